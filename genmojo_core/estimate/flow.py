"""Optical flow between neighbouring frames, with the validity test of METHOD.md section 1 (numpy and OpenCV only).

The method is dense inverse search (Kroeger et al. 2016) as OpenCV ships it, run both ways; a vector holds where the
way there and back closes. Vectors are (dx, dy) in pixels of the frames held.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import cv2
import numpy as np

METHOD = "dense inverse search, forward-backward checked"
_SMALLEST_SIDE = 32  # the search needs a few patches per axis; smaller images are padded up to this
_ABSOLUTE_TOLERANCE = 0.5  # pixels; METHOD.md section 1
_RELATIVE_TOLERANCE = 0.01
_KEPT = 64  # flows that are kept where they are found on demand


@dataclass(frozen=True)
class FlowPair:
    """Flow between two images a and b, both ways.

    Args:
        forward: (H, W, 2) float32, from a to b. backward: (H, W, 2) float32, from b to a.
        forward_valid, backward_valid: (H, W) bool, the way there and back closes and stays in the image.
    """

    forward: np.ndarray
    backward: np.ndarray
    forward_valid: np.ndarray
    backward_valid: np.ndarray


@dataclass(frozen=True)
class SequenceFlow:
    """Flow along a clip of T frames.

    Args:
        forward: (T, H, W, 2) float32 from t to t + 1; the last frame is zero and invalid.
        backward: (T, H, W, 2) float32 from t to t - 1; the first frame is zero and invalid.
        forward_valid, backward_valid: (T, H, W) bool.
    """

    forward: np.ndarray
    backward: np.ndarray
    forward_valid: np.ndarray
    backward_valid: np.ndarray

    def between(self, a: int, b: int) -> np.ndarray:  # (H, W, 2)
        """Flow from frame a to its neighbour b."""
        return np.asarray((self.forward if b > a else self.backward)[a])


class FlowOnDemand:
    """Flow between neighbours of (T, H, W, 3) uint8, found when it is asked for first: for work on few of the frames.

    The newest are kept, so memory does not grow with the clip; nothing is said of their validity.
    """

    def __init__(self, frames: np.ndarray) -> None:
        self._frames = frames
        self._kept: dict[tuple[int, int], np.ndarray] = {}

    def between(self, a: int, b: int) -> np.ndarray:  # (H, W, 2)
        """Flow from frame a to its neighbour b."""
        if (a, b) not in self._kept:
            while len(self._kept) >= _KEPT:
                del self._kept[next(iter(self._kept))]
            self._kept[a, b] = _search(_grey(self._frames[a]), _grey(self._frames[b]))
        return self._kept[a, b]


def forward_backward(frame_a: np.ndarray, frame_b: np.ndarray) -> FlowPair:  # (H, W, 3) or (H, W) uint8 each
    """Flow from a to b and back, each with its validity."""
    grey_a, grey_b = _grey(frame_a), _grey(frame_b)
    forward, backward = _search(grey_a, grey_b), _search(grey_b, grey_a)
    return FlowPair(forward, backward, closes(forward, backward), closes(backward, forward))


def sequence_flow(frames: np.ndarray, progress: Callable[[float], None] | None = None) -> SequenceFlow:
    """Flow between all neighbouring frames of (T, H, W, 3) uint8; `progress` hears a share 0..1."""
    t, h, w = frames.shape[:3]
    result = SequenceFlow(
        np.zeros((t, h, w, 2), np.float32), np.zeros((t, h, w, 2), np.float32),
        np.zeros((t, h, w), bool), np.zeros((t, h, w), bool),
    )  # fmt: skip
    for i in range(t - 1):
        pair = forward_backward(frames[i], frames[i + 1])
        result.forward[i], result.forward_valid[i] = pair.forward, pair.forward_valid
        result.backward[i + 1], result.backward_valid[i + 1] = pair.backward, pair.backward_valid
        if progress:
            progress((i + 1) / (t - 1))
    return result


def closes(there: np.ndarray, back: np.ndarray) -> np.ndarray:  # (H, W, 2), (H, W, 2) -> (H, W) bool
    """Where |F + B(x + F)| <= 0.01 (|F| + |B|) + 0.5 pixels and the target lies in the image (METHOD.md section 1)."""
    h, w = there.shape[:2]
    returned = warp(back, there)
    error = np.linalg.norm(there + returned, axis=-1)
    length = np.linalg.norm(there, axis=-1) + np.linalg.norm(returned, axis=-1)
    x, y = np.meshgrid(np.arange(w), np.arange(h))
    tx, ty = x + there[..., 0], y + there[..., 1]
    inside = (tx >= -0.5) & (tx <= w - 0.5) & (ty >= -0.5) & (ty <= h - 0.5)
    return inside & (error <= _RELATIVE_TOLERANCE * length + _ABSOLUTE_TOLERANCE)


def warp(image: np.ndarray, flow: np.ndarray, nearest: bool = False) -> np.ndarray:
    """The image looked up at x + flow(x).

    Args:
        image: (H, W) or (H, W, C), any type OpenCV can sample; edges are repeated.
        flow: (H, W, 2) pixels. nearest: take the nearest pixel (labels) instead of a bilinear mix.
    """
    h, w = flow.shape[:2]
    x, y = np.meshgrid(np.arange(w, dtype=np.float32), np.arange(h, dtype=np.float32))
    mode = cv2.INTER_NEAREST if nearest else cv2.INTER_LINEAR
    return cv2.remap(image, x + flow[..., 0], y + flow[..., 1], mode, borderMode=cv2.BORDER_REPLICATE)


def _grey(frame: np.ndarray) -> np.ndarray:  # (H, W, 3) RGB or (H, W) -> (H, W) uint8
    """Luminance of a frame."""
    return cv2.cvtColor(frame, cv2.COLOR_RGB2GRAY) if frame.ndim == 3 else np.ascontiguousarray(frame)


def _search(a: np.ndarray, b: np.ndarray) -> np.ndarray:  # (H, W) uint8 each -> (H, W, 2) float32
    """One direction; tiny images are padded for the patch pyramid and cut again."""
    h, w = a.shape
    bottom, right = max(0, _SMALLEST_SIDE - h), max(0, _SMALLEST_SIDE - w)
    if bottom or right:
        a, b = (cv2.copyMakeBorder(i, 0, bottom, 0, right, cv2.BORDER_REPLICATE) for i in (a, b))
    dis = cv2.DISOpticalFlow.create(cv2.DISOPTICAL_FLOW_PRESET_MEDIUM)
    flow = np.asarray(dis.calc(a, b, np.zeros((*a.shape, 2), np.float32)))[:h, :w]
    return np.nan_to_num(flow, nan=0.0, posinf=0.0, neginf=0.0).astype(np.float32)
