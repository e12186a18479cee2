"""COCO keypoints: one annotation per object and frame, `keypoints` as x, y, v triples.

Positions are raster pixels; v is 0 for nothing, 1 for hidden, 2 for seen. Out of view is 0 to COCO; our states, flags
and sources go along as `genmojo_...` lists and positions with v = 0 as they are. Several objects of a category are told
apart by `track_id` (of the annotation or among its `attributes`).
"""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np

from genmojo_core.errors import GenmojoError
from genmojo_core.store.atomic import write_bytes
from genmojo_core.store.safe import json_text, parse_json
from genmojo_core.store.side_arrays import cell_arrays, with_cells
from genmojo_core.store.track_sheet import TrackSheet, blank_tracks
from genmojo_core.tracks.model import NONE, OCCLUDED, OUT_OF_VIEW, VISIBLE, PointTracks

_V = {NONE: 0, VISIBLE: 2, OCCLUDED: 1, OUT_OF_VIEW: 0}
_OURS = "genmojo_"
_CELLS = {"flags": np.uint8, "source": np.uint8, "conf": np.float32}

Object = tuple[int, int | None]  # category, track id


def write(sheet: TrackSheet, path: str | Path) -> None:
    """Write tracks. Raises GenmojoError("io")."""
    tracks, frames = sheet.tracks, sheet.tracks.state.shape[1]
    owners, points, rows = sheet.grid()
    images = [{"id": t, "file_name": sheet.frame_name(t), "width": tracks.size[0], "height": tracks.size[1]}
              for t in range(frames)]  # fmt: skip
    categories = []
    for k, owner in enumerate(owners):
        names = sheet.part_names(points, rows[k : k + 1])
        about = {"id": owner, "name": sheet.name_of(owner), "keypoints": names, "skeleton": [],
                 f"{_OURS}number": points}  # fmt: skip
        for key, words in (("point_name", sheet.point_names), ("review", sheet.reviews)):
            if any(words):
                about[_OURS + key] = [words[r] if r >= 0 else "" for r in rows[k]]
        categories.append(about)
    made = [_annotation(sheet, k * frames + t, owner, rows[k], t)
            for k, owner in enumerate(owners) for t in range(frames)]  # fmt: skip
    write_bytes(path, json_text({"images": images, "categories": categories, "annotations": made}).encode())


def read(path: str | Path) -> TrackSheet:
    """Read keypoints; frames are the images in order of id. Raises GenmojoError: "io", "format", "schema", "empty"."""
    file = Path(path)
    if not file.is_file():
        raise GenmojoError("io", "does not exist or is no file", str(path), "check the name")
    whole = parse_json(file.read_bytes(), str(path))
    try:
        return _sheet(whole, str(path))
    except (KeyError, TypeError, ValueError, IndexError, AttributeError) as error:
        raise GenmojoError("schema", "is not COCO keypoints as we know them", str(path), "give images, categories and "
                           "annotations with keypoints") from error  # fmt: skip


def _annotation(sheet: TrackSheet, number: int, owner: int, rows: np.ndarray, t: int) -> dict[str, Any]:
    """One object in one frame."""
    triples: list[float] = []
    states = []
    for row in rows:
        state = int(sheet.tracks.state[row, t]) if row >= 0 else NONE
        x, y = (float(v) for v in sheet.tracks.xy[row, t]) if row >= 0 else (np.nan, np.nan)
        triples += [*((x, y) if np.isfinite(x + y) else (0.0, 0.0)), _V[state]]
        states.append(state if np.isfinite(x + y) else -state)
    seen = [triples[i : i + 2] for i in range(0, len(triples), 3) if triples[i + 2] > 0]
    low, high = (np.min(seen, axis=0), np.max(seen, axis=0)) if seen else (np.zeros(2), np.zeros(2))
    box = [float(v) for v in (*low, *(high - low))]
    cells = {_OURS + key: [array[r, t].item() if r >= 0 else 0 for r in rows]
             for key, array in cell_arrays(sheet.tracks).items()}  # fmt: skip
    return {"id": number, "image_id": t, "category_id": owner, "keypoints": triples, "num_keypoints": len(seen),
            "bbox": box, "area": box[2] * box[3], "iscrowd": 0, _OURS + "state": states} | cells  # fmt: skip


def _sheet(whole: dict[str, Any], where: str) -> TrackSheet:
    """The sheet of parsed JSON."""
    images = sorted(whole["images"], key=lambda i: int(i["id"]))
    position = {int(image["id"]): t for t, image in enumerate(images)}
    size = int(images[0]["width"]), int(images[0]["height"])
    categories = {int(c["id"]): c for c in whole["categories"]}
    objects = _objects(whole["annotations"], categories, where)
    pairs = [(thing, k) for thing in objects for k in range(len(categories[thing[0]]["keypoints"]))]
    if not pairs:
        raise ValueError("no keypoints")
    told = all(track is None for _, track in objects) and all(_OURS + "number" in c for c in categories.values())
    ids = {thing: thing[0] if all(t is None for _, t in objects) else n + 1 for n, thing in enumerate(objects)}
    made = _filled(whole["annotations"], position, pairs, blank_tracks(
        len(pairs), len(images), [ids[thing] for thing, _ in pairs], size))  # fmt: skip
    parts = [(categories[thing[0]], k) for thing, k in pairs]
    points = tuple(_words(c, "point_name")[k] or _plain_name(c, k) for c, k in parts)
    reviews = tuple(_words(c, "review")[k] for c, k in parts)
    names = {ids[thing]: str(categories[thing[0]]["name"]) for thing in objects}
    files = tuple(str(image["file_name"]) for image in images)
    return TrackSheet(made, np.array([_number(c, k) for c, k in parts], np.int64), names, files,
                      points if any(points) else (), reviews if any(reviews) else (), owners_told=told,
                      ).without_empty()  # fmt: skip


def _objects(annotations: list[dict[str, Any]], categories: dict[int, Any], where: str) -> list[Object]:
    """The objects of a file, sorted. Raises GenmojoError("schema") where two of a category cannot be told apart."""
    found: dict[Object, set[int]] = {}
    for annotation in annotations:
        thing, image = _object(annotation), int(annotation["image_id"])
        if image in found.setdefault(thing, set()):
            name = str(categories[thing[0]]["name"])[:40]
            raise GenmojoError("schema", f"has two annotations of '{name}' in image {image} and nothing that says "
                               "which is which", where, "give each object a category or a track_id")  # fmt: skip
        found[thing].add(image)
    return sorted(found, key=lambda o: (o[0], -1 if o[1] is None else o[1]))


def _object(annotation: dict[str, Any]) -> Object:
    """Which object an annotation is of."""
    attributes = annotation.get("attributes")
    track = annotation.get("track_id", attributes.get("track_id") if isinstance(attributes, dict) else None)
    return int(annotation["category_id"]), None if track is None else int(track)


def _filled(annotations: list[dict[str, Any]], position: dict[int, int], pairs: list[tuple[Object, int]],
            made: PointTracks) -> PointTracks:  # fmt: skip
    """Blank tracks, one per pair of object and key point, with what the annotations say."""
    rows = {pair: row for row, pair in enumerate(pairs)}
    cells = {key: np.zeros(made.state.shape, dtype) for key, dtype in _CELLS.items()
             if any(_OURS + key in a for a in annotations)}  # fmt: skip
    for annotation in annotations:
        thing, t = _object(annotation), position[int(annotation["image_id"])]
        told = annotation.get(_OURS + "state")
        for k, (x, y, v) in enumerate(np.array(annotation["keypoints"], np.float64).reshape(-1, 3)):
            row = rows[thing, k]
            state = abs(int(told[k])) if told else {0: NONE, 1: OCCLUDED}.get(int(v), VISIBLE)
            if state > OUT_OF_VIEW:
                raise ValueError("unknown state")
            made.state[row, t] = state
            made.xy[row, t] = (x, y) if (int(told[k]) > 0 if told else v > 0) else np.nan
            for key, array in cells.items():
                array[row, t] = annotation[_OURS + key][k] if _OURS + key in annotation else 0
    return with_cells(made, cells)


def _words(category: dict[str, Any], key: str) -> list[str]:
    """A list of ours beside the key points, empty words where there is none."""
    return [str(word) for word in category.get(_OURS + key, [""] * len(category["keypoints"]))]


def _plain_name(category: dict[str, Any], place: int) -> str:
    """What a key point is called by a program that is not ours; "" for a number."""
    name = str(category["keypoints"][place])
    return "" if name.isdigit() or _OURS + "point_name" in category else name


def _number(category: dict[str, Any], place: int) -> int:
    """The number of a key point: told, or its name, else its place."""
    if _OURS + "number" in category:
        return int(category[_OURS + "number"][place])
    name = str(category["keypoints"][place])
    return int(name) if name.isdigit() else place + 1
