"""Procedural clips with exact truth: shapes that cross and hide each other, made from formulas alone.

`generate` gives the clip as a camera would (frames, masks, depth, cameras) and everything it does not tell: flow,
tracks with occlusion, novel views. Deterministic. Formats as the shared Blender clips (`synthetic_files`).
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np

from genmojo_core.clip import shapes
from genmojo_core.clip.cameras import Cameras, View
from genmojo_core.clip.clip import Channel, Clip
from genmojo_core.clip.points import OCCLUDED, OUT_OF_VIEW, VISIBLE
from genmojo_core.clip.shapes import NOTHING, Hits
from genmojo_core.clip.synthetic_specs import SyntheticSpec, spec
from genmojo_core.conventions import orbit_camera
from genmojo_core.errors import GenmojoError

UP = np.array([0.0, 0.0, 1.0])
CENTRE = (0.5, 0.5)  # of a pixel: where masks, depth and flow are taken
QUARTERS = tuple((x, y) for y in (0.25, 0.75) for x in (0.25, 0.75))  # where colours are taken, and averaged
ANGLES = ((0, -30), (0, 30), (-30, 0), (30, 0), (0, -90), (0, 90), (0, 180))  # (elevation, azimuth), as Blender clips


@dataclass(frozen=True)
class Truth:
    """What no input tells; names as in the Blender clips' truth.npz. P points, A angles, F novel frames.

    Args:
        depth: (T, H, W) float32 z. labels: (T, H, W) uint8. K: (3, 3). world_to_camera: (T, 4, 4).
        flow: (T, H, W, 2) float32 px to the next frame, also of what gets hidden; flow_valid: (T, H, W) bool.
        tracks: (P, T, 2) float32 raster px. visible: (P, T) bool. state: (P, T) as in `points`.
        track_object: (P,) ids. track_xyz: (P, T, 3) float32 world.
        novel_angles: (A, 2) degrees. novel_world_to_camera: (A, T, 4, 4). novel_frames: (F,).
        novel: (A, F, H, W, 4) uint8 RGBA of the objects alone, straight alpha. orbit_centre: (3,) world.
    """

    depth: np.ndarray
    labels: np.ndarray
    K: np.ndarray
    world_to_camera: np.ndarray
    flow: np.ndarray
    flow_valid: np.ndarray
    tracks: np.ndarray
    visible: np.ndarray
    state: np.ndarray
    track_object: np.ndarray
    track_xyz: np.ndarray
    novel_angles: np.ndarray
    novel_world_to_camera: np.ndarray
    novel_frames: np.ndarray
    novel: np.ndarray
    orbit_centre: np.ndarray


def generate(what: SyntheticSpec | str) -> tuple[Clip, Truth]:
    """The clip of a spec, or of a named one, and its truth.

    Raises GenmojoError("argument") for a spec without frames or shapes, or an unknown name.
    """
    if isinstance(what, str):
        what = spec(what)
    if what.frames < 1 or not what.shapes or min(what.size) < 1:
        raise GenmojoError("argument", "a procedural clip needs at least one frame, one pixel and one shape", what.name)
    stage = Stage(what)
    frames = np.empty((what.frames, what.size[1], what.size[0], 3), np.uint8)
    hits = []
    for t in range(what.frames):
        frames[t], centre = stage.picture(t)
        hits.append(centre)
    truth = _truth(stage, hits)
    return _clip(what, frames, truth), truth


def novel_view(what: SyntheticSpec, t: int, elevation: float, azimuth: float) -> np.ndarray:
    """(H, W, 4) uint8 RGBA, straight alpha, of the objects alone in frame t from any view (conventions.py)."""
    stage = Stage(what)
    return stage.objects_alone(t, stage.novel_pose(t, elevation, azimuth))


class Stage:
    """A spec with its matrices and cameras worked out for every frame."""

    def __init__(self, what: SyntheticSpec) -> None:
        self.what = what
        phases = np.arange(what.frames) / max(1, what.frames - 1)
        self.matrices = [[shape.matrix(p) for shape in what.shapes] for p in phases]
        self.kinds = [shape.kind for shape in what.shapes]
        self.lights = [what.light[0] + (what.light[1] - what.light[0]) * p for p in phases]
        eyes = [np.array(what.eye[0]) * (1 - p) + np.array(what.eye[1]) * p for p in phases]
        width, height = what.size
        focal = what.focal * width
        self.views = [
            View(_looking(eye, np.array(what.target)), focal, focal, width / 2, height / 2, width, height)
            for eye in eyes
        ]
        self.orbit_centre = np.mean([m[:3, 3] for row in self.matrices for m in row], axis=0)
        self._backdrops: dict[tuple[bytes, float], list[np.ndarray]] = {}

    def picture(self, t: int) -> tuple[np.ndarray, Hits]:
        """(H, W, 3) uint8 RGB of frame t and the hits at its pixel centres."""
        total = np.zeros((self.what.size[1], self.what.size[0], 3))
        for offset, backdrop in zip(QUARTERS, self._backdrop(t), strict=True):
            hits = self.cast(t, self.views[t], offset, alone=True)
            colour = shapes.shade(hits, self.what.shapes, self.matrices[t], self.lights[t])
            total += np.where((hits.owner >= 0)[..., None], colour, backdrop)
        return _bytes(total / len(QUARTERS)), self.cast(t, self.views[t], CENTRE, alone=False)

    def objects_alone(self, t: int, pose: np.ndarray) -> np.ndarray:
        """(H, W, 4) uint8 RGBA of the objects in frame t from another pose."""
        colour = np.zeros((self.what.size[1], self.what.size[0], 3))
        cover = np.zeros(colour.shape[:2])
        for offset in QUARTERS:
            hits = self.cast(t, self.views[t].with_pose(pose), offset, alone=True)
            colour += shapes.shade(hits, self.what.shapes, self.matrices[t], self.lights[t])
            cover += hits.owner >= 0
        straight = colour / np.maximum(cover, 1)[..., None]
        return np.dstack([_bytes(straight), _bytes(cover / len(QUARTERS))])

    def cast(self, t: int, view: View, offset: tuple[float, float], *, alone: bool) -> Hits:
        """Hits of frame t from a view, with or without ground and wall."""
        return shapes.cast(view, self.matrices[t], self.kinds, None if alone else self.what.wall, offset)

    def novel_pose(self, t: int, elevation: float, azimuth: float) -> np.ndarray:
        """(4, 4) world to camera of frame t's camera turned about the orbit centre."""
        return orbit_camera(self.views[t].world_to_camera, self.orbit_centre, UP, elevation, azimuth)

    def world(self, t: int, owner: int, points: np.ndarray) -> np.ndarray:
        """(N, 3) world coordinates in frame t of material points of one owner."""
        if owner < 0:
            return points
        matrix = self.matrices[t][owner]
        return points @ matrix[:3, :3].T + matrix[:3, 3]

    def _backdrop(self, t: int) -> list[np.ndarray]:
        """(H, W, 3) colours of ground and wall per quarter of a pixel; kept while camera and light stand still."""
        key = (self.views[t].world_to_camera.tobytes(), float(self.lights[t]))
        if key not in self._backdrops:
            casts = [shapes.cast(self.views[t], [], [], self.what.wall, offset) for offset in QUARTERS]
            self._backdrops = {key: [shapes.shade(hits, (), [], self.lights[t]) for hits in casts]}
        return self._backdrops[key]


def _clip(what: SyntheticSpec, frames: np.ndarray, truth: Truth) -> Clip:
    """The clip as a reader would give it."""
    count = what.frames
    first = np.unique(what.object_of(), return_index=True)[1]
    everywhere = np.ones(frames.shape[:3], bool)
    cameras = Cameras(np.repeat(truth.K[None], count, axis=0), truth.world_to_camera, what.size)
    carried: dict[str, Any] = {
        "depth": Channel(truth.depth, np.isfinite(truth.depth), "given: procedural"),
        "cameras": Channel(cameras, np.ones(count, bool), "given: procedural"),
        "flow": Channel(truth.flow, truth.flow_valid, "given: procedural"),
    }
    return Clip(
        name=what.name,
        path="procedural",
        frames=frames,
        frame_index=np.arange(count),
        seconds=np.arange(count) / what.fps,
        source_names=tuple(f"{t:05d}.jpg" for t in range(count)),
        source_size=what.size,
        object_ids=np.arange(1, len(first) + 1),
        object_names=tuple(f"{what.shapes[shape].kind} {k}" for k, shape in enumerate(first, 1)),
        masks=Channel(truth.labels, everywhere, "given: procedural"),
        world_up=UP if "cameras" in what.given else np.array([0.0, -1.0, 0.0]),
        **{name: carried[name] for name in what.given},
    )


def _truth(stage: Stage, hits: list[Hits]) -> Truth:
    """Everything but the pictures."""
    what, objects = stage.what, stage.what.object_of()
    flow, flow_valid = _flow(stage, hits)
    owners, points = _material_points(stage, hits)
    tracks, state, xyz = _carried(stage, owners, points)
    chosen = np.arange(0, what.frames, what.novel_every) if what.novel_every else np.arange(0)
    poses = np.array([[stage.novel_pose(t, *angle) for t in range(what.frames)] for angle in ANGLES])
    novel = np.zeros((len(ANGLES), len(chosen), what.size[1], what.size[0], 4), np.uint8)
    for a in range(len(ANGLES)):
        for f, t in enumerate(chosen):
            novel[a, f] = stage.objects_alone(int(t), poses[a, t])
    return Truth(
        depth=np.stack([h.depth for h in hits]).astype(np.float32),
        labels=np.stack([np.where(h.owner >= 0, objects[np.maximum(h.owner, 0)] + 1, 0) for h in hits]).astype(
            np.uint8
        ),
        K=stage.views[0].K,
        world_to_camera=np.stack([v.world_to_camera for v in stage.views]),
        flow=flow,
        flow_valid=flow_valid,
        tracks=tracks,
        visible=state == VISIBLE,
        state=state,
        track_object=objects[owners] + 1,
        track_xyz=xyz,
        novel_angles=np.array(ANGLES),
        novel_world_to_camera=poses,
        novel_frames=chosen,
        novel=novel,
        orbit_centre=stage.orbit_centre,
    )


def _flow(stage: Stage, hits: list[Hits]) -> tuple[np.ndarray, np.ndarray]:
    """Where each pixel's material point is in the next frame, minus where it is."""
    width, height = stage.what.size
    flow = np.zeros((len(hits), height, width, 2), np.float32)
    valid = np.zeros((len(hits), height, width), bool)
    grid = np.stack(np.meshgrid(np.arange(width) + 0.5, np.arange(height) + 0.5), axis=-1)
    for t in range(len(hits) - 1):
        for owner in np.setdiff1d(hits[t].owner, NOTHING):
            mine = hits[t].owner == owner
            xy, z = _projected(stage.views[t + 1], stage.world(t + 1, int(owner), hits[t].point[mine]))
            flow[t][mine] = xy - grid[mine]
            valid[t][mine] = z > 0
    return flow, valid


def _material_points(stage: Stage, hits: list[Hits]) -> tuple[np.ndarray, np.ndarray]:
    """Owners (P,) and material points (P, 3): of each shape, half seen in frame 0, the rest at other times."""
    random = np.random.default_rng(stage.what.seed)
    owners, points = [], []
    for k in range(len(stage.what.shapes)):
        seen = [t for t in range(len(hits)) if (hits[t].owner == k).any()]
        for i in range(stage.what.tracks if seen else 0):
            t = seen[0] if i % 2 == 0 else seen[int(random.integers(len(seen)))]
            rows, columns = np.nonzero(hits[t].owner == k)
            pick = int(random.integers(len(rows)))
            owners.append(k)
            points.append(hits[t].point[rows[pick], columns[pick]])
    return np.array(owners, np.int64), np.array(points).reshape(-1, 3)


def _carried(stage: Stage, owners: np.ndarray, points: np.ndarray) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """(P, T, 2) pixels, (P, T) states and (P, T, 3) world places of material points in every frame."""
    count, frames = len(owners), stage.what.frames
    xy, xyz = np.zeros((count, frames, 2)), np.zeros((count, frames, 3))
    state = np.full((count, frames), OUT_OF_VIEW, np.uint8)
    for t, view in enumerate(stage.views):
        for k in np.unique(owners):
            xyz[owners == k, t] = stage.world(t, int(k), points[owners == k])
        xy[:, t], z = _projected(view, xyz[:, t])
        inside = (z > 0) & (xy[:, t] >= 0).all(axis=1) & (xy[:, t] < stage.what.size).all(axis=1)
        first = shapes.first_depth(view, stage.matrices[t], stage.kinds, xy[:, t])
        state[inside, t] = np.where(first > z * (1 - 1e-6), VISIBLE, OCCLUDED)[inside]
    return xy.astype(np.float32), state, xyz.astype(np.float32)


def _projected(view: View, points: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """(N, 2) raster pixels and (N,) depths of (N, 3) world points."""
    local = points @ view.world_to_camera[:3, :3].T + view.world_to_camera[:3, 3]
    z = local[:, 2]
    safe = np.where(np.abs(z) < 1e-12, 1e-12, z)
    return np.stack([local[:, 0] / safe * view.fx + view.cx, local[:, 1] / safe * view.fy + view.cy], axis=-1), z


def _looking(eye: np.ndarray, target: np.ndarray) -> np.ndarray:
    """(4, 4) world to camera, OpenCV axes, upright."""
    forward = (target - eye) / np.linalg.norm(target - eye)
    right = np.cross(forward, UP)
    right /= np.linalg.norm(right)
    rotation = np.stack([right, np.cross(forward, right), forward])
    pose = np.eye(4)
    pose[:3, :3], pose[:3, 3] = rotation, -rotation @ eye
    return pose


def _bytes(values: np.ndarray) -> np.ndarray:
    """0..1 as uint8."""
    return np.round(values * 255).astype(np.uint8)
