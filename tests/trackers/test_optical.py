"""Optical point tracks: exact oracles on moved pictures, hidden frames, wrong calls."""

from __future__ import annotations

import cv2
import numpy as np
import pytest

from genmojo_core.clip.clip import Channel, Clip
from genmojo_core.errors import GenmojoError
from genmojo_core.trackers.optical import track_points
from genmojo_core.trackers.search import best_shifts
from genmojo_core.trackers.stabilise import Matcher, grid_of, layer_of

SIZE = (160, 96)
FRAMES = 8


def moved_clip(step: tuple[float, float], turn: float = 0.0, occluder: bool = False) -> tuple[Clip, list[np.ndarray]]:
    """A textured disc that moves `step` pixels and turns `turn` degrees a frame, with its exact affines (2, 3)."""
    rng = np.random.default_rng(3)
    texture = cv2.GaussianBlur(rng.uniform(0, 255, (SIZE[1], SIZE[0])).astype(np.float32), (0, 0), 1.6)
    texture = np.clip((texture - 127) * 5 + 127, 0, 255)
    start = np.array([42.0, 48.0])
    rows, cols = np.mgrid[: SIZE[1], : SIZE[0]] + 0.5
    disc = (np.hypot(cols - start[0], rows - start[1]) < 20).astype(np.float32)
    frames, masks, affines = [], [], []
    for t in range(FRAMES):
        affine = cv2.getRotationMatrix2D(tuple(start), turn * t, 1.0)
        affine[:, 2] += np.array(step) * t
        affines.append(affine)
        shifted = affine.copy()  # OpenCV warps coordinates of pixel centres, half a pixel from raster coordinates
        shifted[:, 2] += affine[:, :2] @ [0.5, 0.5] - 0.5
        picture, mask = (cv2.warpAffine(a, shifted, SIZE, flags=cv2.INTER_LINEAR) for a in (texture, disc))
        label = np.where(mask > 0.5, 1, 0).astype(np.uint8)
        frame = np.where(label > 0, picture, 90.0)
        if occluder and t in (3, 4):
            label[:, 50:] = 2
            frame[:, 50:] = 200.0
        frames.append(np.repeat(frame[..., None], 3, axis=-1).astype(np.uint8))
        masks.append(label)
    labels = np.stack(masks)
    ids = np.arange(1, int(labels.max()) + 1)
    clip = Clip("moved", "procedural", np.stack(frames), np.arange(FRAMES), np.arange(FRAMES) / 24.0,
                tuple(map(str, range(FRAMES))), SIZE, object_ids=ids, object_names=tuple(map(str, ids)),
                masks=Channel(labels, np.ones(labels.shape, bool), "given: test"))  # fmt: skip
    return clip, affines


def queries() -> np.ndarray:
    """Points on the disc of frame 0."""
    return np.array([[42.0, 48.0], [33.0, 42.0], [50.0, 55.0], [44.0, 36.0], [38.0, 60.0]])


def truth_of(affines: list[np.ndarray], points: np.ndarray) -> np.ndarray:
    """(N, T, 2) exact places."""
    return np.stack([points @ a[:, :2].T + a[:, 2] for a in affines], axis=1)


@pytest.mark.parametrize("step", [(0.4, 0.3), (11.0, 0.0), (9.5, -2.5)])
def test_points_of_a_shifted_disc_stay_on_their_texture(step: tuple[float, float]) -> None:
    clip, affines = moved_clip(step)
    points = queries()
    xy, conf = track_points(clip, np.zeros(5, int), points, np.zeros(5, int))
    error = np.linalg.norm(xy - truth_of(affines, points), axis=-1)
    assert error.mean() < 0.3
    assert error.max() < 2.0
    assert conf.mean() > 0.5


def test_points_of_a_turning_disc_turn_with_it() -> None:
    clip, affines = moved_clip((6.0, 0.0), turn=7.0)
    points = queries()
    xy, _ = track_points(clip, np.zeros(5, int), points, np.zeros(5, int))
    assert np.linalg.norm(xy - truth_of(affines, points), axis=-1).mean() < 0.6


def test_points_hidden_for_two_frames_are_carried_with_low_confidence_and_found_again() -> None:
    clip, affines = moved_clip((6.0, 0.0), occluder=True)
    points = queries()
    xy, conf = track_points(clip, np.zeros(5, int), points, np.zeros(5, int))
    expected = truth_of(affines, points)
    hidden = expected[:, 3, 0] > 52
    assert hidden.any()
    assert (conf[hidden, 3] <= 0.2).all()
    assert np.linalg.norm(xy - expected, axis=-1)[:, 5:].mean() < 1.0


def test_a_query_may_lie_in_any_frame_and_keeps_its_place_there() -> None:
    clip, affines = moved_clip((5.0, 1.0))
    points = truth_of(affines, queries())[:, 4]
    xy, conf = track_points(clip, np.full(5, 4), points, np.zeros(5, int))
    assert np.allclose(xy[:, 4], points)
    assert (conf[:, 4] == 1).all()
    assert np.linalg.norm(xy - truth_of(affines, queries()), axis=-1).mean() < 0.5


def test_two_runs_give_the_same_tracks() -> None:
    clip, _ = moved_clip((7.0, 2.0), turn=3.0)
    first = track_points(clip, np.zeros(5, int), queries(), np.zeros(5, int))
    again = track_points(clip, np.zeros(5, int), queries(), np.zeros(5, int))
    assert np.array_equal(first[0], again[0])
    assert np.array_equal(first[1], again[1])


def test_no_query_gives_empty_tracks() -> None:
    clip, _ = moved_clip((1.0, 0.0))
    xy, conf = track_points(clip, np.zeros(0, int), np.zeros((0, 2)), np.zeros(0, int))
    assert xy.shape == (0, FRAMES, 2)
    assert conf.shape == (0, FRAMES)


def test_wrong_queries_are_refused_in_one_sentence() -> None:
    clip, _ = moved_clip((1.0, 0.0))
    with pytest.raises(GenmojoError, match="outside frames 0 to 7"):
        track_points(clip, np.array([8]), np.zeros((1, 2)), np.zeros(1, int))
    with pytest.raises(GenmojoError, match="an object outside"):
        track_points(clip, np.array([0]), np.zeros((1, 2)), np.array([3]))
    with pytest.raises(GenmojoError, match="has no masks"):
        track_points(clip.with_channels(masks=None), np.array([0]), np.zeros((1, 2)), np.array([0]))


def test_the_integer_search_finds_a_jump_of_half_the_object() -> None:
    clip, _ = moved_clip((17.0, 3.0))
    layer = layer_of(clip.frames, clip.masks.value, 1, clip.masks.valid)
    grid = grid_of(layer, 0)
    shift = best_shifts(layer, grid, 1, grid.xy)[0]
    assert np.abs(shift - [17.0, 3.0]).max() < 1.0


def test_nothing_is_matched_where_the_object_is_hidden() -> None:
    clip, _ = moved_clip((6.0, 0.0), occluder=True)
    layer = layer_of(clip.frames, clip.masks.value, 1, clip.masks.valid)
    grid = grid_of(layer, 0)
    link = Matcher().link(layer, grid, 3, (grid.xy + np.float32([18.0, 0.0])).astype(np.float32))
    behind = link.xy[..., 0] > 51
    assert link.weight[behind].max() == 0
    assert link.weight[~behind].max() > 0.5
