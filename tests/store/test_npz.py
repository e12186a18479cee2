"""Track, query and TAP-Vid files: round trips, the layout of exact truth, and one sentence for everything else."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from hypothesis.extra import numpy as hnp

from genmojo_core.errors import GenmojoError
from genmojo_core.store import npz, tapvid
from genmojo_core.store.track_sheet import TrackSheet
from genmojo_core.tracks.model import NONE, OCCLUDED, OUT_OF_VIEW, VISIBLE, PointTracks


def fails(action, *args) -> str:
    with pytest.raises(GenmojoError) as caught:
        action(*args)
    return caught.value.code


def some_tracks() -> PointTracks:
    xy = np.array([[[1.5, 2], [np.nan, np.nan], [70, 3]], [[9, 9], [10, 11], [12, 13]]], np.float32)
    state = np.array([[VISIBLE, NONE, OUT_OF_VIEW], [VISIBLE, OCCLUDED, VISIBLE]], np.uint8)
    return PointTracks(xy, state, np.array([1, 0]), (64, 48), conf=np.ones((2, 3), np.float32))


def test_tracks_round_trip(tmp_path):
    npz.write_tracks(some_tracks(), tmp_path / "t.npz")
    found = npz.read_tracks(tmp_path / "t.npz")
    np.testing.assert_array_equal(found.xy, some_tracks().xy)
    np.testing.assert_array_equal(found.state, some_tracks().state)
    assert found.size == (64, 48) and found.conf is not None and found.xyz is None


def test_exact_truth_is_read_as_truth(tmp_path):
    """Hidden points keep their place; outside the picture is its own state; the image size comes from the caller."""
    xy = np.array([[[5, 5], [6, 6], [99, 6]]], np.float32)
    np.savez(tmp_path / "truth.npz", tracks=xy, visible=np.array([[1, 0, 0]], bool), track_object=[2],
             track_xyz=np.zeros((1, 3, 3)))  # fmt: skip
    found = npz.read_tracks(tmp_path / "truth.npz", (64, 48))
    assert found.state.tolist() == [[VISIBLE, OCCLUDED, OUT_OF_VIEW]] and found.object.tolist() == [2]
    assert found.xyz is not None
    assert fails(npz.read_tracks, tmp_path / "truth.npz") == "schema"


def test_bad_files(tmp_path):
    good = {"xy": np.zeros((2, 3, 2)), "state": np.ones((2, 3), np.uint8), "object": np.zeros(2), "size": [64, 48]}
    cases = {
        "unsafe_pickle": good | {"xy": np.array([{}], dtype=object)},
        "schema": good | {"xy": np.zeros((2, 4, 2))},
        "value": good | {"state": np.full((2, 3), 9)},
    }
    for expected, arrays in cases.items():
        np.savez(tmp_path / "a.npz", **arrays)
        assert fails(npz.read_tracks, tmp_path / "a.npz") == expected
    for arrays in ({"xy": good["xy"]}, good | {"size": [0, 5]}, good | {"xy": np.full((2, 3, 2), np.nan)}):
        np.savez(tmp_path / "a.npz", **arrays)
        assert fails(npz.read_tracks, tmp_path / "a.npz") in ("schema", "value")
    (tmp_path / "b.npz").write_bytes(b"PK\x03\x04 but no more")
    assert fails(npz.read_tracks, tmp_path / "b.npz") == "format"
    assert fails(npz.read_tracks, tmp_path / "none.npz") == "io"


def test_queries(tmp_path):
    np.savez(tmp_path / "q.npz", t=[0, 2], xy=[[1, 2], [3, 4.5]])
    t, xy = npz.read_queries(tmp_path / "q.npz")
    assert t.tolist() == [0, 2] and xy.tolist() == [[1, 2], [3, 4.5]]
    for t, xy in (([0], [[1, 2], [3, 4]]), ([0.5], [[1, 2]]), ([0], [[np.nan, 1]]), ([], np.zeros((0, 2)))):
        np.savez(tmp_path / "q.npz", t=t, xy=xy)
        assert fails(npz.read_queries, tmp_path / "q.npz") in ("schema", "value", "empty")


def test_a_visible_point_without_place_is_not_written(tmp_path):
    tracks = some_tracks()
    tracks.state[0, 1] = VISIBLE
    assert fails(npz.write_tracks, tracks, tmp_path / "t.npz") == "value"
    assert fails(tapvid.write, TrackSheet.of_tracks(tracks), tmp_path / "t.npz") == "value"
    assert not (tmp_path / "t.npz").exists()


@settings(max_examples=25, deadline=None)
@given(
    hnp.arrays(np.float32, (3, 4, 2), elements=st.floats(0.5, 39.5, width=32)),
    hnp.arrays(np.uint8, (3, 4), elements=st.sampled_from([VISIBLE, OCCLUDED])),
)
def test_tapvid_is_x_over_width(tmp_path_factory, xy, state):
    """Points are x / W and y / H exactly (not W - 1), and come back to the pixel."""
    path = tmp_path_factory.mktemp("tapvid") / "t.npz"
    tapvid.write(TrackSheet.of_tracks(PointTracks(xy, state, np.zeros(3, np.int64), (80, 40))), path)
    with np.load(path) as stored:
        np.testing.assert_array_equal(stored["points"], xy / np.array([80, 40], np.float32))
        np.testing.assert_array_equal(stored["occluded"], state != VISIBLE)
    found = tapvid.read(path).tracks
    np.testing.assert_allclose(found.xy, xy, rtol=1e-6)
    np.testing.assert_array_equal(found.state, state)


def test_tapvid_clips_only_in_the_export(tmp_path):
    tapvid.write(TrackSheet.of_tracks(some_tracks()), tmp_path / "t.npz", video=np.zeros((3, 48, 64, 3), np.uint8))
    with np.load(tmp_path / "t.npz") as stored:
        assert stored["points"].max() == 1.0
    assert tapvid.read(tmp_path / "t.npz").tracks.state[0, 2] == OUT_OF_VIEW
    np.savez(tmp_path / "u.npz", points=np.zeros((1, 2, 2)), occluded=np.zeros((1, 2), bool))
    assert fails(tapvid.read, tmp_path / "u.npz") == "schema"
    assert tapvid.read(tmp_path / "u.npz", (10, 10)).tracks.size == (10, 10)
