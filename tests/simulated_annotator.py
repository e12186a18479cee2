"""A person who annotates a clip with exact truth, at the level of data: sees every second frame, clicks with noise.

Rules (issue 5): the five most trackable points per object on the first frame; a visited frame is corrected where a
visible point is off by more than 3 px as seen, or its state is wrong; clicks have 1 px noise; a state is painted by one
stroke as far as it holds; Enter accepts the frame. Then the worst spots of the queue are visited. Every click, drag and
stroke counts. All pixels are those of a 1920 x 1080 picture.
"""

from __future__ import annotations

import time
from dataclasses import dataclass, replace
from pathlib import Path

import cv2
import numpy as np

from genmojo_core.clip import folders
from genmojo_core.clip.clip import Channel, Clip
from genmojo_core.store.npz import read_tracks
from genmojo_core.trackers.evidence import scene_of
from genmojo_core.trackers.seeding import OpticalSeeder, Queries, Seeder, proposals
from genmojo_core.trackers.solver import SHORT_SIDE, SolveRequest, TrackSolver
from genmojo_core.tracks import edit_tracks, keys
from genmojo_core.tracks.annotation import PROPOSED, TRACKER, Annotation, ObjectInfo
from genmojo_core.tracks.model import OCCLUDED, VISIBLE, PointTracks
from genmojo_core.tracks.suspicion import SUSPICIOUS, Spot, assess, queue

FULL = (1920, 1080)
OFF = 3.0
NOISE = 1.0


def full_hd(folder: Path, short_side: int = SHORT_SIDE) -> Clip:
    """A sample clip as it would be read from a 1920 x 1080 file, held at `short_side`."""
    clip = folders.read(folder, ignore=("depth", "cameras"))
    width, height = round(short_side * FULL[0] / FULL[1]), short_side
    frames = np.stack([_upscaled(frame, (width, height)) for frame in clip.frames])
    labels = np.stack([cv2.resize(m, (width, height), interpolation=cv2.INTER_NEAREST) for m in clip.masks.value])
    masks = Channel(labels, np.ones(labels.shape, bool), clip.masks.source)
    return replace(clip, frames=frames, masks=masks, source_size=FULL)


def truth_of(folder: Path) -> PointTracks:
    """Its true tracks, in pixels of 1920 x 1080."""
    return read_tracks(folder / "truth.npz", (480, 270)).resized(*FULL)


def most_trackable(clip: Clip, truth: PointTracks, object_id: int) -> np.ndarray:
    """Rows of an object's points seen in the first frame, those with the most texture around them first.

    So a person chooses, with the trackability meter (corner strength) on the screen.
    """
    rows = np.flatnonzero((truth.object == object_id) & truth.visible[:, 0])
    gray = cv2.cvtColor(clip.frames[0], cv2.COLOR_RGB2GRAY)
    strength = cv2.cornerMinEigenVal(gray, max(gray.shape[0] // 40, 3))
    places = truth.xy[rows, 0] * np.array(clip.size) / np.array(FULL)
    x, y = np.clip(places, 0, np.array(clip.size) - 1).astype(int).T
    return rows[np.argsort(-strength[y, x], kind="stable")]


def _upscaled(frame: np.ndarray, size: tuple[int, int]) -> np.ndarray:
    full = cv2.resize(frame, FULL, interpolation=cv2.INTER_CUBIC)
    return cv2.resize(full, size, interpolation=cv2.INTER_AREA)


@dataclass
class Report:
    """Per track: keys (n,), errors over visible frames; share of right states; seconds of the machine per key."""

    keys: np.ndarray
    strokes: np.ndarray
    errors: np.ndarray
    per_track: np.ndarray
    right_states: float
    solve_seconds: list[float]

    def line(self) -> str:
        """One line for people."""
        return (f"{len(self.keys)} tracks: keys median {np.median(self.keys):.1f} (of them strokes "
                f"{self.strokes.mean():.1f} on average), error median {np.median(self.errors):.2f} px, p90 "
                f"{np.quantile(self.errors, 0.9):.2f}, over 3 px {(self.errors > OFF).mean():.1%}, OA "
                f"{self.right_states:.1%}, solve {np.median(self.solve_seconds):.2f} s")  # fmt: skip


class Person:
    """Annotates one clip; `run` does everything and returns the Report."""

    def __init__(
        self, clip: Clip, truth: PointTracks, seeder: Seeder | None = None, seed: int = 0, points: int = 5
    ) -> None:
        self.rng = np.random.default_rng(seed)
        self.clip, self.truth = clip, truth
        self.annotation = Annotation(len(clip), FULL)
        self.solver = TrackSolver(clip)
        self.seeder: Seeder = seeder or OpticalSeeder(self.solver)
        self.row: dict[int, int] = {}  # track -> row of the truth
        self.keys: dict[int, int] = {}
        self.strokes: dict[int, int] = {}
        self.seconds: list[float] = []
        infos = [
            ObjectInfo(int(i), n, k + 1, "chosen")
            for k, (i, n) in enumerate(zip(clip.object_ids, clip.object_names, strict=True))
        ]
        edit_tracks.put_objects(self.annotation, infos).do(self.annotation)
        for info in infos:
            rows = most_trackable(clip, truth, info.id)[:points]
            for number, row in enumerate(rows):
                made = edit_tracks.add_track(self.annotation, info.id, number + 1, "simulated")
                made.do(self.annotation)
                self.row[made.track], self.keys[made.track], self.strokes[made.track] = int(row), 1, 0
                keys.set_key(self.annotation, made.track, 0, self._click(int(row), 0)).do(self.annotation)

    def run(self, stride: int = 2, share: float = 0.2) -> Report:
        """Seed, refine every `stride` frames, then visit the first `share` of the queue."""
        ids, queries = Queries.of(self.annotation)
        found = proposals(self.seeder.seed(self.clip, queries), ids, self.seeder.name)
        for track, proposal in found.items() if self.seeder.name in PROPOSED else ():
            self.annotation.propose(track, proposal)
        keys.accept(self.annotation, found, PROPOSED.get(self.seeder.name, TRACKER)).do(self.annotation)
        for t in range(stride, len(self.clip), stride):
            self.visit(t, list(self.row))
        for spot in self.worst(share):
            self.visit(spot.frame, [spot.track])
        return self.report()

    def worst(self, share: float) -> list[Spot]:
        """The first spots of the queue that are suspicious, at most this share of it."""
        evidence = {}
        for info in self.annotation.chosen_objects():
            evidence |= self.solver.evidence(SolveRequest.of(self.annotation, info.id))
        spots = queue(self.annotation, assess(self.annotation, scene_of(self.clip), evidence))
        return [s for s in spots[: int(np.ceil(share * len(spots)))] if s.score >= SUSPICIOUS]

    def visit(self, t: int, tracks: list[int]) -> None:
        """Look at points in a frame, correct what is wrong, accept it."""
        for track in tracks:
            row = self.row[track]
            cells = self.annotation.track(track)
            seen = bool(self.truth.visible[row, t])
            off = float(np.linalg.norm(cells.xy[t] - self.truth.xy[row, t]))
            if seen and off > OFF:
                self.keys[track] += 1
                keys.set_key(self.annotation, track, t, self._click(row, t), VISIBLE).do(self.annotation)
                self._solve(self.annotation.tracks[track].object, (track, t))
            elif (cells.state[t] == VISIBLE) != seen:
                self.keys[track] += 1
                self.strokes[track] += 1
                last = t
                while last + 1 < len(self.clip) and bool(self.truth.visible[row, last + 1]) == seen:
                    last += 1
                state = VISIBLE if seen else int(self.truth.state[row, t])
                keys.set_state(self.annotation, track, t, last, state or OCCLUDED).do(self.annotation)
        keys.confirm(self.annotation, tracks, t).do(self.annotation)

    def report(self) -> Report:
        """How good it is now."""
        errors, per_track, right = [], [], []
        for track, row in self.row.items():
            cells, seen = self.annotation.track(track), self.truth.visible[row]
            error = np.linalg.norm(cells.xy - self.truth.xy[row], axis=1)
            errors.append(error[seen])
            per_track.append(np.median(error[seen]))
            right.append(((cells.state == VISIBLE) == seen).mean())
        order = list(self.row)
        return Report(np.array([self.keys[i] for i in order]), np.array([self.strokes[i] for i in order]),
                      np.concatenate(errors), np.array(per_track), float(np.mean(right)), self.seconds)  # fmt: skip

    def _click(self, row: int, t: int) -> tuple[float, float]:
        x, y = self.truth.xy[row, t] + self.rng.normal(0.0, NOISE, 2)
        return float(x), float(y)

    def _solve(self, object_id: int, key: tuple[int, int]) -> None:
        began = time.process_time()
        answer = self.solver.answer(SolveRequest.of(self.annotation, object_id, key))
        self.seconds.append(time.process_time() - began)
        answer.edit(self.annotation).do(self.annotation)
