"""PLY: what other viewers read back, one frame or a sequence, and what bad files get told."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from scenes import small_scene

from genmojo_core.cli.main import main
from genmojo_core.errors import GenmojoError
from genmojo_core.measure.views import render_frame
from genmojo_core.store import ply, ply_scene, scene_hdf5


def random_splats(count: int, degree: int, seed: int) -> ply.Splats3D:
    rng = np.random.default_rng(seed)
    quats = rng.normal(size=(count, 4))
    return ply.Splats3D(
        rng.normal(size=(count, 3)).astype(np.float32),
        (quats / np.linalg.norm(quats, axis=1, keepdims=True)).astype(np.float32),
        np.exp(rng.uniform(-7, 1, (count, 3))).astype(np.float32),
        rng.uniform(0.001, 0.999, count).astype(np.float32),
        rng.normal(size=(count, (degree + 1) ** 2, 3)).astype(np.float32),
        {"object_id": rng.integers(0, 9, count).astype(np.float32)},
    )


@given(st.integers(1, 40), st.integers(0, 3), st.integers(0, 10**6))
@settings(max_examples=25, deadline=None)
def test_what_is_written_reads_back(tmp_path_factory, count, degree, seed):
    path = tmp_path_factory.mktemp("ply") / "a.ply"
    ours = random_splats(count, degree, seed)
    ply.write(ours, path, extra=True)
    theirs = ply.read(path)
    for name in ("means", "quats", "scales", "opacities", "sh"):
        np.testing.assert_allclose(getattr(theirs, name), getattr(ours, name), rtol=2e-5, atol=1e-6)
    np.testing.assert_array_equal(theirs.extra["object_id"], ours.extra["object_id"])


def test_columns_are_those_of_the_reference(tmp_path):
    """Raw values by name and order: x y z nx ny nz f_dc f_rest opacity scale rot; f_rest channel by channel."""
    splats = random_splats(3, 3, 0)
    ply.write(splats, tmp_path / "a.ply")
    head, body = (tmp_path / "a.ply").read_bytes().split(b"end_header\n", 1)
    columns = [line.split()[2].decode() for line in head.splitlines() if line.startswith(b"property float")]
    rest = [f"f_rest_{i}" for i in range(45)]
    wanted = [*"xyz", "nx", "ny", "nz", "f_dc_0", "f_dc_1", "f_dc_2", *rest, "opacity", "scale_0", "scale_1", "scale_2",
              "rot_0", "rot_1", "rot_2", "rot_3"]  # fmt: skip
    assert columns == wanted and len(body) == 3 * 248
    row = dict(zip(columns, np.frombuffer(body, "<f4", 62), strict=True))
    assert row["f_rest_0"] == splats.sh[0, 1, 0] and row["f_rest_15"] == splats.sh[0, 1, 1]
    assert row["scale_1"] == pytest.approx(np.log(splats.scales[0, 1]), abs=1e-5)
    assert 1 / (1 + np.exp(-row["opacity"])) == pytest.approx(splats.opacities[0], abs=1e-5)


def test_foreign_columns_types_and_discs_are_taken(tmp_path):
    """No normals, doubles, integer columns of another program (as GenMOJO's dino_f_*), no scale_2 (2DGS)."""
    names = [*"xyz", "f_dc_0", "f_dc_1", "f_dc_2", "opacity", "scale_0", "scale_1", "rot_0", "rot_1", "rot_2", "rot_3"]
    record = np.dtype([(n, "<f8") for n in names] + [("dino_f_0", "<f4"), ("label", "u1")])
    table = np.zeros(2, record)
    table["x"], table["rot_0"], table["scale_0"], table["label"] = [1, 2], 3.0, np.log(0.5), [7, 8]
    lines = ["ply", "format binary_little_endian 1.0", "comment made elsewhere", "element vertex 2"]
    lines += [f"property double {n}" for n in names] + ["property float dino_f_0", "property uchar label", "end_header"]
    (tmp_path / "b.ply").write_bytes(("\n".join(lines) + "\n").encode() + table.tobytes())
    splats = ply.read(tmp_path / "b.ply")
    np.testing.assert_allclose(splats.means[:, 0], [1, 2])
    np.testing.assert_allclose(splats.quats[0], [1, 0, 0, 0])
    assert splats.scales[0, 0] == pytest.approx(0.5) and splats.scales[0, 2] < 1e-5
    assert splats.opacities[0] == pytest.approx(0.5) and list(splats.extra["label"]) == [7, 8]
    assert "dino_f_0" in splats.extra and splats.comments == ("made elsewhere",)


def test_bad_files_get_one_sentence(tmp_path):
    good = tmp_path / "good.ply"
    ply.write(random_splats(5, 0, 1), good)
    data = good.read_bytes()
    body = data.index(b"end_header\n") + len(b"end_header\n")
    not_finite = data[:body] + np.float32(np.nan).tobytes() + data[body + 4 :]
    cases = {
        "format": [b"solid x", data.replace(b"binary_little_endian", b"ascii"), data.replace(b"float x", b"list x")],
        "corrupt": [data[:-1]], "schema": [data.replace(b"rot_3", b"rot_9")], "value": [not_finite],
        "size": [data.replace(b"vertex 5", b"vertex 999999999999")], "io": [None],
    }  # fmt: skip
    for code, files in cases.items():
        for i, content in enumerate(files):
            path = tmp_path / f"{code}{i}.ply"
            if content is not None:
                path.write_bytes(content)
            with pytest.raises(GenmojoError) as caught:
                ply.read(path)
            assert caught.value.code == code, (code, i, caught.value)


def test_exported_frames_look_as_the_scene_does(tmp_path):
    """The command writes a sequence; imported again, every frame renders as before (> 60 dB), owners included."""
    scene = small_scene(frames=3)
    scene_hdf5.write(scene, tmp_path / "scene.h5")
    assert (
        main(["export", str(tmp_path / "scene.h5"), "--to", "ply-sequence", "-o", str(tmp_path / "s"), "--extra"]) == 0
    )
    assert main(["import", str(tmp_path / "s"), "-o", str(tmp_path / "back.h5")]) == 0
    back = scene_hdf5.read(tmp_path / "back.h5")
    assert {(o.id, o.count) for o in back.objects} == {(o.id, o.count) for o in scene.objects}
    for t in range(3):
        before = render_frame(scene, t, scene.cameras.view(t)).on()
        after = render_frame(back, t, scene.cameras.view(t)).on()
        assert -10 * np.log10(np.mean((before - after) ** 2) + 1e-12) > 60


def test_objects_and_frames_can_be_chosen(tmp_path):
    scene_hdf5.write(small_scene(frames=3), tmp_path / "scene.h5")
    out = tmp_path / "one.ply"
    command = ["export", str(tmp_path / "scene.h5"), "--to", "ply", "-o", str(out)]
    assert main([*command, "--frames", "2", "--objects", "2"]) == 0
    assert len(ply.read(out)) == next(o.count for o in small_scene().objects if o.id == 2)
    for wrong in (["--frames", "9:"], ["--objects", "77"], ["--objects", "red"]):
        assert main([*command, *wrong]) == 2
    assert ply_scene.read_scene(out).objects[0].id == 1  # without the extra column: one object
