"""Outlines of one object that are its own: where it meets the background, not where something hides it."""

from __future__ import annotations

from dataclasses import dataclass

import cv2
import numpy as np

from genmojo_core.trackers.stabilise import Layer


@dataclass(frozen=True)
class Outline:
    """The own outline of an object in one frame.

    Args:
        xy: (N, 2) float64 raster pixels, on the boundary between the object and the background.
        normal: (N, 2) float64 unit, outwards.
        nearest: (H, W) int32 index of the nearest point of the outline, -1 where something else is nearer: another
            object's edge or the image border.
    """

    xy: np.ndarray
    normal: np.ndarray
    nearest: np.ndarray


def outline_of(layer: Layer, t: int) -> Outline | None:
    """The outline of frame t, None where no piece of it is the object's own."""
    mask = layer.mask[t].astype(np.uint8)
    inner = cv2.erode(mask, np.ones((3, 3), np.uint8), borderValue=0)
    rim = (mask > 0) & (inner == 0)
    soft = cv2.GaussianBlur(mask.astype(np.float32), (0, 0), 1.5)
    slope = -np.stack([cv2.Sobel(soft, cv2.CV_32F, 1, 0), cv2.Sobel(soft, cv2.CV_32F, 0, 1)], axis=-1)
    hidden = cv2.dilate(layer.other[t].astype(np.uint8), np.ones((5, 5), np.uint8)) > 0
    hidden[:2], hidden[-2:], hidden[:, :2], hidden[:, -2:] = True, True, True, True
    rows, cols = np.nonzero(rim)
    if not len(rows):
        return None
    normal = slope[rows, cols].astype(np.float64)
    length = np.linalg.norm(normal, axis=1)
    own = ~hidden[rows, cols] & (length > 0.05)
    if own.sum() < 8:
        return None
    _, label = cv2.distanceTransformWithLabels((~rim).astype(np.uint8), cv2.DIST_L2, 5, labelType=cv2.DIST_LABEL_PIXEL)
    index = np.full(int(label.max()) + 1, -1, np.int32)
    index[label[rows[own], cols[own]]] = np.arange(int(own.sum()))
    normal = normal[own] / length[own, None]
    xy = np.stack([cols[own], rows[own]], axis=1) + 0.5 + 0.5 * normal
    return Outline(xy, normal, index[label])


def whole_area(layer: Layer) -> np.ndarray:  # (T,) float64
    """Visible pixels of every frame times the share of the rim that touches neither another object nor the border."""
    area = layer.mask.sum(axis=(1, 2)).astype(np.float64)
    for t in np.nonzero(area)[0]:
        mask = np.pad(layer.mask[t], 1).astype(np.uint8)
        blocked = np.pad(layer.other[t], 1, constant_values=True)
        around = (cv2.dilate(mask, np.ones((3, 3), np.uint8)) > 0) & (mask == 0)
        area[t] *= 1.0 - blocked[around].mean()
    return area


def spread(outline: Outline, count: int) -> np.ndarray:
    """Indices of about `count` points of an outline, evenly along its length by angle about its middle."""
    if len(outline.xy) <= count:
        return np.arange(len(outline.xy))
    offset = outline.xy - outline.xy.mean(axis=0)
    order = np.argsort(np.arctan2(offset[:, 1], offset[:, 0]))
    return np.sort(order[np.linspace(0, len(order) - 1, count).astype(int)])


def meet(outline: Outline, xy: np.ndarray, normal: np.ndarray, reach: float) -> tuple[np.ndarray, ...]:
    """Points of an outline nearest to image places.

    Args:
        outline: of the target frame.
        xy: (N, 2) raster pixels. normal: (N, 2) outward normals the places have in their own frame.
        reach: pixels beyond which nothing is met.

    Returns (N, 2) places on the outline, (N, 2) its normals and (N,) bool, True where the place is near, the nearest
    edge is the object's own and the normals agree within 45 degrees.
    """
    height, width = outline.nearest.shape
    cell = np.floor(xy).astype(np.int64)
    within = ((cell >= 0) & (cell < [width, height])).all(axis=1)
    cell = np.clip(cell, 0, [width - 1, height - 1])
    index = outline.nearest[cell[:, 1], cell[:, 0]]
    place, facing = outline.xy[index], outline.normal[index]
    good = within & (index >= 0) & (np.linalg.norm(place - xy, axis=1) < reach)
    return place, facing, good & ((facing * normal).sum(axis=1) > 0.7)
