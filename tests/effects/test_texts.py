"""What the plan says, by key: the English reason is these texts, and every language fills in the same values."""

from __future__ import annotations

import json
import string
import xml.etree.ElementTree as ET
from pathlib import Path

import pytest

from genmojo_core.effects import machine
from genmojo_core.effects.decide import plan
from genmojo_core.effects.texts import TEXTS, UNITS, sentence
from genmojo_core.measure import effect_costs
from tests.effects.test_effects import CONFIG, two_apart

TRANSLATIONS = Path(__file__).resolve().parents[2] / "resources" / "translations"


def fields(text: str) -> set[str]:
    return {name for _, name, _, _ in string.Formatter().parse(text) if name is not None}


def test_reasons_are_their_keys_in_words_and_survive_json() -> None:
    for effect in plan(two_apart(), CONFIG, {"flow": False}).effects:
        row = json.loads(json.dumps(vars(effect)))
        assert sentence(row["said"]) == effect.reason and sentence(row["origin_said"]) == effect.origin
        assert effect.unit in UNITS
        spoken = sentence(row["said"], str.upper) if "{" not in "".join(TEXTS[k] for k, _ in row["said"]) else ""
        assert spoken == spoken.upper()


def test_a_run_that_changes_its_mind_says_so_in_its_own_words() -> None:
    changed = plan(two_apart(), CONFIG).changed("shading", on=True, reason="Seen.").get("shading")
    assert changed.reason == "Seen." and changed.said == () and changed.origin_said
    decided = plan(two_apart(), CONFIG).decided("shading", False, ("no_shading", {"percent": 3.2})).get("shading")
    assert not decided.on and decided.reason == sentence(decided.said) and "explains 3 %" in decided.reason


@pytest.mark.parametrize("path", sorted(TRANSLATIONS.glob("*.ts")), ids=lambda path: path.stem)
def test_translations_are_there_and_take_the_same_values(path: Path) -> None:
    found = {m.findtext("source"): m.findtext("translation") or "" for m in ET.parse(path).iter("message")}
    for text in (*TEXTS.values(), *UNITS):
        assert found.get(text), text
        assert fields(found[text]) == fields(text), text


def test_costs_of_a_report_are_known_later(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(machine, "user_cache", lambda: tmp_path)
    assert machine.known_costs() == {}
    part = {"title": "non rigid motion", "kind": "effect", "ms": 12.5, "gain": {"psnr": 1.25}}
    assert effect_costs.keep_report({"clip": "cups", "parts": [part, {**part, "title": "rgb", "kind": "loss"}]})
    assert machine.known_costs() == {"non_rigid_motion": {"psnr": 1.25, "psnr_clip": "cups"}}
    measured = plan(two_apart(), CONFIG).changed("non_rigid_motion", measured_ms=9.5)
    assert effect_costs.keep_run("bear", measured)
    both = {"ms": 9.5, "ms_clip": "bear", "psnr": 1.25, "psnr_clip": "cups"}
    assert machine.known_costs() == {"non_rigid_motion": both}
    assert not effect_costs.keep_run("bear", plan(two_apart(), CONFIG))
    machine.costs_file().write_text("[]")
    assert machine.known_costs() == {}
