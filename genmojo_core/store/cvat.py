"""CVAT's video XML 1.1: one `track` per key point with `points` per frame, flags outside, occluded, keyframe.

Positions are taken as raster pixels. Between keyframes that are frames apart CVAT interpolates linearly, so do we.
The state that CVAT cannot say (not annotated) is an attribute of ours.
"""

from __future__ import annotations

from pathlib import Path
from xml.etree import ElementTree

import numpy as np

from genmojo_core.errors import GenmojoError
from genmojo_core.store.atomic import write_bytes
from genmojo_core.store.track_sheet import TrackSheet, blank_tracks
from genmojo_core.tracks.annotation import KEY
from genmojo_core.tracks.model import NONE, OCCLUDED, OUT_OF_VIEW, VISIBLE

MAX_BYTES = 256 << 20
MAX_FRAMES = 1_000_000


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
    """Read tracks of single points. Raises GenmojoError: "io", "size", "format" no XML, "schema", "value"."""
    root = _parsed(path)
    extent = root.find("meta//original_size")
    if extent is not None:
        size = _whole(extent.findtext("width"), path), _whole(extent.findtext("height"), path)
    if size is None:
        raise GenmojoError("schema", "does not say the image size", str(path), "give --size WIDTHxHEIGHT")
    found = [t for t in root.iter("track") if t.find("points") is not None]
    if not found:
        raise GenmojoError("empty", "holds no track of points", str(path))
    last = max(_whole(p.get("frame"), path) for t in found for p in t.iter("points"))
    told = _whole(root.findtext("meta//task/size") or "0", path)
    total = max(last + 1, told, frames or 0)
    if total > MAX_FRAMES:
        raise GenmojoError("size", f"speaks of {total} frames", str(path))
    labels = list(dict.fromkeys(t.get("label", "") for t in found))
    owners = [_attribute(t, "object", labels.index(t.get("label", "")) + 1, path) for t in found]
    made = blank_tracks(len(found), total, owners, size)
    for row, track in enumerate(found):
        _read_points(track, made.xy[row], made.state[row], path)
    seen: dict[int, int] = {}
    numbers = []
    for track, owner in zip(found, owners, strict=True):
        seen[owner] = seen.get(owner, 0) + 1
        numbers.append(_attribute(track, "point", seen[owner], path))
    names = {owner: t.get("label", "") for t, owner in zip(found, owners, strict=True)}
    return TrackSheet(made, np.array(numbers, np.int64), names)


def _write_points(track: ElementTree.Element, sheet: TrackSheet, row: int, t: int) -> None:
    """One frame of one track."""
    tracks = sheet.tracks
    state, place = int(tracks.state[row, t]), tracks.xy[row, t]
    known = bool(np.isfinite(place).all())
    x, y = place if known else (0.0, 0.0)
    is_key = tracks.flags is None or bool(tracks.flags[row, t] & KEY)
    points = ElementTree.SubElement(track, "points", {
        "frame": str(t), "points": f"{x:.6f},{y:.6f}", "outside": str(int(state in (NONE, OUT_OF_VIEW))),
        "occluded": str(int(state == OCCLUDED)), "keyframe": str(int(is_key or t == 0)), "z_order": "0",
    })  # fmt: skip
    about = {"object": int(tracks.object[row]), "point": int(sheet.numbers[row]), "state": state, "known": int(known)}
    for name, value in about.items():
        ElementTree.SubElement(points, "attribute", {"name": name}).text = str(value)


def _read_points(track: ElementTree.Element, xy: np.ndarray, state: np.ndarray, path: str | Path) -> None:
    """All frames of one track, in place; frames left out lie on the line between their neighbours."""
    before: int | None = None
    for points in sorted(track.iter("points"), key=lambda p: _whole(p.get("frame"), path)):
        t = _whole(points.get("frame"), path)
        parts = (points.get("points") or "").split(";")
        if len(parts) != 1:
            raise GenmojoError("schema", f"has {len(parts)} points in one shape of frame {t}", str(path),
                               "give one track per point")  # fmt: skip
        try:
            place = np.array([float(v) for v in parts[0].split(",")])
        except ValueError as error:
            raise GenmojoError("value", f"'{parts[0][:30]}' is no place", str(path)) from error
        if place.shape != (2,) or not np.isfinite(place).all():
            raise GenmojoError("value", f"'{parts[0][:30]}' is no place", str(path))
        plain = OUT_OF_VIEW if points.get("outside") == "1" else OCCLUDED if points.get("occluded") == "1" else VISIBLE
        told = _attribute(points, "state", plain, path)
        state[t] = told if NONE <= told <= OUT_OF_VIEW else plain
        xy[t] = place if _attribute(points, "known", 1, path) else np.nan
        if before is not None and t - before > 1 and state[before] in (VISIBLE, OCCLUDED):
            share = (np.arange(before + 1, t) - before)[:, None] / (t - before)
            xy[before + 1 : t] = xy[before] + share * (xy[t] - xy[before])
            state[before + 1 : t] = state[before]
        before = t


def _attribute(element: ElementTree.Element, name: str, default: int, path: str | Path) -> int:
    """A whole number among the attributes of a shape, or of a track's first shape."""
    for attribute in element.iter("attribute"):
        if attribute.get("name") == name:
            return _whole(attribute.text, path)
    return default


def _parsed(path: str | Path) -> ElementTree.Element:
    """The document; one that declares entities or is not UTF-8 is refused."""
    file = Path(path)
    if not file.is_file():
        raise GenmojoError("io", "does not exist or is no file", str(path), "check the name")
    if file.stat().st_size > MAX_BYTES:
        raise GenmojoError("size", f"is larger than {MAX_BYTES >> 20} MiB", str(path))
    try:
        text = file.read_text("utf-8")
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
