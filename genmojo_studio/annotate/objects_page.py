"""Step 1: candidates with their figures; choose, reject with a reason, add by box, click or scribble, name, order."""

from __future__ import annotations

from dataclasses import replace

from PySide6.QtCore import QSignalBlocker, QSize, Qt, Signal
from PySide6.QtGui import QIcon
from PySide6.QtWidgets import (
    QAbstractItemView,
    QCheckBox,
    QComboBox,
    QGridLayout,
    QHBoxLayout,
    QHeaderView,
    QLabel,
    QProgressBar,
    QPushButton,
    QSpinBox,
    QTableWidget,
    QTableWidgetItem,
    QToolButton,
    QVBoxLayout,
    QWidget,
)

from genmojo_core.sentences import say
from genmojo_core.tracks.annotation import ObjectInfo, Touched
from genmojo_core.tracks.edit_tracks import put_objects
from genmojo_core.tracks.edits import set_meta
from genmojo_studio.annotate.candidates import Figures
from genmojo_studio.annotate.canvas import Tool
from genmojo_studio.annotate.session import Session
from genmojo_studio.annotate.track_tree import point_icon
from genmojo_studio.translate import decimal, tr

REASONS = ("too small", "does not move", "hidden too often", "not an object", "enough objects")
_COLUMNS = 5


class ObjectsPage(QWidget):
    """The table of candidates and the tools that make more."""

    tool_wanted = Signal(object)  # Tool or None
    cut_wanted = Signal()  # make a mask of what was drawn

    def __init__(self, session: Session, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self._session = session
        self.figures: dict[int, Figures] = {}
        self._filling = False
        self.table = QTableWidget(0, _COLUMNS)
        self.reason = QComboBox()
        self.tools: dict[Tool, QToolButton] = {}
        self.cut = QPushButton(tr("Cut out"))
        self.instead = QCheckBox(tr("Instead of the selected object's mask"))
        self.instead.setToolTip(tr("What is drawn replaces its mask in every frame; runs use the new one."))
        self.progress = QProgressBar(maximum=100)
        self.note = QLabel(wordWrap=True)
        self.limits = {"objects": QSpinBox(minimum=1, maximum=20), "points": QSpinBox(minimum=1, maximum=20)}
        self.progress.hide()
        self._arrange()
        session.edited.connect(self._edited)
        session.selected.connect(self._select)
        self.refresh()

    def refresh(self) -> None:
        """Fill the table anew."""
        self._filling = True
        objects = self._ordered()
        self.table.setRowCount(len(objects))
        for row, info in enumerate(objects):
            self._fill(row, info)
        self._filling = False
        self._select()
        chosen = len(self._session.objects())
        most = self._session.limit("objects")
        self.note.setText(tr("{n} of at most {most} objects chosen.").format(n=chosen, most=most))
        for name, box in self.limits.items():
            with QSignalBlocker(box):
                box.setValue(self._session.limit(name))

    def set_figures(self, figures: dict[int, Figures]) -> None:
        """Figures of the masks have been computed."""
        self.figures = figures
        self.refresh()

    def show_cutting(self, share: float) -> None:
        """Progress of cutting an object out, 0..1."""
        self.progress.setVisible(share < 1)
        self.progress.setRange(0, 0 if share < 1 else 100)
        self.cut.setEnabled(share >= 1)

    def replaced(self) -> int | None:
        """Id of the object whose mask is to be drawn anew, None for a new object."""
        info = self.current()
        return info.id if info is not None and self.instead.isChecked() else None

    def current(self) -> ObjectInfo | None:
        """The object of the row that is selected."""
        row = self.table.currentRow()
        objects = self._ordered()
        return objects[row] if 0 <= row < len(objects) else None

    def choose(self) -> None:
        """Annotate the object of this row."""
        info = self.current()
        if info is None or info.status == "chosen":
            return
        if len(self._session.objects()) >= self._session.limit("objects"):
            self._session.said.emit(tr("There are {n} objects already; reject one first.").format(
                n=self._session.limit("objects")))  # fmt: skip
            return
        order = max((o.order for o in self._session.objects()), default=0) + 1
        name = info.name or tr("object {n}").format(n=info.id)
        self._put([replace(info, status="chosen", order=order, name=name, reason="")], say("choose_object", name=name))
        self._session.select(info.id, 1)

    def reject(self) -> None:
        """Leave the object of this row out, for the reason chosen."""
        info = self.current()
        if info is not None:
            reason = REASONS[self.reason.currentIndex()]
            self._put([replace(info, status="rejected", order=0, reason=reason)], say("reject_object", name=info.name))

    def reorder(self, step: int) -> None:
        """Earlier (-1) or later (1) in the order."""
        info, objects = self.current(), self._session.objects()
        if info is None or info not in objects:
            return
        there = objects.index(info) + step
        if 0 <= there < len(objects):
            objects.remove(info)
            objects.insert(there, info)
            self._put([replace(o, order=n + 1) for n, o in enumerate(objects)], say("order_objects"))

    def _put(self, objects: list[ObjectInfo], title: str) -> None:
        self._session.do(put_objects(self._session.annotation, objects, title))

    def _ordered(self) -> list[ObjectInfo]:
        rank = {"chosen": 0, "candidate": 1, "rejected": 2}
        return sorted(self._session.annotation.objects.values(), key=lambda o: (rank[o.status], o.order, o.id))

    def _fill(self, row: int, info: ObjectInfo) -> None:
        f = self.figures.get(info.id)
        status = {"chosen": "✓", "candidate": "?", "rejected": "✗"}[info.status]
        texts = [info.name or tr("object {n}").format(n=info.id), status,
                 f"{decimal(100 * f.size, '.1f')} %" if f else "…", decimal(f.motion, ".1f") if f else "…",
                 f"{100 * f.seen:.0f}/{100 * f.covered:.0f} %" if f else "…"]  # fmt: skip
        for column, text in enumerate(texts):
            item = QTableWidgetItem(text)
            item.setTextAlignment(Qt.AlignmentFlag.AlignVCenter | (Qt.AlignmentFlag.AlignRight if column > 1 else
                                                                   Qt.AlignmentFlag.AlignLeft))  # fmt: skip
            if column:
                item.setFlags(item.flags() & ~Qt.ItemFlag.ItemIsEditable)
            self.table.setItem(row, column, item)
        chosen = info.status == "chosen"
        icon = point_icon(self._session.place_of(info.id), 0) if chosen else QIcon()
        advice = {"small": tr("very small"), "static": tr("hardly moves"), "hidden": tr("seen in few frames")}
        text = tr(info.reason) or (advice.get(f.advice, "") if f else "")
        tip = f"{texts[0]}: {text}" if text else texts[0]
        for column in range(_COLUMNS):
            cell = self.table.item(row, column)
            if cell is None:
                continue
            cell.setToolTip(tip)
            if column == 0:
                cell.setIcon(icon)
            elif column == 1 and info.status == "candidate" and text:
                cell.setText("?!")

    def _arrange(self) -> None:
        self.table.setHorizontalHeaderLabels([tr("object"), "✓", tr("size"), tr("motion"), tr("seen/cut")])
        tips = ("", tr("✓ chosen, ? undecided (! something speaks against it), ✗ left out"),
                tr("Median share of the frame"), tr("Pixels per frame at 1080 lines"),
                tr("Share of frames in which it is seen; of those, in which it is partly hidden"))  # fmt: skip
        for place, tip in enumerate(tips):
            header = self.table.horizontalHeaderItem(place)
            if header is not None:
                header.setToolTip(tip)
        self.table.horizontalHeader().setSectionResizeMode(QHeaderView.ResizeMode.ResizeToContents)
        self.table.horizontalHeader().setSectionResizeMode(0, QHeaderView.ResizeMode.Stretch)
        self.table.horizontalHeader().setMinimumSectionSize(30)
        self.table.setMinimumHeight(90)
        self.table.verticalHeader().hide()
        self.table.verticalHeader().setDefaultSectionSize(24)
        self.table.setIconSize(QSize(14, 14))
        self.table.setSelectionBehavior(QAbstractItemView.SelectionBehavior.SelectRows)
        self.table.setSelectionMode(QAbstractItemView.SelectionMode.SingleSelection)
        self.table.setTabKeyNavigation(False)
        self.table.setWordWrap(False)
        self.table.setAccessibleName(tr("Candidate objects"))
        self.table.itemChanged.connect(self._renamed)
        self.table.itemSelectionChanged.connect(self._picked)
        column = QVBoxLayout(self)
        column.setContentsMargins(8, 6, 8, 6)
        column.addWidget(self.table, 1)
        column.addLayout(self._decisions())
        column.addLayout(self._makers())
        column.addWidget(self.instead)
        column.addWidget(self.progress)
        column.addWidget(self.note)
        column.addLayout(self._most())

    def _most(self) -> QHBoxLayout:
        """How many objects, and points of each, this project wants."""
        row = QHBoxLayout()
        row.addWidget(QLabel(tr("At most")))
        for name, suffix in (("objects", tr(" objects")), ("points", tr(" points each"))):
            box = self.limits[name]
            box.setSuffix(suffix)
            box.setAccessibleName(tr("At most") + suffix)
            box.setKeyboardTracking(False)
            box.valueChanged.connect(self._limited)
            row.addWidget(box)
        row.addStretch()
        return row

    def _decisions(self) -> QGridLayout:
        grid = QGridLayout()
        self.choose_button, self.reject_button = QPushButton(tr("Choose")), QPushButton(tr("Leave out:"))
        for reason in (tr("too small"), tr("does not move"), tr("hidden too often"), tr("not an object"),
                       tr("enough objects")):  # fmt: skip
            self.reason.addItem(reason)
        self.reason.setAccessibleName(tr("Reason for leaving it out"))
        up, down = _tool("↑", tr("Earlier")), _tool("↓", tr("Later"))
        self.choose_button.clicked.connect(self.choose)
        self.reject_button.clicked.connect(self.reject)
        up.clicked.connect(self._up)
        down.clicked.connect(self._down)
        grid.addWidget(self.choose_button, 0, 0)
        grid.addWidget(up, 0, 1)
        grid.addWidget(down, 0, 2)
        grid.addWidget(self.reject_button, 1, 0)
        grid.addWidget(self.reason, 1, 1, 1, 3)
        grid.setColumnStretch(3, 1)
        return grid

    def _makers(self) -> QHBoxLayout:
        row = QHBoxLayout()
        row.setSpacing(4)
        row.addWidget(QLabel(tr("Add")))
        for tool, title, tip in (
            (Tool.BOX, tr("box"), tr("Draw a rectangle around the object")),
            (Tool.SCRIBBLE, tr("stroke"), tr("Click on it or draw over it")),
            (Tool.SCRIBBLE_OUT, tr("not this"), tr("Draw over what is not part of it")),
        ):
            button = _tool(title, tip)
            button.setCheckable(True)
            button.clicked.connect(self._tool_clicked)
            self.tools[tool] = button
            row.addWidget(button)
        self.cut.setEnabled(False)
        self.cut.clicked.connect(self.cut_wanted)
        row.addWidget(self.cut)
        row.addStretch()
        return row

    def _tool_clicked(self) -> None:
        chosen = next((t for t, b in self.tools.items() if b is self.sender() and b.isChecked()), None)
        self.use_tool(chosen)

    def use_tool(self, chosen: Tool | None) -> None:
        """Draw with a tool from now on, or with none."""
        for tool, button in self.tools.items():
            button.setChecked(tool == chosen)
        self.cut.setEnabled(chosen is not None)
        self.tool_wanted.emit(chosen)

    def _renamed(self, item: QTableWidgetItem) -> None:
        if self._filling or item.column():
            return
        objects = self._ordered()
        name = item.text().strip()[:60]
        if item.row() < len(objects) and name and name != objects[item.row()].name:
            self._put([replace(objects[item.row()], name=name)], say("name_object", name=name))

    def _picked(self) -> None:
        info = self.current()
        if info is not None and not self._filling and self.table.hasFocus():
            self._session.select(info.id, 1)

    def _select(self) -> None:
        objects = self._ordered()
        row = next((n for n, o in enumerate(objects) if o.id == self._session.active[0]), -1)
        if row >= 0 and row != self.table.currentRow():
            self.table.selectRow(row)

    def _edited(self, touched: Touched) -> None:
        changed = any(box.value() != self._session.limit(name) for name, box in self.limits.items())
        if touched.objects or changed:
            self.refresh()

    def _limited(self) -> None:
        """A person wants more or fewer objects or points."""
        for name, box in self.limits.items():
            if box.value() != self._session.limit(name):
                edit = set_meta(self._session.annotation, f"limit_{name}", str(box.value()))
                if self._session.do(replace(edit, title=say(f"most_{name}", count=box.value()))) is None:
                    self.refresh()

    def _up(self) -> None:
        self.reorder(-1)

    def _down(self) -> None:
        self.reorder(1)


def _tool(text: str, tip: str) -> QToolButton:
    """A small button with a tool tip."""
    button = QToolButton()
    button.setText(text)
    button.setToolTip(tip)
    return button
