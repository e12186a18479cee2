"""COCO keypoints: one annotation per object and frame, `keypoints` as x, y, v triples.

Positions are raster pixels; v is 0 for nothing, 1 for hidden, 2 for seen. Out of view is 0 to COCO; our states go along
as `genmojo_state` and positions with v = 0 as they are.
"""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np

from genmojo_core.errors import GenmojoError
from genmojo_core.store.atomic import write_bytes
from genmojo_core.store.safe import json_text, parse_json
from genmojo_core.store.track_sheet import TrackSheet, blank_tracks
from genmojo_core.tracks.model import NONE, OCCLUDED, OUT_OF_VIEW, VISIBLE

_V = {NONE: 0, VISIBLE: 2, OCCLUDED: 1, OUT_OF_VIEW: 0}


def write(sheet: TrackSheet, path: str | Path) -> None:
    """Write tracks. Raises GenmojoError("io")."""
    tracks, frames = sheet.tracks, sheet.tracks.state.shape[1]
    owners, points, rows = sheet.grid()
    images = [{"id": t, "file_name": sheet.frame_name(t), "width": tracks.size[0], "height": tracks.size[1]}
              for t in range(frames)]  # fmt: skip
    categories = [{"id": owner, "name": sheet.name_of(owner), "keypoints": [str(n) for n in points], "skeleton": []}
                  for owner in owners]  # fmt: skip
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
        return _sheet(whole)
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
    return {"id": number, "image_id": t, "category_id": owner, "keypoints": triples, "num_keypoints": len(seen),
            "bbox": box, "area": box[2] * box[3], "iscrowd": 0, "genmojo_state": states}  # fmt: skip


def _sheet(whole: dict[str, Any]) -> TrackSheet:
    """The sheet of parsed JSON."""
    images = sorted(whole["images"], key=lambda i: int(i["id"]))
    position = {int(image["id"]): t for t, image in enumerate(images)}
    size = int(images[0]["width"]), int(images[0]["height"])
    categories = {int(c["id"]): c for c in whole["categories"]}
    pairs = [(owner, k) for owner in sorted(categories) for k in range(len(categories[owner]["keypoints"]))]
    if not pairs:
        raise ValueError("no keypoints")
    made = blank_tracks(len(pairs), len(images), [owner for owner, _ in pairs], size)
    for annotation in whole["annotations"]:
        owner, t = int(annotation["category_id"]), position[int(annotation["image_id"])]
        triples = np.array(annotation["keypoints"], np.float64).reshape(-1, 3)
        told = annotation.get("genmojo_state")
        for k, (x, y, v) in enumerate(triples):
            row = pairs.index((owner, k))
            state = abs(int(told[k])) if told else {0: NONE, 1: OCCLUDED}.get(int(v), VISIBLE)
            if state > OUT_OF_VIEW:
                raise ValueError("unknown state")
            known = int(told[k]) > 0 if told else v > 0
            made.state[row, t] = state
            made.xy[row, t] = (x, y) if known else np.nan
    numbers = [_number(categories[owner]["keypoints"][k], k) for owner, k in pairs]
    names = {owner: str(c["name"]) for owner, c in categories.items()}
    files = tuple(str(image["file_name"]) for image in images)
    return TrackSheet(made, np.array(numbers, np.int64), names, files).without_empty()


def _number(name: str, place: int) -> int:
    """The number a key point is named by, else its place."""
    return int(name) if str(name).isdigit() else place + 1
