"""Plain charts for reports: one list of shapes, written as SVG into a page or drawn into a PNG."""

from __future__ import annotations

import html
import math
from collections.abc import Sequence
from dataclasses import dataclass, field

import cv2
import numpy as np

from genmojo_core.measure.sheet import encode_png

SERIES = ("#0072b2", "#d55e00", "#009e73", "#cc79a7", "#e69f00", "#56b4e9", "#555555")  # told apart by all eyes
INK, DIM, GRID = "#1a1a1a", "#666666", "#e4e4e4"
_LEFT, _RIGHT, _TOP, _BOTTOM = 58, 14, 26, 44  # pixels around the plot
_LEGEND_ROW = 18


@dataclass(frozen=True)
class Series:
    """Points (x, y) of one kind: joined by a line, marked with dots, or both. `dashed` for what is not measured."""

    title: str
    points: Sequence[tuple[float, float]]
    color: str
    line: bool = True
    dots: bool = False
    width: float = 1.8
    dashed: bool = False


@dataclass
class Chart:
    """Axes, their titles and series. `log_x`, `log_y` need positive values."""

    x_title: str
    y_title: str
    series: list[Series] = field(default_factory=list)
    log_x: bool = False
    log_y: bool = False
    size: tuple[int, int] = (760, 380)
    legend: bool = True

    def shapes(self) -> list[tuple]:
        """("line", points, color, width, dashed), ("dot", x, y, color), ("text", x, y, text, anchor, color, strong)."""
        width, height = self.size
        across = _Axis([x for s in self.series for x, _ in s.points], self.log_x, _LEFT, width - _RIGHT)
        up = _Axis([y for s in self.series for _, y in s.points], self.log_y, height - _BOTTOM, _TOP)
        made: list[tuple] = []
        for value, at in across.ticks():
            made += [
                ("line", [(at, _TOP), (at, height - _BOTTOM)], GRID, 1.0, False),
                ("text", at, height - _BOTTOM + 16, _number(value), "middle", DIM, False),
            ]
        for value, at in up.ticks():
            made += [
                ("line", [(_LEFT, at), (width - _RIGHT, at)], GRID, 1.0, False),
                ("text", _LEFT - 7, at + 4, _number(value), "end", DIM, False),
            ]
        made.append(
            ("line", [(_LEFT, _TOP), (_LEFT, height - _BOTTOM), (width - _RIGHT, height - _BOTTOM)], DIM, 1.0, False)
        )
        for s in self.series:
            places = [(across.at(x), up.at(y)) for x, y in s.points]
            if s.line and len(places) > 1:
                made.append(("line", places, s.color, s.width, s.dashed))
            made += [("dot", x, y, s.color) for x, y in places if s.dots or len(places) == 1]
        made += [
            ("text", (width + _LEFT) / 2, height - 8, self.x_title, "middle", INK, False),
            ("text", _LEFT, 14, self.y_title, "start", INK, False),
        ]
        return made + (self._legend() if self.legend else [])

    def _legend(self) -> list[tuple]:
        """Titles of the series in the lower right corner, where curves that rise leave room."""
        width, height = self.size
        titled = [s for s in self.series if s.title]
        left = width - _RIGHT - 12 - 7.2 * max((len(s.title) for s in titled), default=0)
        made: list[tuple] = []
        for i, s in enumerate(titled):
            y = height - _BOTTOM - 12 - _LEGEND_ROW * (len(titled) - 1 - i)
            if s.line:
                made.append(("line", [(left - 28, y - 4), (left - 8, y - 4)], s.color, s.width, s.dashed))
            if s.dots:
                made.append(("dot", left - 18, y - 4, s.color))
            made.append(("text", left, y, s.title, "start", INK, False))
        return made

    def svg(self) -> str:
        """The chart as an SVG element."""
        width, height = self.size
        body = "".join(_svg(shape) for shape in self.shapes())
        return (
            f'<svg viewBox="0 0 {width} {height}" width="{width}" height="{height}" role="img" '
            f'aria-label="{html.escape(self.y_title)} against {html.escape(self.x_title)}">{body}</svg>'
        )

    def png(self, title: str, factor: int = 2) -> bytes:
        """The chart with a title above it as PNG, `factor` times as large."""
        width, height = self.size
        image = np.full(((height + 30) * factor, width * factor, 3), 255, np.uint8)
        _put(image, ("text", 12, 20, title, "start", INK, True), factor, 0)
        for shape in self.shapes():
            _put(image, shape, factor, 30)
        return encode_png(image)


class _Axis:
    """Values to pixels."""

    def __init__(self, values: Sequence[float], log: bool, first: float, last: float) -> None:
        known = [v for v in values if math.isfinite(v) and (v > 0 or not log)] or [1.0]
        self._log, self._first, self._last = log, first, last
        low, high = (math.log10(v) if log else v for v in (min(known), max(known)))
        room = 0.04 * (high - low) or 0.5
        self._low, self._high = low - room, high + room

    def at(self, value: float) -> float:
        """Pixel of a value."""
        place = math.log10(max(value, 1e-12)) if self._log else value
        return self._first + (place - self._low) / (self._high - self._low) * (self._last - self._first)

    def ticks(self) -> list[tuple[float, float]]:
        """Round values with their pixels, about six of them."""
        if self._log:
            for steps in ((1.0,), (1.0, 3.0), (1.0, 2.0, 5.0), (1.0, 1.5, 2.0, 3.0, 4.0, 6.0, 8.0)):
                decades = range(math.floor(self._low), math.ceil(self._high) + 1)
                values = [s * 10.0**d for d in decades for s in steps]
                inside = [v for v in values if self._low <= math.log10(v) <= self._high]
                if len(inside) >= 4:
                    break
            if len(inside) < 3:  # the values lie close together
                inside = _round_values(10.0**self._low, 10.0**self._high, 3)
        else:
            inside = _round_values(self._low, self._high, 6)
        return [(v, self.at(v)) for v in inside]


def _round_values(low: float, high: float, about: int) -> list[float]:
    """Multiples of a round step between two numbers."""
    step = _round_step((high - low) / about)
    return [i * step for i in range(math.ceil(low / step), math.floor(high / step) + 1)]


def _round_step(step: float) -> float:
    """The next of 1, 2, 5 times a power of ten."""
    power = 10.0 ** math.floor(math.log10(step))
    return next(s * power for s in (1.0, 2.0, 5.0, 10.0) if s * power >= step)


def _number(value: float) -> str:
    """Short, thousands as k."""
    return f"{value / 1000:g}k" if abs(value) >= 10_000 else f"{value:.4g}"


def _svg(shape: tuple) -> str:
    kind = shape[0]
    if kind == "line":
        _, places, color, width, dashed = shape
        path = " ".join(f"{x:.1f},{y:.1f}" for x, y in places)
        dash = ' stroke-dasharray="6 4"' if dashed else ""
        return f'<polyline points="{path}" fill="none" stroke="{color}" stroke-width="{width}"{dash}/>'
    if kind == "dot":
        _, x, y, color = shape
        return f'<circle cx="{x:.1f}" cy="{y:.1f}" r="3.6" fill="{color}" stroke="#fff"/>'
    _, x, y, text, anchor, color, _ = shape
    return f'<text x="{x:.1f}" y="{y:.1f}" text-anchor="{anchor}" fill="{color}">{html.escape(text)}</text>'


def _put(image: np.ndarray, shape: tuple, factor: int, down: int) -> None:
    """One shape into the picture, in place."""

    def place(x: float, y: float) -> tuple[int, int]:
        return round(x * factor), round((y + down) * factor)

    def color(name: str) -> tuple[int, ...]:
        return tuple(int(name[i : i + 2], 16) for i in (1, 3, 5))

    if shape[0] == "line":
        _, places, name, width, _ = shape
        path = np.array([place(x, y) for x, y in places], np.int32)
        cv2.polylines(image, [path], False, color(name), max(1, round(width * factor)), cv2.LINE_AA)
    elif shape[0] == "dot":
        cv2.circle(image, place(shape[1], shape[2]), round(3.6 * factor), color(shape[3]), -1, cv2.LINE_AA)
    else:
        _, x, y, text, anchor, name, strong = shape
        scale, thick = 0.42 * factor, factor if strong else max(1, factor // 2)
        plain = text.replace("×", "x").replace("±", "+-")
        length = cv2.getTextSize(plain, cv2.FONT_HERSHEY_SIMPLEX, scale, thick)[0][0]
        back = {"start": 0, "middle": length // 2, "end": length}[anchor]
        left, base = place(x, y)
        cv2.putText(image, plain, (left - back, base), cv2.FONT_HERSHEY_SIMPLEX, scale, color(name), thick, cv2.LINE_AA)


def table(heads: Sequence[str], lines: Sequence[Sequence[str]], strong: Sequence[int] = ()) -> str:
    """An HTML table: first column text, the others numbers; lines numbered in `strong` are set off. Cells are escaped
    unless they begin with "<".
    """
    top = "".join(f"<th>{html.escape(head)}</th>" for head in heads)
    rows = []
    for i, line in enumerate(lines):
        cells = "".join(f"<td>{cell if cell.startswith('<') else html.escape(cell)}</td>" for cell in line)
        rows.append(f"<tr{' class=strong' if i in strong else ''}>{cells}</tr>")
    return f"<table><thead><tr>{top}</tr></thead><tbody>{''.join(rows)}</tbody></table>"
