"""How the pixels of one object move between any two frames of a clip, found once and kept.

A link is a dense match from one frame to another (`stabilise.Matcher`), begun from a prediction. Predictions are the
weak part: texture that repeats, or a motion of half an object, lets a match slip. Whoever knows better (keys that a
person placed) gives `expected` places and slipped links are matched again from there.
"""

from __future__ import annotations

from dataclasses import dataclass

import cv2
import numpy as np

from genmojo_core.trackers.affine import applied, fit_affine, inverted, joined, robust_affine
from genmojo_core.trackers.search import best_shifts
from genmojo_core.trackers.stabilise import Grid, Layer, Link, Matcher, grid_of

_SCRAP = 0.4  # of the largest area: less than this is no ground to leave the expected place
_REACH = 3.0  # how far a smooth link is trusted beyond the places it matched


@dataclass(frozen=True)
class Path:
    """A link made ready for asking at any place.

    affine (2, 3) of the whole object; rest (h, w, 2) smooth deviation from it, amount (h, w) how much was matched
    around a cell; weight (h, w) and score as in `Link`.
    """

    affine: np.ndarray
    rest: np.ndarray
    amount: np.ndarray
    weight: np.ndarray
    score: float


class ObjectMotion:
    """Links between the frames of one object. Holds OpenCV objects: use one per thread.

    Args:
        layer: the object through the clip. known: (T,) bool frames that have masks, by default all.
    """

    def __init__(self, layer: Layer, known: np.ndarray | None = None) -> None:
        self.layer = layer
        self.known = np.ones(len(layer.mask), bool) if known is None else known
        self.frames = len(layer.mask)
        self.areas = layer.mask.sum(axis=(1, 2)).astype(np.float64)
        self._matcher = Matcher()
        self._grids: dict[int, Grid | None] = {}
        self._paths: dict[tuple[int, int], Path | None] = {}
        self._asked: dict[tuple[int, int], set[bytes]] = {}  # places that a link was held against

    def grid(self, t: int) -> Grid | None:
        """Sampling places of the object in frame t, None where it is not seen."""
        if t not in self._grids:
            self._grids[t] = grid_of(self.layer, t)
        return self._grids[t]

    def path(self, s: int, t: int) -> Path | None:
        """The link from frame s to t; None where either does not show the object."""
        if (s, t) not in self._paths:
            self._paths[s, t] = self._matched(s, t)
        return self._paths[s, t]

    def linear(self, s: int, t: int) -> np.ndarray:  # (2, 2)
        """How offsets of frame s look in frame t, for the whole object; the identity without a link."""
        path = self.path(s, t)
        return np.eye(2) if path is None else path.affine[:, :2]

    def carry(self, s: int, t: int, xy: np.ndarray) -> tuple[np.ndarray, np.ndarray, np.ndarray] | None:
        """Places (n, 2) of frame s in frame t, weights (n,) 0..1 of their own match, and trust (n,) in the motion
        around them; None where either frame does not show the object."""
        path, grid = self.path(s, t), self.grid(s)
        if path is None or grid is None:
            return None
        cells = ((xy - grid.xy[0, 0]) / grid.step).astype(np.float32)[:, None]
        weight = cv2.remap(path.weight, cells, None, cv2.INTER_LINEAR)[:, 0].astype(np.float64)
        near = cv2.remap(path.rest, cells, None, cv2.INTER_LINEAR, borderMode=cv2.BORDER_REPLICATE)[:, 0]
        trust = np.clip(_REACH * cv2.remap(path.amount, cells, None, cv2.INTER_LINEAR)[:, 0], 0.0, 1.0)
        return applied(path.affine, xy) + near * trust[:, None], weight, trust * path.score

    def relink(self, s: int, t: int, source: np.ndarray, target: np.ndarray, slack: float) -> bool:
        """Match again if the link contradicts places known in both frames; True if a better one was found.

        The same places are asked about once.

        Args:
            s, t: frames. source, target: (n, 2) the same points in either. slack: pixels they may be wrong.
        """
        said = np.concatenate([source, target]).tobytes()
        if said in self._asked.setdefault((s, t), set()):
            return False
        self._asked[s, t].add(said)
        carried = self.carry(s, t, source)
        grid = self.grid(s)
        if carried is None or grid is None:
            return False
        before = float(np.median(np.linalg.norm(carried[0] - target, axis=1)))
        if before < slack:
            return False
        start = fit_affine(source, target, self._paths[s, t].affine)  # type: ignore[union-attr]
        old = self._paths[s, t]
        self._paths[s, t] = self._from(s, t, grid, start)
        again = self.carry(s, t, source)
        if again is not None and float(np.median(np.linalg.norm(again[0] - target, axis=1))) < before:
            self._asked[s, t] = {said}
            return True
        self._paths[s, t] = old
        return False

    def _matched(self, s: int, t: int) -> Path | None:
        """Match from several predictions and keep the best: the affines over the frames between, and shifts."""
        grid = self.grid(s)
        if grid is None or self.grid(t) is None:
            return None
        start = self._chain(s, t)
        predicted = applied(start, grid.xy)
        best = self._matcher.link(self.layer, grid, t, predicted)
        scrap = self.areas[[s, t]].min() < _SCRAP * self.areas.max()
        size = float(np.sqrt(max(self.areas[s], 1.0)))
        for shift in [] if scrap else best_shifts(self.layer, grid, t, predicted):
            tried = self._matcher.link(self.layer, grid, t, (predicted + shift).astype(np.float32))
            if tried.score / (1.0 + float(shift @ shift) / size**2) > best.score:
                best = tried
        return self._refined(grid, t, best, start)

    def _from(self, s: int, t: int, grid: Grid, start: np.ndarray) -> Path:
        """Match from one prediction."""
        return self._refined(grid, t, self._matcher.link(self.layer, grid, t, applied(start, grid.xy)), start)

    def _refined(self, grid: Grid, t: int, link: Link, start: np.ndarray) -> Path:
        """Match once more at full resolution from the link's own affine, keep the better, smooth it."""
        affine = robust_affine(grid, link, start)
        again = self._matcher.link(self.layer, grid, t, applied(affine, grid.xy), fine=True)
        if again.score >= link.score:
            link, affine = again, robust_affine(grid, again, affine)
        rest = (link.xy - applied(affine, grid.xy)).astype(np.float32) * link.weight[..., None]
        sigma = max(1.5, 0.03 * max(grid.inside.shape))
        amount = cv2.GaussianBlur(link.weight, (0, 0), sigma)
        smooth = cv2.GaussianBlur(rest, (0, 0), sigma) / np.maximum(amount, 1e-3)[..., None]
        return Path(affine, smooth, amount, link.weight, link.score)

    def _chain(self, s: int, t: int) -> np.ndarray:  # (2, 3)
        """Where to begin from s to t: two links half as long, the way back turned round, the last motion, or none."""
        direction = 1 if t > s else -1
        if abs(t - s) > 1:
            middle = self._between(s, t)
            first, second = (self.path(s, middle), self.path(middle, t)) if middle is not None else (None, None)
            return joined(second.affine, first.affine) if first is not None and second is not None else np.eye(2, 3)
        back, before = self._paths.get((t, s)), self._paths.get((s - direction, s))
        if back is not None:
            return inverted(back.affine)
        return before.affine if before is not None else np.eye(2, 3)

    def _between(self, s: int, t: int) -> int | None:
        """The frame nearest to the middle of two, rounded towards t, that shows the object; None if none does."""
        middle = s + int(np.sign(t - s)) * ((abs(t - s) + 1) // 2)
        between = [m for m in range(min(s, t) + 1, max(s, t)) if self.grid(m) is not None]
        return min(between, key=lambda m: abs(m - middle)) if between else None
