"""Films: turntables, camera paths with their own scene time, modes, files that are whole or not there."""

from __future__ import annotations

import av
import cv2
import h5py
import numpy as np
import pytest
from scenes import small_scene

from genmojo_core.cli.main import main
from genmojo_core.clip.camera_path import CameraPath, key_of
from genmojo_core.errors import GenmojoError
from genmojo_core.measure import film
from genmojo_core.measure.views import Look, orbit_target, orbit_view, render_frame
from genmojo_core.store import camera_paths, scene_hdf5


def test_turntable_is_the_orbit_of_render():
    scene = small_scene(frames=5)
    shots = film.turntable(scene, 1, degrees=360, seconds=2, elevation=10, fps=4, time_mode="freeze")
    assert len(shots) == 8 and {s.time for s in shots} == {1.0}
    wanted = orbit_view(scene, 1, 10, 90, orbit_target(scene))
    np.testing.assert_allclose(shots[2].view.world_to_camera, wanted.world_to_camera)
    assert [s.time for s in film.turntable(scene, 0, seconds=1, fps=5, time_mode="play")] == [0, 1, 2, 3, 4]
    loop = film.turntable(scene, 0, seconds=2, fps=scene.fps, time_mode="loop")
    assert [s.time for s in loop[:7]] == [0, 1, 2, 3, 4, 0, 1]
    for wrong in ({"seconds": 0}, {"time_mode": "back"}, {"seconds": 1e9}):
        with pytest.raises(GenmojoError):
            film.turntable(scene, 0, **wrong)


def test_time_between_frames_lies_between_them():
    scene = small_scene(frames=3, shift=0.2, turn=20)
    half, one, two = scene.frame_at(0.5), scene.frame(0), scene.frame(1)
    np.testing.assert_allclose(half.means, (one.means + two.means) / 2, atol=1e-6)
    np.testing.assert_allclose(np.linalg.norm(half.quats, axis=1), 1, atol=1e-6)
    np.testing.assert_array_equal(scene.frame_at(2.0).means, scene.frame(2).means)
    with pytest.raises(GenmojoError):
        render_frame(scene, 2.5, scene.cameras.view(0))


def test_modes_show_what_they_say():
    scene = small_scene()
    shot = film.Shot(scene.cameras.view(0), 0.0)
    images = {mode: next(film.pictures(scene, [shot], mode)) for mode in film.MODES}
    assert all(image.shape == (48, 64, 3) and image.dtype == np.uint8 for image in images.values())
    drawn = render_frame(scene, 0, shot.view, Look(normals=True))
    np.testing.assert_allclose(images["opacity"][..., 0], np.round(drawn.alpha * 255), atol=1)
    middle = drawn.normal[drawn.alpha > 0.9]
    assert (middle[:, 2] > 0.9).mean() > 0.9  # flat discs before a wall look at the camera
    clear = next(film.pictures(scene, [shot], "rgb", objects_only=True, transparent=True))
    assert clear.shape == (48, 64, 4) and clear[0, 0, 3] == 0


def test_a_path_in_the_scene_file_becomes_a_video(tmp_path):
    """The path round-trips beside everything else, and its film shows the scene times of its keys."""
    scene = small_scene(frames=4)
    file = tmp_path / "scene.h5"
    scene_hdf5.write(scene, file)
    keys = (key_of(scene.cameras.view(0), 0.0, 0.0), key_of(scene.cameras.view(0), 3.0, 1.0, hold=0.5))
    paths = [CameraPath("über all", keys), CameraPath("b", keys[:1], True)]
    camera_paths.write_paths(file, paths)
    assert scene_hdf5.validate(file) == []
    back = {p.name: p for p in camera_paths.read_paths(file)}
    assert {n: p.to_json() for n, p in back.items()} == {p.name: p.to_json() for p in paths}
    shots = film.along(scene, back["über all"], fps=4)
    assert [s.time for s in shots] == [0, 0.75, 1.5, 2.25, 3, 3, 3]
    out = tmp_path / "film.mp4"
    assert main(["render", str(file), "--path", "über all", "--fps", "4", "-o", str(out)]) == 0
    with av.open(str(out)) as container:
        frames = [f.to_ndarray(format="rgb24") for f in container.decode(video=0)]
    assert len(frames) == 7
    wanted = film.sheet.to_bytes(render_frame(scene, 3, scene.cameras.view(0)).on())
    assert np.abs(frames[-1].astype(int) - wanted).mean() < 6
    assert main(["render", str(file), "--path", "nowhere", "-o", str(out)]) == 2
    camera_paths.write_json(paths[0], tmp_path / "p.json")
    shown = ["render", str(file), "--path", str(tmp_path / "p.json"), "--fps", "2", "--foreground", "--size", "24"]
    assert main([*shown, "-o", str(tmp_path / "png")]) == 0
    image = cv2.imread(str(tmp_path / "png" / "00000.png"), cv2.IMREAD_UNCHANGED)
    assert image.shape == (24, 32, 4) and image[0, 0, 3] == 0
    for name in ("a/b", "", ".."):
        with pytest.raises(GenmojoError):
            camera_paths.write_paths(file, [CameraPath(name, keys)])
    assert len(camera_paths.read_paths(file)) == 2
    camera_paths.write_paths(file, [])
    assert camera_paths.read_paths(file) == []


def test_a_damaged_path_is_one_sentence(tmp_path):
    scene = small_scene()
    file = tmp_path / "scene.h5"
    scene_hdf5.write(scene, file)
    camera_paths.write_paths(file, [CameraPath("p", (key_of(scene.cameras.view(0), 0.0, 0.0),))])
    with h5py.File(file, "r+") as opened:
        del opened["cameras/paths/p/fov"]
        opened["cameras/paths/p/fov"] = np.zeros((2, 2))
    with pytest.raises(GenmojoError):
        camera_paths.read_paths(file)


@pytest.mark.parametrize("name", ["film.mp4", "pictures"])
def test_a_cancelled_film_leaves_nothing(tmp_path, name):
    scene = small_scene()
    shots = film.turntable(scene, 0, seconds=1, fps=8)

    def tell(share: float) -> None:
        if share > 0.4:
            raise KeyboardInterrupt

    with pytest.raises(KeyboardInterrupt):
        film.write_film(film.pictures(scene, shots), str(tmp_path / name), 8, range(8), tell)
    assert [p for p in tmp_path.rglob("*") if p.is_file()] == []


def test_turntable_from_the_command_line(tmp_path):
    scene_hdf5.write(small_scene(), tmp_path / "s.h5")
    command = ["render", str(tmp_path / "s.h5"), "--turntable", "360", "--seconds", "0.5", "--fps", "8"]
    assert main([*command, "--time", "play", "--mode", "normal", "-o", str(tmp_path / "t")]) == 0
    assert len(list((tmp_path / "t").glob("*.png"))) == 4
    assert main([*command, "--path", "x", "-o", str(tmp_path / "u")]) == 2
