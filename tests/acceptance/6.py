"""Issue 6, "Shown by": the prior on its frozen test set, out of its generator and in whole runs; tracks; the ablation.

    python tests/acceptance/6.py --work DIR [--only frozen,crops,fit] [--again] [--data ../shared/data]

Results are kept in DIR/results, so an interrupted run goes on where it stopped; --again measures anew, but scenes in
DIR/scenes and ablation rows that the same program made are taken over. Prints the table as Markdown and writes it with
all figures to DIR/6.json. One seed, except for the ablation.
"""

from __future__ import annotations

import json
import sys
from collections.abc import Callable
from typing import Any

from ablation_rows import ROWS as ABLATION
from standard_runs import scores
from table import Bench, Check, Rows, main

FLAT = {"blender-cross": 15.6, "blender-trio": 17.6}  # dB of the true silhouette in one flat colour at ±90 and 180
NEAR = {"blender-cross": 16.5, "blender-trio": 18.5}  # dB wanted inside at ±30
GROUPS = {"±30": ("0_30", "0_-30", "30_0", "-30_0"), "±90": ("0_90", "0_-90"), "180": ("0_180",)}

_TABLE = """
import json
from genmojo_core.priors import held_out, weights
print(json.dumps(held_out.table(weights.shipped().volume)))
"""


def frozen(bench: Bench) -> list[Check]:
    """The shipped file on its frozen test set, against predictors made by hand."""
    rows = json.loads(bench.python("-c", _TABLE))
    ours = rows["prior"]
    return [
        Check("all dB", ours["all"]),
        Check("over inflation", ours["all"] - rows["inflated silhouette"]["all"], 1.3),
        Check("over empty", ours["all"] - rows["empty"]["all"], 3.5),
        Check("inside dB", ours["inside"]),
        Check("IoU", ours["iou"]),
        Check("loses with another's condition", ours["all"] - rows["prior, another object's condition"]["all"], 1.0),
    ]


def crops(name: str) -> Callable[[Bench], list[Check]]:
    """Crops of a clip's frames 0 and 12, whole views of the same moment."""

    def row(bench: Bench) -> list[Check]:
        out = bench.python("-m", "tests.benchmarks.prior_crops", str(bench.data / name), "--frames", "0,12")
        rows = json.loads(out)
        ours, by_hand = rows["prior"], rows["inflated"]
        return [
            Check("inside dB", ours["inside"]),
            Check("over inflation", ours["inside"] - by_hand["inside"], 1.0),
            Check("IoU", ours["iou"]),
            Check("over inflation", ours["iou"] - by_hand["iou"], 0.05),
            Check("inside, flat true colour", rows["flat"]["inside"]),
        ]

    return row


def fit(bench: Bench) -> list[Check]:
    """Gaussians fitted to one picture: dB inside the union over the regularised fit, at ±90 degrees."""
    rows = json.loads(bench.python("-m", "tests.benchmarks.prior_fit", "--objects", "8"))
    base, ours = rows["regularised"], rows["pseudo"]
    return [
        Check("pseudo over regularised at ±90", ours["90"] - base["90"], 1.5),
        Check("all", ours["all"] - base["all"]),
        Check("x0 at ±90", rows["x0"]["90"] - base["90"]),
        Check("sds at ±90", rows["sds"]["90"] - base["90"]),
        Check("another object's condition loses", ours["all"] - rows["another object's"]["all"], 1.0),
        Check("IoU regularised", base["iou"]),
        Check("pseudo", ours["iou"]),
        Check("CPU s regularised", base["cpu"]),
        Check("pseudo", ours["cpu"]),
    ]


def novel(name: str) -> Callable[[Bench], list[Check]]:
    """Unseen views against truth, with the prior and without; tracks beside them."""

    def row(bench: Bench) -> list[Check]:
        with_it = scores(bench, name, "prior")
        without = scores(bench, name, "none", "--prior", "none")
        ours, bare = (
            {group: means(one["novel"], views) for group, views in GROUPS.items()} for one in (with_it, without)
        )
        checks = [
            Check("±30 IoU", ours["±30"]["iou"], 0.85),
            Check("inside", ours["±30"]["psnr_inside"], NEAR[name]),
            Check("inside, brightness levelled", ours["±30"]["psnr_levelled"]),
        ]
        for group in ("±90", "180"):
            checks += [
                Check(f"{group} IoU", ours[group]["iou"], 0.65),
                Check("over none", ours[group]["iou"] - bare[group]["iou"], 0.08),
                Check("inside", ours[group]["psnr_inside"], FLAT[name] - 1.5),
                Check("union over none", ours[group]["psnr_union"] - bare[group]["psnr_union"], 1.5),
            ]
        figures = ("ate", "mte", "oa", "hidden")
        return checks + [
            Check(f"{figure}{said}", one[figure])
            for one, said in ((with_it, ""), (without, " without"))
            for figure in figures
            if figure in one
        ]

    return row


def means(views: dict[str, dict[str, float]], names: tuple[str, ...]) -> dict[str, float]:
    """Mean figures over some views."""
    keys = ("iou", "psnr_inside", "psnr_levelled", "psnr_union")
    return {k: sum(views[n][k] for n in names) / len(names) for k in keys}


def first_second(bench: Bench, name: str) -> dict[str, Any]:
    """Figures of a real clip's frames 0:24 at standard with the embedded prior."""
    return scores(bench, name, "prior", "--frames", "0:24", "--budget", "15m")


def crossing(bench: Bench) -> list[Check]:
    """Whole static lift and motion of crossing 0:24 with the embedded prior."""
    got = first_second(bench, "crossing")
    return [Check("wall s", got["seconds"], 900, at_most=True), Check("psnr", got["psnr"])]


def turntable(name: str) -> Callable[[Bench], list[Check]]:
    """A real clip from all round: no more flicker than in the clip's own view, closed, no flat cards."""

    def row(bench: Bench) -> list[Check]:
        got = first_second(bench, name)
        views = got["turntable"]
        own = views["0"]["flicker"]
        return [
            Check("flicker at 0, levels of 255", own),
            *(Check(f"times that at {a}°", views[a]["flicker"] / own, 2.0, at_most=True) for a in views if a != "0"),
            *(Check(f"holes at {a}°, %", views[a]["holes"], 2.0, at_most=True) for a in views),
            *(Check(f"thickness of {one}", share, 0.3) for one, share in got["thickness"].items()),
        ]

    return row


ROWS: Rows = {
    "frozen": ("frozen test set, 64 objects", frozen),
    "crops-cross": ("out of the generator: blender-cross", crops("blender-cross")),
    "crops-trio": ("out of the generator: blender-trio", crops("blender-trio")),
    "fit": ("fit to one picture, 8 objects", fit),
    "novel-cross": ("blender-cross, standard", novel("blender-cross")),
    "novel-trio": ("blender-trio, standard", novel("blender-trio")),
    "crossing": ("crossing 0:24, standard with prior", crossing),
    "turntable-crossing": ("crossing 0:24 from all round", turntable("crossing")),
    "turntable-gold-fish": ("gold-fish 0:24 from all round", turntable("gold-fish")),
    **ABLATION,
}


if __name__ == "__main__":
    sys.exit(main(ROWS, __doc__, "6"))
