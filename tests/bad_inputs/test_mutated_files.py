"""Files that were good until some of their bytes changed: commands read them or refuse them in one sentence.

hypothesis chooses which file, where, and how: bytes replaced, taken out, put in, doubled, or the rest cut off. A
traceback would be raised here: `main` catches nothing but our own errors. Not covered: files that stay readable but
say something else.
"""

from __future__ import annotations

import json
import os
import shutil
from collections.abc import Callable
from functools import cache
from pathlib import Path
from tempfile import mkdtemp

import av
import numpy as np
import pytest
from clip_files import make_clip, picture
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st
from scenes import small_scene

from genmojo_core.cli.main import main
from genmojo_core.store import npz, ply, scene_hdf5
from genmojo_core.tracks.model import PointTracks

T, H, W = 3, 24, 32
EXAMPLES = int(os.environ.get("MUTATIONS", "8"))  # per case; more for a longer hunt

Change = tuple[str, float, bytes]
changes = st.lists(
    st.tuples(st.sampled_from(["replace", "insert", "remove", "double", "cut"]), st.floats(0, 1, exclude_max=True),
              st.binary(min_size=1, max_size=8)),
    min_size=1, max_size=4,
)  # fmt: skip


def mutated(data: bytes, how: list[Change]) -> bytes:
    """The bytes after some changes; places are shares of the length."""
    for kind, share, new in how:
        at = int(share * len(data))
        end = at + len(new)
        if kind == "replace":
            data = data[:at] + new + data[end:]
        elif kind == "insert":
            data = data[:at] + new + data[at:]
        elif kind == "remove":
            data = data[:at] + data[end:]
        elif kind == "double":
            data = data[:end] + data[at:]
        else:
            data = data[:at]
    return data


def folder() -> Path:
    """A clip with everything beside it: masks, depth, cameras, flow, tracks, meta.json."""
    root = make_clip(Path(mkdtemp()) / "clip", frames=T)
    lens = np.array([[30.0, 0, 16], [0, 30, 12], [0, 0, 1]])
    np.savez_compressed(root / "depth.npz", depth=np.full((T, H, W), 4.0, np.float32))
    np.savez(root / "cameras.npz", K=lens, world_to_camera=np.repeat(np.eye(4)[None], T, axis=0))
    np.savez(root / "flow.npz", flow=np.zeros((T, H, W, 2), np.float32), valid=np.ones((T, H, W), bool))
    npz.write_tracks(tracks(), root / "tracks.npz")
    (root / "meta.json").write_text(json.dumps({"fps": 24, "pixel_aspect": 1.0, "names": {"1": "cup"}}))
    return root


def tracks() -> PointTracks:
    return PointTracks(np.full((2, T, 2), 8.0, np.float32), np.ones((2, T), np.uint8), np.array([1, 2]), (W, H))


def video(path: Path) -> None:
    with av.open(str(path), "w") as container:
        stream = container.add_stream("mpeg4", rate=24)
        stream.width, stream.height, stream.pix_fmt = W, H, "yuv420p"
        for t in range(T):
            container.mux(stream.encode(av.VideoFrame.from_ndarray(picture(seed=t), format="rgb24")))
        container.mux(stream.encode())


@cache
def originals() -> Path:
    """A clip folder and single files, made once."""
    root = folder()
    scene_hdf5.write(small_scene(frames=2, per_object=4), root / "scene.h5")
    ply.write(ply.of_frame(small_scene(frames=2, per_object=4), 0), root / "splat.ply")
    video(root / "clip.mp4")
    return root


# What is changed, relative to the clip's folder; the command, of which {clip}, {file}, {out} are filled in.
CASES = {
    "masks": ("Annotations/clip/00001.png", ["inspect", "{clip}"]),
    "frames": ("JPEGImages/clip/00001.png", ["inspect", "{clip}"]),
    "depth": ("depth.npz", ["inspect", "{clip}"]),
    "cameras": ("cameras.npz", ["inspect", "{clip}"]),
    "flow": ("flow.npz", ["inspect", "{clip}"]),
    "tracks of a clip": ("tracks.npz", ["inspect", "{clip}"]),
    "meta": ("meta.json", ["inspect", "{clip}"]),
    "tracks": ("tracks.npz", ["inspect", "{file}"]),
    "tracks scored": ("tracks.npz", ["metrics", "{file}", "{good}"]),
    "scene": ("scene.h5", ["inspect", "{file}"]),
    "scene checked": ("scene.h5", ["validate", "{file}"]),
    "splats": ("splat.ply", ["import", "{file}", "-o", "{out}/back.h5"]),
    "video": ("clip.mp4", ["inspect", "{file}"]),
}


@pytest.fixture
def run_on(tmp_path, capsys) -> Callable[[str, list[Change]], tuple[int, str]]:
    """Runs a case on changed bytes; its exit code and what it said."""

    def run(name: str, how: list[Change]) -> tuple[int, str]:
        file, command = CASES[name]
        clip = tmp_path / "clip"
        shutil.rmtree(clip, ignore_errors=True)
        shutil.copytree(originals(), clip)
        (clip / file).write_bytes(mutated((clip / file).read_bytes(), how))
        places = {"clip": str(clip), "file": str(clip / file), "good": str(originals() / file), "out": str(tmp_path)}
        capsys.readouterr()
        code = main([part.format(**places) for part in command])
        return code, capsys.readouterr().err

    return run


@pytest.mark.parametrize("name", CASES)
def test_unchanged_files_are_read(name: str, run_on) -> None:
    assert run_on(name, [("replace", 0.0, b"")])[0] == 0


@pytest.mark.parametrize("name", CASES)
@settings(max_examples=EXAMPLES, deadline=None, derandomize=True,
          suppress_health_check=[HealthCheck.function_scoped_fixture, HealthCheck.too_slow])  # fmt: skip
@given(how=changes)
def test_changed_bytes_are_read_or_refused_in_one_sentence(name: str, run_on, how: list[Change]) -> None:
    code, said = run_on(name, how)
    assert code in (0, 2), said
    if code == 2 and "checked" not in name:  # validate tells its faults on stdout
        (sentence,) = [line.split("\r")[-1].strip() for line in said.strip().split("\n")]  # after a bar of progress
        assert len(sentence) < 600 and "Traceback" not in sentence
