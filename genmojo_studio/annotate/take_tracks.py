"""Tracks out of files and into files: what is asked, done in the background, and said afterwards."""

from __future__ import annotations

import tempfile
from collections.abc import Callable
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np
from PySide6.QtWidgets import (
    QComboBox,
    QDialog,
    QDialogButtonBox,
    QFileDialog,
    QFormLayout,
    QInputDialog,
    QLabel,
    QMessageBox,
    QWidget,
)

from genmojo_core.clip.frames import frame_names
from genmojo_core.errors import GenmojoError
from genmojo_core.store import tapvid, tapvid_pickle
from genmojo_core.store.track_import import Imported, import_tracks
from genmojo_core.store.track_sheet import WHICH, TrackSheet, Which, taken
from genmojo_studio import notify
from genmojo_studio.annotate import track_files
from genmojo_studio.annotate.session import Session
from genmojo_studio.translate import tr

if TYPE_CHECKING:
    from genmojo_studio.annotate.workspace import AnnotateWorkspace


class ExportDialog(QDialog):
    """Which format, and which tracks by their review."""

    def __init__(self, session: Session, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self.setWindowTitle(tr("Export tracks"))
        self.format, self.which = QComboBox(), QComboBox()
        for form in track_files.FORMATS:
            self.format.addItem(f"{form.title} (.{form.ending})", form)
        infos = session.annotation.active()
        titles = {"not-rejected": tr("all but rejected ones ({n})"), "all": tr("all ({n})"),
                  "approved": tr("approved ones only ({n})")}  # fmt: skip
        for which in WHICH:
            self.which.addItem(titles[which].format(n=sum(taken(i, which) for i in infos)), which)
        self.note = QLabel(wordWrap=True)
        self.note.setProperty("role", "dim")
        self.note.setMinimumWidth(420)
        buttons = QDialogButtonBox(QDialogButtonBox.StandardButton.Cancel)
        self.choose = buttons.addButton(tr("Choose file …"), QDialogButtonBox.ButtonRole.AcceptRole)
        buttons.accepted.connect(self.accept)
        buttons.rejected.connect(self.reject)
        form_layout = QFormLayout(self)
        form_layout.addRow(tr("Format"), self.format)
        form_layout.addRow(tr("Tracks"), self.which)
        form_layout.addRow(self.note)
        form_layout.addRow(buttons)
        self.format.currentIndexChanged.connect(self._describe)
        self._describe()

    def chosen(self) -> tuple[track_files.Format, Which]:
        """The format and the tracks."""
        return self.format.currentData(), self.which.currentData()

    def _describe(self) -> None:
        """What comes back from such a file."""
        texts = {
            "deeplabcut": tr("Holds what is seen, no states: hidden points, flags and reviews do not come back."),
            "tapvid": tr("Points beside the picture lie on its border for other programs; read here, they come back."),
        }
        plain = tr("Places, states, names, numbers and flags come back when it is imported here.")
        self.note.setText(texts.get(self.format.currentData().name, plain))


def export_tracks(workspace: AnnotateWorkspace) -> None:
    """Ask for format, tracks and file; then write."""
    session = _session(workspace)
    dialog = ExportDialog(session, workspace)
    dialog.accepted.connect(lambda: _choose_file(workspace, dialog))
    dialog.finished.connect(dialog.deleteLater)
    dialog.open()


def ask_import(workspace: AnnotateWorkspace) -> None:
    """Ask for a file; its format is seen in it. Read in the background, taken over as one edit."""
    kinds = [f"{tr('All track files')} ({track_files.patterns()})",
             *(f"{f.title} (*.{f.ending})" for f in track_files.FORMATS)]  # fmt: skip
    name, _ = QFileDialog.getOpenFileName(workspace, tr("Import tracks"), "", ";;".join(kinds))
    if name:
        take_file(workspace, Path(name))


def take_file(workspace: AnnotateWorkspace, path: Path) -> None:
    """Tracks of a file into the annotation; a pickle only after consent."""
    session = _session(workspace)
    size, frames = session.annotation.size, session.annotation.frames
    if path.suffix.lower() in track_files.PICKLES:
        _take_pickle(workspace, path)
        return
    _read(workspace, lambda: track_files.told_apart(path).read(path, size, frames))


def said_of(done: Imported) -> str:
    """What an import did, for a person."""
    parts = [tr("Imported: {filled} points filled, {made} new").format(filled=done.filled, made=done.made)]
    for count, text in (
        (done.objects, tr("{n} new objects")),
        (done.locked, tr("{n} locked ones left alone")),
        (done.kept_frames, tr("{n} places of yours kept")),
        (done.placeless, tr("{n} without any place left out")),
    ):
        if count:
            parts.append(text.format(n=count))
    return "; ".join(parts) + "."


def _take_pickle(workspace: AnnotateWorkspace, path: Path) -> None:
    """TAP-Vid's own file: unpacked by a closed process, then one of its videos."""
    text = tr("{name} is a pickle. Opening one can run code; it is opened in a closed process that lets nothing "
              "through but arrays. Open it?").format(name=path.name)  # fmt: skip
    if QMessageBox.question(workspace, tr("Open a pickle?"), text) != QMessageBox.StandardButton.Yes:
        return
    session = _session(workspace)
    folder = tempfile.TemporaryDirectory(prefix="genmojo-tapvid-")

    def unpacked(files: list[Path]) -> None:
        chosen = _video(workspace, files)
        if chosen is None:
            folder.cleanup()
        else:
            _read(workspace, lambda: tapvid.read(chosen, session.annotation.size), folder.cleanup)

    def failed(error: BaseException) -> None:
        folder.cleanup()
        notify.tell(error, workspace)

    session.said.emit(tr("Opening {name} …").format(name=path.name))
    workspace.work.tasks.run(lambda: tapvid_pickle.unpack(path, folder.name, consent=True), unpacked, failed)


def _video(workspace: AnnotateWorkspace, files: list[Path]) -> Path | None:
    """Which of several videos; the clip's own name is offered first."""
    if not files:
        notify.tell(GenmojoError("empty", "holds no video", "TAP-Vid", "give another file"), workspace)
        return None
    if len(files) == 1:
        return files[0]
    names = [file.stem for file in files]
    own = _session(workspace).project.info.name
    first = names.index(own) if own in names else 0
    name, given = QInputDialog.getItem(workspace, tr("Import tracks"), tr("Which video?"), names, first, False)
    return files[names.index(name)] if given else None


def _read(
    workspace: AnnotateWorkspace, read: Callable[[], TrackSheet], after: Callable[[], None] | None = None
) -> None:
    """Read in the background, then take over."""
    session = _session(workspace)

    def done(sheet: TrackSheet) -> None:
        if after is not None:
            after()
        try:
            found = import_tracks(session.annotation, sheet, session.project.person, lambda t: _labels(session, t))
        except GenmojoError as error:
            notify.tell(error, workspace)
            return
        if not found.edit.changes:
            session.said.emit(tr("Nothing to import: ") + said_of(found))
        elif session.do(found.edit) is not None:
            session.said.emit(said_of(found))

    def failed(error: BaseException) -> None:
        if after is not None:
            after()
        notify.tell(error, workspace)

    workspace.work.tasks.run(read, done, failed)


def _labels(session: Session, frame: int) -> np.ndarray | None:
    """(h, w) object ids of a frame: of the clip in memory, else of the frame's own file."""
    clip = session.clip
    if clip is not None and clip.masks is not None:
        table = np.concatenate([[0], clip.object_ids])
        return np.asarray(table[clip.masks.value[frame]])
    return session.cache.mask(frame) if session.cache.read(frame) is not None else None


def _choose_file(workspace: AnnotateWorkspace, dialog: ExportDialog) -> None:
    session, (form, which) = _session(workspace), dialog.chosen()
    info = session.project.info
    start = f"{Path(info.name).stem or 'tracks'}.{form.ending}"
    kind = f"{form.title} (*.{form.ending})"
    name, _ = QFileDialog.getSaveFileName(workspace, tr("Export tracks"), start, kind)
    if not name:
        return
    path = track_files.named(Path(name), form)
    if str(path) != name and path.exists():
        text = tr("{name} exists. Replace it?").format(name=path.name)
        if QMessageBox.question(workspace, tr("Export tracks"), text) != QMessageBox.StandardButton.Yes:
            return
    names = frame_names(info.path)
    names = names if len(names) == session.annotation.frames else ()
    sheet = TrackSheet.of_annotation(session.annotation, names, info.seconds, which)
    if not len(sheet.numbers):
        session.said.emit(tr("There is no such track to export."))
        return
    left = len(session.annotation.active()) - len(sheet.numbers)
    parts = [tr("Exported {n} tracks: {name}").format(n=len(sheet.numbers), name=path)]
    if left:
        parts.append(tr("{n} left out by their review").format(n=left))
    outside = tapvid.clipped_count(sheet.tracks) if form.name == "tapvid" else 0
    if outside:
        parts.append(tr("{n} visible points beside the picture lie at its border").format(n=outside))
    workspace.work.tasks.run(
        lambda: form.write(sheet, path), lambda _none: session.said.emit("; ".join(parts)),
        lambda error: notify.tell(error, workspace),
    )  # fmt: skip


def _session(workspace: AnnotateWorkspace) -> Session:
    """The session; dialogs exist only while there is one. Raises RuntimeError."""
    if workspace.session is None:
        raise RuntimeError("a session is needed to take tracks in or out")
    return workspace.session
