"""`genmojo ablate`: what each part of the method is worth on a clip, as the paper's table."""

from __future__ import annotations

import argparse
from typing import Any

from genmojo_core.cli.arguments import names, seconds
from genmojo_core.cli.output import progress, say
from genmojo_core.errors import GenmojoError


def add_commands(commands: Any) -> None:
    """Add `ablate`."""
    ablate = commands.add_parser("ablate", help="the paper's ablation on a clip: a table of what each part is worth")
    ablate.add_argument("clip", metavar="CLIP")
    ablate.add_argument("-o", "--output", required=True, metavar="DIR", help="table (HTML, PNG, JSON) and scenes; rows "
                        "that lie there already are kept")  # fmt: skip
    ablate.add_argument("--preset", default="draft")
    ablate.add_argument("--size", type=int, default=128, metavar="PX", help="short side while optimising")
    ablate.add_argument("--budget", type=seconds, default=120.0, metavar="120s", help="CPU time per variant "
                        "and seed, so that what else the machine does cuts no run short")  # fmt: skip
    ablate.add_argument("--seeds", type=int, default=3, metavar="N", help="runs per variant")
    ablate.add_argument("--variants", type=names, default=(), metavar="a,b", help="full, no_joint, no_prior, "
                        "scene_prior, no_labels, worse_depth (default: these), and other methods as configurations of "
                        "this engine: dreamscene4d, dreamgaussian4d, shape-of-motion")  # fmt: skip
    ablate.add_argument("--prior", default="embedded", help="of the full model")
    ablate.add_argument("--device", default="auto")
    ablate.set_defaults(run=run_ablate)


def run_ablate(args: argparse.Namespace) -> dict[str, Any]:
    """Run what is missing, write the table, show it. Ctrl-C keeps finished rows."""
    from pathlib import Path

    from genmojo_core.config import preset
    from genmojo_core.measure import ablation, ablation_table
    from genmojo_core.store.atomic import check_writable, write_bytes
    from genmojo_core.store.safe import json_text

    if args.seeds < 1:
        raise GenmojoError("argument", "at least one run per variant is needed", "--seeds")
    folder = Path(args.output)
    check_writable(folder / "ablation.json")
    config = preset(args.preset, short_side=args.size, budget_seconds=args.budget, clock="cpu", prior=args.prior,
                    device=args.device)  # fmt: skip
    chosen = args.variants or tuple(ablation.VARIANTS)
    plan = ablation.Plan(chosen, tuple(range(args.seeds)), config)
    with progress("optimising") as tell:
        told: set[str] = set()

        def hear(name: str, event: Any) -> None:
            if name not in told:
                told.add(name)
                say(f"{len(told)}: {name}")
            tell(getattr(event, "progress", 0.0))

        rows = ablation.ablate(args.clip, plan, folder, hear)
    entries = ablation.summary(rows)
    title = f"Ablation on {Path(args.clip).name}"
    result = {"clip": str(args.clip), "config": config.to_json(), "variants": entries, "rows": rows}
    write_bytes(folder / "ablation.json", json_text(result).encode())
    ablation_table.write_html(entries, title, folder / "ablation.html")
    ablation_table.write_png(entries, title, folder / "ablation.png")
    shown = {e["title"]: {k: e["mean"][k] for k, *_ in ablation_table.COLUMNS if k in e["mean"]} for e in entries}
    return {"path": str(folder / "ablation.html"), "variants": shown}
