"""What a person does to points and tracks, in terms of edits. Windows call these; they know no window."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from genmojo_core.errors import GenmojoError
from genmojo_core.sentences import say
from genmojo_core.tracks import edit_tracks, keys
from genmojo_core.tracks.annotation import CONFIRMED, HUMAN, KEY, SNAPPED, Cells, TrackInfo
from genmojo_core.tracks.edits import CellsChange, Edit, join
from genmojo_core.tracks.model import NONE, OCCLUDED, OUT_OF_VIEW, VISIBLE
from genmojo_core.tracks.review import returned
from genmojo_studio.annotate.session import Painting, Session
from genmojo_studio.translate import fault, tr

DOUBT = 0.5  # suspicion from which Enter does not accept a point unseen


def place(session: Session, xy: tuple[float, float], *, snapped: bool = False) -> int | None:
    """Put the active point of the frame at a raster position, as a new track if it has none; it is seen there.

    Dragging keeps the state instead (`set_key`), so that a hidden point's place can be put right. Returns the step.
    """
    object_id, number = session.active
    track = session.track
    if object_id not in session.annotation.objects:
        session.said.emit(tr("Choose an object first (step 1)."))
        return None
    if track is None and outside(session, xy):
        session.said.emit(tr("A point begins where it is seen: click inside the picture."))
        return None
    if track is None:
        return session.do(_first_key(session, object_id, number, xy, snapped=snapped))
    return set_key(session, track, xy, state=VISIBLE, snapped=snapped)


def set_key(
    session: Session, track: int, xy: tuple[float, float], *, state: int | None = None, snapped: bool = False
) -> int | None:
    """A person puts a track's point of the frame somewhere; without `state` a hidden one stays hidden. The step."""
    try:
        edit = keys.set_key(session.annotation, track, session.frame, xy, state, snapped)
    except GenmojoError as error:
        session.said.emit(fault(error))
        return None
    step = session.do(edit)
    session.judged.emit(track, session.frame, True)
    seen = session.annotation.cells(track, np.array([session.frame])).state[0] == VISIBLE
    if step is not None and seen and outside(session, xy):
        session.said.emit(tr("The point is outside the picture, yet marked visible: O marks it as out of view."))
    return in_work(session, track, step)


def outside(session: Session, xy: tuple[float, float]) -> bool:
    """True for a raster position beyond the picture."""
    return not (0 <= xy[0] <= session.annotation.size[0] and 0 <= xy[1] <= session.annotation.size[1])


def in_work(session: Session, track: int, step: int | None) -> int | None:
    """A draft that a person works on is in progress, from the same step on."""
    if step is not None:
        session.do(edit_tracks.begin(session.annotation, track), step)
    return step


def nudge(session: Session, dx: float, dy: float) -> int | None:
    """Move the active point, or the one placed just now, by raster pixels."""
    track = session.nudged
    if track is None:
        return None
    cells = session.annotation.cells(track, np.array([session.frame]))
    if cells.state[0] == NONE:
        session.said.emit(tr("The point has no place in this frame."))
        return None
    x, y = cells.xy[0]
    return set_key(session, track, (float(x) + dx, float(y) + dy))


def toggle_key(session: Session) -> None:
    """The active point's place becomes a key, or an ordinary place."""
    track = session.track
    if track is None:
        return
    cells = session.annotation.cells(track, np.array([session.frame]))
    if cells.flags[0] & KEY:
        attempt(session, lambda: keys.remove_key(session.annotation, track, session.frame))
    elif cells.state[0] != NONE:
        set_key(session, track, (float(cells.xy[0, 0]), float(cells.xy[0, 1])))
    else:
        session.said.emit(tr("The point has no place in this frame."))


def delete_key(session: Session) -> None:
    """The active point's key becomes an ordinary place."""
    track = session.track
    if track is not None:
        attempt(session, lambda: keys.remove_key(session.annotation, track, session.frame))


def paint(session: Session, track: int, state: int, first: int, last: int) -> int | None:
    """A state over frames first..last, as one step."""
    step = attempt(session, lambda: keys.set_state(session.annotation, track, first, last, state))
    return in_work(session, track, step)


def paint_here(session: Session, state: int) -> int | None:
    """A state for the marked run, or for this frame; hidden where it is that state already means visible again."""
    track = session.track
    if track is None:
        return None
    first, last = marked_run(session)
    if (
        first == last
        and state not in (VISIBLE, NONE)
        and session.annotation.cells(track, np.array([first])).state[0] == state
    ):
        state = VISIBLE
    session.run = (None, None)
    return paint(session, track, state, first, last)


def begin_painting(session: Session, state: int) -> None:
    """Paint from this frame on until `end_painting`; shown at once, stored as one step."""
    track = session.track
    if track is not None and session.painting is None:
        session.painting = Painting(track, state, session.frame, session.frame)
        session.shown.emit()


def end_painting(session: Session) -> None:
    """Store what was painted; a tap alone acts like `paint_here`."""
    painting, session.painting = session.painting, None
    if painting is None:
        return
    first, last = painting.run()
    if first == last:
        paint_here(session, painting.state)
    else:
        paint(session, painting.track, painting.state, first, last)


def toggle_uncertain(session: Session) -> None:
    """The marked run, or this frame, becomes uncertain or certain."""
    track = session.track
    if track is None:
        return
    first, last = marked_run(session)
    session.run = (None, None)
    on = not session.annotation.cells(track, np.array([first])).flags[0] & 2
    attempt(session, lambda: keys.set_uncertain(session.annotation, track, first, last, bool(on)))


def marked_run(session: Session) -> tuple[int, int]:
    """First and last frame marked by [ and ], this frame where one is missing."""
    run = session.run if session.run_track == session.track else (None, None)
    first, last = (session.frame if end is None else end for end in run)
    return min(first, last), max(first, last)


def accept(session: Session, direction: int = 1) -> bool:
    """Confirm the points of the frame that nothing speaks against, and go on.

    The first suspicious point becomes active instead of going on; pressing again, with it on show, accepts it too.
    Returns True if the frame was left.
    """
    annotation, frame = session.annotation, session.frame
    view = annotation.at(frame)
    doubtful = [t for t in view.ids.tolist() if _doubt(session, t) >= DOUBT and not _settled(session, t)]
    asked = session.track in doubtful
    clear = [t for t in view.ids.tolist() if t not in doubtful or t == session.track]
    if clear:
        confirmed = keys.confirm(annotation, clear, frame)
        touched = sorted({c.track for c in confirmed.changes if isinstance(c, CellsChange)})
        begun = [edit_tracks.begin(annotation, track) for track in touched]
        session.do(join(confirmed.kind, confirmed.title, [confirmed, *begun]))
        for track in clear:
            session.judged.emit(track, frame, False)
    left = [t for t in doubtful if t != session.track] if asked else doubtful
    if left:
        session.select_track(left[0])
        session.said.emit(tr("Look at this point, then press Enter again."))
        return False
    session.go(frame + direction * session.stride)
    return True


def set_mode(session: Session, mode: int | None = None) -> None:
    """How the segment around the frame is filled; without `mode` the next of tracker, line and hold."""
    track = session.track
    if track is None:
        return
    start, end = session.annotation.segment(track, session.frame)
    if start is None or end is None:
        session.said.emit(tr("Only between two keys there is a choice: place one on either side."))
        return
    new = (int(session.annotation.track(track).mode[start]) + 1) % 3 if mode is None else mode
    names = (tr("tracker"), tr("line"), tr("hold"))
    step = attempt(session, lambda: keys.set_mode(session.annotation, track, session.frame, new))
    if step is not None:
        session.said.emit(tr("This segment is filled by: {mode}").format(mode=names[new]))


def clear(session: Session, *, after: bool) -> None:
    """Forget the active track after or before the frame."""
    track, frame, last = session.track, session.frame, session.annotation.frames - 1
    if track is None:
        return
    run = (frame + 1, last) if after else (0, frame - 1)
    if run[0] > run[1] or not session.annotation.track(track).state[run[0] : run[1] + 1].any():
        session.said.emit(tr("There is nothing to forget on that side of this frame."))
        return
    attempt(session, lambda: keys.clear(session.annotation, track, *run))


def toggle_lock(session: Session) -> None:
    """Lock the active track, or unlock it; unlocking takes an approval back, which is said."""
    track = session.track
    if track is None:
        return
    before = session.annotation.tracks[track]
    session.do(edit_tracks.lock(session.annotation, track, session.frame, on=not before.locked))
    if session.annotation.tracks[track].review != before.review:
        session.said.emit(tr("Unlocked: the track is no longer approved and waits for a decision again."))


def fixed(session: Session, track: int) -> None:
    """A track that came back was worked on: it waits for its reviewer again. Only what came back can be."""
    if attempt(session, lambda: edit_tracks.fixed(session.annotation, track)) is None:
        return
    info, left = session.annotation.tracks[track], len(returned(session.annotation))
    said = tr("{point} is fixed and goes back to {who}.").format(
        point=session.title(info.object, info.number), who=info.reviewer or tr("the reviewer"))  # fmt: skip
    session.said.emit(said + (" " + tr("{n} more came back.").format(n=left) if left else ""))


def delete_track(session: Session) -> None:
    """Delete the active track; undo brings it back."""
    track = session.track
    if track is not None:
        attempt(session, lambda: edit_tracks.delete_track(session.annotation, track))


def attempt(session: Session, make: object) -> int | None:
    """Make an edit and do it; what forbids it is said."""
    try:
        edit = make() if callable(make) else None
    except GenmojoError as error:
        session.said.emit(fault(error))
        return None
    return session.do(edit) if isinstance(edit, Edit) else None


def _first_key(session: Session, object_id: int, number: int, xy: tuple[float, float], *, snapped: bool) -> Edit:
    """A new track with its first key, as one edit."""
    made = edit_tracks.add_track(session.annotation, object_id, number, session.project.person)
    track = int(made.track or 0)
    flags = KEY | CONFIRMED | (SNAPPED if snapped else 0)
    one = [np.array([v], np.uint8) for v in (VISIBLE, flags, HUMAN, 0)]
    cells = Cells(np.array([xy], np.float32), one[0], one[1], one[2], np.ones(1, np.float32), one[3])
    frames = np.array([session.frame], np.int32)
    placed = CellsChange(track, frames, Cells.empty(1), cells)
    owner = session.annotation.objects[object_id].name
    title = say("place", point=say("point_of", number=number, name=owner))
    return replace(made, title=title, changes=(*made.changes, placed), frame=session.frame)


def _doubt(session: Session, track: int) -> float:
    values = session.suspicion.get(track)
    return float(values[session.frame]) if values is not None else 0.0


def _settled(session: Session, track: int) -> bool:
    """True if a person has dealt with the point in this frame."""
    flags = int(session.annotation.cells(track, np.array([session.frame])).flags[0])
    return bool(flags & (KEY | CONFIRMED)) or _info(session, track).locked


def _info(session: Session, track: int) -> TrackInfo:
    return session.annotation.tracks[track]


STATES = {"occluded": OCCLUDED, "outside": OUT_OF_VIEW, "visible": VISIBLE, "nothing": NONE}
