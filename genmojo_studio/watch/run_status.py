"""While a run goes on: its state, stages with the time left, buttons, the rule that ends it, and what it warned of."""

from __future__ import annotations

import math

from PySide6.QtCore import QSize, QTimer
from PySide6.QtWidgets import (
    QCheckBox,
    QFrame,
    QGridLayout,
    QHBoxLayout,
    QLabel,
    QProgressBar,
    QPushButton,
    QToolButton,
    QVBoxLayout,
    QWidget,
)

from genmojo_studio.actions import ActionTable
from genmojo_studio.icons import icon
from genmojo_studio.state import AppState
from genmojo_studio.translate import decimal, told, tr
from genmojo_studio.watch.controls import as_sentence, dim, number, row, set_role
from genmojo_studio.watch.forecast import spoken
from genmojo_studio.watch.parameter_row import ParameterRow
from genmojo_studio.watch.run_control import RunControl
from genmojo_studio.worker.death import DeathReport

_BUTTONS = (
    ("pause", "run.pause"),
    ("step", "run.step"),
    ("stage", "run.next_stage"),
    ("checkpoint", "run.checkpoint"),
    ("stop", "run.stop_keep"),
)


class RunStatus(QWidget):
    """Follows a `RunControl`; its buttons are the actions of the menu Run."""

    def __init__(
        self, state: AppState, actions: ActionTable, control: RunControl, parent: QWidget | None = None
    ) -> None:
        super().__init__(parent)
        self._state = state
        self._table = actions
        self._control = control
        self._buttons: dict[str, QToolButton] = {}
        self.state_label = QLabel()
        self.state_label.setProperty("role", "heading")
        self.progress = QProgressBar()
        self.progress.setRange(0, 1000)
        self.figures = dim()
        self.stages = QGridLayout()
        self._stage_rows: list[tuple[QLabel, QProgressBar, QLabel]] = []
        self.stop_rule = QCheckBox(tr("Stop when a minute buys less than"))
        self.stop_least = number(0.0, 5.0, " dB", 2, 0.05)
        self.stop_least.setValue(0.1)
        self.warnings = dim()
        self.banner, self.banner_text, self.resume_button = _banner()
        buttons = QHBoxLayout()
        for name, action_id in _BUTTONS:
            buttons.addWidget(self._button(name, action_id))
        buttons.addStretch()
        layout = QVBoxLayout(self)
        layout.setContentsMargins(0, 0, 0, 0)
        layout.addWidget(self.banner)
        layout.addWidget(self.state_label)
        layout.addLayout(buttons)
        layout.addWidget(self.progress)
        layout.addWidget(self.figures)
        layout.addLayout(self.stages)
        layout.addWidget(self.stop_rule)
        layout.addLayout(row(self.stop_least))
        layout.addWidget(dim(tr("Change while it runs")))
        layout.addWidget(ParameterRow(control))
        layout.addWidget(self.warnings)
        layout.addStretch()
        self._timer = QTimer(self)
        self._timer.setSingleShot(True)
        self._timer.setInterval(100)
        self._timer.timeout.connect(self._show_log)
        control.state_changed.connect(self.refresh)
        control.log_grew.connect(self._soon)
        control.died.connect(self.show_death)
        self.stop_rule.toggled.connect(self._take_rule)
        self.stop_least.valueChanged.connect(self._take_rule)
        state.subscribe(self.refresh, "theme")
        self.refresh()

    def refresh(self) -> None:
        """Shows the state that the worker last acknowledged."""
        control = self._control
        text, more = _state_text(control.state), told(control.phase) if control.live else _outcome(control.log.outcome)
        self.state_label.setText(f"{text} – {more}" if more and control.state not in ("failed", "") else text)
        for name, button in self._buttons.items():
            shown = "play" if name == "pause" and control.state == "paused" else name
            button.setIcon(icon(shown, self._state.theme))
            button.setEnabled(self._table.is_enabled(button.objectName()))
        if control.state in ("starting", "ready", "running"):
            self.banner.hide()
        self._show_log()

    def show_death(self, report: DeathReport) -> None:
        """Says why the worker is gone and what to do."""
        set_role(self.banner_text, "bad")
        self.banner_text.setText(f"{report.title}\n{report.advice}")
        self.banner_text.setToolTip(report.detail)
        self.resume_button.setVisible(report.checkpoint)
        self.banner.show()

    def _soon(self) -> None:
        if not self._timer.isActive():
            self._timer.start()

    def _show_log(self) -> None:
        log = self._control.log
        self.progress.setValue(round(log.progress * 1000))
        parts = []
        if log.step:
            parts.append(tr("step {step}, {count} Gaussians").format(step=len(log.step), count=log.gaussians[-1]))
            if self._control.live and math.isfinite(log.eta_seconds):
                parts.append(tr("{time} left").format(time=spoken(log.eta_seconds)))
        if log.accuracy:
            parts.append(f"{decimal(log.accuracy[-1][2], '.2f')} dB")
        if log.memory:
            parts.append(f"{log.memory[-1][1]:.0f} MB")
        if self._control.view_cost and self._control.live:
            parts.append(tr("the view costs {share:.1f} %").format(share=self._control.view_cost * 100))
        self.figures.setText("  ·  ".join(parts))
        warnings = [as_sentence(told(mark.text)) for mark in log.marks if mark.kind == "warning"]
        set_role(self.warnings, "warn")
        self.warnings.setText("\n".join(dict.fromkeys(warnings[-4:])))
        self._show_stages()

    def _show_stages(self) -> None:
        log = self._control.log
        while len(self._stage_rows) > len(log.stages):
            for part in self._stage_rows.pop():
                self.stages.removeWidget(part)
                part.deleteLater()
        for i, stage in enumerate(log.stages):
            if i == len(self._stage_rows):
                made = (QLabel(), QProgressBar(), QLabel())
                for column, widget in enumerate(made):
                    self.stages.addWidget(widget, i, column)
                self._stage_rows.append(made)
            name, bar, left = self._stage_rows[i]
            name.setText(told(stage.name))
            bar.setRange(0, max(stage.steps, 1))
            bar.setFormat(f"{stage.done} / {stage.steps}" if stage.steps else "")
            ended = stage.ended is not None
            bar.setValue(bar.maximum() if ended else min(stage.done, stage.steps))
            spent = (stage.ended if stage.ended is not None else max(log.now, stage.began)) - stage.began
            rest = spent / stage.done * (stage.steps - stage.done) if stage.done and not ended else math.nan
            left.setText(spoken(spent) if ended or math.isnan(rest) else tr("{time} left").format(time=spoken(rest)))
        self.stages.setColumnStretch(1, 1)

    def _take_rule(self) -> None:
        self._control.stop_below = self.stop_least.value() if self.stop_rule.isChecked() else None

    def _button(self, name: str, action_id: str) -> QToolButton:
        button = QToolButton()
        button.setObjectName(action_id)
        button.setIconSize(QSize(20, 20))
        keys = self._table.keys(action_id)
        text = tr(self._table[action_id].text)
        button.setToolTip(f"{text} ({keys[0]})" if keys else text)
        button.clicked.connect(lambda: self._table.trigger(action_id))
        self._buttons[name] = button
        return button


def _banner() -> tuple[QFrame, QLabel, QPushButton]:
    frame, text, button = QFrame(), QLabel(), QPushButton(tr("Resume from the checkpoint"))
    frame.setProperty("role", "banner")
    text.setWordWrap(True)
    layout = QVBoxLayout(frame)
    layout.addWidget(text)
    layout.addWidget(button)
    frame.hide()
    return frame, text, button


def _outcome(reason: str) -> str:
    """Why a run ended before its last step; "" where it did not."""
    return {
        "goal": tr("the goal is reached"),
        "budget": tr("the budget is used up"),
        "interrupted": tr("stopped early"),
    }.get(reason, "")


def _state_text(state: str) -> str:
    return {
        "": tr("No run"),
        "starting": tr("Starting"),
        "ready": tr("Preparing"),
        "running": tr("Running"),
        "paused": tr("Paused"),
        "stepping": tr("Stepping"),
        "stopping": tr("Stopping"),
        "finishing": tr("Writing the scene"),
        "done": tr("Done"),
        "failed": tr("Failed"),
        "lost": tr("No sign of life"),
    }.get(state, state)
