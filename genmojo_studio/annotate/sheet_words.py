"""What the dope sheet says in words: the names of its rows, and what stands under the mouse."""

from __future__ import annotations

from genmojo_core.tracks.annotation import BY_HOLD, BY_LINE, BY_TRACKER, CONFIRMED, KEY, SNAPPED, UNCERTAIN
from genmojo_studio.annotate import returned
from genmojo_studio.annotate.session import Session
from genmojo_studio.annotate.track_tree import review_name, state_name
from genmojo_studio.translate import told, tr

DOUBTFUL = 0.3  # suspicion from which it is drawn and said


def label(session: Session, track: int) -> tuple[str, str]:
    """Of a row: order of its object and number of its point, which no other row has; then its names."""
    info = session.annotation.tracks[track]
    owner = session.annotation.objects.get(info.object)
    place = session.places().get(info.object)
    code = f"{'–' if place is None else place + 1}·{info.number}"
    if session.track_of(info.object, info.number) != track:  # two tracks claim to be the same point
        code += f"#{track}"
    names = [owner.name if owner else tr("object {n}").format(n=info.object), info.name]
    return f"{code}  ", " · ".join(filter(None, names))


def describe_row(session: Session, track: int) -> str:
    """A whole track: its names, keys, and where its review stands."""
    info = session.annotation.tracks[track]
    code, name = label(session, track)
    keys = len(session.annotation.keys(track))
    lines = [f"{code}{name}", tr("{n} keys; review: {state}").format(n=keys, state=review_name(info.review))]
    if info.review in ("needs_fix", "fixed"):
        lines.append(returned.words(session, info))
    if info.locked:
        lines.append(tr("locked"))
    if info.note:
        lines.append(info.note)
    return "\n".join(lines)


def describe_cell(session: Session, track: int, frame: int) -> str:
    """A track in one frame: state, marks, what fills the segment, what speaks against it."""
    cells = session.annotation.track(track)
    flags = int(cells.flags[frame])
    names = ((KEY, tr("key")), (CONFIRMED, tr("accepted")), (UNCERTAIN, tr("uncertain")), (SNAPPED, tr("snapped")))
    marks = [name for bit, name in names if flags & bit]
    code, name = label(session, track)
    state = state_name(int(cells.state[frame])) if cells.state[frame] else tr("not annotated")
    lines = [f"{code}{name}", f"{tr('frame')} {frame}: " + ", ".join([state, *marks])]
    start, end = session.annotation.segment(track, frame)
    if start is not None and end is not None and not flags & KEY:
        modes = {BY_TRACKER: tr("tracker"), BY_LINE: tr("line"), BY_HOLD: tr("hold")}
        text = tr("between the keys {a} and {b}, filled by: {mode}")
        lines.append(text.format(a=start, b=end, mode=modes[int(cells.mode[start])]))
    lines += _doubts(session, track, frame)
    return "\n".join(lines)


def _doubts(session: Session, track: int, frame: int) -> list[str]:
    """What speaks against a place, a line each; nothing where nothing does."""
    info, lines = session.annotation.tracks[track], []
    first, last = returned.run_of(session, info)
    if info.review == "needs_fix" and first <= frame <= last:
        lines.append(returned.words(session, info))
    scores, found = session.suspicion.get(track), session.suspicions.get(track)
    if scores is not None and frame < len(scores) and scores[frame] >= DOUBTFUL:
        text = tr("suspicious ({n} of 9)").format(n=round(9 * float(scores[frame])))
        reasons = [told(reason) for reason in found.reasons(frame)] if found is not None else []
        lines.append(f"{text}: {', '.join(reasons)}" if reasons else text)
    return lines
