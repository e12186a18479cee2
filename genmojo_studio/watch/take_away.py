"""Taking scenes away: HDF5, PLY, pictures, turntables and camera paths. Jobs run in a second process."""

from __future__ import annotations

import json
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
from PySide6.QtCore import QObject, Qt
from PySide6.QtWidgets import QFileDialog, QMessageBox, QProgressDialog, QWidget

from genmojo_core.errors import GenmojoError
from genmojo_core.store.atomic import write_bytes
from genmojo_studio import notify
from genmojo_studio.background import Tasks
from genmojo_studio.export.request import ExportRequest
from genmojo_studio.state import AppState
from genmojo_studio.translate import tr
from genmojo_studio.view3d.cpu_view import CpuView
from genmojo_studio.watch.film_dialogs import PictureDialog, TurntableDialog
from genmojo_studio.watch.live_view import LiveView
from genmojo_studio.watch.path_editor import PathEditor
from genmojo_studio.watch.run_control import RunControl
from genmojo_studio.watch.session import Session
from genmojo_studio.worker.jobs import ExportJob


class TakeAway(QObject):
    """The entries of the menu Take away. `last` is what the newest export wrote, None while it runs."""

    def __init__(self, state: AppState, session: Session, view: LiveView, control: RunControl, parent: QWidget) -> None:
        super().__init__(parent)
        self._control = control
        self._state = state
        self._session = session
        self._view = view
        self._window = parent
        self._tasks = Tasks()
        self._jobs: list[ExportJob] = []
        self._editor: PathEditor | None = None
        self.last: Path | None = None

    @property
    def scene_file(self) -> Path | None:
        """The scene file on show; exports read it. None for a run that goes on and for PLY files."""
        path = self._session.path
        return path if path is not None and path.is_file() and path.suffix.lower() in (".h5", ".hdf5") else None

    @property
    def ready(self) -> bool:
        """True if there is a scene file, or a run that can write one."""
        return self.scene_file is not None or (self._control.live and self._session.snapshot is not None)

    @property
    def _source(self) -> str:
        """The scene file; "" for the run that goes on."""
        return "" if self.scene_file is None else str(self.scene_file)

    def save_hdf5(self) -> None:
        """A checked copy of the scene."""
        output = self._ask(tr("Save the scene"), "scene.h5", "HDF5 (*.h5)")
        if output:
            self.export(ExportRequest("hdf5", self._source, output))

    def save_ply(self) -> None:
        """The frame on show as a 3DGS PLY."""
        output = self._ask(tr("Save this frame"), f"frame-{self._state.frame + 1:05d}.ply", "PLY (*.ply)")
        if output:
            self.export(ExportRequest("ply", self._source, output, frame=self._state.frame, extra=True))

    def save_ply_sequence(self) -> None:
        """Every frame as a PLY in a folder."""
        folder = QFileDialog.getExistingDirectory(self._window, tr("Folder for the PLY files"))
        if folder:
            self.export(ExportRequest("ply-sequence", self._source, folder, extra=True))

    def turntable(self) -> None:
        """The scene turned once round, as a video or pictures."""
        dialog = TurntableDialog(self._view.orbit.elevation, self._window)

        def accepted() -> None:
            output = self._ask_film(dialog.transparent.isChecked(), "turntable")
            if output:
                self.export(dialog.request(self._source, output, self._state.frame))

        dialog.accepted.connect(accepted)
        dialog.finished.connect(dialog.deleteLater)
        dialog.open()

    def camera_path(self) -> None:
        """The editor of camera paths, which stays open beside the window."""
        if self._editor is None:
            self._editor = PathEditor(self._state, self._view, self._window)
            self._editor.render_wanted.connect(self._render_path)
        self._editor.show()
        self._editor.raise_()

    def screenshot(self) -> None:
        """The view as it is, at any size."""
        dialog = PictureDialog((self._view.width(), self._view.height()), self._window)

        def accepted() -> None:
            output = self._ask(tr("Save the picture"), "view.png", "PNG (*.png)")
            if output:
                self.save_picture(output, dialog.size_wanted(), dialog.transparent.isChecked())

        dialog.accepted.connect(accepted)
        dialog.finished.connect(dialog.deleteLater)
        dialog.open()

    def save_picture(self, output: str, size: tuple[int, int], transparent: bool) -> None:
        """Writes the view at a size (width, height), and beside it a JSON file that says where it looks from."""
        request = self._view.request()
        if request is None:
            return
        backdrop = None if transparent else request.look.backdrop
        request = replace(request, moving=False, look=replace(request.look, backdrop=backdrop))
        surface, view = self._view.surface, request.view(*size)
        about = {
            "orbit": request.orbit.text(), "frame": request.t, "mode": str(request.look.mode), "size": list(size),
            "world_to_camera": view.world_to_camera.tolist(), "K": view.K.tolist(),
        }  # fmt: skip

        def write(pixels: np.ndarray) -> Path:
            from genmojo_core.measure.sheet import encode_png  # on this thread: it loads the compiled kernels

            write_bytes(output, encode_png(pixels))
            write_bytes(Path(output).with_suffix(".json"), json.dumps(about, indent=1).encode())
            return Path(output)

        self.last = None
        if isinstance(surface, CpuView):
            self._later(lambda: write(surface.image(request, view)))
        else:
            pixels = surface.image(request, view)  # OpenGL belongs to this thread
            self._later(lambda: write(pixels))

    def export(self, request: ExportRequest) -> None:
        """Runs an export in its own process, with progress and cancel. Of a run that goes on, as it stands now."""
        if not request.scene:
            self._control.scene_so_far(lambda path: self.export(replace(request, scene=str(path))))
            return
        job = ExportJob(self)
        dialog = QProgressDialog(tr("Writing {name} …").format(name=Path(request.output).name), tr("Cancel"), 0, 1000)
        dialog.setParent(self._window, Qt.WindowType.Dialog)
        dialog.setWindowModality(Qt.WindowModality.NonModal)
        dialog.setWindowTitle("GenMOJO Studio")
        dialog.setMinimumDuration(300)
        dialog.setAutoClose(False)
        dialog.setAutoReset(False)
        dialog.canceled.connect(job.cancel)
        job.progress.connect(lambda share: dialog.setValue(round(share * 1000)))
        job.finished.connect(lambda done: self._over(job, dialog, done, ""))
        job.failed.connect(lambda sentence: self._over(job, dialog, None, sentence))
        job.cancelled.connect(lambda: self._over(job, dialog, None, ""))
        self.last = None
        self._jobs.append(job)
        job.start(request)

    def close(self) -> None:
        """Ends what is being written."""
        for job in list(self._jobs):
            job.wait()
        self._tasks.close()
        if self._editor is not None:
            self._editor.close()

    def _over(self, job: ExportJob, dialog: QProgressDialog, done: dict[str, Any] | None, sentence: str) -> None:
        if job not in self._jobs:
            return
        self._jobs.remove(job)
        dialog.blockSignals(True)
        dialog.close()
        dialog.deleteLater()
        if done is not None:
            self.last = Path(done["path"])
            self._session.busy.emit("")
        elif sentence:
            notify.tell(GenmojoError("io", sentence.rstrip(".")), self._window)

    def _render_path(self, path: dict[str, Any], mode: str, short_side: int) -> None:
        if not self.ready:
            QMessageBox.information(
                self._window, "GenMOJO Studio", tr("Save the scene first; videos are made from its file.")
            )
            return
        output = self._ask_film(False, "camera-path")
        if output:
            self.export(ExportRequest("path", self._source, output, path=path, mode=mode, short_side=short_side))

    def _ask(self, title: str, name: str, kinds: str) -> str:
        folder = self.scene_file.parent if self.scene_file is not None else Path.home()
        return QFileDialog.getSaveFileName(self._window, title, str(folder / name), kinds)[0]

    def _ask_film(self, pictures: bool, name: str) -> str:
        if pictures:
            return QFileDialog.getExistingDirectory(self._window, tr("Folder for the pictures"))
        return self._ask(tr("Save the video"), f"{name}.mp4", "MP4 (*.mp4)")

    def _later(self, work: Callable[[], Path]) -> None:
        self._tasks.run(work, lambda path: setattr(self, "last", path), notify.tell)
