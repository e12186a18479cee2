"""Edits, annotations and proposals as bytes: compressed strict JSON with arrays in base64. No pickles, exact floats."""

from __future__ import annotations

import base64
import binascii
import zlib
from collections.abc import Callable
from dataclasses import asdict, fields
from typing import Any

import numpy as np

from genmojo_core.errors import GenmojoError
from genmojo_core.store.safe import json_text, parse_json
from genmojo_core.tracks.annotation import Annotation, Cells, ObjectInfo, Proposal, TrackInfo
from genmojo_core.tracks.edits import CellsChange, Change, Edit, MetaChange, ObjectChange, ProposalChange, TrackChange

MAX_BYTES = 1 << 30  # of one unpacked record
_DTYPES = {"f4": np.float32, "u1": np.uint8, "i4": np.int32}


def encode_edit(edit: Edit) -> bytes:
    """An edit's changes (kind, title, frame and track are columns of their own in the project file)."""
    return _pack({"machine": edit.machine, "changes": [_change_out(c) for c in edit.changes]})


def decode_edit(data: bytes, kind: str, title: str, frame: int | None, track: int | None) -> Edit:
    """The edit `encode_edit` wrote. Raises GenmojoError("corrupt")."""

    def build(record: Any) -> Edit:
        changes = tuple(_change_in(c) for c in record["changes"])
        return Edit(kind, title, changes, frame, track, bool(record["machine"]))

    return _unpack(data, build)


def encode_annotation(annotation: Annotation) -> bytes:
    """Everything an edit can change."""
    return _pack({
        "frames": annotation.frames, "size": list(annotation.size), "meta": annotation.meta,
        "objects": [asdict(o) for o in annotation.objects.values()],
        "tracks": [{"info": asdict(i), "cells": _cells_out(annotation.track(i.id))}
                   for i in annotation.tracks.values()],
    })  # fmt: skip


def decode_annotation(data: bytes) -> Annotation:
    """The annotation `encode_annotation` wrote. Raises GenmojoError("corrupt")."""

    def build(record: Any) -> Annotation:
        width, height = record["size"]
        made = Annotation(int(record["frames"]), (int(width), int(height)))
        made.meta.update({str(k): str(v) for k, v in record["meta"].items()})
        made.reserve(len(record["tracks"]))
        for item in record["objects"]:
            made.put_object(int(item["id"]), object_in(item))
        for item in record["tracks"]:
            info = track_in(item["info"])
            made.put_track(info.id, info)
            made.write_cells(info.id, np.arange(made.frames), _cells_in(item["cells"]))
        return made

    return _unpack(data, build)


def encode_proposal(proposal: Proposal) -> bytes:
    """A tracker's proposal for one track."""
    return _pack(_proposal_out(proposal))


def decode_proposal(data: bytes) -> Proposal:
    """The proposal `encode_proposal` wrote. Raises GenmojoError("corrupt")."""
    return _unpack(data, _proposal_in)


def object_in(record: dict[str, Any]) -> ObjectInfo:
    """An ObjectInfo of plain data; older projects know no masks drawn for objects."""
    values = {"mask": 0} | record
    return ObjectInfo(**{f.name: values[f.name] for f in fields(ObjectInfo)})


def track_in(record: dict[str, Any]) -> TrackInfo:
    """A TrackInfo of plain data.

    Older projects had one note only, over which a reviewer wrote: of a track that came back or was given up it is his.
    """
    if "review_note" not in record:
        theirs = record["review"] in ("needs_fix", "fixed", "rejected")
        record = record | {"note": "" if theirs else record["note"], "review_note": record["note"] if theirs else ""}
    values = {f.name: record[f.name] for f in fields(TrackInfo)}
    values["run"] = tuple(values["run"]) if values["run"] is not None else None
    return TrackInfo(**values)


def _change_out(change: Change) -> dict[str, Any]:
    if isinstance(change, CellsChange):
        return {"what": "cells", "id": change.track, "frames": _array_out(change.frames.astype(np.int32)),
                "before": _cells_out(change.before), "after": _cells_out(change.after)}  # fmt: skip
    if isinstance(change, MetaChange):
        return {"what": "meta", "id": change.key, "before": change.before, "after": change.after}
    if isinstance(change, ProposalChange):
        sides = (None if v is None else _proposal_out(v) for v in (change.before, change.after))
        return {"what": "proposal", "id": change.track, "tracker": change.tracker,
                **dict(zip(("before", "after"), sides, strict=True))}  # fmt: skip
    before, after = (None if v is None else asdict(v) for v in (change.before, change.after))
    what = "track" if isinstance(change, TrackChange) else "object"
    return {"what": what, "id": change.id, "before": before, "after": after}


def _change_in(record: dict[str, Any]) -> Change:
    what, before, after = record["what"], record["before"], record["after"]
    if what == "cells":
        return CellsChange(int(record["id"]), _array_in(record["frames"]), _cells_in(before), _cells_in(after))
    if what == "meta":
        return MetaChange(str(record["id"]), before, after)
    if what == "track":
        return TrackChange(int(record["id"]), *(None if v is None else track_in(v) for v in (before, after)))
    if what == "object":
        return ObjectChange(int(record["id"]), *(None if v is None else object_in(v) for v in (before, after)))
    if what == "proposal":
        return ProposalChange(int(record["id"]), str(record["tracker"]),
                              *(None if v is None else _proposal_in(v) for v in (before, after)))  # fmt: skip
    raise ValueError(f"unknown change {what}")


def _proposal_out(proposal: Proposal) -> dict[str, Any]:
    arrays = {"xy": proposal.xy.astype(np.float32), "state": proposal.state, "conf": proposal.conf.astype(np.float32)}
    return {"tracker": proposal.tracker, **{name: _array_out(a) for name, a in arrays.items()}}


def _proposal_in(record: dict[str, Any]) -> Proposal:
    return Proposal(str(record["tracker"]), *(_array_in(record[k]) for k in ("xy", "state", "conf")))


def _cells_out(cells: Cells) -> list[dict[str, Any]]:
    return [_array_out(a) for a in cells.arrays()]


def _cells_in(record: list[dict[str, Any]]) -> Cells:
    return Cells(*(_array_in(r) for r in record))


def _array_out(array: np.ndarray) -> dict[str, Any]:
    data = np.ascontiguousarray(array)
    return {"t": data.dtype.str[1:], "s": list(data.shape), "d": base64.b64encode(data.tobytes()).decode()}


def _array_in(record: dict[str, Any]) -> np.ndarray:
    flat = np.frombuffer(base64.b64decode(record["d"], validate=True), _DTYPES[record["t"]])
    return flat.reshape([int(n) for n in record["s"]])


def _pack(record: dict[str, Any]) -> bytes:
    return zlib.compress(json_text(record).encode(), 1)


def _unpack(data: bytes, build: Callable[[Any], Any]) -> Any:
    """Unpack and build; whatever a damaged or hostile record causes is GenmojoError("corrupt")."""
    try:
        unpacker = zlib.decompressobj()
        text = unpacker.decompress(data, MAX_BYTES)
        if unpacker.unconsumed_tail or not unpacker.eof:
            raise ValueError("too long or cut off")
        return build(parse_json(text, "project record"))
    except (zlib.error, binascii.Error, KeyError, TypeError, ValueError, AttributeError) as error:
        raise GenmojoError("corrupt", "a stored edit cannot be read", "project", "open a backup copy") from error
