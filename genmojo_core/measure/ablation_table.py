"""The ablation's table as HTML and PNG, in the paper's order: variants down, figures across."""

from __future__ import annotations

import html
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

import cv2
import numpy as np

from genmojo_core.measure.sheet import encode_png
from genmojo_core.store.atomic import write_bytes

# figure, heading, more is better (None: neither), digits
COLUMNS: tuple[tuple[str, str, bool | None, int], ...] = (
    ("ate", "ATE", False, 2), ("mte", "MTE", False, 2), ("a_epe", "A-EPE", False, 2), ("m_epe", "M-EPE", False, 2),
    ("oa", "OA", True, 1), ("psnr", "PSNR", True, 2), ("iou_30", "IoU 30", True, 3),
    ("psnr_inside_30", "in 30", True, 2), ("iou_90", "IoU 90", True, 3), ("psnr_inside_90", "in 90", True, 2),
    ("psnr_union_90", "union 90", True, 2), ("iou_180", "IoU 180", True, 3), ("psnr_inside_180", "in 180", True, 2),
    ("psnr_union_180", "union 180", True, 2), ("cpu_seconds", "CPU s", False, 0),
    ("saves", "saves s", None, 0), ("steps", "steps", None, 0),
)  # fmt: skip
_ROW, _FIRST, _WIDTH = 34, 230, 98  # pixels


def cells(entries: Sequence[Mapping[str, Any]]) -> tuple[list[str], list[list[str]], list[list[bool]]]:
    """Headings, texts and which of them are the best of their column; columns that nobody has are left out."""
    columns = [c for c in COLUMNS if any(c[0] in e["mean"] for e in entries)]
    texts, best = [], []
    for entry in entries:
        line, marks = [entry["title"]], [False]
        for key, _, more, digits in columns:
            value = entry["mean"].get(key)
            every = [e["mean"][key] for e in entries if key in e["mean"]]
            text = "" if value is None else f"{value:.{digits}f}"
            if value is not None and entry["seeds"] > 1:
                text += f" ±{entry['spread'][key]:.{digits}f}"
            line.append(text)
            marks.append(value is not None and more is not None and value == (max(every) if more else min(every)))
        texts.append(line)
        best.append(marks)
    return ["variant", *(c[1] for c in columns)], texts, best


def write_html(entries: Sequence[Mapping[str, Any]], title: str, path: Path) -> None:
    """A page of its own, no scripts. Raises GenmojoError("io")."""
    heads, texts, best = cells(entries)
    lines = [f"<tr>{''.join(f'<th>{html.escape(h)}</th>' for h in heads)}</tr>"]
    for line, marks in zip(texts, best, strict=True):
        row = (f"<td{' class=best' if m else ''}>{html.escape(t)}</td>" for t, m in zip(line, marks, strict=True))
        lines.append(f"<tr>{''.join(row)}</tr>")
    notes = "".join(f"<li>{html.escape(e['title'])}: {html.escape(n)}</li>" for e in entries for n in e["notes"])
    page = (
        f"<!doctype html><meta charset=utf-8><title>{html.escape(title)}</title><style>body{{font:14px sans-serif;"
        "margin:2em}table{border-collapse:collapse}td,th{padding:.35em .55em;text-align:right;border-bottom:1px solid "
        "#ccc}td:first-child,th:first-child{text-align:left}.best{font-weight:bold}</style>"
        f"<h1>{html.escape(title)}</h1><table>{''.join(lines)}</table><p>Tracks in pixels of 256 x 256; IoU of "
        "silhouettes, PSNR inside both silhouettes (in) and in either (union) at ±30, ±90 and 180 degrees; saves: CPU "
        f"seconds against full; bold is best. Means over seeds, ± standard deviation.</p><ul>{notes}</ul>"
    )
    write_bytes(path, page.encode())


def write_png(entries: Sequence[Mapping[str, Any]], title: str, path: Path) -> None:
    """The same table as a picture. Raises GenmojoError("io")."""
    heads, texts, best = cells(entries)
    wide = _WIDTH + (40 if any("±" in t for line in texts for t in line) else 0)
    picture = np.full((_ROW * (len(texts) + 2) + 20, _FIRST + wide * (len(heads) - 1) + 20, 3), 255, np.uint8)
    _write(picture, title, (12, _ROW - 10), True)
    for i, line in enumerate([heads, *texts]):
        y = _ROW * (i + 2) - 10
        for j, text in enumerate(line):
            strong = i == 0 or best[i - 1][j]
            x = 12 if j == 0 else _FIRST + wide * (j - 1)
            _write(picture, text.replace("±", "+-"), (x, y), strong)
        cv2.line(picture, (8, y + 10), (picture.shape[1] - 8, y + 10), (200, 200, 200), 1)
    write_bytes(path, encode_png(picture))


def _write(picture: np.ndarray, text: str, at: tuple[int, int], strong: bool) -> None:
    """One text, in place."""
    cv2.putText(picture, text, at, cv2.FONT_HERSHEY_SIMPLEX, 0.5, (20, 20, 20), 2 if strong else 1, cv2.LINE_AA)
