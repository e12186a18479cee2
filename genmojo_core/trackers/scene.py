"""Point tracks out of a 4D scene: a query is carried by the Gaussians that show at its pixel (METHOD.md section 7).

The released code follows one nearest centre and drops queries without one near. Here a query's surface point is
expressed in the local frame of every Gaussian that contributes to its pixel (weights alpha T, its own instance only),
carried by each, and blended; no query is dropped. Its depth is the median of theirs by weight. Every Gaussian turns
about its own centre, so rotation carries offsets too. A rendered outline is good to a pixel or two, so a query that
falls just beside an object belongs to it.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass

import cv2
import numpy as np

from genmojo_core.clip.cameras import View
from genmojo_core.conventions import quaternion_to_matrix
from genmojo_core.errors import GenmojoError
from genmojo_core.render.cpu.rasterize import rasterize
from genmojo_core.render.rasterizer import ALPHA_MAX, ALPHA_MIN, FRUSTUM_CLAMP, Splats
from genmojo_core.store.scene_file import BakedScene, Frame
from genmojo_core.tracks.model import OCCLUDED, OUT_OF_VIEW, VISIBLE, PointTracks

CARRIERS = 16  # Gaussians that carry one query at most
BEHIND = 0.02  # of the object's size: farther behind its own rendered surface is its hidden side
NEARBY = 0.01  # of the short side: places are good to about this, so the surface is looked up this far around
SHOWS = 0.4  # of a pixel: what its own object must fill for a point there to be seen; outlines are good to a pixel
RIM = 0.015  # of the short side: a query on the background this near an object is meant for the object
LIKENESS_SHORT_SIDE = 96  # pixels of the pictures in which a scene is compared with a clip
TEST_SHORT_SIDE = 384  # pixels at most of the images in which visibility is tested
_ENOUGH = 50  # pixels to be covered before a likeness means anything
_SEEN_ALPHA = 0.5  # coverage from which a pixel shows something


@dataclass(frozen=True)
class Carriers:
    """What carries N queries: up to C Gaussians each.

    rows (N, C) Gaussian indices, weights (N, C) summing to 1, offsets (N, C, 3) of the surface point from each centre
    in the Gaussian's local frame (turned back, scene units), object (N,) position in the scene's objects.
    """

    rows: np.ndarray
    weights: np.ndarray
    offsets: np.ndarray
    object: np.ndarray


def track(
    scene: BakedScene,
    t: np.ndarray,  # (N,) frame positions
    xy: np.ndarray,  # (N, 2) raster px of the clip's source
    progress: Callable[[float], None] | None = None,
    owner: np.ndarray | None = None,  # (N,) ids of objects of the scene, 0: whatever shows there
    cancelled: Callable[[], bool] | None = None,
) -> PointTracks:
    """Tracks of N queries over all frames, in source pixels, with world positions and the owner's id.

    A query that says whose it is goes with that object, also where another one hides it in the scene.

    A point is visible where SHOWS of its pixel is its instance and the point is not behind the instance's own surface:
    a solid hides its far side, at a gap that is small against the distance to the camera but not against the object.
    How far behind is counted from the farthest surface NEARBY (slanted surfaces change depth within the error of a
    place). Outside the picture it is OUT_OF_VIEW. In its own query frame it is the query itself.

    Raises GenmojoError: "empty" for a file without Gaussians or without queries, "argument" for a query outside the
    frames or the picture, for an owner that the scene does not have, and when it was cancelled.
    """
    t, xy = np.asarray(t, np.int64), np.asarray(xy, np.float64)
    _check_queries(scene, t, xy)
    carriers = _carriers(scene, t, xy, _instances(scene, np.zeros(len(t), np.int64) if owner is None else owner))
    positions, states, world = [], [], []
    for i in range(len(scene)):
        if cancelled is not None and cancelled():
            raise GenmojoError("argument", "was cancelled", "seeding")
        frame = scene.frame(i)
        points = _carried(carriers, scene, frame, i, t)
        pixels, depth = project(points, scene.cameras.view(i))
        states.append(_states(scene, frame, i, carriers.object, pixels, depth))
        positions.append(pixels)
        world.append(points)
        if progress is not None:
            progress((i + 1) / len(scene))
    everything, state = np.stack(positions, axis=1), np.stack(states, axis=1)
    own = np.arange(len(t)), t
    everything[own], state[own] = xy, VISIBLE
    ids = np.array([o.id for o in scene.objects], np.int64)
    return PointTracks(everything.astype(np.float32), state, ids[carriers.object], scene.cameras.size,
                       np.stack(world, axis=1).astype(np.float32))  # fmt: skip


def likeness(scene: BakedScene, frames: np.ndarray, times: Sequence[int]) -> float:  # (T, H, W, 3) uint8 RGB
    """How much a scene looks like frames of a clip: the correlation of small pictures of both, -1..1.

    Only pixels that the scene covers count; NaN where it covers next to nothing, or all is of one colour.
    """
    theirs, ours = [], []
    for t in times:
        view, frame = scene.cameras.view(t), scene.frame(t)
        scale = min(1.0, LIKENESS_SHORT_SIDE / min(view.width, view.height))
        small = view.resized(max(1, round(view.width * scale)), max(1, round(view.height * scale)))
        drawn = rasterize(Splats(frame.means, frame.quats, frame.scales, frame.opacities, frame.rgb), small)
        covered = drawn.alpha > _SEEN_ALPHA
        ours.append(drawn.features[covered])
        theirs.append(cv2.resize(frames[t], (small.width, small.height), interpolation=cv2.INTER_AREA)[covered])
    a, b = np.concatenate(ours).astype(np.float64), np.concatenate(theirs) / 255.0
    if len(a) < _ENOUGH or not (a.std() > 0 and b.std() > 0):
        return float("nan")
    return float(np.corrcoef(a.ravel(), b.ravel())[0, 1])


def project(points: np.ndarray, view: View) -> tuple[np.ndarray, np.ndarray]:  # (N, 3) -> (N, 2) px, (N,) z
    """Raster pixels and depths of world points; behind the camera the pixel is that of the near plane."""
    camera = points @ view.world_to_camera[:3, :3].T + view.world_to_camera[:3, 3]
    z = np.maximum(camera[:, 2], view.near)
    return camera[:, :2] / z[:, None] * [view.fx, view.fy] + [view.cx, view.cy], camera[:, 2]


def _check_queries(scene: BakedScene, t: np.ndarray, xy: np.ndarray) -> None:
    """One sentence for what cannot be tracked."""
    if len(scene.xyz) == 0:
        raise GenmojoError("empty", "holds no Gaussians to track with", "scene", "give a scene written by optimize")
    if len(t) == 0 or xy.shape != (len(t), 2):
        raise GenmojoError("empty", "there is no query", "queries", "give t (N,) and xy (N, 2)")
    if (t < 0).any() or (t >= len(scene)).any():
        raise GenmojoError("argument", f"asks at frame {t[(t < 0) | (t >= len(scene))][0]}, the scene has frames 0 to "
                           f"{len(scene) - 1}", "queries")  # fmt: skip
    outside = (xy < 0).any(axis=1) | (xy > np.array(scene.cameras.size)).any(axis=1)
    if outside.any():
        raise GenmojoError("argument", f"asks at {xy[outside][0].round(1).tolist()}, outside the "
                           f"{scene.cameras.size[0]} x {scene.cameras.size[1]} picture", "queries",
                           "give raster pixels of the clip")  # fmt: skip


def _instances(scene: BakedScene, owner: np.ndarray) -> np.ndarray:  # (N,) positions in scene.objects, -1 for id 0
    """Where the owners are among the scene's objects. Raises GenmojoError("argument") for one that is not there."""
    place = {o.id: k for k, o in enumerate(scene.objects) if o.count and not o.is_background}
    unknown = set(owner.tolist()) - place.keys() - {0}
    if unknown:
        raise GenmojoError("argument", f"has no object {min(unknown)} to carry points", "scene",
                           "optimise it with that object's masks")  # fmt: skip
    return np.array([place.get(k, -1) for k in owner.tolist()], np.int64)


def _carriers(scene: BakedScene, t: np.ndarray, xy: np.ndarray, instance: np.ndarray) -> Carriers:
    """Find every query's instance (given, or -1), contributors and surface point in its own frame."""
    count = min(CARRIERS, len(scene.xyz))
    rows, weights = np.zeros((len(t), count), np.int64), np.zeros((len(t), count))
    offsets, owner = np.zeros((len(t), count, 3)), np.zeros(len(t), np.int64)
    for i in np.unique(t):
        frame, view = scene.frame(int(i)), scene.cameras.view(int(i))
        means, conics, depth = _project_splats(frame, view)
        turns = quaternion_to_matrix(frame.quats.astype(np.float64))
        camera_to_world = np.linalg.inv(view.world_to_camera)
        shares, _ = _shares(scene, frame, view)
        winners = np.where(shares.sum(axis=-1) > _SEEN_ALPHA, np.argmax(shares, axis=-1), -1)
        of_objects = [k for k, o in enumerate(scene.objects) if not o.is_background]
        for n in np.flatnonzero(t == i):
            mine = np.full(len(means), True) if instance[n] < 0 else frame.object_index == instance[n]
            place = _onto_object(xy[n], np.isin(winners, of_objects if instance[n] < 0 else instance[n]), view)
            share = _contributions(place, means, conics, depth, np.where(mine, frame.opacities, 0.0))
            near = np.where(mine, depth, np.inf)
            rows[n], weights[n], owner[n] = _choose(share, frame, xy[n], means, near, count)
            z = _surface_depth(depth[rows[n]], weights[n])
            ray = np.array([(xy[n, 0] - view.cx) / view.fx, (xy[n, 1] - view.cy) / view.fy, 1.0])
            point = camera_to_world[:3, :3] @ (ray * z) + camera_to_world[:3, 3]
            away = point - frame.means[rows[n]]
            offsets[n] = np.einsum("cji,cj->ci", turns[rows[n]], away)
    return Carriers(rows, weights, offsets, owner)


def _onto_object(pixel: np.ndarray, on_object: np.ndarray, view: View) -> np.ndarray:  # (2,) px -> (2,) px
    """The centre of the nearest pixel of an object if one is within RIM and the query's own shows none; else itself."""
    height, width = on_object.shape
    scale = np.array([width / view.width, height / view.height])
    column, row = np.clip(np.floor(pixel * scale), 0, [width - 1, height - 1]).astype(np.int64)
    if on_object[row, column]:
        return pixel
    reach = RIM * min(width, height)
    top, left = max(0, int(row - reach)), max(0, int(column - reach))
    rows, columns = np.nonzero(on_object[top : int(row + reach) + 2, left : int(column + reach) + 2])
    centres = np.stack([columns + left, rows + top], axis=-1) + 0.5
    distance = np.linalg.norm(centres - pixel * scale, axis=1)
    if not (distance <= reach).any():
        return pixel
    return centres[np.argmin(distance)] / scale


def _project_splats(frame: Frame, view: View) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """EWA projection (rasterizer.py): means (N, 2) px, conics (N, 3) as (a, b, c), depth (N,); far depth if culled."""
    rotation = view.world_to_camera[:3, :3]
    camera = frame.means @ rotation.T + view.world_to_camera[:3, 3]
    behind = camera[:, 2] <= view.near
    z = np.where(behind, 1.0, camera[:, 2])
    extent, centre, focal = np.array([view.width, view.height]), [view.cx, view.cy], [view.fx, view.fy]
    margin = (FRUSTUM_CLAMP - 1) / 2 * extent
    slope = np.clip(camera[:, :2] / z[:, None], -(centre + margin) / focal, (extent - centre + margin) / focal)
    jacobian = np.zeros((len(z), 2, 3))
    jacobian[:, 0, 0], jacobian[:, 1, 1] = view.fx / z, view.fy / z
    jacobian[:, 0, 2], jacobian[:, 1, 2] = -view.fx * slope[:, 0] / z, -view.fy * slope[:, 1] / z
    axes = quaternion_to_matrix(frame.quats.astype(np.float64)) * frame.scales[:, None, :]
    spread = jacobian @ rotation @ axes
    covariance = spread @ spread.transpose(0, 2, 1) + view.dilation * np.eye(2)
    inverse = np.linalg.inv(covariance)
    conics = np.stack([inverse[:, 0, 0], inverse[:, 0, 1], inverse[:, 1, 1]], axis=-1)
    pixels = camera[:, :2] / z[:, None] * [view.fx, view.fy] + [view.cx, view.cy]
    return np.where(behind[:, None], 1e9, pixels), conics, np.where(behind, np.inf, camera[:, 2])


def _contributions(
    pixel: np.ndarray, means: np.ndarray, conics: np.ndarray, depth: np.ndarray, opacities: np.ndarray
) -> np.ndarray:  # (N,) alpha T of every Gaussian at a pixel
    """Front-to-back blending weights at one place of the picture."""
    dx, dy = (pixel - means).T
    power = 0.5 * (conics[:, 0] * dx * dx + conics[:, 2] * dy * dy) + conics[:, 1] * dx * dy
    alpha = np.minimum(ALPHA_MAX, opacities * np.exp(-np.minimum(power, 50.0)))
    hit = np.flatnonzero((alpha >= ALPHA_MIN) & np.isfinite(depth))
    hit = hit[np.argsort(depth[hit], kind="stable")]
    through = np.cumprod(1.0 - alpha[hit])
    share = np.zeros(len(means))
    share[hit] = alpha[hit] * np.concatenate([[1.0], through[:-1]])[: len(hit)]
    return share


def _choose(
    share: np.ndarray, frame: Frame, pixel: np.ndarray, means: np.ndarray, depth: np.ndarray, count: int
) -> tuple[np.ndarray, np.ndarray, int]:
    """The instance with the largest share, its strongest Gaussians and their weights.

    Where nothing shows, the nearest centre on the picture decides and carries alone.
    """
    owner = frame.object_index
    if share.sum() > 0:
        instance = int(np.argmax(np.bincount(owner, weights=share)))
        own = np.where(owner == instance, share, 0.0)
        rows = np.argsort(-own, kind="stable")[:count]
        return rows, own[rows] / own[rows].sum(), instance
    distance = np.where(np.isfinite(depth), np.linalg.norm(means - pixel, axis=1), np.inf)
    nearest = int(np.argmin(distance))
    weights = np.zeros(count)
    weights[0] = 1.0
    return np.full(count, nearest), weights, int(owner[nearest])


def _surface_depth(depth: np.ndarray, weights: np.ndarray) -> float:  # (C,), (C,) summing to 1
    """The depth in front of which half the weight lies; a mean lies between front and back where the front is thin."""
    order = np.argsort(depth, kind="stable")
    before = np.cumsum(weights[order]) - 0.5 * weights[order]
    return float(np.interp(0.5, before, depth[order]))


def _carried(carriers: Carriers, scene: BakedScene, frame: Frame, i: int, t: np.ndarray) -> np.ndarray:  # (N, 3)
    """World position of every query's surface point in frame i; offsets grow with the object's placement scale."""
    turns = quaternion_to_matrix(frame.quats[carriers.rows].astype(np.float64))
    size = np.cbrt(np.linalg.det(scene.object_to_world[..., :3].astype(np.float64)))  # (T, K)
    growth = size[i, carriers.object] / size[t, carriers.object]
    moved = frame.means[carriers.rows] + growth[:, None, None] * np.einsum("ncij,ncj->nci", turns, carriers.offsets)
    return np.einsum("nc,nci->ni", carriers.weights, moved)


def _states(
    scene: BakedScene, frame: Frame, i: int, owner: np.ndarray, pixels: np.ndarray, depth: np.ndarray
) -> np.ndarray:  # (N,) uint8
    """VISIBLE, OCCLUDED or OUT_OF_VIEW of points at `pixels` (N, 2) and `depth` (N,) in frame i."""
    view = scene.cameras.view(i)
    shares, surface = _shares(scene, frame, view)
    winners = np.argmax(shares, axis=-1)
    height, width = winners.shape
    outside = (pixels < 0).any(axis=1) | (pixels >= [view.width, view.height]).any(axis=1) | (depth <= view.near)
    place = np.floor(pixels * [width / view.width, height / view.height])
    column, row = np.clip(place, 0, [width - 1, height - 1]).astype(np.int64).T
    shown = shares[row, column, owner] > SHOWS
    reach = round(NEARBY * min(width, height))
    around = cv2.getStructuringElement(cv2.MORPH_ELLIPSE, (2 * reach + 1, 2 * reach + 1))
    before = np.zeros(len(owner), bool)
    for k in np.unique(owner):
        own = owner == k
        farthest = cv2.dilate(np.where(winners == k, surface, 0.0), around)[row[own], column[own]]
        before[own] = depth[own] <= farthest + BEHIND * _size(frame.means[frame.object_index == k])
    return np.where(outside, OUT_OF_VIEW, np.where(shown & before, VISIBLE, OCCLUDED)).astype(np.uint8)


def _size(means: np.ndarray) -> float:  # (N, 3)
    """Size of a cloud, as objects are measured in the lift: twice the distance from the middle that 95 % are within."""
    return 2.0 * float(np.percentile(np.linalg.norm(means - np.median(means, axis=0), axis=1), 95))


def _shares(scene: BakedScene, frame: Frame, view: View) -> tuple[np.ndarray, np.ndarray]:
    """Share of every pixel that each object fills (H, W, K), and the mean depth (H, W) of the one with the largest.

    At TEST_SHORT_SIDE at most.
    """
    scale = min(1.0, TEST_SHORT_SIDE / min(view.width, view.height))
    small = view.resized(max(1, round(view.width * scale)), max(1, round(view.height * scale)))
    labels = np.eye(len(scene.objects), dtype=np.float32)[frame.object_index]
    depths = labels * project(frame.means, view)[1][:, None].astype(np.float32)
    features = np.concatenate([labels, depths], axis=1)
    drawn = rasterize(Splats(frame.means, frame.quats, frame.scales, frame.opacities, features), small)
    shares, depth = np.split(drawn.features, 2, axis=-1)
    winners = np.argmax(shares, axis=-1)[..., None]
    surface = np.take_along_axis(depth, winners, -1) / np.maximum(np.take_along_axis(shares, winners, -1), 1e-4)
    return shares, surface[..., 0]
