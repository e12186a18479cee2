"""Small magnified pictures around points: for the loupe and the stabilised strip. No Qt."""

from __future__ import annotations

import cv2
import numpy as np


def patch(
    frame: np.ndarray,  # (H, W, 4) uint8
    xy: tuple[float, float],  # raster centre
    size: tuple[int, int],  # width, height of the result in pixels
    zoom: float,  # result pixels per raster pixel
    *,
    smooth: bool = False,
) -> np.ndarray:  # (height, width, 4) uint8
    """The frame around a raster position, which lies exactly in the middle; grey outside the frame."""
    width, height = size
    inverse = np.array(
        [[1 / zoom, 0, xy[0] - 0.5 + (0.5 - width / 2) / zoom], [0, 1 / zoom, xy[1] - 0.5 + (0.5 - height / 2) / zoom]]
    )
    flags = (cv2.INTER_CUBIC if smooth else cv2.INTER_NEAREST) | cv2.WARP_INVERSE_MAP
    # Only the part that shows is read, however large the frame is.
    x0 = int(np.clip(np.floor(inverse[0, 2]) - 4, 0, frame.shape[1] - 1))
    y0 = int(np.clip(np.floor(inverse[1, 2]) - 4, 0, frame.shape[0] - 1))
    x1 = int(np.clip(np.ceil(inverse[0, 2] + width / zoom) + 4, x0 + 1, frame.shape[1]))
    y1 = int(np.clip(np.ceil(inverse[1, 2] + height / zoom) + 4, y0 + 1, frame.shape[0]))
    inverse[:, 2] -= (x0, y0)
    cut = frame[y0:y1, x0:x1]
    return np.asarray(
        cv2.warpAffine(cut, inverse, size, flags=flags, borderMode=cv2.BORDER_CONSTANT, borderValue=(72, 72, 72, 255))
    )


def difference(one: np.ndarray, two: np.ndarray) -> np.ndarray:  # (h, w, 4) uint8 each
    """Twice the absolute difference of two patches, opaque."""
    shown = cv2.convertScaleAbs(cv2.absdiff(one, two), alpha=2.0)
    shown[..., 3] = 255
    return np.asarray(shown)


def shrunk(frame: np.ndarray, size: tuple[int, int]) -> np.ndarray:
    """A frame (H, W, 4) made smaller to (width, height) without aliasing."""
    return np.asarray(cv2.resize(frame, size, interpolation=cv2.INTER_AREA))
