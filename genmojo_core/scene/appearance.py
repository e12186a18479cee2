"""Light that changes over the clip: one gain per frame and colour channel for the whole scene.

Kept apart from the per-Gaussian colour head so that a lamp that dims is told in 3 T numbers, not in colour changes that
would stand in for motion.
"""

from __future__ import annotations

import torch
from torch import Tensor, nn

from genmojo_core.scene import safemath


class FrameGain(nn.Module):
    """rgb_t = rgb * gain_t, with gain 1 in the reference frame's stead of a global scale.

    Args:
        frames: T. start: (T, 3) measured gains, or None for ones.
    """

    def __init__(self, frames: int, start: Tensor | None = None) -> None:
        super().__init__()
        gains = torch.ones(frames, 3) if start is None else start.float().clamp(0.05, 20.0)
        self.log_gain = nn.Parameter(safemath.safe_log(gains))

    def forward(self, t: int) -> Tensor:
        """(3,) gain of frame t."""
        return torch.exp(self.log_gain[t].clamp(-3.0, 3.0))
