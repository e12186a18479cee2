"""What is known about each object before anything is optimised: boxes, visibility, contacts, canonical frame, depth."""

from __future__ import annotations

from dataclasses import dataclass

import cv2
import numpy as np

from genmojo_core.clip.clip import Clip

REACH = 2  # pixels: masks this close touch
_BORDER = 2  # pixels: a mask this close to the border is cut by it
_KEEP_FIRST = 0.85  # frame 0 is canonical when its mask has this share of the best one's area
_WORTHWHILE = 0.5  # a frame without contact is preferred if its mask has this share of the largest one's area
_ERODE = 7  # pixels, METHOD.md section 3: depth is read inside the mask eroded by 7 x 7


@dataclass(frozen=True)
class ObjectFacts:
    """One object through a clip of T frames; pixels are those of the frames held.

    Args:
        area: (T,) int64 visible pixels.
        boxes: (T, 4) int64 left, top, right, bottom (right and bottom exclusive); zeros where not seen.
        visibility: (T,) float64, area / largest area, 0..1 (all 0 for an object that is never seen).
        touches: (T,) bool, another object's mask lies within REACH pixels.
        cut: (T,) bool, the image border cuts it.
        canonical: the frame where it is best seen (METHOD.md section 11.17).
        depth: (T,) float64 median depth inside the eroded mask, scene units; carried over where not seen, NaN without
            any depth.
        depth_ratio: (T,) float64 depth / depth in the canonical frame (the paper's k_i, reference = itself).
    """

    area: np.ndarray
    boxes: np.ndarray
    visibility: np.ndarray
    touches: np.ndarray
    cut: np.ndarray
    canonical: int
    depth: np.ndarray
    depth_ratio: np.ndarray


def describe(clip: Clip) -> tuple[ObjectFacts, ...]:
    """Facts about every object of a clip, in the order of `clip.object_ids`; empty for a clip without objects."""
    return tuple(_describe_one(clip, k) for k in range(clip.objects))


def canonical_frame(area: np.ndarray, touches: np.ndarray, cut: np.ndarray) -> int:
    """The frame of the largest mask that nothing cuts or touches; frame 0 if it is nearly as good.

    Frames that the border cuts, then frames with contact, are only taken when the others show less than half as much.

    Args:
        area: (T,) pixels. touches, cut: (T,) bool.
    """
    seen = area > 0
    if not seen.any():
        return 0
    candidates = seen
    for free in (seen & ~cut & ~touches, seen & ~cut):
        if free.any() and area[free].max() >= _WORTHWHILE * area.max():
            candidates = free
            break
    best = int(np.argmax(np.where(candidates, area, -1)))
    return 0 if candidates[0] and area[0] >= _KEEP_FIRST * area[best] else best


def object_contacts(labels: np.ndarray, objects: int) -> np.ndarray:  # (T, H, W) uint8 -> (T, K) bool
    """Whether another object lies within REACH pixels of each object, per frame."""
    result = np.zeros((len(labels), objects), bool)
    kernel = np.ones((2 * REACH + 1, 2 * REACH + 1), np.uint8)
    for t, frame in enumerate(labels):
        for k in range(objects):
            mask = frame == k + 1
            if mask.any():
                near = cv2.dilate(mask.astype(np.uint8), kernel) > 0
                result[t, k] = bool((near & (frame > 0) & ~mask).any())
    return result


def _describe_one(clip: Clip, k: int) -> ObjectFacts:
    """Facts about object k."""
    masks = clip.object_mask(k)
    labels = np.where(clip.masks.valid, clip.masks.value, 0) if clip.masks is not None else masks.astype(np.uint8)
    area = masks.sum(axis=(1, 2)).astype(np.int64)
    boxes = np.array([_box(mask) for mask in masks], np.int64)
    width, height = clip.size
    inner = (boxes[:, :2] >= _BORDER).all(axis=1) & (boxes[:, 2] <= width - _BORDER) & (boxes[:, 3] <= height - _BORDER)
    touches = _touches_others(labels, k)
    canonical = canonical_frame(area, touches, ~inner & (area > 0))
    depth = _depths(clip, masks)
    return ObjectFacts(area, boxes, area / max(int(area.max()), 1), touches, ~inner & (area > 0), canonical, depth,
                       depth / depth[canonical])  # fmt: skip


def _touches_others(labels: np.ndarray, k: int) -> np.ndarray:  # (T, H, W) -> (T,) bool
    """Whether another object lies within REACH pixels of object k."""
    only = np.where(labels == k + 1, 1, np.where(labels > 0, 2, 0)).astype(np.uint8)
    return object_contacts(only, 1)[:, 0]


def _box(mask: np.ndarray) -> tuple[int, int, int, int]:
    """Left, top, right, bottom of a mask, zeros if it is empty."""
    rows, columns = np.flatnonzero(mask.any(axis=1)), np.flatnonzero(mask.any(axis=0))
    if not len(rows):
        return 0, 0, 0, 0
    return int(columns[0]), int(rows[0]), int(columns[-1]) + 1, int(rows[-1]) + 1


def _depths(clip: Clip, masks: np.ndarray) -> np.ndarray:  # (T, H, W) bool -> (T,)
    """Median depth inside the eroded mask; frames without one take their nearest neighbour's in time."""
    depth = np.full(len(masks), np.nan)
    if clip.depth is None:
        return depth
    kernel = np.ones((_ERODE, _ERODE), np.uint8)
    for t, mask in enumerate(masks):
        usable = mask & clip.depth.valid[t]
        inside = usable & (cv2.erode(mask.astype(np.uint8), kernel) > 0)
        chosen = inside if inside.any() else usable
        if chosen.any():
            depth[t] = np.median(clip.depth.value[t][chosen])
    known = np.flatnonzero(np.isfinite(depth))
    if not len(known):
        return depth
    nearest = known[np.abs(np.arange(len(depth))[:, None] - known).argmin(axis=1)]
    return depth[nearest]
