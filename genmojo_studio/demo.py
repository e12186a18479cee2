"""The demo clip, made on the spot: the same bytes every time."""

from __future__ import annotations

from pathlib import Path

from genmojo_studio.settings import data_folder

CLIP = "crossing-shapes"


def write() -> Path:
    """Its folder, written if it is not there. Takes seconds the first time: call it on a thread.

    Raises GenmojoError("io") if it cannot be written.
    """
    from genmojo_core.clip import synthetic, synthetic_files  # the start page does without

    folder = data_folder() / "demo" / CLIP
    if not (folder / "truth.npz").exists():
        clip, truth = synthetic.generate(CLIP)
        synthetic_files.write(clip, truth, folder)
    return folder
