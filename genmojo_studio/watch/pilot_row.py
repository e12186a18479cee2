"""A pilot run before the real one: a line that says that it goes on, and a button that skips it."""

from __future__ import annotations

from pathlib import Path
from typing import Any

from PySide6.QtCore import Signal
from PySide6.QtWidgets import QPushButton, QSizePolicy, QWidget

from genmojo_studio.translate import tr
from genmojo_studio.watch.controls import dim, row
from genmojo_studio.watch.effects_process import EffectsProcess
from genmojo_studio.watch.forecast import spoken


class PilotRow(QWidget):
    """Hidden unless a pilot runs, in a process of its own.

    Signals: `told(dict)` with the `Forecast.to_json` that rests on the pilot.
    """

    told = Signal(dict)

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self.said = dim()
        self.skip = QPushButton(tr("Skip"))
        self.skip.setToolTip(tr("Decibels are then foretold from the clip's pixels alone."))
        self.skip.setSizePolicy(QSizePolicy.Policy.Fixed, QSizePolicy.Policy.Fixed)
        self.setLayout(row(self.said, self.skip, stretch=0))
        self._process = EffectsProcess(self)
        self._process.answered.connect(self._take)
        self._process.failed.connect(lambda _: self.hide())
        self.skip.clicked.connect(self.stop)
        self.hide()

    def start(self, clip: Path, preset: str, masks: Path | None, seconds: float) -> None:
        """Runs a pilot of the clip (with corrected masks), which should take so many seconds."""
        self.said.setText(
            tr("A pilot, the clip run small and short, takes about {time}, to foretell decibels better.").format(
                time=spoken(seconds)
            )
        )
        self.show()
        self._process.ask(clip, preset, masks, "--pilot")

    def stop(self) -> None:
        """Skips the pilot."""
        self._process.stop()
        self.hide()

    def close_process(self) -> None:
        """The window goes."""
        self._process.close()

    def _take(self, answer: dict[str, Any]) -> None:
        self.hide()
        if answer.get("forecast"):
            self.told.emit(dict(answer["forecast"]))
