"""Whether the clip's pictures are those that were annotated: checked in the background, told once, never in the way."""

from __future__ import annotations

import threading
from collections.abc import Sequence
from functools import partial

from PySide6.QtCore import QObject, QTimer, Signal
from PySide6.QtWidgets import QMessageBox, QWidget

from genmojo_core.clip import digests
from genmojo_core.errors import GenmojoError
from genmojo_studio import notify
from genmojo_studio.annotate.session import Session
from genmojo_studio.background import Tasks
from genmojo_studio.translate import fault, tr

_BATCH = 32  # frames after which digests are stored: what was begun goes on there the next time
_LATER_MS = 800  # the clip itself is read first
_SPANS = 8


class PictureWatch(QObject):
    """Gives every frame of a project a digest and compares those it has; `done` tells frames that differ."""

    done = Signal(object)  # list of frames
    _found = Signal(object)  # {frame: digest}

    def __init__(self, session: Session, parent: QObject) -> None:
        super().__init__(parent)
        self._s = session
        self.tasks, self._stop = Tasks(yields=True), threading.Event()
        self._now: dict[int, str] = {}
        self.box: QMessageBox | None = None
        self._found.connect(self._take)
        QTimer.singleShot(_LATER_MS, self, self.begin)

    def begin(self) -> None:
        """Read what is stored of every frame, undecoded, beside everything else."""
        if not self._stop.is_set():
            info = self._s.project.info
            self.tasks.run(partial(self._work, info.path, info.sha256), self._compare, self._failed)

    def close(self) -> None:
        """Stop soon; what was found is stored."""
        self._stop.set()
        self.tasks.close()
        if self.box is not None:
            self.box.close()

    def _work(self, path: str, known: Sequence[str]) -> bool:
        """On a thread. False if it was stopped."""
        held = {frame for frame, digest in enumerate(known) if digest}
        batch: dict[int, str] = {}
        for frame, digest in digests.of_frames(path, held):
            if self._stop.is_set():
                return False
            batch[frame] = digest
            if len(batch) >= _BATCH:
                self._found.emit(batch)
                batch = {}
        if self._stop.is_set():
            return False
        self._found.emit(batch)
        return True

    def _take(self, batch: dict[int, str]) -> None:
        """Keep what was found; frames without a digest get it."""
        if self._stop.is_set():
            return
        self._now |= batch
        known = self._s.project.info.sha256
        new = {frame: digest for frame, digest in batch.items() if frame < len(known) and not known[frame]}
        if new and not self._s.project.read_only:
            self._s.project.note_digests(new)

    def _compare(self, whole: bool) -> None:
        if not whole or self._stop.is_set():
            return
        known = self._s.project.info.sha256
        changed, _ = digests.differing(known, [self._now.get(frame, "") for frame in range(len(known))])
        if changed:
            self._warn(changed)
        self.done.emit(changed)

    def _warn(self, changed: list[int]) -> None:
        """One warning; nothing of the work is touched."""
        text = tr("{n} of {all} pictures are not those that were annotated: frames {frames}. Your work is all there. "
                  "Put the old pictures back, or look at these frames again.").format(
            n=len(changed), all=len(self._s.project.info.sha256), frames=spans(changed))  # fmt: skip
        self._s.said.emit(text)
        box = QMessageBox(QMessageBox.Icon.Warning, tr("Pictures were changed"), text, parent=self._window())
        go_on = box.addButton(tr("Go on"), QMessageBox.ButtonRole.RejectRole)
        box.setDefaultButton(go_on)
        if not self._s.project.read_only:
            right = box.addButton(tr("These are right now"), QMessageBox.ButtonRole.AcceptRole)
            right.setToolTip(tr("The project takes these pictures for its own and does not warn again."))
            right.clicked.connect(partial(self._accept, changed))
        self.box = box
        box.open()

    def _accept(self, changed: list[int], _checked: bool = False) -> None:
        """The pictures that are there now are the project's."""
        if not self._stop.is_set():
            self._s.project.note_digests({frame: self._now[frame] for frame in changed})

    def _failed(self, error: BaseException) -> None:
        if isinstance(error, GenmojoError):
            self._s.said.emit(fault(error))
        else:
            notify.tell(error, self._window())

    def _window(self) -> QWidget | None:
        """What a warning lies on."""
        place = self.parent()
        while place is not None and not isinstance(place, QWidget):
            place = place.parent()
        return place


def spans(frames: Sequence[int]) -> str:
    """ "3, 7 to 12": frames, rising, in words."""
    runs: list[list[int]] = []
    for frame in frames:
        if runs and frame == runs[-1][1] + 1:
            runs[-1][1] = frame
        else:
            runs.append([frame, frame])
    parts = [str(a) if a == b else tr("{first} to {last}").format(first=a, last=b) for a, b in runs[:_SPANS]]
    return ", ".join(parts) + (", …" if len(runs) > _SPANS else "")
