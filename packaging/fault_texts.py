"""The sentences of `GenmojoError` in the source: what is wrong and what to do, f-strings as templates with fields.

The app shows faults in the person's language: it finds the template again that some words were made from
(`genmojo_studio/translate.py`). Texts that a variable holds are not seen here.
"""

from __future__ import annotations

import ast
import re
from collections.abc import Iterator
from pathlib import Path

FEWEST = 4  # letters of its own that a template must have to be told from others
_NOT_SHOWN = ("cli", "cluster", "hard_cases")  # of the core: only the command line says these


def fault_texts(root: Path) -> list[str]:
    """Every template, each once, in the order of the files."""
    found: dict[str, None] = {}
    for package in ("genmojo_core", "genmojo_studio"):
        for path in sorted((root / package).rglob("*.py")):
            if path.relative_to(root).parts[1] in _NOT_SHOWN:
                continue
            source = path.read_text(encoding="utf-8")
            for node in ast.walk(ast.parse(source)) if "GenmojoError(" in source else ():
                if isinstance(node, ast.Call) and ast.unparse(node.func).endswith("GenmojoError"):
                    found |= dict.fromkeys(_texts(node))
    return [text for text in found if len(re.findall(r"[^\W\d_]", re.sub(r"\{[^}]*\}", "", text))) >= FEWEST]


def _texts(call: ast.Call) -> Iterator[str]:
    """What is wrong, and what to do about it."""
    given = {**dict(zip(("code", "what", "where", "hint"), call.args, strict=False)),
             **{word.arg: word.value for word in call.keywords if word.arg}}  # fmt: skip
    for name in ("what", "hint"):
        if name in given:
            yield from _templates(given[name])


def _templates(node: ast.expr) -> Iterator[str]:
    if isinstance(node, ast.IfExp):
        yield from _templates(node.body)
        yield from _templates(node.orelse)
    elif isinstance(node, ast.Constant) and isinstance(node.value, str):
        yield _escaped(node.value)
    elif isinstance(node, ast.JoinedStr):
        yield _template(node)


def _template(text: ast.JoinedStr) -> str:
    """An f-string as a template; fields are called after the variables in them."""
    made, names = "", []
    for part in text.values:
        if isinstance(part, ast.FormattedValue):
            words = re.findall(r"[a-z][a-z_]+", ast.unparse(part.value)) or ["value"]
            name = words[-1].strip("_")
            name = f"{name}_{names.count(name) + 1}" if name in names else name
            names.append(words[-1].strip("_"))
            spec = ast.unparse(part.format_spec)[2:-1] if part.format_spec is not None else ""
            made += f"{{{name}:{spec}}}" if spec else f"{{{name}}}"
        elif isinstance(part, ast.Constant):
            made += _escaped(str(part.value))
    return made


def _escaped(text: str) -> str:
    return text.replace("{", "{{").replace("}", "}}")
