"""Where work goes: copies and backups of a project, a clip that was moved, and a disk that takes nothing any more."""

from __future__ import annotations

from datetime import UTC, datetime
from pathlib import Path

from PySide6.QtCore import QObject, QTimer, QUrl, Signal
from PySide6.QtGui import QDesktopServices
from PySide6.QtWidgets import QFileDialog, QInputDialog, QMessageBox, QWidget

from genmojo_core.errors import GenmojoError
from genmojo_core.store import audit, project_file
from genmojo_studio import notify
from genmojo_studio.annotate.session import Session
from genmojo_studio.translate import fault, tr

RETRY_MS = 5000
_KINDS = "GenMOJO (*.genmojo)"


class Keeping(QObject):
    """Watches over what a session could not write yet."""

    troubled = Signal(str)  # why edits wait, "" when all are on the disk again

    def __init__(self, session: Session, parent: QWidget) -> None:
        super().__init__(parent)
        self._s, self._w = session, parent
        self._why = ""  # the disk's last word
        self._again = QTimer(self, interval=RETRY_MS)
        self._again.timeout.connect(self._retry)
        session.unsaved.connect(self._failed)
        session.stored.connect(self._stored)

    def may_close(self) -> bool:
        """True if everything is on the disk, or a person gave up what is not. Asks as often as it takes."""
        project = self._s.project
        while not project.wait(10.0):
            count = tr("Edits that could not be written: {n}.").format(n=project.unsaved())
            box = QMessageBox(QMessageBox.Icon.Warning, tr("Not everything is saved"), count, parent=self._w)
            box.setInformativeText(self._why or tr("Free some space and try again, or save a copy elsewhere."))
            retry = box.addButton(tr("Try again"), QMessageBox.ButtonRole.AcceptRole)
            copy = box.addButton(tr("Save a copy…"), QMessageBox.ButtonRole.AcceptRole)
            lose = box.addButton(tr("Lose them"), QMessageBox.ButtonRole.DestructiveRole)
            stay = box.addButton(QMessageBox.StandardButton.Cancel)
            box.setDefaultButton(retry)
            box.setEscapeButton(stay)
            box.exec()
            if box.clickedButton() is retry:
                project.retry()
            elif box.clickedButton() is lose or (box.clickedButton() is copy and self.save_copy()):
                return True
            elif box.clickedButton() is not copy:
                return False
        return True

    def save_copy(self) -> bool:
        """A whole project file where a person wants it, with what could not be written here; False if there is none."""
        path, _ = QFileDialog.getSaveFileName(self._w, tr("Save a copy of the project"),
                                              f"{self._s.project.info.name}.genmojo", _KINDS)  # fmt: skip
        if not path:
            return False
        target = Path(path).with_suffix(".genmojo")
        try:
            self._s.project.save_copy(target)
        except GenmojoError as error:
            notify.tell(error, self._w)
            return False
        self._s.said.emit(tr("Saved: {name}").format(name=target.name))
        return True

    def backup(self) -> Path | None:
        """A new project file made of the backup copy that a person chooses; the project itself stays as it is."""
        path = self._s.project.path
        copies = project_file.backups(path)
        if not copies:
            self._s.said.emit(tr("There is no backup yet: naming a moment (Ctrl+S) makes one."))
            return None
        numbered = [f"{n + 1}: {_taken(copy.stem)}" for n, copy in enumerate(copies)]
        about = tr("A copy is made at every named moment. It is opened as a new project; this one stays as it is.")
        chosen, given = QInputDialog.getItem(self._w, tr("Open a backup copy"), about, numbered, 0, False)
        if not given:
            return None
        source = copies[numbered.index(chosen)]
        target = path.with_name(f"{path.stem}-{source.stem}.genmojo")
        try:
            if not target.exists():
                project_file.copy(source, target)
        except GenmojoError as error:
            notify.tell(error, self._w)
            return None
        return target

    def show_folder(self) -> None:
        """The folder that the project lies in, in the system's file manager."""
        QDesktopServices.openUrl(QUrl.fromLocalFile(str(self._s.project.path.parent)))

    def _failed(self, error: GenmojoError) -> None:
        self._again.start()
        self._why = fault(error)
        self.troubled.emit(self._why)
        self._s.said.emit(fault(error))

    def _retry(self) -> None:
        self._s.project.retry()

    def _stored(self, _seconds: float) -> None:
        if self._again.isActive() and not self._s.project.unsaved():
            self._again.stop()
            self.troubled.emit("")


def _taken(stem: str) -> str:
    """When a backup copy was made, by the name of its file, in local time; the name where it tells none."""
    try:
        made = datetime.strptime(stem, "%Y%m%dT%H%M%S%f").replace(tzinfo=UTC)
    except ValueError:
        return stem
    return audit.local(made.isoformat())


def found_clip(project: Path, parent: QWidget) -> Path | None:
    """Where a person says that a project's clip lies by now; None if it is where it was, or nobody knows."""
    if project.suffix != ".genmojo":
        return None
    try:
        info = project_file.clip_of(project)
    except GenmojoError:
        return None
    beside = project.parent / Path(info.path).name
    if Path(info.path).exists():
        return None
    if beside.exists():
        return beside
    box = QMessageBox(QMessageBox.Icon.Question, tr("The clip was moved"),
                      tr("{name} is not at {path} any more. Where is it?").format(name=info.name, path=info.path),
                      parent=parent)  # fmt: skip
    folder = box.addButton(tr("A folder…"), QMessageBox.ButtonRole.AcceptRole)
    file = box.addButton(tr("A video…"), QMessageBox.ButtonRole.ActionRole)
    box.addButton(QMessageBox.StandardButton.Cancel)
    box.exec()
    chosen = ""
    if box.clickedButton() is folder:
        chosen = QFileDialog.getExistingDirectory(parent, tr("The clip's folder"))
    elif box.clickedButton() is file:
        chosen = QFileDialog.getOpenFileName(parent, tr("The clip's video"))[0]
    return Path(chosen) if chosen else None
