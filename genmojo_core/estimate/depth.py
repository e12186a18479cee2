"""Depth of every pixel: the given one cleaned, or an honest guess from ground contact, occlusion and shape.

Scene units of a guess are heights of the camera above the ground: only the order of objects is meant.
"""

from __future__ import annotations

import cv2
import numpy as np

from genmojo_core.clip.cameras import Cameras

METHOD = "ground contact, occlusion order and rounded shapes"
_HORIZON = 0.35  # share of the frame's height where an unknown horizon is put
_RELIEF = 0.4  # depth of a body relative to its radius in the image


def clean_depth(depth: np.ndarray, valid: np.ndarray, labels: np.ndarray) -> np.ndarray:
    """Given depth with every invalid pixel filled: by the median of its object in that frame, background by nearest.

    Args:
        depth: (T, H, W) scene units. valid: (T, H, W) bool. labels: (T, H, W) uint8, 0 background.
    Returns:
        (T, H, W) float32, finite and positive. An object without one valid pixel in a frame takes its median over
        all frames, then the median of everything.
    """
    valid = valid & np.isfinite(depth) & (depth > 0)
    filled = np.where(valid, depth, 0).astype(np.float32)
    everything = float(np.median(depth[valid])) if valid.any() else 1.0
    for label in np.unique(labels):
        chosen = labels == label
        known = chosen & valid
        usual = float(np.median(depth[known])) if known.any() else everything
        for t in range(len(depth)):
            missing = chosen[t] & ~valid[t]
            if not missing.any():
                continue
            if label == 0 and known[t].any():
                filled[t] = np.where(missing, nearest_fill(filled[t], known[t]), filled[t])
            else:
                filled[t][missing] = np.median(depth[t][known[t]]) if known[t].any() else usual
    return filled


def nearest_fill(values: np.ndarray, known: np.ndarray) -> np.ndarray:  # (H, W), (H, W) bool -> (H, W)
    """Every pixel takes the value of the nearest known one; without any known pixel the values stay."""
    if not known.any():
        return values
    _, nearest = cv2.distanceTransformWithLabels(
        (~known).astype(np.uint8), cv2.DIST_L2, 5, labelType=cv2.DIST_LABEL_PIXEL
    )
    lookup = np.zeros(int(nearest.max()) + 1, values.dtype)
    lookup[nearest[known]] = values[known]
    return lookup[nearest]


def guess_depth(labels: np.ndarray, objects: int, cameras: Cameras) -> tuple[np.ndarray, np.ndarray]:
    """Guessed depth of a clip: (T, H, W) float32 of what is seen, (H, W) float32 of the plate in camera 0.

    Args:
        labels: (T, H, W) uint8, k + 1 on object k (0..objects-1). cameras: of the frames held.
    """
    t, h, w = labels.shape
    rows = np.arange(h) + 0.5
    ground = 1.0 / np.maximum((rows / h - _HORIZON) * 1.5, 0.08)
    far = 1.3 * ground[int(0.5 * h)]
    plate = np.repeat(np.minimum(ground, far)[:, None], w, axis=1).astype(np.float32)
    depth = np.repeat(plate[None], t, axis=0)
    for k in range(objects):
        for i in range(t):
            mask = labels[i] == k + 1
            if not mask.any():
                continue
            lowest = np.nonzero(mask.any(axis=1))[0].max()
            base = min(ground[lowest], 0.95 * far)
            inside = cv2.distanceTransform(np.pad(mask, 1).astype(np.uint8), cv2.DIST_L2, 5)[1:-1, 1:-1]
            relief = _RELIEF * inside * base / cameras.K[i, 1, 1]
            depth[i][mask] = (base - relief)[mask]
    return depth, plate
