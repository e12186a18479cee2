"""Cutting one object out of one frame: GrabCut with a prior, and what the object looks like."""

from __future__ import annotations

from dataclasses import dataclass

import cv2
import numpy as np

_BINS = 12  # per colour axis of the histograms
_ROUNDS = 3
_NEAR, _BRUSH = 45, 120  # shares of the short side: so near to a stroke all is likely to belong to it, or surely
_LEAST_SHARE = 0.04  # of the box: a smaller cut has failed and the box's inscribed ellipse stands in
_ALIKE = 0.35  # histogram overlap under which it is not the same object


@dataclass(frozen=True)
class Look:
    """Colours and picture of an object where the user pointed at it.

    Args:
        inside, around: (B, B, B) float32 Lab histograms of the object and of a ring round it, each summing to 1.
        picture: (h, w, 3) uint8 crop. picture_mask: (h, w) bool.
    """

    inside: np.ndarray
    around: np.ndarray
    picture: np.ndarray
    picture_mask: np.ndarray


def cut_in_box(
    frame: np.ndarray,  # (H, W, 3) uint8
    box: np.ndarray | None,  # x0, y0, x1, y1 in pixels of the frame
    inside: np.ndarray,  # (H, W) bool, strokes on the object
    outside: np.ndarray,  # (H, W) bool, strokes beside it
) -> np.ndarray:  # (H, W) bool
    """The object in a box, or around strokes; never empty. Without a box the strokes' surroundings are searched."""
    h, w = frame.shape[:2]
    if box is None:
        x, y, bw, bh = cv2.boundingRect(inside.astype(np.uint8))
        reach = max(bw, bh, min(h, w) // 8)
        box = np.array([x - reach, y - reach, x + bw + reach, y + bh + reach])
    x0, y0 = np.clip(box[:2].astype(int), 0, [w - 1, h - 1])
    x1, y1 = np.maximum(np.clip(box[2:].astype(int), 0, [w, h]), [x0 + 1, y0 + 1])
    trimap = np.full((h, w), cv2.GC_BGD, np.uint8)
    trimap[y0:y1, x0:x1] = cv2.GC_PR_FGD if not inside.any() else cv2.GC_PR_BGD
    if inside.any():
        near = cv2.dilate(inside.astype(np.uint8), np.ones((9, 9), np.uint8)) > 0
        trimap[near & (trimap != cv2.GC_BGD)] = cv2.GC_PR_FGD
    trimap[inside], trimap[outside] = cv2.GC_FGD, cv2.GC_BGD
    found = _grabcut(frame, trimap, rounds=6)
    if found.sum() < _LEAST_SHARE * (x1 - x0) * (y1 - y0):
        ellipse = np.zeros((h, w), np.uint8)
        centre = ((float(x0 + x1 - 1) / 2, float(y0 + y1 - 1) / 2), (float(x1 - x0), float(y1 - y0)), 0.0)
        cv2.ellipse(ellipse, centre, 1, -1)
        found = ellipse > 0
        found[(y0 + y1) // 2, (x0 + x1) // 2] = True
    return _largest_parts(found | inside)


def cut_part(
    frame: np.ndarray,  # (H, W, 3) uint8
    stroke: np.ndarray,  # (H, W) bool, on the part
    beside: np.ndarray,  # (H, W) bool, surely not of it
    within: np.ndarray,  # (H, W) bool, where it may be
) -> np.ndarray:  # (H, W) bool
    """The part of `within` that strokes lie on: what looks like their surroundings rather than like the rest."""
    stroke = stroke & within
    if not stroke.any():
        return stroke
    near = _widened(stroke, _NEAR) & within
    stroke = _widened(stroke, _BRUSH) & within & ~beside
    look = Look(_histogram(frame, near), _histogram(frame, within & ~near), frame[:0, :0], stroke[:0, :0])
    likely = near | (own_colour(frame, look) > 0.5)
    trimap = np.where(likely, cv2.GC_PR_FGD, cv2.GC_PR_BGD).astype(np.uint8)
    trimap[~within | beside] = cv2.GC_BGD
    trimap[stroke] = cv2.GC_FGD
    found = _grabcut(frame, trimap, _ROUNDS) & within
    _, parts = cv2.connectedComponents(found.astype(np.uint8))
    return np.isin(parts, np.unique(parts[stroke & found])) & found


def _widened(stroke: np.ndarray, share: int) -> np.ndarray:  # (H, W) bool
    """Strokes made wider on either side by a share of the short side."""
    side = 2 * max(1, min(stroke.shape) // share) + 1
    return cv2.dilate(stroke.astype(np.uint8), np.ones((side, side), np.uint8)) > 0


def learn_look(frame: np.ndarray, mask: np.ndarray) -> Look:  # (H, W, 3) uint8, (H, W) bool
    """Colours inside the mask and around it, and the cropped picture."""
    size = max(4, int(np.sqrt(mask.sum()) // 2))
    ring = (cv2.dilate(mask.astype(np.uint8), np.ones((2 * size + 1, 2 * size + 1), np.uint8)) > 0) & ~mask
    x, y, w, h = cv2.boundingRect(mask.astype(np.uint8))
    return Look(
        _histogram(frame, mask), _histogram(frame, ring), frame[y : y + h, x : x + w].copy(), mask[y : y + h, x : x + w]
    )


def cut(frame: np.ndarray, prior: np.ndarray, look: Look) -> np.ndarray:  # (H, W, 3), (H, W) 0..1 -> (H, W) bool
    """The object near where a prior expects it.

    Pixels far outside the prior are out; deep inside they are in unless their colour is rather that of the
    surroundings (something passes in front); GrabCut decides the band between.
    """
    expected = prior > 0.5
    if not expected.any():
        return expected
    reach = max(2, round(0.08 * float(np.sqrt(expected.sum()))))
    kernel = cv2.getStructuringElement(cv2.MORPH_ELLIPSE, (2 * reach + 1, 2 * reach + 1))
    wide = cv2.dilate((prior > 0.2).astype(np.uint8), kernel) > 0
    deep = cv2.erode(expected.astype(np.uint8), kernel) > 0
    x, y, w, h = cv2.boundingRect(wide.astype(np.uint8))
    pad = 3 * reach
    rows, columns = slice(max(0, y - pad), y + h + pad), slice(max(0, x - pad), x + w + pad)
    colour = own_colour(frame[rows, columns], look)
    wide, deep, near = wide[rows, columns], deep[rows, columns], prior[rows, columns]
    likely = 0.6 * near + 0.4 * colour > 0.5
    trimap = np.where(likely, cv2.GC_PR_FGD, cv2.GC_PR_BGD).astype(np.uint8)
    trimap[deep & (colour > 0.3)] = cv2.GC_FGD
    trimap[~wide] = cv2.GC_BGD
    result = np.zeros(prior.shape, bool)
    result[rows, columns] = _grabcut(frame[rows, columns], trimap, _ROUNDS)
    return _largest_parts(result)


def own_colour(frame: np.ndarray, look: Look) -> np.ndarray:  # (H, W, 3) uint8 -> (H, W) 0..1
    """How much a pixel's colour is the object's rather than its surroundings'; 0.5 for colours never seen."""
    index = _bins(frame)
    inside, around = look.inside[index] + 1e-4, look.around[index] + 1e-4
    return inside / (inside + around)


def resembles(frame: np.ndarray, mask: np.ndarray, look: Look) -> bool:  # (H, W, 3) uint8, (H, W) bool
    """Whether the colours under the mask are still those of the object."""
    return bool(mask.any()) and float(np.minimum(_histogram(frame, mask), look.inside).sum()) >= _ALIKE


def _grabcut(frame: np.ndarray, trimap: np.ndarray, rounds: int) -> np.ndarray:  # (H, W) bool
    """GrabCut from a trimap; without both kinds of pixel, or with too few, the likely ones are taken as they are."""
    front = (trimap == cv2.GC_FGD) | (trimap == cv2.GC_PR_FGD)
    if front.sum() < 8 or (~front).sum() < 8:
        return front
    cv2.setRNGSeed(0)
    result = trimap.copy()
    models = np.zeros((1, 65)), np.zeros((1, 65))
    bgr = np.ascontiguousarray(frame[..., ::-1])
    cv2.grabCut(bgr, result, (0, 0, 0, 0), models[0], models[1], rounds, cv2.GC_INIT_WITH_MASK)
    return (result == cv2.GC_FGD) | (result == cv2.GC_PR_FGD)


def _largest_parts(mask: np.ndarray) -> np.ndarray:  # (H, W) bool
    """The mask without specks: parts under a tenth of its largest one go, pinholes close."""
    closed = cv2.morphologyEx(mask.astype(np.uint8), cv2.MORPH_CLOSE, np.ones((3, 3), np.uint8))
    count, parts, stats, _ = cv2.connectedComponentsWithStats(closed)
    if count <= 2:
        return closed > 0
    area = stats[1:, cv2.CC_STAT_AREA]
    return np.isin(parts, 1 + np.flatnonzero(area >= 0.1 * area.max()))


def _bins(frame: np.ndarray) -> tuple[np.ndarray, ...]:  # (H, W, 3) uint8 -> 3 index arrays
    """Histogram bin of every pixel in Lab."""
    lab = cv2.cvtColor(np.ascontiguousarray(frame), cv2.COLOR_RGB2LAB).astype(np.int32)
    return tuple(np.moveaxis(lab * _BINS // 256, -1, 0))


def _histogram(frame: np.ndarray, mask: np.ndarray) -> np.ndarray:  # (B, B, B) float32
    """Smoothed Lab histogram of the pixels under a mask, summing to 1; uniform if there are none."""
    counts = np.zeros((_BINS,) * 3, np.float32)
    lightness, a, b = _bins(frame)
    np.add.at(counts, (lightness[mask], a[mask], b[mask]), 1.0)
    for axis in range(3):  # neighbouring bins share, so that a shade more does not make a stranger
        counts = 0.5 * counts + 0.25 * (_shifted(counts, axis, 1) + _shifted(counts, axis, -1))
    total = float(counts.sum())
    return counts / total if total > 0 else np.full_like(counts, 1.0 / counts.size)


def _shifted(counts: np.ndarray, axis: int, by: int) -> np.ndarray:
    """The histogram shifted by one bin, the end bin repeated."""
    index = np.clip(np.arange(_BINS) + by, 0, _BINS - 1)
    return np.take(counts, index, axis=axis)
