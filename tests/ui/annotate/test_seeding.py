"""Seeding from the window: what is not found is named and takes nothing away, what is cancelled changes nothing."""

import threading

import numpy as np
import pytest
from annotating import choose_all, fill, place_points

from genmojo_core.store.npz import write_tracks
from genmojo_core.trackers.seeding import make
from genmojo_core.tracks import keys
from genmojo_core.tracks.annotation import FILE
from genmojo_core.tracks.model import OCCLUDED, VISIBLE, PointTracks
from genmojo_studio.annotate import verbs


@pytest.fixture
def said(workspace):
    """All sentences of the status line."""
    sentences = []
    workspace.session.said.connect(sentences.append)
    return sentences


class Waiting:
    """A seeder that goes on when it is told to, and does not look whether it was cancelled."""

    name, licence = "waiting", ""

    def __init__(self) -> None:
        self.go = threading.Event()

    def forecast(self, clip, queries):
        return 1.0

    def seed(self, clip, queries, progress=None, cancelled=None):
        assert self.go.wait(60)
        xy = np.repeat(queries.xy[:, None], len(clip), axis=1) + np.arange(len(clip))[:, None]
        state = np.full(xy.shape[:2], VISIBLE, np.uint8)
        return PointTracks(xy.astype(np.float32), state, queries.object, clip.source_size)


def objects(session):
    return [o.id for o in session.objects()]


def seed(workspace, qtbot, seeder):
    """Seed everything; the number of tracks filled."""
    with qtbot.waitSignal(workspace.work.tracker.seeded, timeout=60_000) as told:
        assert workspace.work.tracker.seed_by(seeder, objects(workspace.session))
    return told.args[0]


def test_a_file_that_has_some_tracks_fills_those_and_names_the_rest(workspace, qtbot, tmp_path, said):
    choose_all(workspace)
    places = place_points(workspace, each=1)
    fill(workspace)
    session = workspace.session
    session.do(keys.set_state(session.annotation, 1, 6, 9, OCCLUDED))
    before, frames = session.annotation.digest(), session.annotation.frames
    xy = np.full((1, frames, 2), 1.0, np.float32)
    far = PointTracks(xy, np.full((1, frames), VISIBLE, np.uint8), np.zeros(1, int), session.annotation.size)
    write_tracks(far, tmp_path / "far.npz")
    assert seed(workspace, qtbot, make("file", tmp_path / "far.npz")) == 0
    assert session.annotation.digest() == before and said[-1].startswith("Nothing was found for point 1 of")
    assert not session.annotation.proposals

    xy = (session.annotation.track(1).xy[:1] + np.arange(frames)[:, None]).astype(np.float32)
    near = PointTracks(xy[None], far.state, far.object, far.size)
    write_tracks(near, tmp_path / "near.npz")
    assert seed(workspace, qtbot, make("file", tmp_path / "near.npz")) == 1
    assert said[-1].startswith(f"1 of {len(places)} tracks are seeded. Nothing was found for point 1 of")
    np.testing.assert_allclose(session.annotation.track(1).xy, xy, atol=1e-3)
    assert (session.annotation.track(1).state[6:10] == OCCLUDED).all(), "what was painted stays"


def test_seeding_again_goes_smoothly_through_every_key(workspace, qtbot):
    choose_all(workspace)
    place_points(workspace, each=1)
    session = workspace.session
    seeder = Waiting()
    seeder.go.set()
    seed(workspace, qtbot, seeder)
    x, y = session.annotation.track(1).xy[10]
    session.do(keys.set_key(session.annotation, 1, 10, (float(x) + 20.0, float(y))))
    seed(workspace, qtbot, seeder)
    xy = session.annotation.track(1).xy
    assert xy[10, 0] == pytest.approx(x + 20.0)
    assert np.abs(np.diff(xy, axis=0)).max() < 1 + 20 / 10 + 0.01, "no key stands out as a spike"


def test_a_key_after_seeding_from_a_file_keeps_the_way_of_the_file(workspace, qtbot, tmp_path):
    choose_all(workspace)
    place_points(workspace, each=1)
    session = workspace.session
    frames = session.annotation.frames
    swing = np.stack([np.zeros(frames), 4.0 * np.sin(np.arange(frames) / 2.0)], axis=1)
    xy = (session.annotation.track(1).xy[:1] + swing).astype(np.float32)
    state = np.where(np.arange(frames) % 12 < 6, VISIBLE, OCCLUDED).astype(np.uint8)
    owner = np.array([session.annotation.tracks[1].object])
    write_tracks(PointTracks(xy[None], state[None], owner, session.annotation.size), tmp_path / "swing.npz")
    assert seed(workspace, qtbot, make("file", tmp_path / "swing.npz")) == 1
    session.select_track(1)
    session.go(9)
    x, y = session.annotation.track(1).xy[9]
    with qtbot.waitSignal(workspace.work.tracker.solved, timeout=60_000):
        verbs.place(session, (float(x) + 1.0, float(y)))
        workspace.work.tracker.after_key(1, 9, session.project.log.head)
    now = session.annotation.track(1)
    hidden = np.setdiff1d(np.flatnonzero(state == OCCLUDED), [9])
    assert (now.state[hidden] == OCCLUDED).all(), "which its mask does not tell"
    assert (now.source[hidden] == FILE).all(), "the next key is answered alike"
    workspace.refine.refresh()
    assert workspace.refine.seed.text().startswith("a person")
    session.go(int(hidden[0]))
    workspace.refine.refresh()
    assert workspace.refine.seed.text().startswith("file")


def test_what_was_cancelled_changes_nothing_however_far_it_was(workspace, qtbot, said):
    choose_all(workspace)
    place_points(workspace, each=1)
    session, tracker = workspace.session, workspace.work.tracker
    before, seeder = session.annotation.digest(), Waiting()
    with qtbot.waitSignal(tracker.seeded, timeout=60_000) as told:
        assert tracker.seed_by(seeder, objects(session))
        tracker.cancel()
        seeder.go.set()
    assert told.args == [0] and session.annotation.digest() == before and "cancelled" in said[-1]
    first, second, counts = Waiting(), Waiting(), []
    tracker.seeded.connect(counts.append)
    tracker.seed_by(first, objects(session))
    tracker.seed_by(second, objects(session))  # takes the place of the first, which must not come back to life
    first.go.set()
    second.go.set()
    qtbot.waitUntil(lambda: len(counts) == 2, timeout=60_000)
    assert counts == [0, len(session.annotation.tracks)]


def test_hidden_points_alone_are_no_place_to_start_from(workspace, said):
    choose_all(workspace)
    place_points(workspace, each=1)
    session = workspace.session
    for track in session.annotation.tracks:
        session.do(keys.set_state(session.annotation, track, 0, 0, OCCLUDED))
    assert not workspace.work.tracker.seed_by(Waiting(), objects(session))
    assert said[-1] == "Place points where they are seen."


def test_to_seed_now_is_not_said_any_more_once_it_is_done_in_any_way(workspace, qtbot):
    choose_all(workspace)
    place_points(workspace, each=workspace.session.limit("points"))
    bar = workspace.window().statusBar()
    assert "Seed the tracks now" in bar.currentMessage()
    fill(workspace)  # as an import or a scene does: no seeding of this window ends here
    workspace.show_step(2)
    assert "Seed the tracks now" not in bar.currentMessage()
