"""Ray casting of small groups of solids: the pictures the embedded prior learns from. No file, no mesh, no library.

A solid is an affine image of the unit ball, cube or cylinder with a colour pattern in the object's coordinates. One
directional light and ambient light. The kernel is self-contained, so that its compiled form stays valid on disk.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from genmojo_core.kernels.cache import inlined, kernel

BALL, CUBE, CYLINDER = 0, 1, 2
PATTERNS = 7  # plain, stripes, waves, gradient, checker, spots, rings
HALF_EXTENT = 0.9136  # half of a picture's side at its orbit's centre: tan(49.1 / 2 degrees) x 2
SAMPLES = 2  # rays per pixel and direction


@dataclass(frozen=True)
class Solids:
    """N solids in one space (z up).

    Args:
        kinds: (N,) int64. placed: (N, 3, 4) unit solid to space.
        colours: (N, 2, 3) two RGB colours in 0..1. pattern: (N,) int64. waves: (N, 4) direction x frequency, phase.
        light: (3,) unit, towards the light. ambient: 0..1.
    """

    kinds: np.ndarray
    placed: np.ndarray
    colours: np.ndarray
    pattern: np.ndarray
    waves: np.ndarray
    light: np.ndarray
    ambient: float


@dataclass(frozen=True)
class Pictures:
    """V views: rgba (V, S, S, 4) float32 premultiplied, depth (V, S, S) mean z of the rays that hit, 0 where none."""

    rgba: np.ndarray
    depth: np.ndarray


def draw(solids: Solids, world_to_camera: np.ndarray, distance: float, side: int) -> Pictures:
    """Pictures of solids.

    Args:
        world_to_camera: (V, 4, 4) OpenCV. distance: from the camera to the plane that 2 HALF_EXTENT of it fill.
        side: pixels, of a square picture.
    """
    views, count = len(world_to_camera), len(solids.kinds)
    inverse = np.empty((views, count, 3, 4))
    normal = np.empty((count, 3, 3))
    for n in range(count):
        square = np.vstack([solids.placed[n], [0, 0, 0, 1]])
        normal[n] = np.linalg.inv(square[:3, :3]).T
        inverse[:, n] = (np.linalg.inv(square) @ np.linalg.inv(world_to_camera))[:, :3]
    to_world = np.linalg.inv(world_to_camera)[:, :3]
    rgba = np.zeros((views, side, side, 4), np.float32)
    depth = np.zeros((views, side, side), np.float32)
    light = np.append(solids.light, solids.ambient)
    look = (normal, to_world, solids.colours, solids.pattern, solids.waves, light)
    _draw((solids.kinds, inverse), look, HALF_EXTENT / distance, rgba, depth)
    return Pictures(rgba, depth)


def outline(solids: Solids) -> np.ndarray:  # (M, 3)
    """Points on the solids' surfaces, dense enough for their bounding box seen from anywhere."""
    points = []
    for n in range(len(solids.kinds)):
        local = _OUTLINES[int(solids.kinds[n])]
        points.append(local @ solids.placed[n, :, :3].T + solids.placed[n, :, 3])
    return np.concatenate(points)


def _unit_outlines() -> dict[int, np.ndarray]:
    """Points on the unit ball, the cube's corners, the cylinder's two rims."""
    turn = np.linspace(0, 2 * np.pi, 12, endpoint=False)
    ring = np.column_stack([np.cos(turn), np.sin(turn)])
    ball = [np.column_stack([ring * np.cos(a), np.full(12, np.sin(a))]) for a in np.linspace(-1.4, 1.4, 7)]
    corners = np.array([(x, y, z) for x in (-1.0, 1.0) for y in (-1.0, 1.0) for z in (-1.0, 1.0)])
    rims = np.concatenate([np.column_stack([ring, np.full(12, z)]) for z in (-1.0, 1.0)])
    return {BALL: np.concatenate(ball), CUBE: corners, CYLINDER: rims}


_OUTLINES = _unit_outlines()


@kernel
def _draw(shape: tuple, look: tuple, slope: float, rgba: np.ndarray, depth: np.ndarray) -> None:
    """Every ray of every view; shape = (kinds, inverse), look = (normal, to_world, colours, pattern, waves, light)."""
    views, side = rgba.shape[0], rgba.shape[1]
    count = len(shape[0])
    for v in range(views):
        for row in range(side):
            for column in range(side):
                hits = 0
                for sub in range(4):
                    y = ((row + 0.25 + 0.5 * (sub // 2)) / side * 2.0 - 1.0) * slope
                    x = ((column + 0.25 + 0.5 * (sub % 2)) / side * 2.0 - 1.0) * slope
                    best, owner, face = 1e30, -1, 0
                    for n in range(count):
                        there, axis = _meet(shape[0][n], shape[1][v, n], x, y)
                        if 0.0 < there < best:
                            best, owner, face = there, n, axis
                    if owner < 0:
                        continue
                    hits += 1
                    depth[v, row, column] += best
                    ray = (x * best, y * best, best)
                    shade = _shade(look, owner, shape[0][owner], _at(shape[1][v, owner], ray), face)
                    mix = _mix(look[3][owner], look[4][owner], _at(look[1][v], ray))
                    for c in range(3):
                        first, second = look[2][owner, 0, c], look[2][owner, 1, c]
                        rgba[v, row, column, c] += 0.25 * min((first + mix * (second - first)) * shade, 1.0)
                    rgba[v, row, column, 3] += 0.25
                if hits > 0:
                    depth[v, row, column] /= hits


@inlined
def _at(m: np.ndarray, p: tuple) -> tuple:
    """A point under a (3, 4) affine map."""
    return (m[0, 0] * p[0] + m[0, 1] * p[1] + m[0, 2] * p[2] + m[0, 3],
            m[1, 0] * p[0] + m[1, 1] * p[1] + m[1, 2] * p[2] + m[1, 3],
            m[2, 0] * p[0] + m[2, 1] * p[1] + m[2, 2] * p[2] + m[2, 3])  # fmt: skip


@inlined
def _meet(kind: int, m: np.ndarray, x: float, y: float) -> tuple:
    """Depth at which the ray (x, y, 1) from the camera enters a unit solid (1e30: never), and the face's axis."""
    o = (m[0, 3], m[1, 3], m[2, 3])
    d = (m[0, 0] * x + m[0, 1] * y + m[0, 2], m[1, 0] * x + m[1, 1] * y + m[1, 2],
         m[2, 0] * x + m[2, 1] * y + m[2, 2])  # fmt: skip
    if kind == BALL:
        a = d[0] * d[0] + d[1] * d[1] + d[2] * d[2]
        b = d[0] * o[0] + d[1] * o[1] + d[2] * o[2]
        root = b * b - a * (o[0] * o[0] + o[1] * o[1] + o[2] * o[2] - 1.0)
        return ((-b - np.sqrt(root)) / a if root > 0 else 1e30), 0
    if kind == CUBE:
        near, far, axis = -1e30, 1e30, 0
        for i in range(3):
            step = d[i] if abs(d[i]) > 1e-12 else 1e-12
            one, two = (-1.0 - o[i]) / step, (1.0 - o[i]) / step
            if min(one, two) > near:
                near, axis = min(one, two), i
            far = min(far, max(one, two))
        return (near if near < far else 1e30), axis
    a = max(d[0] * d[0] + d[1] * d[1], 1e-12)
    b = d[0] * o[0] + d[1] * o[1]
    root = b * b - a * (o[0] * o[0] + o[1] * o[1] - 1.0)
    if root <= 0:
        return 1e30, 0
    reach = np.sqrt(root)
    step = d[2] if abs(d[2]) > 1e-12 else 1e-12
    one, two = (-1.0 - o[2]) / step, (1.0 - o[2]) / step
    cap, around = min(one, two), (-b - reach) / a
    inside = max(cap, around) < min(max(one, two), (-b + reach) / a)
    return (max(cap, around) if inside else 1e30), (2 if cap > around else 0)


@inlined
def _shade(look: tuple, n: int, kind: int, u: tuple, face: int) -> float:
    """Light that a point u of unit solid n reflects."""
    x, y, z = u
    if kind == CUBE:
        x = np.sign(x) if face == 0 else 0.0
        y = np.sign(y) if face == 1 else 0.0
        z = np.sign(z) if face == 2 else 0.0
    elif kind == CYLINDER:
        x, y = (0.0, 0.0) if face == 2 else (x, y)
        z = np.sign(z) if face == 2 else 0.0
    m, light = look[0][n], look[5]
    nx = m[0, 0] * x + m[0, 1] * y + m[0, 2] * z
    ny = m[1, 0] * x + m[1, 1] * y + m[1, 2] * z
    nz = m[2, 0] * x + m[2, 1] * y + m[2, 2] * z
    lit = (nx * light[0] + ny * light[1] + nz * light[2]) / (np.sqrt(nx * nx + ny * ny + nz * nz) + 1e-12)
    return light[3] + (1.0 - light[3]) * max(lit, 0.0)


@inlined
def _mix(pattern: int, f: np.ndarray, p: tuple) -> float:
    """Share 0..1 of the second colour at a point p of the object's space."""
    t = p[0] * f[0] + p[1] * f[1] + p[2] * f[2] + f[3]
    size = abs(f[0]) + abs(f[1]) + abs(f[2])
    if pattern == 1:  # stripes
        return 1.0 if np.sin(t) > 0 else 0.0
    if pattern == 2:  # waves
        return 0.5 + 0.5 * np.sin(t)
    if pattern == 3:  # gradient
        return min(max(0.5 + 0.25 * t, 0.0), 1.0)
    if pattern == 4:  # checker
        s = 0.3 * size
        cells = np.floor(p[0] * s + 0.1) + np.floor(p[1] * s + 0.2) + np.floor(p[2] * s + 0.3)
        return cells - 2.0 * np.floor(cells / 2.0)
    if pattern == 5:  # spots
        s = 0.7 * size
        return 1.0 if np.sin(p[0] * s) * np.sin(p[1] * s) + np.sin(p[2] * s + f[3]) > 0.8 else 0.0
    if pattern == 6:  # rings
        return 0.5 + 0.5 * np.sin(size * np.sqrt(p[0] * p[0] + p[1] * p[1] + p[2] * p[2]) + f[3])
    return 0.0
