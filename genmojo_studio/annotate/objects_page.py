"""Step 1: candidates with their figures; choose, reject with a reason, add by box, click or scribble, name, order."""

from __future__ import annotations

from dataclasses import replace

from PySide6.QtCore import QSignalBlocker, QSize, Qt, Signal
from PySide6.QtGui import QColor, QIcon, QPainter, QPen, QPixmap
from PySide6.QtWidgets import (
    QAbstractItemView,
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
from genmojo_studio.annotate.colours import object_colour
from genmojo_studio.annotate.eliding import Distinct
from genmojo_studio.annotate.masks import Purpose
from genmojo_studio.annotate.session import Session
from genmojo_studio.translate import decimal, mark, tr

REASONS = (mark("too small"), mark("does not move"), mark("hidden too often"), mark("not an object"),
           mark("enough objects"))  # fmt: skip
_FITTING = {"small": REASONS[0], "static": REASONS[1], "hidden": REASONS[2], "covered": REASONS[2]}  # what advice means
_LONGEST = 60  # characters of a name or a reason
_COLUMNS = 5


class ObjectsPage(QWidget):
    """The table of candidates and the tools that make more."""

    tool_wanted = Signal(object)  # Tool or None
    cut_wanted = Signal()  # make a mask of what was drawn

    def __init__(self, session: Session, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self._session = session
        self.figures: dict[int, Figures] = {}
        self.bare = 0
        self._filling = self._cutting = False
        self.table = QTableWidget(0, _COLUMNS)
        self.reason = QComboBox(editable=True)
        self.tools: dict[Tool, QToolButton] = {}
        self.cut = QPushButton(tr("Cut out"))
        self.purpose = QComboBox()
        self.progress = QProgressBar(maximum=100)
        self.about, self.note = QLabel(wordWrap=True), QLabel(wordWrap=True)
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
        self._tell()
        chosen = len(self._session.objects())
        most = self._session.limit("objects")
        self.note.setText(tr("{n} of at most {most} objects chosen.").format(n=chosen, most=most))
        for name, box in self.limits.items():
            with QSignalBlocker(box):
                box.setValue(self._session.limit(name))

    def set_figures(self, figures: dict[int, Figures], bare: int) -> None:
        """Figures of the masks have been computed; `bare`: frames for which the clip has no masks."""
        self.figures, self.bare = figures, bare
        self.refresh()

    def show_cutting(self, share: float) -> None:
        """Progress of cutting an object out, 0..1."""
        self.progress.setVisible(share < 1)
        self.progress.setRange(0, 0 if share < 1 else 100)
        self._cutting = share < 1
        self.cut.setEnabled(not self._cutting and bool(self._session.sketch))

    def show_sketched(self, count: int) -> None:
        """So many boxes and strokes wait to be cut out."""
        self.cut.setEnabled(not self._cutting and count > 0)

    def target(self) -> tuple[Purpose, int | None]:
        """What a cut is for, and the object whose mask it makes; without a selected object a new one."""
        info, purpose = self.current(), Purpose(self.purpose.currentData())
        if info is None or purpose == Purpose.NEW:
            return Purpose.NEW, None
        return purpose, info.id

    def set_purpose(self, purpose: Purpose) -> None:
        """What the next cut is for."""
        self.purpose.setCurrentIndex(self.purpose.findData(purpose.value))

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
        """Leave the object of this row out, for the reason chosen or written."""
        info, text = self.current(), self.reason.currentText().strip()[:_LONGEST]
        if info is not None and not text:
            self._session.said.emit(tr("Say why it is left out."))
        elif info is not None:
            known = {tr(reason): reason for reason in REASONS}
            reason = known.get(text, text)
            self._put([replace(info, status="rejected", order=0, reason=reason)], say("reject_object", name=info.name))
            aside = len(self._session.annotation.tracks_of(info.id))
            if aside:
                self._session.said.emit(tr("{n} tracks of {name} are put aside; they come back if you choose it "
                                           "again.").format(n=aside, name=info.name))  # fmt: skip

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
        icon = _swatch(self._session.places().get(info.id, 0), filled=info.status == "chosen")
        text = self._why(info)
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

    def _why(self, info: ObjectInfo) -> str:
        """Why an object is left out, or what speaks against it, "" for nothing."""
        f = self.figures.get(info.id)
        advice = {"small": tr("very small"), "static": tr("hardly moves"), "hidden": tr("seen in few frames"),
                  "covered": tr("partly hidden most of the time")}  # fmt: skip
        return tr(info.reason) if info.reason else advice.get(f.advice, "") if f else ""

    def _tell(self) -> None:
        """What is to be said of the selected object, and the reason that suits it."""
        info = self.current()
        why = self._why(info) if info is not None else ""
        lacking = tr("{n} frames have no masks: Follow it carries the selected one on.") if self.bare else ""
        about = f"{info.name}: {why}. " if info is not None and why else ""
        self.about.setText(about + lacking.format(n=self.bare))
        f = self.figures.get(info.id) if info is not None else None
        fitting = info.reason if info and info.reason else _FITTING.get(f.advice, "") if f else ""
        if fitting:
            self.reason.setCurrentText(tr(fitting))

    def _arrange(self) -> None:
        self.table.setHorizontalHeaderLabels([tr("object"), "✓", tr("size"), tr("speed"), tr("seen/cut")])
        tips = ("", tr("✓ chosen, ? undecided (! something speaks against it), ✗ left out"),
                tr("Median share of the frame"), tr("Pixels per frame at 1080 lines, against the background"),
                tr("Share of the frames with masks in which it is seen; of those, in which it is partly hidden"),
                )  # fmt: skip
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
        self.table.setTextElideMode(Qt.TextElideMode.ElideMiddle)
        self.table.setItemDelegateForColumn(0, Distinct(self.table))
        self.table.setAccessibleName(tr("Candidate objects"))
        self.table.itemChanged.connect(self._renamed)
        self.table.itemSelectionChanged.connect(self._picked)
        column = QVBoxLayout(self)
        column.setContentsMargins(8, 6, 8, 6)
        column.addWidget(self.table, 1)
        column.addLayout(self._decisions())
        column.addWidget(self.about)
        column.addLayout(self._makers())
        cutting = QHBoxLayout()
        cutting.addWidget(self.purpose, 1)
        cutting.addWidget(self.cut)
        column.addLayout(cutting)
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
        self.reason.addItems([tr(reason) for reason in REASONS])
        self.reason.setInsertPolicy(QComboBox.InsertPolicy.NoInsert)
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
        for purpose, text in ((Purpose.NEW, tr("Makes a new object")),
                              (Purpose.CORRECT, tr("Puts the selected object's mask right")),
                              (Purpose.ANEW, tr("Draws the selected object's mask anew"))):  # fmt: skip
            self.purpose.addItem(text, purpose.value)
        for box in (self.purpose, self.reason):  # the panel is narrow; the list that opens is as wide as its texts
            box.setSizeAdjustPolicy(QComboBox.SizeAdjustPolicy.AdjustToMinimumContentsLengthWithIcon)
            box.setMinimumContentsLength(8)
        self.purpose.setAccessibleName(tr("What is cut out"))
        self.purpose.setToolTip(tr("A correction changes what you point at, and goes on from frame to frame until the "
                                   "mask agrees with it."))  # fmt: skip
        self.cut.setEnabled(False)
        self.cut.clicked.connect(self.cut_wanted)
        row.addStretch()
        return row

    def _tool_clicked(self) -> None:
        chosen = next((t for t, b in self.tools.items() if b is self.sender() and b.isChecked()), None)
        self.use_tool(chosen)

    def use_tool(self, chosen: Tool | None) -> None:
        """Draw with a tool from now on, or with none."""
        for tool, button in self.tools.items():
            button.setChecked(tool == chosen)
        self.tool_wanted.emit(chosen)

    def _renamed(self, item: QTableWidgetItem) -> None:
        if self._filling or item.column():
            return
        objects, text = self._ordered(), item.text().strip()
        name = text[:_LONGEST]
        if not name:
            self._session.said.emit(tr("An object needs a name."))
        elif len(text) > _LONGEST:
            self._session.said.emit(tr("Names have {n} characters at most.").format(n=_LONGEST))
        if item.row() < len(objects) and name and name != objects[item.row()].name:
            self._put([replace(objects[item.row()], name=name)], say("name_object", name=name))
        else:
            self.refresh()

    def _picked(self) -> None:
        info = self.current()
        if info is not None and not self._filling and self.table.hasFocus():
            self._session.select(info.id, 1)
        if not self._filling:
            self._tell()

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
                self._session.do(replace(edit, title=say(f"most_{name}", count=box.value())))
                self.refresh()

    def _up(self) -> None:
        self.reorder(-1)

    def _down(self) -> None:
        self.reorder(1)


def _swatch(place: int, *, filled: bool) -> QIcon:
    """An object's colour, as its outline has it: full where it is annotated, else a frame."""
    pixmap = QPixmap(14, 14)
    pixmap.fill(Qt.GlobalColor.transparent)
    painter = QPainter(pixmap)
    colour = QColor(*object_colour(place))
    painter.setPen(QPen(colour, 2))
    painter.setBrush(colour if filled else Qt.BrushStyle.NoBrush)
    painter.drawRect(2, 2, 10, 10)
    painter.end()
    return QIcon(pixmap)


def _tool(text: str, tip: str) -> QToolButton:
    """A small button with a tool tip."""
    button = QToolButton()
    button.setText(text)
    button.setToolTip(tip)
    return button
