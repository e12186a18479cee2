"""`genmojo train-prior`: the embedded view prior, trained by anyone from nothing but this program."""

from __future__ import annotations

import argparse
from typing import Any

from genmojo_core.cli.arguments import seconds
from genmojo_core.cli.output import progress, say
from genmojo_core.errors import GenmojoError


def add_commands(commands: Any) -> None:
    """Add `train-prior`."""
    train = commands.add_parser("train-prior", help="train the embedded view prior on procedural objects")
    train.add_argument("-o", "--output", required=True, metavar="DIR", help="state, log and prior.safetensors; a state "
                       "that is there is gone on from")  # fmt: skip
    train.add_argument("--from", dest="start", metavar="FILE", help="go on from a finished file's weights")
    train.add_argument("--volume-time", type=seconds, default=3 * 3600.0, metavar="3h", help="CPU time for the volume")
    train.add_argument("--denoiser-time", type=seconds, default=3600.0, metavar="1h", help="and for the denoiser")
    train.add_argument("--batch", type=int, default=8, metavar="N", help="objects per step")
    train.add_argument("--seed", type=int, default=0)
    train.add_argument("--device", default="cpu", help="cpu or cuda")
    train.set_defaults(run=run_train)


def run_train(args: argparse.Namespace) -> dict[str, Any]:
    """Train both parts, write the file and its table. Ctrl-C keeps the last measurement's state."""
    from pathlib import Path

    import torch

    from genmojo_core.priors import make

    if args.batch < 1:
        raise GenmojoError("argument", "a step needs at least one object", "--batch")
    if args.device not in ("cpu", "cuda") or (args.device == "cuda" and not torch.cuda.is_available()):
        raise GenmojoError("argument", f"torch sees no device '{args.device}'", "--device", "use cpu")
    torch.set_num_threads(1)
    folder = Path(args.output)
    plan = make.Times(args.volume_time, args.denoiser_time, args.batch, args.seed, args.device,
                      Path(args.start) if args.start else None)  # fmt: skip
    with progress("training") as tell:

        def hear(part: str, done: Any) -> None:
            tell(done.share)
            figures = ", ".join(f"{name} {value:.4g}" for name, value in done.figures.items())
            say(f"{part}, step {done.step}: {figures}")

        path = make.make_prior(folder, plan, hear)
    return {"path": str(path), **make.described(path)}
