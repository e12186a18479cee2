"""The nine signals of suspicion, each (T,) 0..1 per frame of one track. `unit` is the pixels that are one at 1080p."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from genmojo_core.tracks.annotation import CONFIRMED, KEY, PROPOSED, Cells, Proposal
from genmojo_core.tracks.interpolate import through
from genmojo_core.tracks.model import NONE, OCCLUDED, VISIBLE

_WINDOW = 9  # frames over which motion is compared
_BORDER = 4.0  # px at 1080p
_FITS = 1.3  # links over several frames weigh less than one: this much agreement is all there can be
_USUAL_SIZE = 370.0  # px at 1080p: an object for which errors in pixels count as they are
_SIZES = (100.0, 700.0)  # smaller objects and larger ones are not told apart


@dataclass(frozen=True)
class Scene:
    """Masks of a clip: labels (T, h, w), valid (T, h, w) bool, object id -> label, scale (2,) source -> mask px."""

    labels: np.ndarray
    valid: np.ndarray
    label_of: dict[int, int]
    scale: np.ndarray


def object_size(cells: Cells, others: list[Cells], scene: Scene | None, owner: int, unit: float) -> float:
    """Side in source px of an object: of its masks, else of where its points are, else what is usual."""
    sides: list[float] = []
    if scene is not None and owner in scene.label_of:
        frames = np.unique(np.linspace(0, len(cells) - 1, 12).astype(int))
        thin = scene.labels[frames, ::4, ::4] == scene.label_of[owner]
        area = 16.0 * thin.sum(axis=(1, 2)) / float(np.prod(scene.scale))
        sides = np.sqrt(area[area > 0]).tolist()
    elif len(others) >= 2:
        xy = np.stack([c.xy for c in (cells, *others)]).astype(float)
        known = np.stack([c.state != NONE for c in (cells, *others)])
        xy[~known] = np.nan
        spans = [float(np.ptp(xy[known[:, t], t], axis=0).max()) for t in np.flatnonzero(known.sum(axis=0) >= 3)]
        sides = [s for s in spans if s > 0]
    size = float(np.median(sides)) if sides else _USUAL_SIZE * unit
    return float(np.clip(size, _SIZES[0] * unit, _SIZES[1] * unit))


def kinematics(cells: Cells, others: list[Cells], unit: float) -> np.ndarray:
    """Acceleration and speed, after those of the object's other points are taken out, against what is usual around."""
    return np.maximum(_acceleration_doubt(cells, others, unit), _speed_doubt(cells, others, unit))


def _speed_doubt(cells: Cells, others: list[Cells], unit: float) -> np.ndarray:
    """Robust z of the speed; what an object turns and bends by grows with its motion and is no error."""
    own, rest = _velocity(cells), [_velocity(o) for o in others]
    moving = np.ma.median(np.ma.masked_invalid(np.stack(rest)), axis=0).filled(0.0) if len(rest) >= 2 else 0.0 * own
    speed = np.nan_to_num(np.linalg.norm(own - moving, axis=1))
    pace = np.nan_to_num(np.linalg.norm(moving if len(rest) >= 2 else own, axis=1))
    usual = _medians(speed)
    spread = 1.4826 * _medians(speed, usual)
    step = _rising((speed - usual) / (spread + 0.1 * _medians(pace) + 1.5 * unit), 3.0, 9.0)
    return np.maximum(step, np.append(step[1:], 0.0))  # both ends of a fast step


def _acceleration_doubt(cells: Cells, others: list[Cells], unit: float) -> np.ndarray:
    known = cells.state != NONE
    own = _acceleration(cells)
    rest = [_acceleration(o) for o in others]
    if len(rest) >= 2:
        own = own - np.ma.median(np.ma.masked_invalid(np.stack(rest)), axis=0).filled(0.0)
    size = np.where(known, np.nan_to_num(np.linalg.norm(own, axis=1)), 0.0)
    beside = np.maximum(np.append(size[1:], 0.0), np.append(0.0, size[:-1]))
    size = np.where(size >= beside, size, 0.6 * size)  # a jump shows in the frames beside it too
    usual = _medians(size)
    return _rising((size - usual) / (1.5 * usual + 2.0 * unit), 2.0, 6.0)


def links(cells: Cells, gap: np.ndarray | None, size: float) -> np.ndarray:
    """Distance to where matches from frames nearby put the point (forward and backward error) over the object's size,
    where it is seen."""
    if gap is None:
        return np.zeros(len(cells))
    seen = np.where(cells.state == VISIBLE, np.nan_to_num(gap), 0.0)
    return _rising(seen / size * _USUAL_SIZE, 2.4, 7.7)


def look(likeness: np.ndarray | None, cells: Cells) -> np.ndarray:
    """Pixels unlike those at the keys, against what is usual on this track."""
    if likeness is None or not np.isfinite(likeness).any():
        return np.zeros(len(cells))
    seen = cells.state == VISIBLE
    drop = np.nanmedian(np.where(seen, likeness, np.nan)) - likeness if seen.any() else np.zeros(len(cells))
    return np.where(seen, _rising(np.nan_to_num(drop), 0.15, 0.6), 0.0)


def opinions(cells: Cells, proposals: dict[str, Proposal]) -> np.ndarray:
    """Distances (T,) in source px to where other trackers, or the seed, have the point; NaN where none says anything.

    Each is led through the keys and accepted places first, so what a person put right is held against nobody. Where
    several speak, the one that the place came from is left out.
    """
    if not proposals:
        return np.full(len(cells), np.nan)
    codes = {code: name for name, code in PROPOSED.items()}
    sure = np.flatnonzero(((cells.flags & (KEY | CONFIRMED)) > 0) & (cells.state != NONE))
    away = np.full((len(proposals), len(cells)), np.nan)
    for row, (name, proposal) in enumerate(proposals.items()):
        told = (proposal.state != NONE) & (cells.state == VISIBLE)
        way = through(proposal.xy.astype(np.float32), proposal.state != NONE, sure, cells.xy[sure])
        away[row, told] = np.linalg.norm(way - cells.xy, axis=1)[told]
        own = np.array([codes.get(int(s)) == name for s in cells.source]) & (len(proposals) > 1)
        away[row, own] = np.nan
    none = np.isnan(away).all(axis=0)
    return np.where(none, np.nan, np.nanmax(np.where(np.isnan(away), -1.0, away), axis=0))


def other_tracker(cells: Cells, away: np.ndarray | None, size: float) -> np.ndarray:
    """Distance (T,) to a second opinion over the object's size."""
    if away is None:
        return np.zeros(len(cells))
    return _rising(np.nan_to_num(away) / size * _USUAL_SIZE, 4.0, 16.0)


def mask(
    cells: Cells, scene: Scene | None, owner: int, agreement: np.ndarray | None, likeness: np.ndarray | None = None
) -> np.ndarray:
    """Seen outside its object's mask, or hidden while the mask covers it.

    An object hides its own far side, so the second is doubtful unless matches agree with the place, or the pixels there
    look like the point.
    """
    if scene is None or owner not in scene.label_of:
        return np.zeros(len(cells))
    inside, depth = _inside(cells, scene, owner)
    fits = np.full(len(cells), 0.3) if agreement is None else np.clip(_FITS * np.nan_to_num(agreement), 0.0, 1.0)
    if likeness is not None:
        fits = np.maximum(fits, _rising(np.nan_to_num(likeness), 0.5, 0.9))
    outside = _rising(-depth, 1.0, 4.0)
    hidden = np.where(inside, (0.25 + 0.7 * fits) * _rising(depth, 0.5, 3.0), 0.0)
    return np.where(cells.state == VISIBLE, outside, np.where(cells.state == OCCLUDED, hidden, 0.0))


def affine_residual(cells: Cells, others: list[Cells], unit: float) -> np.ndarray:
    """How far the steps to frames nearby are from an affine motion of the object's other points.

    A solid that turns does not move affinely, so what is usual on this track is taken off.
    """
    out = np.zeros(len(cells))
    if len(others) < 3:
        return out
    xy = np.stack([o.xy for o in others])
    known, own = np.stack([o.state != NONE for o in others]), cells.state != NONE
    for reach in (1, 4):
        error = np.full(len(cells), np.nan)
        for which, t in _alike(known[:, :-reach] & known[:, reach:], own[:-reach] & own[reach:]):
            source, target = (np.swapaxes(xy[which][:, at], 0, 1) for at in (t, t + reach))
            error[t] = _residuals(source, target, cells.xy[t], cells.xy[t + reach]) / unit
        if np.isfinite(error).any():
            size = 5.0 * np.sqrt(reach)
            doubt = _rising(np.nan_to_num(error - np.nanmedian(error)), size, 4.0 * size)
            out = np.maximum(out, np.maximum(doubt, np.concatenate([np.zeros(reach), doubt[:-reach]])))
    return out


def flicker(cells: Cells, size: tuple[int, int]) -> np.ndarray:
    """States that last one or two frames, and points seen on the very border of the picture."""
    out = np.zeros(len(cells))
    edges = np.flatnonzero(np.diff(cells.state.astype(np.int16), prepend=-1, append=-1))
    for first, end in zip(edges[:-1], edges[1:], strict=True):
        inner = first > 0 and end < len(cells)
        if inner and cells.state[first] != NONE and end - first < 3:
            out[first:end] = 0.9 if end - first == 1 else 0.6
    margin = _BORDER * size[1] / 1080.0
    near = ((cells.xy < margin) | (cells.xy > np.array(size) - margin)).any(axis=1)
    return np.maximum(out, np.where(near & (cells.state == VISIBLE), 0.5, 0.0))


def confidence(cells: Cells) -> np.ndarray:
    """The tracker's own doubt where it says the point is seen."""
    return np.where(cells.state == VISIBLE, 1.0 - cells.conf, 0.0)


def away_from_keys(cells: Cells) -> np.ndarray:
    """Frames to the nearest key: half at 10."""
    keys = np.flatnonzero(cells.flags & KEY)
    if not len(keys):
        return np.ones(len(cells))
    away = np.abs(np.arange(len(cells))[:, None] - keys[None]).min(axis=1)
    return away / (away + 10.0)


def _velocity(cells: Cells) -> np.ndarray:  # (T, 2) from the frame before, NaN where one is unknown
    out = np.full((len(cells), 2), np.nan)
    xy = np.where((cells.state == NONE)[:, None], np.nan, cells.xy)
    out[1:] = xy[1:] - xy[:-1]
    return out


def _acceleration(cells: Cells) -> np.ndarray:  # (T, 2), NaN where a neighbour is unknown
    out = np.full((len(cells), 2), np.nan)
    xy = np.where((cells.state == NONE)[:, None], np.nan, cells.xy)
    out[1:-1] = xy[:-2] - 2 * xy[1:-1] + xy[2:]
    return out


def _rising(value: np.ndarray, low: float, high: float) -> np.ndarray:
    """0 up to `low`, 1 from `high`, smooth between."""
    share = np.clip((value - low) / (high - low), 0.0, 1.0)
    return share * share * (3.0 - 2.0 * share)


def _medians(values: np.ndarray, about: np.ndarray | None = None) -> np.ndarray:  # (T,) -> (T,)
    """Medians over _WINDOW frames on either side of each; with `about` (T,) of the distances from its value there."""
    count, wide = len(values), 2 * _WINDOW + 1
    centre = np.zeros(count) if about is None else about
    out = np.empty(count)
    for t in [*range(min(_WINDOW, count)), *range(max(count - _WINDOW, _WINDOW), count)]:
        near = values[max(t - _WINDOW, 0) : t + _WINDOW + 1]
        out[t] = np.median(near if about is None else np.abs(near - centre[t]))
    if count >= wide:
        windows = np.lib.stride_tricks.sliding_window_view(values, wide)
        inner = slice(_WINDOW, count - _WINDOW)
        out[inner] = np.median(windows if about is None else np.abs(windows - centre[inner, None]), axis=1)
    return out


def _alike(known: np.ndarray, own: np.ndarray) -> list[tuple[np.ndarray, np.ndarray]]:  # (n, T) bool, (T,) bool
    """Frames own (k,) in which the same points (n,) bool are known, three at least; so that they are solved at once."""
    frames = np.flatnonzero(own & (known.sum(axis=0) >= 3))
    patterns, place = np.unique(known[:, frames], axis=1, return_inverse=True)
    return [(patterns[:, k], frames[place.ravel() == k]) for k in range(patterns.shape[1])]


def _residuals(source: np.ndarray, target: np.ndarray, here: np.ndarray, there: np.ndarray) -> np.ndarray:  # (k,)
    """Distances of `there` (k, 2) from where the motion of source (k, m, 2) to target (k, m, 2) takes `here` (k, 2);
    nearly affine."""
    middle, goal = np.median(source, axis=1, keepdims=True), np.median(target, axis=1, keepdims=True)
    a, b = source - middle, target - goal
    ridge = 0.05 * np.maximum(np.square(a).sum(axis=(1, 2)), 1e-6)[:, None, None] * np.eye(2)
    turned = np.swapaxes(a, 1, 2)
    linear = np.linalg.solve(turned @ a + ridge, turned @ b + ridge)
    led = ((here[:, None] - middle) @ linear + goal)[:, 0]
    return np.asarray(np.linalg.norm(led - there, axis=1))


def _inside(cells: Cells, scene: Scene, owner: int) -> tuple[np.ndarray, np.ndarray]:
    """Whether each place is on its mask (T,), and mask pixels to the mask's edge (T,), negative outside, at most 5."""
    reach, frames = 5, len(cells)
    _, height, width = scene.labels.shape
    grid = np.stack(np.meshgrid(np.arange(-reach, reach + 1), np.arange(-reach, reach + 1)), axis=-1).reshape(-1, 2)
    distance = np.linalg.norm(grid, axis=1)
    depth = np.zeros(frames)
    inside = np.zeros(frames, bool)
    for t in np.flatnonzero(cells.state != NONE):
        here = np.floor(cells.xy[t] * scene.scale).astype(int)
        column, row = (here + grid).T
        shown = (column >= 0) & (column < width) & (row >= 0) & (row < height)
        own = np.zeros(len(grid), bool)
        at = row[shown], column[shown]
        own[shown] = (scene.labels[t][at] == scene.label_of[owner]) & scene.valid[t][at]
        inside[t] = own[len(grid) // 2]
        unlike = distance[own != inside[t]]
        depth[t] = (1 if inside[t] else -1) * float(unlike.min(initial=reach))
    return inside, depth
