"""CVAT's video XML 1.1: one `track` per object, `points` or `skeleton` per frame, flags outside, occluded, keyframe.

Positions are taken as raster pixels. Between keyframes that are frames apart CVAT interpolates linearly, and keeps the
last one to the end; so do we. A shape of several points, or a skeleton, is read as key points of one object. What CVAT
cannot say of a point of ours is one attribute, "genmojo".
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, field, replace
from pathlib import Path
from xml.etree import ElementTree

import numpy as np

from genmojo_core.errors import GenmojoError
from genmojo_core.store.atomic import write_bytes
from genmojo_core.store.track_sheet import TrackSheet, blank_tracks
from genmojo_core.tracks.annotation import KEY
from genmojo_core.tracks.model import NONE, OCCLUDED, OUT_OF_VIEW, VISIBLE, PointTracks

MAX_BYTES = 256 << 20
MAX_FRAMES = 1_000_000
MAX_CELLS = 50_000_000
_OURS = "genmojo"  # "object number state known flags source confidence" of a point in a frame
_OLD = ("object", "point", "state", "known")  # attributes of files written before


@dataclass(frozen=True)
class _Shape:
    """One point in one frame, as the file has it; `ours` is what the attribute of ours says (7 numbers), or None."""

    frame: int
    xy: tuple[float, float]
    state: int
    ours: tuple[float, ...] | None


@dataclass
class _Point:
    """One key point: its object's label and what tells the object from others, its own name, its shapes by frame."""

    owner: str
    group: str
    name: str
    review: str = ""
    shapes: list[_Shape] = field(default_factory=list)


def write(sheet: TrackSheet, path: str | Path) -> None:
    """Write tracks. Raises GenmojoError("io")."""
    tracks = sheet.tracks
    root = ElementTree.Element("annotations")
    ElementTree.SubElement(root, "version").text = "1.1"
    task = ElementTree.SubElement(ElementTree.SubElement(root, "meta"), "task")
    ElementTree.SubElement(task, "size").text = str(tracks.state.shape[1])
    extent = ElementTree.SubElement(task, "original_size")
    for name, value in zip(("width", "height"), tracks.size, strict=True):
        ElementTree.SubElement(extent, name).text = str(value)
    for row, owner in enumerate(tracks.object):
        about = {"id": str(row), "label": sheet.name_of(int(owner)), "source": "manual"}
        track = ElementTree.SubElement(root, "track", about)
        for t in range(tracks.state.shape[1]):
            _write_points(track, sheet, row, t)
    write_bytes(path, ElementTree.tostring(root, "utf-8", xml_declaration=True))


def read(path: str | Path, size: tuple[int, int] | None = None, frames: int | None = None) -> TrackSheet:
    """Read tracks of points. Raises GenmojoError: "io", "size", "format" no XML, "schema", "value", "empty"."""
    root = _parsed(path)
    extent = root.find("meta//original_size")
    if extent is not None:
        size = _whole(extent.findtext("width"), path), _whole(extent.findtext("height"), path)
    if size is None:
        raise GenmojoError("schema", "does not say the image size", str(path), "give --size WIDTHxHEIGHT")
    found = [point for track in root.iter("track") for point in _points_of(track, path)]
    if not found:
        raise GenmojoError("empty", "holds no track of points or skeletons", str(path))
    last = max(shape.frame for point in found for shape in point.shapes)
    told = _whole(root.findtext("meta//task/size") or "0", path)
    total = max(last + 1, told, frames or 0)
    if total > MAX_FRAMES or total * len(found) > MAX_CELLS:
        raise GenmojoError("size", f"speaks of {total} frames", str(path))
    return _sheet(found, total, size)


def _sheet(found: list[_Point], total: int, size: tuple[int, int]) -> TrackSheet:
    """The points as tracks; objects that we did not write are told apart by label, or by track where it is whole."""
    groups = list(dict.fromkeys(p.group for p in found))
    first = [p.shapes[0].ours for p in found]
    owners = [int(o[0]) if o else groups.index(p.group) + 1 for p, o in zip(found, first, strict=True)]
    made = blank_tracks(len(found), total, owners, size)
    cells = [np.zeros((len(found), total), dtype) for dtype in (np.uint8, np.uint8, np.float32)]
    seen: dict[int, int] = {}
    numbers = []
    for row, (point, owner) in enumerate(zip(found, owners, strict=True)):
        _fill(point, made, cells, row)
        ours = first[row]
        seen[owner] = seen.get(owner, 0) + 1
        numbers.append(int(ours[1]) if ours else seen[owner])
    told = all(o is not None for o in first)
    marked = any(o is not None and len(o) > len(_OLD) for o in first)
    tracks = replace(made, flags=cells[0], source=cells[1], conf=cells[2]) if marked else made
    names = {owner: point.owner for point, owner in zip(found, owners, strict=True)}
    points, reviews = tuple(p.name for p in found), tuple(p.review for p in found)
    return TrackSheet(tracks, np.array(numbers, np.int64), names, point_names=points if any(points) else (),
                      reviews=reviews if any(reviews) else (), owners_told=told,
                      numbers_told=told or any(points))  # fmt: skip


def _write_points(track: ElementTree.Element, sheet: TrackSheet, row: int, t: int) -> None:
    """One frame of one track."""
    tracks = sheet.tracks
    state, place = int(tracks.state[row, t]), tracks.xy[row, t]
    known = bool(np.isfinite(place).all())
    x, y = place if known else (0.0, 0.0)
    flags = KEY if tracks.flags is None else int(tracks.flags[row, t])
    points = ElementTree.SubElement(track, "points", {
        "frame": str(t), "points": f"{x:.6f},{y:.6f}", "outside": str(int(state in (NONE, OUT_OF_VIEW))),
        "occluded": str(int(state == OCCLUDED)), "keyframe": str(int(bool(flags & KEY) or t == 0)), "z_order": "0",
    })  # fmt: skip
    ours: list[float] = [int(tracks.object[row]), int(sheet.numbers[row]), state, int(known)]
    if tracks.flags is not None and tracks.source is not None and tracks.conf is not None:
        ours += [flags, int(tracks.source[row, t]), float(tracks.conf[row, t])]
    about = {_OURS: " ".join(f"{v:.9g}" for v in ours)}
    if t == 0:
        about |= {f"{_OURS}_name": sheet.point_name(row), f"{_OURS}_review": sheet.review(row)}
    for name, text in about.items():
        if text:
            ElementTree.SubElement(points, "attribute", {"name": name}).text = text


def _points_of(track: ElementTree.Element, path: str | Path) -> Iterator[_Point]:
    """The key points of a track: of its shapes of one or more points, or of its skeletons."""
    label = track.get("label", "")
    found: dict[str, _Point] = {}
    shapes = [(shape, (shape.get("points") or "").split(";")) for shape in track.findall("points")]
    whole = f"{label} {track.get('id')}"
    group = label if all(len(parts) == 1 for _, parts in shapes) else whole
    for shape, parts in shapes:
        texts = {a.get("name"): a.text or "" for a in shape.findall("attribute")}
        for k, text in enumerate(parts):
            point = found.setdefault(str(k), _Point(label, group, texts.get(f"{_OURS}_name", "")))
            point.review = point.review or texts.get(f"{_OURS}_review", "")
            point.shapes.append(_shape(shape, shape.get("frame"), text, path))
    for skeleton in track.findall("skeleton"):
        for shape in skeleton.findall("points"):
            name = shape.get("label", "")
            point = found.setdefault(f"skeleton {name}", _Point(label, whole, "" if name.isdigit() else name))
            point.shapes.append(_shape(shape, skeleton.get("frame"), shape.get("points") or "", path))
    for point in found.values():
        point.shapes.sort(key=lambda s: s.frame)
        yield point


def _shape(element: ElementTree.Element, frame: str | None, text: str, path: str | Path) -> _Shape:
    """One point of a shape. Raises GenmojoError("value") for what is no place."""
    try:
        place = tuple(float(v) for v in text.split(","))
    except ValueError as error:
        raise GenmojoError("value", f"'{text[:30]}' is no place", str(path)) from error
    if len(place) != 2 or not np.isfinite(place).all():
        raise GenmojoError("value", f"'{text[:30]}' is no place", str(path))
    state = OUT_OF_VIEW if element.get("outside") == "1" else OCCLUDED if element.get("occluded") == "1" else VISIBLE
    return _Shape(_whole(frame, path), (place[0], place[1]), state, _own(element))


def _own(element: ElementTree.Element) -> tuple[float, ...] | None:
    """What we wrote about a point; attributes of other people are theirs, whatever their names are."""
    texts = {a.get("name", ""): a.text or "" for a in element.findall("attribute")}
    words = texts[_OURS].split() if _OURS in texts else [texts.get(name, "") for name in _OLD]
    try:
        found = tuple(float(word) for word in words)
    except ValueError:
        return None
    good = len(found) in (len(_OLD), len(_OLD) + 3) and all(0 <= v < 2**31 for v in found) and found[2] <= OUT_OF_VIEW
    return found if good else None


def _fill(point: _Point, made: PointTracks, cells: list[np.ndarray], row: int) -> None:
    """All frames of one point, in place; frames left out lie on the line between its shapes, or stay at the last."""
    xy, state = made.xy[row], made.state[row]
    before: int | None = None
    for shape in point.shapes:
        t, ours = shape.frame, shape.ours
        state[t] = shape.state if ours is None else int(ours[2])
        xy[t] = np.nan if ours is not None and not ours[3] else shape.xy
        for array, value in zip(cells, ours[len(_OLD) :] if ours else (), strict=False):
            array[row, t] = value
        if before is not None and t - before > 1:
            share = (np.arange(before + 1, t) - before)[:, None] / (t - before)
            xy[before + 1 : t] = xy[before] + share * (xy[t] - xy[before])
            state[before + 1 : t] = state[before]
        before = t
    if before is not None:
        xy[before + 1 :], state[before + 1 :] = xy[before], state[before]


def _parsed(path: str | Path) -> ElementTree.Element:
    """The document; one that declares entities or is not UTF-8 is refused."""
    file = Path(path)
    if not file.is_file():
        raise GenmojoError("io", "does not exist or is no file", str(path), "check the name")
    if file.stat().st_size > MAX_BYTES:
        raise GenmojoError("size", f"is larger than {MAX_BYTES >> 20} MiB", str(path))
    try:
        text = file.read_text("utf-8-sig")
        if "<!" in text.replace("<!--", "").replace("<![CDATA[", ""):
            raise GenmojoError("format", "declares a document type, which could read other files", str(path),
                               "export it from CVAT again")  # fmt: skip
        return ElementTree.fromstring(text.encode("utf-8"))
    except (ElementTree.ParseError, UnicodeDecodeError, ValueError) as error:
        raise GenmojoError("format", "is no XML in UTF-8", str(path), "give CVAT's video XML 1.1") from error


def _whole(text: str | None, path: str | Path) -> int:
    """A whole number from 0."""
    if text is None or not text.strip().isdigit() or len(text) > 12:
        raise GenmojoError("value", f"'{(text or '')[:20]}' is no whole number", str(path))
    return int(text)
