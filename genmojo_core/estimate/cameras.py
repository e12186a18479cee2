"""Camera motion from background features: still, turning, or moving through known depth.

World = camera of frame 0, so world up is (0, -1, 0) there. Points are tracked outside the dilated masks from key
frames (Lucas-Kanade, there and back); a pose per frame then explains them: the identity when they do not move, a
rotation about the camera's centre when no depth is known (METHOD.md section 11.14: never mix real poses with others),
a full pose (PnP, RANSAC) where depth is.
"""

from __future__ import annotations

from dataclasses import dataclass

import cv2
import numpy as np

from genmojo_core.clip.cameras import Cameras
from genmojo_core.clip.clip import Clip

FOVY = 49.1  # degrees; METHOD.md section 2, used where nothing better is known
_STILL_SHARE = 0.004  # of the short side: background moving less than this over the whole clip is a still camera
_INLIER_SHARE = 0.006  # of the short side (1.5 px at 256): a point agrees with a pose
_FEWEST_POINTS = 12


@dataclass(frozen=True)
class CameraEstimate:
    """Poses of a clip and how they were found.

    Args:
        cameras: one per frame, camera 0 is the identity. valid: (T,) bool, enough background agreed.
        kind: "still", "turning" or "moving".
        displacement: largest median displacement of background points against frame 0, pixels.
        residual: median reprojection error of agreeing points, pixels.
    """

    cameras: Cameras
    valid: np.ndarray
    kind: str
    displacement: float
    residual: float


@dataclass(frozen=True)
class PointsInFrame:
    """Background points of one key frame found again in one frame: (N, 2) raster pixels each."""

    key: int
    in_key: np.ndarray
    in_frame: np.ndarray


def default_intrinsics(clip: Clip, fovy: float = FOVY) -> np.ndarray:  # (3, 3)
    """K of the frames held for a vertical field of view in degrees; pixels may be oblong: fx = fy / pixel aspect."""
    width, height = clip.size
    fy = 0.5 * height / np.tan(np.deg2rad(fovy) / 2)
    return np.array([[fy / clip.held_pixel_aspect, 0, width / 2], [0, fy, height / 2], [0, 0, 1.0]])


def estimate_cameras(
    frames: np.ndarray,  # (T, H, W, 3) uint8
    background: np.ndarray,  # (T, H, W) bool, pixels surely not of an object
    intrinsics: np.ndarray,  # (3, 3)
    depth: np.ndarray | None = None,  # (T, H, W) scene units
    depth_valid: np.ndarray | None = None,  # (T, H, W) bool
) -> CameraEstimate:
    """Poses that explain the background's motion; never fails, frames without evidence repeat their neighbour."""
    t, h, w = frames.shape[:3]
    short = min(h, w)
    tracks = track_background(frames, background)
    displacement = still_displacement(tracks)
    poses, valid, residual = np.tile(np.eye(4), (t, 1, 1)), np.ones(t, bool), displacement
    kind = "still"
    if displacement > _STILL_SHARE * short:
        kind = "turning" if depth is None else "moving"
        poses, valid, residual = _solve_chain(tracks, intrinsics, depth, depth_valid, _INLIER_SHARE * short)
        poses = _fill_and_smooth(poses, valid)
    cameras = Cameras(np.tile(intrinsics, (t, 1, 1)).astype(np.float64), poses, (w, h))
    return CameraEstimate(cameras, valid, kind, displacement, residual)


def still_displacement(tracks: list[PointsInFrame]) -> float:
    """Largest over frames of how far the background went from frame 0, in pixels (median vector, summed over keys)."""
    moved = {0: np.zeros(2)}  # of every frame against frame 0
    for t, points in enumerate(tracks, start=1):
        step = points.in_frame - points.in_key
        moved[t] = moved[points.key] + (np.median(step, axis=0) if len(step) else 0.0)
    return max(float(np.linalg.norm(vector)) for vector in moved.values())


def track_background(frames: np.ndarray, background: np.ndarray) -> list[PointsInFrame]:
    """Key-frame points found in every frame 1..T-1 (entry t - 1); a new key when under 40 % are left.

    Points are followed frame to frame and then matched again against the key frame itself, so they do not drift.
    """
    greys = [cv2.cvtColor(frame, cv2.COLOR_RGB2GRAY) for frame in frames]
    short = min(greys[0].shape)
    key, start = 0, _corners(greys[0], background[0], short)
    source, current = start, start
    result = []
    for t in range(1, len(greys)):
        for _ in range(2):  # second round only after a new key frame
            found, ok = _follow(greys, key, t, source, current)
            ok &= _lies_on(background[t], found)
            few = ok.sum() < max(_FEWEST_POINTS, 0.4 * len(start))
            if not few or key == t - 1:
                break
            key, start = t - 1, _corners(greys[t - 1], background[t - 1], short)
            source, current = start, start
        source, current = source[ok], found[ok]
        result.append(PointsInFrame(key, source, current))
    return result


def _follow(
    greys: list[np.ndarray], key: int, t: int, source: np.ndarray, current: np.ndarray
) -> tuple[np.ndarray, np.ndarray]:  # (N, 2), (N,) bool
    """Points `current` of frame t - 1 followed into t, then aligned with their look at `source` in the key frame."""
    if len(source) == 0:
        return np.zeros((0, 2), np.float32), np.zeros(0, bool)
    window = {"winSize": (15, 15), "maxLevel": 3}
    step, ok, _ = cv2.calcOpticalFlowPyrLK(greys[t - 1], greys[t], _cv(current), None, **window)
    fine = {**window, "maxLevel": 0, "flags": cv2.OPTFLOW_USE_INITIAL_FLOW}
    found, ok_key, _ = cv2.calcOpticalFlowPyrLK(greys[key], greys[t], _cv(source), step.copy(), **fine)
    away = np.linalg.norm(found - step, axis=-1).ravel() > 2.0  # the look changed too much: keep the step's place
    found = np.where(away[:, None, None] | (ok_key[:, :, None] == 0), step, found)
    back, ok_back, _ = cv2.calcOpticalFlowPyrLK(greys[t], greys[t - 1], found, _cv(current).copy(), **fine)
    closed = np.linalg.norm(back - _cv(current), axis=-1).ravel() < 1.0
    return found[:, 0] + 0.5, (ok.ravel() > 0) & (ok_back.ravel() > 0) & closed


def _solve_chain(
    tracks: list[PointsInFrame],
    intrinsics: np.ndarray,
    depth: np.ndarray | None,
    depth_valid: np.ndarray | None,
    tolerance: float,
) -> tuple[np.ndarray, np.ndarray, float]:  # (T, 4, 4), (T,), pixels
    """World-to-camera of every frame: its key's pose, then the pose of the frame in the key's camera."""
    poses = np.tile(np.eye(4), (len(tracks) + 1, 1, 1))
    valid = np.ones(len(poses), bool)
    residuals = [0.0]
    for t, points in enumerate(tracks, start=1):
        solved = None
        if depth is not None:
            ok = None if depth_valid is None else depth_valid[points.key]
            solved = relative_pose(points, intrinsics, depth[points.key], ok, tolerance)
        solved = solved or relative_rotation(points, intrinsics, tolerance)
        valid[t] = solved is not None
        if solved is not None:
            poses[t] = solved[0] @ poses[points.key]
            residuals.append(solved[1])
        else:
            poses[t] = poses[t - 1]
    return poses, valid, float(np.median(residuals))


def relative_rotation(
    points: PointsInFrame, intrinsics: np.ndarray, tolerance: float
) -> tuple[np.ndarray, float] | None:
    """Key-to-frame rotation (4, 4) about the camera's centre and its median error in pixels; None on thin evidence.

    A robust homography picks the points that agree; the rotation then is the least-squares one between their rays
    (Kabsch), repeated on the points it explains.
    """
    if len(points.in_key) < _FEWEST_POINTS:
        return None
    _, agreed = cv2.findHomography(points.in_key, points.in_frame, cv2.RANSAC, 2 * tolerance)
    keep = agreed.ravel() > 0 if agreed is not None else np.ones(len(points.in_key), bool)
    a, b = rays(points.in_key, intrinsics), rays(points.in_frame, intrinsics)
    rotation, error = np.eye(3), np.full(len(a), np.inf)
    for _ in range(5):
        u, _, vt = np.linalg.svd(b[keep].T @ a[keep])
        rotation = u @ np.diag([1, 1, np.linalg.det(u @ vt)]) @ vt
        projected = a @ (intrinsics @ rotation).T
        error = np.linalg.norm(projected[:, :2] / np.maximum(projected[:, 2:], 1e-6) - points.in_frame, axis=1)
        keep = error <= max(2 * tolerance, 1.5 * float(np.median(error)))
    if keep.sum() < _FEWEST_POINTS // 2:
        return None
    pose = np.eye(4)
    pose[:3, :3] = rotation
    return pose, float(np.median(error[keep]))


def relative_pose(
    points: PointsInFrame,
    intrinsics: np.ndarray,
    key_depth: np.ndarray,  # (H, W)
    key_valid: np.ndarray | None,  # (H, W) bool
    tolerance: float,
) -> tuple[np.ndarray, float] | None:
    """Key-to-frame rigid motion (4, 4) from the key frame's depth and its median error in pixels, or None."""
    if len(points.in_key) < _FEWEST_POINTS:
        return None
    h, w = key_depth.shape
    column = np.clip(points.in_key[:, 0].astype(int), 0, w - 1)
    row = np.clip(points.in_key[:, 1].astype(int), 0, h - 1)
    z = key_depth[row, column].astype(np.float64)
    known = np.isfinite(z) & (z > 0)
    if key_valid is not None:
        known &= key_valid[row, column]
    if known.sum() < _FEWEST_POINTS:
        return None
    ray = np.column_stack([points.in_key, np.ones(len(z))]) @ np.linalg.inv(intrinsics).T
    xyz, uv = (ray * z[:, None])[known], points.in_frame[known].astype(np.float64)
    cv2.setRNGSeed(0)
    ok, rvec, tvec, agreed = cv2.solvePnPRansac(
        xyz, uv, intrinsics, None, iterationsCount=300, reprojectionError=tolerance, flags=cv2.SOLVEPNP_SQPNP
    )
    if not ok or agreed is None or len(agreed) < _FEWEST_POINTS:
        return None
    agreed = agreed.ravel()
    rvec, tvec = cv2.solvePnPRefineLM(xyz[agreed], uv[agreed], intrinsics, None, rvec, tvec)
    projected, _ = cv2.projectPoints(xyz[agreed], rvec, tvec, intrinsics, None)
    pose = np.eye(4)
    pose[:3, :3], pose[:3, 3] = cv2.Rodrigues(rvec)[0], tvec.ravel()
    return pose, float(np.median(np.linalg.norm(projected[:, 0] - uv[agreed], axis=1)))


def rays(points: np.ndarray, intrinsics: np.ndarray) -> np.ndarray:  # (N, 2) raster px -> (N, 3) unit
    """Unit viewing directions of pixels in the camera's axes."""
    direction = np.column_stack([points, np.ones(len(points))]) @ np.linalg.inv(intrinsics).T
    return direction / np.linalg.norm(direction, axis=1, keepdims=True)


def _corners(grey: np.ndarray, allowed: np.ndarray, short: int) -> np.ndarray:  # (N, 2) raster px
    """Up to 500 corners to follow; pixel centres are at + 0.5."""
    found = cv2.goodFeaturesToTrack(grey, 500, 0.005, max(3, short // 40), mask=allowed.astype(np.uint8))
    return np.zeros((0, 2), np.float32) if found is None else found[:, 0] + 0.5


def _cv(points: np.ndarray) -> np.ndarray:  # (N, 2) raster px -> (N, 1, 2) OpenCV's pixel-centre coordinates
    """Points as OpenCV's trackers want them."""
    return np.ascontiguousarray(points[:, None] - 0.5, dtype=np.float32)


def _lies_on(allowed: np.ndarray, points: np.ndarray) -> np.ndarray:  # (H, W) bool, (N, 2) -> (N,) bool
    """Which points are inside the image and on allowed pixels."""
    h, w = allowed.shape
    column, row = np.floor(points[:, 0]).astype(int), np.floor(points[:, 1]).astype(int)
    inside = (column >= 0) & (column < w) & (row >= 0) & (row < h)
    return inside & allowed[np.clip(row, 0, h - 1), np.clip(column, 0, w - 1)]


def _fill_and_smooth(poses: np.ndarray, valid: np.ndarray) -> np.ndarray:  # (T, 4, 4), (T,)
    """Poses interpolated over frames without evidence and smoothed by [1 2 1] / 4; camera 0 stays the identity."""
    rvecs = np.array([cv2.Rodrigues(pose[:3, :3])[0].ravel() for pose in poses])
    motion = np.concatenate([rvecs, poses[:, :3, 3]], axis=1)
    frame = np.arange(len(poses))
    motion = np.stack([np.interp(frame, frame[valid], column[valid]) for column in motion.T], axis=1)
    padded = np.concatenate([2 * motion[:1] - motion[1:2], motion, 2 * motion[-1:] - motion[-2:-1]])
    motion = 0.25 * padded[:-2] + 0.5 * padded[1:-1] + 0.25 * padded[2:]
    motion -= motion[0]
    result = np.tile(np.eye(4), (len(poses), 1, 1))
    for pose, (rx, ry, rz, *translation) in zip(result, motion, strict=True):
        pose[:3, :3], pose[:3, 3] = cv2.Rodrigues(np.array([rx, ry, rz]))[0], translation
    return result
