"""The processor's pictures are the GL renderer's, mode by mode; the thread never shows an old wish."""

from __future__ import annotations

import threading
from dataclasses import replace

import numpy as np
import pytest
from scenes import messy_scene, small_scene

from genmojo_core.conventions import orbit_camera
from genmojo_studio.view3d.colouring import colour, straight_rgba, value_bounds
from genmojo_studio.view3d.cpu_painter import CpuPainter
from genmojo_studio.view3d.cpu_view import Drawer
from genmojo_studio.view3d.frames import FrameRequest
from genmojo_studio.view3d.look import Look, Mode, ObjectLook
from genmojo_studio.view3d.orbit import Orbit, reference_of
from genmojo_studio.view3d.quality import Quality
from genmojo_studio.view3d.renderer import SplatRenderer
from genmojo_studio.view3d.snapshot import SceneSnapshot
from tests.view3d.scenes_gl import decibels, egl_context, random_snapshot

LEAST_DB = {Mode.DEPTH_MEDIAN: 20, Mode.ELLIPSOIDS: 8, Mode.CENTRES: 8}  # approximations; all others 55


@pytest.fixture(scope="module")
def renderer() -> SplatRenderer:
    return SplatRenderer(egl_context())


@pytest.mark.parametrize("mode", list(Mode))
@pytest.mark.parametrize("t", [2.0, 0.4], ids=["frame", "between"])
def test_every_mode_agrees_with_the_renderer(renderer: SplatRenderer, mode: Mode, t: float) -> None:
    scene = messy_scene()
    snapshot = SceneSnapshot.from_baked(scene, 1)
    painter = CpuPainter()
    painter.upload(snapshot)
    errors = np.random.default_rng(0).random(len(snapshot)).astype(np.float32)
    painter.set_residuals(errors)
    look = Look(mode=mode, explode=0.2, objects={1: ObjectLook(opacity=0.6, tint=(1.0, 0.0, 1.0))}, splat_scale=0.9)
    view = scene.cameras.view(0)
    view = view.with_pose(orbit_camera(view.world_to_camera, snapshot.orbit_target, scene.world_up, 8, 25))
    mine = painter.picture(view, look, t).sums
    with renderer.ctx:
        renderer.upload(snapshot)
        renderer.set_residuals(errors)
        theirs = renderer.picture(view, look, t).sums
        image = renderer.image(view, replace(look, value_range=value_bounds(theirs, mode), backdrop=(0.1, 0.2, 0.3)), t)
    least = LEAST_DB.get(mode, 55)
    scale = max(1.0, float(np.abs(theirs[..., :3]).max()))
    channels = slice(0, 1) if mode == Mode.INSTANCE else slice(0, 3)
    if mode != Mode.OPACITY:
        seen = theirs[..., 3:] > 0.02 if mode == Mode.INSTANCE else np.ones_like(theirs[..., 3:], bool)
        same = (mine[..., channels] - theirs[..., channels]) * seen / scale
        assert decibels(same, 0) >= (25 if mode == Mode.INSTANCE else least)
    assert decibels(mine[..., 3], theirs[..., 3]) >= least
    colors = np.array([snapshot.object_of(int(i)).color for i in snapshot.object_ids])
    coloured = colour(theirs, mode, (0.1, 0.2, 0.3), value_bounds(theirs, mode), colors)
    assert np.abs(coloured.astype(int) - image[..., :3]).mean() < 0.6  # the shader's colouring is numpy's


def test_without_a_backdrop_colours_are_straight() -> None:
    sums = np.array([[[0.3, 0.15, 0.0, 0.3], [0, 0, 0, 0]]], np.float32)
    assert straight_rgba(sums, Mode.RGB, (0, 1), np.zeros((1, 3)))[0].tolist() == [[255, 128, 0, 77], [0, 0, 0, 0]]


def test_colour_scales_ignore_what_is_not_covered() -> None:
    sums = np.zeros((10, 10, 4), np.float32)
    sums[2:5, :, 0], sums[2:5, :, 3] = 2.0, 1.0
    sums[5:8, :, 0], sums[5:8, :, 3] = 4.0 * 0.5, 0.5
    assert value_bounds(sums, Mode.DEPTH) == pytest.approx((2.0, 4.0))
    assert value_bounds(sums, Mode.FLOW) == pytest.approx((0.0, 4.0))
    assert value_bounds(np.zeros((2, 2, 4)), Mode.DEPTH) == (0.0, 1.0)


def test_the_newest_wish_is_drawn_last_and_few_are_drawn_in_between() -> None:
    """Forty turns asked for faster than they can be drawn: the fortieth is on the screen in the end."""
    snapshot = SceneSnapshot.from_baked(small_scene(frames=2, size=(160, 120)))
    done, drawn = threading.Event(), []

    def finished(pixels: np.ndarray, report: object) -> None:
        drawn.append((pixels, report))
        if report.request.orbit.azimuth == 39:
            done.set()

    drawer = Drawer(finished, pytest.fail)
    for k in range(40):
        drawer.ask(FrameRequest(snapshot, reference_of(snapshot), Orbit(azimuth=float(k)), Look(), 0.0), (80, 60))
    assert done.wait(30)
    drawer.stop()
    assert drawn[-1][1].request.orbit.azimuth == 39
    assert drawn[-1][0].shape == (60, 80, 3)
    assert len(drawn) < 40
    done.clear()
    drawer.ask(drawn[-1][1].request, (80, 60))
    assert done.wait(30)  # a view that was closed and is shown again
    drawer.stop()


def test_errors_of_the_kernels_are_told(monkeypatch: pytest.MonkeyPatch) -> None:
    told = threading.Event()
    reasons = []
    drawer = Drawer(lambda *_: None, lambda reason: (reasons.append(reason), told.set()))
    monkeypatch.setattr(CpuPainter, "picture", lambda *_: (_ for _ in ()).throw(RuntimeError("no kernels\nhere")))
    snapshot = random_snapshot(3)
    drawer.ask(FrameRequest(snapshot, reference_of(snapshot), Orbit(), Look(), 0.0), (20, 20))
    assert told.wait(60)
    assert reasons == ["no kernels"]
    monkeypatch.undo()
    drawn = threading.Event()
    drawer._finished = lambda *_: drawn.set()
    drawer.ask(FrameRequest(snapshot, reference_of(snapshot), Orbit(), Look(), 0.0), (20, 20))
    assert drawn.wait(60)  # the next picture is tried again
    drawer.stop()


def test_less_detail_is_smaller_and_similar() -> None:
    snapshot = SceneSnapshot.from_baked(small_scene(frames=1, size=(160, 120), per_object=400))
    painter = CpuPainter()
    painter.upload(snapshot)
    view = snapshot.cameras.view(0)
    full = painter.picture(view, Look()).sums
    low = painter.picture(view, Look(), None, Quality(2, 0.5)).sums
    assert low.shape == (60, 80, 4)
    assert decibels(low[..., :3], full.reshape(60, 2, 80, 2, 4).mean((1, 3))[..., :3]) > 18


def test_kernels_are_made_ready_before_there_is_a_scene(monkeypatch) -> None:
    """A view that is shown warms up once, without a request; what fails there is told with the first picture."""
    warmed = threading.Event()

    def warm() -> None:
        warmed.set()
        raise RuntimeError("no kernels")

    monkeypatch.setattr("genmojo_studio.view3d.cpu_view.warm_up", warm)
    drawn, reasons = threading.Event(), []
    drawer = Drawer(lambda *_: drawn.set(), reasons.append)
    drawer.begin()
    assert warmed.wait(60)
    snapshot = random_snapshot(3)
    drawer.ask(FrameRequest(snapshot, reference_of(snapshot), Orbit(), Look(), 0.0), (20, 20))
    assert drawn.wait(60) and not reasons
    drawer.stop()
