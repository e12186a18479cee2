"""Finds every text of the app, updates resources/translations/*.ts and compiles them to .qm.

    python packaging/translations.py            # update and compile
    python packaging/translations.py --check    # exit 1 if a text is missing, unfinished or not compiled

Texts are the arguments of `tr("...")` and `mark("...")` in genmojo_studio, those of the action tables, of the effect
plan (genmojo_core/effects/texts.py), of what runs and edits tell (genmojo_core/sentences.py) and of faults
(fault_texts.py; the app finds them again by faults.json). Qt's own lupdate does not know such tables, so the source is
read here; pyside6-lrelease compiles.
"""

from __future__ import annotations

import ast
import json
import subprocess
import sys
import xml.etree.ElementTree as ET
from pathlib import Path

from fault_texts import fault_texts

ROOT = Path(__file__).resolve().parent.parent
FOLDER = ROOT / "resources" / "translations"
CONTEXT = "studio"
LANGUAGES = ("de",)
FAULTS = FOLDER / "faults.json"


def source_texts() -> list[str]:
    """All English texts, those of faults last."""
    return list(dict.fromkeys([*app_texts(), *fault_texts(ROOT)]))


def app_texts() -> list[str]:
    """English texts that the app shows as they stand, in the order of the files."""
    texts: dict[str, None] = {}
    for path in sorted((ROOT / "genmojo_studio").rglob("*.py")):
        for node in ast.walk(ast.parse(path.read_text(encoding="utf-8"))):
            texts |= dict.fromkeys(_argument(node))
    sys.path.insert(0, str(ROOT))
    from genmojo_studio.app import all_actions

    for action in all_actions():
        for text in (action.text, action.help, *action.menu.split("/"), action.workspace.capitalize()):
            if text:
                texts[text] = None
    from genmojo_core.effects.texts import TEXTS, UNITS
    from genmojo_core.sentences import SENTENCES

    return list(texts | dict.fromkeys([*TEXTS.values(), *UNITS, *SENTENCES.values()]))


def update(language: str, texts: list[str]) -> list[str]:
    """Writes the .ts of a language with exactly these texts; returns those without a translation."""
    path = FOLDER / f"genmojo_{language}.ts"
    known = _translations(path)
    root = ET.Element("TS", version="2.1", language=language, sourcelanguage="en")
    context = ET.SubElement(root, "context")
    ET.SubElement(context, "name").text = CONTEXT
    for text in texts:
        message = ET.SubElement(context, "message")
        ET.SubElement(message, "source").text = text
        translation = ET.SubElement(message, "translation")
        if text in known:
            translation.text = known[text]
        else:
            translation.set("type", "unfinished")
    ET.indent(root)
    path.write_text(
        '<?xml version="1.0" encoding="utf-8"?>\n<!DOCTYPE TS>\n' + ET.tostring(root, "unicode") + "\n", "utf-8"
    )
    return [text for text in texts if text not in known]


def compile_language(language: str) -> None:
    """.ts to .qm by pyside6-lrelease of this environment."""
    program = Path(sys.executable).with_name("pyside6-lrelease")
    source = FOLDER / f"genmojo_{language}.ts"
    subprocess.run([str(program), "-silent", str(source), "-qm", str(source.with_suffix(".qm"))], check=True)


def main() -> int:
    """Updates and compiles, or checks."""
    texts = source_texts()
    faults = json.dumps(fault_texts(ROOT), indent=0, ensure_ascii=False) + "\n"
    missing = 0
    if "--check" not in sys.argv:
        FAULTS.write_text(faults, "utf-8")
    elif not FAULTS.exists() or FAULTS.read_text("utf-8") != faults:
        missing = 1
        sys.stdout.write(f"{FAULTS.name} is not that of the source; run this without --check\n")
    for language in LANGUAGES:
        if "--check" in sys.argv:
            known = _translations(FOLDER / f"genmojo_{language}.ts")
            unfinished = [text for text in texts if text not in known]
        else:
            unfinished = update(language, texts)
            compile_language(language)
        missing += len(unfinished)
        sys.stdout.write(f"{language}: {len(texts) - len(unfinished)} of {len(texts)} texts are translated\n")
        sys.stdout.writelines(f"  missing: {text}\n" for text in unfinished)
    return 1 if missing and "--check" in sys.argv else 0


def _translations(path: Path) -> dict[str, str]:
    """Finished translations of a .ts file."""
    if not path.exists():
        return {}
    found = {}
    for message in ET.parse(path).iter("message"):
        source, translation = message.findtext("source"), message.find("translation")
        if source and translation is not None and translation.text and translation.get("type") != "unfinished":
            found[source] = translation.text
    return found


def _argument(node: ast.AST) -> list[str]:
    """The text of a call tr("..."), if the node is one."""
    if not isinstance(node, ast.Call) or _name(node.func) not in ("tr", "mark") or not node.args:
        return []
    first = node.args[0]
    return [first.value] if isinstance(first, ast.Constant) and isinstance(first.value, str) else []


def _name(function: ast.expr) -> str:
    if isinstance(function, ast.Name):
        return function.id
    return function.attr if isinstance(function, ast.Attribute) else ""


if __name__ == "__main__":
    sys.exit(main())
