"""Loading networks of the transformers library from local folders, and preparing frames for them.

Nothing is ever downloaded. Preparation is done here with OpenCV because the library's own needs torchvision.
"""

from __future__ import annotations

import importlib
import json
from pathlib import Path
from typing import Any

import cv2
import numpy as np
from safetensors import SafetensorError

from genmojo_core.errors import GenmojoError

# what the library raises for damaged or unfitting folders
_FAULTS = (OSError, ValueError, KeyError, RuntimeError, ImportError, TypeError, SafetensorError)
# mean and deviation of RGB in 0..1
IMAGENET = (np.array([0.485, 0.456, 0.406], np.float32), np.array([0.229, 0.224, 0.225], np.float32))


def load(folder: Path, class_name: str, device: str = "cpu") -> Any:
    """A model of a transformers class from a local folder, frozen and in evaluation mode.

    Raises GenmojoError("missing_package") if the library or the weights are not there or do not fit one another.
    """
    model = from_folder(folder, class_name)
    return model.to(device).eval().requires_grad_(False)


def from_folder(folder: Path, class_name: str) -> Any:
    """Anything of the transformers library (model, tokenizer) from a local folder; raises as `load`."""
    folder = Path(folder)
    try:
        library = importlib.import_module("transformers")
        loader = getattr(library, class_name)
    except (ImportError, AttributeError) as error:
        raise GenmojoError("missing_package", f"the transformers package has no {class_name} or is not installed",
                           hint="install transformers 4.56 or newer") from error  # fmt: skip
    if not (folder / "config.json").is_file():
        raise GenmojoError("missing_package", "holds no model (no config.json)", str(folder),
                           "give a folder with config.json and weights")  # fmt: skip
    try:
        return loader.from_pretrained(str(folder), local_files_only=True)
    except _FAULTS as error:
        raise GenmojoError("missing_package", f"cannot be loaded as {class_name} ({error})", str(folder),
                           "give a complete folder of that kind of model") from error  # fmt: skip


def settings(folder: Path) -> dict[str, Any]:
    """The folder's preprocessor_config.json as plain data; empty if there is none or it is damaged."""
    try:
        data = json.loads((Path(folder) / "preprocessor_config.json").read_text("utf-8"))
    except (OSError, ValueError):
        return {}
    return data if isinstance(data, dict) else {}


def colour_scale(folder: Path) -> tuple[np.ndarray, np.ndarray]:  # (3,), (3,)
    """Mean and deviation of RGB in 0..1 that the model in the folder was trained with."""
    about = settings(folder)
    pair = [np.asarray(about.get(f"image_{name}", usual), np.float32) for name, usual in
            zip(("mean", "std"), IMAGENET, strict=True)]  # fmt: skip
    usable = all(p.shape == (3,) and np.isfinite(p).all() for p in pair) and (pair[1] > 0).all()
    return (pair[0], pair[1]) if usable else IMAGENET


def prepare(frame: np.ndarray, size: tuple[int, int], scale: tuple[np.ndarray, np.ndarray]) -> np.ndarray:
    """A frame (H, W, 3) uint8 at (width, height), normalised: (1, 3, height, width) float32."""
    shrinks = size[0] * size[1] < frame.shape[0] * frame.shape[1]
    resized = cv2.resize(frame, size, interpolation=cv2.INTER_AREA if shrinks else cv2.INTER_CUBIC)
    normal = (resized.astype(np.float32) / 255.0 - scale[0]) / scale[1]
    return np.ascontiguousarray(normal.transpose(2, 0, 1)[None], dtype=np.float32)
