"""Step 4: every track with where its review stands; approve it, or return it with a reason, a run and a note."""

from __future__ import annotations

from PySide6.QtCore import Qt, Signal
from PySide6.QtWidgets import (
    QCheckBox,
    QComboBox,
    QHBoxLayout,
    QLabel,
    QLineEdit,
    QListWidget,
    QPushButton,
    QSplitter,
    QVBoxLayout,
    QWidget,
)

from genmojo_core.tracks import edit_tracks
from genmojo_core.tracks.annotation import REASONS
from genmojo_core.tracks.edits import set_meta
from genmojo_studio.annotate import verbs
from genmojo_studio.annotate.session import Session
from genmojo_studio.annotate.track_tree import TrackTree, review_name
from genmojo_studio.translate import told, tr


class ReviewPage(QWidget):
    """Decisions about tracks, by the person named."""

    merge_wanted = Signal()
    log_wanted = Signal()

    def __init__(self, session: Session, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self._session = session
        self.summary = QLabel(wordWrap=True)
        self.tree = TrackTree(session, ("review", "doubt"))
        self.person = QLineEdit(session.project.person, placeholderText=tr("your name"))
        self.approve_button, self.fix_button = QPushButton(tr("Approve")), QPushButton(tr("Needs a fix:"))
        self.reject_button = QPushButton(tr("Reject"))
        self.reject_button.setToolTip(tr("The track is given up; it stays in the project."))
        self.reason, self.run_label = QComboBox(), QLabel()
        self.note = QLineEdit(placeholderText=tr("what is wrong there"))
        self.consent = QCheckBox(tr("Time and effort may be exported"))
        self.merge_button, self.log_button = QPushButton(tr("Second annotator…")), QPushButton(tr("Log, statistics…"))
        self.history = QListWidget()
        self.history.setAccessibleName(tr("History of the track"))
        self.history.setWordWrap(True)
        self.history.setHorizontalScrollBarPolicy(Qt.ScrollBarPolicy.ScrollBarAlwaysOff)
        self._arrange()
        session.edited.connect(self.refresh)
        session.selected.connect(self.refresh)
        session.settings_changed.connect(self.refresh)
        self.refresh()

    def showEvent(self, event: object) -> None:
        """Made up to date when it is looked at."""
        self.refresh()

    def approve(self) -> None:
        """The active track is right."""
        track = self._session.track
        if track is not None:
            annotation = self._session.annotation
            step = verbs.attempt(self._session, lambda: edit_tracks.approve(annotation, track, self._who()))
            if step is not None:
                self._next_open()

    def reject(self) -> None:
        """The active track is given up; the note says why."""
        session, track = self._session, self._session.track
        if track is None:
            return
        note = self.note.text()[:400]
        step = verbs.attempt(session, lambda: edit_tracks.reject(session.annotation, track, self._who(), note))
        if step is not None:
            self.note.clear()
            self._next_open()

    def needs_fix(self, reason: int | None = None) -> None:
        """The active track goes back to its annotator; `reason` from 0, by default the one chosen."""
        session, track = self._session, self._session.track
        if track is None:
            return
        run = verbs.marked_run(session)
        which = REASONS[self.reason.currentIndex() if reason is None else reason]
        step = verbs.attempt(session, lambda: edit_tracks.needs_fix(session.annotation, track, which, run, self._who(),
                                                                    self.note.text()[:400]))  # fmt: skip
        if step is not None:
            session.run = (None, None)
            self.note.clear()
            session.said.emit(tr("Returned to {name}: {reason}").format(
                name=session.annotation.tracks[track].person or tr("its annotator"), reason=told(which)))  # fmt: skip
            self._next_open()

    def refresh(self, _touched: object = None) -> None:
        """Counts, the run concerned, the track's history."""
        if not self.isVisible():
            return
        session = self._session
        counts: dict[str, int] = {}
        for info in session.annotation.active():
            counts[info.review] = counts.get(info.review, 0) + 1
        parts = [f"{n} {review_name(name)}" for name, n in counts.items()]
        self.summary.setText(", ".join(parts) or tr("No tracks yet."))
        first, last = verbs.marked_run(session)
        self.run_label.setText(tr("frames {a} to {b}").format(a=first, b=last) if last > first else
                               tr("frame {a}; [ and ] mark more").format(a=first))  # fmt: skip
        self.consent.setChecked(session.annotation.meta.get("consent") == "yes")
        self.history.clear()
        rows = [r for r in session.project.history() if r.track is not None and r.track == session.track]
        for row in rows[-40:][::-1]:
            self.history.addItem(f"{told(row.title)}   {row.who}")

    def _who(self) -> str:
        return self.person.text().strip() or self._session.project.person

    def _next_open(self) -> None:
        """Go on to the next track without a decision."""
        session = self._session
        done = ("approved", "rejected", "needs_fix")
        waiting = [i for i in session.annotation.active() if i.review not in done]
        if waiting:
            session.select(waiting[0].object, waiting[0].number)

    def _arrange(self) -> None:
        for reason in REASONS:
            self.reason.addItem(told(reason))
        self.reason.setAccessibleName(tr("What is wrong"))
        self.approve_button.clicked.connect(self.approve)
        self.fix_button.clicked.connect(self._fix_clicked)
        self.reject_button.clicked.connect(self.reject)
        self.consent.clicked.connect(self._consent_clicked)
        self.merge_button.clicked.connect(self.merge_wanted)
        self.log_button.clicked.connect(self.log_wanted)
        self.person.editingFinished.connect(self._named)
        who, final, decide, together = QHBoxLayout(), QHBoxLayout(), QHBoxLayout(), QHBoxLayout()
        final.addWidget(self.approve_button, 2)
        final.addWidget(self.reject_button, 1)
        who.addWidget(QLabel(tr("Reviewer")))
        who.addWidget(self.person, 1)
        decide.addWidget(self.fix_button)
        decide.addWidget(self.reason, 1)
        together.addWidget(self.merge_button)
        together.addWidget(self.log_button)
        below = QWidget()
        column = QVBoxLayout(below)
        column.setContentsMargins(0, 2, 0, 0)
        column.setSpacing(4)
        column.addLayout(who)
        column.addLayout(final)
        column.addLayout(decide)
        column.addWidget(self.run_label)
        column.addWidget(self.note)
        column.addWidget(self.history, 1)
        column.addLayout(together)
        column.addWidget(self.consent)
        split = QSplitter(Qt.Orientation.Vertical)
        split.addWidget(self.tree)
        split.addWidget(below)
        split.setChildrenCollapsible(False)
        outer = QVBoxLayout(self)
        outer.setContentsMargins(8, 6, 8, 6)
        outer.addWidget(self.summary)
        outer.addWidget(split, 1)
        QWidget.setTabOrder(self.tree, self.person)

    def _fix_clicked(self) -> None:
        self.needs_fix()

    def _named(self) -> None:
        self._session.project.person = self._who()

    def _consent_clicked(self, on: bool) -> None:
        self._session.do(set_meta(self._session.annotation, "consent", "yes" if on else None))
        self.consent.setChecked(self._session.annotation.meta.get("consent") == "yes")  # read only: as it was
