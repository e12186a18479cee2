"""Milliseconds of a frame of the 3D view: `python -m tests.benchmarks.splat_view [--size 960x540] [--scene FILE]`.

GL on whatever driver EGL gives (the name is printed) and the processor's kernels, at 10 000, 50 000 and 150 000
Gaussians: a full frame, and the frame that is drawn while moving (as chosen by `quality.Detail`). Medians of several
frames; wall clock and process time.
"""

from __future__ import annotations

import argparse
import json
import statistics
import sys
import time
from collections.abc import Callable

import moderngl
import numpy as np

from genmojo_core.clip.cameras import View
from genmojo_core.conventions import orbit_camera
from genmojo_core.store import scene_hdf5
from genmojo_studio.view3d.cpu_painter import CpuPainter
from genmojo_studio.view3d.look import Look
from genmojo_studio.view3d.order import back_to_front
from genmojo_studio.view3d.quality import FULL, Detail, Quality
from genmojo_studio.view3d.renderer import SplatRenderer
from genmojo_studio.view3d.snapshot import SceneSnapshot

COUNTS = (10_000, 50_000, 150_000)
FRAMES = 7


def main() -> None:
    """Measure and print one JSON line per engine and count."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--size", default="960x540", help="pixels of the view")
    parser.add_argument("--scene", help="a scene file; its surface is resampled to every count")
    parser.add_argument("--engines", nargs="+", default=["gl", "cpu"], choices=["gl", "cpu"])
    args = parser.parse_args()
    width, height = (int(v) for v in args.size.split("x"))
    for count in COUNTS:
        snapshot = resampled(args.scene, count) if args.scene else wall_and_balls(count)
        view = camera(snapshot, width, height)
        for engine in args.engines:
            measure = gl_frames if engine == "gl" else cpu_frames
            row = {"gaussians": count, "engine": engine, "size": args.size, **measure(snapshot, view)}
            row["sort_ms"] = round(median_ms(lambda s=snapshot: back_to_front(s.positions[:, 2]))[0], 2)
            sys.stdout.write(json.dumps(row) + "\n")
            sys.stdout.flush()


def gl_frames(snapshot: SceneSnapshot, view: View) -> dict[str, object]:
    """A full frame and a moving one of the GL renderer."""
    ctx = moderngl.create_context(standalone=True, backend="egl", require=330)
    with ctx:
        renderer = SplatRenderer(ctx)
        renderer.upload(snapshot)

        def draw(quality: Quality, turn: float) -> None:
            renderer.draw(turned(snapshot, view, turn), Look(), None, quality)
            ctx.finish()

        found = frames(draw)
        found["driver"] = renderer.name
        renderer.release()
    return found


def cpu_frames(snapshot: SceneSnapshot, view: View) -> dict[str, object]:
    """The same by the processor's kernels."""
    painter = CpuPainter()
    painter.upload(snapshot)
    return frames(lambda quality, turn: painter.picture(turned(snapshot, view, turn), Look(), None, quality))


def frames(draw: Callable[[Quality, float], object]) -> dict[str, object]:
    """Medians of full frames and of the frames of a turn."""
    draw(FULL, 0.0)  # compiles, uploads
    full = median_ms(lambda: draw(FULL, 1.0))
    detail = Detail()
    detail.begin(full[0])
    moving = []
    for k in range(4 * FRAMES):
        start = time.perf_counter()
        draw(detail.quality, float(k))
        ms = (time.perf_counter() - start) * 1e3
        moving.append(ms)
        detail.took(ms)
    last = moving[FRAMES:]
    return {
        "full_ms": round(full[0], 1), "full_cpu_ms": round(full[1], 1),
        "moving_ms": round(statistics.median(last), 1), "moving_worst_ms": round(max(last), 1),
        "moving_stride": detail.quality.stride, "moving_scale": detail.quality.scale,
    }  # fmt: skip


def median_ms(act: Callable[[], object]) -> tuple[float, float]:
    """(wall, process) milliseconds."""
    wall, process = [], []
    for _ in range(FRAMES):
        a, b = time.perf_counter(), time.process_time()
        act()
        wall.append((time.perf_counter() - a) * 1e3)
        process.append((time.process_time() - b) * 1e3)
    return statistics.median(wall), statistics.median(process)


def wall_and_balls(count: int) -> SceneSnapshot:
    """Opaque surfaces as optimised scenes have them: a wall and three balls, splats about 1.2 spacings wide."""
    rng = np.random.default_rng(0)
    back = count // 2
    wall = np.column_stack([rng.uniform(-4, 4, back), rng.uniform(-2.4, 2.4, back), np.full(back, 6.0)])
    direction = rng.normal(size=(count - back, 3))
    direction /= np.linalg.norm(direction, axis=1, keepdims=True)
    ball = np.arange(count - back) % 3
    centres = np.array([[-1.2, 0, 4.0], [0.1, 0.2, 3.4], [1.3, -0.1, 4.4]])
    balls = centres[ball] + 0.55 * direction
    spacing = np.r_[np.full(back, np.sqrt(8 * 4.8 / back)), np.full(count - back, np.sqrt(3 * 3.8 / (count - back)))]
    scales = 1.2 * spacing[:, None] * np.exp(0.3 * rng.normal(size=(count, 3))) * [0.6, 0.6, 0.6]
    return SceneSnapshot(
        1, 0, "", 0, 1, np.concatenate([wall, balls]), rng.normal(size=(count, 4)), scales,
        rng.uniform(0.6, 1.0, count), rng.uniform(size=(count, 3)), np.r_[np.zeros(back), 1 + ball], np.arange(count),
        target=np.array([0, 0, 4.0]),
    )  # fmt: skip


def resampled(path: str, count: int) -> SceneSnapshot:
    """A scene's first frame with as many Gaussians: left out, or split into smaller ones beside each other."""
    found = SceneSnapshot.from_baked(scene_hdf5.read(path))
    rng = np.random.default_rng(0)
    rows = rng.choice(len(found), count, replace=count > len(found))
    ratio = (len(found) / count) ** 0.5
    spread = found.scales[rows] * rng.normal(size=(count, 3)) * (0.7 if count > len(found) else 0)
    return SceneSnapshot(
        1, 0, "", 0, 1, found.positions[rows] + spread, found.rotations[rows], found.scales[rows] * ratio,
        found.opacities[rows], found.colours[rows], found.object_id[rows], np.arange(count), target=found.orbit_target,
    )  # fmt: skip


def camera(snapshot: SceneSnapshot, width: int, height: int) -> View:
    """At the origin, 53 degrees wide."""
    return View(np.eye(4), float(width), float(width), width / 2, height / 2, width, height)


def turned(snapshot: SceneSnapshot, view: View, degrees: float) -> View:
    """The camera further round."""
    pose = orbit_camera(view.world_to_camera, snapshot.orbit_target, np.array([0, -1.0, 0]), 0.0, degrees)
    return view.with_pose(pose)


if __name__ == "__main__":
    main()
