"""The objects of the scene: show, solo, tint, move apart; how well each is explained."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace

from PySide6.QtCore import Qt
from PySide6.QtGui import QColor, QIcon, QPixmap
from PySide6.QtWidgets import (
    QColorDialog,
    QGridLayout,
    QHBoxLayout,
    QHeaderView,
    QLabel,
    QPushButton,
    QSlider,
    QTreeWidget,
    QTreeWidgetItem,
    QVBoxLayout,
    QWidget,
)

from genmojo_studio.actions import ActionTable
from genmojo_studio.state import AppState
from genmojo_studio.translate import decimal, tr
from genmojo_studio.view3d.snapshot import SceneSnapshot
from genmojo_studio.watch.appearance import Appearance

_ID = Qt.ItemDataRole.UserRole
_NAME, _COUNT, _PSNR = range(3)


class ObjectsPanel(QWidget):
    """A row per object; the box shows it, a double click makes it stand alone."""

    def __init__(
        self, state: AppState, actions: ActionTable, appearance: Appearance, parent: QWidget | None = None
    ) -> None:
        super().__init__(parent)
        self._state = state
        self._appearance = appearance
        self._snapshot: SceneSnapshot | None = None
        self._counted: tuple[int, ...] = ()
        self.list = QTreeWidget()
        self.list.setHeaderLabels([tr("Object"), tr("Gaussians"), "PSNR"])
        self.list.setRootIsDecorated(False)
        self.list.setUniformRowHeights(True)
        self.list.setMinimumHeight(110)
        header = self.list.header()
        header.setStretchLastSection(False)
        header.setSectionResizeMode(_NAME, QHeaderView.ResizeMode.Stretch)
        for column in (_COUNT, _PSNR):
            header.setSectionResizeMode(column, QHeaderView.ResizeMode.ResizeToContents)
        self.explode = QSlider(Qt.Orientation.Horizontal)
        self.explode.setRange(0, 200)
        self.explode.setToolTip(tr("Moves the objects apart"))
        buttons = QGridLayout()
        for i, (text, call) in enumerate(
            (
                (tr("Solo"), lambda: actions.trigger("view.solo")),
                (tr("All"), lambda: actions.trigger("view.all")),
                (tr("Tint…"), self._tint),
                (tr("Edit this mask…"), lambda: actions.trigger("view.edit_mask")),
            )
        ):
            button = QPushButton(text)
            button.clicked.connect(call)
            buttons.addWidget(button, i // 2, i % 2)
        apart = QHBoxLayout()
        apart.addWidget(QLabel(tr("Apart")))
        apart.addWidget(self.explode, 1)
        layout = QVBoxLayout(self)
        layout.setContentsMargins(8, 8, 8, 8)
        layout.addWidget(self.list, 1)
        layout.addLayout(buttons)
        layout.addLayout(apart)
        self.list.itemChanged.connect(self._ticked)
        self.list.itemSelectionChanged.connect(self._selected)
        self.list.itemDoubleClicked.connect(self._solo)
        self.explode.valueChanged.connect(self._explode)
        appearance.changed.connect(self.refresh)
        state.subscribe(self._follow_selection, "selected_object")

    def show_snapshot(self, snapshot: SceneSnapshot | None) -> None:
        """Lists the objects of a scene."""
        self._snapshot = snapshot
        self.refresh()

    def show_psnr(self, figures: Mapping[int, float]) -> None:
        """Says how well every object is explained in the frame on show, in dB."""
        self.list.blockSignals(True)
        for item in self._items():
            value = figures.get(item.data(_NAME, _ID))
            item.setText(_PSNR, "" if value is None or value != value else f"{decimal(value, '.1f')} dB")
        self.list.blockSignals(False)

    def refresh(self) -> None:
        """Shows the scene's objects under the present look."""
        snapshot, look = self._snapshot, self._appearance.look
        self.list.blockSignals(True)
        ids = tuple(int(i) for i in snapshot.object_ids) if snapshot is not None else ()
        if ids != self._counted:
            self.list.clear()
            self.list.addTopLevelItems([_empty_item(i) for i in ids])
            self._counted = ids
        for k, item in enumerate(self._items()):
            if snapshot is None:
                continue
            named = snapshot.object_of(ids[k])
            item.setText(_NAME, tr("Background") if named.is_background else named.name)
            item.setText(_COUNT, str(int((snapshot.object_index == k).sum())))
            item.setIcon(_NAME, _square(look.of(ids[k]).tint or named.color))
            shown = look.shows(snapshot, ids[k])
            item.setCheckState(_NAME, Qt.CheckState.Checked if shown else Qt.CheckState.Unchecked)
        self.list.blockSignals(False)
        self.explode.blockSignals(True)
        self.explode.setValue(round(look.explode * 100))
        self.explode.blockSignals(False)

    def _items(self) -> list[QTreeWidgetItem]:
        found = (self.list.topLevelItem(i) for i in range(self.list.topLevelItemCount()))
        return [item for item in found if item is not None]

    def _chosen(self) -> int | None:
        item = self.list.currentItem()
        return int(item.data(_NAME, _ID)) if item is not None else None

    def _ticked(self, item: QTreeWidgetItem) -> None:
        object_id, shown = int(item.data(_NAME, _ID)), item.checkState(_NAME) == Qt.CheckState.Checked
        look = self._appearance.look
        solo = (look.solo | {object_id} if shown else look.solo - {object_id}) if look.solo else look.solo
        background = self._snapshot is not None and self._snapshot.object_of(object_id).is_background
        look = replace(look, solo=solo, show_background=shown if background else look.show_background)
        look = look.with_object(object_id, replace(look.of(object_id), visible=shown))
        self._appearance.set(look, tr("Show or hide an object"))

    def _selected(self) -> None:
        if self.list.selectedItems():
            self._state.set(selected_object=self._chosen())

    def _follow_selection(self) -> None:
        self.list.blockSignals(True)
        for item in self._items():
            if item.data(_NAME, _ID) == self._state.selected_object:
                self.list.setCurrentItem(item)
        self.list.blockSignals(False)

    def _solo(self, item: QTreeWidgetItem) -> None:
        self._appearance.toggle_solo(int(item.data(_NAME, _ID)), tr("Solo"))

    def _tint(self) -> None:
        chosen = self._chosen()
        if chosen is None:
            return
        colour = QColorDialog.getColor(parent=self, title=tr("Tint of the object"))
        if colour.isValid():
            self._appearance.tint(chosen, (colour.redF(), colour.greenF(), colour.blueF()), tr("Tint an object"))

    def _explode(self, value: int) -> None:
        self._appearance.set(replace(self._appearance.look, explode=value / 100), tr("Move objects apart"), "explode")


def _empty_item(object_id: int) -> QTreeWidgetItem:
    item = QTreeWidgetItem()
    item.setData(_NAME, _ID, object_id)
    item.setTextAlignment(_COUNT, Qt.AlignmentFlag.AlignRight)
    item.setTextAlignment(_PSNR, Qt.AlignmentFlag.AlignRight)
    return item


def _square(colour: tuple[float, float, float]) -> QIcon:
    picture = QPixmap(14, 14)
    picture.fill(QColor.fromRgbF(*(min(max(c, 0.0), 1.0) for c in colour)))
    return QIcon(picture)
