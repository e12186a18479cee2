"""All hard cases, in the order of their rows."""

from __future__ import annotations

from genmojo_core.hard_cases import clip_cases, guard_cases, maths_cases, splat_cases
from genmojo_core.hard_cases.case import Case

CASES: tuple[Case, ...] = tuple(
    sorted((*maths_cases.CASES, *splat_cases.CASES, *clip_cases.CASES, *guard_cases.CASES), key=lambda case: case.row)
)
