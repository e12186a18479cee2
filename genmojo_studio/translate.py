"""Every text that a person reads goes through `tr`; the source language is English.

`resources/translations/genmojo_<language>.ts` hold the translations, compiled to .qm beside them by
`packaging/translations.py`, which finds the texts in the source and in the action tables.
"""

from __future__ import annotations

from pathlib import Path

from PySide6.QtCore import QCoreApplication, QLibraryInfo, QLocale, QTranslator

from genmojo_core.sentences import translated

CONTEXT = "studio"
FOLDER = Path(__file__).resolve().parent.parent / "resources" / "translations"
LANGUAGES = {"en": "English", "de": "Deutsch"}


def tr(text: str) -> str:
    """A text in the person's language; English where nobody has translated it."""
    return QCoreApplication.translate(CONTEXT, text)


def told(words: str) -> str:
    """What a run told in English (genmojo_core/sentences.py), in the person's language."""
    return translated(words, tr)


def mark(text: str) -> str:
    """A text of a table, translated by `tr` where it is shown; this only lets packaging/translations.py find it."""
    return text


def install(language: str) -> list[QTranslator]:
    """Switches the application to a language of `LANGUAGES`, or to the system's if it is empty.

    Returns the translators, which the caller keeps alive. Windows made before keep their language.
    """
    chosen = language or QLocale.system().name()[:2]
    if chosen not in LANGUAGES or chosen == "en":
        return []
    QLocale.setDefault(QLocale(chosen))
    installed = []
    for name, folder in (
        (f"genmojo_{chosen}", str(FOLDER)),
        (f"qtbase_{chosen}", QLibraryInfo.path(QLibraryInfo.LibraryPath.TranslationsPath)),
    ):
        translator = QTranslator()
        if translator.load(name, folder):
            QCoreApplication.installTranslator(translator)
            installed.append(translator)
    return installed
