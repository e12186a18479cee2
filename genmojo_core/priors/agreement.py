"""Whether a prior says the same about one object from two of its frames (PRIOR.md section 8).

The same solid thing seen twice must give the same volume. How far two volumes differ is measured on silhouettes from
all round after one is moved into the other's space; more than the training objects' 95th percentile means that the
prior does not understand the object (or that its motion is not known), and that it had better be silent.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from functools import partial

import numpy as np
import torch
from torch import Tensor

from genmojo_core.conventions import axis_angle_matrix
from genmojo_core.priors.batches import facts_of
from genmojo_core.priors.families import draw_object
from genmojo_core.priors.generator import TRAINING, shot, view_matrices
from genmojo_core.priors.solids import Solids
from genmojo_core.priors.volume import VolumeNet, picture_rays, render

AROUND = np.array([(0, 60), (0, -60), (0, 120), (0, -120), (0, 180), (30, 0)], float)
SIDE = 24  # pixels of the silhouettes
PERCENTILE = 95.0
SEED = 7
LARGEST_TURN = 60.0  # degrees between the two views of a training object


@dataclass(frozen=True)
class Seen:
    """One volume and the camera it was predicted for.

    Args:
        volume: (1, 4, bins, side, side). elevation: degrees. distance: prior's units.
    """

    volume: Tensor
    elevation: float
    distance: float


def disagreement(one: Seen, two: Seen, to_two: np.ndarray) -> float:
    """0 (the same silhouettes) to 1 (nothing in common): 1 - sum of minima / sum of maxima of coverage.

    Args:
        to_two: (4, 4) similarity from the first volume's space to the second's, for the object at rest in both.
    """
    cameras = np.linalg.inv(view_matrices(AROUND, one.elevation, one.distance))
    scale = float(np.cbrt(np.linalg.det(to_two[:3, :3])))
    moved = to_two @ cameras
    moved[:, :3, :3] /= scale
    first = _coverage(one, cameras, one.distance, 1.0)
    second = _coverage(two, moved, one.distance * scale, scale)
    both, either = torch.minimum(first, second).sum(), torch.maximum(first, second).sum()
    return float(1.0 - both / either.clamp(min=1e-6))


def _coverage(of: Seen, cameras: np.ndarray, distance: float, scale: float) -> Tensor:
    """(V, SIDE^2) alpha from cameras (V, 4, 4) to the volume's space, which look at a place `distance` before them.

    scale: half of a picture's side there, in units of the volume's own.
    """
    rays = picture_rays(torch.tensor(cameras, dtype=torch.float32)[None], torch.tensor([of.distance]), SIDE)
    rays = replace(rays, xy=rays.xy * scale, cameras=torch.full((1, len(cameras)), distance))
    with torch.no_grad():
        return render(of.volume, rays)[0, ..., 3]


def training_percentile(net: VolumeNet, objects: int = 96) -> float:
    """The PERCENTILE of `disagreement` over training objects seen twice, with what may go wrong in training."""
    values = [_of_training_object(net, np.random.default_rng((SEED, 1, i))) for i in range(objects)]
    return float(np.percentile(values, PERCENTILE))


def _of_training_object(net: VolumeNet, rng: np.random.Generator) -> float:
    solids = draw_object(rng, TRAINING.strange)
    turn = axis_angle_matrix(np.array([0.0, 0.0, 1.0]), float(rng.uniform(-1, 1) * LARGEST_TURN))
    turned = replace(solids, placed=turn @ solids.placed, light=turn @ solids.light)
    volumes, places = [], []
    for one in (solids, turned):
        taken = None
        while taken is None:
            taken = shot(rng, partial(_same, one), TRAINING)
        condition = torch.from_numpy(taken.condition(rng, TRAINING))[None]
        with torch.no_grad():
            volume = net(condition, torch.tensor([facts_of(taken.elevation, taken.distance)]))
        volumes.append(Seen(volume, taken.elevation, taken.distance))
        places.append(_square(taken.solids.placed[0]) @ np.linalg.inv(_square(solids.placed[0])))
    return disagreement(volumes[0], volumes[1], places[1] @ np.linalg.inv(places[0]))


def _same(solids: Solids) -> Solids:
    return solids


def _square(affine: np.ndarray) -> np.ndarray:
    """(3, 4) as (4, 4)."""
    return np.vstack([affine, [0.0, 0.0, 0.0, 1.0]])
