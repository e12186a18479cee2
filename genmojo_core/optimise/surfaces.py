"""The visible surface of one object in every frame: filled depth, world points and normals."""

from __future__ import annotations

from dataclasses import dataclass, replace

import cv2
import numpy as np

from genmojo_core.clip.cameras import Cameras
from genmojo_core.clip.clip import Channel, Clip
from genmojo_core.errors import GenmojoError
from genmojo_core.optimise.poses import camera_centre, rays
from genmojo_core.trackers.stabilise import Grid, Layer, grid_of, sample

_AROUND = 8  # pixels of the window around the object's box


@dataclass(frozen=True)
class Patch:
    """Depth of one object in a window of a frame; off the object it goes on with the nearest object pixel's.

    Args:
        left, top: of the window, whole pixels.
        depth: (h, w) float32 z in scene units.
    """

    left: int
    top: int
    depth: np.ndarray

    def lookup(self, image: np.ndarray, xy: np.ndarray) -> np.ndarray:
        """Bilinear values of an image of the window's size at raster places (..., 2), border replicated."""
        return sample(image, xy - np.array([self.left, self.top]), cv2.BORDER_REPLICATE)


@dataclass(frozen=True)
class Surface:
    """One object's surface as one frame sees it.

    Args:
        patch: depth in a window.
        normal: (h, w, 3) float32 world unit normals towards the camera in that window, zero where unknown.
        grid: sampling places over the object.
        points: (gh, gw, 3) float64 world points of the grid's places.
    """

    patch: Patch
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
        size: scene units across the object.
        measured: depth is measured; otherwise it is a guess.
    """

    layer: Layer
    surfaces: list[Surface | None]
    cameras: Cameras
    size: float
    measured: bool

    @property
    def area(self) -> np.ndarray:  # (T,)
        """Visible pixels in every frame."""
        return self.layer.mask.sum(axis=(1, 2)).astype(np.float64)

    def selected(self, frames: np.ndarray) -> ObjectSurfaces:  # (K,) int64
        """The same object in some of the frames."""
        layer = Layer(self.layer.shade[frames], self.layer.mask[frames], self.layer.other[frames])
        return replace(self, layer=layer, surfaces=[self.surfaces[t] for t in frames],
                       cameras=self.cameras.selected(frames))  # fmt: skip

    def world(self, t: int, xy: np.ndarray) -> np.ndarray:  # (N, 2) raster -> (N, 3) world
        """Points of the surface of frame t at image places; the camera's own place where there is no surface."""
        surface = self.surfaces[t]
        depth = np.zeros(len(xy)) if surface is None else surface.patch.lookup(surface.patch.depth, xy)
        return camera_centre(self.cameras, t) + rays(self.cameras, t, xy) * depth[:, None]

    def corrected(self, t: int, cells: np.ndarray, gain: np.ndarray) -> ObjectSurfaces:
        """The same with the depth of frame t changed smoothly.

        Args:
            t: frame. cells: (N, 2) rows and columns of the frame's grid.
            gain: (N,) what has to be added to the depth there; spread by a Gaussian of 1/16 of the grid's side.
        """
        surface = self.surfaces[t]
        if surface is None or not len(cells):
            return self
        grid, patch = surface.grid, surface.patch
        change = _spread(grid.inside.shape, cells, gain)
        offset = grid.xy[0, 0] - np.array([patch.left, patch.top], np.float32)
        height, width = patch.depth.shape
        xs = (np.arange(width) + 0.5 - offset[0]) / grid.step
        ys = (np.arange(height) + 0.5 - offset[1]) / grid.step
        places = np.stack(np.meshgrid(xs, ys), axis=-1).astype(np.float32)
        whole = cv2.remap(change, places, None, cv2.INTER_LINEAR, borderMode=cv2.BORDER_REPLICATE)
        along = rays(self.cameras, t, grid.xy.astype(np.float64))
        new = replace(surface, patch=replace(patch, depth=patch.depth + whole),
                      points=surface.points + along * change[..., None])  # fmt: skip
        return replace(self, surfaces=[*self.surfaces[:t], new, *self.surfaces[t + 1 :]])


def object_surfaces(clip: Clip, k: int, shade: np.ndarray) -> ObjectSurfaces:
    """Surfaces of object k (0..K-1).

    Args:
        clip: with masks, depth and cameras.
        k: object.
        shade: (T, H, W) uint8 of `flat_shade`, shared by all objects.

    Raises GenmojoError("schema") if a channel is missing.
    """
    masks, depth, cameras = _needed(clip.masks, "masks"), _needed(clip.depth, "depth"), _needed(clip.cameras, "cameras")
    mask = (masks.value == k + 1) & masks.valid
    layer = Layer(shade, mask, ((masks.value > 0) & (masks.value != k + 1)) | ~masks.valid)
    surfaces = [_surface(layer, depth, cameras.value, t) for t in range(len(clip))]
    spans = [_span(s) for s in surfaces if s is not None]
    size = float(np.median(spans)) if spans else 1.0
    return ObjectSurfaces(layer, surfaces, cameras.value, max(size, 1e-6), depth.given)


def _needed(channel: Channel | None, name: str) -> Channel:
    """A channel that must be there."""
    if channel is None:
        raise GenmojoError("schema", f"has no {name}", "clip", "complete the clip before asking for its motion")
    return channel


def _surface(layer: Layer, depth: Channel, cameras: Cameras, t: int) -> Surface | None:
    """The surface of frame t, or None where the object has too few pixels."""
    grid = grid_of(layer, t)
    if grid is None:
        return None
    rows, cols = np.nonzero(layer.mask[t])
    left, top = max(cols.min() - _AROUND, 0), max(rows.min() - _AROUND, 0)
    box = slice(top, rows.max() + 1 + _AROUND), slice(left, cols.max() + 1 + _AROUND)
    mask = layer.mask[t][box]
    patch = Patch(int(left), int(top), _filled(depth.value[t][box], mask & depth.valid[t][box], mask))
    centre = camera_centre(cameras, t)
    height, width = mask.shape
    places = np.stack(np.meshgrid(np.arange(width) + left + 0.5, np.arange(height) + top + 0.5), axis=-1)
    normal = _normals(centre + rays(cameras, t, places) * patch.depth[..., None], centre, mask)
    along = rays(cameras, t, grid.xy.astype(np.float64))
    return Surface(patch, normal, grid, centre + along * patch.lookup(patch.depth, grid.xy)[..., None])


def _filled(depth: np.ndarray, known: np.ndarray, mask: np.ndarray) -> np.ndarray:
    """Depth of the nearest known pixel of the object; rim pixels, which may mix two surfaces, are replaced too."""
    core = cv2.erode(known.astype(np.uint8), np.ones((3, 3), np.uint8), borderValue=0) > 0
    core = core if core.sum() > 0.3 * mask.sum() else known if known.any() else mask
    _, label = cv2.distanceTransformWithLabels((~core).astype(np.uint8), cv2.DIST_L2, 5, labelType=cv2.DIST_LABEL_PIXEL)
    table = np.zeros(int(label.max()) + 1, np.float32)
    table[label[core]] = depth[core]
    return table[label]


def _normals(points: np.ndarray, centre: np.ndarray, mask: np.ndarray) -> np.ndarray:
    """World normals; zero on the rim and where the surface is seen nearly edge-on."""
    smooth = cv2.GaussianBlur(points, (0, 0), 1.0)
    raw = np.cross(np.gradient(smooth, axis=1), np.gradient(smooth, axis=0))
    raw /= np.maximum(np.linalg.norm(raw, axis=-1, keepdims=True), 1e-12)
    view = centre - smooth
    view /= np.maximum(np.linalg.norm(view, axis=-1, keepdims=True), 1e-12)
    facing = (raw * view).sum(axis=-1, keepdims=True)
    inner = cv2.erode(mask.astype(np.uint8), np.ones((3, 3), np.uint8), borderValue=0) > 0
    return (raw * np.sign(facing) * (np.abs(facing) > 0.2) * inner[..., None]).astype(np.float32)


def _spread(shape: tuple[int, ...], cells: np.ndarray, gain: np.ndarray) -> np.ndarray:
    """A smooth (h, w) float32 field through values at some cells."""
    total, count = np.zeros(shape), np.zeros(shape)
    np.add.at(total, (cells[:, 0], cells[:, 1]), gain)
    np.add.at(count, (cells[:, 0], cells[:, 1]), 1.0)
    sigma = max(shape) / 16.0
    total, count = cv2.GaussianBlur(total, (0, 0), sigma), cv2.GaussianBlur(count, (0, 0), sigma)
    return (total / np.maximum(count, 1e-6)).astype(np.float32)


def _span(surface: Surface) -> float:
    """Scene units across the visible part: the larger side of its box, 5th to 95th percentile."""
    inside = surface.points[surface.grid.inside]
    if not len(inside):
        return 0.0
    low, high = np.percentile(inside, [5, 95], axis=0)
    return float((high - low).max())
