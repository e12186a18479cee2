"""Every number the effect plan rests on, measured on a completed clip in a second or two (numpy and OpenCV only)."""

from __future__ import annotations

from dataclasses import dataclass

import cv2
import numpy as np

from genmojo_core.clip.clip import Clip
from genmojo_core.effects.light import light_change
from genmojo_core.effects.objects import ObjectFacts, describe
from genmojo_core.effects.occlusion import Cover, occlusion_graph
from genmojo_core.effects.rigid import turning, world_turn
from genmojo_core.effects.sample import SHORT_SIDE, sample
from genmojo_core.effects.shape import Bending, bending
from genmojo_core.estimate.views import carry

OBJECT_LIGHT = 0.5  # turning and swimming objects change by up to 0.41 on the shared clips; beyond: light
HIDDEN_SHARE = 0.1  # of an object's largest area: smaller counts as hidden
_CORNER_QUALITY = 0.02  # of the strongest corner in the frame
_CAMERA_GRID = 48  # pixels of the short side of the grid that camera motion is measured on


@dataclass(frozen=True)
class Evidence:
    """Numbers of one clip; shares are 0..1, pixels are those of a frame with 256 on its short side.

    Args:
        contact: share of frames in which two objects lie within 2 pixels.
        covers: who covers whom, and when.
        background: share of pixels outside all objects.
        camera: largest median shift of the background between frame 0 and another by the camera alone, pixels.
        bending: per object, how far it is from rigid.
        light: largest change of brightness: of the background, or of an object beyond what turning explains.
        objects: number of objects.
        depth: share of the objects' pixels with a valid depth.
        flow: share of the objects' pixels with a valid flow (0 for a single frame).
        corners: usual number of corners per object that flow follows (tracks of one's own count as they are).
        hidden: most frames in a row in which an object is hidden between two in which it is seen.
        sights: per object, (T, 3, 3) rotations from the object as in frame 0 to the camera, as far as flow tells.
        turns: per object, most degrees that it is turned in the world against frame 0.
        facts: what is known about each object (at the measured size).
    """

    contact: float
    covers: tuple[Cover, ...]
    background: float
    camera: float
    bending: tuple[Bending, ...]
    light: float
    objects: int
    depth: float
    flow: float
    corners: float
    hidden: int
    sights: tuple[np.ndarray, ...]
    turns: tuple[float, ...]
    facts: tuple[ObjectFacts, ...]


def measure(clip: Clip) -> Evidence:
    """Measure everything on a reduced copy of the clip (short side at most 256); channels that lack count as 0."""
    small = sample(clip)
    facts = describe(small)
    labels = small.masks.value if small.masks is not None else np.zeros(small.frames.shape[:3], np.uint8)
    contact = np.any([one.touches for one in facts], axis=0) if facts else np.zeros(len(small), bool)
    light, covers = light_change(small), occlusion_graph(small)
    sights = tuple(turning(small, k) for k in range(small.objects))
    poses = np.tile(np.eye(4), (len(small), 1, 1)) if small.cameras is None else small.cameras.value.world_to_camera
    strong = light.objects[light.objects >= OBJECT_LIGHT]
    return Evidence(
        contact=float(contact.mean()),
        covers=covers,
        background=float((labels == 0).mean()),
        camera=camera_shift(small) * SHORT_SIDE / min(small.size),
        bending=tuple(bending(small, k, facts[k], covers) for k in range(small.objects)),
        light=max([light.background, *strong.tolist()]),
        objects=int(sum(one.area.any() for one in facts)),
        depth=_share_inside(labels, None if small.depth is None else small.depth.valid),
        flow=_share_inside(labels[:-1], None if small.flow is None else small.flow.valid[:-1]),
        corners=trackable(small, labels),
        hidden=max((longest_gap(one.visibility) for one in facts), default=0),
        sights=sights,
        turns=tuple(world_turn(sight, poses) for sight in sights),
        facts=facts,
    )


def camera_shift(clip: Clip) -> float:
    """Largest median shift, in pixels of the clip, of the background from frame 0 to any other by the camera alone.

    Points of frame 0 are lifted by its background depth (depth where there is none, else 1) and seen by the others.
    """
    if clip.cameras is None or len(clip) < 2:
        return 0.0
    scale = min(1.0, _CAMERA_GRID / min(clip.size))
    width, height = (max(2, round(side * scale)) for side in clip.size)
    cameras = clip.cameras.value.resized(width, height)
    depth: np.ndarray = np.ones((height, width))
    if clip.background_depth is not None and clip.background_frame == 0:
        depth = clip.background_depth.value
    elif clip.depth is not None:
        depth = clip.depth.value[0]
    coarse = cv2.resize(np.asarray(depth, np.float64), (width, height), interpolation=cv2.INTER_NEAREST)
    here = np.stack(np.meshgrid(np.arange(width), np.arange(height)), axis=-1)
    shifts = [0.0]
    for t in np.flatnonzero(clip.cameras.valid):
        there = carry(cameras.view(0), cameras.view(int(t)), np.maximum(coarse, 1e-6))
        shifts.append(float(np.median(np.linalg.norm(there - here, axis=-1))))
    return max(shifts) / scale


def longest_gap(visibility: np.ndarray) -> int:  # (T,) 0..1
    """Most frames in a row that hide an object between two frames that show it."""
    seen = np.flatnonzero(visibility >= HIDDEN_SHARE)
    return int((np.diff(seen) - 1).max(initial=0))


def trackable(clip: Clip, labels: np.ndarray) -> float:  # labels (T, H, W)
    """Usual number of corners per object and frame where flow holds; 0 without flow or for a single frame."""
    if clip.tracks is not None:
        return float(len(clip.tracks.value.object))
    if clip.flow is None or len(clip) < 2 or not clip.objects:
        return 0.0
    counts = []
    for t in np.unique(np.linspace(0, len(clip) - 2, min(len(clip) - 1, 12)).round().astype(int)):
        grey = cv2.cvtColor(clip.frames[t], cv2.COLOR_RGB2GRAY)
        strength = cv2.cornerMinEigenVal(grey, 3)
        peak = (strength == cv2.dilate(strength, np.ones((5, 5), np.uint8))) & clip.flow.valid[t]
        strong = peak & (strength > max(_CORNER_QUALITY * float(strength.max()), 1e-5))
        counts += [
            int((strong & (labels[t] == k + 1)).sum()) for k in range(clip.objects) if (labels[t] == k + 1).any()
        ]
    return float(np.median(counts)) if counts else 0.0


def _share_inside(labels: np.ndarray, valid: np.ndarray | None) -> float:
    """Share of the objects' pixels where a channel holds; 0 without the channel or without such pixels."""
    inside = labels > 0
    return float(valid[inside].mean()) if valid is not None and inside.any() else 0.0
