"""Scores against exact truth beside a clip (`truth.npz`, `novel/`, BLENDER.md): unseen views and point tracks."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import cv2
import numpy as np

from genmojo_core.clip.cameras import View
from genmojo_core.clip.clip import Clip
from genmojo_core.errors import GenmojoError
from genmojo_core.measure.images import iou, psnr, ssim
from genmojo_core.measure.reconstruction import matching_frames
from genmojo_core.measure.views import Look, orbit_target, orbit_view, render_frame
from genmojo_core.store.npz import read_arrays, read_tracks
from genmojo_core.store.scene_file import BakedScene
from genmojo_core.trackers import scene as scene_tracker
from genmojo_core.tracks.metrics import select, space_metrics, track_metrics
from genmojo_core.tracks.model import PointTracks

_POSE_TOLERANCE = 1e-3
OBJECT_FIGURES = ("tracks", "ate", "mte", "hidden", "oa")
_SILHOUETTE = 0.5  # alpha from which a pixel belongs to a shape


@dataclass(frozen=True)
class NovelTruth:
    """Renders of the objects alone from other cameras.

    folder holds `<elev>_<azim>/NNNNN.png` (RGBA, straight alpha); angles (A, 2) degrees; poses (A, T, 4, 4);
    frames (F,) numbers of the frames rendered.
    """

    folder: Path
    angles: np.ndarray
    poses: np.ndarray
    frames: np.ndarray


def find_truth(clip_path: str | Path) -> Path | None:
    """`truth.npz` beside a clip's frames, or None."""
    path = Path(clip_path) / "truth.npz"
    return path if path.is_file() else None


def track_scores(scene: BakedScene, clip: Clip, truth_path: Path) -> dict[str, Any]:
    """2D and 3D track errors of the scene's own tracks, for queries visible in the scene's first frame.

    The scene alone is asked; truth gives only the queries and the score. 3D errors are taken after one similarity fit
    if depth or cameras were not given to the scene. "track_objects" has OBJECT_FIGURES by the id of the object, as one
    that is hard to follow says little of the others. Raises GenmojoError if the truth does not fit the clip.
    """
    truth = truth_tracks(scene, clip, truth_path)
    first = truth.visible[:, 0]
    if not first.any():
        return {}
    truth = select(truth, first)
    ours = scene_tracker.track(scene, np.zeros(len(truth.xy), np.int64), truth.xy[:, 0])
    figures: dict[str, Any] = dict(track_metrics(ours, truth, np.zeros(len(truth.xy), np.int64)))
    ids = np.unique(truth.object).tolist()
    figures["track_objects"] = {str(k): _of_object(ours, truth, truth.object == k) for k in ids}
    if truth.xyz is not None and ours.xyz is not None:
        figures |= space_metrics(ours.xyz, truth.xyz, not shares_world(scene, clip), truth.object)
    return figures


def _of_object(ours: PointTracks, truth: PointTracks, rows: np.ndarray) -> dict[str, float]:
    """OBJECT_FIGURES of some tracks that were asked for in the first frame."""
    found = track_metrics(select(ours, rows), select(truth, rows), np.zeros(int(rows.sum()), np.int64))
    return {key: found[key] for key in OBJECT_FIGURES if key in found}


def truth_tracks(scene: BakedScene, clip: Clip, truth_path: Path) -> PointTracks:
    """The truth's tracks in the scene's frames only. Raises GenmojoError("schema") for other frame counts."""
    truth = read_tracks(truth_path, clip.source_size)
    if truth.state.shape[1] != len(clip):
        raise GenmojoError("schema", f"has tracks over {truth.state.shape[1]} frames, the clip has {len(clip)}",
                           str(truth_path))  # fmt: skip
    return select(truth, np.arange(len(truth.xy)), matching_frames(scene, clip))


def novel_scores(
    scene: BakedScene, clip: Clip, truth_path: Path, progress: Callable[[float], None] | None = None
) -> dict[str, Any]:
    """Shape and colour of the objects from unseen views, apart (BLENDER.md).

    Returns {"novel": {"<elev>_<azim>": {iou, psnr_inside, psnr_levelled, psnr_union, psnr_white, ssim_white}},
    "novel_iou", "novel_psnr_inside": means over views, "novel_cameras": "given" or "orbit"}; {} if the truth has no
    views. iou compares silhouettes (alpha > 0.5), psnr_inside colours inside their intersection, psnr_levelled the same
    after one factor of brightness per picture (objects rendered without their room are lit by more of the sky than in
    the clip, which no frame tells), psnr_union colours on white in either silhouette, *_white the whole picture on
    white. The truth's own cameras are used if the scene was given depth and cameras; else the scene's orbit about its
    own middle.
    """
    novel = _novel_truth(truth_path)
    if novel is None:
        return {}
    positions = matching_frames(scene, clip)
    shared, target = shares_world(scene, clip), orbit_target(scene)
    views: dict[str, dict[str, float]] = {}
    for a, (elevation, azimuth) in enumerate(novel.angles.tolist()):
        rows = []
        for t, place in enumerate(positions):
            number = int(clip.frame_index[place])
            path = novel.folder / f"{elevation:g}_{azimuth:g}" / f"{number:05d}.png"
            if number not in novel.frames or not path.is_file():
                continue
            view = orbit_view(scene, t, elevation, azimuth, target)
            if shared:
                view = scene.cameras.view(t).with_pose(novel.poses[a, place])
            rows.append(_novel_row(scene, t, view.resized(*clip.size), path))
        if rows:
            views[f"{elevation:g}_{azimuth:g}"] = {k: float(np.nanmean([r[k] for r in rows])) for k in rows[0]}
        if progress is not None:
            progress((a + 1) / len(novel.angles))
    if not views:
        return {}
    return {
        "novel": views, "novel_cameras": "given" if shared else "orbit",
        "novel_iou": float(np.mean([v["iou"] for v in views.values()])),
        "novel_psnr_inside": float(np.nanmean([v["psnr_inside"] for v in views.values()])),
    }  # fmt: skip


def shares_world(scene: BakedScene, clip: Clip) -> bool:
    """True if the scene lives in the clip's given cameras and depth, so that places in space can be compared."""
    ignored = set(scene.config.get("ignore") or ())
    if ignored & {"depth", "cameras"} or clip.cameras is None or clip.depth is None:
        return False
    if not (clip.cameras.given and clip.depth.given):
        return False
    poses = clip.cameras.value.world_to_camera[matching_frames(scene, clip)]
    return bool(np.abs(poses - scene.cameras.world_to_camera).max() < _POSE_TOLERANCE)


def _novel_truth(truth_path: Path) -> NovelTruth | None:
    """The unseen views of a truth file, if there are some."""
    arrays = read_arrays(truth_path)
    folder = truth_path.parent / "novel"
    if not folder.is_dir() or not {"novel_angles", "novel_world_to_camera"} <= set(arrays):
        return None
    poses = arrays["novel_world_to_camera"].astype(np.float64)
    frames = arrays.get("novel_frames", np.arange(poses.shape[1]))
    return NovelTruth(folder, arrays["novel_angles"], poses, frames)


def _novel_row(scene: BakedScene, t: int, view: View, path: Path) -> dict[str, float]:
    """One frame from one unseen view against its RGBA render."""
    color, alpha = _read_rgba(path, (view.width, view.height))
    picture = render_frame(scene, t, view, Look(objects_only=True))
    both = (alpha > _SILHOUETTE) & (picture.alpha > _SILHOUETTE)
    straight = np.clip(picture.color / np.maximum(picture.alpha, 1e-6)[..., None], 0, 1)
    wanted = color / np.maximum(alpha, 1e-6)[..., None]
    level = float((straight * wanted)[both].sum() / max(float(np.square(straight[both]).sum()), 1e-6))
    on_white = color + (1 - alpha)[..., None]
    return {
        "iou": iou(alpha > _SILHOUETTE, picture.alpha > _SILHOUETTE),
        "psnr_inside": psnr(straight, wanted, both),
        "psnr_levelled": psnr(level * straight, wanted, both),
        "psnr_union": psnr(picture.on(), on_white, (alpha > _SILHOUETTE) | (picture.alpha > _SILHOUETTE)),
        "psnr_white": psnr(picture.on(), on_white),
        "ssim_white": ssim(picture.on(), on_white),
    }


def _read_rgba(path: Path, size: tuple[int, int]) -> tuple[np.ndarray, np.ndarray]:
    """Premultiplied colour (H, W, 3) and alpha (H, W), 0..1, area-resampled to (width, height)."""
    stored = cv2.imread(str(path), cv2.IMREAD_UNCHANGED)
    if stored is None or stored.ndim != 3 or stored.shape[2] != 4:
        raise GenmojoError("format", "is no RGBA picture", str(path))
    values = stored[..., [2, 1, 0, 3]].astype(np.float32) / (255 if stored.dtype == np.uint8 else 65535)
    values[..., :3] *= values[..., 3:]
    small = cv2.resize(values, size, interpolation=cv2.INTER_AREA)
    return small[..., :3], small[..., 3]
