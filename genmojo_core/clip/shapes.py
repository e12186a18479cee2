"""Solid shapes of procedural clips: exact ray casting, textures that stick to the surface, simple light.

Every shape is an affine image of a unit solid (ball, cube, cylinder), at any time. A point of the unit solid is
therefore a *material point*: its place at another time is one matrix product away, which makes flow and tracks exact,
also for shapes that pulsate or sway.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal

import numpy as np

from genmojo_core.clip.cameras import View
from genmojo_core.conventions import axis_angle_matrix

Kind = Literal["ball", "cube", "cylinder"]
Vector = tuple[float, float, float]

GROUND, WALL, NOTHING = -1, -2, -3  # owners of rays that meet no shape
AMBIENT = 0.45
_PRIMES = np.array([0x8DA6B343, 0xD8163841, 0xCB1AB31F], np.uint32)
LIGHT = np.array([-0.45, -0.7, 0.55]) / np.linalg.norm([-0.45, -0.7, 0.55])  # towards the light, world


@dataclass(frozen=True)
class Shape:
    """One solid and its motion over the clip; world units, z up.

    Args:
        kind: unit solid: ball |u| <= 1, cube |u_i| <= 1, cylinder x^2 + y^2 <= 1, |z| <= 1.
        radii: half extents along its own axes.
        path: centres, evenly spaced in time, joined by straight lines.
        colours: two RGB colours in 0..1 that the pattern mixes.
        pattern: cells per unit length of the unit solid.
        checker: True for a checker pattern under the noise, False for noise alone.
        spin: degrees turned over the whole clip about `axis`; `turned` degrees at its start.
        pulse: relative change of height, `sway`: sideways lean per height, each one sine wave over the clip.
    """

    kind: Kind
    radii: Vector
    path: tuple[Vector, ...]
    colours: tuple[Vector, Vector]
    pattern: float = 2.5
    checker: bool = False
    spin: float = 0.0
    turned: float = 0.0
    axis: Vector = (0.0, 0.0, 1.0)
    pulse: float = 0.0
    sway: float = 0.0

    def matrix(self, phase: float) -> np.ndarray:
        """(4, 4) affine map from the unit solid to the world at a phase of the clip, 0..1."""
        place = np.eye(4)
        keys = np.array(self.path)
        at = np.linspace(0.0, 1.0, len(keys)) if len(keys) > 1 else np.zeros(1)
        place[:3, 3] = [np.interp(phase, at, keys[:, i]) for i in range(3)]
        wave = np.sin(2 * np.pi * phase)
        lean = np.eye(3)
        lean[0, 2] = self.sway * wave
        stretch = np.diag([1.0, 1.0, 1.0 + self.pulse * wave])
        axis = np.array(self.axis) / np.linalg.norm(self.axis)
        turn = axis_angle_matrix(axis, self.turned + self.spin * phase)
        place[:3, :3] = turn @ lean @ stretch @ np.diag(self.radii)
        return place


@dataclass(frozen=True)
class Hits:
    """The first thing each ray meets.

    Args:
        depth: (H, W) float64 z along the camera axis, inf for nothing.
        owner: (H, W) int64: 0.. index of the shape, GROUND, WALL or NOTHING.
        point: (H, W, 3) material point in the shape's unit solid; world coordinates on ground and wall.
    """

    depth: np.ndarray
    owner: np.ndarray
    point: np.ndarray


def cast(
    view: View, matrices: list[np.ndarray], kinds: list[Kind], wall: float | None, offset: tuple[float, float]
) -> Hits:
    """Cast one ray per pixel, through the point `offset` (0..1 right and down) of the pixel.

    Args:
        view: the camera. matrices: (4, 4) per shape, unit solid to world. kinds: their solids.
        wall: y of the wall behind the scene, which stands on the ground z = 0; None for shapes alone.
    """
    origin, rays = _rays(view, offset)
    hits = Hits(np.full(rays.shape[:2], np.inf), np.full(rays.shape[:2], NOTHING), np.zeros(rays.shape))
    if wall is not None:
        _cast_background(hits, origin, rays, wall)
    for k, (matrix, kind) in enumerate(zip(matrices, kinds, strict=True)):
        window = _window(view, matrix)
        inverse = np.linalg.inv(matrix)
        start = inverse[:3, :3] @ origin + inverse[:3, 3]
        way = rays[window] @ inverse[:3, :3].T
        depth = _SOLIDS[kind](start, way)
        nearer = depth < hits.depth[window]
        hits.depth[window][nearer] = depth[nearer]
        hits.owner[window][nearer] = k
        hits.point[window][nearer] = start + depth[nearer][:, None] * way[nearer]
    return hits


def first_depth(view: View, matrices: list[np.ndarray], kinds: list[Kind], xy: np.ndarray) -> np.ndarray:
    """(N,) depth of the first shape under (N, 2) raster points of a view, inf where there is none."""
    local = (xy - [view.cx, view.cy]) / [view.fx, view.fy]
    pose = np.linalg.inv(view.world_to_camera)
    rays = np.column_stack([local, np.ones(len(xy))]) @ pose[:3, :3].T
    nearest = np.full(len(xy), np.inf)
    for matrix, kind in zip(matrices, kinds, strict=True):
        inverse = np.linalg.inv(matrix)
        start = inverse[:3, :3] @ pose[:3, 3] + inverse[:3, 3]
        nearest = np.minimum(nearest, _SOLIDS[kind](start, rays @ inverse[:3, :3].T))
    return nearest


def shade(hits: Hits, shapes: tuple[Shape, ...], matrices: list[np.ndarray], light: float) -> np.ndarray:
    """(H, W, 3) float64 RGB in 0..1 of hits under a light of some strength; black where nothing was met."""
    colour = np.zeros(hits.point.shape)
    for k, (shape, matrix) in enumerate(zip(shapes, matrices, strict=True)):
        mine = hits.owner == k
        if mine.any():
            points = hits.point[mine]
            normals = _normals(shape.kind, points) @ np.linalg.inv(matrix)[:3, :3]
            normals /= np.linalg.norm(normals, axis=1, keepdims=True)
            lit = AMBIENT + (1 - AMBIENT) * light * np.maximum(normals @ LIGHT, 0)
            colour[mine] = _texture(points, shape, k) * lit[:, None]
    for owner, tint, normal in ((GROUND, (0.46, 0.42, 0.36), (0, 0, 1)), (WALL, (0.42, 0.47, 0.55), (0, -1, 0))):
        mine = hits.owner == owner
        lit = AMBIENT + (1 - AMBIENT) * light * max(0.0, float(np.array(normal) @ LIGHT))
        points = hits.point[mine]
        grain = 0.6 * noise(points * 1.7, 101 - owner) + 0.4 * noise(points * 5.0, 201 - owner)
        colour[mine] = np.array(tint) * (0.55 + 0.9 * grain[:, None]) * lit
    return np.clip(colour, 0, 1)


def noise(points: np.ndarray, seed: int) -> np.ndarray:  # (N, 3) -> (N,)
    """Smooth value noise in 0..1 with one cell per unit length: a hash of the lattice, blended by smoothstep."""
    cell = np.floor(points)
    part = points - cell
    part = part * part * (3 - 2 * part)
    lattice = cell.astype(np.int64).astype(np.uint32) * _PRIMES  # wraps around, as the hash wants it
    x, y, z = ((lattice[:, axis], lattice[:, axis] + _PRIMES[axis]) for axis in range(3))
    px, py, pz = ((1 - part[:, axis], part[:, axis]) for axis in range(3))
    total = np.zeros(len(points))
    for i in (0, 1):
        for j in (0, 1):
            column = x[i] ^ y[j] ^ np.uint32(seed * 0x9E3779B1 & 0xFFFFFFFF)
            weight = px[i] * py[j]
            for k in (0, 1):
                total += weight * pz[k] * _mixed(column ^ z[k])
    return total


def _rays(view: View, offset: tuple[float, float]) -> tuple[np.ndarray, np.ndarray]:
    """Camera centre (3,) and (H, W, 3) world directions whose camera z is 1, so that ray length is depth."""
    pose = np.linalg.inv(view.world_to_camera)
    x = (np.arange(view.width) + offset[0] - view.cx) / view.fx
    y = (np.arange(view.height) + offset[1] - view.cy) / view.fy
    local = np.stack(np.broadcast_arrays(x[None, :], y[:, None], 1.0), axis=-1)
    return pose[:3, 3], local @ pose[:3, :3].T


def _cast_background(hits: Hits, origin: np.ndarray, rays: np.ndarray, wall: float) -> None:
    """Write ground and wall hits."""
    with np.errstate(divide="ignore"):
        for owner, axis, place in ((GROUND, 2, 0.0), (WALL, 1, wall)):
            depth = (place - origin[axis]) / rays[..., axis]
            nearer = (depth > 0) & (depth < hits.depth)
            hits.depth[nearer] = depth[nearer]
            hits.owner[nearer] = owner
    met = hits.owner != NOTHING
    hits.point[met] = origin + hits.depth[met][:, None] * rays[met]


_CORNERS = np.array([(x, y, z) for x in (-1.0, 1.0) for y in (-1.0, 1.0) for z in (-1.0, 1.0)])


def _window(view: View, matrix: np.ndarray) -> tuple[slice, slice]:
    """Rows and columns that can show a shape: the box around its projected corners, all if one is behind."""
    matrix = view.world_to_camera @ matrix
    local = _CORNERS @ matrix[:3, :3].T + matrix[:3, 3]
    if (local[:, 2] <= view.near).any():
        return slice(0, view.height), slice(0, view.width)
    x = local[:, 0] / local[:, 2] * view.fx + view.cx
    y = local[:, 1] / local[:, 2] * view.fy + view.cy
    left, right = np.clip([np.floor(x.min()) - 1, np.ceil(x.max()) + 1], 0, view.width).astype(int)
    top, bottom = np.clip([np.floor(y.min()) - 1, np.ceil(y.max()) + 1], 0, view.height).astype(int)
    return slice(top, bottom), slice(left, right)


def _ball(start: np.ndarray, way: np.ndarray) -> np.ndarray:
    """Depth of the first meeting with |u| = 1."""
    a, b, c = (way * way).sum(-1), way @ start, start @ start - 1
    root = b * b - a * c
    depth = (-b - np.sqrt(np.maximum(root, 0))) / a
    return np.where((root > 0) & (depth > 0), depth, np.inf)


def _cube(start: np.ndarray, way: np.ndarray) -> np.ndarray:
    """Depth of the first meeting with the cube |u_i| <= 1."""
    safe = np.where(np.abs(way) < 1e-300, 1e-300, way)
    one, two = (-1 - start) / safe, (1 - start) / safe
    enter = np.minimum(one, two).max(-1)
    leave = np.maximum(one, two).min(-1)
    return np.where((enter < leave) & (enter > 0), enter, np.inf)


def _cylinder(start: np.ndarray, way: np.ndarray) -> np.ndarray:
    """Depth of the first meeting with the cylinder about z."""
    a = np.maximum((way[..., :2] ** 2).sum(-1), 1e-300)
    b, c = way[..., :2] @ start[:2], start[:2] @ start[:2] - 1
    root = b * b - a * c
    reach = np.sqrt(np.maximum(root, 0))
    z = np.where(np.abs(way[..., 2]) < 1e-300, 1e-300, way[..., 2])
    ends = np.stack([(-1 - start[2]) / z, (1 - start[2]) / z])
    enter = np.maximum((-b - reach) / a, ends.min(0))
    leave = np.minimum((-b + reach) / a, ends.max(0))
    return np.where((root > 0) & (enter < leave) & (enter > 0), enter, np.inf)


_SOLIDS = {"ball": _ball, "cube": _cube, "cylinder": _cylinder}


def _normals(kind: Kind, points: np.ndarray) -> np.ndarray:
    """(N, 3) outward normals of the unit solid (not unit length)."""
    if kind == "ball":
        return points
    if kind == "cube":
        largest = np.abs(points).argmax(1)
        return np.where(np.arange(3) == largest[:, None], np.sign(points), 0.0)
    cap = np.abs(points[:, 2]) > 1 - 1e-9
    return np.where(cap[:, None], points * [0, 0, 1], points * [1, 1, 0])


def _texture(points: np.ndarray, shape: Shape, seed: int) -> np.ndarray:
    """(N, 3) colours: two colours mixed by noise or a checker, with a finer grain that makes every place differ."""
    scaled = points * shape.pattern
    if shape.checker:
        # shifted, so that no cell border lies in a face of the cube, where rounding would decide
        mix = (np.floor(scaled + 0.37).astype(np.int64).sum(1) & 1).astype(np.float64)
    else:
        mix = np.clip(2.2 * noise(scaled, seed) - 0.6, 0, 1)
    grain = 0.65 + 0.7 * noise(scaled * 1.6 + 7.3, seed + 50)
    first, second = np.array(shape.colours)
    return np.clip((first + (second - first) * mix[:, None]) * grain[:, None], 0, 1)


def _mixed(key: np.ndarray) -> np.ndarray:
    """(N,) float64 in 0..1 from (N,) uint32 keys (the finaliser of MurmurHash3)."""
    key = (key ^ (key >> np.uint32(16))) * np.uint32(0x85EBCA6B)
    key = (key ^ (key >> np.uint32(13))) * np.uint32(0xC2B2AE35)
    return (key ^ (key >> np.uint32(16))) * 2.0**-32
