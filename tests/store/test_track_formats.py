"""Track formats: what is written comes back to 1e-4 px with every state the format can hold; foreign files of other
programs' own layout are read; hostile ones are refused in one sentence."""

from __future__ import annotations

import json
from collections.abc import Callable
from pathlib import Path

import h5py
import numpy as np
import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from genmojo_core.errors import GenmojoError
from genmojo_core.store import coco, cotracker_npz, cvat, deeplabcut, sleap, tapvid, tracks_hdf5
from genmojo_core.store.track_sheet import TrackSheet
from genmojo_core.tracks.model import NONE, OCCLUDED, OUT_OF_VIEW, VISIBLE, PointTracks

SIZE = (1920, 1080)


@st.composite
def sheets(draw: st.DrawFn) -> TrackSheet:
    """Tracks with gaps, objects with sparse ids, points outside the picture; no track is wholly empty."""
    owners = draw(st.lists(st.sampled_from([1, 7, 29]), min_size=1, max_size=5).map(sorted))
    frames = draw(st.integers(1, 7))
    rng = np.random.default_rng(draw(st.integers(0, 2**32 - 1)))
    xy = rng.uniform([0, 0], SIZE, (len(owners), frames, 2))
    state = rng.integers(0, 4, (len(owners), frames)).astype(np.uint8)
    state[:, -1] = VISIBLE
    xy[state == OUT_OF_VIEW] += 2000.0
    xy[state == NONE] = np.nan
    tracks = PointTracks(xy.astype(np.float32), state, np.array(owners, np.int64), SIZE)
    plain = TrackSheet.of_tracks(tracks)
    return TrackSheet(tracks, plain.numbers, {i: f"thing {i}" for i in set(owners)})


def same_places(a: TrackSheet, b: TrackSheet, states: tuple[int, ...]) -> None:
    """Same rows; the states named come back, and their positions."""
    assert a.tracks.state.shape == b.tracks.state.shape
    for state in states:
        assert np.array_equal(a.tracks.state == state, b.tracks.state == state), state
        where = a.tracks.state == state
        if state != NONE:
            assert np.abs(a.tracks.xy[where] - b.tracks.xy[where]).max(initial=0.0) <= 1e-4


FULL = {
    "cotracker": (cotracker_npz.write, cotracker_npz.read, "t.npz"),
    "cvat": (cvat.write, cvat.read, "t.xml"),
    "coco": (coco.write, coco.read, "t.json"),
    "hdf5": (tracks_hdf5.write, tracks_hdf5.read, "t.h5"),
}


@pytest.mark.parametrize("name", list(FULL))
@settings(max_examples=15, deadline=None, suppress_health_check=[HealthCheck.function_scoped_fixture])
@given(sheet=sheets())
def test_formats_with_states_bring_everything_back(tmp_path: Path, name: str, sheet: TrackSheet) -> None:
    write, read, file = FULL[name]
    write(sheet, tmp_path / file)
    back = read(tmp_path / file)
    same_places(sheet, back, (NONE, VISIBLE, OCCLUDED, OUT_OF_VIEW))
    assert back.tracks.size == SIZE
    assert np.array_equal(back.tracks.object, sheet.tracks.object)
    assert np.array_equal(back.numbers, sheet.numbers)


@settings(max_examples=15, deadline=None, suppress_health_check=[HealthCheck.function_scoped_fixture])
@given(sheet=sheets())
def test_formats_without_states_bring_back_what_is_seen(tmp_path: Path, sheet: TrackSheet) -> None:
    frames = sheet.tracks.state.shape[1]
    deeplabcut.write(sheet, tmp_path / "t.csv")
    same_places(sheet, deeplabcut.read(tmp_path / "t.csv", SIZE, frames), (VISIBLE,))
    tapvid.write(sheet.tracks, tmp_path / "t.npz")
    same_places(sheet, TrackSheet.of_tracks(tapvid.read(tmp_path / "t.npz")), (VISIBLE,))


@settings(max_examples=15, deadline=None, suppress_health_check=[HealthCheck.function_scoped_fixture])
@given(sheet=sheets())
def test_sleap_brings_back_what_is_seen_and_our_states(tmp_path: Path, sheet: TrackSheet) -> None:
    sleap.write(sheet, tmp_path / "t.h5")
    back = sleap.read(tmp_path / "t.h5")
    owners = [(int(o), int(n)) for o, n in zip(back.tracks.object, back.numbers, strict=True)]
    rows = [owners.index((int(o), int(n))) for o, n in zip(sheet.tracks.object, sheet.numbers, strict=True)]
    assert np.array_equal(back.tracks.state[rows], sheet.tracks.state)
    seen = sheet.tracks.visible
    assert np.abs(back.tracks.xy[rows][seen] - sheet.tracks.xy[seen]).max() <= 1e-4
    assert back.object_names[owners[0][0]] == f"thing {owners[0][0]}"


def test_the_first_pixels_centre_is_zero_to_sleap_deeplabcut_and_cotracker(tmp_path: Path) -> None:
    tracks = PointTracks(np.array([[[0.5, 3.25]]], np.float32), np.array([[VISIBLE]], np.uint8), np.array([1]), (8, 6))
    sheet = TrackSheet.of_tracks(tracks)
    sleap.write(sheet, tmp_path / "s.h5")
    with h5py.File(tmp_path / "s.h5") as file:
        assert file["tracks"].shape == (1, 2, 1, 1)
        assert file["tracks"][0, :, 0, 0].tolist() == [0.0, 2.75]
    deeplabcut.write(sheet, tmp_path / "d.csv")
    assert (tmp_path / "d.csv").read_text().splitlines()[-1].endswith("img00000.png,0.000000,2.750000")
    cotracker_npz.write(sheet, tmp_path / "c.npz")
    assert np.load(tmp_path / "c.npz")["tracks"][0, 0].tolist() == [0.0, 2.75]


def test_axes_are_not_mixed_up(tmp_path: Path) -> None:
    xy = np.arange(2 * 3 * 2, dtype=np.float32).reshape(2, 3, 2) + 0.5
    sheet = TrackSheet.of_tracks(PointTracks(xy, np.full((2, 3), VISIBLE, np.uint8), np.array([1, 1]), (50, 40)))
    cotracker_npz.write(sheet, tmp_path / "c.npz")
    held = np.load(tmp_path / "c.npz")
    assert held["tracks"].shape == (3, 2, 2)
    assert held["tracks"][2, 1].tolist() == [10.0, 11.0]
    tapvid.write(sheet.tracks, tmp_path / "t.npz")
    assert np.allclose(np.load(tmp_path / "t.npz")["points"][1, 2], [10.5 / 50, 11.5 / 40])


def test_files_of_the_other_programs_themselves_are_read(tmp_path: Path) -> None:
    (tmp_path / "dlc.csv").write_text(
        "scorer,Ada,Ada,Ada,Ada\nbodyparts,nose,nose,tail,tail\ncoords,x,y,x,y\n"
        "labeled-data/v/img003.png,10.0,20.0,,\nlabeled-data/v/img007.png,11.0,21.0,5.0,6.0\n"
    )
    sheet = deeplabcut.read(tmp_path / "dlc.csv", (640, 480))
    assert sheet.tracks.xy[0, 3].tolist() == [10.5, 20.5]
    assert sheet.tracks.state[:, 3].tolist() == [VISIBLE, NONE]
    assert sheet.tracks.xy[1, 7].tolist() == [5.5, 6.5]
    (tmp_path / "cvat.xml").write_text(
        "<annotations><meta><job><original_size><width>64</width><height>48</height></original_size></job></meta>"
        '<track id="0" label="eye"><points frame="0" points="1.0,2.0" outside="0" occluded="0" keyframe="1"/>'
        '<points frame="4" points="9.0,2.0" outside="0" occluded="1" keyframe="1"/>'
        '<points frame="5" points="9.0,2.0" outside="1" occluded="0" keyframe="1"/></track></annotations>'
    )
    sheet = cvat.read(tmp_path / "cvat.xml")
    assert sheet.tracks.state[0].tolist() == [VISIBLE] * 4 + [OCCLUDED, OUT_OF_VIEW]
    assert sheet.tracks.xy[0, 2].tolist() == [5.0, 2.0]
    sleap_tracks = np.full((1, 2, 1, 4), np.nan)
    sleap_tracks[0, :, 0, 1] = (3.0, 4.0)
    with h5py.File(tmp_path / "a.h5", "w") as file:
        file["tracks"], file["track_names"], file["node_names"] = sleap_tracks, [b"fly"], [b"head"]
    sheet = sleap.read(tmp_path / "a.h5", (64, 48))
    assert sheet.tracks.xy[0, 1].tolist() == [3.5, 4.5]
    assert sheet.tracks.state[0].tolist() == [NONE, VISIBLE, NONE, NONE]


@pytest.mark.parametrize(
    ("read", "name", "text", "says"),
    [
        (cvat.read, "a.xml", '<!DOCTYPE a [<!ENTITY x SYSTEM "file:///etc/passwd">]><annotations/>', "document type"),
        (cvat.read, "b.xml", "<annotations><track", "no XML"),
        (cvat.read, "c.xml", '<annotations><track><points frame="99999999999999" points="1,1"/></track></annotations>',
         "whole number|image size"),
        (coco.read, "d.json", '{"images": [], "categories": []}', "not COCO"),
        (coco.read, "e.json", '{"images": NaN}', "not valid JSON"),
        (lambda p: deeplabcut.read(p, SIZE), "f.csv", "a,b\n1,2\n", "bodyparts"),
        (lambda p: deeplabcut.read(p, SIZE), "g.csv", "scorer,a,a\nbodyparts,b,b\ncoords,x,y\nimg1.png,one,2\n",
         "no number"),
    ],
)  # fmt: skip
def test_what_is_no_such_file_is_refused_in_one_sentence(
    tmp_path: Path, read: Callable[[Path], TrackSheet], name: str, text: str, says: str
) -> None:
    (tmp_path / name).write_text(text)
    with pytest.raises(GenmojoError, match=says):
        read(tmp_path / name)


def test_a_sparse_category_does_not_invent_points(tmp_path: Path) -> None:
    whole = {"images": [{"id": 4, "file_name": "a", "width": 9, "height": 8}],
             "categories": [{"id": 1, "name": "cat", "keypoints": ["nose", "ear"]}],
             "annotations": [{"id": 1, "image_id": 4, "category_id": 1, "keypoints": [1, 2, 2, 0, 0, 0]}]}  # fmt: skip
    (tmp_path / "a.json").write_text(json.dumps(whole))
    sheet = coco.read(tmp_path / "a.json")
    assert sheet.tracks.xy.tolist() == [[[1.0, 2.0]]]
