"""Work in the background of a session: reading the clip, candidates, masks by hand, seeds, solving, suspicion."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path

import numpy as np
from PySide6.QtCore import QObject, QTimer, Signal

from genmojo_core.clip import folders
from genmojo_core.clip.clip import Clip
from genmojo_core.errors import GenmojoError
from genmojo_core.sentences import say
from genmojo_core.store.project import Project
from genmojo_core.store.safe import json_text, parse_json
from genmojo_core.trackers.solver import SHORT_SIDE
from genmojo_core.tracks.annotation import ObjectInfo
from genmojo_core.tracks.edit_tracks import put_objects
from genmojo_studio import notify
from genmojo_studio.annotate import hand_masks, tracking
from genmojo_studio.annotate.candidates import Figures, all_figures, camera_path
from genmojo_studio.annotate.hand_masks import Drawn
from genmojo_studio.annotate.masks import Masks
from genmojo_studio.annotate.picture_watch import PictureWatch
from genmojo_studio.annotate.session import Session
from genmojo_studio.background import Tasks
from genmojo_studio.translate import fault, tr

_OFFERED = "candidates"  # blob: ids of masks that became candidates once, so that none comes back after an undo


@dataclass(frozen=True)
class _Read:
    """The clip with its own masks and the frames (T,) that have any, masks of an older project, ids of masks offered
    before (None: not noted)."""

    clip: Clip
    known: np.ndarray
    first: dict[int, Drawn]
    offered: set[int] | None


class Work(QObject):
    """Owns the threads of one session; results arrive on the UI thread, late ones are dropped."""

    clip_ready = Signal()
    figures_ready = Signal(object, int)  # {object id: Figures}, number of frames without masks
    spots_ready = Signal(object)  # list of Spot
    busy_changed = Signal(str)  # what is going on, "" for nothing

    def __init__(self, session: Session, parent: QObject | None = None) -> None:
        super().__init__(parent)
        self._session = session
        self.tasks = Tasks()
        self.masks = Masks(session, self)
        self.masks.busy_changed.connect(self.busy_changed)
        self.masks.changed.connect(self._masks_changed)
        self.tracker = tracking.Tracking(session, self)
        self.tracker.spots_ready.connect(self.spots_ready)
        self.tracker.busy_changed.connect(self.busy_changed)
        self.pictures = PictureWatch(session, self)
        self._read: _Read | None = None
        self._camera: np.ndarray | None = None  # once known; masks change it hardly
        self._ready = False
        self._closed = False

    def begin(self) -> None:
        """Read the clip, soon; called when everybody listens, for what is ready is said once."""
        QTimer.singleShot(0, self._read_clip)

    def close(self) -> None:
        """Drop what is going on."""
        self._closed = True
        self.pictures.close()
        self.masks.close()
        self.tracker.close()
        self.tasks.close()

    # ---- clip and candidates

    def _read_clip(self) -> None:
        if self._closed:
            return
        state, project = self._session.state, self._session.project
        path = Path(project.info.path)
        same = state.clip_path == path and len(state.clip or ()) == self._session.annotation.frames
        held, corrected = state.clip if same else None, state.masks_path is not None
        if held is None or corrected:
            self.busy_changed.emit(tr("Reading the clip …"))
        self.tasks.run(lambda: _read(project, path, held, corrected), self._clip_read, self._failed)

    def _clip_read(self, read: _Read) -> None:
        if self._closed:
            return
        self.busy_changed.emit("")
        self._read = read
        self.masks.begin(read.clip, read.first, read.known)

    def _masks_changed(self) -> None:
        """Other masks are on show: for the first time the clip is ready too."""
        if not self._ready and self._read is not None:
            self._ready = True
            self._offer(self._read)
            self.clip_ready.emit()
        self._count()
        self.tracker.look_again()

    def _offer(self, read: _Read) -> None:
        """The clip's masks become candidates, each once in the project's life: what was undone stays undone."""
        session, clip = self._session, read.clip
        if session.project.read_only:
            return
        ids = {int(i) for i in clip.object_ids}
        begun = any(row.kind == "objects" for row in session.project.history())  # before offers were noted
        offered = read.offered if read.offered is not None else ids if begun else set()
        names = clip.object_names or ("",) * clip.objects
        new = [
            ObjectInfo(int(i), name or tr("object {n}").format(n=int(i)))
            for i, name in zip(clip.object_ids, names, strict=True)
            if int(i) not in session.annotation.objects and int(i) not in offered
        ]
        if new:
            session.do(put_objects(session.annotation, new, say("candidates")))
        if offered | ids != read.offered:
            session.project.put_blob(_OFFERED, json_text(sorted(offered | ids)).encode())

    def _count(self) -> None:
        clip = self._session.clip
        if clip is None or clip.masks is None:
            return

        def work() -> tuple[np.ndarray, dict[int, Figures]]:
            camera = self._camera if self._camera is not None else camera_path(clip)
            return camera, all_figures(clip, self.masks.known, camera)

        self.tasks.run(work, self._counted, self._failed)

    def _counted(self, result: tuple[np.ndarray, dict[int, Figures]]) -> None:
        self._camera, found = result
        self.figures_ready.emit(found, int((~self.masks.known).sum()))

    def _failed(self, error: BaseException) -> None:
        if self._closed:
            return
        self.busy_changed.emit("")
        if isinstance(error, GenmojoError):
            self._session.said.emit(fault(error))
        else:
            notify.tell(error)


def _read(project: Project, path: Path, held: Clip | None, corrected: bool) -> _Read:
    """Read what opening a clip needs; of a clip that is held already only its own masks, if others stand for them."""
    clip = held
    if clip is None or corrected:
        clip = folders.read(path, short_side=SHORT_SIDE, ignore=folders.CHANNELS)
        if held is not None and held.frames.shape == clip.frames.shape:  # the frames once only
            clip = held.with_channels(masks=clip.masks, object_ids=clip.object_ids, object_names=clip.object_names)
    noted = project.blob(_OFFERED)
    offered = None if noted is None else {int(i) for i in parse_json(noted.decode(), _OFFERED)}
    known = np.ones(len(clip), bool) if clip.masks is None else np.any(clip.masks.valid, axis=(1, 2))
    return _Read(clip, known, hand_masks.load_first(project), offered)
