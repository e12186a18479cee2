"""What the window and the worker say to each other: JSON messages, each with its length before it.

A message is 4 bytes of length (big-endian) and that many bytes of UTF-8 JSON, one object with a "type":

    window -> worker   hello {version, token}
                       command {id, name, arguments}; names in COMMANDS
    worker -> window   hello {version, state, bus, parameters, request}
                       ack {id, ok, result | error}       once, when the command has taken effect
                       state {state, reason}              the window shows states from these and nothing else
                       event {n, event}                   genmojo_core.events as JSON, numbered from 0
                       phase {name, note, silence}        what the worker is at; it may be silent for so many seconds
                       beat {...}                         once a second: phase, step, memory, cost of the view
                       preview {stream, sequence}         something new lies in the preview bus
                       probe {on}                         the window should not draw while this is on (governor.py)

Every message of another version is refused at hello, so later ones need no check.
"""

from __future__ import annotations

import json
import struct
from collections.abc import Mapping
from dataclasses import asdict, dataclass, field, fields
from typing import Any, Literal

from genmojo_core.errors import GenmojoError

VERSION = 1
MAX_MESSAGE = 16 << 20
BEAT_SECONDS = 1.0
SILENCE_SECONDS = 5.0  # of missed heartbeats, after which a worker counts as lost

State = Literal[
    "starting",  # the program is loading
    "ready",  # it listens and reads the clip
    "running",
    "paused",
    "stepping",  # a few steps, then paused
    "stopping",  # stop was asked for and is on its way
    "finishing",  # the scene is being written
    "done",
    "failed",
    "lost",  # no sign of life; it may come back
]
ENDED: tuple[State, ...] = ("done", "failed")
COMMANDS = ("pause", "resume", "step", "run_to_next_stage", "set_parameter", "checkpoint", "stop", "look", "sweep",
            "set_view", "write_scene", "ping")  # fmt: skip
Cadence = Literal["off", "slow", "live"]

_HEAD = struct.Struct(">I")


def encode(message: Mapping[str, Any]) -> bytes:
    """A message as bytes. Raises GenmojoError("size") for one over MAX_MESSAGE."""
    body = json.dumps(message, separators=(",", ":"), allow_nan=True).encode()
    if len(body) > MAX_MESSAGE:
        raise GenmojoError("size", f"a message of {len(body)} bytes is too long", "worker")
    return _HEAD.pack(len(body)) + body


class Decoder:
    """Bytes as they come, messages as they are complete."""

    def __init__(self) -> None:
        self._rest = bytearray()

    def feed(self, data: bytes) -> list[dict[str, Any]]:
        """The messages that `data` completes. Raises GenmojoError("format"): the other side is no worker of ours."""
        self._rest += data
        found = []
        while len(self._rest) >= _HEAD.size:
            (length,) = _HEAD.unpack_from(self._rest)
            if length > MAX_MESSAGE:
                raise GenmojoError("format", "sent something that is no message", "worker")
            if len(self._rest) < _HEAD.size + length:
                break
            body = bytes(self._rest[_HEAD.size : _HEAD.size + length])
            del self._rest[: _HEAD.size + length]
            found.append(_parsed(body))
        return found


def _parsed(body: bytes) -> dict[str, Any]:
    """One JSON object with a type."""
    try:
        message = json.loads(body)
    except ValueError as error:
        raise GenmojoError("format", "sent something that is no JSON", "worker") from error
    if not isinstance(message, dict) or not isinstance(message.get("type"), str):
        raise GenmojoError("format", "sent a message without a type", "worker")
    return message


@dataclass(frozen=True)
class RunRequest:
    """What to optimise and how.

    Args:
        clip: path of the clip. run_dir: folder of the run ("" = the client makes one, see runs.py).
        preset, changes: as in `config.preset(preset, **changes)`. effects: overrides by hand, e.g. {"flow": False}.
        frames: (first, end) positions in the source, None for all. ignore: channels not to read.
        pixel_aspect: of source pixels, None for the clip's own. boxes: rows (frame, x0, y0, x1, y1), one object each.
        masks: file of corrected masks that stand for the clip's (clip/mask_file.py), "" for none.
        tracks: annotated tracks to follow, an npz or a project (store/annotated_tracks.py), "" for the clip's own.
        models: external models by option name, as the command line's, e.g. {"depth_model": "folder"}.
        resume: go on from the run folder's checkpoint. paused: wait before the first step.
        cadence: how often previews come. look_at: frame the window shows, None for the canonical one.
        output: where the scene is written at the end ("" = scene.h5 in the run folder).
    """

    clip: str
    run_dir: str = ""
    preset: str = "standard"
    changes: dict[str, Any] = field(default_factory=dict)
    effects: dict[str, bool] = field(default_factory=dict)
    frames: tuple[int, int | None] | None = None
    ignore: tuple[str, ...] = ()
    pixel_aspect: float | None = None
    boxes: tuple[tuple[float, ...], ...] = ()
    masks: str = ""
    tracks: str = ""
    models: dict[str, str] = field(default_factory=dict)
    resume: bool = False
    paused: bool = False
    cadence: Cadence = "live"
    look_at: int | None = None
    output: str = ""

    def to_json(self) -> dict[str, Any]:
        """Plain data."""
        return asdict(self)

    @classmethod
    def from_json(cls, data: Mapping[str, Any]) -> RunRequest:
        """The request of plain data. Raises GenmojoError("schema") for names it does not know."""
        known = {f.name for f in fields(cls)}
        if set(data) - known or "clip" not in data:
            raise GenmojoError("schema", "is no request for a run", "request.json", "start the run again")
        values = dict(data)
        for name in ("frames", "ignore"):
            if values.get(name) is not None:
                values[name] = tuple(values[name])
        values["boxes"] = tuple(tuple(row) for row in values.get("boxes", ()))
        return cls(**values)
