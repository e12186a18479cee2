"""Logarithms, divisions, roots and rotations whose values *and gradients* stay finite: the only place they are written.

Each function states what it returns at the edge. RELIABILITY.md rows N01, N02, N03, N11, N30 are their tests.
"""

from __future__ import annotations

import math

import torch
from torch import Tensor

LOGIT_LIMIT = 12.0  # beyond it a float32 sigmoid is 0 or 1 and its gradient is lost
LOG_SCALE_LIMIT = 20.0


def safe_divide(numerator: Tensor, denominator: Tensor, floor: float = 1e-8) -> Tensor:
    """numerator / denominator; 0 with gradient 0 where |denominator| <= floor (both operands are masked first)."""
    good = denominator.abs() > floor
    return torch.where(good, numerator / torch.where(good, denominator, torch.ones_like(denominator)), 0.0)


def safe_sqrt(value: Tensor, floor: float = 1e-12) -> Tensor:
    """Square root of max(value, floor); gradient 0 below the floor."""
    return torch.sqrt(torch.clamp(value, min=floor))


def safe_log(value: Tensor, floor: float = 1e-4) -> Tensor:
    """log(value) continued by its tangent below `floor`, so that a hopeless pixel still pulls with gradient 1/floor."""
    low = value < floor
    inside = torch.log(torch.where(low, torch.full_like(value, floor), value))
    return torch.where(low, math.log(floor) + (value - floor) / floor, inside)


def safe_norm(vector: Tensor, floor: float = 1e-8) -> Tensor:
    """Euclidean length over the last axis, at least `floor`; gradient 0 at the zero vector."""
    return safe_sqrt((vector * vector).sum(-1), floor * floor)


def logit(probability: Tensor) -> Tensor:
    """Inverse of the sigmoid, limited to +-LOGIT_LIMIT."""
    low = 1.0 / (1.0 + math.exp(LOGIT_LIMIT))
    p = probability.clamp(low, 1.0 - low)
    return torch.log(p / (1.0 - p)).clamp(-LOGIT_LIMIT, LOGIT_LIMIT)


def exp_scale(log_scale: Tensor) -> Tensor:
    """exp(log_scale), argument limited to +-LOG_SCALE_LIMIT."""
    return torch.exp(log_scale.clamp(-LOG_SCALE_LIMIT, LOG_SCALE_LIMIT))


def normalise(quats: Tensor) -> Tensor:  # (..., 4) wxyz
    """Unit quaternions; one shorter than 1e-8 becomes the identity, with gradient 0."""
    squared = (quats * quats).sum(-1, keepdim=True)
    good = squared > 1e-16
    unit = quats * torch.rsqrt(torch.where(good, squared, torch.ones_like(squared)))
    identity = torch.zeros_like(quats)
    identity[..., 0] = 1.0
    return torch.where(good, unit, identity)


def quaternion_multiply(a: Tensor, b: Tensor) -> Tensor:  # (..., 4), (..., 4) wxyz
    """Hamilton product: the rotation b followed by the rotation a."""
    aw, ax, ay, az = a.unbind(-1)
    bw, bx, by, bz = b.unbind(-1)
    return torch.stack(
        [
            aw * bw - ax * bx - ay * by - az * bz,
            aw * bx + ax * bw + ay * bz - az * by,
            aw * by - ax * bz + ay * bw + az * bx,
            aw * bz + ax * by - ay * bx + az * bw,
        ],
        dim=-1,
    )


def quaternion_conjugate(quats: Tensor) -> Tensor:
    """Inverse rotation of unit quaternions."""
    return torch.cat([quats[..., :1], -quats[..., 1:]], dim=-1)


def rotate(quats: Tensor, vectors: Tensor) -> Tensor:  # (..., 4) unit, (..., 3)
    """Vectors turned by unit quaternions: v + 2 w (u x v) + 2 u x (u x v)."""
    w, u = quats[..., :1], quats[..., 1:]
    u, vectors = torch.broadcast_tensors(u, vectors)
    cross = torch.linalg.cross(u, vectors)
    return vectors + 2.0 * (w * cross + torch.linalg.cross(u, cross))


def rotation_vector_to_quaternion(vector: Tensor) -> Tensor:  # (..., 3) radians -> (..., 4) wxyz
    """Unit quaternion of a rotation vector; Taylor series near zero, so the gradient at 0 is exact."""
    squared = (vector * vector).sum(-1, keepdim=True)
    small = squared < 1e-8
    angle = torch.sqrt(torch.where(small, torch.ones_like(squared), squared))
    factor = torch.where(small, 0.5 - squared / 48.0, torch.sin(angle / 2.0) / angle)
    real = torch.where(small, 1.0 - squared / 8.0, torch.cos(angle / 2.0))
    return torch.cat([real, factor * vector], dim=-1)


def project(points: Tensor, world_to_camera: Tensor, K: Tensor, near: float) -> tuple[Tensor, Tensor]:
    """Raster pixels (..., 2) and depths (...) of world points (..., 3); the division floors depths at `near`."""
    in_camera = points @ world_to_camera[:3, :3].T + world_to_camera[:3, 3]
    z = in_camera[..., 2]
    safe = torch.clamp(z, min=near)
    x = K[0, 0] * in_camera[..., 0] / safe + K[0, 2]
    y = K[1, 1] * in_camera[..., 1] / safe + K[1, 2]
    return torch.stack([x, y], dim=-1), z
