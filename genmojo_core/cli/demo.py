"""`genmojo demo`: the whole way on a clip that is made on the spot, with exact truth to compare with."""

from __future__ import annotations

import argparse
import importlib.util
import os
import subprocess
import sys
import time
from pathlib import Path
from typing import Any

from genmojo_core.cli.output import say
from genmojo_core.errors import GenmojoError

_CLIP = "crossing-shapes"  # a named procedural clip
_BUDGET = 60.0  # seconds of optimisation


def add_commands(commands: Any) -> None:
    """Add `demo`."""
    demo = commands.add_parser("demo", help="make a clip, turn it into a scene, measure it, show it")
    demo.add_argument("-o", "--output", default="genmojo-demo", metavar="DIR", help="where clip, scene and sheet go")
    demo.add_argument("--budget", type=float, default=_BUDGET, metavar="S", help="seconds of optimisation")
    demo.add_argument("--no-app", action="store_true", help="do not open the app")
    demo.set_defaults(run=run_demo)


def run_demo(args: argparse.Namespace) -> dict[str, Any]:
    """Clip -> effects -> scene -> scores -> files, each step said aloud."""
    from genmojo_core.cli import optimise, scores
    from genmojo_core.clip import folders
    from genmojo_core.config import preset
    from genmojo_core.effects import decide
    from genmojo_core.estimate.complete import complete
    from genmojo_core.store import scene_hdf5
    from genmojo_core.store.atomic import check_writable

    start = time.monotonic()
    folder = Path(args.output)
    check_writable(folder / "scene.h5")
    config = preset("draft", budget_seconds=args.budget)
    say(f"1/4 making the clip '{_CLIP}' with exact truth")
    clip_path = write_clip(folder / "clip")
    clip = complete(folders.read(clip_path, short_side=config.short_side))
    plan = decide.plan(clip, config, {})
    say("2/4 deciding what the clip calls for")
    for effect in plan.effects:
        say(f"    {'on ' if effect.on else 'off'} {effect.name}: {effect.reason}")
    say(f"3/4 optimising a 4D scene of {clip.objects} objects over {len(clip)} frames")
    scene_path = folder / "scene.h5"
    job = optimise.Job(str(scene_path), str(clip_path), start)
    run = optimise.optimize_clip(clip, plan, config, job)
    if run.get("exit_code"):
        return run
    say("4/4 comparing with the truth")
    figures = scores.evaluate(scene_hdf5.read(scene_path), str(clip_path), str(folder / "sheet.png"))
    kept = ("psnr", "psnr_full", "ssim", "instance_iou", "novel_iou", "novel_psnr_inside", "ate", "mte", "oa", "ate_3d")
    shown = {key: figures[key] for key in kept if key in figures}
    result = {"seconds": time.monotonic() - start, "first_scene_seconds": run["first_scene_seconds"],
              "steps": run["steps"], "peak_mb": run["peak_mb"], **shown, "clip": str(clip_path),
              "path": str(scene_path), "sheet": str(folder / "sheet.png")}  # fmt: skip
    if not args.no_app:
        open_app(scene_path)
    return result


def write_clip(folder: Path) -> Path:
    """Generate the demo's clip into a folder and return it. Raises GenmojoError("io")."""
    from genmojo_core.clip import synthetic, synthetic_files

    clip, truth = synthetic.generate(_CLIP)
    synthetic_files.write(clip, truth, folder)
    return folder


def open_app(scene: Path) -> bool:
    """Start the app on a scene if there is a display and the app is installed; says why not otherwise."""
    if importlib.util.find_spec("genmojo_studio.app") is None:
        say("The app is not part of this installation yet; the scene can be rendered with genmojo render.")
        return False
    if sys.platform.startswith("linux") and not (os.environ.get("DISPLAY") or os.environ.get("WAYLAND_DISPLAY")):
        say(f"There is no display; open the scene later with: genmojo-studio {scene}")
        return False
    try:
        subprocess.Popen([sys.executable, "-m", "genmojo_studio.app", str(scene)])
    except OSError as error:
        raise GenmojoError("io", f"the app cannot be started ({error.strerror})", str(scene)) from error
    return True
