"""What makes a clip hard to give back, measured before a run: how fine its texture is and how oddly it moves.

Both are errors in dB of simple stand-ins for a scene, so they are in the unit that is to be foretold (numpy and OpenCV
only, well under a second).
"""

from __future__ import annotations

import math
from dataclasses import asdict, dataclass

import cv2
import numpy as np

from genmojo_core.clip.clip import Clip
from genmojo_core.effects.sample import sample

PATCHES = 1000  # pieces of one colour that the objects' texture is approximated with
SHORT_SIDE = 128  # pixels at which everything is measured
_FLOOR = 1e-5  # squared error below which nothing can be told


@dataclass(frozen=True)
class Difficulty:
    """Of one clip.

    Args:
        texture: dB of the objects' pixels drawn with 1000 patches per frame and smoothed.
        motion: dB of the objects' pixels of a frame carried by flow into the frame before it.
        change: dB between an object and itself as it stands in the middle of the clip, moved by its mask's centre.
        area: the objects' share of the frame, 0..1.
        moved: pixels (of a frame with 256 on its short side) that an object's pixels move per frame, usual value.
        reached, coarse, fine: as in a Pilot of the clip (effects/pilot.py); None where none has run.
    """

    texture: float
    motion: float
    change: float
    area: float
    moved: float
    reached: float | None = None
    coarse: float | None = None
    fine: float | None = None

    def to_json(self) -> dict[str, float | None]:
        """Plain data."""
        return asdict(self)


def difficulty(clip: Clip) -> Difficulty:
    """Measure a completed clip; a clip without objects is as easy as can be."""
    small = sample(clip, SHORT_SIDE)
    labels = small.masks.value if small.masks is not None else np.zeros(small.frames.shape[:3], np.uint8)
    frames = small.frames.astype(np.float32) / 255.0
    shown = np.unique(np.linspace(0, len(small) - 1, min(len(small), 12)).round().astype(int))
    return Difficulty(
        texture=_decibel([_texture_error(frames[t], labels[t] > 0) for t in shown]),
        motion=_decibel(_motion_errors(small, frames, labels)),
        change=_decibel([e for k in range(small.objects) for e in _change_errors(frames, labels == k + 1, shown)]),
        area=float((labels > 0).mean()),
        moved=_moved(small, labels) * 256.0 / min(small.size),
    )


def _decibel(errors: list[tuple[float, int]]) -> float:
    """PSNR of pooled (summed squared error, pixels)."""
    count = sum(n for _, n in errors)
    return -10.0 * math.log10(max(sum(e for e, _ in errors) / count, _FLOOR)) if count else -10 * math.log10(_FLOOR)


def _pooled(a: np.ndarray, b: np.ndarray, inside: np.ndarray) -> tuple[float, int]:
    return float(((a - b)[inside] ** 2).sum()) / 3, int(inside.sum())


def _texture_error(image: np.ndarray, inside: np.ndarray) -> tuple[float, int]:
    """The picture reduced so that the objects cover PATCHES pixels, and enlarged again."""
    count = int(inside.sum())
    if not count:
        return 0.0, 0
    scale = min(1.0, math.sqrt(PATCHES / count))
    height, width = inside.shape
    size = (max(2, round(width * scale)), max(2, round(height * scale)))
    coarse = cv2.resize(cv2.resize(image, size, interpolation=cv2.INTER_AREA), (width, height),
                        interpolation=cv2.INTER_CUBIC)  # fmt: skip
    return _pooled(coarse, image, inside)


def _motion_errors(clip: Clip, frames: np.ndarray, labels: np.ndarray) -> list[tuple[float, int]]:
    """Every frame drawn from the next one through the flow."""
    if clip.flow is None or len(clip) < 2:
        return []
    height, width = labels.shape[1:]
    x, y = np.meshgrid(np.arange(width, dtype=np.float32), np.arange(height, dtype=np.float32))
    errors = []
    for t in range(len(clip) - 1):
        flow = np.nan_to_num(clip.flow.value[t]).astype(np.float32)
        there = cv2.remap(frames[t + 1], x + flow[..., 0], y + flow[..., 1], cv2.INTER_LINEAR,
                          borderMode=cv2.BORDER_REPLICATE)  # fmt: skip
        errors.append(_pooled(there, frames[t], (labels[t] > 0) & clip.flow.valid[t]))
    return errors


def _change_errors(frames: np.ndarray, mask: np.ndarray, shown: np.ndarray) -> list[tuple[float, int]]:
    """One object moved from the frame that shows most of it to others, compared where both show it."""
    area = mask.sum(axis=(1, 2))
    if not area.any():
        return []
    best = int(np.argmax(area))
    centre = np.argwhere(mask[best]).mean(axis=0)
    errors = []
    for t in shown:
        if t == best or area[t] < 0.3 * area[best]:
            continue
        dy, dx = np.argwhere(mask[t]).mean(axis=0) - centre
        shift = np.array([[1, 0, dx], [0, 1, dy]], np.float32)
        size = (mask.shape[2], mask.shape[1])
        moved = cv2.warpAffine(frames[best], shift, size)
        covers = cv2.warpAffine(mask[best].astype(np.uint8), shift, size) > 0
        errors.append(_pooled(moved, frames[t], covers & mask[t]))
    return errors


def _moved(clip: Clip, labels: np.ndarray) -> float:
    """Median length of the flow inside the objects, pixels of the clip."""
    if clip.flow is None or len(clip) < 2:
        return 0.0
    inside = (labels[:-1] > 0) & clip.flow.valid[:-1]
    return float(np.median(np.linalg.norm(clip.flow.value[:-1][inside], axis=-1))) if inside.any() else 0.0
