"""A running scene as numpy: the Gaussians of one frame, for previews."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import torch
from torch import Tensor

from genmojo_core.scene.gaussians import Gaussians
from genmojo_core.scene.scene4d import Scene4D


@dataclass(frozen=True)
class LiveFrame:
    """All Gaussians at one frame in world space, activated, objects first, then the background.

    means (N, 3) float32, quats (N, 4) wxyz, scales (N, 3) linear, opacities (N,) 0..1, rgb (N, 3) not clamped,
    object_id (N,) uint16 as in the clip's masks (0: background), uid (N,) uint64 as in the scene file.
    """

    means: np.ndarray
    quats: np.ndarray
    scales: np.ndarray
    opacities: np.ndarray
    rgb: np.ndarray
    object_id: np.ndarray
    uid: np.ndarray


@torch.no_grad()
def live_frame(scene: Scene4D, t: int) -> LiveFrame:
    """The scene at frame t (0..T-1), as `bake` would write it."""
    composed = scene.compose(t, scene.states([t])[0])
    sets: list[tuple[int, Gaussians]] = [(o.id, o.gaussians) for o in scene.objects]
    if scene.background is not None:
        sets.append((0, scene.background))
    owner = np.concatenate([np.full(len(g), i, np.uint16) for i, g in sets])
    uid = np.concatenate([g.uid.cpu().numpy().astype(np.uint64) + np.uint64(k << 48) for k, (_, g) in enumerate(sets)])
    return LiveFrame(
        _numpy(composed.means), _numpy(composed.quats), _numpy(composed.scales), _numpy(composed.opacities),
        _numpy(composed.features[:, :3]), owner, uid,
    )  # fmt: skip


def _numpy(values: Tensor) -> np.ndarray:
    return values.detach().float().cpu().numpy()
