"""The effect table speaks the person's language, and shows what a report measured instead of what is predicted."""

from __future__ import annotations

import json

from PySide6.QtCore import QCoreApplication, QLocale, Qt

from genmojo_core.config import preset
from genmojo_core.effects.decide import plan
from genmojo_core.events import EffectChanged
from genmojo_studio import translate
from genmojo_studio.state import AppState
from genmojo_studio.watch.curves import Curves
from genmojo_studio.watch.effects_table import EffectsTable
from genmojo_studio.watch.run_log import RunLog
from tests.effects.test_effects import two_apart


def test_evidence_is_told_in_german_with_measured_costs(qtbot):
    rows = plan(two_apart(), preset("draft"), {"flow": False}).to_json()
    known = {"ms_clip": "cups", "ms": 12.5, "psnr": 1.25, "psnr_clip": "bear"}
    rows = [{**row, "known": known if row["name"] == "depth_order" else None} for row in rows]
    translators = translate.install("de")
    try:
        table = EffectsTable()
        qtbot.addWidget(table)
        table.show_rows(rows)
        items = {row["name"]: table.topLevelItem(i) for i, row in enumerate(rows)}
        assert "Das Licht bleibt gleich." in items["appearance_change"].toolTip(0)
        assert "stetiges Licht" in items["appearance_change"].toolTip(0)
        assert "% Helligkeit" in items["appearance_change"].text(1)
        assert items["flow"].toolTip(0).startswith("Von Hand ausgeschaltet. Der Fluss gilt in")
        assert items["depth_order"].text(2) == "12,5 ms" and "+1,25 dB („bear“)" in items["depth_order"].toolTip(0)
        assert items["background"].text(2).startswith("≈ ")
        log = RunLog()
        run_plan = plan(two_apart(), preset("draft")).decided("shading", False, ("no_shading", {"percent": 3.2}))
        shading = run_plan.get("shading")
        event = EffectChanged(1.0, 1.0, "shading", shading.on, shading.reason, shading.said)
        log.add(json.loads(json.dumps(event.to_json())))
        curves = Curves(AppState())
        qtbot.addWidget(curves)
        curves.show_log(log)
        curves._draw_marks()
        assert curves._mark_items[0].toolTip() == (
            "Wohin Flächen zeigen, erklärt 3 % ihrer Helligkeitsänderung: keine Schattierung."
        )
    finally:
        for translator in translators:
            QCoreApplication.removeTranslator(translator)
        QLocale.setDefault(QLocale.system())


def test_costs_that_a_run_measured_come_into_the_table_and_boxes_stay(qtbot):
    rows = plan(two_apart(), preset("draft")).to_json()
    table = EffectsTable()
    qtbot.addWidget(table)
    table.show_rows(rows)
    place = next(i for i, row in enumerate(rows) if row["name"] == "depth_order")
    table.topLevelItem(place).setCheckState(0, Qt.CheckState.Unchecked)
    wanted = table.overrides()
    table.show_costs({"background": {"ms": 7.25, "ms_clip": "cups"}})
    costs = {row["name"]: table.topLevelItem(i).text(2) for i, row in enumerate(rows)}
    assert costs["background"] == "7.2 ms" and costs["flow"].startswith("≈ ")
    assert table.overrides() == wanted != {}
