"""How well a scene gives its own clip back: PSNR, SSIM and instance overlap of every frame (METHOD.md section 8)."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

import numpy as np

from genmojo_core.clip import folders
from genmojo_core.clip.clip import Clip
from genmojo_core.config import MEASURED_SIDE
from genmojo_core.errors import GenmojoError
from genmojo_core.measure.images import instance_ious, psnr, ssim
from genmojo_core.measure.views import Look, Picture, render_frame
from genmojo_core.store.scene_file import BakedScene


def reconstruction(scene: BakedScene, clip: Clip, progress: Callable[[float], None] | None = None) -> dict[str, float]:
    """Compare every frame of the scene with the clip, read at the size to measure at.

    Returns (means over frames, in dB or 0..1):
        psnr: foreground = union of the masks, per frame, then mean over the frames that show an object.
        psnr_full: all pixels. ssim: all pixels. instance_iou: mean over frames and objects whose mask is not empty,
        of the rendered instance map (largest share where alpha > 0.5); void pixels count nowhere.
        light_share_db: psnr gained by the light's change over time (one gain per frame and channel).
        color_share_db: psnr gained on top by Gaussians that change colour each on its own: motion explained by colour.
    Raises GenmojoError("schema") if the clip has not the scene's frames or size.
    """
    positions = matching_frames(scene, clip)
    rows: list[dict[str, float]] = []
    ious = []
    for t, place in enumerate(positions):
        image = clip.frames[place].astype(np.float32) / 255
        picture = picture_at(scene, t, clip.size)
        drawn = picture.on()
        foreground = foreground_of(clip, int(place))
        row = {"psnr": psnr(drawn, image, foreground), "psnr_full": psnr(drawn, image), "ssim": ssim(drawn, image)}
        if scene.d_dc is not None:
            for change in ("light", "none"):
                changed = picture_at(scene, t, clip.size, Look(color_change=change)).on()
                row[change] = psnr(changed, image, foreground)
        rows.append(row)
        ious.append(_overlaps(scene, clip, int(place), picture))
        if progress is not None:
            progress((t + 1) / len(positions))
    figures = {key: _mean([row[key] for row in rows]) for key in rows[0]}
    light, none = (figures.pop(change, figures["psnr"]) for change in ("light", "none"))
    figures["color_share_db"], figures["light_share_db"] = figures["psnr"] - light, light - none
    figures["instance_iou"] = _mean(list(np.concatenate(ious))) if ious else float("nan")
    return figures


def as_measured(clip: Clip, source: str, frames: tuple[int, int | None] | None) -> Clip:
    """The clip read again at the size to measure at; itself where it has that size, or where only it has masks.

    Args:
        source, frames: the path and positions that it was read from. Raises GenmojoError as reading it.
    """
    if min(clip.size) != MEASURED_SIDE and Path(source).exists():
        again = folders.read(source, frames=frames, short_side=MEASURED_SIDE, ignore=folders.CHANNELS)
        clip = again if again.masks is not None else clip
    return clip


def matching_frames(scene: BakedScene, clip: Clip) -> np.ndarray:  # (T,) positions in the clip
    """Where the scene's frames are in a clip, by their numbers. Raises GenmojoError("schema") if one is not there."""
    if tuple(scene.cameras.size) != tuple(clip.source_size):
        (width, height), (made_width, made_height) = clip.source_size, scene.cameras.size
        raise GenmojoError("schema", f"is {width} x {height}, the scene was made from {made_width} x {made_height}",
                           clip.path, "give the scene's own clip")  # fmt: skip
    place = {int(number): i for i, number in enumerate(clip.frame_index)}
    absent = [int(number) for number in scene.frame_index if int(number) not in place]
    if absent:
        raise GenmojoError("schema", f"has no frame {absent[0]}, which the scene has", clip.path,
                           "give the scene's own clip")  # fmt: skip
    return np.array([place[int(number)] for number in scene.frame_index])


def picture_at(scene: BakedScene, t: int, size: tuple[int, int], look: Look | None = None) -> Picture:
    """Frame t through its own camera, drawn at `size` (width, height)."""
    return render_frame(scene, t, scene.cameras.view(t).resized(*size), look or Look())


def foreground_of(clip: Clip, place: int) -> np.ndarray:  # (H, W) bool
    """Union of the masks of one frame; nothing if the clip has none."""
    if clip.masks is None:
        return np.zeros(clip.frames.shape[1:3], bool)
    return (clip.masks.value[place] > 0) & clip.masks.valid[place]


def rendered_labels(scene: BakedScene, clip: Clip, picture: Picture) -> np.ndarray:  # (H, W) int64
    """The rendered instance map in the numbers of the clip's masks: 0 background, k + 1 object k."""
    number = {int(source): k + 1 for k, source in enumerate(clip.object_ids)}
    table = np.array([0 if o.is_background else number.get(o.id, 0) for o in scene.objects] + [0])
    return table[picture.instance()]


def _overlaps(scene: BakedScene, clip: Clip, place: int, picture: Picture) -> np.ndarray:  # (K,)
    """IoU of every object in one frame; NaN where its mask is empty."""
    if clip.masks is None:
        return np.zeros(0)
    labels = rendered_labels(scene, clip, picture)
    return instance_ious(labels, clip.masks.value[place], clip.masks.valid[place], clip.objects)


def _mean(values: list[float]) -> float:
    """Mean of the numbers that are there; NaN if none is."""
    there = [v for v in values if not np.isnan(v)]
    return float(np.mean(there)) if there else float("nan")
