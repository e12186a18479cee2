"""Options that put an external model or a file in the place of an embedded estimator."""

from __future__ import annotations

import argparse
from pathlib import Path
from typing import TYPE_CHECKING

from genmojo_core.errors import GenmojoError

if TYPE_CHECKING:
    from genmojo_core.estimate.models import DepthModel, Models


def add_model_options(parser: argparse.ArgumentParser) -> None:
    """`--depth-model`, `--depth-file`, `--mask-model`, `--detector`, `--find`; nothing is fetched."""
    parser.add_argument("--depth-model", metavar="DIR", help="folder of a Depth-Anything model (transformers layout)")
    parser.add_argument(
        "--depth-file", metavar="[metric:]NPZ", help="depth another program wrote: disparity, or metric"
    )
    parser.add_argument("--mask-model", metavar="DIR", help="folder of a SAM, SAM-HQ or SAM 2 model (transformers)")
    parser.add_argument("--detector", metavar="DIR", help="folder of a Grounding DINO or OWL-ViT model (transformers)")
    parser.add_argument("--find", metavar="a,b", help="objects the detector looks for, e.g. 'a red cup,a hand'")


def models_of(args: argparse.Namespace) -> Models | None:
    """The models that the options name, or None if there is none.

    Raises GenmojoError: "argument" for options that contradict one another, "io" or "missing_package" from the models.
    """
    from genmojo_core.estimate.models import Models

    if args.depth_model and args.depth_file:
        raise GenmojoError("argument", "depth comes from a model and from a file", "--depth-model, --depth-file",
                           "give one of them")  # fmt: skip
    if bool(args.detector) != bool(args.find):
        raise GenmojoError("argument", "a detector needs names to look for, and names a detector",
                           "--detector, --find", "give both")  # fmt: skip
    depth = _depth(args)
    masks = detector = None
    if args.mask_model:
        from genmojo_core.estimate.network_masks import SegmentAnything

        masks = SegmentAnything(Path(args.mask_model))
    if args.detector:
        from genmojo_core.estimate.network_text import TextDetector

        detector = TextDetector(Path(args.detector))
    phrases = tuple(part.strip() for part in (args.find or "").split(",") if part.strip())
    if depth is None and masks is None and detector is None:
        return None
    return Models(depth, masks, detector, phrases)


def _depth(args: argparse.Namespace) -> DepthModel | None:
    """Depth from a network or from a file."""
    if args.depth_model:
        from genmojo_core.estimate.network_depth import DepthNetwork

        return DepthNetwork(Path(args.depth_model))
    if args.depth_file:
        from genmojo_core.estimate.models import DepthFile

        kind, _, path = args.depth_file.rpartition(":")
        if kind == "metric":
            return DepthFile(Path(path), "metric")
        return DepthFile(Path(args.depth_file))
    return None
