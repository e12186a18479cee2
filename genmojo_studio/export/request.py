"""What to export: plain data that travels from the window to the exporting process. Imports neither Qt nor torch."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import asdict, dataclass, field, fields
from typing import Any, Literal

from genmojo_core.errors import GenmojoError

Kind = Literal["hdf5", "ply", "ply-sequence", "picture", "frames", "turntable", "path"]
KINDS: tuple[Kind, ...] = ("hdf5", "ply", "ply-sequence", "picture", "frames", "turntable", "path")


@dataclass(frozen=True)
class ExportRequest:
    """One export of a scene file.

    Args:
        kind: what is made: "hdf5" the scene itself, "ply" one frame, "ply-sequence" all, "picture" one frame from one
            camera, "frames" the clip's frames from its own cameras or turned by elevation and azimuth, "turntable",
            "path" (a camera path).
        scene: file to read. output: file or folder to write; films are mp4 by their name, else numbered PNG files.
        frame: position in the clip (picture, ply, turntable). mode: one of genmojo_core.measure.film.MODES.
        short_side: of the picture in pixels, None for the clip's own. objects_only, transparent: leave the background
            out; PNG with alpha. objects: mask ids (PLY), None for all.
        camera: world_to_camera (4 rows of 4) and "fov" (vertical, degrees) of a picture, None for the clip's camera
            turned by elevation and azimuth. size: (width, height) of a picture with a camera of its own.
        degrees, seconds, fps, time_mode, elevation, azimuth: of a turntable (film.turntable). path: of "path", as
            camera_path.CameraPath.to_json gives it. paths: camera paths to keep in an "hdf5", the same way.
        extra: PLY with columns of ours.
    """

    kind: Kind
    scene: str
    output: str
    frame: int = 0
    mode: str = "rgb"
    short_side: int | None = None
    objects_only: bool = False
    transparent: bool = False
    objects: list[int] | None = None
    camera: dict[str, Any] | None = None
    size: list[int] | None = None
    degrees: float = 360.0
    seconds: float = 6.0
    fps: float = 24.0
    time_mode: str = "freeze"
    elevation: float = 0.0
    azimuth: float = 0.0
    path: dict[str, Any] | None = None
    paths: list[dict[str, Any]] = field(default_factory=list)
    extra: bool = False

    def to_json(self) -> dict[str, Any]:
        """Plain data."""
        return asdict(self)

    @classmethod
    def from_json(cls, data: Mapping[str, Any]) -> ExportRequest:
        """The inverse. Raises GenmojoError("argument")."""
        known = {f.name for f in fields(cls)}
        if set(data) - known or not {"kind", "scene", "output"} <= set(data) or data["kind"] not in KINDS:
            raise GenmojoError("argument", "is no export this program knows", str(data.get("kind", "")))
        return cls(**data)
