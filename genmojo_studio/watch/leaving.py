"""What becomes of a run when its window closes: it goes on alone, ends with its scene, ends without, or stays."""

from __future__ import annotations

import time

from PySide6.QtCore import QCoreApplication, QEventLoop
from PySide6.QtWidgets import QMessageBox, QWidget

from genmojo_studio.translate import tr
from genmojo_studio.watch.run_control import RunControl

_PATIENCE_SECONDS = 20.0


def may_leave(control: RunControl, parent: QWidget) -> bool:
    """Asks once if a run goes on, and does what was chosen; False keeps the window."""
    if not control.live:
        return True
    box = QMessageBox(parent)
    box.setIcon(QMessageBox.Icon.Question)
    box.setText(tr("A run is going on. What becomes of it?"))
    box.setInformativeText(tr("A run that goes on alone is listed on the start page; open it there to watch it again."))
    alone = box.addButton(tr("Let it go on"), QMessageBox.ButtonRole.AcceptRole)
    keep = box.addButton(tr("Stop and keep the scene"), QMessageBox.ButtonRole.DestructiveRole)
    discard = box.addButton(tr("Stop and throw it away"), QMessageBox.ButtonRole.DestructiveRole)
    box.addButton(QMessageBox.StandardButton.Cancel)
    box.setDefaultButton(alone)
    box.exec()
    chosen = box.clickedButton()
    if chosen is alone:
        control.detach()
        return True
    if chosen in (keep, discard):
        control.stop(chosen is keep)
        _wait(control)
        return True
    return False


def _wait(control: RunControl) -> None:
    """Until the worker has ended; after a while it is left to end alone."""
    until = time.monotonic() + _PATIENCE_SECONDS
    while control.live and time.monotonic() < until:
        QCoreApplication.processEvents(QEventLoop.ProcessEventsFlag.ExcludeUserInputEvents, 50)
    if control.live:
        control.detach()
