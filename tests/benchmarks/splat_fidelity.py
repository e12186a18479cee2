"""How exact the GL renderer is: `python -m tests.benchmarks.splat_fidelity [--scene FILE]` prints one JSON object.

PSNR in dB against the float64 compositor (ten random scenes) and the optimiser's rasteriser (five, and a scene file
from four sides); the largest error of elevation and azimuth on the way to a camera and back, in degrees.
"""

from __future__ import annotations

import argparse
import json
import sys
from pathlib import Path

import numpy as np

ROOT = Path(__file__).resolve().parents[2]
sys.path[:0] = [str(ROOT), str(ROOT / "tests")]

from genmojo_core.measure.views import orbit_view, render_frame  # noqa: E402 - after the path is set
from genmojo_core.render.cpu.rasterize import rasterize  # noqa: E402
from genmojo_core.render.rasterizer import Splats  # noqa: E402
from genmojo_core.store import scene_hdf5  # noqa: E402
from genmojo_studio.view3d.look import Look  # noqa: E402
from genmojo_studio.view3d.orbit import Orbit  # noqa: E402
from genmojo_studio.view3d.renderer import SplatRenderer  # noqa: E402
from genmojo_studio.view3d.snapshot import SceneSnapshot  # noqa: E402
from tests.view3d.scenes_gl import a_view, decibels, egl_context, random_snapshot, truth  # noqa: E402
from tests.view3d.test_orbit import reference  # noqa: E402

SIDES = ((0, 0, 0.0), (30, 0, 0.3), (0, 30, 0.6), (-10, -25, 1.0))  # elevation, azimuth, share of the clip


def main() -> None:
    """Measure and print."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--scene", help="a scene file")
    args = parser.parse_args()
    renderer = SplatRenderer(egl_context())
    found = {
        "driver": renderer.name,
        "float64_db": min(against_float64(renderer, seed) for seed in range(10)),
        "rasteriser_db": min(against_rasteriser(renderer, seed) for seed in range(5)),
        "round_trip_degrees": round_trip(),
    }
    if args.scene:
        found["scene_db"] = min(against_file(renderer, args.scene))
    print(json.dumps(found))


def against_float64(renderer: SplatRenderer, seed: int) -> float:
    """300 random Gaussians."""
    snapshot, view = random_snapshot(300, seed), a_view()
    renderer.upload(snapshot)
    return decibels(renderer.picture(view, Look()).sums[..., :3], truth(snapshot, view).features)


def against_rasteriser(renderer: SplatRenderer, seed: int) -> float:
    """3000 random Gaussians."""
    snapshot, view = random_snapshot(3000, seed, size=0.03), a_view(320, 240)
    renderer.upload(snapshot)
    parts = (snapshot.positions, snapshot.rotations, snapshot.scales, snapshot.opacities, snapshot.colours)
    return decibels(renderer.picture(view, Look()).sums[..., :3], rasterize(Splats(*parts), view).features)


def against_file(renderer: SplatRenderer, path: str) -> list[float]:
    """A scene file from four sides at four times, as `genmojo render` draws it."""
    scene = scene_hdf5.read(path)
    snapshot = SceneSnapshot.from_baked(scene)
    renderer.upload(snapshot)
    found = []
    for elevation, azimuth, share in SIDES:
        t = round(share * (len(scene) - 1))
        view = orbit_view(scene, t, elevation, azimuth, snapshot.orbit_target)
        drawn = renderer.picture(view, Look(), float(t)).sums[..., :3]
        found.append(decibels(drawn, render_frame(scene, t, view).color))
    return found


def round_trip() -> float:
    """Largest error over a thousand random views of a tilted input camera."""
    rng = np.random.default_rng(0)
    worst = 0.0
    for _ in range(1000):
        ref = reference(pitch=float(rng.uniform(-20, 20)))
        given = Orbit(float(rng.uniform(-65, 65)), float(rng.uniform(-179, 179)), float(rng.uniform(-179, 179)), 3.0)
        got = ref.orbit_of(ref.pose(given))
        errors = (got.elevation - given.elevation, got.azimuth - given.azimuth, got.roll - given.roll)
        worst = max(worst, *(abs((e + 180) % 360 - 180) for e in errors))
    return worst


if __name__ == "__main__":
    main()
