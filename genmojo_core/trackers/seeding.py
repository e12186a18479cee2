"""First tracks for annotation behind one interface: optical, scene, cotracker, file.

A seeder answers queries with tracks in source pixels; they become proposals beside the tracks, and fill only what no
person has said (`tracks.keys.accept`).

    seeder = make("scene", path="scene.h5")
    tracks = seeder.seed(clip, queries, progress)
    project.do(accept(annotation, proposals(tracks, ids, seeder.name), TRACKER))
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path
from typing import Protocol

import numpy as np

from genmojo_core.clip.clip import Clip
from genmojo_core.errors import GenmojoError
from genmojo_core.store import track_npz
from genmojo_core.trackers.solver import SolveRequest, TrackSolver
from genmojo_core.tracks.annotation import CONFIRMED, HUMAN, KEY, Annotation, Cells, Proposal
from genmojo_core.tracks.interpolate import placed
from genmojo_core.tracks.model import NONE, VISIBLE, PointTracks

NAMES = ("optical", "scene", "cotracker", "file")
_NEAR = 0.02  # of the picture's height: a track of a file this near a query at its frame is taken for it
_LINK_SECONDS = 0.02  # of process time per match between two frames
_LINKS_PER_FRAME = 12
_SCENE_FRAME_SECONDS = 0.15  # to test visibility in one frame of a scene

Progress = Callable[[float], None]
Cancelled = Callable[[], bool]


@dataclass(frozen=True)
class Queries:
    """N points to follow: t (N,) frame positions, xy (N, 2) source raster px, object (N,) mask ids (0: none)."""

    t: np.ndarray
    xy: np.ndarray
    object: np.ndarray

    @staticmethod
    def of(annotation: Annotation, tracks: list[int] | None = None) -> tuple[list[int], Queries]:
        """The first key of every track (or of some); tracks without a key are left out. Returns ids and queries."""
        asked = [info.id for info in annotation.active()] if tracks is None else tracks
        ids = [i for i in asked if len(annotation.keys(i))]
        t = np.array([annotation.keys(i)[0] for i in ids], np.int64)
        xy = np.array([annotation.track(i).xy[f] for i, f in zip(ids, t, strict=True)], np.float64).reshape(-1, 2)
        return ids, Queries(t, xy, np.array([annotation.tracks[i].object for i in ids], np.int64))


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
            rows = np.flatnonzero(queries.object == owner)
            cells = tuple(_keyed(queries, int(row), frames) for row in rows)
            request = SolveRequest(int(owner), clip.source_size, tuple(int(r) for r in rows), cells, None)
            found = solver.answer(request, cancelled=cancelled).found
            for row, (_, answer) in found.items():
                xy[row], state[row], conf[row] = answer.xy, answer.state, answer.conf
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
        """Tracks with occlusion flags, carried by the Gaussians that show at each query."""
        from genmojo_core.store import scene_hdf5
        from genmojo_core.trackers import scene as scene_tracker

        scene = scene_hdf5.read(self.path)
        if len(scene) != len(clip):
            raise GenmojoError("value", f"has {len(scene)} frames, the clip {len(clip)}", str(self.path),
                               "optimise this clip first")  # fmt: skip
        size = np.array(scene.cameras.size, np.float64)
        xy = np.clip(queries.xy * size / np.array(clip.source_size), 0.0, size)
        tracks = scene_tracker.track(scene, queries.t, xy, progress).resized(*clip.source_size)
        conf = np.where(tracks.state == VISIBLE, 0.7, 0.5).astype(np.float32)
        return PointTracks(tracks.xy, tracks.state, queries.object, clip.source_size, tracks.xyz, conf)


class FileSeeder:
    """Tracks somebody made before: TAP-Vid npz, CoTracker npz, our npz. Args: path: the file."""

    name, licence = "file", ""

    def __init__(self, path: str | Path) -> None:
        self.path = Path(path)

    def forecast(self, clip: Clip, queries: Queries) -> float:
        """A moment."""
        return 0.5

    def seed(
        self, clip: Clip, queries: Queries, progress: Progress | None = None, cancelled: Cancelled | None = None
    ) -> PointTracks:
        """For each query the track of the file that is nearest to it in its frame; none where none is near."""
        tracks = track_npz.read(self.path, clip.source_size).tracks
        if tracks.state.shape[1] != len(clip):
            raise GenmojoError("schema", f"has {tracks.state.shape[1]} frames, the clip {len(clip)}", str(self.path))
        tracks = placed(tracks.resized(*clip.source_size))
        frames = len(clip)
        xy = np.zeros((len(queries.t), frames, 2), np.float32)
        state, conf = np.zeros((len(xy), frames), np.uint8), np.zeros((len(xy), frames), np.float32)
        for row, (t, place) in enumerate(zip(queries.t, queries.xy, strict=True)):
            gap = np.linalg.norm(tracks.xy[:, t] - place, axis=1)
            gap = np.where(tracks.state[:, t] == NONE, np.inf, gap)
            best = int(np.argmin(gap)) if len(gap) else -1
            if best >= 0 and gap[best] <= _NEAR * clip.source_size[1]:
                xy[row], state[row] = np.nan_to_num(tracks.xy[best]), tracks.state[best]
                conf[row] = 0.5 if tracks.conf is None else tracks.conf[best]
        return PointTracks(xy, state, queries.object, clip.source_size, conf=conf)


def make(name: str, path: str | Path | None = None, **options: str) -> Seeder:
    """A seeder by name.

    Args:
        name: one of NAMES. path: the scene.h5 of "scene", the file of "file", the checkout of "cotracker".
        options: of "cotracker": checkpoint, a path; consent, "yes" for models from torch.hub.
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
    from genmojo_core.trackers.cotracker import CoTrackerSeeder

    checkpoint = Path(options["checkpoint"]) if options.get("checkpoint") else None
    return CoTrackerSeeder(Path(path), checkpoint, consent=options.get("consent") == "yes")


def proposals(tracks: PointTracks, ids: list[int], name: str) -> dict[int, Proposal]:
    """Tracks, row by row, as proposals for tracks of an annotation."""
    tracks = placed(tracks)
    conf = np.full(tracks.state.shape, 0.5, np.float32) if tracks.conf is None else tracks.conf
    return {track: Proposal(name, np.nan_to_num(tracks.xy[row]).astype(np.float32), tracks.state[row],
                            conf[row].astype(np.float32)) for row, track in enumerate(ids)}  # fmt: skip


def _keyed(queries: Queries, row: int, frames: int) -> Cells:
    """Cells that know the query only."""
    cells = Cells.empty(frames)
    t = int(queries.t[row])
    if not 0 <= t < frames:
        raise GenmojoError("value", f"a query asks at frame {t}, the clip has 0 to {frames - 1}", "queries")
    cells.xy[t], cells.state[t], cells.flags[t] = queries.xy[row], VISIBLE, KEY | CONFIRMED
    cells.source[t], cells.conf[t] = HUMAN, 1.0
    return cells
