"""Annotated tracks for an optimisation, from a file of tracks or straight from an annotator's project."""

from __future__ import annotations

import tempfile
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

from genmojo_core.errors import GenmojoError
from genmojo_core.store import project_file
from genmojo_core.store.npz import write_tracks
from genmojo_core.tracks.supervision import said_by_people

PROJECT = ".genmojo"


@contextmanager
def as_npz(path: str | None, *, needed: bool = True) -> Iterator[str | None]:
    """The npz that a clip reads its tracks from, as long as the context lasts; None for None.

    An npz is taken as it is; of a project (.genmojo) what people placed or accepted (`tracks.supervision`).

    Raises GenmojoError as `project_file.load`; "empty" if nobody placed a point and `needed`, else that gives None.
    """
    if path is None or Path(path).suffix != PROJECT:
        yield path
        return
    said = said_by_people(project_file.load(Path(path)).annotation)
    if said is None:
        if needed:
            raise GenmojoError("empty", "holds no point that a person placed", path, "place points first")
        yield None
        return
    with tempfile.TemporaryDirectory(prefix="genmojo-tracks-") as folder:
        file = Path(folder) / "tracks.npz"
        write_tracks(said, file)
        yield str(file)
