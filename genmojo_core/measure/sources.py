"""Which program made a result: a digest of the sources and weights that decide it."""

from __future__ import annotations

import hashlib
from functools import cache
from pathlib import Path

from genmojo_core.priors import weights

# Packages that a scene and its figures come from; what only shows, stores or tells is left out.
DECIDING = ("clip", "effects", "estimate", "kernels", "measure", "optimise", "priors", "render", "scene", "trackers",
            "tracks", "config.py", "conventions.py")  # fmt: skip
_ROOT = Path(__file__).resolve().parents[1]


@cache
def digest() -> str:
    """Twelve hexadecimal digits that change with any of these sources or with the shipped prior."""
    paths = [_ROOT / name for name in DECIDING]
    files = [file for path in paths for file in (sorted(path.rglob("*.py")) if path.is_dir() else [path])]
    total = hashlib.sha256()
    for file in [*files, weights.SHIPPED]:
        total.update(hashlib.sha256(file.read_bytes()).digest())
    return total.hexdigest()[:12]
