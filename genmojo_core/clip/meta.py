"""meta.json of a clip: frame rate, object names, shape of a pixel. Every key is optional."""

from __future__ import annotations

import json
import math
from collections.abc import Mapping
from dataclasses import dataclass, field
from pathlib import Path

from genmojo_core.clip.limits import FPS_RANGE, LIMITS, PIXEL_ASPECT_RANGE, check_limit
from genmojo_core.errors import GenmojoError


@dataclass(frozen=True)
class Meta:
    """What a meta.json says.

    Args:
        fps: frames per second, or None. names: object id -> name. pixel_aspect: width / height, or None.
    """

    fps: float | None = None
    names: Mapping[int, str] = field(default_factory=dict)
    pixel_aspect: float | None = None


def read(path: Path) -> Meta:
    """The file's contents; an empty Meta if there is no file.

    Raises GenmojoError: "io"; "size"; "format" if it is no JSON object; "value" for a number out of its range.
    """
    if not path.is_file():
        return Meta()
    where = str(path)
    try:
        check_limit("meta_bytes", path.stat().st_size, where)
        data = json.loads(path.read_text(encoding="utf-8-sig"), parse_constant=_refuse)
    except OSError as error:
        raise GenmojoError("io", f"cannot be read ({error.strerror})", where, "check the path") from error
    except (ValueError, RecursionError) as error:
        raise GenmojoError("format", "is no valid JSON", where, "correct it or take it away") from error
    if not isinstance(data, dict):
        raise GenmojoError("format", "is no JSON object", where, "correct it or take it away")
    return Meta(_number(data, "fps", FPS_RANGE, where), _names(data.get("objects"), where),
                _number(data, "pixel_aspect", PIXEL_ASPECT_RANGE, where))  # fmt: skip


def check_pixel_aspect(value: float, where: str) -> float:
    """The value, if it is a shape a pixel can have; raises GenmojoError("value")."""
    low, high = PIXEL_ASPECT_RANGE
    if not math.isfinite(value) or not low <= value <= high:
        raise GenmojoError("value", f"the pixel aspect is {value}, allowed is {low:g} to {high:g}", where)
    return float(value)


def _number(data: Mapping[str, object], key: str, allowed: tuple[float, float], where: str) -> float | None:
    """A number within its range, or None."""
    value = data.get(key)
    if value is None:
        return None
    good = isinstance(value, int | float) and not isinstance(value, bool)
    if not good or not allowed[0] <= float(value) <= allowed[1]:  # type: ignore[arg-type]
        raise GenmojoError("value", f"{key} is {str(value)[:40]}, allowed is {allowed[0]:g} to {allowed[1]:g}", where)
    return float(value)  # type: ignore[arg-type]


def _names(objects: object, where: str) -> dict[int, str]:
    """Object names by id; names are shown literally, so only their length is cut."""
    if objects is None:
        return {}
    if not isinstance(objects, dict) or not all(str(k).isdecimal() and len(k) < 10 for k in objects):
        raise GenmojoError("format", "the objects are no mapping from id to name", where, 'write {"1": "dog"}')
    return {int(k): str(v)[: LIMITS["name_length"].most] for k, v in objects.items()}


def _refuse(name: str) -> float:
    """NaN and Infinity are no JSON."""
    raise ValueError(name)
