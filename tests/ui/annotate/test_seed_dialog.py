"""The seed dialog end to end: real widgets, real child processes. CoTracker is a stand-in with the real interface.

Not covered: CoTracker itself, how good scenes are (tests/acceptance/5.py).
"""

import subprocess
import sys

import numpy as np
import pytest
from annotating import choose_all, place_points
from shiboken6 import isValid

from genmojo_core.clip import mask_file
from genmojo_core.store.npz import read_tracks
from genmojo_core.tracks import keys
from genmojo_core.tracks.annotation import KEY, ObjectInfo
from genmojo_core.tracks.edit_tracks import add_track, put_objects
from genmojo_core.tracks.model import NONE, OCCLUDED, VISIBLE
from genmojo_studio.annotate.seed_dialog import SeedDialog

STAND_IN = """
import torch

class CoTrackerPredictor(torch.nn.Module):
    def __init__(self, checkpoint="x", offline=True, v2=False, window_len=60):
        super().__init__()
        self.speed = torch.load(checkpoint)["speed"]

    def forward(self, video, queries=None, segm_mask=None, grid_size=0, grid_query_frame=0, backward_tracking=False):
        B, T, C, H, W = video.shape
        t = torch.arange(T, dtype=torch.float32)[None, :, None, None]
        tracks = queries[:, None, :, 1:] + (t - queries[:, None, :, :1]) * self.speed
        return tracks, (t[..., 0] < 5).expand(B, T, queries.shape[1])
"""


@pytest.fixture
def checkout(tmp_path):
    pytest.importorskip("torch")
    package = tmp_path / "checkout" / "cotracker"
    package.mkdir(parents=True)
    (package / "__init__.py").write_text("")
    (package / "predictor.py").write_text(STAND_IN)
    weights = tmp_path / "scaled_offline.pth"
    save = "import sys, torch; torch.save({'speed': torch.tensor([0.5, 0.25])}, sys.argv[1])"
    subprocess.run([sys.executable, "-c", save, str(weights)], check=True)
    return package.parent, weights


def opened(workspace):
    """The dialog as its key opens it."""
    workspace.table.trigger("annotate.track.seed")
    return next(d for d in workspace.findChildren(SeedDialog) if d.isVisible())


def test_cotracker_from_the_dialog(workspace, qtbot, checkout):
    choose_all(workspace)
    places = place_points(workspace, each=1)
    dialog, session = opened(workspace), workspace.session
    dialog.choose("cotracker")
    dialog.checkout.line.setText(str(checkout[0]))
    dialog.weights.line.setText(str(checkout[1]))
    dialog.start.click()
    assert dialog.isVisible() and "agreed" in dialog.note.text(), "nothing runs before the licence was agreed to"
    dialog.consent.setChecked(True)
    dialog.start.click()
    qtbot.waitUntil(lambda: not isValid(dialog), timeout=60_000)
    scale = np.array(session.annotation.size) / np.array(session.clip.size)
    for track, place in zip(session.annotation.tracks, places, strict=True):
        cells = session.annotation.track(track)
        expected = session.annotation.track(track).xy[0] + np.arange(len(cells))[:, None] * (0.5, 0.25) * scale
        np.testing.assert_allclose(cells.xy, expected, atol=2e-3)
        assert cells.flags[0] & KEY and np.hypot(*(cells.xy[0] - place)) < 1.0, "a human key is never overwritten"
        assert cells.state[1:5].tolist() == [VISIBLE] * 4 and cells.state[5] == OCCLUDED
    session.undo()
    assert all((session.annotation.track(t).state[1:] == NONE).all() for t in session.annotation.tracks)


def test_a_wrong_checkout_is_said_in_the_dialog(workspace, tmp_path):
    choose_all(workspace)
    place_points(workspace, each=1)
    dialog = opened(workspace)
    dialog.choose("cotracker")
    dialog.checkout.line.setText(str(tmp_path))
    dialog.consent.setChecked(True)
    dialog.start.click()
    assert dialog.isVisible() and "predictor.py" in dialog.note.text()
    dialog.reject()


def test_a_scene_is_optimised_with_the_masks_cut_by_hand(workspace, qtbot):
    """The run is started and given up: what it was given stays on the disk."""
    choose_all(workspace)
    place_points(workspace, each=1)
    frame = workspace.session.annotation.size
    workspace.work.masks.add_box(0.3 * frame[0], 0.3 * frame[1], 0.6 * frame[0], 0.7 * frame[1])
    workspace.work.masks.cut()
    qtbot.waitUntil(lambda: bool(workspace.session.hand_masks), timeout=120_000)
    (own,) = workspace.session.hand_masks
    dialog = opened(workspace)
    dialog.choose("scene")
    dialog.start.click()
    arguments = dialog.job.arguments()
    dialog.reject()
    given = mask_file.with_masks(workspace.session.clip, arguments[arguments.index("--masks") + 1])
    assert own in given.object_ids
    assert (given.object_mask(given.object_ids.tolist().index(own)) == workspace.session.hand_masks[own]).all()
    assert "--tracks" in arguments


def test_why_nothing_was_seeded_is_said_in_the_dialog(workspace, qtbot, checkout):
    choose_all(workspace)
    place_points(workspace, each=1)
    checkout[1].write_bytes(b"no weights")
    dialog = opened(workspace)
    dialog.choose("cotracker")
    dialog.checkout.line.setText(str(checkout[0]))
    dialog.weights.line.setText(str(checkout[1]))
    dialog.consent.setChecked(True)
    dialog.start.click()
    qtbot.waitUntil(lambda: dialog.start.isEnabled(), timeout=60_000)
    assert "CoTracker stopped" in dialog.note.text()
    source = checkout[0] / "cotracker" / "predictor.py"
    source.write_text("import os, signal\nos.kill(os.getpid(), signal.SIGKILL)\n")
    dialog.start.click()
    qtbot.waitUntil(lambda: dialog.start.isEnabled(), timeout=60_000)
    assert "out of memory" in dialog.note.text()
    dialog.reject()


def test_an_object_without_mask_or_points_does_not_stop_the_others(workspace, qtbot):
    choose_all(workspace)
    place_points(workspace, each=1)
    session = workspace.session
    annotation, first = session.annotation, next(iter(session.annotation.tracks))
    session.do(put_objects(annotation, [ObjectInfo(9, "ghost", 9, "chosen")]))
    session.select(9, 1)
    dialog = opened(workspace)
    dialog.active_only.setChecked(True)
    dialog.start.click()
    assert dialog.isVisible() and dialog.note.text() == "Place points first."
    dialog.reject()
    session.do(add_track(annotation, 9, 1))
    (ghost,) = annotation.tracks_of(9)
    session.do(keys.set_key(annotation, ghost.id, 0, tuple(annotation.track(first).xy[0])))
    said = []
    session.said.connect(said.append)
    dialog = opened(workspace)
    dialog.start.click()
    qtbot.waitUntil(lambda: not isValid(dialog), timeout=120_000)
    assert (session.annotation.track(first).state != NONE).all()
    assert any("ghost" in sentence and "seeded" in sentence for sentence in said)


def test_solve_from_scene_begins_at_once_with_a_forecast(workspace, qtbot):
    choose_all(workspace)
    place_points(workspace, each=1)
    workspace.table.trigger("annotate.track.scene")
    dialog = next(d for d in workspace.findChildren(SeedDialog) if d.isVisible())
    assert dialog.job is not None and dialog.progress.isVisible() and "min" in dialog.note.text()
    assert "--tracks" in dialog.job.arguments()
    dialog.reject()


@pytest.mark.slow
@pytest.mark.timeout(600)
def test_solve_from_scene_with_one_button(workspace, qtbot):
    """The real optimiser in its own process, given what was placed; its scene's tracks fill the rest."""
    choose_all(workspace)
    place_points(workspace, each=1)
    dialog, session = opened(workspace), workspace.session
    dialog.choose("scene")
    dialog.minutes.setItemData(0, 0.25)
    dialog.start.click()
    qtbot.waitUntil(lambda: not isValid(dialog), timeout=500_000)
    given = read_tracks(session.project.path.with_suffix(".scene.tracks.npz"), session.annotation.size)
    assert (given.state[:, 0] == VISIBLE).all() and (given.state[:, 1:] == NONE).all()
    for track in session.annotation.tracks:
        cells = session.annotation.track(track)
        assert (cells.state != NONE).all() and cells.flags[0] & KEY
        assert track in session.project.annotation.proposals
