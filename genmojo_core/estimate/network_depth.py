"""Depth-Anything-V2 (and other depth networks of the transformers library) from a local folder."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path
from typing import Any

import cv2
import numpy as np

from genmojo_core.clip.clip import Clip
from genmojo_core.estimate import network
from genmojo_core.estimate.models import DepthPrediction

_SIDE = 518  # pixels of the short side that Depth-Anything was trained at


@dataclass(frozen=True)
class DepthNetwork:
    """A depth network; relative ones give disparity, metric ones depth (told by their config).

    Args:
        folder: local folder with config.json and weights.
        short_side: pixels the frames are brought to; None for the model's own.
        device: "cpu" or "cuda".
    """

    folder: Path
    short_side: int | None = None
    device: str = "cpu"

    def predict(self, clip: Clip) -> DepthPrediction:
        """Depth or disparity of every frame; raises GenmojoError("missing_package") as `network.load`."""
        model = network.load(self.folder, "AutoModelForDepthEstimation", self.device)
        metric = getattr(model.config, "depth_estimation_type", "relative") == "metric"
        head = getattr(model, "head", None)
        if head is not None and getattr(head, "max_depth", 1.0) is None:
            head.max_depth = 1.0  # relative models leave it out of their config
        scale = network.colour_scale(self.folder)
        size = self._input_size(clip, _patch(model))
        value = np.stack([self._one(model, network.prepare(frame, size, scale), clip.size) for frame in clip.frames])
        valid = np.isfinite(value) & ((value > 0) | (not metric))
        return DepthPrediction(
            np.where(valid, value, 0), valid, "metric" if metric else "disparity", f"the network in {self.folder.name}"
        )

    def _input_size(self, clip: Clip, patch: int) -> tuple[int, int]:
        """(width, height) of whole patches in the shape the picture is shown in."""
        width, height = clip.size[0] * clip.held_pixel_aspect, float(clip.size[1])
        ratio = (self.short_side or network.settings(self.folder).get("size", {}).get("height", _SIDE)) / min(
            width, height
        )
        return max(1, round(width * ratio / patch)) * patch, max(1, round(height * ratio / patch)) * patch

    def _one(self, model: Any, pixels: np.ndarray, size: tuple[int, int]) -> np.ndarray:  # (H, W) float32
        """One frame through the network, brought back to the frame's size."""
        import torch

        with torch.inference_mode():
            output = model(pixel_values=torch.from_numpy(pixels).to(self.device)).predicted_depth
        plane = output[0].float().cpu().numpy()
        return cv2.resize(plane, size, interpolation=cv2.INTER_LINEAR)


def _patch(model: Any) -> int:
    """Side of a patch in pixels."""
    backbone = getattr(model.config, "backbone_config", None)
    return int(getattr(model.config, "patch_size", None) or getattr(backbone, "patch_size", None) or 14)
