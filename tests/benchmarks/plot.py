"""Cost against contributing pairs as a picture: measured times of a rasteriser and the straight line through them."""

from __future__ import annotations

from pathlib import Path

import cv2
import numpy as np

SIZE, MARGIN = (1200, 800), (110, 90)  # pixels: width and height; left and bottom
COLOURS = {2_000: (190, 120, 30), 10_000: (40, 140, 40), 50_000: (50, 60, 200)}  # BGR by number of splats
DARK, FAINT = (60, 60, 60), (225, 225, 225)


def linear_cost(rows: list[dict[str, float]]) -> dict[str, float]:
    """Least squares of seconds = per_pair * pairs + per_splat * splats + per_picture in relative error, and errors."""
    pairs = np.array([row["pairs"] for row in rows])
    splats = np.array([row["count"] for row in rows])
    seconds = np.array([row["forward"] + row["backward"] for row in rows])
    table = np.stack([pairs, splats, np.ones(len(rows))], axis=1) / seconds[:, None]
    found, *_ = np.linalg.lstsq(table, np.ones(len(rows)), rcond=None)
    error = np.abs(table @ found - 1)
    per_pair, per_splat, per_picture = (float(one) for one in found)
    return {"per_pair": per_pair, "per_splat": per_splat, "per_picture": per_picture,
            "worst_error": float(error.max()), "median_error": float(np.median(error))}  # fmt: skip


def draw_plot(rows: list[dict[str, float]], path: Path) -> None:
    """Write a PNG: milliseconds over millions of pairs, both logarithmic, one colour per number of splats."""
    picture = np.full((SIZE[1], SIZE[0], 3), 255, np.uint8)
    cost = linear_cost(rows)
    pairs = [row["pairs"] / 1e6 for row in rows]
    times = [1e3 * (row["forward"] + row["backward"]) for row in rows]
    axes = _Axes((min(pairs) / 1.5, max(pairs) * 1.5), (min(times) / 2, max(times) * 1.5))
    _grid(picture, axes)
    for count, colour in COLOURS.items():
        members = [row for row in rows if row["count"] == count]
        if not members:
            continue
        fixed = cost["per_splat"] * count + cost["per_picture"]
        line = [axes.place(x, 1e3 * (cost["per_pair"] * 1e6 * x + fixed))
                for x in np.geomspace(*axes.x, 100)]  # fmt: skip
        cv2.polylines(picture, [np.array(line, np.int32)], False, colour, 1, cv2.LINE_AA)
        for row in members:
            place = axes.place(row["pairs"] / 1e6, 1e3 * (row["forward"] + row["backward"]))
            cv2.circle(picture, place, 7, colour, -1, cv2.LINE_AA)
            _write(picture, f"{int(row['width'])}x{int(row['height'])}", (place[0] + 10, place[1] + 16), colour, 0.42)
    for number, (count, colour) in enumerate(COLOURS.items()):
        _write(picture, f"{count:,} splats", (MARGIN[0] + 20, 70 + 26 * number), colour, 0.6)
    _write(picture, "Forward + backward, one thread: CPU milliseconds over millions of (splat, pixel) pairs",
           (MARGIN[0], 32), DARK, 0.62)  # fmt: skip
    _write(picture, f"lines: {1e9 * cost['per_pair']:.2f} ns per pair + {1e9 * cost['per_splat']:.0f} ns per splat"
           f" + {1e3 * cost['per_picture']:.2f} ms, median error {100 * cost['median_error']:.0f} %",
           (MARGIN[0] + 330, SIZE[1] - 24), DARK, 0.55)  # fmt: skip
    cv2.imwrite(str(path), picture)


class _Axes:
    """Two logarithmic axes: values to pixels."""

    def __init__(self, x: tuple[float, float], y: tuple[float, float]) -> None:
        self.x, self.y = x, y

    def place(self, x: float, y: float) -> tuple[int, int]:
        """Pixel of a point."""
        across = np.log(x / self.x[0]) / np.log(self.x[1] / self.x[0])
        up = np.log(y / self.y[0]) / np.log(self.y[1] / self.y[0])
        right, top = SIZE[0] - 40, 50
        return int(MARGIN[0] + across * (right - MARGIN[0])), int(
            SIZE[1] - MARGIN[1] - up * (SIZE[1] - MARGIN[1] - top)
        )


def _grid(picture: np.ndarray, axes: _Axes) -> None:
    """Lines and numbers at 1, 2, 5, 10, ..."""
    for decade in range(-2, 5):
        for digit in (1, 2, 5):
            value = digit * 10.0**decade
            if axes.x[0] <= value <= axes.x[1]:
                x, _ = axes.place(value, axes.y[0])
                cv2.line(picture, (x, 50), (x, SIZE[1] - MARGIN[1]), FAINT, 1)
                _write(picture, f"{value:g} M", (x - 18, SIZE[1] - MARGIN[1] + 24), DARK, 0.5)
            if axes.y[0] <= value <= axes.y[1]:
                _, y = axes.place(axes.x[0], value)
                cv2.line(picture, (MARGIN[0], y), (SIZE[0] - 40, y), FAINT, 1)
                _write(picture, f"{value:g} ms", (18, y + 5), DARK, 0.5)


def _write(picture: np.ndarray, text: str, place: tuple[int, int], colour: tuple[int, int, int], size: float) -> None:
    cv2.putText(picture, text, place, cv2.FONT_HERSHEY_SIMPLEX, size, colour, 1, cv2.LINE_AA)
