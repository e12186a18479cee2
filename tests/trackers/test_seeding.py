"""Seeding behind one interface: which places are asked, what becomes of several, what is refused."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import annotations
import numpy as np
import pytest
from scenes import small_scene

from genmojo_core.clip.clip import Clip
from genmojo_core.errors import GenmojoError
from genmojo_core.measure.views import render_frame
from genmojo_core.store import npz, scene_hdf5
from genmojo_core.trackers.seeding import Queries, make, merged
from genmojo_core.tracks import keys
from genmojo_core.tracks.model import NONE, OCCLUDED, VISIBLE, PointTracks


def clip_of(pictures: np.ndarray) -> Clip:
    """A clip of frames (T, H, W, 3)."""
    frames = len(pictures)
    return Clip("c", "procedural", pictures, np.arange(frames), np.arange(frames) / 24.0,
                tuple(map(str, range(frames))), (pictures.shape[2], pictures.shape[1]))  # fmt: skip


def still(places: list[tuple[float, float]], frames: int = 9, size: tuple[int, int] = (96, 72)) -> PointTracks:
    """Points that stand still and are seen."""
    xy = np.repeat(np.array(places, np.float32)[:, None], frames, axis=1)
    state = np.full(xy.shape[:2], VISIBLE, np.uint8)
    return PointTracks(xy, state, np.zeros(len(xy), np.int64), size)


def test_every_visible_key_is_asked_and_no_hidden_one() -> None:
    annotation = annotations.started(24, 1, 3)
    keys.set_key(annotation, 1, 2, (1.0, 2.0), OCCLUDED).do(annotation)
    keys.set_key(annotation, 1, 5, (3.0, 4.0), VISIBLE).do(annotation)
    keys.set_key(annotation, 1, 9, (5.0, 6.0), VISIBLE).do(annotation)
    keys.set_key(annotation, 2, 4, (7.0, 8.0), OCCLUDED).do(annotation)
    keys.set_key(annotation, 3, 0, (9.0, 9.0)).do(annotation)
    ids, queries = Queries.of(annotation)
    assert ids == [1, 3]
    assert queries.t.tolist() == [5, 9, 0] and queries.point.tolist() == [0, 0, 1]
    assert queries.xy.tolist() == [[3, 4], [5, 6], [9, 9]] and queries.object.tolist() == [1, 1, 1]


def test_between_two_queries_both_tracks_count_by_distance_and_confidence() -> None:
    queries = Queries(np.array([2, 6]), np.zeros((2, 2)), np.array([1, 1]), np.array([0, 0]))
    tracks = still([(10.0, 20.0), (30.0, 20.0)])
    tracks.state[1, 5] = OCCLUDED
    one = merged(replace(tracks, conf=np.ones((2, 9), np.float32)), queries)
    assert one.xy[0, :, 0] == pytest.approx([10, 10, 10, 15, 20, 25, 30, 30, 30], abs=1e-3)
    assert one.state[0].tolist() == [VISIBLE] * 5 + [OCCLUDED] + [VISIBLE] * 3 and one.object.tolist() == [1]
    doubtful = np.repeat(np.array([[0.25], [0.75]], np.float32), 9, axis=1)
    assert merged(replace(tracks, conf=doubtful), queries).xy[0, 4, 0] == pytest.approx(25.0, abs=1e-3)
    tracks.state[1, :] = NONE
    assert (merged(tracks, queries).xy[0, :, 0] == 10).all(), "one that knows nothing says nothing"
    tracks.state[0, 8] = NONE
    assert merged(tracks, queries).state[0, 8] == NONE


def test_no_track_of_a_file_is_taken_for_two_points(tmp_path: Path) -> None:
    npz.write_tracks(still([(20.0, 20.0), (70.0, 50.0)]), tmp_path / "f.npz")
    clip = clip_of(np.zeros((9, 72, 96, 3), np.uint8))
    queries = Queries(np.array([0, 0, 4, 0]), np.array([[21.0, 20.0], [20.2, 20.0], [40.0, 40.0], [70.0, 50.0]]),
                      np.array([1, 2, 2, 3]), np.array([0, 1, 1, 2]))  # fmt: skip
    found = merged(make("file", tmp_path / "f.npz").seed(clip, queries), queries)
    assert (found.state[0] == NONE).all() and (found.state[1:] == VISIBLE).all()
    assert found.xy[1:, 0].tolist() == [[20, 20], [70, 50]]


def test_a_file_of_another_size_is_refused(tmp_path: Path) -> None:
    tracks = np.full((9, 2, 2), 300.0, np.float32)
    np.savez(tmp_path / "c.npz", tracks=tracks, visibility=np.ones((9, 2), bool))
    queries = Queries(np.array([0]), np.array([[20.0, 20.0]]), np.array([1]))
    with pytest.raises(GenmojoError, match="store the size"):
        make("file", tmp_path / "c.npz").seed(clip_of(np.zeros((9, 72, 96, 3), np.uint8)), queries)


def test_a_scene_answers_for_its_own_clip_and_objects_only(tmp_path: Path) -> None:
    scene = small_scene(frames=6, size=(96, 72), per_object=400)
    scene_hdf5.write(scene, tmp_path / "s.h5")
    drawn = [render_frame(scene, t, scene.cameras.view(t)).on() for t in range(6)]
    pictures = np.round(255 * np.clip(drawn, 0, 1)).astype(np.uint8)
    seeder, middle = make("scene", tmp_path / "s.h5"), np.array([[48.0, 36.0]])
    found = seeder.seed(clip_of(pictures), Queries(np.zeros(2, int), middle[[0, 0]], np.array([1, 9])))
    assert (found.state[0] != NONE).all() and (found.state[1] == NONE).all(), "the scene has no object 9"
    queries = Queries(np.zeros(1, int), middle, np.array([1]))
    with pytest.raises(GenmojoError, match="another clip"):
        seeder.seed(clip_of(pictures[:, ::-1, ::-1]), queries)
    with pytest.raises(GenmojoError, match="96 x 72 pixels, the clip 72 x 72"):
        seeder.seed(clip_of(pictures[:, :, :72]), queries)
