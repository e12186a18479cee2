"""What lies under a pixel, exactly; trajectories; errors carried to Gaussians."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from scenes import messy_scene, small_scene

from genmojo_core.clip.cameras import View
from genmojo_core.errors import GenmojoError
from genmojo_studio.view3d.cpu_painter import CpuPainter
from genmojo_studio.view3d.look import Look, ObjectLook
from genmojo_studio.view3d.picking import pick
from genmojo_studio.view3d.residuals import residuals
from genmojo_studio.view3d.snapshot import SceneSnapshot
from tests.view3d.scenes_gl import a_view, random_snapshot, truth


@pytest.mark.parametrize("seed", range(4))
def test_weights_are_those_of_the_float64_picture(seed: int) -> None:
    """Every Gaussian's weight in a pixel, to 1e-6: the table explains the colour on the screen."""
    snapshot, view = random_snapshot(80, seed), a_view(48, 36, shift=(5.0, -3.0))
    weights = truth(snapshot, view, np.eye(80)).features  # (H, W, 80)
    for row, column in ((18, 24), (10, 30), (25, 12), (18, 5)):
        found = pick(snapshot, view, Look(), column + 0.3, row + 0.9)
        wanted = {n: w for n, w in enumerate(weights[row, column]) if w > 1e-7}
        assert {c.row: c.weight for c in found.contributors} == pytest.approx(wanted, abs=1e-6)
        assert found.coverage == pytest.approx(weights[row, column].sum(), abs=1e-6)
        assert found.color == pytest.approx(weights[row, column] @ snapshot.colours, abs=1e-5)
        depths = [c.depth for c in found.contributors]
        assert depths == sorted(depths)


def test_the_surface_is_picked_not_a_floater_before_it() -> None:
    snapshot = random_snapshot(2)
    snapshot = replace(
        snapshot, positions=np.array([[0, 0, 1.0], [0, 0, 3.0]]), scales=np.full((2, 3), 0.5),
        opacities=np.array([0.2, 0.95]), object_id=np.array([1, 2]),
    )  # fmt: skip
    view = a_view()
    found = pick(snapshot, view, Look(), 48, 36)
    assert found.main is not None
    assert (found.main.row, found.main.object_name) == (1, "object 2")
    assert found.position == pytest.approx([0, 0, 3.0], abs=1e-6)
    alone = pick(snapshot, view, Look(solo=frozenset({1})), 48, 36)
    assert [c.row for c in alone.contributors] == [0]
    faded = pick(snapshot, view, Look(objects={2: ObjectLook(opacity=0.001)}), 48, 36)
    assert [c.row for c in faded.contributors] == [0]


def test_nothing_under_the_pixel() -> None:
    found = pick(random_snapshot(0), a_view(), Look(), 3, 4)
    assert (found.contributors, found.main, found.position, found.coverage) == ((), None, None, 0.0)
    behind = View(np.diag([1.0, 1, -1, 1]), 96, 96, 48, 36, 96, 72)
    assert pick(random_snapshot(20), behind, Look(), 48, 36).main is None


@pytest.mark.parametrize("row", [0, 150, 262])
def test_a_trajectory_is_the_frames_own_values(row: int) -> None:
    scene = messy_scene()
    path = SceneSnapshot.from_baked(scene, 1).trajectory(row)
    for t in range(len(scene)):
        frame = scene.frame(t)
        assert path["positions"][t] == pytest.approx(frame.means[row], abs=1e-6)
        assert path["scales"][t] == pytest.approx(frame.scales[row], rel=1e-5)
        assert path["colours"][t] == pytest.approx(frame.rgb[row], abs=1e-6)
        assert np.abs(path["rotations"][t] @ frame.quats[row]) == pytest.approx(1, abs=1e-6)
    with pytest.raises(GenmojoError):
        SceneSnapshot.from_baked(scene).trajectory(10**6)


def test_a_live_preview_has_one_point_of_a_trajectory() -> None:
    assert random_snapshot(5).trajectory(2)["positions"].shape == (1, 3)


def test_the_canonical_scene_stands_still() -> None:
    """Each object in its own reference frame, without deformation."""
    scene = messy_scene()
    scene = replace(scene, ref_frame=np.array([0, 2, 1]))
    still = SceneSnapshot.from_baked(scene, 1).canonical
    assert still.frames is None
    for k, t in enumerate(scene.ref_frame):
        rows = scene.object_index == k
        placed = scene.object_to_world[t, k]
        assert still.positions[rows] == pytest.approx(scene.xyz[rows] @ placed[:, :3].T + placed[:, 3], abs=1e-5)
    live = random_snapshot(3)
    assert live.canonical is live


def test_errors_stick_to_the_gaussians_that_cause_them() -> None:
    """A disc whose input has another colour carries the error; the hidden and the right ones carry none."""
    scene = small_scene(frames=2, size=(160, 120), per_object=150)
    snapshot = SceneSnapshot.from_baked(scene, 1)
    painter = CpuPainter()
    painter.upload(snapshot)
    view = scene.cameras.view(1)
    image = np.clip(painter.picture(view, Look(), 1.0).sums[..., :3], 0, 1)
    red = (image[..., 0] > 0.5) & (image[..., 1] < 0.3)
    image[red] = (0, 0, 1)
    wrong = residuals(snapshot, (image * 255 + 0.5).astype(np.uint8), lambda v, look: painter.picture(v, look, 1.0))
    disc, rest = snapshot.object_id == 1, snapshot.object_id == 2
    assert np.median(wrong[disc]) > 0.3
    assert np.median(wrong[rest]) < 0.02
    without_cameras = residuals(random_snapshot(4), np.zeros((8, 8, 3), np.uint8), painter.picture)
    assert without_cameras.max() == 0
