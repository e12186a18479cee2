"""The fixed workload of the rasteriser's benchmark: objects on shells in front of a background sheet."""

from __future__ import annotations

import numpy as np

from genmojo_core.clip.cameras import View
from genmojo_core.conventions import axis_angle_matrix
from genmojo_core.kernels.stage import alone
from genmojo_core.render.cpu.project import Ellipses, lens_of, project_splats
from genmojo_core.render.cpu.rasterize import Cloud
from genmojo_core.render.rasterizer import Splats

SIZES = ((128, 128), (256, 256), (480, 270), (960, 540))
COUNTS = (2_000, 10_000, 50_000)
FLOW, LABELS = 2, 4
CHANNELS = 3 + LABELS + FLOW


def view_of(width: int, height: int) -> View:
    """Distance 4, yaw 0.15, pitch -0.1 rad, 50 degrees on the longer side."""
    focal = 0.5 * max(width, height) / np.tan(np.deg2rad(25.0))
    pose = np.eye(4)
    pose[:3, :3] = axis_angle_matrix(np.array([1.0, 0, 0]), np.rad2deg(-0.1)) @ axis_angle_matrix(
        np.array([0, 1.0, 0]), np.rad2deg(0.15)
    )
    pose[2, 3] = 4.0
    return View(pose, focal, focal, width / 2, height / 2, width, height)


def scene(count: int, width: int, height: int, seed: int = 0) -> Splats[np.ndarray]:
    """80 % of the splats on four ellipsoid shells, 20 % on a sheet at depth 7; float32, flow in the last channels.

    The size of the object splats is found by bisection so that their median 3-sigma radius on the screen is
    clip(4.5 sqrt(1e4 / count) height / 256, 3, 6) pixels.
    """
    rng = np.random.default_rng(seed)
    view = view_of(width, height)
    objects = int(0.8 * count)
    means = np.concatenate([_shells(rng, objects), _sheet(rng, count - objects, view)])
    quats = rng.normal(size=(count, 4))
    shape = np.exp(0.45 * rng.normal(size=(objects, 3))) * np.array([1, 1, 0.35])
    opacities = 1 / (1 + np.exp(-(1 + 1.5 * rng.normal(size=count))))
    target = float(np.clip(4.5 * np.sqrt(1e4 / count) * height / 256, 3, 6))
    spacing = 1.1 * 7 * max(width, height) / view.fx / np.sqrt(count - objects)
    sheet = 0.7 * spacing * np.exp(0.3 * rng.normal(size=(count - objects, 3)))
    low, high = 1e-4, 1.0
    for _ in range(40):
        size = np.sqrt(low * high)
        if _median_radius(means[:objects], quats[:objects], size * shape, view) < target:
            low = size
        else:
            high = size
    labels = np.eye(LABELS)[np.arange(count) * LABELS // count]
    features = np.concatenate([rng.uniform(size=(count, 3)), labels, rng.normal(size=(count, FLOW))], axis=1)
    order = rng.permutation(count)
    arrays = (means, quats, np.concatenate([size * shape, sheet]), opacities, features)
    return Splats(*(np.ascontiguousarray(a[order], dtype=np.float32) for a in arrays))


def count_pairs(drawn: object) -> int:
    """(splat, pixel) pairs that a finished drawing blended, replayed per tile in numpy."""
    from genmojo_core.render.cpu.project import GEOMETRY

    bins, drawing = drawn.bins, drawn.passes[0].drawing
    width = GEOMETRY + drawing.slots
    records = drawing.records[: len(bins.order) * width].reshape(-1, width)[:, :GEOMETRY].astype(np.float64)
    pairs = 0
    y, x = np.meshgrid(np.arange(16) + 0.5, np.arange(16) + 0.5, indexing="ij")
    for tile in range(bins.tiles_x * bins.tiles_y):
        left, top = tile % bins.tiles_x * 16, tile // bins.tiles_x * 16
        inside = (x + left < drawing.width) & (y + top < drawing.height)
        ranks = bins.rank[bins.tile_start[tile] : bins.tile_start[tile + 1]]
        transmittance = np.where(inside, 1.0, 0.0)
        for start in range(0, len(ranks), 64):
            r = records[ranks[start : start + 64]]
            dx, dy = x[None] + left - r[:, 0, None, None], y[None] + top - r[:, 1, None, None]
            e = r[:, 5, None, None] + r[:, 2, None, None] * dx**2 + r[:, 3, None, None] * dx * dy
            e = e + r[:, 4, None, None] * dy**2
            alpha = np.where(e >= np.log2(1 / 255), np.minimum(np.exp2(np.minimum(e, 0.0)), 0.99), 0.0)
            after = transmittance * np.cumprod(1 - alpha, axis=0)
            pairs += int(((after > 1e-4) & (alpha > 0)).sum())
            transmittance = np.where(after[-1] > 1e-4, after[-1], 0.0)
            if not transmittance.any():
                break
    return pairs


def _shells(rng: np.random.Generator, count: int) -> np.ndarray:
    """Points on four ellipsoids with radii 0.35..0.6 and 3 % noise, centres within 0.9 of the origin."""
    parts = []
    for k in range(4):
        number = count // 4 + (k < count % 4)
        direction = rng.normal(size=(number, 3))
        direction /= np.linalg.norm(direction, axis=1, keepdims=True)
        radii = rng.uniform(0.35, 0.6, size=3) * (1 + 0.03 * rng.normal(size=(number, 1)))
        parts.append(direction * radii + rng.uniform(-0.9, 0.9, size=3))
    return np.concatenate(parts)


def _sheet(rng: np.random.Generator, count: int, view: View) -> np.ndarray:
    """Points near camera depth 7 on a jittered grid over 1.1 times the frustum, in world coordinates."""
    side = int(np.ceil(np.sqrt(count)))
    grid = np.stack(np.meshgrid(np.arange(side), np.arange(side)), axis=-1).reshape(-1, 2)[:count]
    uv = ((grid + rng.uniform(size=(count, 2))) / side - 0.5) * 1.1
    z = 7 + rng.uniform(-0.3, 0.3, size=count)
    camera = np.stack([uv[:, 0] * view.width / view.fx * z, uv[:, 1] * view.height / view.fy * z, z], axis=1)
    return (camera - view.world_to_camera[:3, 3]) @ view.world_to_camera[:3, :3]


def _median_radius(means: np.ndarray, quats: np.ndarray, scales: np.ndarray, view: View) -> float:
    """Median over splats of three times the larger standard deviation on the screen, dilation included."""
    count = len(means)
    arrays = (means, quats, scales, np.ones(count))
    cloud = Cloud(*(np.ascontiguousarray(a, dtype=np.float32) for a in arrays))
    out = Ellipses(
        np.zeros((count, 6), np.float32),
        np.zeros(count, np.float32),
        np.zeros((count, 4), np.int32),
        np.zeros(2, np.int64),
    )
    project_splats(alone(count), lens_of(view), cloud, out)
    seen = out.box[:, 0] <= out.box[:, 1]
    a, b, c = out.geometry[seen, 2] * -2, -out.geometry[seen, 3], out.geometry[seen, 4] * -2
    smallest = (a + c) / 2 - np.sqrt(((a - c) / 2) ** 2 + b**2)
    return float(np.median(3 * np.sqrt(1.4426950408889634 / np.maximum(smallest, 1e-12))))
