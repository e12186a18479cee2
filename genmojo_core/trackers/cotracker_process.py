"""The child process in which CoTracker runs: arrays in, arrays out, checkpoints as weights only.

    python -m genmojo_core.trackers.cotracker_process asked.npz answer.npz CHECKOUT CHECKPOINT HUB_MODEL MEMORY_GIB \
        [shares.txt]

asked: video (T, H, W, 3) uint8, queries (N, 3) t, x, y in pixels counted from the centre of the first.
answer: tracks (T, N, 2), visibility (T, N). shares: gets a line with the share 0..1 that is done, again and again.
"""

from __future__ import annotations

import inspect
import sys
from collections.abc import Sequence
from pathlib import Path
from typing import Any

import numpy as np

from genmojo_core.store.npz import read_arrays, write_arrays

_UPDATES = 6  # of the tracks in a window, in every version of its predictor


def main(arguments: Sequence[str]) -> int:
    """Track one window; 0 when the answer is written."""
    asked, answer, checkout, checkpoint, hub, memory, *shares = arguments
    import torch

    if not torch.cuda.is_available():  # a GPU's driver reserves address space that is no memory
        _limit_memory(float(memory))
    arrays = read_arrays(asked)
    video = torch.from_numpy(np.array(arrays["video"])).permute(0, 3, 1, 2)[None].float()  # (1, T, 3, H, W) 0..255
    queries = torch.from_numpy(np.array(arrays["queries"], np.float32))[None]  # (1, N, 3) t, x, y
    model = _from_hub(torch, hub) if hub else _from_checkout(checkout, checkpoint)
    if torch.cuda.is_available():
        model, video, queries = model.to("cuda"), video.to("cuda"), queries.to("cuda")
    tell = Shares(Path(shares[0]) if shares else None)
    with torch.no_grad():
        if hasattr(model, "step"):
            tracks, visibility = _both_ways(model, video, queries, tell)
        else:
            tell.listen(model, video.shape[1])
            tracks, visibility = model(video, queries=queries, backward_tracking=True)
    write_arrays(answer, {"tracks": tracks[0].cpu().numpy(), "visibility": visibility[0].cpu().numpy() > 0.5})
    return 0


class Shares:
    """Tells how far a window is. Args: path: the file that gets a line for every step, None for nobody."""

    def __init__(self, path: Path | None) -> None:
        self._path, self._done, self._whole = path, 0, 1

    def expect(self, steps: int) -> None:
        """So many steps make the whole."""
        self._whole = max(steps, 1)

    def step(self, *_: object) -> None:
        """One more is done."""
        self._done += 1
        if self._path is not None:
            with open(self._path, "a", encoding="ascii") as file:
                file.write(f"{min(self._done / self._whole, 1.0):.4f}\n")

    def listen(self, predictor: Any, frames: int) -> None:
        """Count a predictor's steps: its updates, _UPDATES per window of its own, and its features, in time and back.

        Where its model has no such parts nothing is told.
        """
        model = getattr(predictor, "model", None)
        update, features = getattr(model, "updateformer", None), getattr(model, "fnet", None)
        if update is None or features is None:
            return
        half = max(int(getattr(model, "window_len", frames)) // 2, 1)
        slides = hasattr(model, "init_video_online_processing")
        windows = len(range(0, max(frames - half, 1), half)) if slides else 1
        self.expect(2 * (_UPDATES * windows + 1))
        update.register_forward_hook(self.step)
        features.register_forward_hook(self.step)


def _both_ways(model: Any, video: Any, queries: Any, tell: Shares) -> tuple[Any, Any]:
    """Tracks (1, T, N, 2) and visibility (1, T, N) of a predictor that is given the video bit by bit (the online ones):
    forwards from every query, and backwards through the video turned round."""
    last = video.shape[1] - 1
    tell.expect(2 * len(_bits(last + 1, model.step)))
    turned = queries.clone()
    turned[..., 0] = last - queries[..., 0]
    tracks, visibility = _in_bits(model, video, queries, tell)
    back = [part.flip(1) for part in _in_bits(model, video.flip(1), turned, tell)]
    times = queries[:, None, :, 0].long()  # (1, 1, N)
    frames = video.new_tensor(range(last + 1))[None, :, None]
    before, own = frames < times, frames == times
    tracks = back[0].where(before[..., None], tracks).where(~own[..., None], queries[:, None, :, 1:])
    return tracks, back[1].where(before, visibility) | own


def _in_bits(model: Any, video: Any, queries: Any, tell: Shares) -> tuple[Any, Any]:
    """One way through the video: bits of two steps that overlap by one."""
    model(video_chunk=video[:, : 2 * model.step], is_first_step=True, queries=queries)
    for start in _bits(video.shape[1], model.step):
        tracks, visibility = model(video_chunk=video[:, start : start + 2 * model.step])
        tell.step()
    return tracks, visibility


def _bits(frames: int, step: int) -> range:
    """First frames of the bits of a video."""
    return range(0, max(frames - step, 1), step)


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
    """The model of that name by torch.hub; the parent starts this only after the user agreed.

    Its entry points of version 2 make version 3 unless they are told (their default has changed).
    """
    version = {"version": "2"} if name in ("cotracker2", "cotracker2_online") else {}
    return torch.hub.load("facebookresearch/co-tracker", name, trust_repo=True, **version)


def _limit_memory(gib: float) -> None:
    """Bound the address space where the system can, so that a long clip ends this process and no other."""
    if gib <= 0 or not sys.platform.startswith("linux"):
        return
    import resource

    resource.setrlimit(resource.RLIMIT_AS, (int(gib * 2**30), int(gib * 2**30)))


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
