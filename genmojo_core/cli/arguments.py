"""Values on the command line, parsed with one sentence per fault."""

from __future__ import annotations

import argparse
import math
import re
from typing import Any, NoReturn

from genmojo_core.errors import GenmojoError


class Parser(argparse.ArgumentParser):
    """argparse whose faults are GenmojoErrors: one sentence, no usage page."""

    def error(self, message: str) -> NoReturn:
        """Raise GenmojoError("argument")."""
        raise GenmojoError("argument", message, self.prog, f"see {self.prog} --help")


def frame_range(text: str) -> tuple[int, int | None]:
    """ "A:B", ":B", "A:" or "A" as (first, end); end None for all. Positions in the source, B not included.

    Raises GenmojoError("argument").
    """
    match = re.fullmatch(r"(\d*):(\d*)|(\d+)", text.strip())
    if match is None or text.strip() == ":":
        raise GenmojoError("argument", f"'{text}' is no range of frames", "--frames", "write for example 0:24")
    if match[3] is not None:
        return int(match[3]), int(match[3]) + 1
    first, end = int(match[1] or 0), int(match[2]) if match[2] else None
    if end is not None and end <= first:
        raise GenmojoError("argument", f"'{text}' holds no frame", "--frames", "write for example 0:24")
    return first, end


def seconds(text: str) -> float:
    """ "60s", "2m", "1.5h" or "60" as seconds. Raises GenmojoError("argument") unless positive."""
    match = re.fullmatch(r"(\d+(?:\.\d*)?)\s*(s|m|min|h)?", text.strip())
    value = float(match[1]) * {"m": 60, "min": 60, "h": 3600}.get(match[2] or "s", 1) if match else 0.0
    if value <= 0:
        raise GenmojoError("argument", f"'{text}' is no time", "--budget", "write for example 60s or 2m")
    return value


def picture_size(text: str) -> tuple[int, int]:
    """ "1920x1080" as (width, height). Raises GenmojoError("argument")."""
    match = re.fullmatch(r"([1-9]\d{0,5})x([1-9]\d{0,5})", text.strip())
    if match is None:
        raise GenmojoError("argument", f"'{text}' is no picture size", "--size", "write for example 1920x1080")
    return int(match[1]), int(match[2])


def names(text: str) -> tuple[str, ...]:
    """ "a,b" as ("a", "b")."""
    return tuple(part.strip() for part in text.split(",") if part.strip())


def box(text: str) -> tuple[int, tuple[float, float, float, float]]:
    """ "FRAME:X0,Y0,X1,Y1" as (frame, (x0, y0, x1, y1)), source pixels. Raises GenmojoError("argument")."""
    match = re.fullmatch(r"(\d+):([^,]+),([^,]+),([^,]+),([^,]+)", text.strip())
    try:
        corners = tuple(float(match[i]) for i in range(2, 6)) if match else ()
    except ValueError:
        corners = ()
    if match is None or len(corners) != 4 or not all(map(math.isfinite, corners)):
        raise GenmojoError("argument", f"'{text}' is no box", "--box", "write FRAME:X0,Y0,X1,Y1 in pixels of the clip")
    x0, y0, x1, y1 = corners
    if x1 <= x0 or y1 <= y0:
        raise GenmojoError("argument", f"the box '{text}' has no area", "--box", "give X0 < X1 and Y0 < Y1")
    return int(match[1]), (x0, y0, x1, y1)


def add_clip_options(parser: argparse.ArgumentParser) -> None:
    """Options that say how a clip is read."""
    parser.add_argument("clip", metavar="CLIP", help="folder of frames, DAVIS/MOSE/GenMOJO folder, or a video")
    parser.add_argument("--frames", type=frame_range, metavar="A:B", help="positions A to B-1 of the source")
    parser.add_argument("--ignore", type=names, default=(), metavar="a,b", help="channels not to read: depth, cameras, "
                        "flow, background, tracks")  # fmt: skip
    parser.add_argument("--pixel-aspect", type=float, metavar="A", help="width / height of one source pixel as shown")
    parser.add_argument("--box", type=box, action="append", default=[], metavar="FRAME:X0,Y0,X1,Y1",
                        help="one object in a clip without masks; may be given several times")  # fmt: skip
    parser.add_argument("--masks", metavar="FILE.npz", help="masks corrected in genmojo-studio, instead of the clip's")
    parser.add_argument("--tracks", metavar="FILE", help="annotated point tracks that the scene shall follow instead "
                        "of CLIP/tracks.npz: an npz, or a .genmojo project (what people placed in it)")  # fmt: skip
    parser.add_argument("--effects", default="auto", metavar="auto|all|+a,-b", help="switch effects on or off by "
                        "hand; all: every effect that the clip allows")  # fmt: skip


def add_config_options(parser: argparse.ArgumentParser) -> None:
    """Options that make a run configuration."""
    parser.add_argument(
        "--preset",
        help="draft, standard or full (numbers: genmojo_core/config.py), or auto: whatever gives most in "
        "--budget; auto where only a budget is given, else standard",
    )
    parser.add_argument("--size", type=int, metavar="PX", help="short side of the frames while optimising")
    parser.add_argument("--budget", type=seconds, metavar="60s", help="end after this time with what stands")
    parser.add_argument("--until", metavar="GOAL", help='end once this holds: "psnr>=26" (held out, dB) or '
                        '"gain<0.1dB/min" (expected of the next minute)')  # fmt: skip
    parser.add_argument("--seed", type=int, default=0)
    parser.add_argument("--device", default="auto", help="auto, cpu or cuda")
    parser.add_argument("--prior", metavar="embedded|none|zero123:DIR",
                        help="what draws sides that no frame shows (also zeronvs:DIR)")  # fmt: skip
    parser.add_argument("--view-range", type=float, metavar="DEG", help="how far round the camera the scene will be "
                        "looked at (180: all round); sides beyond are not asked of the prior")  # fmt: skip
    parser.add_argument("--method", metavar="NAME", help="genmojo, or what it is compared with: dreamscene4d, "
                        "dreamgaussian4d, shape-of-motion")  # fmt: skip
    parser.add_argument("--prior-mode", metavar="auto|pseudo|x0|sds", help="how the prior is followed")


def config_changes(args: argparse.Namespace) -> dict[str, Any]:
    """What the options change in a preset."""
    changes: dict[str, Any] = {"seed": args.seed, "device": args.device, "ignore": args.ignore}
    changes |= {
        name: getattr(args, name)
        for name in ("prior", "prior_mode", "method", "until", "view_range")
        if getattr(args, name) is not None
    }
    if args.size is not None:
        changes["short_side"] = args.size
    if args.budget is not None:
        changes["budget_seconds"] = args.budget
    return changes
