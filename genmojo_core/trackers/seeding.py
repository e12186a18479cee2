"""First tracks for annotation behind one interface: optical, scene, cotracker, file.

A seeder answers queries with tracks in source pixels; they become proposals beside the tracks, and fill only what no
person has said (`tracks.keys.accept`).

    seeder = make("scene", path="scene.h5")
    ids, queries = Queries.of(annotation)
    tracks = merged(seeder.seed(clip, queries, progress), queries)
    project.do(accept(annotation, proposals(tracks, ids, seeder.name), TRACKER))
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Protocol

import numpy as np

from genmojo_core.clip.clip import Clip
from genmojo_core.errors import GenmojoError
from genmojo_core.store import track_npz
from genmojo_core.trackers.solver import SolveRequest, TrackSolver
from genmojo_core.tracks.annotation import CONFIRMED, HUMAN, KEY, Annotation, Cells, Proposal
from genmojo_core.tracks.interpolate import placed
from genmojo_core.tracks.model import NONE, VISIBLE, PointTracks

if TYPE_CHECKING:
    from genmojo_core.store.scene_file import BakedScene

NAMES = ("optical", "scene", "cotracker", "file")
_ALIKE = 0.5  # correlation of pictures from which a scene is taken to be of the clip
_SHAPE = 0.02  # by which width / height may differ
_STRAY = 0.2  # of the visible places of a file outside the picture: it is of another size
_NEAR = 0.02  # of the picture's height: a track of a file this near a query at its frame is taken for it
_LINK_SECONDS = 0.02  # of process time per match between two frames
_LINKS_PER_FRAME = 12
_SCENE_FRAME_SECONDS = 0.15  # to test visibility in one frame of a scene

_FILE_BYTES = 2e7  # a second's worth of a file

Progress = Callable[[float], None]
Cancelled = Callable[[], bool]


@dataclass(frozen=True)
class Queries:
    """Where points to follow are seen: t (N,) frame positions, xy (N, 2) source raster px, object (N,) mask ids (0:
    none). point (N,): which point each shows, 0..P-1 and all of one in a row; by default each a point of its own.
    """

    t: np.ndarray
    xy: np.ndarray
    object: np.ndarray
    point: np.ndarray | None = None

    @staticmethod
    def of(annotation: Annotation, tracks: list[int] | None = None) -> tuple[list[int], Queries]:
        """Every visible key of every track (or of some). Returns the ids of the points and the queries.

        Tracks without a visible key are left out: where a point is hidden, something else is seen.
        """
        asked = [info.id for info in annotation.active()] if tracks is None else tracks
        seen = {i: [t for t in annotation.keys(i) if annotation.track(i).state[t] == VISIBLE] for i in asked}
        ids = [i for i, frames in seen.items() if frames]
        each = [(n, i, t) for n, i in enumerate(ids) for t in seen[i]]
        xy = np.array([annotation.track(i).xy[t] for _, i, t in each], np.float64).reshape(-1, 2)
        owner = np.array([annotation.tracks[i].object for _, i, _ in each], np.int64)
        return ids, Queries(np.array([t for *_, t in each], np.int64), xy, owner,
                            np.array([n for n, *_ in each], np.int64))  # fmt: skip

    def points(self) -> list[np.ndarray]:
        """The rows of every point, in their order."""
        point = np.arange(len(self.t)) if self.point is None else self.point
        return [np.flatnonzero(point == n) for n in range(int(point.max(initial=-1)) + 1)]


class Seeder(Protocol):
    """Something that follows points through a clip."""

    name: str
    licence: str  # shown before the first use; empty for our own

    def forecast(self, clip: Clip, queries: Queries) -> float:
        """Seconds it will probably take."""

    def seed(
        self, clip: Clip, queries: Queries, progress: Progress | None = None, cancelled: Cancelled | None = None
    ) -> PointTracks:
        """Tracks in the order of the queries, source pixels, with `conf`. Raises GenmojoError."""


class OpticalSeeder:
    """The embedded tracker: matches inside masks, solved together (trackers/solver.py).

    Args:
        solver: to share what was matched with the solver that answers keys; made anew by default.
    """

    name, licence = "optical", ""

    def __init__(self, solver: TrackSolver | None = None) -> None:
        self._solver = solver

    def forecast(self, clip: Clip, queries: Queries) -> float:
        """From the number of matches between frames."""
        return _LINK_SECONDS * _LINKS_PER_FRAME * len(clip) * len(np.unique(queries.object))

    def seed(
        self, clip: Clip, queries: Queries, progress: Progress | None = None, cancelled: Cancelled | None = None
    ) -> PointTracks:
        """Tracks of points that lie on objects with masks."""
        solver = self._solver or TrackSolver(clip)
        frames = len(clip)
        xy = np.zeros((len(queries.t), frames, 2), np.float32)
        state, conf = np.zeros((len(xy), frames), np.uint8), np.zeros((len(xy), frames), np.float32)
        owners = np.unique(queries.object)
        for number, owner in enumerate(owners):
            points = [p for p in queries.points() if queries.object[p[0]] == owner]
            cells = tuple(_keyed(queries, p, frames) for p in points)
            request = SolveRequest(int(owner), clip.source_size, tuple(range(len(points))), cells, None)
            found = solver.answer(request, cancelled=cancelled).found
            for n, (_, answer) in found.items():
                xy[points[n]], state[points[n]], conf[points[n]] = answer.xy, answer.state, answer.conf
            if progress is not None:
                progress((number + 1) / len(owners))
        return PointTracks(xy, state, queries.object, clip.source_size, conf=conf)


class SceneSeeder:
    """Tracks through occlusion from an optimised 4D scene of the same clip. Args: path: its scene.h5."""

    name, licence = "scene", ""

    def __init__(self, path: str | Path) -> None:
        self.path = Path(path)

    def forecast(self, clip: Clip, queries: Queries) -> float:
        """From the number of frames; the scene exists already."""
        return 1.0 + _SCENE_FRAME_SECONDS * len(clip)

    def seed(
        self, clip: Clip, queries: Queries, progress: Progress | None = None, cancelled: Cancelled | None = None
    ) -> PointTracks:
        """Tracks with occlusion flags, carried by the Gaussians of their objects that show at each query.

        Nothing is found for objects that the scene does not have. Raises GenmojoError("value") for a scene of another
        clip: other frames, another shape of the picture, or a picture unlike the clip's (`scene.likeness`).
        """
        from genmojo_core.store import scene_hdf5
        from genmojo_core.trackers import scene as scene_tracker

        scene = scene_hdf5.read(self.path)
        self._check_clip(scene, clip)
        size = np.array(scene.cameras.size, np.float64)
        xy = np.clip(queries.xy * size / np.array(clip.source_size), 0.0, size)
        held = [o.id for o in scene.objects if o.count and not o.is_background]
        rows = np.flatnonzero(np.isin(queries.object, [0, *held]))
        places = np.full((len(xy), len(clip), 2), np.nan, np.float32)
        state, conf = np.full(places.shape[:2], NONE, np.uint8), np.zeros(places.shape[:2], np.float32)
        if len(rows):
            t, owner = queries.t[rows], queries.object[rows]
            tracks = scene_tracker.track(scene, t, xy[rows], progress, owner, cancelled).resized(*clip.source_size)
            places[rows], state[rows] = tracks.xy, tracks.state
            conf[rows] = np.where(tracks.state == VISIBLE, 0.7, 0.5)
        return PointTracks(places, state, queries.object, clip.source_size, conf=conf)

    def _check_clip(self, scene: BakedScene, clip: Clip) -> None:
        """Raise GenmojoError("value") unless the scene is of this clip."""
        from genmojo_core.trackers.scene import likeness

        where = str(self.path)
        if len(scene) != len(clip):
            raise GenmojoError("value", f"has {len(scene)} frames, the clip {len(clip)}", where,
                               "optimise this clip first")  # fmt: skip
        (width, height), (w, h) = scene.cameras.size, clip.source_size
        if abs(width * h / (height * w) - 1.0) > _SHAPE:
            raise GenmojoError("value", f"has {width} x {height} pixels, the clip {w} x {h}", where,
                               "optimise this clip first")  # fmt: skip
        alike = likeness(scene, clip.frames, sorted({0, len(clip) // 2, len(clip) - 1}))
        if alike < _ALIKE:
            raise GenmojoError("value", f"is a scene of another clip: their pictures are alike by {alike:.2f} only",
                               where, "optimise this clip first")  # fmt: skip


class FileSeeder:
    """Tracks somebody made before: TAP-Vid npz, CoTracker npz, our npz. Args: path: the file."""

    name, licence = "file", ""

    def __init__(self, path: str | Path) -> None:
        self.path = Path(path)

    def forecast(self, clip: Clip, queries: Queries) -> float:
        """From the size of the file."""
        return 0.5 + (self.path.stat().st_size / _FILE_BYTES if self.path.is_file() else 0.0)

    def seed(
        self, clip: Clip, queries: Queries, progress: Progress | None = None, cancelled: Cancelled | None = None
    ) -> PointTracks:
        """For each point the track of the file that is nearest to it in a frame of its queries, if one is near.

        No track is taken for two points. Raises GenmojoError("schema") for a file of other frames or another size.
        """
        tracks = track_npz.read(self.path, clip.source_size).tracks
        if tracks.state.shape[1] != len(clip):
            raise GenmojoError("schema", f"has {tracks.state.shape[1]} frames, the clip {len(clip)}", str(self.path))
        tracks = placed(tracks.resized(*clip.source_size))
        self._check_places(tracks)
        frames, points = len(clip), queries.points()
        gap = np.linalg.norm(tracks.xy[:, queries.t] - queries.xy, axis=-1)  # (tracks, N)
        gap = np.where(np.isfinite(gap), gap, np.inf)
        nearest = np.stack([gap[:, rows].min(axis=1) for rows in points], axis=1)  # (tracks, P)
        xy = np.zeros((len(queries.t), frames, 2), np.float32)
        state, conf = np.zeros((len(xy), frames), np.uint8), np.zeros((len(xy), frames), np.float32)
        for best, n in _pairs(nearest, _NEAR * clip.source_size[1]):
            xy[points[n]], state[points[n]] = np.nan_to_num(tracks.xy[best]), tracks.state[best]
            conf[points[n]] = 0.5 if tracks.conf is None else tracks.conf[best]
        return PointTracks(xy, state, queries.object, clip.source_size, conf=conf)

    def _check_places(self, tracks: PointTracks) -> None:
        """Raise GenmojoError("schema") where many visible places lie outside the picture."""
        seen = tracks.xy[tracks.visible]
        size = np.array(tracks.size)
        if len(seen) and ((seen < 0) | (seen > size)).any(axis=1).mean() > _STRAY:
            reach = np.abs(seen).max(axis=0)
            raise GenmojoError("schema", f"has visible points up to {reach[0]:.0f}, {reach[1]:.0f}, the clip has "
                               f"{size[0]} x {size[1]} pixels", str(self.path),
                               "store the size its pixels belong to: size = (width, height)")  # fmt: skip


def make(name: str, path: str | Path | None = None, **options: str) -> Seeder:
    """A seeder by name.

    Args:
        name: one of NAMES. path: the scene.h5 of "scene", the file of "file", the checkout of "cotracker".
        options: of "cotracker": checkpoint, a path; consent, "yes" for models from torch.hub; window, frames at once;
            memory, GiB that it may take.
    Raises GenmojoError("argument") for what is missing.
    """
    if name == "optical":
        return OpticalSeeder()
    if name not in NAMES:
        raise GenmojoError("argument", f"there is no tracker '{name}'", hint=f"use one of {', '.join(NAMES)}")
    if path is None:
        raise GenmojoError("argument", f"'{name}' needs a path", hint=f"write {name}:PATH")
    if name == "scene":
        return SceneSeeder(path)
    if name == "file":
        return FileSeeder(path)
    from genmojo_core.trackers.cotracker import CoTrackerSeeder, Limits

    wanted = {"window": (int, options.get("window")), "memory_gib": (float, options.get("memory"))}
    limits = Limits(**{key: kind(text) for key, (kind, text) in wanted.items() if text})
    checkpoint = Path(options["checkpoint"]) if options.get("checkpoint") else None
    return CoTrackerSeeder(Path(path), checkpoint, limits, consent=options.get("consent") == "yes")


def merged(tracks: PointTracks, queries: Queries) -> PointTracks:
    """One track per point: between two of its queries both their tracks by distance in time and confidence.

    Before its first and after its last query that one's own; the state is that of the track with more say.
    """
    points = queries.points()
    if len(points) == len(queries.t):
        return tracks
    tracks = placed(tracks)
    frames = np.arange(tracks.state.shape[1])
    own = np.full(tracks.state.shape, 0.5, np.float32) if tracks.conf is None else tracks.conf
    xy, state, conf = [], [], []
    for rows in points:
        t, order = np.unique(queries.t[rows], return_index=True)
        rows = rows[order]
        known = tracks.state[rows] != NONE
        say = np.stack([np.interp(frames, t, one) for one in np.eye(len(t))]) * np.maximum(own[rows], 0.01)
        say = (say + 1e-6 / (1.0 + np.abs(frames - t[:, None]))) * known  # where neither neighbour knows: the nearest
        share = say / np.maximum(say.sum(axis=0), 1e-12)
        xy.append(np.where(known.any(axis=0)[:, None],
                           (share[..., None] * np.nan_to_num(tracks.xy[rows])).sum(axis=0), np.nan))  # fmt: skip
        state.append(np.take_along_axis(tracks.state[rows], share.argmax(axis=0)[None], axis=0)[0])
        conf.append((share * own[rows]).sum(axis=0))
    owner = queries.object[[rows[0] for rows in points]]
    return PointTracks(np.array(xy, np.float32), np.array(state), owner, tracks.size, conf=np.array(conf, np.float32))


def proposals(tracks: PointTracks, ids: list[int], name: str) -> dict[int, Proposal]:
    """Tracks, row by row, as proposals for tracks of an annotation."""
    tracks = placed(tracks)
    conf = np.full(tracks.state.shape, 0.5, np.float32) if tracks.conf is None else tracks.conf
    return {track: Proposal(name, np.nan_to_num(tracks.xy[row]).astype(np.float32), tracks.state[row],
                            conf[row].astype(np.float32)) for row, track in enumerate(ids)}  # fmt: skip


def _pairs(gap: np.ndarray, most: float) -> list[tuple[int, int]]:
    """Rows and columns of a table, each once, the smallest entries first, none above `most`."""
    out: list[tuple[int, int]] = []
    left = gap.copy()
    while left.size and left.min() <= most:
        row, column = (int(k) for k in np.unravel_index(np.argmin(left), left.shape))
        out.append((row, column))
        left[row], left[:, column] = np.inf, np.inf
    return out


def _keyed(queries: Queries, rows: np.ndarray, frames: int) -> Cells:
    """Cells that know the queries of one point only."""
    cells = Cells.empty(frames)
    t = queries.t[rows]
    if (t < 0).any() or (t >= frames).any():
        raise GenmojoError("value", f"a query asks at frame {t[(t < 0) | (t >= frames)][0]}, the clip has 0 to "
                           f"{frames - 1}", "queries")  # fmt: skip
    cells.xy[t], cells.state[t], cells.flags[t] = queries.xy[rows], VISIBLE, KEY | CONFIRMED
    cells.source[t], cells.conf[t] = HUMAN, 1.0
    return cells
