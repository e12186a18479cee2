"""Training examples of the embedded prior: one picture of an object as a crop of a clip shows it, and truths around it.

The prior's space has the condition camera's axes (OpenCV) and its origin where views turn about: at depth `distance`
along the camera's axis. What the condition shows has its median depth at `distance` - FRONT, so a clip's depth alone
places the space; a side of the square picture measures 2 HALF_EXTENT there, whatever the lens.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace

import cv2
import numpy as np

from genmojo_core.conventions import orbit_camera
from genmojo_core.priors.families import draw_object
from genmojo_core.priors.solids import HALF_EXTENT, Solids, draw, outline

VERSION = 1  # of what is drawn; part of a weight file's description
CONDITION = 64  # pixels of the condition's side
SIDE = 32  # pixels of a target's side
FRONT = 0.3  # how far in front of the origin the visible surface lies, median
FILL = 0.65  # of the picture's side, taken by the longer side of the object's box
LARGEST_CROP = 3.0  # an object of which less shows is no reference
Rng = np.random.Generator


@dataclass(frozen=True)
class Variation:
    """What may go wrong with a condition; the default is a clean one.

    scale: ln range of the box's size around FILL. shift: of its centre, in half pictures. occluded, depth_lost:
    probabilities. depth_error: largest relative standard deviation of depth's stretch; an example's own lies anywhere
    below, as some clips have measured depth and some a guess. noise: of the colours. blurred:
    probability that the picture was enlarged from fewer pixels. strange: probability of a family that the frozen test
    set does not know.
    """

    scale: float = 0.0
    shift: float = 0.0
    occluded: float = 0.0
    depth_lost: float = 0.0
    depth_error: float = 0.0
    noise: float = 0.0
    blurred: float = 0.0
    strange: float = 0.0


TRAINING = Variation(0.22, 0.06, 0.35, 0.25, 0.35, 0.02, 0.4, 0.25)


@dataclass(frozen=True)
class Example:
    """One object.

    Args:
        condition: (7, C, C) float32: RGB and alpha (straight, colour 0 outside), hidden, depth, depth known.
        elevation: degrees of the condition camera, + = from above. distance: to the origin, the prior's units.
        views: (K, 2) degrees (elevation, azimuth) relative to the condition. targets: (K, 4, S, S) premultiplied.
    """

    condition: np.ndarray
    elevation: float
    distance: float
    views: np.ndarray
    targets: np.ndarray


def view_matrices(views: np.ndarray, elevation: float, distance: float) -> np.ndarray:  # (K, 2) -> (K, 4, 4)
    """Cameras of views (elevation, azimuth in degrees, relative), world to camera in the prior's space."""
    start = np.eye(4)
    start[2, 3] = distance
    angle = np.deg2rad(elevation)
    up = np.array([0.0, -np.cos(angle), -np.sin(angle)])
    return np.stack([orbit_camera(start, np.zeros(3), up, float(e), float(a)) for e, a in views])


def example(rng: Rng, views: np.ndarray | None = None, count: int = 6, variation: Variation = TRAINING) -> Example:
    """A new object, its condition and its views (given, or `count` random ones)."""
    taken = None
    while taken is None:
        taken = shot(rng, lambda: draw_object(rng, variation.strange), variation)
    if views is None:
        views = random_views(rng, count)
    targets = draw(taken.solids, view_matrices(views, taken.elevation, taken.distance), taken.distance, SIDE).rgba
    targets = np.ascontiguousarray(np.moveaxis(targets, -1, 1))
    return Example(taken.condition(rng, variation), taken.elevation, taken.distance, views, targets)


@dataclass(frozen=True)
class Shot:
    """An object (z up) placed in the prior's space and looked at by its condition camera.

    rgba (C, C, 4), depth (C, C) relative to the origin, hidden (C, C) 0 or 1.
    """

    solids: Solids
    elevation: float
    distance: float
    rgba: np.ndarray
    depth: np.ndarray
    hidden: np.ndarray

    def condition(self, rng: Rng, variation: Variation) -> np.ndarray:
        """(7, C, C), see Example."""
        return _condition(rng, self.rgba, self.depth, self.hidden, variation)


def shot(rng: Rng, make: Callable[[], Solids], variation: Variation) -> Shot | None:
    """An object from a random elevation and distance; None where too little of it shows."""
    elevation, distance = float(rng.uniform(-10, 40)), float(np.exp(rng.uniform(np.log(1.7), np.log(10.0))))
    fill = FILL * np.exp(rng.uniform(-1, 1) * variation.scale)
    centre = rng.uniform(-1, 1, 2) * variation.shift
    made = make()
    solids = _placed(made, elevation, distance, fill, centre)
    first = draw(solids, view_matrices(np.zeros((1, 2)), elevation, distance), distance, CONDITION)
    alpha = first.rgba[0, ..., 3]
    hidden = np.zeros_like(alpha)
    if rng.random() < variation.occluded:
        hidden, zoom, middle = _cropped(_occluder(rng, alpha), alpha, fill)
        solids = _placed(made, elevation, distance, zoom * fill, zoom * (centre - middle) + centre)
        first = draw(solids, view_matrices(np.zeros((1, 2)), elevation, distance), distance, CONDITION)
        alpha = first.rgba[0, ..., 3]
    seen = (alpha > 0.5) & (hidden < 0.5)
    if seen.sum() < 24:
        return None
    grown = (distance - FRONT) / float(np.median(first.depth[0][seen]))
    depth = first.depth[0] * grown - distance
    return Shot(_scaled(solids, grown, distance), elevation, distance, first.rgba[0], depth, hidden)


def random_views(rng: Rng, count: int) -> np.ndarray:  # (count, 2)
    """Elevation within 30 degrees of the condition's, azimuth all round."""
    return np.column_stack([rng.uniform(-30, 30, count), rng.uniform(-180, 180, count)])


def _placed(solids: Solids, elevation: float, distance: float, fill: float, centre: np.ndarray) -> Solids:
    """Solids (z up) moved into the prior's space so that their box in the condition has its size and place."""
    angle = np.deg2rad(elevation)
    axes = np.array([[1, 0, 0], [0, -np.sin(angle), -np.cos(angle)], [0, np.cos(angle), -np.sin(angle)]])
    turned = replace(solids, placed=axes @ solids.placed, light=axes @ solids.light)
    points = outline(turned)
    middle = (points.min(axis=0) + points.max(axis=0)) / 2
    scale = fill * HALF_EXTENT / max(np.abs(points - middle)[:, :2].max(), 1e-6)
    for _ in range(4):  # perspective: the box is found by trying
        moved = scale * (points - middle)
        seen = moved[:, :2] / (distance + moved[:, 2:]) * distance / HALF_EXTENT
        low, high = seen.min(axis=0), seen.max(axis=0)
        scale *= np.clip(2 * fill / max((high - low).max(), 1e-6), 0.5, 2.0)
        scale = min(scale, 0.8 * distance / max(-(points - middle)[:, 2].min(), 1e-6))
        middle[:2] += ((low + high) / 2 - centre) * HALF_EXTENT / scale
    placed = turned.placed * scale
    placed[:, :, 3] -= scale * middle
    return replace(turned, placed=placed)


def _scaled(solids: Solids, factor: float, distance: float) -> Solids:
    """Everything moved along the condition camera's rays: its picture stays, depths are multiplied."""
    placed = solids.placed * factor
    placed[:, 2, 3] += (factor - 1) * distance
    return replace(solids, placed=placed)


def _occluder(rng: Rng, alpha: np.ndarray) -> np.ndarray:
    """(C, C) 0 or 1: an edge, a bar, a ball, all but a hole, all but a gap: up to three quarters of the object."""
    side = len(alpha)
    y, x = (np.mgrid[:side, :side] + 0.5) / side * 2 - 1
    angle = rng.uniform(0, 2 * np.pi)
    along = x * np.cos(angle) + y * np.sin(angle)
    kind = rng.integers(5)
    if kind == 0:
        hidden = along > np.quantile(along[alpha > 0.5], rng.uniform(0.25, 0.95)) if (alpha > 0.5).any() else along > 1
    elif kind == 1:
        hidden = np.abs(along - rng.uniform(-0.4, 0.4)) < rng.uniform(0.05, 0.2)
    elif kind == 4:
        hidden = np.abs(along - rng.uniform(-0.3, 0.3)) > rng.uniform(0.15, 0.5)
    else:
        cx, cy = rng.uniform(-0.6, 0.6, 2) if kind == 2 else rng.uniform(-0.3, 0.3, 2)
        inside = (x - cx) ** 2 / rng.uniform(0.03, 0.2) + (y - cy) ** 2 / rng.uniform(0.03, 0.4) < 1
        hidden = inside if kind == 2 else ~inside
    return hidden.astype(np.float32)


def _cropped(hidden: np.ndarray, alpha: np.ndarray, fill: float) -> tuple[np.ndarray, float, np.ndarray]:
    """A clip's crop is taken around what shows, not around the whole object: how that changes a picture.

    Returns the occluder (C, C) as the new crop shows it, the enlargement (1..LARGEST_CROP), the place (2,) of the old
    picture, -1..1 right and down, that comes to its middle.
    """
    rows, columns = np.nonzero((alpha > 0.5) & (hidden < 0.5))
    if len(rows) == 0:
        return hidden, 1.0, np.zeros(2)
    side = len(alpha)
    low, high = np.array([columns.min(), rows.min()]), np.array([columns.max(), rows.max()]) + 1
    middle = (low + high) / side - 1.0
    zoom = float(np.clip(fill * side / max(high - low), 1.0, LARGEST_CROP))
    half = side / 2 - 0.5  # the pixel coordinate of the picture's middle
    move = np.array([[zoom, 0, 0], [0, zoom, 0]])
    move[:, 2] = half - zoom * ((middle + 1) * side / 2 - 0.5)
    return cv2.warpAffine(hidden, move, (side, side), flags=cv2.INTER_NEAREST,
                          borderMode=cv2.BORDER_REPLICATE), zoom, middle  # fmt: skip


def _condition(rng: Rng, rgba: np.ndarray, depth: np.ndarray, hidden: np.ndarray, variation: Variation) -> np.ndarray:
    """The channels of a condition; `depth` is relative to the origin."""
    if variation.blurred and rng.random() < variation.blurred:
        rgba = _enlarged(rgba, int(rng.integers(14, 48)))
    alpha = rgba[..., 3] * (1 - hidden)
    rgb = rgba[..., :3] / np.maximum(rgba[..., 3:], 1e-6)
    rgb = np.clip(rgb + rng.normal(size=rgb.shape) * variation.noise, 0, 1) * (alpha > 0)[..., None]
    known = (alpha > 0.5).astype(np.float32)
    if rng.random() < variation.depth_lost:
        known[:] = 0
    elif variation.depth_error:
        side = len(depth)
        spread = variation.depth_error * rng.random()
        slope = rng.normal(size=2) * 0.5 * spread
        y, x = (np.mgrid[:side, :side] + 0.5) / side * 2 - 1
        depth = -FRONT + (depth + FRONT) * np.exp(rng.normal() * spread) + slope[0] * x + slope[1] * y
        depth = depth + rng.normal(size=depth.shape) * 0.02
    channels = [*np.moveaxis(rgb, -1, 0), alpha, hidden, np.clip(depth, -1.5, 1.5) * known, known]
    return np.stack(channels).astype(np.float32)


def _enlarged(rgba: np.ndarray, side: int) -> np.ndarray:
    """A premultiplied picture as if it had been taken with `side` pixels."""
    small = cv2.resize(rgba, (side, side), interpolation=cv2.INTER_AREA)
    return cv2.resize(small, rgba.shape[:2], interpolation=cv2.INTER_LINEAR)
