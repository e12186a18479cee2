"""`genmojo evaluate` and `genmojo metrics`: how good a scene or point tracks are."""

from __future__ import annotations

import argparse
from typing import Any

import numpy as np

from genmojo_core.cli.output import progress
from genmojo_core.errors import GenmojoError


def add_commands(commands: Any) -> None:
    """Add `evaluate` and `metrics`."""
    evaluate = commands.add_parser("evaluate", help="a scene against its clip, and against truth where there is some")
    evaluate.add_argument("scene", metavar="scene.h5")
    evaluate.add_argument("clip", metavar="CLIP")
    evaluate.add_argument("--sheet", metavar="PATH.png", help="also write a contact sheet")
    evaluate.add_argument("--turntable", action="store_true",
                          help="also look at the objects from all round: flicker, holes, thickness")  # fmt: skip
    evaluate.set_defaults(run=run_evaluate)
    metrics = commands.add_parser("metrics", help="point tracks against true ones, in pixels of 256 x 256")
    metrics.add_argument("predicted", metavar="PRED.npz")
    metrics.add_argument("truth", metavar="TRUTH.npz", help="our tracks npz, or a Blender truth.npz")
    metrics.set_defaults(run=run_metrics)


def run_evaluate(args: argparse.Namespace) -> dict[str, Any]:
    """Everything that can be measured, at 256 pixels on the short side."""
    from genmojo_core.store import scene_hdf5
    from genmojo_core.store.atomic import check_writable

    if args.sheet:
        check_writable(args.sheet)
    scene = scene_hdf5.read(args.scene)
    result = evaluate(scene, args.clip, args.sheet)
    if args.turntable:
        from genmojo_core.measure.turntable import turntable_figures

        with progress("looking from all round") as tell:
            result |= turntable_figures(scene, progress=tell)
    return result


def evaluate(scene: Any, clip_path: str, sheet_path: str | None = None) -> dict[str, Any]:
    """Scores of a BakedScene against the clip at `clip_path`; also used by `demo`.

    Raises GenmojoError if the clip is not the scene's own or the sheet cannot be written.
    """
    from genmojo_core.clip import folders
    from genmojo_core.config import MEASURED_SIDE
    from genmojo_core.measure import sheet, truth
    from genmojo_core.measure.reconstruction import reconstruction

    clip = folders.read(clip_path, short_side=MEASURED_SIDE)
    result: dict[str, Any] = {"clip": clip.name, "frames": len(scene), "gaussians": len(scene.xyz)}
    with progress("rendering every frame") as tell:
        result |= reconstruction(scene, clip, tell)
    truth_path = truth.find_truth(clip_path)
    if truth_path is not None:
        with progress("unseen views") as tell:
            result |= truth.novel_scores(scene, clip, truth_path, tell)
        result |= truth.track_scores(scene, clip, truth_path)
    if sheet_path is not None:
        sheet.write_sheet(scene, clip, sheet_path)
        result["sheet"] = sheet_path
    return result


def run_metrics(args: argparse.Namespace) -> dict[str, Any]:
    """Track metrics. Where PRED holds just the tracks of TRUTH that are visible in frame 0, those are compared."""
    from genmojo_core.store.npz import read_tracks
    from genmojo_core.tracks.metrics import select, space_metrics, track_metrics

    predicted = read_tracks(args.predicted)
    truth = read_tracks(args.truth, predicted.size)
    first = truth.visible[:, 0]
    if len(predicted.xy) != len(truth.xy) and len(predicted.xy) == int(first.sum()):
        truth = select(truth, first)
    if predicted.state.shape != truth.state.shape:
        (n, t), (m, u) = predicted.state.shape, truth.state.shape
        raise GenmojoError("schema", f"holds {n} tracks over {t} frames, the truth {m} over {u}", args.predicted)
    result = track_metrics(predicted, truth)
    if predicted.xyz is not None and truth.xyz is not None and np.isfinite(predicted.xyz).any():
        result |= space_metrics(predicted.xyz, truth.xyz, True, truth.object)
    return dict(result)
