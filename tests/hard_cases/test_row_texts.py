"""Rows N16, N17, N32 and N33 of RELIABILITY.md by their own words: depth of thin cover, hidden references, limits of
helpers, conventions of files."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
import torch

from genmojo_core.cli.main import main
from genmojo_core.clip.cameras import View
from genmojo_core.estimate.complete import complete
from genmojo_core.hard_cases import clips
from genmojo_core.hard_cases.runs import finished
from genmojo_core.measure.views import render_frame
from genmojo_core.optimise.first_poses import first_poses
from genmojo_core.optimise.losses import masked_mean
from genmojo_core.optimise.motion import initial_motion
from genmojo_core.render import autograd, torch_tiles
from genmojo_core.render.rasterizer import Splats
from genmojo_core.render.ssim import ssim_map, whole_windows
from genmojo_core.scene.initialise import unproject
from genmojo_core.store import ply, scene_hdf5
from tests.render.scenes import camera
from tests.scenes import small_scene

RASTERISERS = [autograd.splat, torch_tiles.splat]
COVERED = 1e-4  # coverage below which a depth is none (render/rasterizer.py)


def card(depth: float, opacity: float, colour: tuple[float, float, float]) -> Splats:
    """A disc that faces the camera and fills the view."""
    parts = ([0.0, 0.0, depth], [1.0, 0.0, 0.0, 0.0], [30.0, 30.0, 1e-3], opacity, list(colour))
    return Splats(*(torch.tensor([part], dtype=torch.float32) for part in parts))


def both(front: Splats, back: Splats) -> Splats:
    names = ("means", "quats", "scales", "opacities", "features")
    return Splats(*(torch.cat([getattr(front, name), getattr(back, name)]) for name in names))


@pytest.mark.parametrize("draw", RASTERISERS)
def test_n16_a_half_covered_card_is_at_its_depth_and_blends_once(draw) -> None:
    view = camera(16, 12)
    picture = draw(card(4.0, 0.5, (1.0, 0.5, 0.25)), view)
    middle = (6, 8)
    assert float(picture.alpha[middle]) == pytest.approx(0.5, abs=1e-4)
    assert float(picture.depth[middle] / picture.alpha[middle]) == pytest.approx(4.0, abs=1e-3)
    over = draw(both(card(4.0, 0.5, (1.0, 0.0, 0.0)), card(6.0, 0.8, (0.0, 1.0, 0.0))), view)
    assert over.features[middle].tolist() == pytest.approx([0.5, 0.4, 0.0], abs=1e-3)
    assert float(over.depth[middle]) == pytest.approx(0.5 * 4.0 + 0.4 * 6.0, abs=2e-3)


@pytest.mark.parametrize("draw", RASTERISERS)
@pytest.mark.parametrize("opacity", [0.0, 0.003])
def test_n16_where_nothing_is_drawn_no_depth_is_valid(draw, opacity: float) -> None:
    picture = draw(card(4.0, opacity, (1.0, 1.0, 1.0)), camera(16, 12))
    assert not bool((picture.alpha >= COVERED).any())
    assert not picture.depth.any() and not picture.features.any()


@pytest.mark.parametrize("found_by", [first_poses, pytest.param(initial_motion, marks=pytest.mark.slow)])
def test_n17_hiding_one_object_for_ten_frames_makes_no_object_jump_in_depth(found_by) -> None:
    """There is no reference object: every depth is the object's own, and goes on while it is hidden."""
    hidden = complete(clips.without(clips.plain(16, (96, 64)), 0, slice(3, 13)))
    cameras = hidden.cameras.value
    for k, motion in enumerate(found_by(hidden)):
        t = motion.ref_frame
        rows, columns = np.nonzero(hidden.object_mask(k)[t])
        xy = np.column_stack([columns, rows]) + 0.5
        middle = unproject(xy, hidden.depth.value[t, rows, columns], cameras.view(t)).mean(axis=0)
        z = (cameras.world_to_camera @ motion.pose @ np.append(middle, 1.0))[:, 2]
        assert np.isfinite(z).all()
        assert np.abs(np.diff(np.log(z))).max() < 0.05, (k, z)


@pytest.mark.slow
def test_n17_depth_factors_of_a_run_stay_bounded_and_smooth_while_an_object_is_hidden() -> None:
    outcome = finished(clips.without(clips.plain(16, (48, 32)), 0, slice(3, 13)), joint_steps=60)
    for model in outcome.run.scene.objects:
        factor = model.placement.baked()[1]
        assert ((factor > 0.1) & (factor < 10)).all()
        assert np.abs(np.diff(factor)).max() < 0.05 + 1e-6


@pytest.mark.parametrize("side", range(1, 33))
def test_n32_structure_of_crops_smaller_than_its_window(side: int) -> None:
    generator = torch.Generator().manual_seed(side)
    picture = torch.rand(1, side, 7, 3, generator=generator)
    shown = torch.rand(1, side, 7, 3, generator=generator, requires_grad=True)
    assert torch.allclose(ssim_map(picture, picture), torch.ones(1), atol=1e-4)
    ssim_map(shown, picture).sum().backward()
    assert bool(torch.isfinite(shown.grad).all())
    assert bool(whole_windows(torch.ones(1, side, 7)).all())


def test_n32_sixteen_frames_of_full_hd_are_one_mean() -> None:
    """2^25 values: helpers that refuse more than 2^24, or add up in steps too small for float32, fail."""
    values = torch.full((16, 1080, 1920), 0.25)
    weight = torch.ones_like(values)
    values[:, :, 960:] = 0.75
    assert float(masked_mean(values, weight)) == pytest.approx(0.5, rel=1e-4)


def triad(frames: int = 2):
    """Three needles along x, y and z in red, green and blue, of three lengths: no mirror image looks the same."""
    scene = small_scene(frames=frames, per_object=3, background=False, turn=20.0)
    xyz, scale, dc = scene.xyz.copy(), scene.scale.copy(), scene.dc.copy()
    rot = scene.rot.copy()
    for first in (0, 3):
        for axis in range(3):
            xyz[first + axis] = 0.3 * np.eye(3)[axis]
            scale[first + axis] = np.where(np.eye(3)[axis] > 0, 0.1 * (axis + 1), 0.03)
            dc[first + axis] = (np.eye(3)[axis] - 0.5) / 0.28209479
    rot[:] = np.array([0.9, 0.1, -0.3, 0.3]) / np.linalg.norm([0.9, 0.1, -0.3, 0.3])
    rot_t = np.broadcast_to(rot, scene.rot_t.shape).astype(np.float32)
    return replace(scene, xyz=xyz, scale=scale, dc=dc, rot=rot.astype(np.float32), rot_t=rot_t)


def pictures(scene, view: View) -> np.ndarray:
    return np.stack([render_frame(scene, t, view).on() for t in range(len(scene))])


def test_n33_an_asymmetric_triad_comes_back_pixel_for_pixel_and_is_counted(tmp_path: Path, capsys) -> None:
    scene = triad()
    view = scene.cameras.view(0)
    before = pictures(scene, view)
    assert before.std() > 0.01 and not np.allclose(before, before[:, :, ::-1], atol=0.05)
    scene_hdf5.write(scene, tmp_path / "scene.h5")
    assert np.abs(pictures(scene_hdf5.read(tmp_path / "scene.h5"), view) - before).max() < 1 / 255
    command = ["export", str(tmp_path / "scene.h5"), "-o", str(tmp_path / "p"), "--extra", "--to", "ply-sequence"]
    assert main(command) == 0
    assert main(["import", str(tmp_path / "p"), "-o", str(tmp_path / "back.h5")]) == 0
    assert np.abs(pictures(scene_hdf5.read(tmp_path / "back.h5"), view) - before).max() < 1 / 255
    capsys.readouterr()
    assert main(["export", str(tmp_path / "scene.h5"), "--to", "ply", "-o", str(tmp_path / "one.ply"), "--json"]) == 0
    told = capsys.readouterr().out
    assert f'"gaussians": {len(scene.xyz)}' in told and len(ply.read(tmp_path / "one.ply")) == len(scene.xyz)
