"""A project that another program has open: its edits appear here, and once it has left, writing can be taken over."""

from __future__ import annotations

from dataclasses import dataclass
from functools import partial
from pathlib import Path

from PySide6.QtCore import QObject, QTimer

from genmojo_core.errors import GenmojoError
from genmojo_core.store import project_db, project_news
from genmojo_core.store.project_db import Holder
from genmojo_core.store.project_news import News
from genmojo_studio import notify
from genmojo_studio.annotate.button_panel import StepBar
from genmojo_studio.annotate.session import Session
from genmojo_studio.background import Tasks
from genmojo_studio.translate import fault, tr

POLL_MS = 700
_LONGEST = 14  # letters of a name in the bar; the tool tip has all

_Stamp = tuple[tuple[int, int], ...]


@dataclass(frozen=True)
class _Look:
    """What was found: news, who writes, whether nobody does any more, and the file's stamp before it was read."""

    news: News | None
    holder: Holder | None
    free: bool
    stamp: _Stamp


class Following(QObject):
    """Looks at the file every now and then, on a thread, as long as the session is read only.

    `free`: nobody writes any more, so this program may.
    """

    def __init__(self, session: Session, bar: StepBar) -> None:
        super().__init__(session)
        self._s, self._bar = session, bar
        self.free = False
        self._stamp: _Stamp = ()
        self._tasks = Tasks()
        self._timer = QTimer(self, interval=POLL_MS)
        self._timer.timeout.connect(self.look)
        session.destroyed.connect(self._tasks.close)
        bar.take_over.setVisible(False)
        bar.take_over.clicked.connect(self.take_over)
        if session.project.read_only:
            self._timer.start()
            self.look()

    def look(self) -> None:
        """Ask the file, unless it is being asked."""
        project = self._s.project
        if not self._tasks.busy and self._timer.isActive():
            look = partial(_look, project.path, len(project.log), project.log.chain, self._stamp)
            self._tasks.run(look, self._seen, self._failed)

    def take_over(self) -> None:
        """Write from now on; said if another program was faster."""
        if not self.free:
            return
        try:
            taken = self._s.project.take_over()
        except GenmojoError as error:
            self._failed(error)
            return
        self.free = False
        if not taken:
            self._s.said.emit(tr("Another program was faster: the project stays read only here."))
            return
        self.stop()
        self._bar.show_reader(tr("saved"), free=False)
        self._bar.saved.setToolTip("")
        self._s.settings_changed.emit()
        self._s.selected.emit()
        self._s.said.emit(tr("You are writing this project now."))

    def stop(self) -> None:
        """Look no more."""
        self._timer.stop()

    def _seen(self, look: _Look) -> None:
        if not self._timer.isActive() or not self._s.project.read_only or self._s.closed:
            self.stop()
            return
        self._stamp = look.stamp
        try:
            if look.news is not None:
                self._s.project.follow(look.news)
        except GenmojoError as error:
            self._failed(error)
            return
        self.free = look.free
        words = [reader_words(look.holder, free=look.free, most=most) for most in (_LONGEST, 1000)]
        self._bar.show_reader(*words, free=look.free)

    def _failed(self, error: BaseException) -> None:
        """What cannot be followed is said once; what is shown stays."""
        self.stop()
        if isinstance(error, GenmojoError):
            self._s.said.emit(fault(error))
            self._bar.show_reader(tr("read only: not up to date"), free=False)
            self._bar.saved.setToolTip(fault(error))
        else:
            notify.tell(error)


def reader_words(holder: Holder | None, *, free: bool, most: int = _LONGEST) -> str:
    """Who writes the project that is read only here; names have `most` letters at most."""
    name = tr("another program") if holder is None else _short(holder.person or tr("somebody"), most)
    if free:
        return tr("read only: {name} has left").format(name=name)
    if holder is None:
        return tr("read only")
    words = tr("read only: {name} is editing ({pid}/{host})")
    return words.format(name=name, pid=holder.pid, host=_short(holder.host, most))


def _short(name: str, most: int) -> str:
    return name if len(name) <= most else name[: most - 1] + "…"


def _look(path: Path, known: int, chain: bytes, stamp: _Stamp) -> _Look:
    """On a thread: what is new, if anything was written since the file had this stamp, and who writes."""
    lock = project_db.take_lock(path, None)
    if lock is not None:
        lock.close()
    now = project_news.stamp(path)
    news = project_news.read(path, known, chain) if now != stamp else None
    return _Look(news, project_db.holder(path), lock is not None, now)
