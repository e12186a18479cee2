"""Every text that a person reads goes through `tr`; the source language is English.

What the core says comes in English and is translated where it is shown: `told` for its sentences, `fault` for errors.

`resources/translations/genmojo_<language>.ts` hold the translations, compiled to .qm beside them by
`packaging/translations.py`, which finds the texts in the source and in the action tables.
"""

from __future__ import annotations

import json
import re
from functools import cache
from itertools import product
from numbers import Integral, Real
from pathlib import Path
from string import Formatter
from typing import Any

from PySide6.QtCore import QCoreApplication, QLibraryInfo, QLocale, QTranslator

from genmojo_core.errors import GenmojoError
from genmojo_core.sentences import origin, translated

CONTEXT = "studio"
FOLDER = Path(__file__).resolve().parent.parent / "resources" / "translations"
LANGUAGES = {"en": "English", "de": "Deutsch"}


class _Text(str):
    """A text into which numbers are put with the decimal point of the person's language."""

    __slots__ = ()

    def format(self, *args: Any, **values: Any) -> str:
        return _FORMATTER.vformat(self, args, values)


class _Formatter(Formatter):
    def format_field(self, value: Any, format_spec: str) -> str:
        words = str(super().format_field(value, format_spec))
        if isinstance(value, Real) and not isinstance(value, Integral):
            return words.replace(".", QLocale().decimalPoint())
        return words


_FORMATTER = _Formatter()


def tr(text: str) -> str:
    """A text in the person's language, whose `format` writes numbers as that language does.

    English where nobody has translated it.
    """
    return _Text(QCoreApplication.translate(CONTEXT, text))


def decimal(value: float, spec: str) -> str:
    """A number as `format` writes it, with the decimal point of the person's language."""
    return _FORMATTER.format_field(value, spec)


def told(words: str) -> str:
    """What the core told in English (genmojo_core/sentences.py), in the person's language."""
    return translated(words, tr, QLocale().decimalPoint())


def fault(error: GenmojoError | str) -> str:
    """The sentence of a GenmojoError in the person's language; also of one that another process said."""
    if isinstance(error, GenmojoError) and origin(error.what, _faults())[0]:
        return GenmojoError(error.code, _of_fault(error.what), error.where, _of_fault(error.hint)).sentence()
    sentence = str(error)
    body = sentence.removesuffix(".")
    starts = [0, *(cut.end() for cut in re.finditer(": ", body))]
    ends = [*(cut.start() for cut in re.finditer("; ", body)), len(body)]
    for start, end in product(starts, ends):
        what, hint = body[start:end], body[end + 2 :]
        if start < end and all(not words or origin(words, _faults())[0] for words in (what, hint)):
            return f"{body[:start]}{_of_fault(what)}{'; ' if hint else ''}{_of_fault(hint)}."
    return sentence


def _of_fault(words: str) -> str:
    """What is wrong, or what to do about it, in the person's language."""
    return translated(words, tr, QLocale().decimalPoint(), _faults())


@cache
def _faults() -> tuple[str, ...]:
    """What faults say, as sentences with fields; packaging/translations.py gathers them from the source."""
    return tuple(json.loads((FOLDER / "faults.json").read_text("utf-8")))


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
