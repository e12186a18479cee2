"""The masks of a session, as its edits say: cut out of what was drawn, kept, put on show, handed to runs."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from functools import partial
from pathlib import Path

import numpy as np
from PySide6.QtCore import QObject, Signal

from genmojo_core.clip.clip import Clip
from genmojo_core.errors import GenmojoError
from genmojo_core.estimate.masks import Prompt
from genmojo_core.sentences import say
from genmojo_core.tracks.annotation import ObjectInfo, Touched
from genmojo_core.tracks.edit_tracks import put_objects
from genmojo_studio import notify
from genmojo_studio.annotate import hand_masks
from genmojo_studio.annotate.canvas import Tool
from genmojo_studio.annotate.hand_masks import Drawn
from genmojo_studio.annotate.session import Session
from genmojo_studio.background import Tasks
from genmojo_studio.translate import fault, tr


class Masks(QObject):
    """What is drawn waits in `prompts`; `cut` makes an edit of it. `changed` tells whenever other masks are on show.

    Cutting out takes long, so it has a thread of its own; another one reads masks back and writes them for runs.
    """

    changed = Signal()
    cutting = Signal(float)  # 0..1, 1 when done
    busy_changed = Signal(str)  # what is going on, "" for nothing
    tool_changed = Signal(object)  # Tool or None

    def __init__(self, session: Session, parent: QObject | None = None) -> None:
        super().__init__(parent)
        self._session = session
        self.tasks, self._files = Tasks(), Tasks()
        self.prompts: list[Prompt] = []
        self.replaces: Callable[[], int | None] = lambda: (
            None
        )  # the object whose mask a cut stands for; None: a new one
        self._own: Clip | None = None  # as its files give it
        self._first: dict[int, Drawn] = {}  # of a project older than edits of masks
        self._known: dict[int, Drawn] = {}  # by number: those on show and the newest
        self._wanted: dict[int, int] | None = None  # object id -> number, on show or on the way
        self._closed = False
        session.edited.connect(self._edited)

    def close(self) -> None:
        """Drop what is going on."""
        self._closed = True
        self.tasks.close()
        self._files.close()

    def begin(self, clip: Clip, first: dict[int, Drawn]) -> None:
        """The clip has been read, with the masks of its files; `first` as `hand_masks.load_first`."""
        self._own, self._first = clip, first
        self._show()

    @property
    def path(self) -> Path:
        """Where the masks are written for runs, as long as any is drawn."""
        return self._session.project.path.with_suffix(hand_masks.SUFFIX)

    @property
    def busy(self) -> bool:
        """Whether masks are being cut out, read or written."""
        return self.tasks.busy or self._files.busy

    # ---- drawing

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

        def work() -> tuple[Drawn, bytes]:
            drawn = hand_masks.cut_out(clip, prompts)
            return drawn, hand_masks.pack(drawn)

        self.tasks.run(work, done, self._failed)

    def _cut_done(self, replaced: int | None, result: tuple[Drawn, bytes]) -> None:
        session, clip = self._session, self._session.clip
        if self._closed or clip is None:
            return
        self.cutting.emit(1.0)
        self.busy_changed.emit("")
        drawn, packed = result
        annotation = session.annotation
        number = replaced or max([0, *annotation.objects, *clip.object_ids.tolist()]) + 1
        info = annotation.objects.get(number) or ObjectInfo(number, tr("object {n}").format(n=number))
        mask = len(session.project.log) + 1  # the edit's own number: no other mask ever has it
        try:
            hand_masks.keep(session.project, mask, packed)
        except GenmojoError as error:
            session.said.emit(fault(error))
            return
        self._known[mask] = drawn
        edit = put_objects(annotation, [replace(info, mask=mask)], say("cut_out", name=info.name))
        session.do(replace(edit, frame=drawn.frames[0]))
        session.select(number, 1)

    # ---- showing what the edits say

    def _edited(self, touched: Touched) -> None:
        if touched.objects:
            self._show()

    def _show(self) -> None:
        """Bring the masks that the edits name onto the screen, if others are there."""
        session, own = self._session, self._own
        objects = session.annotation.objects
        wanted = {o.id: o.mask for o in objects.values() if o.mask or o.id in self._first}
        if own is None or wanted == self._wanted:
            return
        self._wanted = wanted
        project, known, first = session.project, dict(self._known), self._first
        names = {i: objects[i].name for i in wanted}

        def work() -> tuple[Clip, dict[int, Drawn]]:
            drawn = {}
            for i, mask in sorted(wanted.items(), key=lambda pair: pair[1]):  # the newest lies on top
                drawn[i] = (known.get(mask) or hand_masks.load(project, mask)) if mask else first[i]
            return hand_masks.with_drawn(own, drawn, names), drawn

        self._files.run(work, partial(self._shown, wanted), partial(self._unreadable, own))

    def _shown(self, wanted: dict[int, int], result: tuple[Clip, dict[int, Drawn]]) -> None:
        if self._closed or wanted != self._wanted:
            return  # others are on the way
        session = self._session
        session.clip, drawn = result
        session.hand_masks = {i: one.mask for i, one in drawn.items()}
        self._known = {wanted[i]: one for i, one in drawn.items()}
        self.changed.emit()
        self._publish()

    def _unreadable(self, own: Clip, error: BaseException) -> None:
        """A drawn mask cannot be read: the clip's own stand, and nothing is handed to runs."""
        self._failed(error)
        if not self._closed:
            self._session.clip, self._session.hand_masks = own, {}
            self.changed.emit()

    def _publish(self) -> None:
        """Runs of this clip, and everything that shows it, take the masks as they stand now."""
        clip, project, path = self._session.clip, self._session.project, self.path
        if clip is None or project.read_only:
            return
        if self._wanted:
            self._files.run(lambda: hand_masks.publish(clip, project.path), self._published, self._failed)
        elif path.exists() or self._session.state.masks_path == path:
            self._files.run(lambda: hand_masks.withdraw(project.path), self._published, self._failed)

    def _published(self, path: Path | None) -> None:
        if not self._closed:
            self._session.state.set(clip=self._session.clip, masks_path=path)

    def _failed(self, error: BaseException) -> None:
        if self._closed:
            return
        self.busy_changed.emit("")
        self.cutting.emit(1.0)
        if isinstance(error, GenmojoError):
            self._session.said.emit(fault(error))
        else:
            notify.tell(error)
