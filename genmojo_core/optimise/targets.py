"""What the renders are compared with: one frame's pixels, labels, depth and flow as tensors, held-out blocks cut."""

from __future__ import annotations

import math
from dataclasses import dataclass, field, replace

import numpy as np
import torch
from torch import Tensor

from genmojo_core.clip.clip import Clip

BLOCK = 4  # side of a held-out block, pixels


@dataclass(frozen=True)
class Window:
    """A part of the picture, pixels; right and bottom exclusive."""

    left: int
    top: int
    right: int
    bottom: int

    @property
    def width(self) -> int:
        """Pixels across."""
        return self.right - self.left

    @property
    def height(self) -> int:
        """Pixels down."""
        return self.bottom - self.top

    def slices(self) -> tuple[slice, slice]:
        """Rows and columns of it."""
        return slice(self.top, self.bottom), slice(self.left, self.right)


@dataclass(frozen=True)
class FrameTargets:
    """Targets of one frame; H x W at the optimised size.

    rgb (H, W, 3) 0..1; labels (H, W) int64, 0 background, k + 1 object k; seen (H, W) float, 1 where the pixel counts
    (neither void nor held out); held_out (H, W) bool; depth (H, W) and depth_seen (H, W) float; flow (H, W, 2) px to
    the next frame and flow_seen (H, W) float. `depth_scaled` tells a measured depth from a guess.
    window: the part of the frame that all this is cut from (None: the frame as a whole); beyond: background pixels that
    count outside of it; diagonal: of the whole frame, pixels.
    depth_pixels: for every label, flat indices of its pixels with depth; flow_pixels: flat indices of foreground with
    flow. They spare the terms that look at a few pixels a walk over the whole image. kept: what terms worked out once.
    """

    rgb: Tensor
    labels: Tensor
    seen: Tensor
    held_out: Tensor
    depth: Tensor
    depth_seen: Tensor
    flow: Tensor
    flow_seen: Tensor
    depth_scaled: bool
    window: Window | None = None
    beyond: float = 0.0
    diagonal: float = 0.0

    def cut(self, window: Window) -> FrameTargets:
        """The targets inside a window."""
        rows, columns = window.slices()
        names = ("rgb", "labels", "seen", "held_out", "depth", "depth_seen", "flow", "flow_seen")
        parts = {name: getattr(self, name)[rows, columns].contiguous() for name in names}
        free = ((self.labels == 0) * self.seen).sum() - ((parts["labels"] == 0) * parts["seen"]).sum()
        return replace(self, **parts, window=window, beyond=float(free), diagonal=self.diagonal)

    def corner(self) -> Tensor:  # (2,)
        """Left and top of the window in pixels of the frame."""
        return torch.tensor([0.0, 0.0] if self.window is None else [float(self.window.left), float(self.window.top)])

    def __post_init__(self) -> None:
        if not self.diagonal:
            object.__setattr__(self, "diagonal", math.hypot(*self.labels.shape))
        labels = self.labels.reshape(-1)
        has_depth = self.depth_seen.reshape(-1) > 0
        indices = [torch.nonzero((labels == k) & has_depth)[:, 0] for k in range(1, int(labels.max()) + 1)]
        object.__setattr__(self, "depth_pixels", indices)
        flowing = torch.nonzero((labels > 0) & (self.flow_seen.reshape(-1) > 0))[:, 0]
        object.__setattr__(self, "flow_pixels", flowing)

    depth_pixels: list[Tensor] = field(init=False, repr=False)
    flow_pixels: Tensor = field(init=False, repr=False)
    kept: dict = field(init=False, repr=False, compare=False, default_factory=dict)


def held_out_blocks(masks: np.ndarray, share: float, seed: int) -> np.ndarray:  # (T, H, W) labels -> bool
    """Random BLOCK x BLOCK blocks that lie in the foreground, about `share` of it, the same for the same seed."""
    frames, height, width = masks.shape
    rows, columns = height // BLOCK, width // BLOCK
    rng = np.random.default_rng(seed)
    held = np.zeros(masks.shape, bool)
    inner = masks[:, : rows * BLOCK, : columns * BLOCK].reshape(frames, rows, BLOCK, columns, BLOCK)
    foreground = (inner > 0).mean(axis=(2, 4)) > 0.5
    chosen = foreground & (rng.random(foreground.shape) < share)
    held[:, : rows * BLOCK, : columns * BLOCK] = chosen.repeat(BLOCK, axis=1).repeat(BLOCK, axis=2)
    return held


class Targets:
    """All frames of a complete clip, made into tensors frame by frame on demand (nothing is copied up front).

    Args:
        clip: complete. object_rows: clip object index -> label channel (objects that could not be lifted are dropped).
        held_out_share: of the foreground, cut from every loss. seed: of the blocks.
    """

    def __init__(self, clip: Clip, object_rows: dict[int, int], held_out_share: float, seed: int) -> None:
        self.clip = clip
        self.lookup = np.zeros(256, np.int64)
        for k, row in object_rows.items():
            self.lookup[k + 1] = row + 1
        self.held = held_out_blocks(clip.masks.value, held_out_share, seed)
        self._kept: dict[int, FrameTargets] = {}

    def __len__(self) -> int:
        return len(self.clip)

    def frame(self, t: int) -> FrameTargets:
        """Targets of frame t; the most used 64 frames stay in memory."""
        if t not in self._kept:
            if len(self._kept) >= 64:
                self._kept.pop(next(iter(self._kept)))
            self._kept[t] = self._build(t)
        return self._kept[t]

    def _build(self, t: int) -> FrameTargets:
        clip = self.clip
        labels = self.lookup[clip.masks.value[t]]
        valid = clip.masks.valid[t]
        seen = valid & ~self.held[t]
        has_depth = clip.depth is not None
        depth = clip.depth.value[t] if has_depth else np.ones(labels.shape, np.float32)
        depth_seen = clip.depth.valid[t] & seen if has_depth else np.zeros(labels.shape, bool)
        last = t + 1 >= len(clip) or clip.flow is None
        flow = np.zeros((*labels.shape, 2), np.float32) if last else clip.flow.value[t]
        flow_seen = np.zeros(labels.shape, bool) if last else clip.flow.valid[t] & seen
        return FrameTargets(
            torch.from_numpy(clip.frames[t].astype(np.float32) / 255.0),
            torch.from_numpy(labels), torch.from_numpy(seen.astype(np.float32)), torch.from_numpy(self.held[t]),
            torch.from_numpy(np.ascontiguousarray(depth, np.float32)), torch.from_numpy(depth_seen.astype(np.float32)),
            torch.from_numpy(np.ascontiguousarray(flow, np.float32)), torch.from_numpy(flow_seen.astype(np.float32)),
            has_depth and clip.depth.given,
        )  # fmt: skip
