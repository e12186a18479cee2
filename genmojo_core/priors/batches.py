"""Examples as tensors: what the two networks are trained and measured on."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
import torch
from torch import Tensor

from genmojo_core.priors.generator import Example, example, view_matrices
from genmojo_core.priors.volume import Rays, picture_rays


@dataclass(frozen=True)
class Batch:
    """B objects with K views each.

    Args:
        condition: (B, 7, C, C). facts: (B, 2). distance: (B,). to_space: (B, K, 4, 4). targets: (B, K, 4, S, S).
    """

    condition: Tensor
    facts: Tensor
    distance: Tensor
    to_space: Tensor
    targets: Tensor

    def rays(self, side: int) -> Rays:
        """Rays through all pixels of all views."""
        return picture_rays(self.to_space, self.distance, side)


def facts_of(elevation: float, distance: float) -> tuple[float, float]:
    """What the volume network is told about the condition camera: degrees, prior's units."""
    return elevation / 30.0, 1.0 / distance


def batch_of(examples: Sequence[Example], device: str = "cpu") -> Batch:
    """Examples with equally many views as one batch."""
    poses = np.stack([np.linalg.inv(view_matrices(e.views, e.elevation, e.distance)) for e in examples])
    parts = (
        np.stack([e.condition for e in examples]), np.array([facts_of(e.elevation, e.distance) for e in examples]),
        np.array([e.distance for e in examples]), poses, np.stack([e.targets for e in examples]),
    )  # fmt: skip
    return Batch(*(torch.tensor(part, dtype=torch.float32, device=device) for part in parts))


def make_batch(rng: np.random.Generator, objects: int, device: str = "cpu") -> Batch:
    """A fresh training batch; the condition's elevation is told with an error of some degrees, as clips tell it."""
    batch = batch_of([example(rng) for _ in range(objects)], device)
    wrong = torch.tensor(rng.normal(size=objects) * 0.3, dtype=torch.float32, device=device)
    batch.facts[:, 0] += wrong
    return batch
