"""A scene scored beside its run, with the clock held: accuracy at a few moments, against truth where a clip has it."""

from __future__ import annotations

import math
from dataclasses import replace
from pathlib import Path

import numpy as np

from genmojo_core.clip import folders, resize
from genmojo_core.clip.clip import Clip
from genmojo_core.config import MEASURED_SIDE
from genmojo_core.measure import truth
from genmojo_core.measure.reconstruction import reconstruction
from genmojo_core.optimise.run import Run
from genmojo_core.store.scene_file import BakedScene

FIRST_MOMENT = 20.0  # seconds of the run; each further moment comes after twice the time
NOVEL = {"30": ("0_30", "0_-30", "30_0", "-30_0"), "90": ("0_90", "0_-90"), "180": ("0_180",)}


class Scorer:
    """Scores scenes of one clip: `psnr`, `psnr_full`, `ssim`, `instance_iou`, and where truth lies beside the clip
    `ate`, `mte`, `oa` and `novel_psnr`, `novel_iou` (METHOD.md section 8).

    Args:
        clip_path, frames: as the clip of the run was read; it is read again at the size everything is measured at.
        completed: that clip; its masks count where none lie on disk (they grew from boxes).
    """

    def __init__(
        self, clip_path: str, frames: tuple[int, int | None] | None = None, completed: Clip | None = None
    ) -> None:
        self.path, self.frames, self.completed = clip_path, frames, completed
        self.truth = truth.find_truth(clip_path)
        self._clip: Clip | None = None
        self._next = FIRST_MOMENT

    def watch(self, run: Run) -> None:
        """Between two events: if a moment has come, add a scored point to the run's curve. Its clock stands still."""
        if run.clock.this_run() < self._next or not run.progress.curve:
            return
        run.clock.hold()
        run.add_point(**self.figures(run.bake()))
        run.clock.go_on()
        while self._next <= run.clock.this_run():
            self._next *= 2

    def figures(self, scene: BakedScene, unseen: bool = True) -> dict[str, float]:
        """All figures of a scene that can be measured, unseen views (which take longest) only if `unseen`.

        Raises GenmojoError as reading the clip and its truth.
        """
        clip = self.measured()
        found: dict[str, float] = dict(reconstruction(scene, clip))
        if self.truth is not None:
            found |= {k: v for k, v in truth.track_scores(scene, clip, self.truth).items() if isinstance(v, float)}
            found |= novel_figures(scene, clip, self.truth) if unseen else {}
        return {key: float(value) for key, value in found.items() if math.isfinite(value)}

    def measured(self) -> Clip:
        """The clip at the size to measure at. Raises GenmojoError as reading it."""
        if self._clip is None:
            clip = folders.read(self.path, frames=self.frames, short_side=MEASURED_SIDE)
            self._clip = clip if clip.masks is not None or self.completed is None else _masked(clip, self.completed)
        return self._clip


def _masked(clip: Clip, completed: Clip) -> Clip:
    """A clip with the masks of the same frames at another size."""
    if completed.masks is None:
        return clip
    labels = np.stack([resize.nearest_labels(frame, clip.size) for frame in completed.masks.value])
    valid = np.stack([resize.nearest(frame, clip.size) for frame in completed.masks.valid])
    return clip.with_channels(masks=replace(completed.masks, value=labels, valid=valid),
                              object_ids=completed.object_ids, object_names=completed.object_names)  # fmt: skip


def novel_figures(scene: BakedScene, clip: Clip, truth_path: Path) -> dict[str, float]:
    """Means over unseen views, all together and in three groups of angles; {} if the truth has none."""
    found = truth.novel_scores(scene, clip, truth_path)
    views = found.get("novel", {})
    if not views:
        return {}
    figures = {"novel_iou": found["novel_iou"], "novel_psnr": found["novel_psnr_inside"]}
    for name, members in NOVEL.items():
        there = [views[m] for m in members if m in views]
        for key in ("iou", "psnr_inside", "psnr_union"):
            if there:
                figures[f"{key}_{name}"] = float(np.mean([v[key] for v in there]))
    return figures
