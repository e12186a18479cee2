"""Object space to world, frame by frame: similarity from the initial motion, then a trainable turn, shift and dolly.

METHOD.md section 3. For frame t: x_world = s_t R_t x + t_t; the turn is about the object's centre; the shift is in
units of the object's size; the depth dolly x <- C - (C - x) k_t about the camera centre C moves the object in depth
without changing its projection, and multiplies sigma by the *same frame's* k_t.
"""

from __future__ import annotations

import numpy as np
import torch
from torch import Tensor, nn

from genmojo_core.conventions import matrix_to_quaternion, quaternion_to_matrix
from genmojo_core.scene import safemath

DOLLY_STEP = 0.05  # largest change of k from frame to frame


class Placement(nn.Module):
    """Where one object is in every frame.

    Args:
        pose: (T, 4, 4) similarity [s R | t] from object space to world.
        camera_centres: (T, 3) world.
    """

    def __init__(self, pose: np.ndarray, camera_centres: np.ndarray) -> None:
        super().__init__()
        size = np.cbrt(np.linalg.det(pose[:, :3, :3]))
        self.register_buffer("size", torch.tensor(size, dtype=torch.float32))
        quats = matrix_to_quaternion(pose[:, :3, :3] / size[:, None, None])
        self.register_buffer("quats", torch.tensor(quats, dtype=torch.float32))
        self.register_buffer("origin", torch.tensor(pose[:, :3, 3], dtype=torch.float32))
        self.register_buffer("centres", torch.tensor(camera_centres, dtype=torch.float32))
        frames = len(pose)
        self.turn = nn.Parameter(torch.zeros(frames, 3))  # rotation vector, radians
        self.shift = nn.Parameter(torch.zeros(frames, 3))  # in units of the object's size, world axes
        self.log_dolly = nn.Parameter(torch.zeros(frames))

    size: Tensor
    quats: Tensor
    origin: Tensor
    centres: Tensor

    def similarity(self, t: int) -> tuple[Tensor, Tensor, Tensor]:
        """Scale (), unit quaternion (4,) and translation (3,) of frame t, dolly included."""
        k = torch.exp(self.log_dolly[t].clamp(-2.0, 2.0))
        quat = safemath.quaternion_multiply(safemath.rotation_vector_to_quaternion(self.turn[t]), self.quats[t])
        origin = self.origin[t] + self.size[t] * self.shift[t]
        return self.size[t] * k, quat, self.centres[t] + k * (origin - self.centres[t])

    def smoothness(self) -> Tensor:
        """Mean squared second difference in time of turn, shift and dolly; 0 for fewer than three frames."""
        if len(self.turn) < 3:
            return self.turn.sum() * 0.0
        track = torch.cat([self.turn, self.shift, self.log_dolly[:, None]], dim=1)
        second = track[2:] - 2.0 * track[1:-1] + track[:-2]
        return (second * second).mean()

    @torch.no_grad()
    def limit_dolly(self, start: int) -> None:
        """Project the dolly back onto small steps per frame, outward from the canonical frame."""
        k = limited_dolly(np.exp(self.log_dolly.clamp(-2.0, 2.0).double().numpy()), start)
        self.log_dolly.copy_(torch.from_numpy(np.log(np.maximum(k, 0.1))))

    def baked(self) -> tuple[np.ndarray, np.ndarray]:
        """(T, 3, 4) [s R | t] with everything included, and (T,) dolly factors."""
        rows = np.zeros((len(self.turn), 3, 4))
        with torch.no_grad():
            for t in range(len(self.turn)):
                s, q, origin = self.similarity(t)
                rows[t, :, :3] = float(s) * quaternion_to_matrix(safemath.normalise(q).double().numpy())
                rows[t, :, 3] = origin.double().numpy()
            dolly = torch.exp(self.log_dolly.clamp(-2.0, 2.0)).numpy()
        return rows, dolly


def limited_dolly(k: np.ndarray, start: int) -> np.ndarray:  # (T,) -> (T,)
    """Depth factors followed outward from frame `start` in steps of at most DOLLY_STEP per frame.

    A slow series is returned unchanged; a jump is caught up with over several frames, not cut off for good.
    """
    k = np.asarray(k, dtype=np.float64)
    limited = k.copy()
    for order in (range(start + 1, len(k)), range(start - 1, -1, -1)):
        for t in order:
            before = limited[t - 1] if t > start else limited[t + 1]
            limited[t] = before + np.clip(k[t] - before, -DOLLY_STEP, DOLLY_STEP)
    return limited
