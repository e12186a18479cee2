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
from genmojo_core.store import coco, cotracker_npz, cvat, deeplabcut, sleap, tapvid, track_npz, tracks_hdf5
from genmojo_core.store.track_sheet import TrackSheet
from genmojo_core.tracks.annotation import UNCERTAIN
from genmojo_core.tracks.model import NONE, OCCLUDED, OUT_OF_VIEW, VISIBLE, PointTracks

SIZE = (1920, 1080)


WORDS = st.text(st.characters(categories=("L", "N", "P", "Zs"), exclude_characters="\ufeff"), max_size=8).map(str.strip)


@st.composite
def sheets(draw: st.DrawFn) -> TrackSheet:
    """What an annotation can hold: objects with sparse ids, sparse numbers, names in any script, every state with a
    place anywhere (hidden inside, on the border or outside, seen beside the picture), flags, sources, confidences."""
    pairs = draw(
        st.lists(st.tuples(st.sampled_from([1, 7, 29]), st.integers(1, 6)), min_size=1, max_size=6, unique=True)
    )
    pairs.sort()
    count, frames = len(pairs), draw(st.integers(1, 7))
    rng = np.random.default_rng(draw(st.integers(0, 2**32 - 1)))
    xy = rng.uniform([0, 0], SIZE, (count, frames, 2))
    state = rng.integers(0, 4, (count, frames)).astype(np.uint8)
    state[:, -1] = VISIBLE
    away = rng.random((count, frames)) < 0.3
    xy[away] = rng.choice([0.0, -7.25, 2000.5], (int(away.sum()), 2))
    xy[state == NONE] = np.nan
    flags, source = rng.integers(0, 32, (count, frames)), rng.integers(1, 7, (count, frames))
    conf = rng.random((count, frames)).astype(np.float32)
    cells = [np.where(state == NONE, 0, array) for array in (conf, flags.astype(np.uint8), source.astype(np.uint8))]
    tracks = PointTracks(xy.astype(np.float32), state, np.array([o for o, _ in pairs], np.int64), SIZE, None, *cells)
    names = {i: draw(WORDS) or f"thing {i}" for i in sorted({o for o, _ in pairs})}
    words = draw(st.lists(WORDS, min_size=count, max_size=count))
    reviews = tuple(draw(st.sampled_from(["draft", "approved", "rejected"])) for _ in pairs)
    seconds = np.cumsum(rng.uniform(0.01, 0.2, frames))
    return TrackSheet(tracks, np.array([n for _, n in pairs], np.int64), names, (), tuple(words), reviews, seconds)


def the_same(a: TrackSheet, b: TrackSheet, cells: bool = True) -> None:
    """Every track of `a` is in `b` with its place to 1e-4 px, its states, and what else a project knows of it."""
    there = list(zip(b.tracks.object.tolist(), b.numbers.tolist(), strict=True))
    rows = [there.index(pair) for pair in zip(a.tracks.object.tolist(), a.numbers.tolist(), strict=True)]
    assert len(there) == len(rows)
    assert np.array_equal(b.tracks.state[rows], a.tracks.state)
    known = a.tracks.state != NONE
    assert np.abs(b.tracks.xy[rows][known] - a.tracks.xy[known]).max(initial=0.0) <= 1e-4
    assert [b.name_of(i) for i in a.tracks.object.tolist()] == [a.name_of(i) for i in a.tracks.object.tolist()]
    assert [b.point_name(r) for r in rows] == [a.point_name(k) for k in range(len(rows))]
    assert [b.review(r) for r in rows] == [a.review(k) for k in range(len(rows))]
    assert b.owners_told
    assert b.numbers_told
    for name in ("flags", "source", "conf") if cells else ():
        assert np.array_equal(getattr(b.tracks, name)[rows], getattr(a.tracks, name)), name


FULL = {
    "ours": (track_npz.write, track_npz.read, "t.npz"),
    "tapvid": (tapvid.write, track_npz.read, "t.npz"),
    "cotracker": (cotracker_npz.write, track_npz.read, "t.npz"),
    "cvat": (cvat.write, cvat.read, "t.xml"),
    "coco": (coco.write, coco.read, "t.json"),
    "hdf5": (tracks_hdf5.write, tracks_hdf5.read, "t.h5"),
    "sleap": (sleap.write, sleap.read, "t.h5"),
}


@pytest.mark.parametrize("name", list(FULL))
@settings(max_examples=20, deadline=None, suppress_health_check=[HealthCheck.function_scoped_fixture])
@given(sheet=sheets())
def test_every_format_but_csv_brings_everything_back(tmp_path: Path, name: str, sheet: TrackSheet) -> None:
    write, read, file = FULL[name]
    write(sheet, tmp_path / file)
    back = read(tmp_path / file)
    the_same(sheet, back)
    assert back.tracks.size == SIZE
    if name in ("ours", "tapvid", "cotracker", "hdf5"):
        assert back.seconds is not None
        assert np.allclose(back.seconds, sheet.seconds)


@settings(max_examples=20, deadline=None, suppress_health_check=[HealthCheck.function_scoped_fixture])
@given(sheet=sheets())
def test_deeplabcut_brings_back_what_is_seen(tmp_path: Path, sheet: TrackSheet) -> None:
    deeplabcut.write(sheet, tmp_path / "t.csv")
    back = deeplabcut.read(tmp_path / "t.csv", SIZE, sheet.tracks.state.shape[1])
    seen = sheet.tracks.visible
    assert np.array_equal(back.tracks.visible, seen)
    assert np.abs(back.tracks.xy[seen] - sheet.tracks.xy[seen]).max() <= 1e-4
    assert np.array_equal(back.numbers, sheet.numbers)
    assert {back.name_of(i) for i in back.tracks.object.tolist()} == set(sheet.object_names.values())


def test_points_keep_their_names_in_programs_that_know_names(tmp_path: Path) -> None:
    tracks = PointTracks(np.full((4, 2, 2), 5.0, np.float32), np.ones((4, 2), np.uint8), np.array([1, 1, 2, 2]), (9, 9))
    names = ("nose", "tail", "nose", "tail")
    sheet = TrackSheet(tracks, np.array([1, 2, 1, 2]), {1: "dog", 2: "cat"}, (), names)
    for module, file in ((sleap, "s.h5"), (coco, "c.json"), (cvat, "c.xml")):
        module.write(sheet, tmp_path / file)
        assert module.read(tmp_path / file).point_names == names
    deeplabcut.write(sheet, tmp_path / "d.csv")
    assert deeplabcut.read(tmp_path / "d.csv", (9, 9)).point_names == names
    with h5py.File(tmp_path / "s.h5") as file:
        assert file["node_names"][:].tolist() == [b"nose", b"tail"]
    assert json.loads((tmp_path / "c.json").read_text())["categories"][0]["keypoints"] == ["nose", "tail"]


def test_what_another_program_changed_in_tapvid_and_cotracker_counts(tmp_path: Path) -> None:
    state = np.array([[VISIBLE, OCCLUDED, OUT_OF_VIEW]], np.uint8)
    tracks = PointTracks(np.full((1, 3, 2), 20.0, np.float32), state, np.array([1]), (80, 40))
    tapvid.write(TrackSheet.of_tracks(tracks), tmp_path / "t.npz")
    with np.load(tmp_path / "t.npz") as held:
        arrays = dict(held)
    arrays["points"][0, 1] = (0.5, 0.5)
    arrays["occluded"][0, 2] = False
    np.savez(tmp_path / "t.npz", **arrays)
    back = tapvid.read(tmp_path / "t.npz").tracks
    assert back.xy[0].tolist() == [[20, 20], [40, 20], [20, 20]]
    assert back.state[0].tolist() == [VISIBLE, OCCLUDED, VISIBLE]
    cotracker_npz.write(TrackSheet.of_tracks(tracks), tmp_path / "c.npz")
    with np.load(tmp_path / "c.npz") as held:
        arrays = dict(held)
    arrays["visibility"][1, 0] = True
    np.savez(tmp_path / "c.npz", **arrays)
    assert cotracker_npz.read(tmp_path / "c.npz").tracks.state[0].tolist() == [VISIBLE, VISIBLE, OUT_OF_VIEW]


def test_a_visible_point_beside_the_picture_is_counted_before_tapvid_clips_it() -> None:
    xy = np.array([[[85.5, 20.0], [80.0, 40.0], [90.0, 1.0]]], np.float32)
    tracks = PointTracks(xy, np.array([[VISIBLE, VISIBLE, OCCLUDED]], np.uint8), np.array([1]), (80, 40))
    assert tapvid.clipped_count(tracks) == 1


def test_probabilities_of_cotracker_have_its_own_thresholds(tmp_path: Path) -> None:
    plain = {"tracks": np.full((3, 1, 2), 4.0, np.float32), "size": np.array([9, 9])}
    seen = np.array([[0.4], [0.95], [0.8]], np.float32)
    np.savez(tmp_path / "a.npz", visibility=seen, **plain)
    assert cotracker_npz.read(tmp_path / "a.npz").tracks.visible[0].tolist() == [False, True, False]
    np.savez(tmp_path / "b.npz", visibility=seen, confidence=np.array([[1.0], [0.5], [0.9]]), **plain)
    assert cotracker_npz.read(tmp_path / "b.npz").tracks.visible[0].tolist() == [False, False, True]


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
    tapvid.write(sheet, tmp_path / "t.npz")
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


def test_what_other_programs_write_is_read_as_they_mean_it(tmp_path: Path) -> None:
    (tmp_path / "dlc.csv").write_text(
        "\ufeffscorer,net,net,net\nbodyparts,nose,nose,nose\ncoords,x,y,likelihood\n0,10,20,0.99\n1,11,21,0.001\n",
        encoding="utf-8",
    )
    sheet = deeplabcut.read(tmp_path / "dlc.csv", (64, 48))
    assert sheet.tracks.state.tolist() == [[VISIBLE, OCCLUDED]]
    assert sheet.tracks.flags.tolist() == [[0, UNCERTAIN]]
    assert sheet.point_names == ("nose",)
    meta = "<meta><task><size>4</size><original_size><width>64</width><height>48</height></original_size></task></meta>"
    (tmp_path / "a.xml").write_text(
        f'<annotations>{meta}<track id="0" label="fish"><points frame="0" points="1,2;3,4" outside="0" occluded="0">'
        '<attribute name="state">walking</attribute><attribute name="object">3</attribute></points></track>'
        '<track id="1" label="fish"><skeleton frame="1"><points label="nose" points="5,6" outside="0" occluded="1"/>'
        '<points label="tail" points="7,8" outside="0" occluded="0"/></skeleton></track></annotations>'
    )
    sheet = cvat.read(tmp_path / "a.xml")
    assert sheet.tracks.object.tolist() == [1, 1, 2, 2]
    assert sheet.numbers.tolist() == [1, 2, 1, 2]
    assert sheet.point_names == ("", "", "nose", "tail")
    assert sheet.tracks.xy[:, 3].tolist() == [[1, 2], [3, 4], [5, 6], [7, 8]]  # the last place is kept to the end
    assert sheet.tracks.state[:, 3].tolist() == [VISIBLE, VISIBLE, OCCLUDED, VISIBLE]
    whole = {"images": [{"id": 4, "file_name": "a", "width": 9, "height": 8}],
             "categories": [{"id": 1, "name": "cat", "keypoints": ["nose"]}],
             "annotations": [{"id": k, "image_id": 4, "category_id": 1, "keypoints": [k, 2, 2]}
                             for k in (1, 2)]}  # fmt: skip
    (tmp_path / "a.json").write_text(json.dumps(whole))
    with pytest.raises(GenmojoError, match="two annotations of 'cat' in image 4"):
        coco.read(tmp_path / "a.json")
    for k, annotation in enumerate(whole["annotations"]):
        annotation["attributes"] = {"track_id": 10 + k}
    (tmp_path / "a.json").write_text(json.dumps(whole))
    sheet = coco.read(tmp_path / "a.json")
    assert sheet.tracks.object.tolist() == [1, 2]
    assert sheet.tracks.xy[:, 0].tolist() == [[1, 2], [2, 2]]
    assert not sheet.owners_told


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
