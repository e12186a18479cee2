"""Rows of issue 6's table: tracks from the scene alone and the order of the ablation, against the Blender clips' truth.

Scenes and ablation rows are kept in the table's folder, and used again only by the program that made them. An ablation
is 18 runs of two minutes of CPU time at most, each kept as it ends; a run takes 30 (no prior) to 110 seconds.
"""

from __future__ import annotations

import json
from collections.abc import Callable

from standard_runs import genmojo, scores
from table import Bench, Check, Rows

CHAIN = {"cross": 11.6, "trio": 9.2}  # ATE of the mask-stabilised chain (BLENDER.md)
LIMITS = {"cross": (7.0, 5.0, 9.0), "trio": (5.5, 4.5, 9.0)}  # ATE, MTE, hidden
OA = 90.0
BELOW_CHAIN = 0.65  # 35 % below it
WITHOUT_INPUTS = 1.5


def tracks(name: str) -> Callable[[Bench], list[Check]]:
    """Tracks of the scene alone, all frames, in pixels of 256 x 256."""

    def row(bench: Bench) -> list[Check]:
        got = scores(bench, f"blender-{name}", "prior")
        ate, mte, hidden = LIMITS[name]
        return [
            Check("ate", got["ate"], min(ate, BELOW_CHAIN * CHAIN[name]), at_most=True),
            Check("mte", got["mte"], mte, at_most=True),
            Check("hidden", got["hidden"], hidden, at_most=True),
            Check("oa", got["oa"], OA),
            *(Check(key, got.get(key)) for key in ("ate_3d", "ate_3d_percent", "aj", "delta", "psnr")),
            *(Check(f"object {k}: {of}", one[of]) for k, one in got["track_objects"].items() for of in ("ate", "oa")),
        ]

    return row


def guessed(name: str) -> Callable[[Bench], list[Check]]:
    """The same without depth and cameras."""

    def row(bench: Bench) -> list[Check]:
        given = scores(bench, f"blender-{name}", "prior")
        got = scores(bench, f"blender-{name}", "guessed", "--ignore", "depth,cameras")
        return [Check("ate ratio", got["ate"] / given["ate"], WITHOUT_INPUTS, at_most=True),
                *(Check(key, got.get(key)) for key in ("ate", "mte", "hidden", "oa", "ate_3d_percent"))]  # fmt: skip

    return row


def ablation(name: str) -> Callable[[Bench], list[Check]]:
    """The paper's order, means over three seeds; every check is full minus variant, or variant minus full."""

    def row(bench: Bench) -> list[Check]:
        folder = bench.work / f"ablation-{name}"
        genmojo(bench, "ablate", str(bench.data / f"blender-{name}"), "-o", str(folder), "--budget", "120")
        kept = json.loads((folder / "ablation.json").read_text())
        mean = {entry["variant"]: entry["mean"] for entry in kept["variants"]}
        cut = sum(any("the budget ended" in note for note in one["notes"]) for one in kept["rows"])
        full = mean["full"]

        def worse(variant: str, key: str, sign: int = 1) -> Check:
            return Check(f"{variant}: {key} worse by", sign * (full[key] - mean[variant][key]), 0.0)

        return [
            worse("no_joint", "psnr"), worse("no_joint", "a_epe", -1),
            *(worse("no_prior", key) for key in ("iou_90", "psnr_union_90", "iou_180", "psnr_union_180")),
            *(worse("no_prior", key) for key in ("iou_30", "psnr_inside_30")),
            worse("no_labels", "a_epe", -1),
            *(worse("scene_prior", key) for key in ("iou_90", "psnr_union_90")),
            Check("runs cut short by the budget", cut, 0, at_most=True),
            *(Check(f"{variant}: {key}", mean[variant][key]) for variant in mean for key in ("psnr", "a_epe", "steps")),
        ]  # fmt: skip

    return row


ROWS: Rows = {
    **{f"tracks-{name}": (f"{name}: tracks from the scene alone", tracks(name)) for name in LIMITS},
    **{f"guessed-{name}": (f"{name} without depth and cameras", guessed(name)) for name in LIMITS},
    **{f"ablation-{name}": (f"{name}: ablation, 128 px, 3 seeds", ablation(name)) for name in LIMITS},
}
