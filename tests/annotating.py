"""What a person does in the annotator, for tests of its window: clicks, objects chosen, points placed."""

import numpy as np
from PySide6.QtCore import QPoint, Qt
from PySide6.QtTest import QTest

from genmojo_core.tracks import keys
from genmojo_core.tracks.annotation import TRACKER, Proposal
from genmojo_core.tracks.model import VISIBLE


def at(workspace, x, y):
    """Widget pixel of a raster position."""
    wx, wy = workspace.canvas.mapping.to_widget(x, y)
    return QPoint(round(wx), round(wy))


def click(workspace, x, y):
    QTest.mouseClick(workspace.canvas, Qt.MouseButton.LeftButton, Qt.KeyboardModifier.NoModifier, at(workspace, x, y))


def choose_all(workspace):
    for row in range(workspace.objects.table.rowCount()):
        workspace.objects.table.selectRow(row)
        workspace.objects.choose_button.click()


def place_points(workspace, each=2):
    """Step 2 with `each` points per object, on their masks; returns the raster places."""
    workspace.show_step(1)
    session = workspace.session
    labels = session.cache.mask(0)
    placed = []
    for info in session.objects():
        session.select(info.id, 1)
        rows, columns = np.nonzero(labels == info.id)
        for share in np.linspace(0.3, 0.7, each):
            k = int(share * len(rows))
            placed.append((columns[k] + 0.5, rows[k] + 0.5))
            click(workspace, *placed[-1])
    return placed


def fill(workspace):
    """Tracks that stay where they were placed and are always visible: no tracker needed. Selects the first."""
    session = workspace.session
    frames = session.annotation.frames
    found = {}
    for track in session.annotation.tracks:
        xy = np.repeat(session.annotation.track(track).xy[:1], frames, axis=0)
        found[track] = Proposal("still", xy, np.full(frames, VISIBLE, np.uint8), np.full(frames, 0.9, np.float32))
    session.do(keys.accept(session.annotation, found, TRACKER))
    session.select_track(next(iter(found)))


def refine(workspace, each):
    """Step 3 with `each` points per object, filled without a tracker, which rests from now on."""
    choose_all(workspace)
    place_points(workspace, each=each)
    fill(workspace)
    workspace.show_step(2)
    workspace.work.tracker.close()
