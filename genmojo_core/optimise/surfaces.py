"""The visible surface of one object in every frame: filled depth, world points and normals."""

from __future__ import annotations

from dataclasses import dataclass

import cv2
import numpy as np

from genmojo_core.clip.cameras import Cameras
from genmojo_core.clip.clip import Clip
from genmojo_core.optimise.poses import camera_centre, rays
from genmojo_core.trackers.stabilise import Grid, Layer, grid_of, layer_of, sample


@dataclass(frozen=True)
class Surface:
    """One object's surface as one frame sees it.

    Args:
        depth: (H, W) float32 z; off the object it holds the nearest object pixel's depth.
        normal: (H, W, 3) float32 world unit normals towards the camera, zero where the depth jumps.
        grid: sampling places over the object.
        points: (h, w, 3) float64 world points of the grid's places.
    """

    depth: np.ndarray
    normal: np.ndarray
    grid: Grid
    points: np.ndarray


@dataclass(frozen=True)
class ObjectSurfaces:
    """One object through the clip.

    Args:
        layer: shade and masks.
        surfaces: T surfaces, None where the object is not seen.
        cameras: cameras of all frames.
        area: (T,) visible pixels.
        size: scene units across the object where it is largest.
        measured: depth is measured; otherwise it is a guess.
    """

    layer: Layer
    surfaces: list[Surface | None]
    cameras: Cameras
    area: np.ndarray
    size: float
    measured: bool

    def world(self, t: int, xy: np.ndarray) -> np.ndarray:  # (N, 2) raster -> (N, 3) world
        """Points of the surface of frame t at image places."""
        surface = self.surfaces[t]
        if surface is None:
            return np.tile(camera_centre(self.cameras, t), (len(xy), 1))
        depth = sample(surface.depth, xy)
        return camera_centre(self.cameras, t) + rays(self.cameras, t, xy) * depth[:, None]


def object_surfaces(clip: Clip, k: int) -> ObjectSurfaces:
    """Surfaces of object k (0..K-1) of a clip that has masks, depth and cameras."""
    layer = layer_of(clip.frames, clip.masks.value, k + 1, clip.masks.valid)
    surfaces = [_surface(clip, layer, t) for t in range(len(clip))]
    spans = [_span(s) for s in surfaces if s is not None]
    size = float(np.median(spans)) if spans else 1.0
    area = layer.mask.sum(axis=(1, 2)).astype(np.float64)
    return ObjectSurfaces(layer, surfaces, clip.cameras.value, area, size, clip.depth.given)


def _surface(clip: Clip, layer: Layer, t: int) -> Surface | None:
    """The surface of frame t, or None where the object has too few pixels."""
    grid = grid_of(layer, t)
    if grid is None:
        return None
    cameras = clip.cameras.value
    depth = _filled(clip.depth.value[t], layer.mask[t] & clip.depth.valid[t], layer.mask[t])
    centre = camera_centre(cameras, t)
    h, w = depth.shape
    cells = np.stack(np.meshgrid(np.arange(w) + 0.5, np.arange(h) + 0.5), axis=-1)
    points = centre + rays(cameras, t, cells) * depth[..., None]
    normal = _normals(points, centre, layer.mask[t], grid)
    places = centre + rays(cameras, t, grid.xy.astype(np.float64)) * sample(depth, grid.xy)[..., None]
    return Surface(depth, normal, grid, places)


def _filled(depth: np.ndarray, known: np.ndarray, mask: np.ndarray) -> np.ndarray:
    """Depth of the nearest known pixel of the object, rim pixels last."""
    core = cv2.erode(known.astype(np.uint8), np.ones((3, 3), np.uint8), borderValue=0) > 0
    core = core if core.sum() > 0.3 * mask.sum() else known if known.any() else mask
    _, label = cv2.distanceTransformWithLabels((~core).astype(np.uint8), cv2.DIST_L2, 5, labelType=cv2.DIST_LABEL_PIXEL)
    table = np.zeros(int(label.max()) + 1, np.float32)
    table[label[core]] = depth[core]
    return table[label]


def _normals(points: np.ndarray, centre: np.ndarray, mask: np.ndarray, grid: Grid) -> np.ndarray:
    """World normals inside the object's box; zero where the four neighbours are not all on one smooth surface."""
    normal = np.zeros(points.shape, np.float32)
    rows, cols = np.nonzero(mask)
    box = slice(max(rows.min() - 2, 0), rows.max() + 3), slice(max(cols.min() - 2, 0), cols.max() + 3)
    patch = cv2.GaussianBlur(points[box], (0, 0), 1.0)
    across, down = np.gradient(patch, axis=1), np.gradient(patch, axis=0)
    raw = np.cross(across, down)
    raw /= np.maximum(np.linalg.norm(raw, axis=-1, keepdims=True), 1e-12)
    view = centre - patch
    view /= np.maximum(np.linalg.norm(view, axis=-1, keepdims=True), 1e-12)
    facing = (raw * view).sum(axis=-1, keepdims=True)
    inner = cv2.erode(mask[box].astype(np.uint8), np.ones((3, 3), np.uint8), borderValue=0) > 0
    normal[box] = raw * np.sign(facing) * (np.abs(facing) > 0.2) * inner[..., None]
    return normal


def _span(surface: Surface) -> float:
    """Scene units across the visible part: the larger side of its box, 5th to 95th percentile."""
    inside = surface.points[surface.grid.inside]
    return float(np.ptp(np.percentile(inside, [5, 95], axis=0), axis=0).max()) if len(inside) else 0.0
