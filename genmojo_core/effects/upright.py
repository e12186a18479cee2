"""Does an object stretch or lean? Its outline's proportions, which turning about the vertical leaves alone; numpy only.

A body that stretches or leans changes by an affine map, which neither the fourth mode of flow nor an outline freed of
affine changes can see (`shape`). Seen from afar, its outline's second moments tell: turning about the vertical changes
their width alone, distance their size alone, and a turn in the picture (`roll`) turns them. What none of these explains
is not rigid. A flat thing that tips towards the camera looks alike, and is taken for one that shrinks.
"""

from __future__ import annotations

import math
from collections.abc import Sequence

import numpy as np

from genmojo_core.clip.clip import Clip
from genmojo_core.effects.objects import ObjectFacts
from genmojo_core.effects.occlusion import Cover

# Limits of what rigid objects show, fixed on made clips 0 to 99 (measure/effect_truth.py).
RIGID_STRETCH = 0.09  # change of log height (turning cubes at most 0.06; a change of 15 % of height is 3 % of the size)
RIGID_LEAN = 0.13  # change of sideways shift per height (turning cubes at most 0.12)
_WINDOW = 12  # frames that are compared
_SPARED = 6  # frames from which on the greatest and the least value are taken for chance
_LEAST_AREA, _LEAST_SHARE = 60, 0.3  # pixels, and share of the largest area, of an outline that says something


def affine_change(clip: Clip, k: int, facts: ObjectFacts, covers: Sequence[Cover]) -> float:
    """How much object k stretches or leans, as a multiple of what rigid objects show; 0 where it is not seen whole.

    Args:
        facts: of the object. covers: who covers whom; frames in which it lies behind another are left out.
    """
    hidden = np.zeros(len(clip), bool)
    for cover in covers:
        if cover.back == k:
            hidden[list(cover.frames)] = True
    large = facts.area >= max(_LEAST_AREA, _LEAST_SHARE * facts.area.max(initial=0))
    frames = np.flatnonzero(large & ~facts.cut & ~hidden)
    if len(frames) < 2:
        return 0.0
    masks = clip.object_mask(k)
    raw = np.stack([_moments(masks[t]) for t in frames])
    turned = np.stack([_turned(one, -angle) for one, angle in zip(raw, roll(clip, masks)[frames], strict=True)])
    depth = np.log(facts.depth[frames]) if np.isfinite(facts.depth[frames]).all() else np.zeros(len(frames))
    worst = 0.0
    for start in range(len(frames) - 1):
        chosen = (frames >= frames[start]) & (frames < frames[start] + _WINDOW)
        worst = max(worst, min(_change(moments[chosen], depth[chosen]) for moments in (raw, turned)))
    return worst


def roll(clip: Clip, masks: np.ndarray) -> np.ndarray:  # (T, H, W) bool -> (T,) radians
    """How far the flow turned what lies in the masks in the picture since frame 0; nothing where there is no flow."""
    steps = np.zeros(len(clip))
    if clip.flow is None:
        return steps
    for t in range(len(clip) - 1):
        y, x = np.nonzero(masks[t] & clip.flow.valid[t])
        if len(x) < _LEAST_AREA:
            continue
        rows = np.column_stack([x - x.mean(), y - y.mean(), np.ones(len(x))])
        flow = clip.flow.value[t][y, x].astype(np.float64)
        keep = np.ones(len(x), bool)
        for _ in range(3):
            found = np.linalg.lstsq(rows[keep], flow[keep], rcond=None)[0]
            error = np.linalg.norm(flow - rows @ found, axis=1)
            keep = error <= 2.5 * np.median(error) + 1e-9
        steps[t + 1] = 0.5 * (found[0, 1] - found[1, 0])
    return np.cumsum(steps)


def _change(moments: np.ndarray, depth: np.ndarray) -> float:  # (F, 3) xx, xy, yy; (F,) log
    """The larger of stretch and lean over some frames, as multiples of their limits.

    Height counts as far as neither the depth, nor a wrong depth, nor coming nearer as the width says explains it.
    """
    height, width = 0.5 * np.log(moments[:, 2]), 0.5 * np.log(moments[:, 0])
    stretch = min(_range(height + depth), _range(height), _range(height - width))
    return max(stretch / RIGID_STRETCH, _range(moments[:, 1] / moments[:, 2]) / RIGID_LEAN)


def _range(values: np.ndarray) -> float:
    """Largest less smallest value, of many the second ones."""
    ordered = np.sort(values)
    spared = 1 if len(ordered) >= _SPARED else 0
    return float(ordered[len(ordered) - 1 - spared] - ordered[spared])


def _moments(mask: np.ndarray) -> np.ndarray:  # (H, W) bool -> (3,) xx, xy, yy in square pixels
    """Second moments of a mask about its centre, that of one pixel added so that none is zero."""
    y, x = np.nonzero(mask)
    return np.array([x.var(), ((x - x.mean()) * (y - y.mean())).mean(), y.var()]) + [1 / 12, 0.0, 1 / 12]


def _turned(moments: np.ndarray, angle: float) -> np.ndarray:  # (3,) -> (3,)
    """Second moments of a mask turned by an angle from x towards y."""
    c, s = math.cos(angle), math.sin(angle)
    xx, xy, yy = moments
    return np.array([c * c * xx - 2 * c * s * xy + s * s * yy, c * s * (xx - yy) + (c * c - s * s) * xy,
                     s * s * xx + 2 * c * s * xy + c * c * yy])  # fmt: skip
