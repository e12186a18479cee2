"""Camera motion from background points: still, turning, or moving.

World = camera of frame 0, so world up is (0, -1, 0) there. Points are followed outside the masks; a still camera is
recognised as such. Else poses start from the believed depth of the points (given, or a guessed stage) and are adjusted
together with it (`bundle`), once turning on the spot and once moving; moving must explain the points clearly better.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

import cv2
import numpy as np

from genmojo_core.clip.cameras import Cameras
from genmojo_core.clip.clip import Clip
from genmojo_core.estimate.background_points import PointPaths, drift, follow_background
from genmojo_core.estimate.bundle import Bundle, adjust, cost, errors, world_points

FIELD_OF_VIEW = 49.1  # degrees of the longer side, where nothing better is known; METHOD.md section 2 (square images)
# Of the short side: a background that goes less far over the whole clip means a still camera. The drift, a median of
# many points, is off by under 0.05 px at 256; the video of a camera on its stand was seen to wobble by 0.54.
_STILL_SHARE = 0.6 / 256
_FEWEST_POINTS = 12  # of a frame
_CLEARLY_BETTER = 0.6  # share of the turning camera's error that a moving one must stay under
_KNOWN, _GUESSED = 0.03, 0.7  # deviation of log depth where depth is given, where it is guessed
_FOCAL_DOUBT = 0.3
_POINT_ERROR = 1.5  # pixels
_FOCAL_GAIN = 0.8  # share of the error that a free focal length must stay under to be believed


@dataclass(frozen=True)
class CameraEstimate:
    """Poses of a clip and how they were found.

    Args:
        cameras: one per frame, camera 0 is the identity. valid: (T,) bool, enough background points were seen.
        kind: "still", "turning" or "moving".
        displacement: how far the background went at most, pixels. residual: median reprojection error, pixels.
        points: (N, 3) background points in world coordinates; none unless the camera moves.
    """

    cameras: Cameras
    valid: np.ndarray
    kind: str
    displacement: float
    residual: float
    points: np.ndarray


@dataclass(frozen=True)
class Believed:
    """What is believed of depth before cameras are known: (T, H, W) scene units, and where it is measured."""

    depth: np.ndarray
    valid: np.ndarray


def default_intrinsics(clip: Clip, field_of_view: float = FIELD_OF_VIEW) -> np.ndarray:  # (3, 3)
    """K of the frames held for the longer side's field of view in degrees; pixels may be oblong: fx = fy / aspect."""
    width, height = clip.size
    longer = max(width * clip.held_pixel_aspect, height)
    fy = 0.5 * longer / np.tan(np.deg2rad(field_of_view) / 2)
    return np.array([[fy / clip.held_pixel_aspect, 0, width / 2], [0, fy, height / 2], [0, 0, 1.0]])


def estimate_cameras(
    frames: np.ndarray,  # (T, H, W, 3) uint8
    free: np.ndarray,  # (T, H, W) bool, pixels surely not of an object
    intrinsics: np.ndarray,  # (3, 3)
    believed: Believed,
) -> CameraEstimate:
    """Poses that explain the background's motion; never fails: frames without evidence repeat their neighbour."""
    t, h, w = frames.shape[:3]
    paths = follow_background(frames, free)
    displacement = float(np.linalg.norm(drift(paths), axis=1).max())
    enough = np.concatenate(
        [[True], (paths.seen() & (paths.start[:, None] < np.arange(t))).sum(axis=0)[1:] >= _FEWEST_POINTS]
    )
    lens, kind, poses, residual = intrinsics, "still", np.tile(np.eye(4), (t, 1, 1)), displacement
    points = np.zeros((0, 3))
    if displacement > _STILL_SHARE * min(h, w):
        bundle, kind = solve_motion(paths, intrinsics, believed)
        poses, lens, residual = bundle.poses, bundle.lens(), _usual_error(bundle)
        points = world_points(bundle, _POINT_ERROR) if kind == "moving" else points
    cameras = Cameras(np.tile(lens, (t, 1, 1)).astype(np.float64), poses, (w, h))
    return CameraEstimate(cameras, enough, kind, displacement, residual, points)


def solve_motion(paths: PointPaths, intrinsics: np.ndarray, believed: Believed) -> tuple[Bundle, str]:
    """The better of turning on the spot and moving, as an adjusted bundle, and its name.

    Seen from afar, a body turning left and its hollow mould turning right look alike, so without depth the mirrored
    answer is tried as well. The focal length is freed last, and kept only where that makes a moving camera explain
    the points clearly better: parallax shows it, small turns do not.
    """
    turning = adjust(replace(_bundle(paths, intrinsics, believed), moves=False), 8, 1e-3)
    moving = replace(turning, moves=True)
    if believed.valid.any():
        moving = _settle(replace(moving, poses=_poses(moving, moving.doubt == _KNOWN)))
    else:
        moving = _settle(moving)
        mirrored = replace(turning, moves=True, log_depth=2 * np.median(moving.log_depth) - moving.log_depth)
        mirrored = _settle(replace(mirrored, poses=_poses(mirrored, np.ones(len(mirrored.start), bool))))
        moving = min(moving, mirrored, key=cost)
    focused = adjust(replace(moving, focal_doubt=_FOCAL_DOUBT, tolerance=2.0), 8, 3e-3)
    focused = adjust(replace(focused, tolerance=1.0), 12, 3e-4)
    believable = abs(focused.log_focal) < 3 * _FOCAL_DOUBT
    if believable and _usual_error(focused) < _FOCAL_GAIN * _usual_error(moving):
        moving = focused
    if believed.valid.any() or _usual_error(moving) < _CLEARLY_BETTER * _usual_error(turning):
        return moving, "moving"
    return turning, "turning"


def _settle(bundle: Bundle) -> Bundle:
    """Adjusted with a wide tolerance first, which forgives a bad start."""
    for tolerance, rounds, enough in ((6.0, 8, 1e-2), (2.0, 8, 3e-3), (1.0, 10, 1e-3)):
        bundle = adjust(replace(bundle, tolerance=tolerance), rounds, enough)
    return bundle


def _usual_error(bundle: Bundle) -> float:
    """Median reprojection error in pixels, 0 when nothing was seen twice."""
    found = errors(bundle)
    return float(np.median(found)) if len(found) else 0.0


def _bundle(paths: PointPaths, intrinsics: np.ndarray, believed: Believed) -> Bundle:
    """What is to be adjusted, starting from a chain of rotations and the believed depth."""
    at_start = paths.at_start()
    h, w = believed.depth.shape[1:]
    column = np.clip(at_start[:, 0].astype(int), 0, w - 1)
    row = np.clip(at_start[:, 1].astype(int), 0, h - 1)
    log_depth = np.log(np.maximum(believed.depth[paths.start, row, column].astype(np.float64), 1e-3))
    known = believed.valid[paths.start, row, column]
    later = paths.seen() & (np.arange(paths.xy.shape[1]) > paths.start[:, None])
    point, frame = np.nonzero(later)
    return Bundle(
        poses=_rotations(paths, intrinsics),
        intrinsics=intrinsics,
        log_depth=log_depth,
        start=paths.start,
        at_start=at_start,
        point=point,
        frame=frame,
        xy=paths.xy[point, frame],
        believed=log_depth,
        doubt=np.where(known, _KNOWN, _GUESSED),
    )


def _rotations(paths: PointPaths, intrinsics: np.ndarray) -> np.ndarray:  # (T, 4, 4)
    """Each frame's rotation against frame 0: robust least squares between the rays of the points it shares (Kabsch)."""
    rays, seen = _rays(paths.xy, intrinsics), paths.seen()
    at_start = _rays(paths.at_start(), intrinsics)
    poses = np.tile(np.eye(4), (paths.xy.shape[1], 1, 1))
    for t in range(1, len(poses)):
        chosen = np.flatnonzero(seen[:, t] & (paths.start < t))
        poses[t] = poses[t - 1]
        if len(chosen) < _FEWEST_POINTS:
            continue
        first = np.swapaxes(poses[paths.start[chosen], :3, :3], 1, 2)
        world, here = np.einsum("nij,nj->ni", first, at_start[chosen]), rays[chosen, t]
        weight = np.ones(len(chosen))
        for _ in range(10):
            u, _, vt = np.linalg.svd((here * weight[:, None]).T @ world)
            poses[t, :3, :3] = u @ np.diag([1, 1, np.linalg.det(u @ vt)]) @ vt
            error = np.linalg.norm(world @ poses[t, :3, :3].T - here, axis=1)
            weight = 1 / (1 + (error / max(float(np.median(error)), 1e-6)) ** 2)
    return poses


def _poses(bundle: Bundle, trusted: np.ndarray) -> np.ndarray:  # (N,) bool -> (T, 4, 4)
    """Each frame's pose from the depth of trusted points it shares with earlier frames (PnP, RANSAC)."""
    poses = bundle.poses.copy()
    ray = np.column_stack([bundle.at_start, np.ones(len(bundle.start))]) @ np.linalg.inv(bundle.intrinsics).T
    in_start = np.column_stack([ray * np.exp(bundle.log_depth)[:, None], np.ones(len(ray))])
    cv2.setRNGSeed(0)
    for t in range(1, len(poses)):
        chosen = np.flatnonzero(bundle.frame == t)
        point = bundle.point[chosen]
        known = trusted[point]
        world = np.einsum("nij,nj->ni", np.linalg.inv(poses[bundle.start[point]]), in_start[point])[known, :3]
        poses[t] = poses[t - 1]
        if known.sum() < _FEWEST_POINTS:
            continue
        ok, turn, shift, _ = cv2.solvePnPRansac(
            world, bundle.xy[chosen][known], bundle.intrinsics, None, iterationsCount=200, reprojectionError=2.0,
            flags=cv2.SOLVEPNP_SQPNP,
        )  # fmt: skip
        if ok:
            poses[t, :3, :3], poses[t, :3, 3] = cv2.Rodrigues(turn)[0], shift.ravel()
    return poses


def _rays(points: np.ndarray, intrinsics: np.ndarray) -> np.ndarray:  # (..., 2) raster px -> (..., 3) unit
    """Unit viewing directions of pixels in the camera's axes."""
    direction = np.concatenate([points, np.ones((*points.shape[:-1], 1))], axis=-1) @ np.linalg.inv(intrinsics).T
    return direction / np.linalg.norm(direction, axis=-1, keepdims=True)
