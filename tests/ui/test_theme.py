"""Colours people can read, and every text translated."""

import subprocess
import sys
from dataclasses import asdict
from pathlib import Path

import pytest

from genmojo_studio.theme import THEMES, contrast

_ROOT = Path(__file__).resolve().parents[2]


@pytest.mark.parametrize("theme", THEMES)
def test_text_stands_out_from_every_surface(theme):
    table = asdict(THEMES[theme])
    for surface in ("window", "panel", "field", "raised"):
        for ink in ("text", "dim", "good", "warn", "bad"):
            assert contrast(table[ink], table[surface]) >= 4.5, (ink, surface)
        assert contrast(table["accent"], table[surface]) >= 3.0 or surface == "raised", surface
    assert contrast(table["on_accent"], table["accent"]) >= 3.9


def test_contrast_is_that_of_wcag():
    assert contrast("#000000", "#ffffff") == pytest.approx(21.0)
    assert contrast("#777777", "#ffffff") == pytest.approx(4.48, abs=0.01)


def test_nearly_every_text_is_translated():
    """`packaging/translations.py` names what is missing; new texts are English until somebody translates them."""
    script = _ROOT / "packaging" / "translations.py"
    run = subprocess.run([sys.executable, str(script), "--check"], capture_output=True, text=True, timeout=60)
    done, of = (int(run.stdout.split()[i]) for i in (1, 3))
    assert done >= 0.95 * of, run.stdout


def test_the_german_window_is_german(qapp):
    from PySide6.QtCore import QCoreApplication, QLocale

    from genmojo_studio import translate

    translators = translate.install("de")
    try:
        assert translate.tr("Open the demo clip") == "Demo-Clip öffnen"
    finally:
        for translator in translators:
            QCoreApplication.removeTranslator(translator)
        QLocale.setDefault(QLocale.system())
    assert translate.tr("Open the demo clip") == "Open the demo clip"
