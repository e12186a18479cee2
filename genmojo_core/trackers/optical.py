"""Point tracks from frames and masks alone: flow links of each object, chained with links that skip frames.

Needs no depth, no cameras and no torch. A query is followed outward from its frame. In every next frame it has several
predictions, one per earlier frame it was found in: that frame's stabilised flow at the point, or the robust affine of
the whole object where the point itself is hidden. Their weighted median is taken, so one wrong link does no harm and
drift is stopped by the links that skip frames.
"""

from __future__ import annotations

from dataclasses import dataclass

import cv2
import numpy as np

from genmojo_core.clip.clip import Clip
from genmojo_core.errors import GenmojoError
from genmojo_core.trackers.affine import applied, joined, robust_affine
from genmojo_core.trackers.search import best_shifts
from genmojo_core.trackers.stabilise import Grid, Layer, Link, Matcher, flat_shade, grid_of

_STEPS = (1, 2, 4)  # frames between the ends of a link
_SCRAP = 0.4  # of the largest area: less than this is no ground to leave the expected place
_HIDDEN = 0.2  # confidence of a place that only the object's affine motion predicts


@dataclass
class _Object:
    """One object's layer, grids, links between frames and largest area while tracks are made."""

    layer: Layer
    grids: list[Grid | None]
    matcher: Matcher
    links: dict[tuple[int, int], tuple[Link, np.ndarray] | None]
    area: float


def track_points(
    clip: Clip,
    queries_t: np.ndarray,  # (N,) frame positions
    queries_xy: np.ndarray,  # (N, 2) held raster pixels
    object_index: np.ndarray,  # (N,) 0..K-1
) -> tuple[np.ndarray, np.ndarray]:  # (N, T, 2) held raster pixels, (N, T) 0..1
    """Positions of points of objects in all frames, and how sure they are.

    A confidence above 0.5 is a place seen and matched; up to 0.2 it was carried by the object's motion while hidden; 0
    where the object is not in the frame. In its own frame a query has confidence 1.

    Raises GenmojoError("schema") if the clip has no masks, GenmojoError("value") if a query names no frame or object.
    """
    _check(clip, queries_t, object_index)
    frames = len(clip)
    xy = np.repeat(np.asarray(queries_xy, np.float64)[:, None], frames, axis=1)
    conf = np.zeros((len(xy), frames))
    shade = np.stack([flat_shade(f) for f in clip.frames])
    matcher = Matcher()
    for k in np.unique(object_index):
        mask = clip.object_mask(int(k))
        other = (clip.masks.value > 0) & ~mask if clip.masks is not None else ~mask
        layer = Layer(shade, mask, other)
        thing = _Object(
            layer, [grid_of(layer, t) for t in range(frames)], matcher, {}, float(mask.sum(axis=(1, 2)).max())
        )
        for q in np.unique(queries_t[object_index == k]):
            rows = np.nonzero((object_index == k) & (queries_t == q))[0]
            xy[rows], conf[rows] = _follow(thing, int(q), xy[rows, q])
    return xy, conf


def _check(clip: Clip, queries_t: np.ndarray, object_index: np.ndarray) -> None:
    """Raise where there is nothing to track with or a query points nowhere."""
    if clip.masks is None:
        raise GenmojoError(
            "schema", "has no masks, and points are tracked inside them", clip.path, "give masks or boxes"
        )
    if len(queries_t) and (np.min(queries_t) < 0 or np.max(queries_t) >= len(clip)):
        raise GenmojoError("value", f"a query is outside frames 0 to {len(clip) - 1}", clip.path)
    if len(object_index) and (np.min(object_index) < 0 or np.max(object_index) >= clip.objects):
        raise GenmojoError("value", f"a query names an object outside 0 to {clip.objects - 1}", clip.path)


def _follow(thing: _Object, q: int, xy: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Points (n, 2) of frame q through all frames: (n, T, 2) and confidence (n, T)."""
    frames = len(thing.grids)
    out, conf = np.repeat(xy[:, None], frames, axis=1), np.zeros((len(xy), frames))
    conf[:, q] = 1.0
    for direction in (1, -1):
        done = [q]
        t = q + direction
        while 0 <= t < frames:
            sources = [s for s in done if abs(s - t) in _STEPS or s == q] or done[-1:]
            sources.reverse()  # nearest first: links that skip frames start from those that do not
            found = [r for s in sources if (r := _carried(thing, s, t, out[:, s], conf[:, s])) is not None]
            if found:
                out[:, t], conf[:, t] = _agreed(np.stack([f[0] for f in found]), np.stack([f[1] for f in found]))
                done.append(t)
            else:
                out[:, t] = _continued(out, t, direction, q)
            t += direction
    return out, conf


def _continued(out: np.ndarray, t: int, direction: int, q: int) -> np.ndarray:  # (n, T, 2) -> (n, 2)
    """Where the points go if their last motion goes on, for frames in which the object is not seen."""
    last, before = t - direction, t - 2 * direction
    if last == q or not 0 <= before < out.shape[1]:
        return out[:, last]
    return 2 * out[:, last] - out[:, before]


def _carried(thing: _Object, s: int, t: int, xy: np.ndarray, conf: np.ndarray) -> tuple[np.ndarray, np.ndarray] | None:
    """Points of frame s in frame t by one link: (n, 2) and weights (n,)."""
    pair = _link(thing, s, t)
    grid = thing.grids[s]
    if pair is None or grid is None:
        return None
    link, affine = pair
    cells = ((xy - grid.xy[0, 0]) / grid.step).astype(np.float32)[:, None]
    weight = cv2.remap(link.weight, cells, None, cv2.INTER_LINEAR)[:, 0].astype(np.float64)
    rest = (link.xy - applied(affine, grid.xy)).astype(np.float32) * link.weight[..., None]
    sigma = max(1.5, 0.03 * max(grid.inside.shape))
    amount = cv2.GaussianBlur(link.weight, (0, 0), sigma)
    smooth = cv2.GaussianBlur(rest, (0, 0), sigma) / np.maximum(amount, 1e-3)[..., None]
    near = cv2.remap(smooth, cells, None, cv2.INTER_LINEAR, borderMode=cv2.BORDER_REPLICATE)[:, 0]
    reliable = np.clip(3.0 * cv2.remap(amount, cells, None, cv2.INTER_LINEAR)[:, 0], 0.0, 1.0)[:, None]
    place = applied(affine, xy) + near * reliable
    unseen = _HIDDEN * np.clip(3.0 * link.score, 0.01, 1.0)  # never 0: some link must be believed
    return place, np.maximum(weight, unseen) * np.maximum(conf, 0.05)


def _agreed(places: np.ndarray, weights: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Weighted geometric median (n, 2) of predictions (S, n, 2), and the confidence of the best supported (n,)."""
    centre = (places * weights[..., None]).sum(axis=0) / np.maximum(weights.sum(axis=0), 1e-9)[:, None]
    for _ in range(8):
        pull = weights / np.maximum(np.linalg.norm(places - centre, axis=-1), 0.1)
        centre = (places * pull[..., None]).sum(axis=0) / np.maximum(pull.sum(axis=0), 1e-12)[:, None]
    near = np.exp(-((np.linalg.norm(places - centre, axis=-1) / 3.0) ** 2))
    return centre, np.clip((weights * near).max(axis=0), 0.0, 1.0)


def _link(thing: _Object, s: int, t: int) -> tuple[Link, np.ndarray] | None:
    """The link between two frames with its robust affine (2, 3); None where either does not show the object."""
    if (s, t) not in thing.links:
        thing.links[s, t] = _matched(thing, s, t)
    return thing.links[s, t]


def _matched(thing: _Object, s: int, t: int) -> tuple[Link, np.ndarray] | None:
    """Match from several predictions and keep the best: the affines over the frames between, and shifts."""
    grid = thing.grids[s]
    if grid is None or thing.grids[t] is None:
        return None
    start = _chain(thing, s, t)
    predicted = applied(start, grid.xy)
    best = thing.matcher.link(thing.layer, grid, t, predicted)
    areas = thing.layer.mask[[s, t]].sum(axis=(1, 2))
    scrap = areas.min() < _SCRAP * thing.area
    size = float(np.sqrt(max(float(areas[0]), 1.0)))
    for shift in [] if scrap else best_shifts(thing.layer, grid, t, predicted):
        tried = thing.matcher.link(thing.layer, grid, t, (predicted + shift).astype(np.float32))
        if tried.score / (1.0 + float(shift @ shift) / size**2) > best.score:
            best = tried
    affine = robust_affine(grid, best, start)
    again = thing.matcher.link(thing.layer, grid, t, applied(affine, grid.xy))
    if again.score >= best.score:
        best, affine = again, robust_affine(grid, again, affine)
    return best, affine


def _chain(thing: _Object, s: int, t: int) -> np.ndarray:  # (2, 3)
    """The affine from s to t through a link already made and a further one, else the last motion, else none."""
    direction = 1 if t > s else -1
    middle = t - direction
    first, second = thing.links.get((s, middle)), thing.links.get((middle, t))
    if middle != s and first is not None and second is not None:
        return joined(second[1], first[1])
    before = thing.links.get((s - direction, s))
    return before[1] if middle == s and before is not None else np.eye(2, 3)
