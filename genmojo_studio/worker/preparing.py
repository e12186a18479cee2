"""From a request to a run: read the clip, estimate what it lacks, decide the effects, compile, build. Loads torch."""

from __future__ import annotations

import argparse
import importlib
import threading
from collections.abc import Callable, Iterator
from dataclasses import dataclass, field, replace
from typing import Protocol

import numpy as np

from genmojo_core import events
from genmojo_core.cli.models import models_of
from genmojo_core.clip import folders, mask_file
from genmojo_core.clip.clip import Clip
from genmojo_core.config import RunConfig, preset
from genmojo_core.effects import decide
from genmojo_core.effects.plan import EffectPlan
from genmojo_core.errors import GenmojoError
from genmojo_core.estimate.complete import complete
from genmojo_core.estimate.masks import Box
from genmojo_core.estimate.models import Models
from genmojo_core.sentences import say
from genmojo_core.store import annotated_tracks
from genmojo_studio.view3d.snapshot import SnapshotObject
from genmojo_studio.worker.preview_codec import FrameArrays, Setting
from genmojo_studio.worker.protocol import RunRequest
from genmojo_studio.worker.session import Held

COMPILE_SECONDS = 300.0  # a first compile may keep the whole process busy so long
LOAD_SECONDS = 120.0  # as may loading torch from a slow disk
_TARGET_FRAMES = 5  # frames whose Gaussians say what views turn about

Announce = Callable[[str, str, float], None]  # phase, note for people, seconds it may be silent


class Seen(Protocol):
    """A prior in a run: `genmojo_core.optimise.unseen.UnseenViews`."""

    seen: list[tuple[float, float, int]]


class StopAsked(Exception):  # noqa: N818 - no fault
    """The user stopped the run before there was a scene."""


def prepare(request: RunRequest, announce: Announce, stopped: Callable[[], bool]) -> tuple[Clip, EffectPlan, RunConfig]:
    """The completed clip, its effects and the configuration.

    Raises GenmojoError for what is wrong with the request or the clip, StopAsked.
    """
    config = preset(request.preset, **request.changes)
    announce("reading", say("reading"), 60.0)
    with annotated_tracks.as_npz(request.tracks or None, needed=False) as tracks:
        clip = folders.read(request.clip, frames=request.frames, short_side=config.short_side, ignore=request.ignore,
                            pixel_aspect=request.pixel_aspect, tracks=tracks)  # fmt: skip
    clip = mask_file.with_masks(clip, request.masks) if request.masks else clip

    def tell(stage: str, share: float) -> None:
        if stopped():
            raise StopAsked
        announce("estimating", say("estimating", stage=stage, percent=100 * share), 0.0)

    clip = complete(clip, boxes=_boxes(request), progress=tell, models=_models(request))
    return clip, decide.plan(clip, config, request.effects), config


def load_and_compile(config: RunConfig, announce: Announce) -> threading.Thread:
    """Load torch and compile the CPU kernels on a thread of their own, while the clip is read."""
    thread = threading.Thread(target=_load, args=(config, announce), name="genmojo-load", daemon=True)
    thread.start()
    return thread


def build(clip: Clip, plan: EffectPlan, config: RunConfig, request: RunRequest) -> WatchedRun:
    """The run, ready to be driven."""
    return WatchedRun(clip, plan, config, request)


class Directions:
    """The views that have been supervised so far, each direction once (to a degree), in the order they came."""

    def __init__(self) -> None:
        self._known: dict[tuple[float, float], tuple[float, float, float]] = {}
        self._told = 0

    def rows(self, unseen: Seen | None, frames: int) -> np.ndarray:  # (M, 3) float32
        """Rows elevation, azimuth, frame: the clip's frames, then what a prior has judged."""
        seen = [] if unseen is None else unseen.seen
        for elevation, azimuth, frame in seen[self._told :]:
            self._known.setdefault((round(elevation), round(azimuth)), (elevation, azimuth, float(frame)))
        self._told = len(seen)
        own = [(0.0, 0.0, float(t)) for t in range(frames)]
        return np.array([*own, *self._known.values()], np.float32)


@dataclass
class WatchedRun:
    """A `genmojo_core.optimise.run.Run` with what a view needs to know (see session.Optimisation)."""

    clip: Clip
    plan: EffectPlan
    config: RunConfig
    request: RunRequest
    _setting: Setting | None = field(default=None, init=False)
    _directions: Directions = field(default_factory=lambda: Directions(), init=False)

    def __post_init__(self) -> None:
        from genmojo_core.optimise.run import Run  # torch

        self.run = Run(self.clip, self.plan, self.config, self.request.run_dir, self.request.resume)
        self.clock: Held = self.run.clock
        self.reference = 0

    @property
    def steps_done(self) -> int:
        """Steps since the first start, over resumes."""
        return self.run.progress.step

    def __iter__(self) -> Iterator[events.Event]:
        """The run's events."""
        for event in self.run:
            if isinstance(event, events.Preview) and not event.step:
                self.reference, self._setting = self.run.reference, None  # the scene was built anew
            yield event

    def stop(self) -> None:
        """End after the present step."""
        self.run.stop()

    def change(self, name: str, value: float) -> events.ParameterChanged:
        """Set a parameter from the next step on."""
        return self.run.change(name, value)

    def checkpoint(self) -> events.Checkpointed | None:
        """Write a checkpoint now."""
        return self.run.checkpoint()

    def live(self, t: int) -> FrameArrays:
        """The Gaussians of frame t."""
        return self.run.live(t)

    def write_scene(self, path: str, told: Callable[[str], None]) -> None:
        """Bake now; write on a thread, which the end of the program waits for."""
        from genmojo_core.store import scene_hdf5

        scene = self.run.bake()

        def write() -> None:
            try:
                scene_hdf5.write(scene, path)
            except GenmojoError as error:
                told(error.sentence())
            else:
                told("")

        threading.Thread(target=write, name="genmojo-write").start()

    def setting(self) -> Setting:
        """Objects with the colours the scene file will give them, cameras of the source, what views turn about."""
        if self._setting is None:
            from genmojo_core.optimise.bake import PALETTE  # torch

            scene, clip = self.run.scene, self.clip
            objects = [SnapshotObject(o.id, o.name, PALETTE[i % len(PALETTE)]) for i, o in enumerate(scene.objects)]
            if scene.background is not None:
                objects.append(SnapshotObject(0, "background", (0.5, 0.5, 0.5), True))
            self._setting = Setting(len(clip), tuple(objects), self.run.cameras().resized(*clip.source_size),
                                    np.asarray(clip.world_up, float), self._target())  # fmt: skip
        return replace(self._setting, supervised=self._directions.rows(self.run.unseen, len(self.clip)))

    def _target(self) -> np.ndarray:
        """Median of the objects' Gaussians over some frames."""
        points = []
        for t in np.unique(np.linspace(0, len(self.clip) - 1, _TARGET_FRAMES).astype(int)):
            now = self.run.live(int(t))
            points.append(now.means[now.object_id != 0])
        return np.median(np.concatenate(points), axis=0).astype(np.float64)


def _load(config: RunConfig, announce: Announce) -> None:
    """torch, the run's modules, the kernels."""
    announce("loading", say("loading"), LOAD_SECONDS)
    importlib.import_module("genmojo_core.optimise.run")
    if config.device.startswith("cuda"):
        return
    backend = importlib.import_module("genmojo_core.render.backend")
    backend.warm_up(lambda sentence: announce("compiling", sentence, COMPILE_SECONDS)).join()
    announce("loaded", "", 0.0)


def _boxes(request: RunRequest) -> list[Box]:
    """The boxes given, one object each, counted in the frames that are read."""
    first = request.frames[0] if request.frames else 0
    return [Box(int(frame) - first, x0, y0, x1, y1, i + 1) for i, (frame, x0, y0, x1, y1) in enumerate(request.boxes)]


def _models(request: RunRequest) -> Models | None:
    """External models named by the command line's option names."""
    names = ("depth_model", "depth_file", "mask_model", "detector", "find")
    return models_of(argparse.Namespace(**{name: request.models.get(name) for name in names}))
