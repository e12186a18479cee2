"""Segment Anything (SAM, SAM-HQ, SAM 2) of the transformers library from a local folder."""

from __future__ import annotations

import json
from functools import cached_property
from pathlib import Path
from typing import Any

import cv2
import numpy as np

from genmojo_core.errors import GenmojoError
from genmojo_core.estimate import network

_CLASSES = {"sam": "SamModel", "sam_hq": "SamHQModel", "sam2": "Sam2Model", "sam2_video": "Sam2Model"}


class SegmentAnything:
    """Cuts out the object in a box.

    Args:
        folder: local folder with config.json and weights; the kind of model is read from config.json.
        device: "cpu" or "cuda".
    Raises GenmojoError("missing_package") if the folder holds no such model.
    """

    def __init__(self, folder: Path, device: str = "cpu") -> None:
        self.folder, self.device = Path(folder), device
        self.kind = model_type(self.folder)
        if self.kind not in _CLASSES:
            raise GenmojoError("missing_package", f"holds a '{self.kind}' model", str(folder),
                               f"give one of {', '.join(sorted(_CLASSES))}")  # fmt: skip
        self.name = f"{self.kind} in {self.folder.name}"

    @cached_property
    def model(self) -> Any:
        """The network, loaded at first use."""
        return network.load(self.folder, _CLASSES[self.kind], self.device)

    def segment(self, frame: np.ndarray, box: np.ndarray) -> np.ndarray:  # (H, W, 3) uint8, (4,) -> (H, W) bool
        """The mask with the best predicted overlap for a box x0, y0, x1, y1 in raster pixels."""
        import torch

        h, w = frame.shape[:2]
        side = self._side()
        if self.kind.startswith("sam2"):  # stretched to a square
            inner = (side, side)
        else:  # scaled to fit, padded below and to the right
            ratio = side / max(h, w)
            inner = (max(1, round(w * ratio)), max(1, round(h * ratio)))
        pixels = np.zeros((1, 3, side, side), np.float32)
        pixels[:, :, : inner[1], : inner[0]] = network.prepare(frame, inner, network.colour_scale(self.folder))
        scaled = np.asarray(box, np.float32) * np.array([inner[0] / w, inner[1] / h] * 2, np.float32)
        with torch.inference_mode():
            output = self.model(
                pixel_values=torch.from_numpy(pixels).to(self.device),
                input_boxes=torch.from_numpy(scaled[None, None]).to(self.device),
            )
        scores = output.iou_scores.float().cpu().numpy().reshape(-1)
        logits = output.pred_masks.float().cpu().numpy()
        logits = logits.reshape(-1, *logits.shape[-2:])
        best = cv2.resize(logits[int(scores[: len(logits)].argmax())], (side, side), interpolation=cv2.INTER_LINEAR)
        return cv2.resize(best[: inner[1], : inner[0]], (w, h), interpolation=cv2.INTER_LINEAR) > 0

    def _side(self) -> int:
        """Pixels of the square the network sees."""
        value: Any = self.model.config.prompt_encoder_config.image_size
        return int(value[0] if isinstance(value, list | tuple) else value)


def model_type(folder: Path) -> str:
    """The `model_type` in a folder's config.json; empty if there is none."""
    try:
        data = json.loads((Path(folder) / "config.json").read_text("utf-8"))
    except (OSError, ValueError):
        return ""
    return str(data.get("model_type", "")) if isinstance(data, dict) else ""
