"""The GL renderer against a float64 compositor and against the optimiser's rasteriser."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace

import numpy as np
import pytest
from scenes import messy_scene, small_scene

from genmojo_core.clip.cameras import View
from genmojo_core.conventions import orbit_camera, quaternion_to_matrix
from genmojo_core.errors import GenmojoError
from genmojo_core.render.cpu.rasterize import rasterize
from genmojo_core.render.rasterizer import Splats
from genmojo_studio.view3d.look import Look, Mode, ObjectLook
from genmojo_studio.view3d.quality import Quality
from genmojo_studio.view3d.renderer import SplatRenderer
from genmojo_studio.view3d.snapshot import SceneSnapshot
from tests.view3d.scenes_gl import a_view, decibels, egl_context, random_snapshot, truth


@pytest.fixture(scope="module")
def shared() -> Iterator[SplatRenderer]:
    made = SplatRenderer(egl_context())
    yield made
    with made.ctx:
        made.release()


@pytest.fixture
def renderer(shared: SplatRenderer) -> Iterator[SplatRenderer]:
    """The module's renderer with its context current, whatever other contexts a test has made."""
    with shared.ctx:
        yield shared


@pytest.mark.parametrize("shift", [(0.0, 0.0), (20.0, -15.0), (-90.0, 10.0)], ids=["centred", "off centre", "outside"])
def test_colour_agrees_with_float64(renderer: SplatRenderer, shift: tuple[float, float]) -> None:
    """Principal points anywhere: a crop of a clip must look like the clip."""
    snapshot, view = random_snapshot(300), a_view(shift=shift)
    renderer.upload(snapshot)
    drawn, wanted = renderer.picture(view, Look()).sums, truth(snapshot, view)
    assert decibels(drawn[..., :3], wanted.features) >= 60
    assert np.abs(drawn[..., 3] - wanted.alpha).max() < 2e-3


@pytest.mark.parametrize("seed", [1, 2])
def test_needles_and_giants_agree_with_float64(renderer: SplatRenderer, seed: int) -> None:
    """Splats 3000 times longer than thick, or larger than the screen, keep their shape in float32."""
    snapshot = random_snapshot(40, seed)
    scales = snapshot.scales.copy()
    scales[::2] *= np.array([1.0, 1e-3, 20.0], np.float32)
    snapshot = replace(snapshot, scales=scales)
    renderer.upload(snapshot)
    view = a_view()
    assert decibels(renderer.picture(view, Look()).sums[..., :3], truth(snapshot, view).features) >= 60


def test_colour_agrees_with_the_optimisers_rasteriser(renderer: SplatRenderer) -> None:
    """What a person sees is what the optimiser optimised, at more splats than the oracle can hold."""
    snapshot, view = random_snapshot(3000, size=0.03), a_view(320, 240)
    renderer.upload(snapshot)
    parts = (snapshot.positions, snapshot.rotations, snapshot.scales, snapshot.opacities, snapshot.colours)
    wanted = rasterize(Splats(*parts), view)
    drawn = renderer.picture(view, Look()).sums
    assert decibels(drawn[..., :3], wanted.features) >= 45
    assert decibels(drawn[..., 3], wanted.alpha) >= 45


def test_depth_objects_normals_are_the_weighted_sums(renderer: SplatRenderer) -> None:
    snapshot, view = random_snapshot(200, 3), a_view()
    renderer.upload(snapshot)
    wanted = truth(snapshot, view)
    assert np.abs(renderer.picture(view, Look(mode=Mode.DEPTH)).sums[..., 0] - wanted.depth).max() < 5e-3
    shares = truth(snapshot, view, np.eye(3)[snapshot.object_id]).features
    soft = renderer.picture(view, Look(mode=Mode.INSTANCE_SOFT)).sums[..., :3]
    colors = np.array([o.color for o in snapshot.objects])
    assert decibels(soft, shares @ colors) >= 60
    axes = quaternion_to_matrix(snapshot.rotations.astype(float))
    thin = np.take_along_axis(axes, np.argmin(snapshot.scales, axis=1)[:, None, None], axis=2)[..., 0]
    thin *= -np.sign(np.sum(thin * snapshot.positions, axis=1, keepdims=True))
    normals = renderer.picture(view, Look(mode=Mode.NORMAL)).sums[..., :3]
    assert decibels(normals, truth(snapshot, view, thin).features) >= 55


def test_the_object_with_the_largest_share_wins_with_any_number_of_objects(renderer: SplatRenderer) -> None:
    """Three shares fit one pass; seven objects need three passes, and the winner may be in any of them."""
    snapshot, view = random_snapshot(210, 4, objects=7), a_view()
    renderer.upload(snapshot)
    shares = truth(snapshot, view, np.eye(7)[snapshot.object_id]).features
    drawn = renderer.picture(view, Look(mode=Mode.INSTANCE)).sums
    ordered = np.sort(shares, axis=-1)
    clear = (ordered[..., -1] - ordered[..., -2] > 1e-3) & (ordered[..., -1] > 0.01)
    assert clear.mean() > 0.3
    assert np.array_equal(drawn[..., 0][clear].astype(int), shares.argmax(-1)[clear])


def test_median_depth_is_where_half_the_light_is_absorbed(renderer: SplatRenderer) -> None:
    snapshot = random_snapshot(2, 5)
    places = np.array([[0, 0, 2.0], [0, 0, 4.0]])
    snapshot = replace(snapshot, positions=places, scales=np.full((2, 3), 0.5), colours=np.ones((2, 3)))
    view = a_view()
    for opacity, depth in ((0.8, 2.0), (0.4, 4.0)):
        renderer.upload(replace(snapshot, opacities=np.array([opacity, 0.9])))
        centre = renderer.picture(view, Look(mode=Mode.DEPTH_MEDIAN)).sums[36, 48]
        assert centre[0] / centre[3] == pytest.approx(depth, abs=0.01)
    assert renderer.picture(view, Look(mode=Mode.DEPTH_MEDIAN)).sums[0, 0, 3] == 0  # nothing there, no depth


def test_flow_is_the_motion_of_projections(renderer: SplatRenderer) -> None:
    scene = small_scene(frames=3, shift=0.2)
    renderer.upload(SceneSnapshot.from_baked(scene, 1))
    view = scene.cameras.view(1)
    drawn = renderer.picture(view, Look(mode=Mode.FLOW), 1.0).sums
    moving = 0.2 * view.fx / 4.0  # disc 0 at depth 4
    place = np.array([-0.6 + 0.2, 0.0, 4.0])
    column, row = int(view.fx * place[0] / 4 + view.cx), int(view.cy)
    flow = drawn[row, column, :2] / drawn[row, column, 3]
    assert flow == pytest.approx([moving, 0], abs=0.15)  # the wall behind shines through by a percent or two


def test_time_between_frames_and_on_frames(renderer: SplatRenderer) -> None:
    """Scrubbing draws each frame's own geometry (also turned, scaled, deforming), and the way between them."""
    scene = messy_scene()
    snapshot = SceneSnapshot.from_baked(scene, 0)
    renderer.upload(snapshot)
    view = scene.cameras.view(0)
    view = view.with_pose(orbit_camera(view.world_to_camera, snapshot.orbit_target, scene.world_up, 10, 20))
    for t in (0, 2, 1):
        assert decibels(renderer.picture(view, Look(), float(t)).sums[..., :3],
                        truth(snapshot.at(t), view).features) >= 50  # fmt: skip
    a, b = snapshot.at(0), snapshot.at(1)
    halfway = renderer.picture(view, Look(mode=Mode.CENTRES), 0.5).sums[..., 3]
    middle = replace(a, positions=0.5 * (a.positions + b.positions))
    renderer.upload(replace(middle, frames=None))
    assert decibels(halfway, renderer.picture(view, Look(mode=Mode.CENTRES)).sums[..., 3]) >= 40


def test_layers_are_shared_where_memory_is_short(renderer: SplatRenderer, monkeypatch: pytest.MonkeyPatch) -> None:
    """A clip longer than the budget still scrubs: the longest unused frame makes room."""
    monkeypatch.setattr("genmojo_studio.view3d.scene_textures.LAYER_BUDGET", 1)
    scene = small_scene(frames=5)
    snapshot = SceneSnapshot.from_baked(scene, 0)
    renderer.upload(snapshot)
    view = scene.cameras.view(0)
    for t in (0, 3.5, 1, 4, 0.25):
        drawn = renderer.picture(view, Look(), t).sums
        if t == int(t):
            assert decibels(drawn[..., :3], truth(snapshot.at(int(t)), view).features) >= 50
    assert not renderer.prefetch()


def test_objects_hide_solo_tint_fade_and_move_apart(renderer: SplatRenderer) -> None:
    snapshot, view = random_snapshot(150, 6), a_view()
    renderer.upload(snapshot)
    colour = renderer.picture(view, Look(), None).sums
    ids = snapshot.object_id
    cases = {
        "solo": (Look(solo=frozenset({2})), ids == 2, {}),
        "background": (Look(show_background=False), ids != 0, {}),
        "hidden": (Look(objects={1: ObjectLook(visible=False)}), ids != 1, {}),
    }
    for name, (look, kept, _) in cases.items():
        subset = _rows(snapshot, kept)
        assert decibels(renderer.picture(view, look).sums[..., :3], truth(subset, view).features) >= 60, name
    faded = replace(snapshot, opacities=np.where(ids == 1, 0.25, 1) * snapshot.opacities)
    look = Look(objects={1: ObjectLook(opacity=0.25)})
    assert decibels(renderer.picture(view, look).sums[..., :3], truth(faded, view).features) >= 60
    look = Look(objects={1: ObjectLook(tint=(1, 0, 0), tint_mix=1.0)})
    tinted = replace(snapshot, colours=np.where((ids == 1)[:, None], [1.0, 0, 0], snapshot.colours))
    assert decibels(renderer.picture(view, look).sums[..., :3], truth(tinted, view).features) >= 60
    moved = snapshot.positions.copy()
    for k in (1, 2):
        moved[ids == k] += 0.5 * (np.median(moved[ids == k], axis=0) - snapshot.orbit_target)
    apart = renderer.picture(view, Look(explode=0.5)).sums[..., :3]
    assert decibels(apart, truth(replace(snapshot, positions=moved), view).features) >= 60
    assert np.array_equal(renderer.picture(view, Look()).sums, colour)  # and nothing stays behind


def test_splats_of_all_objects_are_sorted_in_one_list(renderer: SplatRenderer) -> None:
    """Two objects one within the other: order by object would put one wholly in front."""
    snapshot = random_snapshot(3)
    places = np.array([[0, 0, 2.0], [0, 0, 3.0], [0, 0, 4.0]])
    snapshot = replace(
        snapshot, positions=places, object_id=np.array([1, 2, 1]), scales=np.full((3, 3), 0.4),
        opacities=np.full(3, 0.7),
    )  # fmt: skip
    renderer.upload(snapshot)
    view = a_view()
    assert decibels(renderer.picture(view, Look()).sums[..., :3], truth(snapshot, view).features) >= 60


def test_large_scenes_are_sorted_aside_and_exactly_for_pictures() -> None:
    """Above the limit the view draws at once with an older order and wakes when the new one is there."""
    woken: list[int] = []
    made = SplatRenderer(egl_context(), lambda: woken.append(1), exact_up_to=100)
    snapshot, view = random_snapshot(300, 7), a_view()
    made.upload(snapshot)
    made.draw(view, Look())
    turned = view.with_pose(orbit_camera(view.world_to_camera, np.array([0, 0, 3.0]), np.array([0, -1.0, 0]), 0, 170))
    made.draw(turned, Look())
    assert not made.order_is_exact
    exact = made.picture(turned, Look())
    assert exact.order_is_exact
    assert decibels(exact.sums[..., :3], truth(snapshot, turned).features) >= 60
    made.release()
    assert woken


def test_lower_detail_looks_alike(renderer: SplatRenderer) -> None:
    """While moving: half the pixels each way and a quarter of the splats show the same picture without holes."""
    snapshot, view = random_snapshot(8000, 8, size=0.03), a_view(160, 120)
    renderer.upload(snapshot)
    full = renderer.picture(view, Look()).sums
    renderer.draw(view, Look(), None, Quality(4, 0.5))
    small = np.frombuffer(renderer._targets["sums"].read(components=4, dtype="f4"), np.float32).reshape(60, 80, 4)[::-1]
    coarse = full.reshape(60, 2, 80, 2, 4).mean((1, 3))
    assert decibels(small[..., :3], coarse[..., :3]) > 14
    assert small[..., 3].mean() == pytest.approx(coarse[..., 3].mean(), rel=0.1)


def test_nothing_and_broken_splats(renderer: SplatRenderer) -> None:
    """No Gaussian, values that are not finite, a zero quaternion: a black picture or the others' one, no error."""
    view = a_view()
    empty = random_snapshot(0)
    renderer.upload(empty)
    assert not renderer.picture(view, Look()).sums.any()
    good = random_snapshot(60, 9)
    arrays = {name: getattr(good, name).copy() for name in ("positions", "scales", "opacities", "rotations")}
    arrays["positions"][0], arrays["scales"][1], arrays["opacities"][2] = np.nan, np.inf, np.nan
    arrays["rotations"][3] = 0
    renderer.upload(replace(good, **arrays))
    rest = _rows(good, np.arange(60) > 3)
    assert decibels(renderer.picture(view, Look()).sums[..., :3], truth(rest, view).features) >= 60


def test_images_have_the_first_row_at_the_top_and_straight_alpha(renderer: SplatRenderer) -> None:
    snapshot = random_snapshot(1)
    snapshot = replace(snapshot, positions=np.array([[0, -0.8, 3.0]]), colours=np.array([[1.0, 0.5, 0.0]]),
                       opacities=np.array([0.6]), object_id=np.array([1]))  # fmt: skip
    renderer.upload(snapshot)
    view = View(np.eye(4), 60.0, 60.0, 32.0, 24.0, 64, 48)
    image = renderer.image(view, Look(backdrop=None))
    row, column = np.unravel_index(image[..., 3].argmax(), image.shape[:2])
    assert row < 24  # minus y is up
    assert image[row, column, :3] == pytest.approx([255, 128, 0], abs=3)
    on_white = renderer.image(view, Look(backdrop=(1.0, 1.0, 1.0)))
    assert (on_white[40, 5] == 255).all()


def test_too_large_a_picture_is_refused_in_words(renderer: SplatRenderer) -> None:
    renderer.upload(random_snapshot(5))
    with pytest.raises(GenmojoError, match="smaller size"):
        renderer.picture(a_view(1 << 20, 8), Look())


def _rows(snapshot: SceneSnapshot, kept: np.ndarray) -> SceneSnapshot:
    """The snapshot with some of its rows."""
    names = ("positions", "rotations", "scales", "opacities", "colours", "object_id", "uid")
    return replace(snapshot, **{name: getattr(snapshot, name)[kept] for name in names})
