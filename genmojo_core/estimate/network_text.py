"""Objects found by their names: Grounding DINO, OWL-ViT or OWLv2 of the transformers library from a local folder."""

from __future__ import annotations

from collections.abc import Sequence
from functools import cached_property
from pathlib import Path
from typing import Any

import numpy as np

from genmojo_core.errors import GenmojoError
from genmojo_core.estimate import network
from genmojo_core.estimate.models import Detection
from genmojo_core.estimate.network_masks import model_type

_KINDS = ("grounding-dino", "mm-grounding-dino", "owlvit", "owlv2")
_CLIP = (
    np.array([0.48145466, 0.4578275, 0.40821073], np.float32),
    np.array([0.26862954, 0.26130258, 0.27577711], np.float32),
)
_LEAST_SCORE = {"owlvit": 0.1, "owlv2": 0.15}
_OVERLAP = 0.6  # two boxes of one phrase that overlap more are one object


class TextDetector:
    """Finds boxes of named objects.

    Args:
        folder: local folder with config.json, weights and the tokenizer's files.
        least_score: boxes under it are dropped; None for the kind's usual.
        device: "cpu" or "cuda".
    Raises GenmojoError("missing_package") if the folder holds no such model.
    """

    def __init__(self, folder: Path, least_score: float | None = None, device: str = "cpu") -> None:
        self.folder, self.device, self.kind = Path(folder), device, model_type(Path(folder))
        if self.kind not in _KINDS:
            raise GenmojoError("missing_package", f"holds a '{self.kind}' model", str(folder),
                               f"give one of {', '.join(_KINDS)}")  # fmt: skip
        self.least_score = _LEAST_SCORE.get(self.kind, 0.3) if least_score is None else least_score
        self.name = f"{self.kind} in {self.folder.name}"

    @cached_property
    def model(self) -> Any:
        """The network, loaded at first use."""
        return network.load(self.folder, "AutoModelForZeroShotObjectDetection", self.device)

    @cached_property
    def tokenizer(self) -> Any:
        """The text side of the model."""
        return network.from_folder(self.folder, "AutoTokenizer")

    def find(self, frame: np.ndarray, phrases: Sequence[str]) -> list[Detection]:
        """Boxes of the phrases in a frame (H, W, 3) uint8, best first, doubles dropped."""
        names = [phrase.strip().lower().rstrip(".") for phrase in phrases]
        names = [name for name in names if name]
        if not names:
            raise GenmojoError("argument", "names no object", "--text", "give e.g. 'a red cup'")
        scores, boxes = self._grounded(frame, names) if "dino" in self.kind else self._owl(frame, names)
        found = []
        for phrase, column in zip(names, scores.T, strict=True):
            keep = np.flatnonzero(column >= self.least_score)
            found += [Detection(phrase, _corners(boxes[q], frame.shape), float(column[q])) for q in keep]
        return _without_doubles(sorted(found, key=lambda d: -d.score))

    def _grounded(self, frame: np.ndarray, names: list[str]) -> tuple[np.ndarray, np.ndarray]:  # (Q, P), (Q, 4)
        """Grounding DINO: phrases parted by full stops; a box scores a phrase by its best token."""
        import torch

        h, w = frame.shape[:2]
        ratio = min(800 / min(h, w), 1333 / max(h, w))
        size = (max(32, round(w * ratio)), max(32, round(h * ratio)))
        pixels = torch.from_numpy(network.prepare(frame, size, network.colour_scale(self.folder))).to(self.device)
        text = self.tokenizer(" . ".join(names) + " .", return_tensors="pt").to(self.device)
        with torch.inference_mode():
            mask = torch.ones(1, size[1], size[0], dtype=torch.long, device=self.device)
            output = self.model(pixel_values=pixels, pixel_mask=mask, **text)
        scores, boxes = _scores_and_boxes(output)
        ids = text["input_ids"][0].tolist()
        stop = self.tokenizer.convert_tokens_to_ids(".")
        special = set(self.tokenizer.all_special_ids)
        owner = np.cumsum([0] + [token == stop for token in ids[:-1]])
        words = np.array([token != stop and token not in special for token in ids])
        columns = [np.flatnonzero(words & (owner == p)) for p in range(len(names))]
        return np.stack([scores[:, c].max(axis=1) if len(c) else np.zeros(len(scores)) for c in columns], 1), boxes

    def _owl(self, frame: np.ndarray, names: list[str]) -> tuple[np.ndarray, np.ndarray]:  # (Q, P), (Q, 4)
        """OWL-ViT: one text per phrase; OWLv2 sees the frame padded to a square."""
        import torch

        side = int(self.model.config.vision_config.image_size)
        scale = network.colour_scale(self.folder) if network.settings(self.folder) else _CLIP
        padded = frame
        if self.kind == "owlv2":
            longest = max(frame.shape[:2])
            padded = np.full((longest, longest, 3), 128, np.uint8)
            padded[: frame.shape[0], : frame.shape[1]] = frame
        pixels = torch.from_numpy(network.prepare(padded, (side, side), scale)).to(self.device)
        length = int(self.model.config.text_config.max_position_embeddings)
        text = self.tokenizer(names, padding="max_length", max_length=length, truncation=True, return_tensors="pt")
        with torch.inference_mode():
            output = self.model(
                pixel_values=pixels,
                input_ids=text["input_ids"].to(self.device),
                attention_mask=text["attention_mask"].to(self.device),
            )
        scores, boxes = _scores_and_boxes(output)
        stretch = np.array([padded.shape[1] / frame.shape[1], padded.shape[0] / frame.shape[0]] * 2)
        return scores, boxes * stretch


def _scores_and_boxes(output: Any) -> tuple[np.ndarray, np.ndarray]:  # (Q, C) 0..1, (Q, 4)
    """Sigmoid scores and boxes (centre x, y, width, height as shares of the image) of the first image."""
    logits = output.logits[0].float().cpu().numpy().astype(np.float64)
    scores = 1.0 / (1.0 + np.exp(-np.clip(np.nan_to_num(logits, neginf=-50.0), -50, 50)))
    return scores, output.pred_boxes[0].float().cpu().numpy()


def _corners(box: np.ndarray, shape: tuple[int, ...]) -> tuple[float, float, float, float]:
    """Corners in raster pixels, kept inside the frame, of a box given as shares (centre, size)."""
    h, w = shape[:2]
    x, y, bw, bh = (float(v) for v in box)
    return (
        float(np.clip((x - bw / 2) * w, 0, w)), float(np.clip((y - bh / 2) * h, 0, h)),
        float(np.clip((x + bw / 2) * w, 0, w)), float(np.clip((y + bh / 2) * h, 0, h)),
    )  # fmt: skip


def _without_doubles(found: list[Detection]) -> list[Detection]:
    """Detections best first; one that overlaps a better one, of whatever phrase, is the same object."""
    kept: list[Detection] = []
    for detection in found:
        if detection.box[2] - detection.box[0] < 1 or detection.box[3] - detection.box[1] < 1:
            continue
        if all(overlap(detection.box, other.box) < _OVERLAP for other in kept):
            kept.append(detection)
    return kept


def overlap(a: Sequence[float], b: Sequence[float]) -> float:
    """Intersection over union of two boxes x0, y0, x1, y1."""
    width = max(0.0, min(a[2], b[2]) - max(a[0], b[0]))
    height = max(0.0, min(a[3], b[3]) - max(a[1], b[1]))
    union = (a[2] - a[0]) * (a[3] - a[1]) + (b[2] - b[0]) * (b[3] - b[1]) - width * height
    return width * height / union if union > 0 else 0.0
