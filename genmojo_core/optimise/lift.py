"""Static lift: from a complete clip and its initial motion to the first 4D scene (METHOD.md sections 2, 3, 6)."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace

import cv2
import numpy as np
import torch
from torch import Tensor

from genmojo_core.clip.clip import Clip
from genmojo_core.config import RunConfig
from genmojo_core.conventions import DILATION, matrix_to_quaternion
from genmojo_core.effects.plan import EffectPlan
from genmojo_core.errors import GenmojoError
from genmojo_core.optimise.first_poses import Moves
from genmojo_core.optimise.motion import ObjectMotion
from genmojo_core.optimise.objective import TrackSupervision
from genmojo_core.scene.appearance import FrameGain
from genmojo_core.scene.background import background_points, never_shown
from genmojo_core.scene.deform import DeformationField, FieldShape
from genmojo_core.scene.gaussians import Gaussians
from genmojo_core.scene.initialise import Points, points_of_image, project, surface_axes, uncovered
from genmojo_core.scene.placement import Placement
from genmojo_core.scene.scene4d import Layout, ObjectModel, Scene4D
from genmojo_core.sentences import say

START_SHARE = 0.7  # of the allowed Gaussians; the rest is left to density control
FIRST_SHARE = 0.65  # of these, spent on the canonical frame
MIN_POINTS = 16
SURE = 0.3  # confidence from which a pose may bring in parts of other frames
RIM = 2  # pixels beside a mask that may belong to it


@dataclass(frozen=True)
class Lifted:
    """The first scene.

    rows: clip object index -> position among the scene's objects (an object that is never seen has none);
    frames_of: (centre (3,), size) of each scene object's canonical coordinates; warnings: sentences for the user.
    """

    scene: Scene4D
    rows: dict[int, int]
    frames_of: list[tuple[np.ndarray, float]]
    warnings: tuple[str, ...]


def lift(clip: Clip, plan: EffectPlan, config: RunConfig, motions: Sequence[Moves]) -> Lifted:
    """The scene before the first optimiser step: every object placed and coloured from pixels, background behind.

    Args:
        clip: complete (estimate.complete), at the size to optimise. plan: what to allocate.
        motions: one per object of the clip, in its order.

    Raises:
        GenmojoError("empty"): no object has a pixel with depth in any frame.
    """
    generator = torch.Generator().manual_seed(config.seed)
    gain = FrameGain(len(clip), frame_gains(clip)) if plan.on("appearance_change") else None
    objects: list[ObjectModel] = []
    rows: dict[int, int] = {}
    frames_of, warnings = [], []
    for k in range(clip.objects):
        points = object_points(clip, k, motions[k], int(START_SHARE * config.gaussians_per_object))
        if len(points) < MIN_POINTS:
            points = _padded(points, clip, k, motions[k])
        if not len(points):
            warnings.append(say("never_visible", name=clip.object_names[k]))
            continue
        rows[k] = len(objects)
        frames_of.append(_canonical_frame(points))
        objects.append(_object_model(clip, k, motions[k], points, plan, config, generator))
    if not objects:
        raise GenmojoError("empty", "no object has a visible pixel with depth", clip.name, "check the masks")
    background = None
    if plan.on("background") and config.background_gaussians:
        cloud = background_points(clip, config.background_gaussians)
        background = Gaussians.from_surface(_tensor(cloud.xyz), _tensor(cloud.rgb), _axes(cloud, 1.0), 0.95)
        background.invented = torch.from_numpy(never_shown(cloud.xyz, clip))
    labels = len(objects) if plan.on("instance_labels") else 1
    cameras = replace(clip.cameras.value, dilation=DILATION)  # at the optimised size, whatever size they came in
    scene = Scene4D(objects, background, gain, cameras, Layout(labels, plan.on("flow")))
    return Lifted(scene, rows, frames_of, tuple(warnings))


def track_supervision(lifted: Lifted, motions: list[ObjectMotion]) -> list[TrackSupervision]:
    """The initial motion's point tracks in each scene object's canonical coordinates."""
    tracks = []
    for k, row in lifted.rows.items():
        centre, size = lifted.frames_of[row]
        motion = motions[k]
        tracks.append(TrackSupervision(_tensor((motion.track_xyz - centre) / size), _tensor(motion.track_xy),
                                       _tensor(motion.track_conf)))  # fmt: skip
    return tracks


def object_points(clip: Clip, k: int, motion: Moves, count: int) -> Points:
    """World points of object k as it stands in its canonical frame, parts hidden there added from other frames."""
    cameras, ref = clip.cameras.value, motion.ref_frame
    mask = clip.object_mask(k)
    usable = mask & clip.depth.valid
    points = points_of_image(clip.frames[ref], _depth(clip, motion, ref), usable[ref], cameras.view(ref),
                             int(count * FIRST_SHARE))  # fmt: skip
    others = [t for t in np.unique(np.linspace(0, len(clip) - 1, 7).astype(int)) if t != ref]
    others.sort(key=lambda t: abs(t - ref))
    for i, t in enumerate(others):
        left = count - len(points)
        if motion.confidence[t] < SURE or left < MIN_POINTS:
            continue
        there = replace(points, xyz=_bent(motion, t, points.xyz)).moved(motion.pose[t])
        holes = uncovered(there, cameras.view(t), usable[t])
        if holes.sum() < 4:
            continue
        share = max(MIN_POINTS, left // (len(others) - i))
        found = points_of_image(clip.frames[t], _depth(clip, motion, t), holes, cameras.view(t), share)
        back = found.moved(np.linalg.inv(motion.pose[t]))
        if motion.bend is not None:
            back = replace(back, xyz=motion.bend.undone(t, back.xyz))
        points = points.joined(back.chosen(_within_masks(clip, k, motion, back.xyz, [ref, *others])))
    return points


def _within_masks(clip: Clip, k: int, motion: Moves, xyz: np.ndarray, frames: list[int]) -> np.ndarray:  # (N,) bool
    """Which canonical points (N, 3) stay where object k may be in most frames with a sure pose.

    It may be on its mask, behind other objects, on void pixels and outside the picture. Points brought in from a frame
    with a wrong pose or a wrong mask fall beside the object everywhere else.
    """
    free = (clip.masks.value == 0) & clip.masks.valid
    against, asked = np.zeros(len(xyz)), 0
    for t in (t for t in frames if motion.confidence[t] >= SURE):
        asked += 1
        near = np.full((2 * RIM + 1, 2 * RIM + 1), 1, np.uint8)
        surely_free = cv2.erode(free[t].astype(np.uint8), near, borderValue=1) > 0
        xy, _ = project(_bent(motion, t, xyz) @ motion.pose[t, :3, :3].T + motion.pose[t, :3, 3],
                        clip.cameras.value.view(t))  # fmt: skip
        inside = np.all((xy >= 0) & (xy < clip.size), axis=1)
        column, row = np.where(inside[:, None], xy, 0).astype(int).T
        against += inside & surely_free[row, column]
    return 2 * against <= asked


def frame_gains(clip: Clip) -> Tensor:
    """(T, 3) light relative to the clip's median frame: ratios of medians over pixels no object ever covers."""
    free = ~(clip.masks.value > 0).any(axis=0) if clip.masks is not None else np.ones(clip.frames.shape[1:3], bool)
    if free.sum() < 64:
        free = np.ones(clip.frames.shape[1:3], bool)
    means = clip.frames[:, free].astype(np.float64).mean(axis=1) + 1.0  # (T, 3)
    plate = means[clip.background_frame]
    return _tensor(means / plate)


def _object_model(
    clip: Clip, k: int, motion: Moves, points: Points, plan: EffectPlan, config: RunConfig,
    generator: torch.Generator,
) -> ObjectModel:  # fmt: skip
    """One object's parameters: canonical coordinates centred and in units of the object's size."""
    centre, size = _canonical_frame(points)
    to_object = np.eye(4)
    to_object[:3, :3] *= size
    to_object[:3, 3] = centre
    local = _tensor((points.xyz - centre) / size)
    rgb = _tensor(points.rgb)
    if plan.on("appearance_change"):
        rgb = rgb / frame_gains(clip)[motion.ref_frame]
    gaussians = Gaussians.from_surface(local, rgb.clamp(0, 1), _axes(points, size))
    centres = np.linalg.inv(clip.cameras.value.world_to_camera)[:, :3, 3]
    placement = Placement(motion.pose @ to_object, centres)
    field = None
    if plan.on_object("non_rigid_motion", int(clip.object_ids[k])):
        settings = plan.get("non_rigid_motion").settings or {}
        bases = int(settings.get("motion_bases", config.motion_bases))
        shape = FieldShape(len(clip), bases, config.plane_resolution, config.plane_levels, config.plane_channels,
                           config.field_width, plan.on("appearance_change"))  # fmt: skip
        reach = local.abs().amax(dim=0).clamp(min=0.1) * 1.5
        field = DeformationField(torch.stack([-reach, reach]), _anchors(local, bases), shape, generator)
        _start_bending(field, motion, points.xyz, local, size)
    return ObjectModel(int(clip.object_ids[k]), clip.object_names[k], motion.ref_frame, gaussians, placement, field)


def _canonical_frame(points: Points) -> tuple[np.ndarray, float]:
    """Centre (3,) and size of the object: canonical coordinates are (x - centre) / size, about -0.5..0.5."""
    centre = np.median(points.xyz, axis=0)
    distance = np.linalg.norm(points.xyz - centre, axis=1)
    return centre, max(2.0 * float(np.percentile(distance, 95)), 4.0 * float(np.median(points.sigma)), 1e-6)


def _anchors(points: Tensor, count: int) -> Tensor:
    """Farthest-point samples: `count` rows, repeated if there are fewer points."""
    chosen = [0]
    distance = (points - points[0]).norm(dim=1)
    for _ in range(count - 1):
        chosen.append(int(distance.argmax()))
        distance = torch.minimum(distance, (points - points[chosen[-1]]).norm(dim=1))
    return points[chosen]


def _padded(points: Points, clip: Clip, k: int, motion: Moves) -> Points:
    """A tiny object (a pixel or two) gets MIN_POINTS jittered copies of its points, so that nothing divides by zero."""
    if not len(points):
        seen = np.flatnonzero((clip.object_mask(k) & clip.depth.valid).any(axis=(1, 2)))
        if not len(seen):
            return points
        t = int(seen[0])
        mask = clip.object_mask(k)[t] & clip.depth.valid[t]
        points = points_of_image(clip.frames[t], clip.depth.value[t], mask, clip.cameras.value.view(t), MIN_POINTS)
        points = points.moved(np.linalg.inv(motion.pose[t]))
    for _ in range(int(np.ceil(np.log2(MIN_POINTS / len(points))))):
        points = points.joined(points)
    jitter = np.random.default_rng(0).normal(size=points.xyz.shape)
    return replace(points, xyz=points.xyz + 0.3 * jitter * points.sigma[:, None])


def _depth(clip: Clip, motion: Moves, t: int) -> np.ndarray:  # (H, W)
    """The clip's depth of frame t, with the object's own window as the motion found it where that is known."""
    patch = None if motion.depth is None else motion.depth[t]
    depth = clip.depth.value[t]
    if patch is None:
        return depth
    depth = depth.copy()
    height, width = depth.shape
    top, left = max(patch.top, 0), max(patch.left, 0)
    bottom, right = min(patch.top + patch.depth.shape[0], height), min(patch.left + patch.depth.shape[1], width)
    depth[top:bottom, left:right] = patch.depth[
        top - patch.top : bottom - patch.top, left - patch.left : right - patch.left
    ]
    return depth


def _bent(motion: Moves, t: int, points: np.ndarray) -> np.ndarray:
    """Canonical points with the initial bend of frame t."""
    return points if motion.bend is None else motion.bend.at(t, points)


def _start_bending(field: DeformationField, motion: Moves, points: np.ndarray, local: Tensor, size: float) -> None:
    """Motion bases that reproduce the initial bend as well as their coefficients allow (least squares per frame).

    Args:
        points: (N, 3) canonical points in world units. local: the same in object units. size: world per object unit.
    """
    if motion.bend is None or not np.any(motion.bend.coefficients):
        return
    with torch.no_grad():
        coefficients = field.coefficients(local).double()
        pull = coefficients.T @ coefficients + 1e-3 * len(local) * torch.eye(coefficients.shape[1]).double()
        for t in range(len(field.bases)):
            moved = torch.from_numpy((motion.bend.at(t, points) - points) / size)
            field.bases[t] = torch.linalg.solve(pull, coefficients.T @ moved).float()


def _axes(points: Points, size: float) -> tuple[Tensor, Tensor]:
    """Quaternions (N, 4) and standard deviations (N, 3) of pieces of surface, in units of `size`."""
    rotations, sigmas = surface_axes(points.tangents)
    return _tensor(matrix_to_quaternion(rotations)), _tensor(sigmas / size)


def _tensor(array: np.ndarray) -> Tensor:
    return torch.tensor(np.ascontiguousarray(array), dtype=torch.float32)
