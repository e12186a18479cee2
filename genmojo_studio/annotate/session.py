"""One clip being annotated: project, frames, what is selected. Panels read it and listen; verbs change it."""

from __future__ import annotations

import hashlib
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from PySide6.QtCore import QObject, Signal

from genmojo_core.clip.clip import Clip
from genmojo_core.clip.frames import open_source
from genmojo_core.errors import GenmojoError
from genmojo_core.estimate.masks import Prompt
from genmojo_core.store import project_file, work_figures
from genmojo_core.store.project import Project, Step
from genmojo_core.store.project_file import ClipInfo
from genmojo_core.tracks.annotation import Annotation, ObjectInfo, Touched
from genmojo_core.tracks.edits import Edit
from genmojo_core.tracks.suspicion import Suspicion
from genmojo_studio.annotate.frame_cache import FrameCache
from genmojo_studio.annotate.mapping import View
from genmojo_studio.settings import data_folder
from genmojo_studio.state import AppState
from genmojo_studio.translate import fault, told, tr

POINTS = 5  # key points per object
OBJECTS = 5  # objects per clip; both can be changed in the project's notes
STRIDES = (1, 10)  # least and most
TRAILS = (0, 6, 24, 60)  # frames on either side
Place = tuple[int, tuple[int, int], View]  # a frame, a point, a part of the frame


@dataclass
class Painting:
    """A state being painted with a key held: track, state, frames on which it began and now is."""

    track: int
    state: int
    first: int
    last: int

    def run(self) -> tuple[int, int]:
        """First and last frame, rising."""
        return min(self.first, self.last), max(self.first, self.last)


@dataclass(frozen=True)
class Other:
    """A track shown beside what stands: a second annotator's, or what a track is about to become; and what to call it.

    colour (r, g, b) 0..255.
    """

    annotation: Annotation
    track: int
    label: str
    colour: tuple[int, int, int] = (255, 255, 255)


class Session(QObject):
    """Clip, project and selection; every change is told by a signal, on the UI thread."""

    frame_changed = Signal(int)  # the frame that shall be shown
    shown = Signal()  # frame, overlay or selection must be painted again
    edited = Signal(object)  # Touched
    selected = Signal()
    said = Signal(str)  # a sentence for the person
    view_wanted = Signal(object)  # View: the part of the frame to be shown again
    unsaved = Signal(object)  # GenmojoError: an edit could not be written; it waits
    stored = Signal(float)  # an edit is on the disk, seconds after it was made
    settings_changed = Signal()
    judged = Signal(int, int, bool)  # track, frame: a person corrected it (True) or accepted it

    def __init__(self, state: AppState, cache: FrameCache, project: Project, parent: QObject | None = None) -> None:
        super().__init__(parent)
        self.state, self.cache, self.project = state, cache, project
        self.clip: Clip | None = None  # the whole clip at reduced size, read in the background
        self.stride, self.trail, self.mask_mode = _stride_of(project), TRAILS[1], 1
        self.active = (0, 1)  # object id, number 1..; the point that a click places
        self.run: tuple[int | None, int | None] = (None, None)  # marked by [ and ], on this track:
        self.run_track: int | None = None
        self.painting: Painting | None = None
        self.others: tuple[Other, ...] = ()
        self.suspicion: dict[int, np.ndarray] = {}  # track -> (T,) 0..1
        self.suspicions: dict[int, Suspicion] = {}  # track -> what it comes from
        self.snap = False
        self.first_frames: dict[int, int] = {}  # object id -> frame in which it is first seen, as far as that is known
        self.placed: tuple[int, int] | None = None  # the point placed just now, while the next one is active
        self.hand_masks: dict[int, np.ndarray] = {}  # object id -> (T, h, w) bool, made in step 1
        self.sketch: list[Prompt] = []  # drawn in step 1 and not cut out yet
        self.sketching = False  # whether it is shown
        self.reviewing = False  # whether a person decides about tracks (step 4)
        self._points: dict[tuple[int, int], int] = {}
        self._looked_up = -1
        self.closed = False
        self.holding = False  # whether a point is being dragged: until it is let go its frame stands still
        self.view: Callable[[], View] = lambda: None  # the part of the frame on show
        self._back: list[Place] = []  # where one was before jumps
        self._ahead: list[Place] = []  # what was gone back from
        self.annotation.listeners.append(self._touched)
        project.saved = lambda _seq, seconds: self.stored.emit(seconds)
        project.failed = self.unsaved.emit
        self._unsubscribe = state.subscribe(self._frame_moved, "frame")
        objects = self.annotation.chosen_objects()
        if objects:
            self.active = (objects[0].id, 1)

    # ---- what stands

    @property
    def annotation(self) -> Annotation:
        """Objects and tracks as they stand."""
        return self.project.annotation

    @property
    def frame(self) -> int:
        """The frame that shall be shown."""
        return int(self.state.frame)

    @property
    def track(self) -> int | None:
        """The active point's track, None if it has none yet."""
        return self.track_of(*self.active)

    @property
    def nudged(self) -> int | None:
        """The track that nudges move: the active point's, or that of the point placed just now."""
        return self.track if self.track is not None or self.placed is None else self.track_of(*self.placed)

    def track_of(self, object_id: int, number: int) -> int | None:
        """The track of a point of an object."""
        if self._looked_up != self.annotation.revision:  # asked for at every step: never a search
            self._looked_up = self.annotation.revision
            self._points = {(i.object, i.number): i.id for i in self.annotation.tracks.values()}
        return self._points.get((object_id, number))

    def objects(self) -> list[ObjectInfo]:
        """Objects that are annotated, in their order."""
        return self.annotation.chosen_objects()

    def place_of(self, object_id: int) -> int:
        """Place of an object in that order, which gives its hue; after all others if it is not among them."""
        ids = [o.id for o in self.objects()]
        return ids.index(object_id) if object_id in ids else len(ids)

    def places(self) -> dict[int, int]:
        """Place, hence hue, of every object: those that are annotated in their order, then the others."""
        ids = [o.id for o in self.objects()]
        return {i: n for n, i in enumerate([*ids, *(i for i in self.annotation.objects if i not in ids)])}

    def limit(self, name: str) -> int:
        """How many "objects" per clip or "points" per object this project wants."""
        return int(self.annotation.meta.get(f"limit_{name}", OBJECTS if name == "objects" else POINTS))

    def first_frame(self, object_id: int) -> int:
        """The frame in which an object is first seen, 0 as long as nobody knows."""
        return self.first_frames.get(object_id, 0)

    def mask_at(self, frame: int) -> np.ndarray | None:
        """(h, w) object ids of a frame, from the clip or made by hand; None if there are none."""
        if self.clip is not None and self.clip.masks is not None and self.hand_masks:
            table = np.concatenate([[0], self.clip.object_ids]).astype(np.uint8)
            return np.asarray(table[self.clip.masks.value[frame]])
        return self.cache.mask(frame)

    def title(self, object_id: int, number: int) -> str:
        """What a person calls a point."""
        track = self.track_of(object_id, number)
        owner = self.annotation.objects.get(object_id)
        point = self.annotation.tracks[track].name if track is not None else ""
        name = owner.name if owner else tr("object {n}").format(n=object_id)
        return f"{name} · {number} {point}".rstrip()

    def label(self, object_id: int, number: int) -> str:
        """A point in words that no other point has: the object's place in the order goes first."""
        place = self.places().get(object_id)
        return f"{'–' if place is None else place + 1}  {self.title(object_id, number)}"

    # ---- going and choosing

    def enter(self, step: str, *, sketching: bool) -> None:
        """A step begins; `sketching`: what is drawn in it is shown."""
        self.sketching, self.reviewing = sketching, step == "review"
        self.settings_changed.emit()

    def go(self, frame: int, *, jump: bool = False) -> None:
        """Show a frame; a jump can be gone back from. While a point is held nothing moves."""
        if self.holding:
            return
        frame = min(max(frame, 0), self.annotation.frames - 1)
        if jump and frame != self.frame:
            self.remember()
        self.state.set(frame=frame)

    def remember(self) -> None:
        """Frame, point and view can be gone back to: called where a jump, a scrub or a choice begins."""
        self._ahead = []
        if not self._back or self._back[-1] != self._here():
            self._back = [*self._back[-99:], self._here()]

    def go_back(self) -> None:
        """The frame, point and view before the last jump."""
        self._retrace(self._back, self._ahead)

    def go_ahead(self) -> None:
        """Where `go_back` came from."""
        self._retrace(self._ahead, self._back)

    def _here(self) -> Place:
        return self.frame, self.active, self.view()

    def _retrace(self, way: list[Place], other: list[Place]) -> None:
        here = self._here()
        while way:
            place = way.pop()
            if place != here:
                other.append(here)
                self.select(*place[1])
                self.go(place[0])
                self.view_wanted.emit(place[2])
                return
        self.said.emit(tr("There is no place to go to that way."))

    def set_stride(self, stride: int) -> None:
        """Frames that Enter, comma and full stop move by; kept with the project, beside its history."""
        if stride != self.stride:
            self.stride = stride
            if not self.project.read_only:
                self.project.put_blob(work_figures.STRIDE_BLOB, str(stride).encode())
            self.settings_changed.emit()

    def select(self, object_id: int, number: int = 1) -> None:
        """Make a point active."""
        self.active, self.placed = (object_id, number), None
        self.state.set(selected_object=object_id or None, selected_track=self.track)
        self.selected.emit()
        self.shown.emit()

    def set_placed(self, point: tuple[int, int]) -> None:
        """Nudges go to this point until another one is selected."""
        self.placed = point
        self.selected.emit()

    def select_track(self, track: int) -> None:
        """Make a track's point active."""
        info = self.annotation.tracks.get(track)
        if info is not None:
            self.select(info.object, info.number)

    # ---- changing

    def do(self, edit: Edit, step: int | None = None) -> int | None:
        """Do and store an edit; what forbids it is said. Returns the step, None if nothing was done."""
        try:
            return self.project.do(edit, step)
        except GenmojoError as error:
            self.said.emit(fault(error))
            return None

    def undo(self) -> None:
        """Take the newest step back and show where it was."""
        self._moved(self.project.undo, tr("Undone: {title}"))

    def redo(self) -> None:
        """Do it again and show where it was."""
        self._moved(self.project.redo, tr("Done again: {title}"))

    def go_to(self, seq: int) -> None:
        """Go to any state of the history, on any branch, and show what changed last on the way."""
        self._moved(lambda: self.project.go_to(seq), tr("There now, after: {title}. The history leads back."))

    def show_step(self, step: Step, sentence: str) -> None:
        """Go where a step happened and say what it did."""
        if step.track is not None and step.track in self.annotation.tracks:
            self.select_track(step.track)
        if step.frame is not None:
            self.go(step.frame)
        self.said.emit(sentence.format(title=told(step.titles[-1])))  # what a person did; the rest follows from it

    def close(self) -> None:
        """Write everything, let go of files and threads."""
        self.closed = True
        self._unsubscribe()
        self.project.saved = self.project.failed = None
        if self._touched in self.annotation.listeners:
            self.annotation.listeners.remove(self._touched)
        self.project.close()
        self.cache.close()

    def _moved(self, move: object, sentence: str) -> None:
        before = dict(self.annotation.tracks)
        self.remember()
        try:
            step = move() if callable(move) else None
        except GenmojoError as error:
            self.said.emit(fault(error))
            return
        if isinstance(step, Step):
            gone = None if step.track in self.annotation.tracks else before.get(step.track or 0)
            if gone is not None:
                self.select(gone.object, gone.number)  # the point that was taken back is the next to be placed
            self.show_step(step, sentence)
        else:
            self.said.emit(tr("Nothing more to take back or do again."))

    def _touched(self, touched: Touched) -> None:
        if self.active[0] not in self.annotation.objects and self.objects():
            self.active = (self.objects()[0].id, 1)
        self.state.set(selected_track=self.track)
        self.edited.emit(touched)
        self.shown.emit()

    def _frame_moved(self) -> None:
        if self.painting is not None:
            self.painting.last = self.frame
        self.frame_changed.emit(self.frame)


def _stride_of(project: Project) -> int:
    """The stride that a project was left with; 2 where none was chosen."""
    kept = work_figures.stride_of(project.path)
    return kept if STRIDES[0] <= kept <= STRIDES[1] else work_figures.STRIDE


def _check_clip(project: Project, cache: FrameCache, clip: Path, moved: bool) -> None:
    """Note where a moved clip lies. Raises GenmojoError("value") if it is another one, with everything closed."""
    wanted, found = (project.info.frames, project.info.size), (cache.count, tuple(cache.size))
    if wanted != found:
        cache.close()
        project.close()
        raise GenmojoError("value", f"has {found[0]} frames of {found[1]}, the project's clip has {wanted[0]} of "
                           f"{wanted[1]}", str(clip), "choose the clip that was annotated")  # fmt: skip
    if moved and not project.read_only:
        project.moved_clip(clip.absolute())


def project_path(clip_path: Path) -> Path:
    """Where the project of a clip lies: in the app's own folder, named after the clip and where it is."""
    where = hashlib.sha256(str(clip_path.absolute()).encode()).hexdigest()[:8]
    return data_folder() / "projects" / f"{clip_path.absolute().name}-{where}.genmojo"


def prepare_project(clip_path: Path) -> None:
    """Make the project file of a clip where there is none, for any thread: the disk may be slow.

    Raises GenmojoError as `open_source` and `Project.create`.
    """
    file = project_path(clip_path)
    if not file.exists():
        source = open_source(clip_path)
        project_file.create(file, _info(clip_path, source.size, source.seconds))


def _info(path: Path, size: tuple[int, int], seconds: np.ndarray) -> ClipInfo:
    return ClipInfo(path.name, str(path.absolute()), size, np.arange(len(seconds)), seconds)


def open_session(state: AppState, path: Path, person: str, at: Path | None = None, clip: Path | None = None) -> Session:
    """The session of a clip, whose project lies `at` a path, or of a project file.

    `clip` is where a project file's clip lies by now, if it was moved.

    Raises GenmojoError as `FrameCache`, `Project.open` and `Project.create`.
    """
    if path.suffix == ".genmojo":
        project = Project.open(path, person)
        try:
            cache = FrameCache(str(clip or project.info.path))
        except GenmojoError:
            project.close()
            raise
        _check_clip(project, cache, clip or Path(project.info.path), clip is not None)
    else:
        cache = FrameCache(path)
        file = at or project_path(path)
        file.parent.mkdir(parents=True, exist_ok=True)
        try:
            project = Project.open_or_create(file, _info(path, cache.size, cache.seconds), person)
        except GenmojoError:
            cache.close()
            raise
    there = Path(project.info.path)
    if state.clip is None or state.clip_path != there or len(state.clip) != cache.count:
        state.set(clip=None, clip_path=there, masks_path=None, frame_count=cache.count, frame=0)
    state.set(project_path=project.path)
    return Session(state, cache, project)
