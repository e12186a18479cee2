"""What the annotator asks before it acts. Each dialog asks; the deed itself is a verb elsewhere."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from typing import TYPE_CHECKING

from PySide6.QtCore import QPoint, Qt
from PySide6.QtWidgets import QFileDialog, QInputDialog, QMenu

from genmojo_core.clip import digests
from genmojo_core.errors import GenmojoError
from genmojo_core.store import project_file
from genmojo_core.tracks.annotation import REASONS
from genmojo_studio import notify
from genmojo_studio.annotate import audit_panel, take_tracks
from genmojo_studio.annotate.exchange_dialog import ExchangeDialog, Kind, hindrance
from genmojo_studio.annotate.history_dialog import HistoryDialog
from genmojo_studio.annotate.log_dialog import LogDialog
from genmojo_studio.annotate.merge_dialog import MergeDialog
from genmojo_studio.annotate.seed_dialog import SeedDialog
from genmojo_studio.translate import told, tr

if TYPE_CHECKING:
    from genmojo_studio.annotate.workspace import AnnotateWorkspace


class Dialogs:
    """The dialogs of one workspace; tests answer them through the widgets they open."""

    def __init__(self, workspace: AnnotateWorkspace) -> None:
        if workspace.session is None:
            raise RuntimeError("a session is needed before its dialogs can be made")
        self._w, self._s = workspace, workspace.session

    def seed(self) -> None:
        """Which tracker, which tracks; then it runs in the background."""
        self._seed_dialog().open()

    def solve_from_scene(self) -> None:
        """A scene is optimised and its tracks taken, without a question; the dialog tells how long, and cancels."""
        dialog = self._seed_dialog()
        dialog.open()
        dialog.solve_from_scene()

    def _seed_dialog(self) -> SeedDialog:
        dialog = SeedDialog(self._s, self._w.work, self._w)
        dialog.setAttribute(Qt.WidgetAttribute.WA_DeleteOnClose)
        return dialog

    def fix(self) -> None:
        """What is wrong, by a key from 1 to 6; the run marked, or this frame, is meant."""
        menu = QMenu(tr("What is wrong?"), self._w)
        for n, reason in enumerate(REASONS):
            menu.addAction(f"&{n + 1}  {told(reason)}")
        at = self._w.canvas.mapToGlobal(QPoint(self._w.canvas.width() // 2 - 80, self._w.canvas.height() // 3))
        chosen = menu.exec(at)
        if chosen is not None:
            self._w.review.needs_fix(menu.actions().index(chosen))

    def exchange(self, kind: Kind) -> None:
        """Swap, split or join the active track: with which point, in which frames; why not, where it cannot be."""
        why_not = hindrance(self._s, kind)
        if why_not:
            self._s.said.emit(why_not)
            return
        dialog = ExchangeDialog(self._s, kind, self._w)
        dialog.setAttribute(Qt.WidgetAttribute.WA_DeleteOnClose)
        dialog.open()
        dialog.beside(self._w.canvas)

    def checkpoint(self) -> None:
        """A name for what stands now."""
        name, given = QInputDialog.getText(self._w, tr("Name this moment"), tr("Name"))
        if given and name.strip() and self._try(lambda: self._s.project.checkpoint(name.strip()[:80])):
            self._s.said.emit(tr("Named: {name}").format(name=name))

    def history(self) -> None:
        """All states there ever were; the window stays usable beside it."""
        for old in self._w.findChildren(HistoryDialog):
            old.close()
        dialog = HistoryDialog(self._s, self._w)
        dialog.setAttribute(Qt.WidgetAttribute.WA_DeleteOnClose)
        dialog.show()

    def merge(self) -> None:
        """Compare with a second annotator's project, and merge it; a project both began from makes it three-way."""
        kinds = "GenMOJO (*.genmojo)"
        other, _ = QFileDialog.getOpenFileName(self._w, tr("The second annotator's project"), "", kinds)
        if not other:
            return
        start, _ = QFileDialog.getOpenFileName(self._w, tr("What both began from (cancel if there is none)"), "", kinds)

        def compare() -> None:
            mine, theirs = self._s.project.info, project_file.load(Path(other))
            base = project_file.load(Path(start)) if start else None
            doubt, against = project_file.clip_doubt(mine, theirs.info), theirs.info
            if not doubt and base is not None:
                doubt, against = project_file.clip_doubt(mine, base.info), base.info
            MergeDialog(self._s, theirs.annotation, base.annotation if base is not None else None, self._w, doubt,
                        *digests.differing(mine.sha256, against.sha256)).open()  # fmt: skip

        self._try(compare)

    def log(self) -> LogDialog:
        """Who did what, and how long it took."""
        dialog = LogDialog(self._s, self._w)
        dialog.setAttribute(Qt.WidgetAttribute.WA_DeleteOnClose)
        dialog.open()
        return dialog

    def check_log(self) -> None:
        """Whether the log is as it was written."""
        dialog = self.log()
        dialog.tabs.setCurrentWidget(dialog.audit)
        dialog.audit.check()

    def export_log(self) -> None:
        """The log as a table or JSON."""
        audit_panel.ask_export(self._s, self._w.work.tasks, self._w)

    def import_tracks(self) -> None:
        """Tracks of a file, into points where no person has spoken."""
        take_tracks.ask_import(self._w)

    def export_tracks(self) -> None:
        """Tracks into a file."""
        take_tracks.export_tracks(self._w)

    def _try(self, work: Callable[[], object]) -> bool:
        """Whether it worked; faults are told."""
        try:
            work()
        except GenmojoError as error:
            notify.tell(error, self._w)
            return False
        return True
