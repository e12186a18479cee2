"""Before a run: preset, budget, device, effects with their evidence, and what it will take."""

from __future__ import annotations

from dataclasses import asdict, replace
from typing import Any

from PySide6.QtCore import Qt, QTimer, Signal
from PySide6.QtWidgets import QCheckBox, QComboBox, QFormLayout, QPushButton, QSizePolicy, QVBoxLayout, QWidget

from genmojo_core.clip.clip import Clip
from genmojo_core.clip.resize import fitted
from genmojo_core.config import PRESETS, RunConfig
from genmojo_core.effects.auto import AUTO_SECONDS, for_budget
from genmojo_core.effects.costs import run_sizes
from genmojo_core.effects.difficulty import Difficulty
from genmojo_core.effects.forecast import Forecast, foretold, work_of
from genmojo_core.effects.machine import known_costs
from genmojo_studio.state import AppState
from genmojo_studio.translate import told, tr
from genmojo_studio.watch import forecast
from genmojo_studio.watch.controls import as_sentence, dim, number, set_role
from genmojo_studio.watch.effects_table import EffectsTable
from genmojo_studio.watch.pilot_row import PilotRow
from genmojo_studio.watch.run_log import RunLog
from genmojo_studio.worker.protocol import RunRequest

_NO_LIMIT = 1e9  # seconds: JSON knows no infinity
AUTO = "auto"
_LEAST_AUTO = 10  # seconds
_DEVICES = ("auto", "cpu", "cuda")


class RunSetup(QWidget):
    """The form of a new run. `start_wanted` when its button is pressed."""

    start_wanted = Signal()

    def __init__(self, state: AppState, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self._state = state
        self._measured_for: tuple[object, ...] | None = None
        self._asked: Forecast | None = None  # what was expected of the run that was asked for last
        self._came = ""
        self.preset = QComboBox()
        texts = (tr("Draft"), tr("Standard"), tr("Full (as the paper)"), tr("Best for the budget"))
        for name, text in zip((*PRESETS, AUTO), texts, strict=True):
            self.preset.addItem(text, name)
        about = tr("Size, Gaussians and pace are chosen so that the budget buys most.")
        self.preset.setItemData(self.preset.findData(AUTO), about, Qt.ItemDataRole.ToolTipRole)
        self.budget = number(0, 86400, " s", 0, 10)
        self.budget.setToolTip(tr("The run ends after this time with what it has."))
        self.device = QComboBox()
        for name, text in zip(_DEVICES, (tr("Automatic"), tr("Processor"), tr("Graphics card (CUDA)")), strict=True):
            self.device.addItem(text, name)
        self.annotated = QCheckBox(tr("Follow the annotated points"))
        self.annotated.setChecked(True)
        self.annotated.setToolTip(tr("What people placed or accepted in this clip leads the scene."))
        self.effects = EffectsTable()
        self.effects.setMinimumHeight(150)
        self.effects.setSizePolicy(QSizePolicy.Policy.Expanding, QSizePolicy.Policy.Expanding)
        self.said = dim()
        self.pilot = PilotRow()
        self.start_button = QPushButton(tr("Start"))
        self.start_button.setDefault(True)
        form = QFormLayout()
        form.setFieldGrowthPolicy(QFormLayout.FieldGrowthPolicy.AllNonFixedFieldsGrow)
        form.addRow(tr("Preset"), self.preset)
        form.addRow(tr("Budget"), self.budget)
        form.addRow(tr("Device"), self.device)
        form.addRow(self.annotated)
        self._form = form
        layout = QVBoxLayout(self)
        layout.setContentsMargins(0, 0, 0, 0)
        layout.addLayout(form)
        layout.addWidget(self.effects, 1)
        layout.addWidget(self.said)
        layout.addWidget(self.pilot)
        layout.addWidget(self.start_button)
        self._connect()
        self._take_preset()

    def _connect(self) -> None:
        self.preset.activated.connect(self._take_preset)
        self.budget.valueChanged.connect(self._tell)
        self.effects.measured.connect(self._tell)
        self.effects.measured.connect(self._send_pilot)
        self.pilot.told.connect(self._piloted)
        self.effects.changed.connect(self._tell)
        self.effects.failed.connect(self._measuring_failed)
        self.start_button.clicked.connect(self.start_wanted)
        self._state.subscribe(self.refresh, "clip", "clip_path", "masks_path", "project_path")

    def refresh(self) -> None:
        """Another clip or preset: measures its effects once the panel is on show."""
        path, project = self._state.clip_path, self._state.project_path
        self._form.setRowVisible(self.annotated, project is not None)
        self.start_button.setEnabled(path is not None)
        if path is None:
            self.said.setText(tr("Open a clip to start a run."))
            return
        preset, masks = self._preset, self._state.masks_path
        edited = masks.stat().st_mtime_ns if masks is not None and masks.exists() else 0
        wanted = (path, preset, edited)
        if self.isVisible() and wanted != self._measured_for:
            self._measured_for = wanted
            self.pilot.stop()
            self.effects.clear()
            self.effects.rows = []
            self._say(tr("Measuring what the clip calls for …"), "dim")
            self.effects.measure(path, preset, masks)

    def showEvent(self, event: object) -> None:
        """Nothing is measured while the panel is hidden."""
        QTimer.singleShot(0, self.refresh)

    def config(self) -> RunConfig:
        """The preset with the budget of the form, or what gives most in that budget."""
        clip = self._state.clip
        if self._is_auto and clip is not None:
            return for_budget(self._budget(), clip)
        return replace(PRESETS.get(self._preset, PRESETS["draft"]), budget_seconds=self._budget())

    def request(self) -> RunRequest | None:
        """What to ask the worker for; None without a clip."""
        if self._state.clip_path is None:
            return None
        self.pilot.stop()
        self._asked, self._came = self._foretold(self._state.clip), ""
        changes = {"budget_seconds": self._budget(), "device": str(self.device.currentData())}
        return RunRequest(
            clip=str(self._state.clip_path),
            preset="draft" if self._is_auto else self._preset,
            changes=self._chosen() | changes,
            effects=self.effects.overrides(),
            look_at=self._state.frame,
            masks=str(self._state.masks_path or ""),
            tracks=str(self._state.project_path or "") if self.annotated.isChecked() else "",
        )

    def close_processes(self) -> None:
        """The window goes: nothing is measured any more."""
        self.effects.close_process()
        self.pilot.close_process()

    def came(self, log: RunLog) -> None:
        """A run has ended: its effects' costs, and what was expected of it beside what came, if anything was."""
        self.effects.show_costs(known_costs())
        if self._asked is None or not log.accuracy:
            return
        self._came = tr(
            "The last run: expected {time} and {psnr:.1f} dB, took {took}, {got:.1f} dB on pixels that were held out."
        ).format(
            time=forecast.spoken(self._asked.seconds),
            psnr=self._asked.decibel,
            took=forecast.spoken(log.now),
            got=log.accuracy[-1][2],
        )
        self._asked = None
        self._tell()

    @property
    def _preset(self) -> str:
        return str(self.preset.currentData())

    @property
    def _is_auto(self) -> bool:
        return self._preset == AUTO

    def _chosen(self) -> dict[str, Any]:
        """What the choice for a budget changes in a draft; {} for the other presets."""
        if not self._is_auto:
            return {}
        draft = asdict(PRESETS["draft"])
        return {name: value for name, value in asdict(self.config()).items() if value != draft[name]}

    def _budget(self) -> float:
        return self.budget.value() if self.budget.value() >= 1 else _NO_LIMIT

    def _take_preset(self) -> None:
        budget = AUTO_SECONDS if self._is_auto else PRESETS[self._preset].budget_seconds
        self.budget.setMinimum(_LEAST_AUTO if self._is_auto else 0)
        self.budget.setSpecialValueText("" if self._is_auto else tr("no limit"))
        self.budget.setValue(budget if budget < 86400 else 0)
        self.refresh()

    def _tell(self) -> None:
        clip = self._state.clip
        if clip is None or not self.effects.rows:
            return
        needed = self._forecast(clip)
        text = self._expected(clip) + tr("about {mb:.1f} GB of memory.").format(mb=needed.megabytes / 1000)
        if needed.too_large:
            text += " " + tr("That is more than this machine has free: choose a smaller preset.")
        edited = [tr("The run uses the masks that were corrected here.")] if self._state.masks_path else []
        came = [self._came] if self._came else []
        guesses = [as_sentence(told(guess)) for guess in self.effects.guesses]
        self._say("\n".join([text, *came, *edited, *guesses]), "bad" if needed.too_large else "dim")

    def _send_pilot(self) -> None:
        """Where a pilot is worth its time, it begins as soon as the effects are known."""
        path, seconds = self._state.clip_path, self.effects.pilot_seconds
        if path is not None and seconds is not None:
            self.pilot.start(path, self._preset, self._state.masks_path, seconds)

    def _piloted(self, expected: dict[str, Any]) -> None:
        self.effects.expected = expected
        self._tell()

    def _expected(self, clip: Clip) -> str:
        """Seconds and dB to expect, in words; "" before they are known."""
        expected = self._foretold(clip)
        if expected is None:
            return ""
        said = (
            tr("Expected: {time} (± {spread}), {psnr:.1f} dB (± {error:.1f}), ")
            if expected.clip.reached is None
            else tr("Expected: {time} (± {spread}), {psnr:.1f} dB (± {error:.1f}, from a pilot run), ")
        )
        return said.format(
            time=forecast.spoken(expected.seconds),
            spread=forecast.spoken(expected.seconds_error),
            psnr=expected.decibel,
            error=expected.decibel_error,
        )

    def _foretold(self, clip: Clip | None) -> Forecast | None:
        """What to expect with the budget and the effects as they are chosen now; None before it is known."""
        basis = self.effects.expected
        if not basis or clip is None:
            return None
        config = self.config()
        chosen = [row for row in self.effects.chosen() if row["on"]]
        on, rigid = [row["name"] for row in chosen], max((len(row.get("spared", ())) for row in chosen), default=0)
        size, window = fitted(clip.source_size, config.short_side), basis.get("window")
        work = work_of(size, len(clip), clip.objects, on, config, window, rigid)
        return foretold(work, Difficulty(**basis["clip"]), config, float(basis["factor"]))

    def _forecast(self, clip: Clip) -> forecast.Forecast:
        config = self.config()
        share = next((row["evidence"] / 100 for row in self.effects.rows if row["name"] == "background"), 0.0)
        sizes = run_sizes(clip.source_size, len(clip), clip.objects, share, config)
        return forecast.forecast(self.effects.chosen(), sizes, config)

    def _measuring_failed(self, sentence: str) -> None:
        self._measured_for = None
        self._say(sentence, "bad")

    def _say(self, text: str, role: str) -> None:
        self.said.setText(text)
        set_role(self.said, role)
