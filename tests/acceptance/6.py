"""Issue 6, "Shown by": the prior on its frozen test set, out of its generator and in whole runs; tracks; the ablation.

    python tests/acceptance/6.py --work DIR [--only frozen,crops,fit] [--again] [--data ../shared/data]

Results are kept in DIR/results, so an interrupted run goes on where it stopped; --again measures anew. Prints the table
as Markdown and writes it with all figures to DIR/6.json. Scenes are DIR/scenes/*.h5. One seed.
"""

from __future__ import annotations

import json
import sys
import time
from collections.abc import Callable
from typing import Any

from ablation_rows import ROWS as ABLATION
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


def run(bench: Bench, name: str, key: str, *options: str) -> tuple[dict[str, Any], float]:
    """The scores of a clip at `standard`, and the wall seconds of the run."""
    scene = bench.work / "scenes" / f"{key}.h5"
    scene.parent.mkdir(exist_ok=True)
    clip, start = str(bench.data / name), time.monotonic()
    program = ("-m", "genmojo_core.cli.main")
    bench.python(*program, "optimize", clip, "-o", str(scene), "--preset", "standard", *options, "--json")
    seconds = time.monotonic() - start
    return json.loads(bench.python(*program, "evaluate", str(scene), clip, "--json")), seconds


def novel(name: str) -> Callable[[Bench], list[Check]]:
    """Unseen views against truth, with the prior and without; tracks beside them."""

    def row(bench: Bench) -> list[Check]:
        with_it, _ = run(bench, name, f"{name}-prior")
        without, _ = run(bench, name, f"{name}-none", "--prior", "none")
        ours, bare = (
            {group: means(scores["novel"], views) for group, views in GROUPS.items()} for scores in (with_it, without)
        )
        checks = [
            Check("±30 IoU", ours["±30"]["iou"], 0.85),
            Check("inside", ours["±30"]["psnr_inside"], NEAR[name]),
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
            Check(f"{figure}{said}", scores[figure])
            for scores, said in ((with_it, ""), (without, " without"))
            for figure in figures
            if figure in scores
        ]

    return row


def means(views: dict[str, dict[str, float]], names: tuple[str, ...]) -> dict[str, float]:
    """Mean figures over some views."""
    return {k: sum(views[n][k] for n in names) / len(names) for k in ("iou", "psnr_inside", "psnr_union")}


def crossing(bench: Bench) -> list[Check]:
    """Whole static lift and motion of crossing 0:24 with the embedded prior."""
    scores, seconds = run(bench, "crossing", "crossing-prior", "--frames", "0:24", "--budget", "15m")
    return [Check("wall s", seconds, 900, at_most=True), Check("psnr", scores["psnr"])]


ROWS: Rows = {
    "frozen": ("frozen test set, 64 objects", frozen),
    "crops-cross": ("out of the generator: blender-cross", crops("blender-cross")),
    "crops-trio": ("out of the generator: blender-trio", crops("blender-trio")),
    "fit": ("fit to one picture, 8 objects", fit),
    "novel-cross": ("blender-cross, standard", novel("blender-cross")),
    "novel-trio": ("blender-trio, standard", novel("blender-trio")),
    "crossing": ("crossing 0:24, standard with prior", crossing),
    **ABLATION,
}


if __name__ == "__main__":
    sys.exit(main(ROWS, __doc__, "6"))
