"""The command line as a user meets it: results as JSON, one sentence per fault, exit codes, nothing half-written."""

from __future__ import annotations

import json
import os
import signal

import cv2
import numpy as np
import pytest
from scenes import small_scene

from genmojo_core.cli.main import main
from genmojo_core.effects.machine import Machine
from genmojo_core.measure.views import Look, render_frame
from genmojo_core.store import npz, scene_hdf5
from genmojo_core.tracks.model import PointTracks


@pytest.fixture(scope="module")
def scene_path(tmp_path_factory):
    path = tmp_path_factory.mktemp("scene") / "scene.h5"
    scene_hdf5.write(small_scene(per_object=300), path)
    return str(path)


@pytest.fixture(scope="module")
def clip_path(tmp_path_factory):
    """The clip that the small scene shows exactly, as frames and palette masks (frame numbers 3, 5, 7, 9)."""
    from genmojo_core.clip import png

    scene, folder = small_scene(per_object=300), tmp_path_factory.mktemp("clip") / "discs"
    for part in ("JPEGImages", "Annotations"):
        (folder / part / "discs").mkdir(parents=True)
    for t, number in enumerate(scene.frame_index):
        picture = render_frame(scene, t, scene.cameras.view(t), Look())
        frame = np.round(picture.on() * 255).astype(np.uint8)
        cv2.imwrite(str(folder / "JPEGImages" / "discs" / f"{number:05d}.png"), frame[..., ::-1])
        index = np.maximum(picture.instance(), 0).astype(np.uint8)
        data = png.encode_palette(index, png.davis_palette())
        (folder / "Annotations" / "discs" / f"{number:05d}.png").write_bytes(data)
    return str(folder)


def run(capsys, *argv: str) -> tuple[int, dict, str]:
    """Exit code, JSON of stdout, stderr without progress."""
    code = main([*argv, "--json"])
    captured = capsys.readouterr()
    return code, json.loads(captured.out) if captured.out else {}, captured.err


def refused(capsys, *argv: str) -> str:
    """The one sentence of a command that exits 2 and prints nothing else."""
    code = main(list(argv))
    captured = capsys.readouterr()
    assert code == 2 and captured.out == ""
    lines = [line for line in captured.err.replace("\r", "\n").split("\n") if line.strip() and "% |" not in line]
    assert len(lines) == 1 and lines[0].endswith("."), lines
    return lines[0]


# ---- scenes out ---------------------------------------------------------------------------------------------------


def test_render_pictures_by_frame_number(capsys, scene_path, tmp_path):
    code, found, _ = run(capsys, "render", scene_path, "-o", str(tmp_path / "r"), "--azimuth", "30", "--frames", "1:3")
    assert code == 0 and sorted(os.listdir(tmp_path / "r")) == ["00005.png", "00007.png"]
    assert cv2.imread(str(tmp_path / "r" / "00005.png")).shape == (48, 64, 3) and found["frames"] == 2


@pytest.mark.parametrize("mode", ["rgb", "depth", "instance", "flow"])
def test_render_modes(capsys, scene_path, tmp_path, mode):
    code, _, _ = run(capsys, "render", scene_path, "-o", str(tmp_path), "--mode", mode, "--size", "96")
    image = cv2.imread(str(tmp_path / "00003.png"), cv2.IMREAD_UNCHANGED)
    assert code == 0 and image.shape == (96, 128, 3) and image.std() > 5


def test_render_foreground_is_straight_rgba(capsys, scene_path, tmp_path):
    run(capsys, "render", scene_path, "-o", str(tmp_path), "--foreground")
    image = cv2.imread(str(tmp_path / "00003.png"), cv2.IMREAD_UNCHANGED)
    assert image.shape == (48, 64, 4) and image[0, 0, 3] == 0 and image[..., 3].max() > 240
    soft = (image[..., 3] > 60) & (image[..., 3] < 200) & (np.arange(64) < 30)
    assert soft.any() and image[soft][:, 2].min() > 200  # red stays red at the rim: colour is not premultiplied


def test_render_given_cameras(capsys, scene_path, tmp_path):
    """Cameras of the whole clip (12 frames) for a scene of some: picked by frame number."""
    scene = small_scene()
    poses = np.tile(np.eye(4), (12, 1, 1))
    poses[5, 0, 3] = 0.4
    np.savez(tmp_path / "c.npz", K=scene.cameras.K[0], world_to_camera=poses)
    run(capsys, "render", scene_path, "-o", str(tmp_path / "a"), "--cameras", str(tmp_path / "c.npz"))
    run(capsys, "render", scene_path, "-o", str(tmp_path / "b"))
    same = [np.array_equal(*(cv2.imread(str(tmp_path / d / f"0000{n}.png")) for d in "ab")) for n in (3, 5, 7, 9)]
    assert same == [True, False, True, True]


def test_render_video(capsys, scene_path, tmp_path):
    import av

    code, _, _ = run(capsys, "render", scene_path, "-o", str(tmp_path / "v.mp4"), "--size", "49")
    with av.open(str(tmp_path / "v.mp4")) as video:
        assert code == 0 and sum(1 for _ in video.decode(video=0)) == 4
    assert os.listdir(tmp_path) == ["v.mp4"]


def test_tracks_and_metrics(capsys, scene_path, tmp_path):
    """Queries in, tracks npz out, scored against themselves."""
    np.savez(tmp_path / "q.npz", t=[0, 1], xy=[[20.5, 24.0], [1.0, 1.0]])
    code, found, _ = run(
        capsys, "tracks", scene_path, "--queries", str(tmp_path / "q.npz"), "-o", str(tmp_path / "t.npz")
    )
    assert code == 0 and found["tracks"] == 2
    tracks = npz.read_tracks(tmp_path / "t.npz")
    assert tracks.xyz.shape == (2, 4, 3) and tracks.object.tolist() == [1, 0] and tracks.size == (64, 48)
    code, found, _ = run(capsys, "metrics", str(tmp_path / "t.npz"), str(tmp_path / "t.npz"))
    assert code == 0 and found["ate"] == 0 and found["oa"] == 100
    assert {"ate", "mte", "a_epe", "m_epe", "aj", "delta", "oa", "ate_3d"} <= set(found)


def test_metrics_takes_the_visible_half_of_a_truth(capsys, tmp_path):
    """A Blender truth.npz as TRUTH, predictions only for what is visible in frame 0."""
    xy = np.arange(24, dtype=np.float32).reshape(3, 4, 2)
    visible = np.array([[1, 1, 1, 1], [0, 1, 1, 1], [1, 1, 0, 1]], bool)
    np.savez(tmp_path / "truth.npz", tracks=xy, visible=visible, track_object=[1, 1, 2])
    state = np.where(visible, 1, 2).astype(np.uint8)[[0, 2]]
    npz.write_tracks(PointTracks(xy[[0, 2]], state, np.array([1, 2]), (64, 48)), tmp_path / "p.npz")
    code, found, _ = run(capsys, "metrics", str(tmp_path / "p.npz"), str(tmp_path / "truth.npz"))
    assert code == 0 and found["tracks"] == 2 and found["ate"] == 0 and found["oa"] == 100


def test_evaluate_the_scenes_own_clip(capsys, scene_path, clip_path, tmp_path):
    """A clip made of the scene's own pictures: hardly any error, every instance found, a sheet to look at."""
    sheet = tmp_path / "sheet.png"
    code, found, _ = run(capsys, "evaluate", scene_path, clip_path, "--sheet", str(sheet))
    assert code == 0 and found["psnr"] > 45 and found["psnr_full"] > 45 and found["ssim"] > 0.99
    assert found["instance_iou"] > 0.99 and found["color_share_db"] == 0
    assert cv2.imread(str(sheet)).shape == (20 + 4 * 52, 6 * 68, 3)


def test_inspect_and_validate(capsys, scene_path, clip_path, tmp_path):
    assert run(capsys, "inspect", scene_path)[1]["kind"] == "scene"
    assert run(capsys, "inspect", clip_path)[1]["frames"] == 4
    assert run(capsys, "validate", scene_path)[1] == {"file": scene_path, "valid": True, "faults": []}
    broken = tmp_path / "b.h5"
    with open(scene_path, "rb") as stream:
        broken.write_bytes(stream.read()[:5000])
    code, found, _ = run(capsys, "validate", str(broken))
    assert code == 2 and not found["valid"] and len(found["faults"]) == 1


# ---- faults -------------------------------------------------------------------------------------------------------


def test_bad_scenes_and_files(capsys, scene_path, clip_path, tmp_path):
    (tmp_path / "empty.h5").write_bytes(b"")
    (tmp_path / "q.npz").write_bytes(b"PK")
    (tmp_path / "file").write_bytes(b"x")
    out = str(tmp_path / "out")
    for argv in (
        ("render", str(tmp_path / "none.h5"), "-o", out),
        ("render", str(tmp_path / "empty.h5"), "-o", out),
        ("render", str(tmp_path), "-o", out),
        ("render", scene_path, "-o", str(tmp_path / "file")),
        ("render", scene_path, "-o", out, "--frames", "9:12"),
        ("render", scene_path, "-o", out, "--frames", "3:1"),
        ("render", scene_path, "-o", out, "--size", "0"),
        ("render", scene_path, "-o", out, "--cameras", str(tmp_path / "q.npz")),
        ("render", scene_path, "-o", out, "--mode", "x-ray"),
        ("tracks", scene_path, "--queries", str(tmp_path / "q.npz"), "-o", out),
        ("tracks", scene_path, "--queries", str(tmp_path / "none.npz"), "-o", out),
        ("tracks", scene_path, "--queries", scene_path, "-o", "/proc/none/t.npz"),
        ("metrics", scene_path, scene_path),
        ("evaluate", scene_path, str(tmp_path / "none")),
        ("inspect", str(tmp_path / "none")),
        ("optimise", "x"),
        (),
    ):
        refused(capsys, *argv)
    assert sorted(os.listdir(tmp_path)) == ["empty.h5", "file", "q.npz"]


def test_evaluate_refuses_another_clip(capsys, scene_path, tmp_path):
    (tmp_path / "c").mkdir()
    for number in (3, 5, 7):
        cv2.imwrite(str(tmp_path / "c" / f"{number:05d}.png"), np.zeros((48, 64, 3), np.uint8))
    assert "no frame 9" in refused(capsys, "evaluate", scene_path, str(tmp_path / "c"))


@pytest.mark.parametrize(
    "options",
    [
        ("--preset", "best"),
        ("--budget", "soon"),
        ("--budget", "-3"),
        ("--size", "3"),
        ("--ignore", "masks"),
        ("--frames", "a:b"),
        ("--frames", "9:9"),
        ("--frames", "40:50"),
        ("--box", "0:1,1,9"),
        ("--box", "0:9,9,1,1"),
        ("--effects", "+magic"),
        ("--pixel-aspect", "-1"),
        ("--seed", "x"),
        ("-o", "/proc/none/scene.h5"),
        ("--resume",),
    ],
)
def test_bad_options_of_optimize(capsys, clip_path, tmp_path, options):
    """One sentence each, before any work, and no file."""
    output = () if "-o" in options else ("-o", str(tmp_path / "scene.h5"))
    refused(capsys, "optimize", clip_path, *output, *options)
    assert os.listdir(tmp_path) == []


@pytest.mark.parametrize("kind", ["missing", "empty", "no object", "other mask size", "file"])
def test_bad_clips(capsys, tmp_path, kind):
    """Missing, empty, no object in any frame, masks of another size, no picture."""
    clip = tmp_path / "clip"
    if kind == "file":
        clip.write_bytes(b"nothing")
    elif kind != "missing":
        for part in ("JPEGImages", "Annotations"):
            (clip / part / "a").mkdir(parents=True)
        for t in range(3 if kind != "empty" else 0):
            cv2.imwrite(str(clip / "JPEGImages" / "a" / f"{t:05d}.png"), np.full((48, 64, 3), 90, np.uint8))
            mask = np.zeros((48, 64) if kind == "no object" else (24, 32), np.uint8)
            cv2.imwrite(str(clip / "Annotations" / "a" / f"{t:05d}.png"), mask)
    refused(capsys, "optimize", str(clip), "-o", str(tmp_path / "scene.h5"), "--preset", "draft")
    assert not (tmp_path / "scene.h5").exists()


# ---- a run --------------------------------------------------------------------------------------------------------


@pytest.fixture(autouse=True)
def calibrated(monkeypatch):
    """A machine that was measured already: tests neither wait for that nor touch the user's cache."""
    monkeypatch.setattr("genmojo_core.effects.machine.load", lambda: Machine())


class FakeRun:
    """A run of ten steps that bakes the small scene; `presses` sends Ctrl-C after that many steps."""

    presses: int | None = None
    fails = False

    def __init__(self, clip, plan, config, run_dir=None, resume=False, curve_path=None) -> None:
        self.stopped, self.plan = False, plan

    def stop(self) -> None:
        self.stopped = True

    def bake(self):
        return small_scene(per_object=300)

    def __iter__(self):
        from genmojo_core.events import Failed, Finished, Preview, Step

        yield Preview(0.5, 0.5, "lift", 0, 0, 20.0)
        for i in range(1, 11):
            yield Step(float(i), float(i), "joint", i, 10, 1.0, {}, 10, None, i / 10, 0.0)
            if i == self.presses:
                os.kill(os.getpid(), signal.SIGINT)
            if self.fails:
                yield Failed(2.0, 2.0, i, "numeric", "Steps were not finite three times.")
                return
            if self.stopped:
                break
        yield Finished(10.0, 10.0, i, "interrupted" if self.stopped else "done")


@pytest.fixture
def fake(monkeypatch):
    pytest.importorskip("torch")
    monkeypatch.setattr("genmojo_core.optimise.run.Run", FakeRun)
    monkeypatch.setattr("genmojo_core.effects.pilot.pays", lambda *_: False)
    monkeypatch.setattr(FakeRun, "presses", None)
    monkeypatch.setattr(FakeRun, "fails", False)
    return FakeRun


def test_optimize_reports_what_the_contract_says(capsys, fake, clip_path, tmp_path):
    code, found, _ = run(capsys, "optimize", clip_path, "-o", str(tmp_path / "s.h5"), "--preset", "draft")
    assert code == 0 and scene_hdf5.validate(tmp_path / "s.h5") == []
    assert {"seconds", "steps", "psnr", "psnr_full", "peak_mb", "effects", "path", "curve", "guesses"} <= set(found)
    assert found["steps"] == 10 and found["psnr"] > 45 and found["first_scene_seconds"] == 0.5
    assert {"name", "on", "evidence", "unit", "threshold", "reason", "ms_per_step", "mb"} <= set(found["effects"][0])
    kept = scene_hdf5.read(tmp_path / "s.h5")
    assert kept.config["forecast"] == found["forecast"] and kept.metrics["psnr"] == pytest.approx(found["psnr"])
    assert found["forecast"]["psnr_off"] == pytest.approx(found["psnr"] - found["forecast"]["expected_psnr"])


def test_a_budget_alone_means_auto_and_a_named_preset_is_kept(capsys, clip_path):
    for options, name in ((["--budget", "20s"], "auto"), (["--budget", "20s", "--preset", "draft"], "draft")):
        code, found, err = run(capsys, "effects", clip_path, *options)
        assert code == 0 and found["preset"] == name and "Expected: " in err
        assert found["forecast"]["seconds"] <= 20.0 and found["forecast"]["steps"] > 0


def test_a_run_that_takes_long_sends_a_pilot_ahead_unless_asked_not_to(capsys, fake, clip_path, tmp_path, monkeypatch):
    from genmojo_core.effects.pilot import Pilot
    from genmojo_core.measure import pilot_run

    sent, known = [], []
    monkeypatch.setattr("genmojo_core.effects.pilot.pays", lambda *_: True)
    monkeypatch.setattr("genmojo_core.effects.pilot.stored", lambda *_: known[0] if known else None)
    monkeypatch.setattr(pilot_run, "piloted", lambda *_: (sent.append(1), known.append(Pilot(25.0, 30.0, 35.0))))
    command = ["optimize", clip_path, "-o", str(tmp_path / "s.h5"), "--preset", "draft"]
    _, plain, err = run(capsys, *command, "--no-pilot")
    assert not sent and "pilot" not in err
    _, found, err = run(capsys, *command)
    assert sent == [1] and "A pilot, the clip run small and short" in err and "from a pilot run" in err
    assert found["forecast"]["expected_psnr"] != plain["forecast"]["expected_psnr"]
    _, _, err = run(capsys, *command)
    assert sent == [1] and "A pilot," not in err and "from a pilot run" in err  # it is kept
    known.clear()
    code, found, _ = run(capsys, "effects", clip_path, "--pilot")
    assert code == 0 and sent == [1, 1] and found["forecast"]["clip"]["reached"] == 25.0
    assert found["pilot_seconds"] is None
    known.clear()
    assert run(capsys, "effects", clip_path)[1]["pilot_seconds"] > 0 and sent == [1, 1]


def test_ctrl_c_keeps_the_work(capsys, fake, clip_path, tmp_path, monkeypatch):
    """One Ctrl-C: the run ends after its step, the scene is written, exit 130; handlers are put back."""
    monkeypatch.setattr(fake, "presses", 3)
    before = signal.getsignal(signal.SIGINT)
    code, found, err = run(capsys, "optimize", clip_path, "-o", str(tmp_path / "s.h5"), "--preset", "draft")
    assert code == 130 and found["steps"] == 3 and found["reason"] == "interrupted" and found["psnr"] is None
    assert scene_hdf5.validate(tmp_path / "s.h5") == [] and "Interrupted" in err
    assert signal.getsignal(signal.SIGINT) is before


def test_a_failed_run_keeps_its_scene_and_says_so(capsys, fake, clip_path, tmp_path, monkeypatch):
    monkeypatch.setattr(fake, "fails", True)
    assert main(["optimize", clip_path, "-o", str(tmp_path / "s.h5"), "--preset", "draft"]) == 2
    captured = capsys.readouterr()
    assert "not finite three times" in captured.err and captured.out == ""
    assert scene_hdf5.validate(tmp_path / "s.h5") == []


def test_effects(capsys, clip_path):
    code, found, _ = run(capsys, "effects", clip_path, "--effects", "+appearance_change")
    by_name = {e["name"]: e for e in found["effects"]}
    assert code == 0 and by_name["appearance_change"]["overridden"] and by_name["background"]["reason"]


def test_faults_of_ours_are_raised(monkeypatch, scene_path, tmp_path):
    """Anything but a fault of the input leaves main as itself: Python shows the traceback and exits 1."""
    monkeypatch.setattr("genmojo_core.store.scene_hdf5.read", lambda _: 1 / 0)
    with pytest.raises(ZeroDivisionError):
        main(["render", scene_path, "-o", str(tmp_path)])
