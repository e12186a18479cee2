"""Mutation check of issue 7: each guard is taken away in turn, and at least one named hard case has to fail.

    python -m tests.acceptance.mutations [--only NAME] [--kept FILE]

What is in FILE is not tried again, so an interrupted check goes on where it stopped.
Guards inside compiled kernels are constants when those compile: each is taken away in a process of its own, which
compiles anew into an empty cache. Not taken away is the budget of entries, whose case would fill the memory.
"""

from __future__ import annotations

import argparse
import json
import os
import subprocess
import sys
import tempfile
from collections.abc import Callable
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any
from unittest import mock

import numpy as np
import torch

from genmojo_core.hard_cases import suite
from genmojo_core.hard_cases.case import verdicts
from genmojo_core.optimise import guard, run
from genmojo_core.optimise.working_space import WorkingSpace
from genmojo_core.priors import sds
from genmojo_core.render.cpu import rasterize
from genmojo_core.scene import safemath


@dataclass(frozen=True)
class Mutation:
    """A guard taken away: what is replaced on what, and the rows of cases that may notice."""

    name: str
    target: Any
    attribute: str
    instead: Any
    rows: tuple[str, ...]


def _raw_quaternions(quats: torch.Tensor) -> torch.Tensor:
    return quats / torch.linalg.norm(quats, dim=-1, keepdim=True)


def _raw_rotation(vector: torch.Tensor) -> torch.Tensor:
    angle = torch.linalg.norm(vector, dim=-1, keepdim=True)
    return torch.cat([torch.cos(angle / 2), torch.sin(angle / 2) / angle * vector], dim=-1)


def _raw_projection(points: Any, pose: Any, K: Any, near: float) -> Any:  # noqa: N803 - the field's name
    return points[..., :2] / points[..., 2:], points[..., 2]


def _no_near_plane(of: Callable[..., Any]) -> Callable[..., Any]:
    return lambda view, pose=None: of(replace(view, near=-1e30), pose)


def _nowhere(clip: Any) -> WorkingSpace:
    return WorkingSpace(np.zeros(3), 1.0)


MUTATIONS = (
    Mutation("floor of divisions", safemath, "safe_divide", lambda a, b, floor=0.0: a / b, ("N01",)),
    Mutation("floor of roots", safemath, "safe_sqrt", lambda x, floor=0.0: torch.sqrt(x), ("N30",)),
    Mutation("floor of logarithms", safemath, "safe_log", lambda x, floor=0.0: torch.log(x), ("N14",)),
    Mutation("floor of lengths", safemath, "safe_norm", lambda x, floor=0.0: (x * x).sum(-1).sqrt(), ("N30",)),
    Mutation("clamp of logits", safemath, "logit", lambda p: torch.log(p / (1 - p)), ("N11",)),
    Mutation("clamp of log scales", safemath, "exp_scale", torch.exp, ("N03",)),
    Mutation("quaternions without length", safemath, "normalise", _raw_quaternions, ("N02",)),
    Mutation("Taylor branch of rotations", safemath, "rotation_vector_to_quaternion", _raw_rotation, ("N30",)),
    Mutation("floor of depths", safemath, "project", _raw_projection, ("N01",)),
    Mutation("near plane", rasterize, "lens_of", _no_near_plane(rasterize.lens_of), ("N01", "N20")),
    Mutation("finite gate", guard.Guard, "judge", lambda self, loss, parts=None: "step", ("N27",)),
    Mutation("quarantine", guard.Guard, "quarantine", lambda self: [], ("N27", "N11")),
    Mutation("rollback", guard.Guard, "rollback", lambda self: None, ("N27",)),
    Mutation("end of hopeless runs", guard, "ROLLBACKS", 10**9, ("N27",)),
    Mutation("learning rates back off", guard, "BACK_OFF", 1.0, ("N27",)),
    Mutation("learning rates come back", guard, "RECOVERY", 10**9, ("N27",)),
    Mutation("largest gradient", guard, "LARGEST", float("inf"), ("N27",)),
    Mutation("ranges of parameters", guard.Guard, "_limit", lambda self, owner, gaussians: None, ("N11",)),
    Mutation("bound of a prior's words", sds, "GAP_LIMIT", float("inf"), ("N26",)),
    Mutation("coordinates near the origin", run, "working_space", _nowhere, ("N24", "N28")),
)


@dataclass(frozen=True)
class Compiled:
    """A guard inside the kernels: the constant of render/rasterizer.py, what it becomes, rows that may notice."""

    name: str
    constant: str
    instead: float
    rows: tuple[str, ...]


COMPILED = (
    Compiled("least alpha (compiled)", "ALPHA_MIN", 1e-30, ("N12", "N13", "N05")),
    Compiled("clamp of alpha (compiled)", "ALPHA_MAX", 1.0, ("N13",)),
)
CHILD = """
import sys
from genmojo_core.render import rasterizer
setattr(rasterizer, sys.argv[1], float(sys.argv[2]))
from genmojo_core.hard_cases import suite
from genmojo_core.hard_cases.case import verdicts
for verdict in verdicts([case for case in suite.CASES if case.row in sys.argv[3].split(",")]):
    if not verdict.holds:
        print(verdict.row, verdict.name)
"""


def failing_compiled(mutation: Compiled) -> list[str]:
    """Names of the cases that fail in a process whose kernels were compiled without the guard."""
    with tempfile.TemporaryDirectory() as cache:
        environment = {**os.environ, "XDG_CACHE_HOME": cache, "LOCALAPPDATA": cache}
        command = [sys.executable, "-c", CHILD, mutation.constant, str(mutation.instead), ",".join(mutation.rows)]
        told = subprocess.run(command, env=environment, capture_output=True, text=True, check=False)
    if told.returncode:
        raise RuntimeError(f"{mutation.name}: {told.stderr[-500:]}")
    return told.stdout.splitlines()[:2]


def failing(mutation: Mutation) -> list[str]:
    """Names of the cases that fail without the guard; it stops at the first two."""
    found: list[str] = []
    with mock.patch.object(mutation.target, mutation.attribute, mutation.instead):
        for verdict in verdicts([case for case in suite.CASES if case.row in mutation.rows]):
            found += [] if verdict.holds else [f"{verdict.row} {verdict.name}"]
            if len(found) == 2:
                break
    return found


def kept_rows(path: Path | None) -> dict[str, list[str]]:
    """Cases that failed without each guard tried so far."""
    return {} if path is None or not path.exists() else dict(map(json.loads, path.read_text().splitlines()))


def main() -> int:
    """Print guard -> cases that fail without it; 1 if a guard is missed by nobody."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--only", default="", help="guards whose name contains this")
    parser.add_argument("--kept", type=Path, help="file of results, a JSON line each")
    args = parser.parse_args()
    torch.set_num_threads(1)
    kept, survived = kept_rows(args.kept), 0
    print("| guard taken away | cases that fail |\n|---|---|")
    for mutation in (m for m in (*MUTATIONS, *COMPILED) if args.only in m.name):
        found = kept.get(mutation.name)
        if found is None:
            found = failing(mutation) if isinstance(mutation, Mutation) else failing_compiled(mutation)
            if args.kept is not None:
                with args.kept.open("a") as file:
                    file.write(json.dumps([mutation.name, found]) + "\n")
        survived += not found
        print(f"| {mutation.name} | {', '.join(found) or 'NONE'} |", flush=True)
    return 1 if survived else 0


if __name__ == "__main__":
    sys.exit(main())
