"""Edits a project without end, and tells on stdout what was acknowledged; to be killed at any moment.

    python editing_child.py FILE SEED

Every acknowledged row is one line: its number and the digest of the annotation right after it.
"""

from __future__ import annotations

import os
import sys
import time
from pathlib import Path

import annotations
import numpy as np

from genmojo_core.store.project import Project
from genmojo_core.tracks.edits import Edit


def main(path: Path, seed: int) -> None:
    project = Project.open(path, backup=False)
    digests: dict[int, str] = {}

    def saved(seq: int, seconds: float) -> None:
        os.write(1, f"{seq} {digests[seq]}\n".encode())

    project.saved = saved
    rng = np.random.default_rng(seed)
    while True:
        edit = annotations.random_edit(project.annotation, rng)
        if not edit.changes:
            continue
        digests[len(project.log) + 1] = _digest_after(project, edit)
        project.do(edit)
        if rng.integers(8) == 0 and project.log.undo_target() is not None:
            digests[len(project.log) + 1] = "move"
            project.undo()
        time.sleep(0.001)


def _digest_after(project: Project, edit: Edit) -> str:
    """What the annotation will be."""
    edit.do(project.annotation)
    digest = project.annotation.digest()
    edit.undo(project.annotation)
    return digest


if __name__ == "__main__":
    main(Path(sys.argv[1]), int(sys.argv[2]))
