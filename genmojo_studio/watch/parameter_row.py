"""Numbers of a run that may be changed while it goes on: learning rates, loss weights, budget, cadence."""

from __future__ import annotations

import math

from PySide6.QtWidgets import QComboBox, QHBoxLayout, QPushButton, QWidget

from genmojo_core.config import PRESETS
from genmojo_core.optimise.parameters import PARAMETERS
from genmojo_studio.translate import tr
from genmojo_studio.watch.controls import number
from genmojo_studio.watch.run_control import RunControl


class ParameterRow(QWidget):
    """A name, its value, a button. The change takes effect at the next step and is marked on the curves."""

    def __init__(self, control: RunControl, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self._control = control
        self.name = QComboBox()
        for parameter in PARAMETERS.values():
            self.name.addItem(parameter.name, parameter.name)
        self.name.setToolTip(tr("A number of the run; a change takes effect at the next step"))
        self.value = number(0, 1e9, "", 6, 0.01)
        self.button = QPushButton(tr("Set"))
        layout = QHBoxLayout(self)
        layout.setContentsMargins(0, 0, 0, 0)
        layout.addWidget(self.name, 1)
        layout.addWidget(self.value)
        layout.addWidget(self.button)
        self.name.currentIndexChanged.connect(self.refresh)
        self.button.clicked.connect(self._set)
        control.state_changed.connect(self.refresh)
        self.refresh()

    def refresh(self) -> None:
        """Shows the range and the value that the run began with, or has got since."""
        name = str(self.name.currentData())
        parameter = PARAMETERS[name]
        self.value.setRange(parameter.low, parameter.high if math.isfinite(parameter.high) else 1e9)
        self.value.setDecimals(0 if parameter.whole else 6)
        self.value.setValue(self._control.parameters.get(name, self._at_start(name)))
        self.setEnabled(self._control.live)

    def _at_start(self, name: str) -> float:
        """The value of the run's preset; 0 for one that presets do not have."""
        request = self._control.client.request
        preset = PRESETS[request.preset if request is not None else "standard"]
        if request is not None and name in request.changes:
            return float(request.changes[name])
        found: object = preset
        for part in name.split("."):
            found = getattr(found, part, 0.0)
        return float(found) if isinstance(found, int | float) and math.isfinite(found) else 0.0

    def _set(self) -> None:
        name = str(self.name.currentData())
        self._control.set_parameter(name, self.value.value())
