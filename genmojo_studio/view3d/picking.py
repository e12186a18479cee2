"""What makes the colour of a pixel: the splats under it with their exact blending weights."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from genmojo_core.clip.cameras import View
from genmojo_core.conventions import quaternion_to_matrix
from genmojo_core.render.rasterizer import ALPHA_MAX, ALPHA_MIN, TRANSMITTANCE_MIN
from genmojo_studio.view3d.gl_pieces import jacobian_limits
from genmojo_studio.view3d.look import Look, object_table
from genmojo_studio.view3d.snapshot import SceneSnapshot


@dataclass(frozen=True)
class Contributor:
    """One Gaussian's part in a pixel: row in the snapshot, weight alpha T (all of them sum to the coverage), z."""

    row: int
    uid: int
    object_id: int
    object_name: str
    weight: float
    depth: float
    opacity: float
    colour: tuple[float, float, float]


@dataclass(frozen=True)
class Pick:
    """What lies under a pixel.

    Args:
        x, y: raster pixels of the view. t: time.
        contributors: front to back.
        main: the one in which half of the pixel's light is absorbed (a floater in front does not hide the surface),
            or None where nothing is.
        position: (3,) world, the pixel's ray at the main one's depth, or None.
        color, coverage: the pixel without backdrop.
    """

    x: float
    y: float
    t: float
    contributors: tuple[Contributor, ...]
    main: Contributor | None
    position: np.ndarray | None
    color: tuple[float, float, float]
    coverage: float


def pick(snapshot: SceneSnapshot, view: View, look: Look, x: float, y: float) -> Pick:
    """The contributors of the pixel that holds (x, y), raster pixels of `view`; semantics of render/rasterizer.py.

    `snapshot` is the moment shown. Hidden objects do not count.
    """
    table = object_table(snapshot, look)
    owner = snapshot.object_index
    rows = np.flatnonzero(table.shown[owner] & snapshot.is_sound)
    place = np.array([np.floor(x) + 0.5, np.floor(y) + 0.5])
    rows, alpha, depth = _alphas(snapshot, rows, view, place, (look.splat_scale, table.offset, table.opacity))
    order = np.lexsort((rows, depth))
    rows, alpha, depth = rows[order], alpha[order], depth[order]
    left = np.cumprod(1 - alpha)
    weight = np.where(left > TRANSMITTANCE_MIN, alpha * np.concatenate([[1.0], left[:-1]]), 0.0)
    found = tuple(_contributor(snapshot, int(r), w, z) for r, w, z in zip(rows, weight, depth, strict=True) if w > 0)
    coverage = float(weight.sum())
    color = weight @ snapshot.colours[rows] if len(rows) else np.zeros(3)
    main = None
    if found:
        total = np.cumsum([c.weight for c in found])
        main = found[int(np.searchsorted(total, 0.5 * total[-1]))]
    position = None if main is None else _on_ray(view, x, y, main.depth)
    return Pick(
        x, y, snapshot.frame, found, main, position, (float(color[0]), float(color[1]), float(color[2])), coverage
    )


def _contributor(snapshot: SceneSnapshot, row: int, weight: float, depth: float) -> Contributor:
    """A row of the table."""
    object_id = int(snapshot.object_id[row])
    red, green, blue = (float(v) for v in snapshot.colours[row])
    return Contributor(row, int(snapshot.uid[row]), object_id, snapshot.object_of(object_id).name, float(weight),
                       float(depth), float(snapshot.opacities[row]), (red, green, blue))  # fmt: skip


def _alphas(
    snapshot: SceneSnapshot,
    rows: np.ndarray,
    view: View,
    place: np.ndarray,
    looks: tuple[float, np.ndarray, np.ndarray],
) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Rows that reach the pixel centre `place`, their alphas there, their depths; float64."""
    scale, offset, gain = looks
    owner = snapshot.object_index
    world = snapshot.positions[rows].astype(np.float64) + offset[owner[rows]]
    c = world @ view.world_to_camera[:3, :3].T + view.world_to_camera[:3, 3]
    keep = (c[:, 2] >= view.near) & (c[:, 2] <= view.far)
    rows, c = rows[keep], c[keep]
    centre = c[:, :2] / c[:, 2:] * [view.fx, view.fy] + [view.cx, view.cy]
    # No splat reaches further than 3.4 sigma; a row of the Jacobian is at most f / z times sqrt(1 + u^2) long.
    low_u, high_u, low_v, high_v = jacobian_limits(view)
    lean = np.sqrt(1 + max(low_u**2, high_u**2) + max(low_v**2, high_v**2))
    sigma = snapshot.scales[rows].max(axis=1) * scale * max(view.fx, view.fy) / c[:, 2] * lean
    near = np.abs(centre - place).max(axis=1) <= 3.4 * np.sqrt(sigma**2 + view.dilation)
    rows, c, centre = rows[near], c[near], centre[near]
    u = np.clip(c[:, 0] / c[:, 2], low_u, high_u)
    v = np.clip(c[:, 1] / c[:, 2], low_v, high_v)
    zero = np.zeros(len(rows))
    jacobian = np.stack([np.stack([view.fx / c[:, 2], zero, -view.fx * u / c[:, 2]], axis=1),
                         np.stack([zero, view.fy / c[:, 2], -view.fy * v / c[:, 2]], axis=1)], axis=1)  # fmt: skip
    axes = quaternion_to_matrix(snapshot.rotations[rows].astype(np.float64)) * (scale * snapshot.scales[rows, None, :])
    half = jacobian @ view.world_to_camera[:3, :3] @ axes
    conic = np.linalg.inv(half @ half.transpose(0, 2, 1) + view.dilation * np.eye(2))
    away = place - centre
    opacity = snapshot.opacities[rows].astype(np.float64) * gain[owner[rows]]
    alpha = np.minimum(ALPHA_MAX, opacity * np.exp(-0.5 * np.einsum("ni,nij,nj->n", away, conic, away)))
    seen = alpha >= ALPHA_MIN
    return rows[seen], alpha[seen], c[seen, 2]


def _on_ray(view: View, x: float, y: float, depth: float) -> np.ndarray:  # (3,) world
    """The point of a pixel's ray at a depth."""
    camera = np.array([(x - view.cx) / view.fx * depth, (y - view.cy) / view.fy * depth, depth])
    return view.world_to_camera[:3, :3].T @ (camera - view.world_to_camera[:3, 3])
