"""Tracks that a reviewer sent back: in words, as spots at the head of the queue, and on show above step 3's page."""

from __future__ import annotations

from PySide6.QtCore import QRectF, Signal
from PySide6.QtGui import QColor, QPainter
from PySide6.QtWidgets import QFrame, QHBoxLayout, QLabel, QPushButton, QWidget

from genmojo_core.tracks.annotation import TrackInfo
from genmojo_core.tracks.review import returned
from genmojo_core.tracks.suspicion import Spot
from genmojo_studio.annotate.session import Session
from genmojo_studio.translate import told, tr

_TINT = (214, 84, 150)
_NAMED = 4  # points that are named; of the others the number is told


def tint(alpha: int) -> QColor:
    """The colour of what came back, 0 (nothing) to 255."""
    return QColor(*_TINT, alpha)


def is_mine(session: Session, info: TrackInfo) -> bool:
    """Whether a track is this person's, or nobody's."""
    return info.person in ("", session.project.person)


def run_of(session: Session, info: TrackInfo) -> tuple[int, int]:
    """First and last frame that a reviewer means."""
    last = session.annotation.frames - 1
    first, end = info.run or (0, last)
    return min(first, last), min(end, last)


def pins(session: Session) -> list[Spot]:
    """What came back and is not fixed yet, this person's own tracks first; for a reviewer what was fixed since."""
    infos = session.annotation.active()
    chosen: list[tuple[TrackInfo, tuple[str, ...]]]
    if session.reviewing:
        chosen = [(i, (tr("fixed: {said}").format(said=_said(i)),)) for i in infos if i.review == "fixed"]
    else:
        chosen = [(i, _for_annotator(session, i)) for i in infos if i.review == "needs_fix"]
    chosen.sort(key=lambda c: (not (session.reviewing or is_mine(session, c[0])), session.place_of(c[0].object),
                               c[0].object, c[0].number))  # fmt: skip
    runs = [run_of(session, info) for info, _ in chosen]
    return [Spot(info.id, *run, run[0], 1.0, why) for (info, why), run in zip(chosen, runs, strict=True)]


def words(session: Session, info: TrackInfo) -> str:
    """What a reviewer said of a track that came back, in a sentence; "" for any other track."""
    if info.review not in ("needs_fix", "fixed") or not info.reason:
        return ""
    first, last = run_of(session, info)
    place = tr("frame {a}") if first == last else tr("frames {a} to {b}")
    said = tr("Sent back by {who}, round {n}: {reason}, {place}.").format(
        who=info.reviewer or tr("a reviewer"), n=info.rounds, reason=told(info.reason),
        place=place.format(a=first, b=last))  # fmt: skip
    return f"{said} “{info.review_note}”" if info.review_note else said


def summary(session: Session) -> str:
    """How many tracks came back and whose they are; "" if none did."""
    infos = returned(session.annotation)
    if not infos:
        return ""
    count = tr("A track came back from the review.") if len(infos) == 1 else tr(
        "{n} tracks came back from the review.").format(n=len(infos))  # fmt: skip
    lines = [f"{count} {tr('N goes there first.')}"]
    people = sorted({i.person for i in infos if not is_mine(session, i)})
    groups = [
        ("", [i for i in infos if is_mine(session, i)]),
        *((p, [i for i in infos if i.person == p]) for p in people),
    ]
    for person, theirs in groups:
        if theirs:
            names = ", ".join(session.title(i.object, i.number) for i in theirs[:_NAMED])
            more = tr(" and {n} more").format(n=len(theirs) - _NAMED) if len(theirs) > _NAMED else ""
            whose = person or (tr("Yours") if people else "")
            lines.append(f"{whose}: {names}{more}" if whose else f"{names}{more}")
    return "\n".join(lines)


def paint_run(painter: QPainter, area: QRectF) -> None:
    """Tint the frames that a reviewer means, where they lie in a row of the dope sheet."""
    painter.fillRect(area, tint(90))
    painter.fillRect(QRectF(area.left(), area.bottom() - 3, area.width(), 3), tint(255))


def _for_annotator(session: Session, info: TrackInfo) -> tuple[str, ...]:
    who = info.reviewer or tr("a reviewer")
    said = tr("sent back by {who}: {reason}").format(who=who, reason=_said(info))
    return (said,) if is_mine(session, info) else (said, tr("for {name}").format(name=info.person))


def _said(info: TrackInfo) -> str:
    """A reviewer's reason, and words if there are any."""
    return f"{told(info.reason)}, “{info.review_note}”" if info.review_note else told(info.reason)


class ReturnedBar(QFrame):
    """Above step 3's page while tracks wait that came back: how many, whose, and a button that answers."""

    fixed_wanted = Signal()

    def __init__(self, session: Session, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self._session = session
        self.setProperty("role", "banner")
        self.text = QLabel(wordWrap=True)
        self.fixed = QPushButton(tr("Fixed"))
        self.fixed.setToolTip(tr("The point that is active was worked on and goes back to the reviewer."))
        self.fixed.clicked.connect(self.fixed_wanted)
        row = QHBoxLayout(self)
        row.setContentsMargins(8, 4, 4, 4)
        row.addWidget(self.text, 1)
        row.addWidget(self.fixed)
        session.edited.connect(self.refresh)
        session.selected.connect(self.refresh)
        session.settings_changed.connect(self.refresh)
        self.refresh()

    def refresh(self, _touched: object = None) -> None:
        """Something was decided, answered or chosen."""
        sentence, track = summary(self._session), self._session.track
        self.text.setText(sentence)
        self.fixed.setEnabled(track is not None and self._session.annotation.tracks[track].review == "needs_fix")
        self.setVisible(bool(sentence))
