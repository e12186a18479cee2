"""From "Edit this mask" to a run that uses it: the annotator draws, the plan is made anew, the worker's clip has it."""

from pathlib import Path

import numpy as np
from PySide6.QtTest import QTest

from genmojo_core.clip import folders
from genmojo_studio.annotate.masks import Purpose
from genmojo_studio.worker import preparing

_BOX = (60.0, 40.0, 200.0, 160.0)


def test_an_edited_mask_reaches_the_plan_and_the_run(window, qtbot, told):
    window.open_demo()
    qtbot.waitUntil(lambda: window.state.clip is not None, timeout=60_000)
    watch = window.workspaces["watch"]
    qtbot.waitUntil(lambda: bool(watch.setup.effects.rows), timeout=120_000)
    assert watch.setup.request().masks == ""
    before = window.state.clip.masks.value.copy()
    edited = int(window.state.clip.object_ids[1])
    window.state.set(selected_object=edited)
    assert window.table.trigger("view.edit_mask")
    qtbot.waitUntil(lambda: window.workspace == "annotate", timeout=60_000)  # it is loaded first
    annotate = window.workspaces["annotate"]
    qtbot.waitUntil(lambda: annotate.session is not None and annotate.session.clip is not None, timeout=60_000)
    qtbot.waitUntil(lambda: annotate.session.active[0] == edited, timeout=60_000)
    qtbot.waitUntil(lambda: annotate.objects.target() == (Purpose.CORRECT, edited), timeout=60_000)
    assert annotate.step == 0
    annotate.work.masks.add_box(*_BOX)
    annotate.work.masks.cut()
    qtbot.waitUntil(lambda: window.state.masks_path is not None, timeout=60_000)

    clip = window.state.clip
    assert clip.object_ids.tolist() == folders.read(window.state.clip_path).object_ids.tolist()
    assert (clip.masks.value != before).any()
    window.show_workspace("watch")
    qtbot.waitUntil(lambda: bool(watch.setup.effects.rows), timeout=120_000)
    QTest.qWait(50)
    assert watch.run_tabs.currentIndex() == 0 and not told
    request = watch.setup.request()
    assert Path(request.masks) == window.state.masks_path
    prepared, _, _ = preparing.prepare(request, lambda *_: None, lambda: False)
    k = prepared.object_ids.tolist().index(edited) + 1
    assert prepared.masks.source.endswith(".masks.npz")
    held, used = clip.masks.value == k, prepared.masks.value == k
    np.testing.assert_allclose(used.mean((1, 2)), held.mean((1, 2)), atol=0.01)

    window.state.set(clip=None, clip_path=None, masks_path=None)
    window.read_clip(Path(request.clip), "watch")  # opened again, another day
    qtbot.waitUntil(lambda: window.state.masks_path is not None, timeout=60_000)
    np.testing.assert_array_equal(window.state.clip.masks.value, clip.masks.value)
