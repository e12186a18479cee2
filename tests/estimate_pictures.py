"""Small pictures with known answers for the tests of estimators."""

import cv2
import numpy as np

from genmojo_core.clip.clip import Channel, Clip


def texture(height, width, seed=0):
    """Smooth coloured noise (H, W, 3) uint8 that flow and corners can hold on to."""
    noise = np.random.default_rng(seed).normal(size=(height, width, 3)).astype(np.float32)
    smooth = sum(cv2.GaussianBlur(noise, (0, 0), s) * s for s in (1.5, 3.0, 6.0))
    low, high = np.percentile(smooth, [1, 99])
    return np.clip(255 * (smooth - low) / (high - low), 0, 255).astype(np.uint8)


def window(picture, x, y, width, height):
    """The picture seen from (x, y), which need not be whole."""
    move = np.array([[1, 0, x], [0, 1, y]], float)
    return cv2.warpAffine(picture, move, (width, height), flags=cv2.INTER_CUBIC | cv2.WARP_INVERSE_MAP)


def clip_of(frames, labels=None, **channels):
    """A clip of square pixels around frames (T, H, W, 3) and labels (T, H, W)."""
    t, h, w = frames.shape[:3]
    count = int(labels.max()) if labels is not None else 0
    masks = None if labels is None else Channel(labels.astype(np.uint8), np.ones(labels.shape, bool), "given: test")
    return Clip(
        "made", "made", frames, np.arange(t), np.arange(t) / 10, tuple(str(i) for i in range(t)), (w, h),
        object_ids=np.arange(1, count + 1), object_names=tuple(f"object {k}" for k in range(count)), masks=masks,
        **channels,
    )  # fmt: skip


def squares(count=8, size=96, side=24, step=4, seed=0):
    """Frames and labels of a textured square that crosses a still textured background, and the background."""
    background, body = texture(size, size, seed), texture(side, side, seed + 1)[..., ::-1]
    frames, labels = np.repeat(background[None], count, axis=0), np.zeros((count, size, size), np.uint8)
    for t in range(count):
        x, y = 4 + step * t, size // 2 - side // 2
        frames[t, y : y + side, x : x + side] = body
        labels[t, y : y + side, x : x + side] = 1
    return frames, labels, background
