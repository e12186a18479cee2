"""Contact sheets: a scene beside its clip on one picture, to look at (issue 2: input, render, depth, labels, views)."""

from __future__ import annotations

from pathlib import Path

import cv2
import numpy as np

from genmojo_core.clip.clip import Clip
from genmojo_core.errors import GenmojoError
from genmojo_core.measure.reconstruction import matching_frames, picture_at
from genmojo_core.measure.views import Look, Picture, orbit_target, orbit_view, render_frame
from genmojo_core.store.atomic import write_bytes
from genmojo_core.store.scene_file import BakedScene

NOVEL = ((0.0, 30.0), (30.0, 0.0))  # elevation, azimuth in degrees
_TITLES = ("input", "render", "depth", "labels", "view 0, 30", "view 30, 0")
_GAP = 4


def write_sheet(scene: BakedScene, clip: Clip, path: str | Path, rows: int = 4) -> None:
    """Write a PNG: `rows` frames spread over the clip, six columns. Raises GenmojoError("io")."""
    write_bytes(path, encode_png(contact_sheet(scene, clip, rows)))


def contact_sheet(scene: BakedScene, clip: Clip, rows: int = 4) -> np.ndarray:  # (H, W, 3) uint8 RGB
    """The sheet as an image; every cell has the clip's held size."""
    positions = matching_frames(scene, clip)
    target = orbit_target(scene)
    chosen = np.unique(np.linspace(0, len(scene) - 1, min(rows, len(scene))).round().astype(int))
    lines = []
    for t in chosen:
        picture = picture_at(scene, int(t), clip.size)
        views = [orbit_view(scene, int(t), e, a, target).resized(*clip.size) for e, a in NOVEL]
        cells = [
            clip.frames[positions[t]],
            to_bytes(picture.on()),
            depth_picture(picture),
            label_picture(scene, picture),
        ]
        cells += [to_bytes(render_frame(scene, int(t), view, Look()).on((0.0, 0.0, 0.0))) for view in views]
        lines.append(np.concatenate([_framed(cell) for cell in cells], axis=1))
    return np.concatenate([_titles(lines[0].shape[1]), *lines], axis=0)


def depth_picture(picture: Picture) -> np.ndarray:  # (H, W, 3) uint8 RGB
    """Depth in colours, near = bright; scaled to the 2nd..98th percentile of what shows; black where nothing does."""
    seen = picture.depth > 0
    if not seen.any():
        return np.zeros((*picture.depth.shape, 3), np.uint8)
    near, far = np.percentile(picture.depth[seen], [2, 98])
    level = 1 - np.clip((picture.depth - near) / max(far - near, 1e-9), 0, 1)
    colored = cv2.applyColorMap(np.round(level * 255).astype(np.uint8), cv2.COLORMAP_INFERNO)[..., ::-1]
    return np.where(seen[..., None], colored, 0).astype(np.uint8)


def label_picture(scene: BakedScene, picture: Picture) -> np.ndarray:  # (H, W, 3) uint8 RGB
    """Instances in their display colours; the background dark, nothing black."""
    colors = [(0.2, 0.2, 0.2) if o.is_background else o.color for o in scene.objects]
    table = np.array([*colors, (0.0, 0.0, 0.0)], np.float32)
    return to_bytes(table[picture.instance()])


def flow_picture(flow: np.ndarray) -> np.ndarray:  # (H, W, 2) px -> (H, W, 3) uint8 RGB
    """Direction as hue, length as saturation, relative to the 99th percentile of lengths."""
    length, angle = cv2.cartToPolar(flow[..., 0].astype(np.float32), flow[..., 1].astype(np.float32))
    most = max(float(np.percentile(length, 99)), 1e-6)
    hsv = np.stack([angle * (90 / np.pi), np.clip(length / most, 0, 1) * 255, np.full_like(length, 255)], axis=-1)
    return cv2.cvtColor(hsv.astype(np.uint8), cv2.COLOR_HSV2RGB)


def to_bytes(image: np.ndarray) -> np.ndarray:
    """0..1 floats to uint8."""
    return np.round(np.clip(image, 0, 1) * 255).astype(np.uint8)


def encode_png(image: np.ndarray) -> bytes:
    """PNG bytes of an RGB, RGBA or grey image. Raises GenmojoError("format") if it cannot be encoded."""
    swapped = image if image.ndim == 2 else image[..., [2, 1, 0, 3][: image.shape[2]]]
    done, data = cv2.imencode(".png", swapped)
    if not done:
        raise GenmojoError("format", f"cannot encode a picture of {image.shape}")
    return data.tobytes()


def _framed(cell: np.ndarray) -> np.ndarray:
    """A cell with a thin white border."""
    return cv2.copyMakeBorder(np.ascontiguousarray(cell), _GAP, 0, _GAP, 0, cv2.BORDER_CONSTANT, value=(255, 255, 255))


def _titles(width: int) -> np.ndarray:
    """The names of the columns."""
    strip = np.full((20, width, 3), 255, np.uint8)
    for i, title in enumerate(_TITLES):
        cv2.putText(strip, title, (i * width // len(_TITLES) + 6, 15), cv2.FONT_HERSHEY_SIMPLEX, 0.45, (0, 0, 0), 1)
    return strip
