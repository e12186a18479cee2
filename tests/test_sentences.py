"""What runs tell: English words that the app finds the sentence of again, with the same values in every language."""

from __future__ import annotations

import json
import string
import xml.etree.ElementTree as ET
from pathlib import Path

import pytest
from hypothesis import given
from hypothesis import strategies as st

from genmojo_core.sentences import SENTENCES, origin, say, translated

TRANSLATIONS = Path(__file__).resolve().parents[1] / "resources" / "translations"
NAMES = st.text(st.characters(categories=("L", "N", "P", "Zs")), min_size=1, max_size=20)


def fields(text: str) -> list[str]:
    return sorted(name for _, name, _, _ in string.Formatter().parse(text) if name is not None)


def spec(text: str, name: str) -> str:
    return next(spec or "" for _, field, spec, _ in string.Formatter().parse(text) if field == name)


@given(key=st.sampled_from(sorted(SENTENCES)), name=NAMES, number=st.floats(0, 1e6))
def test_words_lead_back_to_their_sentence(key: str, name: str, number: float) -> None:
    """Whatever objects are called: a translation that keeps the order gives the same words again."""
    text = SENTENCES[key]
    words = say(key, **{field: number if spec(text, field) else name for field in fields(text)})
    seen: list[str] = []

    def quoted(template: str) -> str:
        seen.append(template)
        return template

    assert translated(words, quoted) == words
    assert seen, words


def test_values_move_and_sentences_inside_are_translated_too() -> None:
    german = {
        SENTENCES["depth_guess"]: "aus {method} kommt die Tiefe",
        SENTENCES["depth_method"]: "Bodenkontakt",
        SENTENCES["prior_off"]: "{reason}: kein Prior für {name}",
    }
    words = say("depth_guess", method=say("depth_method"))
    assert translated(words, german.__getitem__) == "aus Bodenkontakt kommt die Tiefe"
    words = say("prior_off", name="the {red} ball", reason="too small")
    assert translated(words, german.__getitem__) == "too small: kein Prior für the {red} ball"


@pytest.mark.parametrize("key", [key for key, text in SENTENCES.items() if "{point}" in text])
def test_a_point_inside_a_sentence_is_not_taken_for_the_sentence(key: str) -> None:
    point = say("point_of", number=3, name="the car, frame 2")
    words = say(key, point=point, frames=say("frames", first=2, last=5))
    template, values = origin(words)
    assert template == SENTENCES[key] and values["point"] == point


def test_words_of_nobody_come_back_as_they_are() -> None:
    assert translated("Something a newer worker says: 3 of 4", str.upper) == "Something a newer worker says: 3 of 4"


@pytest.mark.parametrize("path", sorted(TRANSLATIONS.glob("*.ts")), ids=lambda path: path.stem)
def test_translations_are_there_and_take_the_same_values(path: Path) -> None:
    found = {m.findtext("source"): m.findtext("translation") or "" for m in ET.parse(path).iter("message")}
    faults = json.loads((TRANSLATIONS / "faults.json").read_text("utf-8"))
    for text in (*SENTENCES.values(), *faults):
        assert found.get(text), text
        assert fields(found[text]) == fields(text), text
