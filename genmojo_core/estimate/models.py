"""Seams for external models: what a depth, mask or text model must offer, and depth from a file.

The classes that load real networks are in `network_depth.py`, `network_masks.py` and `network_text.py`; nothing here
imports torch.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Literal, Protocol

import numpy as np

from genmojo_core.clip.clip import Clip
from genmojo_core.clip.npz import open_npz
from genmojo_core.clip.resize import nearest_valid
from genmojo_core.errors import GenmojoError


@dataclass(frozen=True)
class DepthPrediction:
    """What a depth model says about a clip.

    Args:
        value: (T, H, W) float32 at the size of the frames held. valid: (T, H, W) bool.
        kind: "metric" = depth along the axis; "disparity" = scale / depth + shift, both unknown.
        source: short name for messages.
    """

    value: np.ndarray
    valid: np.ndarray
    kind: Literal["metric", "disparity"]
    source: str


@dataclass(frozen=True)
class Detection:
    """One object found by its name: box x0, y0, x1, y1 in raster pixels of the frame, score 0..1."""

    phrase: str
    box: tuple[float, float, float, float]
    score: float


class DepthModel(Protocol):
    """Gives depth or disparity of a clip."""

    def predict(self, clip: Clip) -> DepthPrediction:
        """Depth of every frame of the clip."""
        ...


class MaskModel(Protocol):
    """Cuts out one object."""

    name: str

    def segment(self, frame: np.ndarray, box: np.ndarray) -> np.ndarray:
        """Mask (H, W) bool of the object in box x0, y0, x1, y1 (raster pixels) of a frame (H, W, 3) uint8 RGB."""
        ...


class Detector(Protocol):
    """Finds objects by name."""

    name: str

    def find(self, frame: np.ndarray, phrases: Sequence[str]) -> list[Detection]:
        """Objects named by the phrases in a frame (H, W, 3) uint8 RGB, best first."""
        ...


@dataclass(frozen=True)
class Models:
    """External models that replace embedded estimators; None leaves the embedded one.

    Args:
        depth: gives depth. masks: cuts objects out of boxes. detector: finds boxes for `phrases`.
        phrases: names of the objects to find, e.g. ("a red cup", "a hand").
    """

    depth: DepthModel | None = None
    masks: MaskModel | None = None
    detector: Detector | None = None
    phrases: tuple[str, ...] = ()


@dataclass(frozen=True)
class DepthFile:
    """Depth or disparity written by another program: an npz with `disparity`, `depth` or `depths` (N, h, w).

    DepthCrafter writes its disparity under the name `depth`, so the kind must be said. N is the number of frames of
    the clip as read, or of the source, whose frames are then picked by their number.
    """

    path: Path
    kind: Literal["metric", "disparity"] = "disparity"

    def predict(self, clip: Clip) -> DepthPrediction:
        """Values at the size of the frames held.

        Raises GenmojoError: as `open_npz`; "schema" for a wrong rank or number of frames; "empty" if none is finite.
        """
        file = open_npz(self.path)
        name = file.first_of("disparity", "depth", "depths") or "disparity"
        data = file.array(name)
        where = file.where(name)
        wanted = np.arange(len(clip)) if len(data) == len(clip) else clip.frame_index
        if data.ndim != 3 or data.dtype.kind not in "fiu" or wanted.min() < 0 or wanted.max() >= len(data):
            raise GenmojoError("schema", f"is {data.dtype} {data.shape} for a clip of {len(clip)} frames", where,
                               "give numbers (T, H, W), one plane per frame")  # fmt: skip
        planes = [self._plane(data[i].astype(np.float32), clip.size) for i in wanted]
        value, valid = (np.stack(part) for part in zip(*planes, strict=True))
        if not valid.any():
            raise GenmojoError("empty", "holds no finite value", where, "take another file")
        return DepthPrediction(value, valid, self.kind, f"{self.kind} from {self.path.name}")

    def _plane(self, plane: np.ndarray, size: tuple[int, int]) -> tuple[np.ndarray, np.ndarray]:
        """One plane at the frames' size and where it holds."""
        good = np.isfinite(plane) & ((plane > 0) | (self.kind == "disparity"))
        return nearest_valid(np.where(good, plane, 0), good, size)
