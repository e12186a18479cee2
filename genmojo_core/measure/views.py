"""Pictures of a baked scene: colour, coverage, depth, labels and flow of any frame from any camera."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal

import numpy as np

from genmojo_core.clip.cameras import View
from genmojo_core.conventions import dc_to_rgb, normalise_quaternions, orbit_camera, quaternion_to_matrix, shade_factors
from genmojo_core.errors import GenmojoError
from genmojo_core.render.cpu.rasterize import rasterize
from genmojo_core.render.rasterizer import Splats
from genmojo_core.store.scene_file import BakedScene, Frame

ALPHA_FOR_DEPTH = 1e-4  # below this coverage a pixel has no depth (and no flow)
WHITE = (1.0, 1.0, 1.0)
BLACK = (0.0, 0.0, 0.0)


@dataclass(frozen=True)
class Picture:
    """One rendered frame, H x W pixels, K objects in the scene's order.

    Args:
        color: (H, W, 3) float32 premultiplied RGB, not clamped.
        alpha: (H, W) coverage 0..1.
        depth: (H, W) z in scene units, alpha-normalised; 0 where alpha < 1e-4.
        labels: (H, W, K) premultiplied share of every object; sums to alpha.
        flow: (H, W, 2) pixels to the next frame, alpha-normalised, or None.
        backdrop: what lies behind by default: white behind objects alone, black behind a scene with its background,
            as while it was optimised.
        normal: (H, W, 3) thinnest axis of the Gaussians, turned towards the camera, in its axes with y and z turned
            round (x right, y up, z to the viewer), alpha-normalised, or None.
    """

    color: np.ndarray
    alpha: np.ndarray
    depth: np.ndarray
    labels: np.ndarray
    flow: np.ndarray | None = None
    backdrop: tuple[float, float, float] = WHITE
    normal: np.ndarray | None = None

    def on(self, backdrop: tuple[float, float, float] | np.ndarray | None = None) -> np.ndarray:
        """(H, W, 3) float32 0..1 colour over a backdrop (one colour or an image; None: the picture's own), clamped."""
        behind = self.backdrop if backdrop is None else backdrop
        rest = (1.0 - self.alpha)[..., None] * np.asarray(behind, np.float32)
        return np.clip(self.color + rest, 0.0, 1.0)

    def straight_rgba(self) -> np.ndarray:  # (H, W, 4) uint8
        """Colour divided by coverage, and the coverage: what PNG wants."""
        rgb = self.color / np.maximum(self.alpha, 1e-6)[..., None]
        rgba = np.concatenate([np.clip(rgb, 0, 1), np.clip(self.alpha, 0, 1)[..., None]], axis=-1)
        rgba[self.alpha < 0.5 / 255] = 0
        return np.round(rgba * 255).astype(np.uint8)

    def instance(self, threshold: float = 0.5) -> np.ndarray:  # (H, W) int64, -1 = nothing there
        """Position (in the scene's objects) of the object with the largest share, where alpha > threshold."""
        if self.labels.shape[-1] == 0:
            return np.full(self.alpha.shape, -1)
        return np.where(self.alpha > threshold, np.argmax(self.labels, axis=-1), -1)


@dataclass(frozen=True)
class Look:
    """What to draw: everything or the objects alone, which change of colour over time, flow to which view.

    Args:
        objects_only: leave the background out.
        color_change: "all"; "light" keeps only one gain per frame and channel for the whole scene; "none" drops it (to
            see how much of the fit each explains).
        flow_to: camera of the next frame, or None for no flow.
        normals: also draw normals.
    """

    objects_only: bool = False
    color_change: Literal["all", "light", "none"] = "all"
    flow_to: View | None = None
    normals: bool = False


def render_frame(scene: BakedScene, t: float, view: View, look: Look = Look()) -> Picture:  # noqa: B008 - frozen
    """Draw time t (0..T-1, fractions between frames) from a camera.

    Flow is the projection at t + 1 through `look.flow_to` minus the one at t through `view` (last frame: no motion of
    objects). Raises GenmojoError("empty") for a file without Gaussians, "argument" for a frame that is not there.
    """
    if len(scene.xyz) == 0:
        raise GenmojoError("empty", "holds tracks but no Gaussians", "scene", "give a scene written by optimize")
    if not 0 <= t <= len(scene) - 1:
        raise GenmojoError("argument", f"there is no frame {t}, the scene has {len(scene)}", "scene")
    frame = scene.frame_at(t)
    owner = frame.object_index
    background = np.array([o.is_background for o in scene.objects])
    keep = ~background[owner] if look.objects_only else np.ones(len(owner), bool)
    rgb = _colors(scene, frame, look)
    parts = [rgb, np.eye(len(scene.objects), dtype=np.float32)[owner]]
    if look.flow_to is not None:
        after = scene.frame_at(min(t + 1, len(scene) - 1))
        parts.append(_pixels(after.means, look.flow_to) - _pixels(frame.means, view))
    if look.normals:
        parts.append(_normals(frame, view))
    features = np.concatenate(parts, axis=1).astype(np.float32)
    splats = Splats(frame.means[keep], frame.quats[keep], frame.scales[keep], frame.opacities[keep], features[keep])
    drawn = rasterize(splats, view)
    count = 3 + len(scene.objects)
    seen = drawn.alpha >= ALPHA_FOR_DEPTH
    share = np.where(seen, drawn.alpha, 1.0)
    flow = None
    if look.flow_to is not None:
        flow = np.where(seen[..., None], drawn.features[..., count : count + 2] / share[..., None], 0)
    normal = np.where(seen[..., None], drawn.features[..., -3:] / share[..., None], 0) if look.normals else None
    depth = np.where(seen, drawn.depth / share, 0.0).astype(np.float32)
    backdrop = BLACK if background[owner[keep]].any() else WHITE
    return Picture(drawn.features[..., :3], drawn.alpha, depth, drawn.features[..., 3:count], flow, backdrop, normal)


def orbit_target(scene: BakedScene) -> np.ndarray:  # (3,) world
    """What views turn about: the median of the objects' Gaussians over all frames (of everything if no object)."""
    background = np.array([o.is_background for o in scene.objects])
    points = []
    for t in range(len(scene)):
        frame = scene.frame(t)
        rows = ~background[frame.object_index]
        points.append(frame.means[rows] if rows.any() else frame.means)
    return np.median(np.concatenate(points), axis=0).astype(np.float64)


def orbit_view(scene: BakedScene, t: int, elevation: float, azimuth: float, target: np.ndarray) -> View:
    """The input camera of frame t turned rigidly by (elevation, azimuth) degrees about a target (3,)."""
    view = scene.cameras.view(t)
    if elevation == 0 and azimuth == 0:
        return view
    return view.with_pose(orbit_camera(view.world_to_camera, target, scene.world_up, elevation, azimuth))


def short_side_size(size: tuple[int, int], short_side: int) -> tuple[int, int]:
    """(width, height) of an image of `size` with its short side brought to `short_side` pixels."""
    scale = short_side / min(size)
    return max(1, round(size[0] * scale)), max(1, round(size[1] * scale))


def _colors(scene: BakedScene, frame: Frame, look: Look) -> np.ndarray:  # (N, 3) 0..1 and more
    """Colours with the change over time that is wanted.

    Light is the scene's shading, then the gain g of every channel that brings the colours nearest to the frame's:
    least squares, every Gaussian weighted by its opacity.
    """
    if scene.d_dc is None or look.color_change == "all":
        return frame.rgb
    constant = dc_to_rgb(scene.dc)
    if look.color_change == "none":
        return constant
    constant = constant * _shading(scene, frame)
    weighted = frame.opacities[:, None] * constant
    gain = (weighted * frame.rgb).sum(axis=0) / np.maximum((weighted * constant).sum(axis=0), 1e-9)
    return constant * gain


def _shading(scene: BakedScene, frame: Frame) -> np.ndarray:  # (N, 1)
    """What the light does to colours because objects turn under it (scene/shading.py); ones in a scene without."""
    found = [row.get("settings") for row in scene.effects if row.get("name") == "shading" and row.get("on")]
    if not found or not found[0]:
        return np.ones((len(frame.means), 1))
    own = quaternion_to_matrix(normalise_quaternions(scene.rot))
    thin = np.argmin(scene.scale, axis=1)[:, None, None]
    local = np.take_along_axis(own, thin, axis=2)[..., 0]
    sign = np.where((local * scene.xyz).sum(axis=1, keepdims=True) < 0, -1.0, 1.0)
    first = np.stack([scene.object_to_world[t, k, :, :3] for k, t in enumerate(scene.ref_frame)]).astype(np.float64)
    first /= np.cbrt(np.linalg.det(first))[:, None, None]
    before = np.einsum("nij,nj->ni", first[frame.object_index], sign * local)
    now = sign * np.take_along_axis(quaternion_to_matrix(frame.quats), thin, axis=2)[..., 0]
    factor = shade_factors(before, now, np.array([found[0][str(k)] for k in range(len(found[0]))]))
    fixed = np.array([o.is_background for o in scene.objects])[frame.object_index]
    return np.where(fixed, 1.0, factor)[:, None]


def _normals(frame: Frame, view: View) -> np.ndarray:  # (N, 3)
    """Thinnest axis of every Gaussian, turned towards the camera: x right, y up, z to the viewer."""
    axes = quaternion_to_matrix(frame.quats)
    thin = np.take_along_axis(axes, np.argmin(frame.scales, axis=1)[:, None, None], axis=2)[..., 0]
    rotation = view.world_to_camera[:3, :3]
    local, ray = thin @ rotation.T, frame.means @ rotation.T + view.world_to_camera[:3, 3]
    facing = np.where((local * ray).sum(1, keepdims=True) > 0, -local, local)
    return facing * np.array([1.0, -1.0, -1.0])


def _pixels(means: np.ndarray, view: View) -> np.ndarray:  # (N, 3) world -> (N, 2) px
    """Projection of centres; centres nearer than the near plane are projected as if they lay on it."""
    camera = means @ view.world_to_camera[:3, :3].T + view.world_to_camera[:3, 3]
    z = np.maximum(camera[:, 2:], view.near)
    return camera[:, :2] / z * [view.fx, view.fy] + [view.cx, view.cy]
