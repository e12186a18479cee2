"""Names in narrow columns: those that differ look different, in the table of objects and in the tree.

Not covered: names that differ in letters which look alike.
"""

from dataclasses import replace

import pytest
from annotating import choose_all, place_points
from PySide6.QtGui import QFont, QFontMetrics, QStandardItem, QStandardItemModel
from PySide6.QtWidgets import QStyleOptionViewItem

from genmojo_core.tracks.edit_tracks import put_objects
from genmojo_studio.annotate.eliding import Distinct, elided

NAMES = ["pedestrian left, white coat, one", "pedestrian left, black coat, one", "pedestrian left, black coat, two",
         "dog", "pedestrian"]  # fmt: skip


@pytest.mark.parametrize("room", [70, 90, 120, 160])
def test_names_that_differ_look_different(qapp, room):
    metrics = QFontMetrics(QFont("DejaVu Sans", 10))
    shown = [elided(name, NAMES, room, metrics) for name in NAMES]
    assert len(set(shown)) == len(NAMES), shown
    assert all(metrics.horizontalAdvance(text) <= room for text in shown)
    assert shown[3] == "dog"


def test_a_name_alone_keeps_its_ends(qapp):
    metrics = QFontMetrics(QFont("DejaVu Sans", 10))
    short = elided(NAMES[0], [NAMES[0], "dog"], 90, metrics)
    assert short[:3] == "ped" and short[-3:] == "one"


def drawn(view, index):
    """The text of a cell as it is drawn."""
    option = QStyleOptionViewItem()
    view.initViewItemOption(option)
    option.rect, option.widget = view.visualRect(index), view
    view.itemDelegateForIndex(index).initStyleOption(option, index)
    return option.text


def test_the_table_and_the_tree_tell_objects_apart(workspace, qtbot):
    choose_all(workspace)
    session = workspace.session
    infos = session.objects()[:2]
    names = [f"crossing pedestrian with a {colour} umbrella, number one" for colour in ("white", "black")]
    session.do(put_objects(session.annotation, [replace(i, name=n) for i, n in zip(infos, names, strict=True)]))
    table = workspace.objects.table
    rows = [drawn(table, table.model().index(row, 0)) for row in range(2)]
    assert rows[0] != rows[1] and all(text not in names for text in rows)
    assert table.item(0, 0).text() == names[0], "what is edited is the whole name"
    workspace.show_step(2)
    tree = workspace.refine.tree
    qtbot.waitUntil(tree.isVisible, timeout=60_000)
    tops = [drawn(tree, tree.model().index(row, 0)) for row in range(2)]
    assert tops[0] != tops[1] and all(text not in names for text in tops)


def test_the_tree_tells_the_names_of_points(workspace, qtbot):
    choose_all(workspace)
    workspace.show_step(1)
    owner = workspace.session.active[0]
    workspace.points.template.setCurrentIndex(workspace.points.template.findData("animal"))
    place_points(workspace, each=2)
    session, tree = workspace.session, workspace.points.tree
    first = tree.topLevelItem(session.place_of(owner)).child(0)
    named = session.annotation.tracks_of(owner)[0]
    assert named.name
    session.select_track(named.id)
    top = first.parent()
    assert tree.viewport().rect().contains(tree.visualItemRect(top).center()), "whose point it is shows"
    qtbot.waitUntil(lambda: first.text(0) == f"1  {named.name}", timeout=20_000)
    workspace.points.name.setText("tip of the nose")
    workspace.points.name.editingFinished.emit()
    qtbot.waitUntil(lambda: first.text(0) == "1  tip of the nose", timeout=20_000)


def test_a_model_of_plain_names_is_left_alone(qapp):
    model = QStandardItemModel()
    model.appendRow(QStandardItem("dog"))
    option = QStyleOptionViewItem()
    Distinct().initStyleOption(option, model.index(0, 0))
    assert option.text == "dog"
