"""Work in the background of a session: reading the clip, candidates, masks by hand, seeds, solving, suspicion."""

from __future__ import annotations

from collections.abc import Callable
from functools import partial
from pathlib import Path

import numpy as np
from PySide6.QtCore import QObject, QTimer, Signal

from genmojo_core.clip import folders
from genmojo_core.clip.clip import Clip
from genmojo_core.errors import GenmojoError
from genmojo_core.estimate.masks import Prompt
from genmojo_core.sentences import say
from genmojo_core.trackers.solver import SHORT_SIDE
from genmojo_core.tracks.annotation import ObjectInfo
from genmojo_core.tracks.edit_tracks import put_objects
from genmojo_studio import notify
from genmojo_studio.annotate import hand_masks, tracking
from genmojo_studio.annotate.candidates import Figures, figures
from genmojo_studio.annotate.canvas import Tool
from genmojo_studio.annotate.session import Session
from genmojo_studio.background import Tasks
from genmojo_studio.translate import tr


class Work(QObject):
    """Owns the threads of one session; results arrive on the UI thread, late ones are dropped."""

    clip_ready = Signal()
    figures_ready = Signal(object)  # {object id: Figures}
    masks_changed = Signal()
    cutting = Signal(float)  # 0..1, 1 when done
    spots_ready = Signal(object)  # list of Spot
    busy_changed = Signal(str)  # what is going on, "" for nothing
    tool_changed = Signal(object)  # Tool or None

    def __init__(self, session: Session, parent: QObject | None = None) -> None:
        super().__init__(parent)
        self._session = session
        self.tasks = Tasks()
        self.tracker = tracking.Tracking(session, self)
        self.tracker.spots_ready.connect(self.spots_ready)
        self.tracker.busy_changed.connect(self.busy_changed)
        self.prompts: list[Prompt] = []
        self._own_masks: dict[int, np.ndarray] = {}
        self.replaces: Callable[[], int | None] = lambda: (
            None
        )  # the object whose mask a cut stands for; None: a new one
        self._closed = False
        QTimer.singleShot(0, self._read_clip)

    def close(self) -> None:
        """Drop what is going on."""
        self._closed = True
        self.tracker.close()
        self.tasks.close()

    # ---- masks by hand

    def use_tool(self, tool: Tool | None) -> None:
        """Draw with a tool on the canvas; None goes back to points and forgets what was drawn."""
        if tool is None:
            self.prompts = []
        self.tool_changed.emit(tool)

    def add_box(self, x0: float, y0: float, x1: float, y1: float) -> None:
        """A box around an object of the frame on show."""
        if x1 - x0 >= 2 and y1 - y0 >= 2:
            self.prompts.append(hand_masks.box_prompt(self._session.frame, (x0, y0, x1, y1)))
            self.cut()

    def add_stroke(self, points: np.ndarray, on: bool) -> None:
        """A stroke or a click in the frame on show; `cut` uses it."""
        self.prompts.append(hand_masks.stroke_prompt(self._session.frame, points, on=on))
        self._session.said.emit(tr("{n} strokes; press Cut out.").format(n=len(self.prompts)))

    def cut(self) -> None:
        """Make an object of what was drawn, in a thread."""
        clip, prompts = self._session.clip, list(self.prompts)
        if clip is None or not prompts:
            reading = tr("The clip is still being read.")
            self._session.said.emit(reading if clip is None else tr("Draw something first."))
            return
        self.prompts = []
        self.busy_changed.emit(tr("Cutting the object out of every frame …"))
        self.cutting.emit(0.0)
        done = partial(self._cut_done, self.replaces())
        self.tasks.run(lambda: hand_masks.cut_out(clip, prompts), done, self._failed)

    def _cut_done(self, replaced: int | None, mask: np.ndarray) -> None:
        session, clip = self._session, self._session.clip
        if self._closed or clip is None:
            return
        self.cutting.emit(1.0)
        self.busy_changed.emit("")
        number = replaced or max([0, *session.annotation.objects, *clip.object_ids.tolist()]) + 1
        known = session.annotation.objects.get(number)
        name = known.name if known else tr("object {n}").format(n=number)
        self._own_masks[number] = mask
        if not session.project.read_only:
            hand_masks.save(session.project, self._own_masks)
        self._add_mask(number, name, mask)
        self._publish()
        made = known or ObjectInfo(number, name)
        session.do(put_objects(session.annotation, [made], say("cut_out", name=name)))
        session.select(number, 1)
        self._count()

    def _add_mask(self, number: int, name: str, mask: np.ndarray) -> None:
        if self._session.clip is not None:
            self._session.clip = hand_masks.with_object(self._session.clip, number, name, mask)
            self._session.hand_masks[number] = mask
            self.masks_changed.emit()

    def _publish(self) -> None:
        """Runs of this clip, and everything that shows it, take the masks as they stand now."""
        clip, project = self._session.clip, self._session.project
        if clip is not None and not project.read_only:
            self.tasks.run(lambda: hand_masks.publish(clip, project.path), self._published, self._failed)

    def _published(self, path: Path) -> None:
        if not self._closed:
            self._session.state.set(clip=self._session.clip, masks_path=path)

    # ---- clip and candidates

    def _read_clip(self) -> None:
        if self._closed:
            return
        state, path = self._session.state, Path(self._session.project.info.path)
        if state.clip is not None and state.clip_path == path and len(state.clip) == self._session.annotation.frames:
            self._clip_read(state.clip)
            return
        self.busy_changed.emit(tr("Reading the clip …"))

        def read() -> Clip:
            return folders.read(path, short_side=SHORT_SIDE, ignore=folders.CHANNELS)

        self.tasks.run(read, self._clip_read, self._failed)

    def _clip_read(self, clip: Clip) -> None:
        if self._closed:
            return
        self.busy_changed.emit("")
        session = self._session
        session.clip = clip
        self._own_masks = hand_masks.load(session.project)
        for number, mask in self._own_masks.items():
            info = session.annotation.objects.get(number)
            self._add_mask(number, info.name if info else "", mask)
        if self._own_masks:
            self._publish()
        names = clip.object_names or ("",) * clip.objects
        new = [
            ObjectInfo(int(i), name or tr("object {n}").format(n=int(i)))
            for i, name in zip(clip.object_ids, names, strict=True)
            if int(i) not in session.annotation.objects
        ]
        if new and not session.project.read_only:
            session.do(put_objects(session.annotation, new, say("candidates")))
        self.clip_ready.emit()
        self._count()
        self.tracker.look_again()

    def _count(self) -> None:
        clip = self._session.clip
        if clip is None or clip.masks is None:
            return

        def work() -> dict[int, Figures]:
            return {int(i): figures(clip.masks.value, k + 1) for k, i in enumerate(clip.object_ids)}  # type: ignore[union-attr]

        self.tasks.run(work, self.figures_ready.emit, self._failed)

    def _failed(self, error: BaseException) -> None:
        if self._closed:
            return
        self.busy_changed.emit("")
        self.cutting.emit(1.0)
        if isinstance(error, GenmojoError):
            self._session.said.emit(str(error))
        else:
            notify.tell(error)
