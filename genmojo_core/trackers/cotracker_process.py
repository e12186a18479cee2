"""The child process in which CoTracker runs: arrays in, arrays out, checkpoints as weights only.

    python -m genmojo_core.trackers.cotracker_process asked.npz answer.npz CHECKOUT CHECKPOINT HUB_MODEL MEMORY_GIB

asked: video (T, H, W, 3) uint8, queries (N, 3) t, x, y in pixels counted from the centre of the first.
answer: tracks (T, N, 2), visibility (T, N).
"""

from __future__ import annotations

import inspect
import sys
from collections.abc import Sequence
from pathlib import Path
from typing import Any

import numpy as np

from genmojo_core.store.npz import read_arrays, write_arrays


def main(arguments: Sequence[str]) -> int:
    """Track one window; 0 when the answer is written."""
    asked, answer, checkout, checkpoint, hub, memory = arguments
    import torch

    if not torch.cuda.is_available():  # a GPU's driver reserves address space that is no memory
        _limit_memory(float(memory))
    arrays = read_arrays(asked)
    video = torch.from_numpy(np.array(arrays["video"])).permute(0, 3, 1, 2)[None].float()  # (1, T, 3, H, W) 0..255
    queries = torch.from_numpy(np.array(arrays["queries"], np.float32))[None]  # (1, N, 3) t, x, y
    model = _from_hub(torch, hub) if hub else _from_checkout(checkout, checkpoint)
    if torch.cuda.is_available():
        model, video, queries = model.to("cuda"), video.to("cuda"), queries.to("cuda")
    with torch.no_grad():
        tracks, visibility = model(video, queries=queries, backward_tracking=True)
    write_arrays(answer, {"tracks": tracks[0].cpu().numpy(), "visibility": visibility[0].cpu().numpy() > 0.5})
    return 0


def _from_checkout(checkout: str, checkpoint: str) -> Any:
    """The predictor of a local checkout with the weights: of the kinds of model that its source can make, the one that
    the weights' name tells, else the first that takes them."""
    sys.path.insert(0, checkout)
    from cotracker.predictor import CoTrackerPredictor

    known = inspect.signature(CoTrackerPredictor.__init__).parameters
    kinds = _kinds(Path(checkpoint).stem.lower(), "v2" in known, "window_len" in known)
    for options in kinds[:-1]:
        try:
            return CoTrackerPredictor(checkpoint=checkpoint, **options)
        except RuntimeError as error:  # what torch raises for weights of another model
            sys.stderr.write(f"{options}: {error}\n")
    return CoTrackerPredictor(checkpoint=checkpoint, **kinds[-1])


def _kinds(weights: str, third: bool, windows: bool) -> list[dict[str, Any]]:
    """Options of the predictor for every kind of model, the likeliest first.

    CoTracker 3's source makes its own models, offline and online, and both of CoTracker 2's; CoTracker 2's source only
    those; CoTracker 1's takes a checkpoint and nothing else.
    """
    if not windows:
        return [{}]
    v1 = "v1" in weights or "wind_16" in weights
    second: list[dict[str, Any]] = [{"window_len": 16 if v1 else 8}, {"window_len": 8 if v1 else 16}]
    if not third:
        return second
    second = [{"v2": True} | options for options in second]
    own: list[dict[str, Any]] = [{"offline": True, "window_len": 60}, {"offline": False, "window_len": 16}]
    own = own[::-1] if "online" in weights else own
    return second + own if "cotracker2" in weights or "v2" in weights else own + second


def _from_hub(torch: Any, name: str) -> Any:
    """The model of that name by torch.hub; the parent starts this only after the user agreed."""
    return torch.hub.load("facebookresearch/co-tracker", name, trust_repo=True)


def _limit_memory(gib: float) -> None:
    """Bound the address space where the system can, so that a long clip ends this process and no other."""
    if gib <= 0 or not sys.platform.startswith("linux"):
        return
    import resource

    resource.setrlimit(resource.RLIMIT_AS, (int(gib * 2**30), int(gib * 2**30)))


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
