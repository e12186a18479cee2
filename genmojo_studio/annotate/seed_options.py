"""What trackers need to know, as widgets of the seed dialog: paths, and all of CoTracker."""

from __future__ import annotations

import datetime
from pathlib import Path

from PySide6.QtCore import QUrl, Signal
from PySide6.QtGui import QDesktopServices
from PySide6.QtWidgets import (
    QCheckBox,
    QComboBox,
    QFileDialog,
    QFormLayout,
    QHBoxLayout,
    QLineEdit,
    QPushButton,
    QSpinBox,
    QWidget,
)

from genmojo_core.trackers import seeding
from genmojo_core.trackers.cotracker import HUB, HUB_MODELS, WINDOWS, machine_gib
from genmojo_studio.settings import Settings
from genmojo_studio.translate import tr

_TERMS = "https://creativecommons.org/licenses/by-nc/4.0/"


class PathLine(QWidget):
    """A path to type or to choose; without a filter a folder is meant."""

    changed = Signal()

    def __init__(self, hint: str, kinds: str, path: str = "") -> None:
        super().__init__()
        self._kinds = kinds
        self.line = QLineEdit(path, placeholderText=hint)
        self.line.setAccessibleName(hint)
        self.line.textChanged.connect(self.changed)
        button = QPushButton("…")
        button.setAccessibleName(tr("Choose"))
        button.setFixedWidth(32)
        button.clicked.connect(self._choose)
        row = QHBoxLayout(self)
        row.setContentsMargins(0, 0, 0, 0)
        row.addWidget(self.line)
        row.addWidget(button)

    def text(self) -> str:
        """The path, "" if there is none."""
        return self.line.text().strip()

    def _choose(self) -> None:
        if self._kinds:
            chosen, _ = QFileDialog.getOpenFileName(self, self.line.placeholderText(), self.text(), self._kinds)
        else:
            chosen = QFileDialog.getExistingDirectory(self, self.line.placeholderText(), self.text())
        if chosen:
            self.line.setText(chosen)


class CoTrackerOptions(QWidget):
    """Where CoTracker and its weights come from, what it may take, and that its licence was agreed to."""

    changed = Signal()

    def __init__(self, settings: Settings) -> None:
        super().__init__()
        self._settings = settings
        self.origin = QComboBox()
        self.origin.addItem(tr("a folder of mine"), "")
        for name in HUB_MODELS:
            self.origin.addItem(tr("{name}, downloaded by torch.hub").format(name=name), HUB + name)
        self.checkout = PathLine(tr("folder of CoTracker's source"), "", settings.text("cotracker/checkout"))
        self.weights = PathLine(tr("its weights (.pth)"), "*.pth", settings.text("cotracker/weights"))
        self.consent = QCheckBox(tr("I have read its licence, and this use is not commercial"))
        self.consent.setChecked(bool(settings.text("cotracker/licence")))
        self.download = QCheckBox(tr("Its code and weights may be downloaded and run"))
        self.at_once = QSpinBox(minimum=WINDOWS[0], maximum=WINDOWS[1], suffix=tr(" frames"))
        self.memory = QSpinBox(minimum=1, maximum=4096, suffix=tr(" GiB"))
        self.at_once.setValue(int(settings.text("cotracker/window", "64")))
        self.memory.setValue(int(settings.text("cotracker/memory", f"{0.8 * machine_gib():.0f}")))
        self._form = form = QFormLayout(self)
        form.addRow(tr("From"), self.origin)
        form.addRow(tr("Source"), self.checkout)
        form.addRow(tr("Weights"), self.weights)
        form.addRow(tr("At once"), self.at_once)
        form.addRow(tr("Memory"), self.memory)
        licence = QPushButton(tr("Its licence: CC BY-NC 4.0…"))
        licence.clicked.connect(lambda: QDesktopServices.openUrl(QUrl(_TERMS)))
        form.addRow(licence)
        form.addRow(self.download)
        form.addRow(self.consent)
        self.origin.currentIndexChanged.connect(self._show_origin)
        for signal in (self.origin.currentIndexChanged, self.weights.changed, self.at_once.valueChanged):
            signal.connect(self.changed)
        self._show_origin()

    def kind(self) -> str:
        """Which CoTracker it is, for what is known of its speed."""
        return f"cotracker:{self._hub()[len(HUB) :] or Path(self.weights.text()).stem}"

    def seeder(self) -> seeding.Seeder:
        """CoTracker as it was chosen; what was chosen and agreed to is remembered. Raises GenmojoError."""
        self._settings.put("cotracker/licence", datetime.date.today().isoformat())
        limits = {"window": str(self.at_once.value()), "memory": str(self.memory.value())}
        for key, text in limits.items():
            self._settings.put(f"cotracker/{key}", text)
        hub = self._hub()
        if hub:
            return seeding.make("cotracker", hub, consent="yes" if self.download.isChecked() else "", **limits)
        self._settings.put("cotracker/checkout", self.checkout.text())
        self._settings.put("cotracker/weights", self.weights.text())
        return seeding.make("cotracker", self.checkout.text() or None, checkpoint=self.weights.text(), **limits)

    def _hub(self) -> str:
        """ "hub:NAME", "" for a folder."""
        return str(self.origin.currentData())

    def _show_origin(self) -> None:
        hub = bool(self._hub())
        for widget, on in ((self.checkout, not hub), (self.weights, not hub), (self.download, hub)):
            self._form.setRowVisible(widget, on)
