"""The frozen test set of the embedded prior: objects no training run sees, fixed by seed before the first training."""

from __future__ import annotations

import hashlib
import json
from collections.abc import Sequence
from functools import lru_cache
from pathlib import Path
from typing import Any

import numpy as np

from genmojo_core.priors.generator import VERSION, Example, Variation, example

SEED = 20251122  # training seeds its batches with (seed, step), two numbers, and so never meets it
COUNT = 64
VIEWS = np.array(
    [(0, a) for a in (30, -30, 60, -60, 90, -90, 120, -120, 150, -150, 180)] + [(29, 0), (-29, 0), (29, 90)], float
)
RECORD = Path(__file__).resolve().parents[2] / "resources" / "prior_test_set.json"


@lru_cache(maxsize=1)
def frozen_examples() -> tuple[Example, ...]:
    """The 64 objects with clean conditions and 14 views each."""
    return tuple(example(np.random.default_rng(SEED + i), VIEWS, variation=Variation()) for i in range(COUNT))


def record(examples: Sequence[Example]) -> dict[str, Any]:
    """What identifies the set: a hash of its 8-bit pictures, and each object's mean, which survives another processor.

    Returns plain data as RECORD holds it.
    """
    digest = hashlib.sha256()
    for one in examples:
        digest.update(np.round(one.targets * 255).astype(np.uint8).tobytes())
    return {
        "generator": VERSION, "seed": SEED, "count": len(examples), "views": VIEWS.tolist(),
        "sha256": digest.hexdigest(), "means": [round(float(one.targets.mean()), 6) for one in examples],
    }  # fmt: skip


def recorded() -> dict[str, Any]:
    """The committed record."""
    return dict(json.loads(RECORD.read_text()))
