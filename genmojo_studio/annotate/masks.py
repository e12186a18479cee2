"""The masks of a session, as its edits say: cut out of what was drawn, kept, put on show, handed to runs."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from enum import Enum
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
from genmojo_studio.annotate.hand_masks import Drawn
from genmojo_studio.annotate.session import Session
from genmojo_studio.background import Tasks
from genmojo_studio.translate import fault, tr

SMALLEST = 2.0  # raster pixels: sides of a box that can be meant


class Purpose(Enum):
    """What a cut is for."""

    NEW = "new"  # an object of its own
    CORRECT = "correct"  # the selected object's mask, put right
    ANEW = "anew"  # another mask for the selected object


class Masks(QObject):
    """What is drawn waits in `Session.sketch`; `cut` makes an edit of it. `changed`: other masks are on show.

    Cutting out takes long, so it has a thread of its own; another one reads masks back and writes them for runs.
    """

    changed = Signal()
    cutting = Signal(float)  # 0..1, 1 when done
    busy_changed = Signal(str)  # what is going on, "" for nothing
    sketched = Signal(int)  # how many boxes and strokes wait

    def __init__(self, session: Session, parent: QObject | None = None) -> None:
        super().__init__(parent)
        self._session = session
        self.tasks, self._files = Tasks(), Tasks()
        self._taken: list[Prompt] = []  # taken back, newest last
        self.target: Callable[[], tuple[Purpose, int | None]] = lambda: (Purpose.NEW, None)  # and the object's id
        self._own: Clip | None = None  # as its files give it
        self.known = np.zeros(0, bool)  # (T,) frames for which the clip's files have masks
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

    def begin(self, clip: Clip, first: dict[int, Drawn], known: np.ndarray) -> None:
        """The clip has been read, with the masks of its files, which `known` (T,) frames have.

        `first` is as `hand_masks.load_first`.
        """
        self._own, self._first, self.known = clip, first, known
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

    def add_box(self, x0: float, y0: float, x1: float, y1: float) -> None:
        """A box around an object of the frame on show, in raster pixels; what lies outside the frame is left out."""
        width, height = self._session.annotation.size
        x0, x1, y0, y1 = max(x0, 0.0), min(x1, float(width)), max(y0, 0.0), min(y1, float(height))
        if x1 - x0 >= SMALLEST and y1 - y0 >= SMALLEST:
            self._add(hand_masks.box_prompt(self._session.frame, (x0, y0, x1, y1)))
        else:
            self._session.said.emit(tr("Draw inside the frame, not too small."))

    def add_stroke(self, points: np.ndarray, on: bool) -> None:
        """A stroke or a click (n, 2) in the frame on show, raster pixels; what lies outside the frame is left out."""
        inside = points[((points >= 0) & (points <= np.array(self._session.annotation.size))).all(axis=1)]
        if len(inside):
            self._add(hand_masks.stroke_prompt(self._session.frame, inside, on=on))
        else:
            self._session.said.emit(tr("Draw inside the frame, not too small."))

    def take_back(self) -> bool:
        """The box or stroke drawn last goes, until it is put back; False if there is none."""
        return self._move(self._session.sketch, self._taken)

    def put_back(self) -> bool:
        """The box or stroke taken back last is there again; False if there is none."""
        return self._move(self._taken, self._session.sketch)

    def cut(self) -> None:
        """Make a mask of what was drawn, in a thread: of a new object, or another one of an object that is there."""
        session, clip, prompts = self._session, self._session.clip, list(self._session.sketch)
        purpose, number = self.target()
        if clip is None or not prompts:
            session.said.emit(tr("The clip is still being read.") if clip is None else tr("Draw something first."))
            return
        old = self._mask_of(clip, number) if purpose == Purpose.CORRECT and number is not None else None

        def work() -> Drawn:
            return hand_masks.corrected(clip, old, prompts) if old else hand_masks.cut_out(clip, prompts)

        self._make(work, number, prompts)

    def follow(self, number: int) -> None:
        """Carry an object's mask on into frames for which the clip has none, in a thread."""
        clip = self._session.clip
        if clip is not None:
            old, known = self._mask_of(clip, number), self.known
            self._make(lambda: hand_masks.followed(clip, old, known), number, [])

    def _make(self, work: Callable[[], Drawn], number: int | None, prompts: list[Prompt]) -> None:
        """Make a mask of an object (None: a new one) in a thread; `prompts` are used up by it."""
        if self.tasks.busy or self._session.project.read_only:
            busy, closed = tr("Something is being cut out already."), tr("The project is read only.")
            self._session.said.emit(busy if self.tasks.busy else closed)
            return
        self.busy_changed.emit(tr("Cutting the object out of every frame …"))
        self.cutting.emit(0.0)

        def packed() -> tuple[Drawn, bytes]:
            drawn = work()
            return drawn, hand_masks.pack(drawn)

        self.tasks.run(packed, partial(self._cut_done, number, prompts), self._failed)

    def _add(self, prompt: Prompt) -> None:
        self._taken.clear()
        self._session.sketch.append(prompt)
        self._sketched()

    def _move(self, source: list[Prompt], target: list[Prompt]) -> bool:
        if source:
            target.append(source.pop())
            self._sketched()
            return True
        return False

    def _sketched(self) -> None:
        """Something was drawn or taken back."""
        count = len(self._session.sketch)
        said = tr("Drawn: {n}. Cut out makes a mask of it; undo takes the last one back.")
        self._session.said.emit(said.format(n=count))
        self.sketched.emit(count)
        self._session.shown.emit()

    def _mask_of(self, clip: Clip, number: int) -> Drawn:
        """The mask of an object as it stands."""
        info, ids = self._session.annotation.objects.get(number), clip.object_ids.tolist()
        if info is not None and info.mask in self._known:
            return self._known[info.mask]
        if number in ids:
            return Drawn(clip.object_mask(ids.index(number)))
        return Drawn(np.zeros(clip.frames.shape[:3], bool))

    def _cut_done(self, replaced: int | None, prompts: list[Prompt], result: tuple[Drawn, bytes]) -> None:
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
        session.sketch = [p for p in session.sketch if not any(p is used for used in prompts)]
        self._taken.clear()
        self.sketched.emit(len(session.sketch))
        self._known[mask] = drawn
        title = say("correct_mask" if replaced else "cut_out", name=info.name)
        edit = put_objects(annotation, [replace(info, mask=mask)], title)
        session.do(replace(edit, frame=prompts[0].frame if prompts else None))
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
