"""Priors on motion: neighbours move, turn and resize alike; changes stay small (METHOD.md section 4, corrected).

Positions are in object space, where the similarity to the world cancels out of every difference.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import torch
from torch import Tensor

from genmojo_core.kernels.probe import kernels_work
from genmojo_core.scene import safemath
from genmojo_core.scene.deform import Deformation
from genmojo_core.scene.scene4d import ObjectState

REACH = 10.0  # w = exp(-REACH distance) at unit object size


@dataclass(frozen=True)
class Neighbours:
    """index (N, k) int64 of each Gaussian's nearest others; weight (N, k) = exp(-10 d)."""

    index: Tensor
    weight: Tensor


def nearest(points: Tensor, count: int) -> Neighbours:  # (N, 3)
    """The `count` nearest other points of each point, distances direct and centred (RELIABILITY.md N24).

    With fewer than count + 1 points, all others; a single point gets itself with weight 0.
    """
    total = len(points)
    count = min(count, total - 1)
    if count < 1:
        return Neighbours(torch.zeros(total, 1, dtype=torch.int64), torch.zeros(total, 1))
    centred = points.detach() - points.detach().mean(dim=0)
    index, distance = [], []
    for chunk in centred.split(1024):
        all_distances = torch.cdist(chunk, centred, compute_mode="donot_use_mm_for_euclid_dist")
        near, which = all_distances.topk(count + 1, largest=False)
        index.append(which[:, 1:])
        distance.append(near[:, 1:])
    return Neighbours(torch.cat(index), torch.exp(-REACH * torch.cat(distance)))


def rigidity(now: ObjectState, after: ObjectState, neighbours: Neighbours, rows: Tensor) -> tuple[Tensor, Tensor]:
    """(L_rigid, L_rot) between two frames over some rows; both 0 on any rigid motion with matching quaternions.

    L_rigid = mean sqrt(w |(x_j - x_i)_t - R_t R_t'^T (x_j - x_i)_t'|^2), with the rotation that takes t' back to t
    (the released code uses its transpose). L_rot = mean sqrt(w |q_rel,j - q_rel,i|^2), q_rel = q_t q_t'^-1.
    """
    pair = (now.local_means, after.local_means, now.local_quats, after.local_quats)
    if all(p.dtype == torch.float32 and p.device.type == "cpu" for p in pair) and kernels_work():
        rigid, turned = _Rigidity.apply(neighbours, rows, *pair).unbind()
        return rigid, turned
    return rigidity_torch(now, after, neighbours, rows)


def rigidity_torch(
    now: ObjectState, after: ObjectState, neighbours: Neighbours, rows: Tensor
) -> tuple[Tensor, Tensor]:  # fmt: skip
    """`rigidity` in plain torch, any device and dtype."""
    index, weight = neighbours.index[rows], neighbours.weight[rows]
    edges_now = now.local_means[index] - now.local_means[rows][:, None]
    edges_after = after.local_means[index] - after.local_means[rows][:, None]
    turn = safemath.quaternion_multiply(now.local_quats, safemath.quaternion_conjugate(after.local_quats))
    back = safemath.rotate(turn[rows][:, None].expand(-1, index.shape[1], -1), edges_after)
    moved = (weight * ((edges_now - back) ** 2).sum(-1)).clamp(min=0)
    own, others = turn[rows][:, None], turn[index]
    others = torch.where((own * others).sum(-1, keepdim=True) < 0, -others, others)  # q and -q are one rotation
    turned = weight * ((others - own) ** 2).sum(-1)
    return safemath.safe_sqrt(moved).mean(), safemath.safe_sqrt(turned).mean()


def scale_terms(deformation: Deformation, neighbours: Neighbours, rows: Tensor) -> tuple[Tensor, Tensor]:
    """(local, size): neighbours change log scale alike, and mean |change of log scale|."""
    change = deformation.d_log_scales
    index, weight = neighbours.index[rows], neighbours.weight[rows]
    local = weight * ((change[index] - change[rows][:, None]) ** 2).sum(-1)
    return safemath.safe_sqrt(local).mean(), change[rows].abs().mean()


class _Rigidity(torch.autograd.Function):
    """`rigidity` through the kernel: both terms in one walk over the edges."""

    @staticmethod
    def forward(ctx: Any, neighbours: Neighbours, rows: Tensor, *pair: Tensor) -> Tensor:
        """(2,) both terms; keeps the arrays for backward."""
        from genmojo_core.scene.motion_cpu.rigidity import Edges, Pair, rigid_terms

        ctx.pair = Pair(*(p.detach().contiguous().numpy() for p in pair))
        ctx.edges = Edges(*(t.contiguous().numpy() for t in (neighbours.index, neighbours.weight, rows)))
        return torch.from_numpy(rigid_terms(ctx.pair, ctx.edges)).float()

    @staticmethod
    @torch.autograd.function.once_differentiable
    def backward(ctx: Any, upstream: Tensor) -> tuple[Any, ...]:
        """Gradients of the positions and quaternions at both times."""
        from genmojo_core.scene.motion_cpu.rigidity import rigid_gradients

        gradients = rigid_gradients(ctx.pair, ctx.edges, upstream.double().numpy())
        return None, None, *(torch.from_numpy(g) for g in gradients)
