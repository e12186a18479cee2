"""DeepLabCut's csv of labelled frames (its HDF5 may unpickle and is not read).

Header rows scorer, individuals (optional), bodyparts, coords; one row per frame, named by one column or three
('labeled-data', video, image). Pixels are counted from the centre of the first one; not seen = empty; no states. A
network's predictions have a likelihood: below DeepLabCut's own threshold the point counts as hidden, uncertain, and
nowhere in particular.
"""

from __future__ import annotations

import csv
import io
import re
from dataclasses import replace
from pathlib import Path

import numpy as np

from genmojo_core.errors import GenmojoError
from genmojo_core.store.atomic import write_bytes
from genmojo_core.store.track_sheet import TrackSheet, blank_tracks
from genmojo_core.tracks.annotation import UNCERTAIN
from genmojo_core.tracks.model import OCCLUDED, VISIBLE, PointTracks

CENTRE = 0.5
MAX_BYTES = 256 << 20
_INDEX = 3  # columns that name a frame
_SURE = 0.6  # likelihood: `pcutoff` of its configuration


def write(sheet: TrackSheet, path: str | Path, scorer: str = "genmojo") -> None:
    """Write the frames in which any point is seen. Raises GenmojoError("io")."""
    tracks = sheet.tracks
    rows = range(len(tracks.object))
    blank = [""] * (_INDEX - 1)
    points = _parts(sheet)
    heads = {"scorer": [scorer] * len(rows), "individuals": [sheet.name_of(int(i)) for i in tracks.object],
             "bodyparts": [points[int(n)] for n in sheet.numbers]}  # fmt: skip
    out = io.StringIO()
    writer = csv.writer(out, lineterminator="\n")
    for head, values in heads.items():
        writer.writerow([head, *blank, *(v for value in values for v in (value, value))])
    writer.writerow(["coords", *blank, *(["x", "y"] * len(rows))])
    for t in np.flatnonzero(tracks.visible.any(axis=0)):
        cells = [f"{v - CENTRE:.6f}" if tracks.state[i, t] == VISIBLE else "" for i in rows for v in tracks.xy[i, t]]
        writer.writerow(["labeled-data", "clip", f"img{t:05d}.png", *cells])
    write_bytes(path, out.getvalue().encode())


def read(path: str | Path, size: tuple[int, int], frames: int | None = None) -> TrackSheet:
    """Read labels. A frame is the number in its image's name, or the row where names hold none.

    Args:
        path: the csv. size: (width, height). frames: of the clip; default: up to the last labelled one.
    Raises GenmojoError: "io", "size", "schema" for another layout, "value" for what is no number.
    """
    lines = _lines(path)
    heads = {
        line[0]: line for line in lines[:4] if line and line[0] in ("scorer", "individuals", "bodyparts", "coords")
    }
    if "bodyparts" not in heads or "coords" not in heads:
        raise GenmojoError("schema", "has no rows bodyparts and coords", str(path), "give DeepLabCut's csv")
    coords = heads["coords"]
    start = next((i for i, c in enumerate(coords) if c == "x"), len(coords))
    body = lines[len(heads) :]
    numbers = _frame_numbers([line[:start] for line in body])
    columns = [i for i in range(start, len(coords) - 1) if coords[i] == "x" and coords[i + 1] == "y"]
    who = heads.get("individuals", ["object"] * len(coords))
    names = list(dict.fromkeys(who[i] for i in columns))
    parts = list(dict.fromkeys(heads["bodyparts"][i] for i in columns))
    total = max([*(n + 1 for n in numbers), frames or 1])
    made = blank_tracks(len(columns), total, [names.index(who[i]) + 1 for i in columns], size)
    made = _with_places(made, columns, coords, dict(zip(numbers, body, strict=True)), path)
    points = [_part_number(heads["bodyparts"][i], parts) for i in columns]
    called = tuple("" if re.fullmatch(r"point\d+", heads["bodyparts"][i]) else heads["bodyparts"][i] for i in columns)
    return TrackSheet(made, np.array(points, np.int64), {k + 1: n for k, n in enumerate(names)},
                      point_names=called if any(called) else (), owners_told=False)  # fmt: skip


def _with_places(made: PointTracks, columns: list[int], coords: list[str], body: dict[int, list[str]],
                 path: str | Path) -> PointTracks:  # fmt: skip
    """Rows of the table (frame -> cells) into tracks, whose x stand in those columns; a likelihood may follow y."""
    likely = [i + 2 < len(coords) and coords[i + 2] == "likelihood" for i in columns]
    flags = np.zeros_like(made.state)
    conf = np.where(np.array(likely, bool)[:, None], np.float32(0), np.float32(1)) + np.zeros_like(flags, np.float32)
    for t, line in body.items():
        for row, i in enumerate(columns):
            x, y, p = (_number(line[j], path) if j < len(line) else np.nan for j in (i, i + 1, i + 2))
            if not np.isfinite(x + y):
                continue
            made.xy[row, t], made.state[row, t] = (x + CENTRE, y + CENTRE), VISIBLE
            if likely[row] and np.isfinite(p):
                conf[row, t] = np.clip(p, 0.0, 1.0)
                if p < _SURE:
                    made.xy[row, t], made.state[row, t], flags[row, t] = np.nan, OCCLUDED, UNCERTAIN
    return replace(made, flags=flags, conf=conf) if any(likely) else made


def _parts(sheet: TrackSheet) -> dict[int, str]:
    """Number of a key point -> body part: names where all have one and their order gives the numbers back."""
    _, points, rows = sheet.grid()
    names = sheet.part_names(points, rows)
    order = list(dict.fromkeys(sheet.numbers.tolist()))
    named = points == order == list(range(1, len(points) + 1)) and not any(n.isdigit() for n in names)
    return dict(zip(points, names, strict=True)) if named else {n: f"point{n}" for n in points}


def _lines(path: str | Path) -> list[list[str]]:
    file = Path(path)
    if not file.is_file():
        raise GenmojoError("io", "does not exist or is no file", str(path), "check the name")
    if file.stat().st_size > MAX_BYTES:
        raise GenmojoError("size", f"is larger than {MAX_BYTES >> 20} MiB", str(path))
    try:
        return [line for line in csv.reader(io.StringIO(file.read_text("utf-8-sig"))) if line]
    except (UnicodeDecodeError, csv.Error) as error:
        raise GenmojoError("format", "is no csv text", str(path), "give DeepLabCut's csv") from error


def _frame_numbers(index: list[list[str]]) -> list[int]:
    """Frame of every row: the last number in its name, if all differ, else its place."""
    found = [re.findall(r"\d+", Path(part[-1] or part[0]).stem) for part in index]
    numbers = [int(f[-1]) for f in found if f]
    good = len(numbers) == len(index) and len(set(numbers)) == len(numbers) and max(numbers, default=0) < 10_000_000
    return numbers if good else list(range(len(index)))


def _part_number(name: str, parts: list[str]) -> int:
    """The number in "point3", else the place among the body parts."""
    match = re.fullmatch(r"point(\d+)", name)
    return int(match[1]) if match else parts.index(name) + 1


def _number(text: str, path: str | Path) -> float:
    try:
        return float(text) if text.strip() else float("nan")
    except ValueError as error:
        raise GenmojoError("value", f"'{text[:20]}' is no number", str(path)) from error
