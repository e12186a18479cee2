"""Every text of the annotator goes through the translation, and the translation tool knows every text that is asked.

A language of marks stands in for German: what shows without marks was never translated. Dialogs that ask for a file are
not covered, nor texts that only a fault of a file brings up (tests/test_sentences.py).
"""

import importlib
import json
import re
from pathlib import Path

import pytest
from annotating import choose_all, place_points
from PySide6.QtCore import QCoreApplication, QLocale, QTranslator
from PySide6.QtWidgets import (
    QAbstractButton,
    QAbstractSpinBox,
    QComboBox,
    QDockWidget,
    QLabel,
    QLineEdit,
    QListWidget,
    QTableWidget,
    QTabWidget,
    QTreeWidget,
    QWidget,
)

from genmojo_core.errors import GenmojoError
from genmojo_core.sentences import say
from genmojo_core.tracks.annotation import REASONS
from genmojo_core.tracks.exchange import swap
from genmojo_core.tracks.model import OCCLUDED, OUT_OF_VIEW, VISIBLE
from genmojo_studio import translate
from genmojo_studio.annotate import verbs
from genmojo_studio.annotate.button_panel import KeyButton
from genmojo_studio.annotate.log_dialog import LogDialog
from genmojo_studio.annotate.points_page import TEMPLATES
from genmojo_studio.annotate.seed_dialog import SeedDialog
from genmojo_studio.annotate.steps import STEPS


class Marks(QTranslator):
    """Puts every text between marks and keeps what was asked for."""

    def __init__(self):
        super().__init__()
        self.asked = set()

    def translate(self, context, text, _disambiguation=None, _n=-1):
        if context != translate.CONTEXT:
            return ""
        self.asked.add(text)
        return f"«{text}»"

    def isEmpty(self):  # noqa: N802
        return False


@pytest.fixture
def marks(qapp):
    marks = Marks()
    QCoreApplication.installTranslator(marks)
    yield marks
    QCoreApplication.removeTranslator(marks)


def shown(root):
    """Every text that the widgets under one show or tell."""
    for w in [root, *root.findChildren(QWidget)]:
        yield from (w.toolTip(), w.accessibleName())
        if isinstance(w, QLabel | QAbstractButton):
            yield w.text()
        elif isinstance(w, QLineEdit):
            yield w.placeholderText()
        elif isinstance(w, QAbstractSpinBox):
            yield from (w.prefix(), w.suffix())
        elif isinstance(w, QComboBox):
            yield from (w.itemText(n) for n in range(w.count()))
        elif isinstance(w, QListWidget):
            yield from (w.item(n).text() for n in range(w.count()))
        elif isinstance(w, QTableWidget):
            cells = [w.horizontalHeaderItem(x) for x in range(w.columnCount())]
            cells += [w.item(y, x) for y in range(w.rowCount()) for x in range(w.columnCount())]
            yield from (t for c in cells if c is not None for t in (c.text(), c.toolTip()))
        elif isinstance(w, QTreeWidget):
            yield from (w.headerItem().text(n) for n in range(w.columnCount()))
        elif isinstance(w, QTabWidget):
            yield from (w.tabText(n) for n in range(w.count()))
        elif isinstance(w, QDockWidget):
            yield w.windowTitle()


def bare(text, names):
    """What of a text stands outside marks and is a word, no name, key or unit."""
    depth, rest = 0, []
    for letter in text:
        depth += (letter == "«") - (letter == "»")
        rest.append(letter if depth == 0 else " ")
    words = "".join(rest)
    for name in sorted(names, key=len, reverse=True):
        words = words.replace(name, " ")
    words = re.sub(r"\([^()]*\)|\b(Ctrl|Shift|Alt|Return|Del|Space)\b", " ", words)  # keys, in brackets or alone
    return re.findall(r"[^\W\d_]{3,}", words)


def known_texts(monkeypatch):
    monkeypatch.syspath_prepend(str(Path(__file__).resolve().parents[3] / "packaging"))
    faults = json.loads((translate.FOLDER / "faults.json").read_text("utf-8"))
    return {"", *importlib.import_module("translations").app_texts(), *faults}


def work_through(workspace, qtbot):
    """Edits of every kind, as the app makes them."""
    session, tracker = workspace.session, workspace.work.tracker
    choose_all(workspace)
    workspace.objects.reorder(1)
    workspace.objects.limits["points"].setValue(4)
    place_points(workspace)
    workspace.points.template.setCurrentIndex(1)
    tracker.seed([session.active[0]])
    qtbot.waitUntil(lambda: session.project.history()[-1].kind == "seed", timeout=120_000)
    qtbot.waitUntil(lambda: not tracker.tasks.busy, timeout=120_000)
    track = session.annotation.tracks_of(session.active[0])[0].id
    session.select_track(track)
    session.go(4)
    for state in (OCCLUDED, OUT_OF_VIEW, VISIBLE):
        verbs.paint(session, track, state, 2, 5)
    verbs.paint_here(session, OCCLUDED)
    for verb in (verbs.toggle_uncertain, verbs.toggle_uncertain, verbs.set_mode, verbs.delete_key):
        verb(session)
    verbs.nudge(session, 1.0, 0.0)
    verbs.accept(session)
    verbs.clear(session, after=True)
    verbs.toggle_lock(session)
    verbs.toggle_lock(session)
    other = session.annotation.tracks_of(session.active[0])[1].id
    session.do(swap(session.annotation, track, other, 0, 1))
    workspace.show_step(3)
    for reason in range(len(REASONS)):
        session.select_track(track)
        workspace.review.needs_fix(reason)
    session.select_track(track)
    workspace.hands._fixed()
    session.select_track(track)
    workspace.review.reject()
    session.select_track(other)
    verbs.delete_track(session)
    workspace.review.consent.click()


def test_every_text_of_the_annotator_is_translated_and_known(marks, request, qtbot, monkeypatch):
    workspace = request.getfixturevalue("workspace")
    session, said = workspace.session, []
    session.said.connect(said.append)
    work_through(workspace, qtbot)
    titles = {row.title for row in session.project.log.rows}
    names = {"Ada", *(o.name for o in session.annotation.objects.values()), *TEMPLATES["animal"]}
    kept = {t: re.sub("«(left|right) eye»", "", t) for t in titles}  # what people called a point is theirs
    assert not [t for t, words in kept.items() if "«" in words], "the log keeps English words, whatever the language"
    assert not {t: bare(translate.told(t), names) for t in titles if bare(translate.told(t), names)}
    verbs.toggle_lock(session)
    verbs.nudge(session, 1.0, 0.0)
    while session.project.log.undo_target() is not None:
        session.undo()
    while session.project.log.redo_target() is not None:
        session.redo()
    left = {t: bare(t, names) for t in said}
    for place in range(len(STEPS)):
        workspace.show_step(place)
        qtbot.wait(80)  # panels that follow the frame do so a moment later
        left |= {t: bare(t, names) for t in shown(workspace)}
    for dialog in (LogDialog(session, workspace), SeedDialog(session, workspace.work, workspace)):
        left |= {t: bare(t, names) for t in shown(dialog)}
        dialog.deleteLater()
    assert not {text: words for text, words in left.items() if words}
    unknown = marks.asked - known_texts(monkeypatch)
    assert not unknown


@pytest.fixture
def german(qapp):
    translators = translate.install("de")
    yield
    for translator in translators:
        QCoreApplication.removeTranslator(translator)
    QLocale.setDefault(QLocale.system())


def test_faults_and_numbers_are_german(german):
    locked = GenmojoError("argument", f"{say('point_of', number=1, name='key')} is locked", hint="unlock it first")
    assert translate.fault(locked) == "Punkt 1 von key ist gesperrt; entsperren Sie sie erst."
    said = GenmojoError("schema", "has 5 keys, allowed are 1 to 4", "C:/a: b; c.json", "put the keys in order of time")
    german = "hat 5 Schlüssel, erlaubt sind 1 bis 4; ordnen Sie die Schlüssel nach der Zeit."
    assert translate.fault(said) == translate.fault(said.sentence()) == f"C:/a: b; c.json: {german}"
    assert translate.fault("a.npz: is 3 > 2; who knows.") == "a.npz: is 3 > 2; who knows."
    words = say("depth_steadied", percent=2.5)
    assert "2,5 %" in translate.told(words) and translate.decimal(0.25, ".1%") == "25,0%"
    saved = translate.tr("{n} min of optimising, ready in about {m:.1f} min").format(n=1, m=1.25)
    assert saved.endswith("1,2 min")


@pytest.mark.parametrize("size", [(1366, 690), (1920, 960)], ids=["1366x768", "1920x1040"])  # less the window's head
def test_nothing_is_cut_in_german(german, request, qtbot, size):
    workspace = request.getfixturevalue("workspace")
    choose_all(workspace)
    place_points(workspace)
    workspace.resize(*size)
    panel = workspace.buttons

    def cut():
        """Texts that are cut, or stand without their key."""
        buttons = panel.findChildren(KeyButton)
        edges = [b.mapTo(panel.viewport(), b.rect().topRight()).x() for b in buttons]
        wide = [b.fontMetrics().horizontalAdvance(b.text()) for b in buttons]
        return [b.text() for b, right, text in zip(buttons, edges, wide, strict=True)
                if right >= panel.viewport().width() or text >= b.width() or not b.shows_key()]  # fmt: skip

    for place in range(len(STEPS)):
        workspace.show_step(place)
        bar = workspace.docks["information"].widget().horizontalScrollBar()
        qtbot.waitUntil(lambda bar=bar: bar.maximum() == 0 and not cut(), timeout=20_000)
    told = {b.objectName(): b.toolTip() for b in panel.findChildren(KeyButton)}
    assert told["annotate.review.reject"].endswith("(Strg+Umschalt+X)")
    assert told["annotate.move.loop"].endswith("(Umschalt+Leertaste)")
