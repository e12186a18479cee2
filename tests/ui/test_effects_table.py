"""The effect table speaks the person's language, and shows what a report measured instead of what is predicted."""

from __future__ import annotations

from PySide6.QtCore import QCoreApplication, QLocale

from genmojo_core.config import preset
from genmojo_core.effects.decide import plan
from genmojo_studio import translate
from genmojo_studio.watch.effects_table import EffectsTable
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
        assert items["depth_order"].text(2) == "12.5 ms gemessen" and "+1.25 dB („bear“)" in items[
            "depth_order"
        ].toolTip(0)
        assert items["background"].text(2).endswith(" ms")
    finally:
        for translator in translators:
            QCoreApplication.removeTranslator(translator)
        QLocale.setDefault(QLocale.system())
