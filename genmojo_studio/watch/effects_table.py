"""What a clip calls for: each effect with its measured number, threshold, reason and cost, and a box to override it."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

from PySide6.QtCore import Qt, Signal
from PySide6.QtGui import QFont
from PySide6.QtWidgets import QHeaderView, QTreeWidget, QTreeWidgetItem, QWidget

from genmojo_core.effects.texts import sentence
from genmojo_studio.translate import decimal, tr
from genmojo_studio.watch.effects_process import EffectsProcess

_AS_WIDE = QHeaderView.ResizeMode.ResizeToContents
_NAME = Qt.ItemDataRole.UserRole


class EffectsTable(QTreeWidget):
    """Measures in a process of its own, so that the window never waits.

    Signals: `measured` when the table is filled, `failed(sentence)`, `changed` when a box was ticked.
    """

    measured = Signal()
    failed = Signal(str)
    changed = Signal()

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self.setHeaderLabels([tr("Effect"), tr("Evidence"), tr("Cost")])
        self.setRootIsDecorated(False)
        self.setUniformRowHeights(True)
        self.header().setStretchLastSection(False)
        for column, how in enumerate((_AS_WIDE, QHeaderView.ResizeMode.Stretch, _AS_WIDE)):
            self.header().setSectionResizeMode(column, how)
        self.rows: list[dict[str, Any]] = []
        self.guesses: list[str] = []
        self.frames = 0
        self.expected: dict[str, Any] = {}  # `Forecast.to_json` for the preset that was measured
        self.pilot_seconds: float | None = None  # that a pilot of the clip would take, where one is worth it
        self._process = EffectsProcess(self)
        self._process.answered.connect(self._take)
        self._process.failed.connect(self.failed)
        self.itemChanged.connect(self._ticked)

    def measure(self, clip: Path, preset: str, masks: Path | None = None) -> None:
        """Asks what the clip (with corrected masks) calls for under a preset; an older question is dropped."""
        self._process.ask(clip, preset, masks)

    def close_process(self) -> None:
        """The window goes: nothing is measured any more."""
        self._process.close()

    def show_rows(self, rows: Sequence[Mapping[str, Any]]) -> None:
        """Fills the table with rows of `EffectPlan.to_json`."""
        self.rows = [dict(row) for row in rows]
        self.blockSignals(True)
        self.clear()
        for row in self.rows:
            self.addTopLevelItem(_item(row))
        self.blockSignals(False)

    def show_costs(self, known: Mapping[str, Mapping[str, Any]]) -> None:
        """Effects have been measured since: `machine.known_costs()`; boxes stay as they are ticked."""
        rows = [{**row, "known": known.get(str(row["name"]))} for row in self.rows]
        ticked = [self._ticked_at(i) for i in range(len(rows))]
        self.show_rows(rows)
        for item, on in zip(map(self.topLevelItem, range(len(rows))), ticked, strict=True):
            if item is not None:
                item.setCheckState(0, Qt.CheckState.Checked if on else Qt.CheckState.Unchecked)

    def chosen(self) -> list[dict[str, Any]]:
        """The rows with `on` as the boxes say."""
        return [{**row, "on": self._ticked_at(i)} for i, row in enumerate(self.rows)]

    def overrides(self) -> dict[str, bool]:
        """Effects whose box differs from what the evidence says."""
        wanted = ((row, self._ticked_at(i)) for i, row in enumerate(self.rows))
        return {str(row["name"]): on for row, on in wanted if on != bool(row["on"])}

    def _ticked_at(self, row: int) -> bool:
        item = self.topLevelItem(row)
        return item is not None and item.checkState(0) == Qt.CheckState.Checked

    def _ticked(self, item: QTreeWidgetItem) -> None:
        row = next(row for row in self.rows if row["name"] == item.data(0, _NAME))
        font = QFont(self.font())
        font.setBold((item.checkState(0) == Qt.CheckState.Checked) != bool(row["on"]))
        self.blockSignals(True)
        item.setFont(0, font)
        self.blockSignals(False)
        self.changed.emit()

    def _take(self, answer: dict[str, Any]) -> None:
        self.guesses = [str(sentence) for sentence in answer.get("guesses", [])]
        self.frames = int(answer.get("frames", 0))
        self.expected = dict(answer.get("forecast") or {})
        self.pilot_seconds = answer.get("pilot_seconds")
        self.show_rows(answer["effects"])
        self.measured.emit()


def _item(row: Mapping[str, Any]) -> QTreeWidgetItem:
    unit, bound = tr(str(row["unit"])), f"{row['threshold']:.3g}"
    evidence = f"{decimal(row['evidence'], '.3g')} {unit}"
    sign = "≥" if row["evidence"] >= row["threshold"] else "<"
    known = row.get("known")
    cost = (
        f"{decimal(known['ms'], '.1f')} ms" if known and "ms" in known else f"≈ {decimal(row['ms_per_step'], '.1f')} ms"
    )
    item = QTreeWidgetItem([_title(str(row["name"])), f"{row['evidence']:.3g} {sign} {bound} {unit}", cost])
    item.setData(0, _NAME, row["name"])
    item.setCheckState(0, Qt.CheckState.Checked if row["on"] else Qt.CheckState.Unchecked)
    said = "\n".join(
        (
            _words(row.get("said")) or str(row["reason"]),
            tr("Measured {evidence}; on from {bound} ({origin}).").format(
                evidence=evidence, bound=bound, origin=_words(row.get("origin_said")) or row["origin"]
            ),
            tr("Costs about {ms:.1f} ms per step and {mb:.1f} MB.").format(ms=row["ms_per_step"], mb=row["mb"]),
            *_known(known or {}),
        )
    )
    for column in range(3):
        item.setToolTip(column, said)
    return item


def _known(known: Mapping[str, Any]) -> list[str]:
    """What runs and reports on this machine measured of an effect."""
    said = []
    if "ms" in known:
        said.append(tr("Measured here: {ms:.1f} ms per step ('{ms_clip}').").format(**known))
    if "psnr" in known:
        said.append(tr("Gained here: {psnr:+.2f} dB ('{psnr_clip}').").format(**known))
    return said


def _words(said: Sequence[Any] | None) -> str:
    """What the plan says by key, in the person's language."""
    return sentence([(str(key), values) for key, values in said or ()], tr)


def _title(name: str) -> str:
    return {
        "joint_occlusion": tr("Joint occlusion"),
        "background": tr("Background"),
        "camera_motion": tr("Camera motion"),
        "non_rigid_motion": tr("Bending motion"),
        "appearance_change": tr("Changing light"),
        "shading": tr("Shading of what turns"),
        "unseen_views": tr("Unseen views"),
        "instance_labels": tr("Object labels"),
        "depth_order": tr("Depth order"),
        "flow": tr("Optical flow"),
        "track_supervision": tr("Point tracks"),
        "reappearance": tr("Reappearance"),
    }.get(name, name)
