"""Before seeding: which tracker, which tracks, what it needs, what its licence says. While it runs: progress, cancel.

What a tracker finds is a proposal: places and states that a person gave are never overwritten.
"""

from __future__ import annotations

import datetime
from collections.abc import Callable
from pathlib import Path

from PySide6.QtCore import QUrl
from PySide6.QtGui import QDesktopServices
from PySide6.QtWidgets import (
    QButtonGroup,
    QCheckBox,
    QComboBox,
    QDialog,
    QDialogButtonBox,
    QFileDialog,
    QFormLayout,
    QHBoxLayout,
    QLabel,
    QLineEdit,
    QProgressBar,
    QPushButton,
    QRadioButton,
    QSpinBox,
    QVBoxLayout,
    QWidget,
)

from genmojo_core.errors import GenmojoError
from genmojo_core.store.npz import write_tracks
from genmojo_core.trackers import seeding
from genmojo_core.trackers.cotracker import WINDOWS, machine_gib
from genmojo_core.tracks.supervision import said_by_people
from genmojo_studio.annotate import hand_masks
from genmojo_studio.annotate.scene_job import SUFFIX, Forecast, SceneJob
from genmojo_studio.annotate.session import Session
from genmojo_studio.annotate.work import Work
from genmojo_studio.settings import Settings
from genmojo_studio.translate import decimal, fault, tr

MINUTES = (1, 2, 5, 10)
_TERMS = "https://creativecommons.org/licenses/by-nc/4.0/"


class SeedDialog(QDialog):
    """Asks, starts, shows how far it is; closing it while it runs cancels."""

    def __init__(self, session: Session, work: Work, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self._session, self._work, self._settings = session, work, Settings()
        self.job: SceneJob | None = None
        self._expected = Forecast(0.0, 1.0)
        self.setWindowTitle(tr("Seed tracks"))
        self.setMinimumWidth(500)
        self._column = column = QVBoxLayout(self)
        self._trackers, self._scope = QButtonGroup(self), QButtonGroup(self)
        self.options: dict[str, QWidget] = {}
        for n, (title, about, make) in enumerate(self._choices()):
            self._add(column, n, (title, about), make())
        column.addSpacing(6)
        scope = QHBoxLayout()
        for n, title in enumerate((tr("all objects"), tr("the active object only"))):
            button = QRadioButton(title)
            button.setChecked(n == 0)
            self._scope.addButton(button, n)
            scope.addWidget(button)
        self.active_only = self._scope.button(1)
        scope.addStretch()
        column.addLayout(scope)
        self.note = QLabel(tr("Your keys, accepted places and painted states stay as they are."), wordWrap=True)
        column.addWidget(self.note)
        self.progress = QProgressBar()
        self.progress.setMaximum(100)
        self.progress.hide()
        column.addWidget(self.progress)
        self.buttons = QDialogButtonBox(QDialogButtonBox.StandardButton.Cancel)
        self.start = self.buttons.addButton(tr("Seed"), QDialogButtonBox.ButtonRole.ActionRole)
        self.start.setDefault(True)
        column.addWidget(self.buttons)
        self.start.clicked.connect(self._start)
        self.buttons.rejected.connect(self.reject)
        self._trackers.idClicked.connect(self._show_options)
        work.tracker.progressed.connect(self._progressed)
        work.tracker.seeded.connect(self._seeded)
        session.said.connect(self.note.setText)  # a window-modal dialog hides what the status line says
        self._show_options(0)

    def choice(self) -> str:
        """Name of the tracker chosen, one of `seeding.NAMES`."""
        return seeding.NAMES[self._trackers.checkedId()]

    def choose(self, name: str) -> None:
        """Tick a tracker."""
        self._trackers.button(seeding.NAMES.index(name)).setChecked(True)
        self._show_options(seeding.NAMES.index(name))

    def objects(self) -> list[int]:
        """Ids of the objects to seed."""
        return [o.id for o in self._session.objects()] if self._scope.checkedId() == 0 else [self._session.active[0]]

    def solve_from_scene(self) -> None:
        """Begin at once: optimise a scene for the time chosen last, and take its tracks."""
        self.choose("scene")
        self._start()

    def reject(self) -> None:
        """Close; what runs is cancelled."""
        self._work.tracker.cancel()
        if self.job is not None:
            self.job.cancel()
        super().reject()

    # ---- what is asked

    def _choices(self) -> list[tuple[str, str, Callable[[], QWidget]]]:
        """Title, explanation and options of every tracker, in the order of `seeding.NAMES`."""
        return [
            (tr("Optical (built in)"), tr("Follows the points inside their masks by flow and matching, from both ends "
             "between your keys."), QWidget),
            (tr("Solve from scene"), tr("Optimises a 4D scene that follows what you placed so far and takes its "
             "tracks, which go on behind what hides them."), self._scene_options),
            (tr("CoTracker (yours)"), tr("A checkout and weights that you have. CC BY-NC 4.0: no commercial use. It "
             "runs in a process of its own."), self._cotracker_options),
            (tr("From a file"), tr("Tracks of this clip that somebody made before: TAP-Vid, CoTracker or ours (npz)."),
             self._file_options),
        ]  # fmt: skip

    def _add(self, column: QVBoxLayout, n: int, texts: tuple[str, str], options: QWidget) -> None:
        button = QRadioButton(texts[0])
        button.setChecked(n == 0)
        self._trackers.addButton(button, n)
        column.addWidget(button)
        label = QLabel(texts[1], wordWrap=True)
        label.setProperty("role", "dim")
        label.setContentsMargins(24, 0, 0, 2)
        column.addWidget(label)
        options.setContentsMargins(24, 0, 0, 4)
        self.options[seeding.NAMES[n]] = options
        column.addWidget(options)

    def _scene_options(self) -> QWidget:
        inside = QWidget()
        form = QFormLayout(inside)
        self.minutes = QComboBox()
        for minutes in MINUTES:
            ready = decimal(self._forecast(60.0 * minutes).whole / 60, ".1f")
            self.minutes.addItem(
                tr("{n} min of optimising, ready in about {m} min").format(n=minutes, m=ready), minutes
            )
        for title, path in self._scenes_there():
            self.minutes.addItem(title, str(path))
        last = self.minutes.findData(int(self._settings.text("seed/minutes", "1")))
        self.minutes.setCurrentIndex(max(last, 0))
        self.scene = _PathLine(tr("or a scene of this clip that exists"), "scene.h5 (*.h5)")
        form.addRow(tr("Time"), self.minutes)
        form.addRow(tr("Scene"), self.scene)
        return inside

    def _forecast(self, seconds: float) -> Forecast:
        return Forecast.of(seconds, self._session.annotation)

    def _scenes_there(self) -> list[tuple[str, Path]]:
        """Scenes of this clip that can be taken at once: this project's last one, the one on show in Watch."""
        last, shown = self._session.project.path.with_suffix(SUFFIX), self._session.state.scene_path
        there = [(tr("the last scene of this project, at once"), last)]
        if shown is not None and shown.suffix == ".h5" and self._session.state.clip_path == self._clip_path:
            there.append((tr("the scene on show in Watch, at once"), shown))
        return [(title, path) for title, path in there if path.is_file()]

    @property
    def _clip_path(self) -> Path:
        return Path(self._session.project.info.path)

    def _cotracker_options(self) -> QWidget:
        inside = QWidget()
        form = QFormLayout(inside)
        self.origin = QComboBox()
        self.origin.addItem(tr("a folder of mine"), "")
        self.origin.addItem(tr("CoTracker 3, downloaded by torch.hub"), "hub:cotracker3_offline")
        self.origin.addItem(tr("CoTracker 2, downloaded by torch.hub"), "hub:cotracker2")
        self.checkout = _PathLine(tr("folder of CoTracker's source"), "", self._settings.text("cotracker/checkout"))
        self.weights = _PathLine(tr("its weights (.pth)"), "*.pth", self._settings.text("cotracker/weights"))
        self.consent = QCheckBox(tr("I have read its licence, and this use is not commercial"))
        self.download = QCheckBox(tr("Its code and weights may be downloaded and run"))
        form.addRow(tr("From"), self.origin)
        form.addRow(tr("Source"), self.checkout)
        form.addRow(tr("Weights"), self.weights)
        self.at_once = QSpinBox(minimum=WINDOWS[0], maximum=WINDOWS[1], suffix=tr(" frames"))
        self.memory = QSpinBox(minimum=1, maximum=4096, suffix=tr(" GiB"))
        self.at_once.setValue(int(self._settings.text("cotracker/window", "64")))
        self.memory.setValue(int(self._settings.text("cotracker/memory", f"{0.8 * machine_gib():.0f}")))
        form.addRow(tr("At once"), self.at_once)
        form.addRow(tr("Memory"), self.memory)
        licence = QPushButton(tr("Its licence: CC BY-NC 4.0…"))
        licence.clicked.connect(lambda: QDesktopServices.openUrl(QUrl(_TERMS)))
        form.addRow(licence)
        form.addRow(self.download)
        form.addRow(self.consent)
        self.consent.setChecked(bool(self._settings.text("cotracker/licence")))

        def show_origin() -> None:
            hub = bool(self.origin.currentData())
            for widget, on in ((self.checkout, not hub), (self.weights, not hub), (self.download, hub)):
                form.setRowVisible(widget, on)

        self.origin.currentIndexChanged.connect(show_origin)
        show_origin()
        return inside

    def _file_options(self) -> QWidget:
        inside = QWidget()
        form = QFormLayout(inside)
        self.file = _PathLine(tr("npz file"), "npz (*.npz)")
        form.addRow(tr("File"), self.file)
        return inside

    def _show_options(self, chosen: int) -> None:
        for n, name in enumerate(seeding.NAMES):
            self.options[name].setVisible(n == chosen and name != "optical")
        self._fit()

    # ---- what is done

    def _start(self) -> None:
        try:
            started = self._begin(self.choice())
        except GenmojoError as error:
            self.note.setText(fault(error))
            return
        if started:
            self._show_running(True)

    def _show_running(self, on: bool) -> None:
        """While it runs nothing can be chosen; when it failed, everything can again."""
        self.progress.setVisible(on)
        for widget in (self.start, *self._trackers.buttons(), *self._scope.buttons(), *self.options.values()):
            widget.setEnabled(not on)
        self._fit()

    def _fit(self) -> None:
        """As high as what is on show needs: lines that wrap need more than a layout asks for by itself."""
        self._column.activate()
        self.resize(self.width(), max(self._column.totalHeightForWidth(self.width()), self.sizeHint().height()))

    def _begin(self, name: str) -> bool:
        """Start what was chosen; False (with a sentence) where something is missing. Raises GenmojoError."""
        tracker = self._work.tracker
        if name == "optical":
            return tracker.seed(self.objects())
        if name == "scene":
            path = self.scene.text() or str(self.minutes.currentData())
            made = seeding.make("scene", path) if path.endswith(".h5") else None
            return tracker.seed_by(made, self.objects()) if made is not None else self._optimise()
        if name == "file":
            return tracker.seed_by(seeding.make("file", self.file.text() or None), self.objects())
        if not self.consent.isChecked():
            self.note.setText(tr("CoTracker's licence has to be agreed to first."))
            return False
        return tracker.seed_by(self._cotracker(), self.objects())

    def _cotracker(self) -> seeding.Seeder:
        """CoTracker as it was chosen; what was chosen and agreed to is remembered. Raises GenmojoError."""
        self._settings.put("cotracker/licence", datetime.date.today().isoformat())
        limits = {"window": str(self.at_once.value()), "memory": str(self.memory.value())}
        for key, text in limits.items():
            self._settings.put(f"cotracker/{key}", text)
        hub = str(self.origin.currentData())
        if hub:
            return seeding.make("cotracker", hub, consent="yes" if self.download.isChecked() else "", **limits)
        self._settings.put("cotracker/checkout", self.checkout.text())
        self._settings.put("cotracker/weights", self.weights.text())
        return seeding.make("cotracker", self.checkout.text() or None, checkpoint=self.weights.text(), **limits)

    def _optimise(self) -> bool:
        """Optimise a scene from what people said: points placed and accepted, masks cut out by hand."""
        session = self._session
        if session.clip is None or not any(len(i) for i in map(session.annotation.keys, session.annotation.tracks)):
            self.note.setText(
                tr("The clip is still being read.") if session.clip is None else tr("Place points first.")
            )
            return False
        output = session.project.path.with_suffix(SUFFIX)
        said, given = said_by_people(session.annotation), {}
        if said is not None:
            given["--tracks"] = output.with_suffix(".tracks.npz")
            write_tracks(said, given["--tracks"])
        if session.hand_masks and session.clip is not None:
            given["--masks"] = hand_masks.publish(session.clip, session.project.path)
        minutes = float(self.minutes.currentData())
        self._settings.put("seed/minutes", f"{minutes:.0f}")
        self._expected = self._forecast(60.0 * minutes)
        self.job = SceneJob(self._clip_path, output, 60.0 * minutes, self._expected.optimise, given, self)
        self.job.progressed.connect(self._optimised)
        self.job.finished.connect(self._scene_ready)
        self.job.failed.connect(self._failed)
        self.job.start()
        ready = decimal(self._expected.whole / 60, ".1f")
        self.note.setText(tr("Optimising; ready in about {m} min. You can close this to cancel.").format(m=ready))
        return True

    def _scene_ready(self, path: str) -> None:
        self.note.setText(tr("Following the points through the scene …"))
        if not self._work.tracker.seed_by(seeding.make("scene", path), self.objects()):
            self._show_running(False)

    def _failed(self, sentence: str) -> None:
        self._show_running(False)
        self.note.setText(sentence)

    def _optimised(self, share: float) -> None:
        """Share of the optimisation, which is the first part of the whole."""
        self._show_share(share * self._expected.optimise / self._expected.whole)

    def _progressed(self, share: float) -> None:
        """Share of the tracking, which is the whole or its last part."""
        before = 0.0 if self.job is None else self._expected.optimise / self._expected.whole
        self._show_share(before + (1.0 - before) * share)

    def _show_share(self, share: float) -> None:
        self.progress.setValue(round(100 * share))

    def _seeded(self, tracks: int) -> None:
        if not self.progress.isVisible():
            return
        if tracks:
            self.accept()
        else:
            self._show_running(False)  # why has been said


class _PathLine(QWidget):
    """A path to type or to choose; without a filter a folder is meant."""

    def __init__(self, hint: str, kinds: str, path: str = "") -> None:
        super().__init__()
        self._kinds = kinds
        self.line = QLineEdit(path, placeholderText=hint)
        self.line.setAccessibleName(hint)
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
