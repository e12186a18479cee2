"""Small clip files for tests: images, masks and folders made on the spot."""

from __future__ import annotations

from pathlib import Path

import cv2
import numpy as np
import pytest

from genmojo_core.clip import png

SHARED = Path(__file__).resolve().parents[2] / "shared" / "data"


def shared_clip(name: str) -> Path:
    """Folder of a shared clip; skips the test where the clips are not beside the checkout."""
    if not (SHARED / name).is_dir():
        pytest.skip(f"the shared clip {name} is not beside this checkout")
    return SHARED / name


def picture(width: int = 32, height: int = 24, seed: int = 0) -> np.ndarray:
    """(H, W, 3) uint8 RGB of smooth colours, different for each seed."""
    rows, columns = np.mgrid[0:height, 0:width]
    channels = [rows * 5 + seed * 11, columns * 4 + seed * 7, (rows + columns) * 3 + seed * 3]
    return (np.stack(channels, axis=-1) % 256).astype(np.uint8)


def labels(width: int = 32, height: int = 24, ids: tuple[int, ...] = (1, 2)) -> np.ndarray:
    """(H, W) uint8: one 6 x 6 square per id, from the left."""
    index = np.zeros((height, width), np.uint8)
    for place, i in enumerate(ids):
        index[5:11, 2 + 8 * place : 8 + 8 * place] = i
    return index


def put_image(path: Path, rgb: np.ndarray) -> Path:
    """Write an image file by its extension."""
    path.parent.mkdir(parents=True, exist_ok=True)
    done, data = cv2.imencode(path.suffix, rgb[..., ::-1] if rgb.ndim == 3 else rgb)
    assert done
    path.write_bytes(data.tobytes())
    return path


def put_mask(path: Path, index: np.ndarray) -> Path:
    """Write a palette PNG."""
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_bytes(png.encode_palette(index, png.davis_palette()))
    return path


def make_clip(root: Path, frames: int = 3, numbers: list[int] | None = None, *, masks: bool = True) -> Path:
    """<root>/JPEGImages/<root's name>/NNNNN.png and Annotations likewise, two objects; returns root."""
    for t, number in enumerate(numbers or range(frames)):
        put_image(root / "JPEGImages" / root.name / f"{number:05d}.png", picture(seed=t))
        if masks:
            put_mask(root / "Annotations" / root.name / f"{number:05d}.png", labels())
    return root
