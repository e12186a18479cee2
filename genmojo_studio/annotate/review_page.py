"""Step 4: every track with where its review stands; approve it, or return it with a reason, a run and a note."""

from __future__ import annotations

from collections.abc import Callable
from itertools import islice

from PySide6.QtCore import Qt, Signal
from PySide6.QtWidgets import (
    QCheckBox,
    QComboBox,
    QHBoxLayout,
    QLabel,
    QLineEdit,
    QListWidget,
    QPushButton,
    QSizePolicy,
    QSplitter,
    QVBoxLayout,
    QWidget,
)

from genmojo_core.tracks import edit_tracks
from genmojo_core.tracks.annotation import REASONS, TrackInfo
from genmojo_core.tracks.edits import Edit, set_meta
from genmojo_core.tracks.review import SETTLED, closed
from genmojo_studio.annotate import returned, verbs
from genmojo_studio.annotate.session import Session
from genmojo_studio.annotate.track_tree import TrackTree, review_name
from genmojo_studio.settings import Settings
from genmojo_studio.translate import told, tr

_SHOWN = 40  # edits of a track


class ReviewPage(QWidget):
    """Decisions about tracks, by the person named."""

    merge_wanted = Signal()
    log_wanted = Signal()

    def __init__(self, session: Session, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self._session = session
        self.summary = QLabel(wordWrap=True)
        self.tree = TrackTree(session, ("review", "doubt"))
        self.person = QLineEdit(session.project.person, placeholderText=tr("your name"), maxLength=80)
        self.person.setToolTip(tr("Stands beside what you do from now on; what was done before keeps its name."))
        self.ask = QLabel(tr("Under which name do you decide? It is asked once on this machine."), wordWrap=True)
        self.ask.setProperty("role", "warn")
        self.about = QLabel(wordWrap=True)
        self._notes: dict[int, str] = {}  # track -> what was typed about it and not said yet
        self._noted = session.track  # the track that the note on show is about
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
        session.edited.connect(self._list_history, Qt.ConnectionType.QueuedConnection)  # once the log has it, too
        session.selected.connect(self._other_track)
        session.selected.connect(self.refresh)
        session.settings_changed.connect(self.refresh)
        self.refresh()

    def showEvent(self, event: object) -> None:
        """Made up to date when it is looked at."""
        self.refresh()

    def approve(self) -> None:
        """The active track is right."""
        self._decide(lambda track, who, note: edit_tracks.approve(self._session.annotation, track, who, note),
                     tr("Approved: {point}."))  # fmt: skip

    def reject(self) -> None:
        """The active track is given up; the note says why."""
        self._decide(lambda track, who, note: edit_tracks.reject(self._session.annotation, track, who, note),
                     tr("Rejected: {point}."))  # fmt: skip

    def needs_fix(self, reason: int | None = None) -> None:
        """The active track goes back to its annotator; `reason` from 0, by default the one chosen."""
        session, run = self._session, verbs.marked_run(self._session)
        which = REASONS[self.reason.currentIndex() if reason is None else reason]
        done = self._decide(lambda track, who, note: edit_tracks.needs_fix(session.annotation, track, which, run, who,
                                                                           note),
                            tr("Returned to {name}: {reason}.").replace("{reason}", told(which)))  # fmt: skip
        if done:
            session.run = (None, None)

    def _decide(self, make: Callable[[int, str, str], Edit], sentence: str) -> bool:
        """One decision about the active track, under the name that stands here now; then on to the next one."""
        session, track = self._session, self._session.track
        if track is None:
            return False
        self._named()
        note, who = self.note.text().strip()[:400], session.project.person
        if verbs.attempt(session, lambda: make(track, who, note)) is None:
            return False
        self._notes.pop(track, None)
        self.note.clear()
        info = session.annotation.tracks[track]
        said = [sentence.format(point=session.title(info.object, info.number), name=info.person or tr("its annotator"))]
        if info.person == who and who:
            said.append(tr("It is your own track: let another person look at it too."))
        if closed(session.annotation):
            said.append(tr("Every track is decided: the clip is closed."))
        self._next_open()
        session.said.emit(" ".join(said))
        return True

    def refresh(self, _touched: object = None) -> None:
        """Counts, the run concerned, the track's history as far as it stands."""
        if not self.isVisible():
            return
        session = self._session
        self.summary.setText(_summary(session))
        self.ask.setVisible(not Settings().text("person"))
        info = session.annotation.tracks.get(session.track or 0)
        self.about.setText("" if info is None else about(session, info))
        first, last = verbs.marked_run(session)
        self.run_label.setText(tr("frames {a} to {b}").format(a=first, b=last) if last > first else
                               tr("frame {a}; [ and ] mark more").format(a=first))  # fmt: skip
        self.consent.setChecked(session.annotation.meta.get("consent") == "yes")
        self._list_history()

    def _list_history(self, _touched: object = None) -> None:
        """What was done to the track and stands."""
        session = self._session
        self.history.clear()
        mine = (row for row in session.project.log.standing() if row.track is not None and row.track == session.track)
        for row in islice(mine, _SHOWN):
            self.history.addItem(f"{told(row.title)}   {row.who}")

    def _next_open(self) -> None:
        """Go on to what was fixed, at the frames that were meant, or to the next track without a decision."""
        session = self._session
        waiting = [i for i in session.annotation.active() if i.review not in (*SETTLED, "needs_fix")]
        here = session.track or 0
        waiting.sort(key=lambda i: (i.review != "fixed", i.id <= here, i.id))
        if waiting:
            session.select_track(waiting[0].id)
            if waiting[0].review == "fixed":
                session.go(returned.run_of(session, waiting[0])[0], jump=True)

    def _other_track(self) -> None:
        """What was typed stays with the track that it was typed for."""
        if self._session.track != self._noted:
            self._notes[self._noted or 0] = self.note.text()
            self._noted = self._session.track
            self.note.setText(self._notes.pop(self._noted or 0, ""))

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
        column.addWidget(self.about)
        column.addWidget(self.ask)
        column.addLayout(who)
        column.addLayout(final)
        column.addLayout(decide)
        column.addWidget(self.run_label)
        column.addWidget(self.note)
        self.history.setMinimumHeight(48)
        self.history.setSizePolicy(QSizePolicy.Policy.Expanding, QSizePolicy.Policy.Ignored)  # takes what is left
        column.addWidget(self.history, 1)
        column.addLayout(together)
        column.addWidget(self.consent)
        split = QSplitter(Qt.Orientation.Vertical)
        split.addWidget(self.tree)
        split.addWidget(below)
        split.setStretchFactor(0, 1)
        split.setStretchFactor(1, 2)
        split.setChildrenCollapsible(False)
        outer = QVBoxLayout(self)
        outer.setContentsMargins(8, 6, 8, 6)
        outer.addWidget(self.summary)
        outer.addWidget(split, 1)
        QWidget.setTabOrder(self.tree, self.person)

    def _fix_clicked(self) -> None:
        self.needs_fix()

    def _named(self) -> None:
        """The name on show is that of what is done from now on, here and in the app's next sessions."""
        name, project, settings = self.person.text().strip(), self._session.project, Settings()
        if not name:
            self.person.setText(project.person)
        elif name != project.person or name != settings.text("person"):
            project.person = name
            settings.put("person", name)
            self._session.settings_changed.emit()

    def _consent_clicked(self, on: bool) -> None:
        self._session.do(set_meta(self._session.annotation, "consent", "yes" if on else None))
        self.consent.setChecked(self._session.annotation.meta.get("consent") == "yes")  # read only: as it was


def about(session: Session, info: TrackInfo) -> str:
    """A track for its reviewer: whose it is, how often it went back, what was said of it so far."""
    own = info.person == session.project.person and bool(info.person)
    lines = [tr("Annotated by {name}.").format(name=info.person or tr("nobody named"))]
    if own:
        lines[0] += " " + tr("It is your own track.")
    if info.review in SETTLED:
        verdict = tr("Approved by {who}.") if info.review == "approved" else tr("Rejected by {who}.")
        note = f" “{info.review_note}”" if info.review_note else ""
        lines.append(verdict.format(who=info.reviewer or tr("a reviewer")) + note)
    lines.append(returned.words(session, info))
    if info.note:
        lines.append(tr("The annotator's note: {note}").format(note=info.note))
    return "\n".join(filter(None, lines))


def _summary(session: Session) -> str:
    """How many tracks stand where, and whether the clip is closed."""
    counts: dict[str, int] = {}
    for info in session.annotation.active():
        counts[info.review] = counts.get(info.review, 0) + 1
    parts = ", ".join(f"{n} {review_name(name)}" for name, n in counts.items())
    if closed(session.annotation):
        return tr("The clip is closed: {parts}. Returning or unlocking a track opens it again.").format(parts=parts)
    return parts or tr("No tracks yet.")
