"""Does an object bend? Measures that a rigid body, however it turns, keeps small; numpy and OpenCV only.

Flow: points of a rigid body followed over a few frames span three modes (Tomasi and Kanade 1992: the centred track
matrix of a rigid body under an affine camera has rank 3); the amplitude of the fourth mode is motion that is not rigid
(Bregler et al. 2000). Outline: a mask seen whole in two frames a few frames apart, its affine change taken out, keeps
its outline unless the object bends or turns fast. Flow misses objects whose texture says nothing, outlines those that
are always touched, and both those that only stretch or lean (`upright`), so any one is enough.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass

import cv2
import numpy as np

from genmojo_core.clip.clip import Clip
from genmojo_core.effects.follow import follow
from genmojo_core.effects.objects import ObjectFacts
from genmojo_core.effects.occlusion import Cover
from genmojo_core.effects.upright import affine_change

# Limits of what rigid objects show, each between the rigid and the bending objects of the shared Blender clips.
RIGID_MODE = 0.004  # of the object's size: fourth mode (rigid at most 0.0022 there, an animal or a player 0.005-0.016)
RIGID_MODE_PX = 0.35  # pixels: error of the flow itself (rigid at most 0.25 there)
RIGID_OUTLINE = 0.02  # of the object's size: mean outline shift (rigid at most 0.017 there, the bending cylinder 0.03)
OUTLINE_NOISE_PX = 0.3  # pixels a mask's outline shifts by sampling alone
# Of what rigid objects show at most: beside others that bend, one below is rigid. Not where its outline could never be
# compared: a pedestrian always touched by another shows 0.74, fish 0.44 to 0.71, a truck 0.3.
SURELY_RIGID, SURELY_RIGID_UNSEEN = 0.6, 0.35

_FLOW_WINDOW = 6  # frames points are followed
_OUTLINE_WINDOW = 8  # frames between two outlines at most
_MOST_WINDOWS = 24  # of a long clip
_FEWEST_POINTS = 16
_MOST_POINTS = 1500
_SIDE, _EXTENT = 64, 2.6  # outline patch: pixels, half width in standard deviations of the mask
_COARSE_TURNS, _FINE_TURNS = np.arange(-180, 180, 7.5), np.arange(-5, 5.1, 1.25)  # degrees


@dataclass(frozen=True)
class Bending:
    """How far an object is from rigid.

    Args:
        mode: amplitude of the fourth mode as a share of the object's size (NaN: could not be followed).
        outline: mean shift of the outline as a share of the object's size (NaN: never seen whole for long enough).
        affine: how much it stretches or leans, as a multiple of what a rigid object shows (0: not measured).
        score: the largest of the three as a multiple of what a rigid object shows; 0 when none could be measured.
    """

    mode: float
    outline: float
    affine: float
    score: float

    @property
    def surely_rigid(self) -> bool:
        """True if it need not bend although other objects of the clip do."""
        return self.score < (SURELY_RIGID if math.isfinite(self.outline) else SURELY_RIGID_UNSEEN)


def bending(clip: Clip, k: int, facts: ObjectFacts, covers: Sequence[Cover] = ()) -> Bending:
    """Measure object k; at the edges: NaN measures and score 0 for one frame, no flow or an object hardly seen.

    Args:
        facts: of the object. covers: who covers whom (`occlusion`).
    """
    size = math.sqrt(max(int(facts.area.max(initial=0)), 1))
    mode, outline = _fourth_mode(clip, k), _outline_change(clip, k, facts)
    from_flow = min(mode / (RIGID_MODE * size), mode / RIGID_MODE_PX)
    from_outline = max(0.0, outline - OUTLINE_NOISE_PX) / (RIGID_OUTLINE * size)
    affine = affine_change(clip, k, facts, covers)
    score = max(x for x in (from_flow, from_outline, affine) if math.isfinite(x))
    return Bending(mode / size, outline / size, affine, score)


def fourth_mode(tracks: np.ndarray) -> float:  # (P, F, 2) pixels
    """Root mean square, in pixels, of the part of the motion in the fourth mode, after taking out stray points."""
    rows = tracks.transpose(1, 2, 0).reshape(-1, len(tracks)).astype(np.float64)
    keep = np.ones(rows.shape[1], bool)
    for _ in range(3):
        centred = rows - np.median(rows[:, keep], axis=1, keepdims=True)
        basis = np.linalg.svd(centred[:, keep], full_matrices=False)[0][:, :3]
        error = np.sqrt(((centred - basis @ (basis.T @ centred)) ** 2).mean(axis=0))
        keep = error <= 2.5 * np.median(error) + 1e-9
    rows = rows[:, keep] - rows[:, keep].mean(axis=1, keepdims=True)
    singular = np.linalg.svd(rows, compute_uv=False)
    return float(singular[3] / math.sqrt(rows.size / 2)) if len(singular) > 3 else math.nan


def _fourth_mode(clip: Clip, k: int) -> float:
    """The usual large value over the clip (90th percentile of the windows), pixels; NaN when nothing is followed."""
    window = min(_FLOW_WINDOW, len(clip))
    if clip.flow is None or window < 3:
        return math.nan
    masks = clip.object_mask(k)
    values = []
    for start in _starts(len(clip) - window + 1):
        tracks = follow(masks, clip.flow.value, clip.flow.valid, range(start, start + window), _MOST_POINTS)
        if len(tracks) >= _FEWEST_POINTS:
            values.append(fourth_mode(tracks))
    return float(np.percentile(values, 90)) if values else math.nan


def _outline_change(clip: Clip, k: int, facts: ObjectFacts) -> float:
    """Largest mean shift of the outline, pixels, within a window of frames that show the object whole; NaN if none."""
    whole = (facts.area >= max(60, 0.3 * facts.area.max(initial=0))) & ~facts.touches & ~facts.cut
    masks = clip.object_mask(k)
    worst = math.nan
    for start in _starts(len(clip)):
        length = int(np.argmin(np.append(whole[start : start + _OUTLINE_WINDOW], False)))
        if length < 3:
            continue
        differing = _unlike(masks[start], masks[start + length - 1])
        area = math.sqrt(float(facts.area[start]) * float(facts.area[start + length - 1]))
        shift = differing * math.sqrt(area) / 4.0  # an outline of length 4 sqrt(area), as a square has
        worst = shift if math.isnan(worst) else max(worst, shift)
    return worst


def _unlike(mask: np.ndarray, other: np.ndarray) -> float:  # (H, W) bool each
    """Share of the mask's area by which two masks differ after the affine change between them is taken out."""
    patch, place = _patch(mask, _spread(mask), 0.0), _spread(other)
    turn = 0.0
    for turns in (_COARSE_TURNS, _FINE_TURNS):
        differing = [float((patch ^ _patch(other, place, turn + step)).sum()) for step in turns]
        best = int(np.argmin(differing))
        turn += float(turns[best])
    return differing[best] / max(float(patch.sum()), 1.0)


def _spread(mask: np.ndarray) -> tuple[np.ndarray, np.ndarray]:  # (H, W) bool -> (2,), (2, 2)
    """Centre of a mask and the symmetric root of its covariance, in pixels (at least half a pixel each way)."""
    y, x = np.nonzero(mask)
    values, axes = np.linalg.eigh(np.cov(np.stack([x, y]).astype(np.float64)))
    return np.array([x.mean(), y.mean()]), axes @ np.diag(np.sqrt(np.maximum(values, 0.25))) @ axes.T


def _patch(mask: np.ndarray, spread: tuple[np.ndarray, np.ndarray], degrees: float) -> np.ndarray:
    """(64, 64) bool: the mask with its spread made round and unit, after a turn."""
    c, s = math.cos(math.radians(degrees)), math.sin(math.radians(degrees))
    grid = np.linspace(-_EXTENT, _EXTENT, _SIDE)
    places = spread[1] @ np.array([[c, -s], [s, c]]) @ np.stack(np.meshgrid(grid, grid)).reshape(2, -1)
    columns, rows = ((places + spread[0][:, None]).reshape(2, _SIDE, _SIDE)).astype(np.float32)
    return cv2.remap(mask.astype(np.float32), columns, rows, cv2.INTER_LINEAR) > 0.5


def _starts(count: int) -> list[int]:
    """At most so many window starts, spread evenly over 0..count-1."""
    return sorted({int(x) for x in np.linspace(0, count - 1, min(count, _MOST_WINDOWS)).round()}) if count > 0 else []
