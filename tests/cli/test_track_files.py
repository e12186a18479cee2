"""`genmojo seed`, and tracks in `export`, `import`, `inspect` and `validate`, as a user types them."""

from __future__ import annotations

import json
from dataclasses import replace
from pathlib import Path

import cv2
import numpy as np
import pytest

from genmojo_core.cli.main import main
from genmojo_core.clip import png
from genmojo_core.clip.synthetic import generate
from genmojo_core.clip.synthetic_specs import spec
from genmojo_core.store.npz import read_tracks, write_tracks
from genmojo_core.store.project import Project, info_of
from genmojo_core.tracks import edit_tracks, keys
from genmojo_core.tracks.annotation import ObjectInfo
from genmojo_core.tracks.model import OCCLUDED, VISIBLE, PointTracks


def said(capsys: pytest.CaptureFixture[str], *arguments: str) -> dict:
    assert main([*arguments, "--json"]) == 0
    return json.loads(capsys.readouterr().out)


@pytest.fixture()
def folder(tmp_path: Path) -> Path:
    """A small clip with masks, queries and true tracks as files."""
    clip, truth = generate(replace(spec("crossing-shapes"), frames=4, size=(96, 54), novel_every=0))
    for name in ("JPEGImages", "Annotations"):
        (tmp_path / "clip" / name / "clip").mkdir(parents=True)
    for t in range(4):
        picture = tmp_path / "clip" / "JPEGImages" / "clip" / f"{t:05d}.png"
        cv2.imwrite(str(picture), clip.frames[t][..., ::-1])
        mask = tmp_path / "clip" / "Annotations" / "clip" / f"{t:05d}.png"
        mask.write_bytes(png.encode_palette(clip.masks.value[t], png.davis_palette()))
    rows = np.flatnonzero(truth.visible[:, 0])[::9]
    np.savez(tmp_path / "points.npz", t=np.zeros(len(rows), int), xy=truth.tracks[rows, 0])
    state = np.where(truth.visible[rows], VISIBLE, OCCLUDED).astype(np.uint8)
    tracks = PointTracks(truth.tracks[rows].astype(np.float32), state, truth.track_object[rows], (96, 54))
    write_tracks(tracks, tmp_path / "truth.npz")
    return tmp_path


def test_seeding_tells_whose_each_point_is_and_follows_it(folder: Path, capsys: pytest.CaptureFixture[str]) -> None:
    truth = read_tracks(folder / "truth.npz")
    for tracker in ("optical", f"file:{folder / 'truth.npz'}"):
        asked = ["--points", str(folder / "points.npz"), "--tracker", tracker, "-o", str(folder / "t.npz")]
        result = said(capsys, "seed", str(folder / "clip"), *asked)
        assert result["tracks"] == len(truth.xy)
        tracks = read_tracks(folder / "t.npz")
        assert tracks.object.tolist() == truth.object.tolist()
        assert np.median(np.linalg.norm(tracks.xy - truth.xy, axis=-1)[truth.visible]) < 1.0
    assert main(["seed", str(folder / "clip"), "--points", str(folder / "points.npz"), "--tracker", "magic", "-o",
                 str(folder / "t.npz")]) == 2  # fmt: skip


@pytest.mark.parametrize(
    ("change", "words"),
    [({"object": [1]}, "object is (1,)"), ({"object": [1.5, 2.0]}, "float64"), ({"t": [0, 4]}, "frame 4"),
     ({"t": [0, 9], "object": [1, 1]}, "frame 9"), ({"xy": [[5.0, 5.0], [-5.0, 20.0]]}, "outside the 96 x 54")],
)  # fmt: skip
def test_points_that_cannot_be_seeded_are_said_and_nothing_is_written(
    folder: Path, capsys: pytest.CaptureFixture[str], change: dict, words: str
) -> None:
    np.savez(folder / "p.npz", **({"t": [0, 1], "xy": [[5.0, 5.0], [9.0, 9.0]]} | change))
    asked = ["--points", str(folder / "p.npz"), "-o", str(folder / "bad.npz")]
    assert main(["seed", str(folder / "clip"), *asked]) == 2
    assert words in capsys.readouterr().err
    assert not (folder / "bad.npz").exists()


@pytest.mark.parametrize("name", ["tapvid", "cotracker", "sleap", "deeplabcut", "cvat", "coco", "tracks-hdf5"])
def test_what_is_exported_is_imported(folder: Path, capsys: pytest.CaptureFixture[str], name: str) -> None:
    file, back = str(folder / "x"), str(folder / "back.npz")
    said(capsys, "export", str(folder / "truth.npz"), "--to", name, "-o", file)
    said(capsys, "import", file, "--from", name, "-o", back, "--size", "96x54", "--length", "4")
    before, after = read_tracks(folder / "truth.npz"), read_tracks(back)
    order = np.lexsort((after.xy[:, 0, 0], after.object)) if name == "sleap" else np.arange(len(after.xy))
    same = np.lexsort((before.xy[:, 0, 0], before.object)) if name == "sleap" else order
    seen = before.visible[same]
    assert np.abs(before.xy[same] - after.xy[order])[seen].max() <= 1e-4


def test_projects_are_described_checked_and_exported(folder: Path, capsys: pytest.CaptureFixture[str]) -> None:
    file = folder / "p.genmojo"
    project = Project.create(file, info_of(4, (96, 54), "clip"), person="Ada")
    project.do(edit_tracks.put_objects(project.annotation, [ObjectInfo(1, "dog", 1, "chosen")]))
    project.do(edit_tracks.add_track(project.annotation, 1, 1, "Ada"))
    project.do(keys.set_key(project.annotation, 1, 0, (5.0, 6.0)))
    project.close()
    about = said(capsys, "inspect", str(file))
    assert (about["kind"], about["tracks"], about["keys"], about["time"]) == ("project", 1, 1, [])
    assert said(capsys, "validate", str(file))["valid"]
    said(capsys, "export", str(file), "--to", "tracks", "-o", str(folder / "clip" / "tracks.npz"))
    assert said(capsys, "inspect", str(folder / "clip"))["channels"] == ["masks", "tracks"]
    assert main(["export", str(file), "--to", "tracks", "--review", "approved", "-o", str(folder / "a.npz")]) == 2
    assert "--review all" in capsys.readouterr().err
