"""The same pictures as the GL renderer's, drawn by the optimiser's processor kernels: where OpenGL is missing or slow.

Colour, depth, shares, flow, normals, errors and centres are exact; the median depth is found between 45 depths; an
ellipsoid is a splat with a hard edge, lit by the angle of its thin axis.
"""

from __future__ import annotations

from collections import OrderedDict
from dataclasses import replace

import numpy as np

from genmojo_core.clip.cameras import View
from genmojo_core.conventions import normalise_quaternions, quaternion_to_matrix
from genmojo_core.render.rasterizer import Splats
from genmojo_studio.view3d.look import Look, Mode, ObjectTable, object_table
from genmojo_studio.view3d.orbit import next_pose
from genmojo_studio.view3d.quality import FULL, Picture, Quality
from genmojo_studio.view3d.snapshot import SceneSnapshot

_DEPTHS = 45  # thresholds of the median depth
_CACHED_BYTES = 256 << 20
_HARD = 500.0  # an opacity at which a splat is solid up to a sharp edge
_SHELL = 0.22  # alpha at the surface of an ellipsoid
_DOT_PIXELS = 1.2


def warm_up() -> None:
    """Load the kernels, or compile them where they never ran, by drawing one Gaussian: before there is a scene."""
    one = np.ones(1)
    snapshot = SceneSnapshot(0, 0, "", 0, 1, np.array([[0, 0, 1]]), np.array([[1, 0, 0, 0]]), np.full((1, 3), 0.1), one,
                             np.ones((1, 3)), one, one)  # fmt: skip
    painter = CpuPainter()
    painter.upload(snapshot)
    painter.picture(View(np.eye(4), 16.0, 16.0, 8.0, 8.0, 16, 16), Look())


class CpuPainter:
    """Draws snapshots without OpenGL; safe to use from one thread at a time, which need not be the UI's."""

    def __init__(self) -> None:
        self._snapshot: SceneSnapshot | None = None
        self._frames: OrderedDict[int, SceneSnapshot] = OrderedDict()
        self._residuals: np.ndarray | None = None
        self._shuffle = np.zeros(0, np.int64)

    def upload(self, snapshot: SceneSnapshot) -> None:
        """Take a snapshot."""
        if snapshot is not self._snapshot:
            self._snapshot, self._residuals = snapshot, None
            self._frames.clear()
            if len(self._shuffle) != len(snapshot):
                self._shuffle = np.random.default_rng(0).permutation(len(snapshot))

    def set_residuals(self, values: np.ndarray) -> None:
        """One number per splat (N,), shown by Mode.RESIDUAL."""
        self._residuals = values

    def picture(self, view: View, look: Look, t: float | None = None, quality: Quality = FULL) -> Picture:
        """The mode's sums (H, W, 4) for a view at time t, as `SplatRenderer.picture` gives them."""
        if quality.scale != 1.0:
            view = view.resized(*quality.size(view.width, view.height))
        if self._snapshot is None or len(self._snapshot) == 0:
            return Picture(np.zeros((view.height, view.width, 4), np.float32))
        snapshot = self.moment(t)
        table = object_table(self._snapshot, look)
        rows = np.flatnonzero(table.shown[snapshot.object_index] & snapshot.is_sound)
        if quality.stride > 1:
            kept = self._shuffle[:: quality.stride]
            rows = np.sort(kept[np.isin(kept, rows, assume_unique=True)])
        shown = _rows(snapshot, rows, table)
        thicker = look.splat_scale * quality.stride**0.5
        splats = Splats(shown.positions, shown.rotations, shown.scales * np.float32(thicker), shown.opacities,
                        np.zeros((len(rows), 0), np.float32))  # fmt: skip
        return Picture(self._sums(shown, rows, splats, view, (look, table, t)))

    def moment(self, t: float | None) -> SceneSnapshot:
        """The snapshot at a time, between frames interpolated as the GL renderer does."""
        if self._snapshot is None:
            raise ValueError("nothing was uploaded")
        snapshot = self._snapshot
        if t is None or snapshot.frames is None:
            return snapshot
        t = min(max(float(t), 0.0), snapshot.T - 1.0)
        first = int(t)
        a = self._frame(first)
        if t == first:
            return a
        b, s = self._frame(first + 1), np.float32(t - first)
        flip = np.where(np.sum(a.rotations * b.rotations, axis=1, keepdims=True) < 0, -1, 1).astype(np.float32)
        return replace(
            a, positions=a.positions + s * (b.positions - a.positions),
            rotations=normalise_quaternions(a.rotations + s * (b.rotations * flip - a.rotations)),
            scales=np.maximum(a.scales, 1e-30) ** (1 - s) * np.maximum(b.scales, 1e-30) ** s,
            colours=a.colours + s * (b.colours - a.colours),
        )  # fmt: skip

    def _frame(self, t: int) -> SceneSnapshot:
        """A frame, kept while there is memory for it."""
        snapshot = self._snapshot
        if snapshot is None:
            raise ValueError("nothing was uploaded")
        if t in self._frames:
            self._frames.move_to_end(t)
        else:
            self._frames[t] = snapshot.at(t)
            if len(self._frames) * len(snapshot) * 60 > _CACHED_BYTES and len(self._frames) > 2:
                self._frames.popitem(last=False)
        return self._frames[t]

    def _sums(
        self, shown: SceneSnapshot, rows: np.ndarray, splats: Splats[np.ndarray], view: View,
        how: tuple[Look, ObjectTable, float | None],
    ) -> np.ndarray:  # fmt: skip
        """(H, W, 4): three channels of the mode and coverage."""
        # Imported here: it loads the compiled kernels, which a window with OpenGL does not need.
        from genmojo_core.render.cpu.rasterize import rasterize

        look, table, t = how
        if look.mode == Mode.DEPTH_MEDIAN:
            return _median(splats, view)
        features = self._features(shown, rows, view, how)
        if look.mode == Mode.CENTRES:
            dot = _DOT_PIXELS * max(1.0, view.height / 720)
            splats = replace(splats, scales=np.full_like(splats.scales, 1e-9), opacities=_full(splats, _HARD))
            view = replace(view, dilation=(dot / 4) ** 2)
        elif look.mode == Mode.ELLIPSOIDS:
            reach = np.sqrt(2 * np.log(np.maximum(splats.opacities / _SHELL, 1.0)))[:, None]
            edge = np.float32(np.sqrt(2 * np.log(2 * _HARD)))
            solid = np.where(splats.opacities > _SHELL, np.float32(_HARD), np.float32(0))
            splats = replace(splats, scales=splats.scales * reach / edge, opacities=solid)
        drawn = rasterize(replace(splats, features=features), view)
        sums = np.zeros((*drawn.alpha.shape, 4), np.float32)
        sums[..., 3] = drawn.alpha
        if look.mode == Mode.DEPTH:
            sums[..., 0] = drawn.depth
        elif look.mode == Mode.INSTANCE:
            sums[..., 0], sums[..., 1] = drawn.features.argmax(axis=-1), drawn.features.max(axis=-1)
        else:
            sums[..., : features.shape[1]] = drawn.features
        return sums

    def _features(
        self, shown: SceneSnapshot, rows: np.ndarray, view: View, how: tuple[Look, ObjectTable, float | None]
    ) -> np.ndarray:  # (M, C)
        """What is blended in a mode."""
        look, table, t = how
        owner = shown.object_index
        if look.mode in (Mode.RGB, Mode.CENTRES, Mode.ELLIPSOIDS):
            mix = table.tint[owner, 3:]
            rgb = shown.colours * (1 - mix) + table.tint[owner, :3] * mix
            if look.mode == Mode.ELLIPSOIDS:
                axis, towards = _thin_axes(shown), shown.positions - _centre(view)
                slope = np.abs(np.sum(axis * towards, axis=1)) / np.maximum(np.linalg.norm(towards, axis=1), 1e-12)
                rgb = rgb * (0.55 + 0.45 * slope[:, None])
            return rgb.astype(np.float32)
        if look.mode == Mode.INSTANCE:
            return np.eye(len(table.shown), dtype=np.float32)[owner]
        if look.mode == Mode.INSTANCE_SOFT:
            return table.color[owner]
        if look.mode == Mode.NORMAL:
            axis, towards = _thin_axes(shown), shown.positions - _centre(view)
            axis *= -np.where(np.sum(axis * towards, axis=1, keepdims=True) > 0, 1, -1)
            return (axis @ view.world_to_camera[:3, :3].T).astype(np.float32)
        if look.mode == Mode.FLOW:
            return self._flow(shown, rows, view, how)
        if look.mode == Mode.RESIDUAL and self._residuals is not None:
            return self._residuals[rows, None].astype(np.float32)
        return np.zeros((len(rows), 1 if look.mode == Mode.RESIDUAL else 0), np.float32)

    def _flow(
        self, shown: SceneSnapshot, rows: np.ndarray, view: View, how: tuple[Look, ObjectTable, float | None]
    ) -> np.ndarray:  # (M, 2) pixels
        """Motion of projected centres to the next frame, the input camera's own motion included."""
        _, table, t = how
        time = float(shown.frame if t is None or self._snapshot is None or self._snapshot.frames is None else t)
        after = self.moment(min(time + 1, shown.T - 1)).positions[rows] + table.offset[shown.object_index]
        moved = view.with_pose(next_pose(shown.cameras, view, time))
        return (_pixels(after, moved) - _pixels(shown.positions, view)).astype(np.float32)


def _median(splats: Splats[np.ndarray], view: View) -> np.ndarray:  # (H, W, 4)
    """Depth where half of the light is absorbed: coverage in front of many depths, interpolated."""
    from genmojo_core.render.cpu.rasterize import rasterize

    z = splats.means @ view.world_to_camera[2, :3].astype(np.float32) + np.float32(view.world_to_camera[2, 3])
    inside = z[(z >= view.near) & (z <= view.far)]
    sums = np.zeros((view.height, view.width, 4), np.float32)
    if not len(inside):
        return sums
    steps = np.quantile(inside, np.linspace(0, 1, _DEPTHS + 1)).astype(np.float32)
    features = (z[:, None] <= steps[None, 1:]).astype(np.float32)
    absorbed = rasterize(replace(splats, features=features), view).features  # (H, W, _DEPTHS), rising
    absorbed = np.concatenate([np.zeros_like(absorbed[..., :1]), absorbed], axis=-1)
    found = absorbed[..., -1] >= 0.5
    first = np.clip(np.argmax(absorbed >= 0.5, axis=-1), 1, _DEPTHS)
    below, above = (np.take_along_axis(absorbed, (first - k)[..., None], axis=-1)[..., 0] for k in (1, 0))
    share = np.clip((0.5 - below) / np.maximum(above - below, 1e-6), 0, 1)
    depth = steps[first - 1] + share * (steps[first] - steps[first - 1])
    sums[..., 0], sums[..., 3] = np.where(found, depth, 0), found
    return sums


def _rows(snapshot: SceneSnapshot, rows: np.ndarray, table: ObjectTable) -> SceneSnapshot:
    """Some rows of a snapshot with the objects' offsets and opacities applied."""
    owner = snapshot.object_index[rows]
    return replace(
        snapshot, positions=snapshot.positions[rows] + table.offset[owner], rotations=snapshot.rotations[rows],
        scales=snapshot.scales[rows], opacities=np.minimum(snapshot.opacities[rows] * table.opacity[owner], 1.0),
        colours=snapshot.colours[rows], object_id=snapshot.object_id[rows], uid=snapshot.uid[rows],
        objects=_all_objects(snapshot), frames=None,
    )  # fmt: skip


def _all_objects(snapshot: SceneSnapshot) -> tuple:
    """Every object with a name, so that a subset of rows keeps the order of the object table."""
    return tuple(snapshot.object_of(int(i)) for i in snapshot.object_ids)


def _thin_axes(snapshot: SceneSnapshot) -> np.ndarray:  # (N, 3) world
    """The axis of every splat along which it is thinnest."""
    axes = quaternion_to_matrix(snapshot.rotations)
    return np.take_along_axis(axes, snapshot.scales.argmin(axis=1)[:, None, None], axis=2)[..., 0]


def _centre(view: View) -> np.ndarray:
    """Where the camera is, world."""
    return -view.world_to_camera[:3, :3].T @ view.world_to_camera[:3, 3]


def _pixels(means: np.ndarray, view: View) -> np.ndarray:  # (N, 3) world -> (N, 2) px
    """Projection of centres; those nearer than the near plane as if they lay on it."""
    camera = means @ view.world_to_camera[:3, :3].T + view.world_to_camera[:3, 3]
    z = np.maximum(camera[:, 2:], view.near)
    return camera[:, :2] / z * [view.fx, view.fy] + [view.cx, view.cy]


def _full(splats: Splats[np.ndarray], value: float) -> np.ndarray:
    """(N,) float32 of one value."""
    return np.full(len(splats.means), value, np.float32)
