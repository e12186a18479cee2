"""Suspicion: each signal fires on its own error and gives its reason, people's own keys are left alone, and errors put
into good tracks of real pictures come first in the queue."""

from __future__ import annotations

from pathlib import Path

import annotations
import injected_errors
import numpy as np
import pytest
import simulated_annotator

from genmojo_core.trackers.evidence import scene_of
from genmojo_core.trackers.solver import SolveRequest, TrackSolver
from genmojo_core.tracks import keys, suspicion
from genmojo_core.tracks.annotation import Annotation, Proposal
from genmojo_core.tracks.model import OCCLUDED, VISIBLE
from genmojo_core.tracks.signals import Scene, _alike, _medians, _speed_doubt, links, object_size, other_tracker
from genmojo_core.tracks.suspicion import Calibration, Evidence, assess, queue

DATA = Path(__file__).parents[3] / "shared" / "data"


def moving(frames: int = 24) -> Annotation:
    """Five points that move alike, keys at both ends."""
    annotation = annotations.started(frames, 1, 5)
    for track in annotation.tracks:
        for t in (0, frames - 1):
            keys.set_key(annotation, track, t, (300.0 + 70 * track + 9 * t, 400.0 + 40 * (track % 3))).do(annotation)
    return annotation


def shifted(annotation: Annotation, track: int, first: int, last: int, by: tuple[float, float]) -> None:
    cells = annotation.cells(track, np.arange(first, last + 1))
    cells.xy[:] += np.float32(by)
    annotation.write_cells(track, np.arange(first, last + 1), cells)


def masks_around(annotation: Annotation) -> Scene:
    """One object that covers the picture's middle, at a quarter of the size."""
    labels = np.zeros((annotation.frames, 270, 480), np.uint8)
    labels[:, 60:200, 20:300] = 1
    return Scene(labels, np.ones(labels.shape, bool), {1: 1}, np.array([0.25, 0.25]))


def test_a_jump_is_the_worst_spot_and_says_why() -> None:
    annotation = moving()
    shifted(annotation, 3, 10, 10, (25.0, -12.0))
    worst = queue(annotation, assess(annotation))[0]
    assert worst.track == 3
    assert abs(worst.frame - 10) <= 1  # the step into a jump and the one out of it share it
    assert "sudden motion" in worst.reasons


def test_tracks_without_errors_are_not_suspicious_near_keys() -> None:
    found = assess(moving())
    assert max(float(s.score.max()) for s in found.values()) < suspicion.SUSPICIOUS


def test_a_point_outside_its_mask_is_found_even_at_a_key() -> None:
    annotation = moving()
    keys.set_key(annotation, 2, 12, (1500.0, 900.0)).do(annotation)
    found = assess(annotation, masks_around(annotation))[2]
    assert found.score[12] > 0.8
    assert found.reasons(12)[0] == "contradicts the object's mask"


def test_a_hidden_point_on_its_own_mask_is_doubtful_when_matches_agree() -> None:
    annotation = moving()
    keys.set_state(annotation, 2, 8, 12, OCCLUDED).do(annotation)
    cells = annotation.cells(2, np.arange(8, 13))
    cells.flags[:] = 0  # a tracker said so, not a person
    annotation.write_cells(2, np.arange(8, 13), cells)
    sure = {2: Evidence(agreement=np.ones(24))}
    unsure = {2: Evidence(agreement=np.zeros(24))}
    high = assess(annotation, masks_around(annotation), sure)[2].score[8:13].min()
    low = assess(annotation, masks_around(annotation), unsure)[2].score[8:13].max()
    assert high > 0.5 > low


def test_pixels_that_look_like_the_point_speak_against_its_being_hidden() -> None:
    annotation = moving()
    keys.set_state(annotation, 2, 6, 9, OCCLUDED).do(annotation)
    cells = annotation.track(2)
    cells.flags[6:10] = 0  # a tracker said so, nobody painted it
    unlike = np.full(24, 0.9)
    unlike[6:10] = 0.1
    scores = [assess(annotation, masks_around(annotation), {2: Evidence(agreement=np.zeros(24), likeness=likeness)})[2]
              for likeness in (np.full(24, 0.9), unlike)]  # fmt: skip
    assert (scores[0].score[6:10] > suspicion.SUSPICIOUS).all()
    assert (scores[1].score[6:10] < suspicion.SUSPICIOUS).all()
    assert np.allclose(scores[0].parts[:, :6], scores[1].parts[:, :6])  # seen frames are judged among seen ones


def test_keys_are_above_suspicion_and_accepted_frames_nearly() -> None:
    annotation = moving()
    shifted(annotation, 3, 10, 10, (25.0, -12.0))
    before = assess(annotation)[3].score[10]
    keys.confirm(annotation, [3], 10).do(annotation)
    accepted = assess(annotation)[3].score[10]
    x, y = annotation.track(3).xy[10]
    keys.set_key(annotation, 3, 10, (float(x), float(y))).do(annotation)
    assert assess(annotation)[3].score[10] == 0
    assert 0 < accepted < 0.5 * before


def test_a_state_of_one_frame_is_doubtful() -> None:
    annotation = moving()
    cells = annotation.cells(1, np.array([9]))
    cells.state[:] = OCCLUDED
    annotation.write_cells(1, np.array([9]), cells)
    assert "state changes back and forth" in assess(annotation)[1].reasons(9)


JUMPS = (6, 16)


def judged(corrected: bool) -> tuple[Annotation, Calibration]:
    """Two jumps of one track, accepted or corrected, each as often as a person presses Enter on a last frame."""
    annotation = moving()
    calibration = Calibration(prior=1.0)
    for t in JUMPS:
        shifted(annotation, 3, t, t, (25.0, -12.0))
    found = assess(annotation)[3]
    for t in JUMPS:
        keys.confirm(annotation, [3], t).do(annotation)
        for _ in range(30):
            calibration.learn(3, t, found, corrected)
    return annotation, calibration


def test_what_people_correct_and_accept_teaches_whom_to_trust() -> None:
    motion = list(suspicion.SIGNALS).index("motion")
    wrong, first, right = (c.trust()[motion] for c in (judged(False)[1], Calibration(), judged(True)[1]))
    assert wrong < 0.7 * first < first < right


def test_a_place_teaches_once_and_no_signal_is_ever_ruined() -> None:
    _, often = judged(corrected=False)
    assert len(often.outcomes) == len(JUMPS), "thirty Enters on a frame say no more than one"
    often.outcomes |= {(9, t): (np.ones(9), False) for t in range(5000)}
    np.testing.assert_allclose(often.trust(), 0.3 * Calibration().trust())


def test_what_was_undone_teaches_nothing_and_the_rest_is_kept_as_plain_data() -> None:
    annotation, calibration = judged(corrected=False)
    again = Calibration(prior=1.0)
    again.put_rows([tuple(row) for row in calibration.rows()])
    np.testing.assert_allclose(again.trust(annotation), calibration.trust(annotation))
    assert not np.allclose(again.trust(annotation), Calibration().trust())
    for t in JUMPS:
        cells = annotation.cells(3, np.array([t]))
        cells.flags[:] = 0
        annotation.write_cells(3, np.array([t]), cells)
    np.testing.assert_allclose(again.trust(annotation), Calibration().trust())


def test_the_queue_covers_every_frame_once() -> None:
    annotation = moving()
    shifted(annotation, 3, 10, 14, (25.0, -12.0))
    seen = np.zeros((6, 24), int)
    for spot in queue(annotation, assess(annotation)):
        seen[spot.track, spot.first : spot.last + 1] += 1
    assert (seen[1:] == 1).all()


@pytest.mark.clips
@pytest.mark.parametrize("name", ["blender-cross", pytest.param("blender-trio", marks=pytest.mark.slow)])
def test_nine_of_ten_errors_are_in_the_first_fifth_of_the_queue(name: str) -> None:
    if not (DATA / name).is_dir():
        pytest.skip(f"{name} is not beside the checkout")
    clip = simulated_annotator.full_hd(DATA / name, 270)
    truth = simulated_annotator.truth_of(DATA / name)
    solver, shares = TrackSolver(clip), []
    for seed in range(2):
        rng = np.random.default_rng(seed)
        annotation = injected_errors.annotated(truth, rng, points=12)
        errors = injected_errors.inject(annotation, rng, 8)
        evidence = {}
        for owner in annotation.chosen_objects():
            evidence |= solver.evidence(SolveRequest.of(annotation, owner.id))
        spots = queue(annotation, assess(annotation, scene_of(clip), evidence))
        shares.append(injected_errors.found_share(spots, errors)[0])
    assert (annotation.track(1).state == VISIBLE).any()
    assert np.mean(shares) >= 0.9


def test_a_sudden_change_of_speed_speaks_and_the_pace_of_the_object_does_not() -> None:
    steady, fast = moving(), moving()
    shifted(fast, 3, 10, 13, (24.0, 0.0))
    motion = list(suspicion.SIGNALS).index("motion")
    assert assess(steady)[3].parts[motion].max() < 0.1
    cells = fast.track(3)
    others = [fast.track(t) for t in fast.tracks if t != 3]
    for t in (9, 10, 13, 14):  # both ends of the step in and of the step out
        assert _speed_doubt(cells, others, 1.0)[t] > 0.5
    assert _speed_doubt(cells, others, 1.0)[:8].max() == 0


def test_errors_count_against_the_size_of_the_object() -> None:
    annotation = moving()
    cells, gap = annotation.track(2), np.full(24, 6.0)
    small, large = links(cells, gap, 120.0), links(cells, gap, 600.0)
    assert (small > large + 0.2).all()
    away = np.full(24, 8.0)
    assert other_tracker(cells, away, 120.0).min() > other_tracker(cells, away, 600.0).max() + 0.2
    scene = masks_around(annotation)  # 280 x 140 mask px at a quarter of the size
    assert object_size(cells, [], scene, 1, 1.0) == pytest.approx(4 * np.sqrt(280 * 140), rel=0.3)


def test_a_second_opinion_speaks_where_it_differs_and_not_where_a_person_put_a_point_right() -> None:
    annotation = moving()
    trackers = list(suspicion.SIGNALS).index("trackers")
    xy = annotation.track(3).xy.copy()
    xy[10:16] += np.float32(40.0)
    annotation.propose(3, Proposal("optical", xy, np.full(24, VISIBLE, np.uint8), np.ones(24, np.float32)))
    found = assess(annotation)[3]
    assert found.parts[trackers, 11:15].min() > 0.3
    assert found.parts[trackers, :9].max() == 0
    assert "trackers disagree" in found.reasons(12)
    xy = annotation.track(3).xy.copy()
    annotation.propose(3, Proposal("optical", xy, np.full(24, VISIBLE, np.uint8), np.ones(24, np.float32)))
    keys.set_key(annotation, 3, 12, (float(xy[12, 0]) + 30, float(xy[12, 1]))).do(annotation)
    assert assess(annotation)[3].parts[trackers].max() < 0.3


@pytest.mark.parametrize("frames", [1, 5, 18, 19, 40])
def test_medians_around_frames_are_those_of_each_frame_alone(frames: int) -> None:
    values = np.random.default_rng(frames).uniform(0, 9, frames)
    near = [values[max(t - 9, 0) : t + 10] for t in range(frames)]
    usual = _medians(values)
    np.testing.assert_array_equal(usual, [np.median(n) for n in near])
    apart = [np.median(np.abs(n - np.median(n))) for n in near]
    np.testing.assert_array_equal(_medians(values, usual), apart)


def test_frames_in_which_the_same_points_are_known_go_together() -> None:
    rng = np.random.default_rng(1)
    known, own = rng.random((5, 60)) < 0.8, rng.random(60) < 0.9
    groups = _alike(known, own)
    assert sorted(t for _, frames in groups for t in frames) == [
        t for t in range(60) if own[t] and known[:, t].sum() >= 3
    ]
    assert all((known[:, frames] == which[:, None]).all() for which, frames in groups) and len(groups) <= 2**5
    assert _alike(known[:2], own) == []


def test_copies_are_the_same_and_stay_what_they_were() -> None:
    annotation = moving()
    annotation.propose(3, Proposal("x", np.ones((24, 2), np.float32), np.ones(24, np.uint8), np.ones(24, np.float32)))
    copied, digest = annotation.copy(), annotation.digest()
    keys.set_key(annotation, 3, 12, (1.0, 2.0)).do(annotation)
    annotation.put_proposal(3, "x", None)
    assert copied.digest() == digest != annotation.digest() and list(copied.proposals[3]) == ["x"]
    assert copied.revision < annotation.revision and copied.listeners == []
