"""Track error of the first motion and of optical chains on the Blender clips, before any Gaussian exists.

    python tests/benchmarks/motion.py [--short-side 256] [clips folder]

ATE / MTE / hidden ATE in 256 x 256 units, queries visible in frame 0, all frames; with measured depth and cameras and
with both ignored; error of the objects' rotation in degrees where the truth tells it; process CPU seconds.
"""

from __future__ import annotations

import argparse
import time
from collections.abc import Callable
from pathlib import Path

import cv2
import numpy as np

from genmojo_core.clip.clip import Clip
from genmojo_core.clip.folders import read
from genmojo_core.estimate.complete import complete
from genmojo_core.optimise.motion import ObjectMotion, carry, initial_motion
from genmojo_core.trackers.optical import track_points

CLIPS = Path(__file__).resolve().parents[3] / "shared" / "data"
Predict = Callable[[np.ndarray, np.ndarray, np.ndarray], np.ndarray]


def main() -> None:
    """Print one line per clip and method."""
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("--short-side", type=int, default=256)
    parser.add_argument("clips", type=Path, nargs="?", default=CLIPS)
    arguments = parser.parse_args()
    cv2.setNumThreads(1)
    print("clip | method | ATE | MTE | hidden | rotation | CPU s")
    for name in ("blender-cross", "blender-trio"):
        truth = dict(np.load(arguments.clips / name / "truth.npz"))
        for ignore in ((), ("depth", "cameras")):
            clip = complete(read(arguments.clips / name, short_side=arguments.short_side, ignore=ignore))
            given = "ignored" if ignore else "given"
            began = time.process_time()
            motions = initial_motion(clip)
            spent = time.process_time() - began
            line = scores(clip, truth, lambda t, xy, k, m=motions, c=clip: carry(m, c, t, xy, k))
            turned = f"{rotation_error(truth, motions):.2f}" if not ignore else "-"
            print(f"{name} | motion, depth {given} | {line} | {turned} | {spent:.1f}", flush=True)
        began = time.process_time()
        line = scores(clip, truth, lambda t, xy, k, c=clip: track_points(c, t, xy, k)[0])
        print(f"{name} | optical chains | {line} | - | {time.process_time() - began:.1f}", flush=True)


def scores(clip: Clip, truth: dict[str, np.ndarray], predict: Predict) -> str:
    """ATE | MTE | hidden ATE of predicted tracks."""
    source, held = np.array(clip.source_size), np.array(clip.size)
    queries = truth["tracks"][:, 0] * (held / source)
    xy = predict(np.zeros(len(queries), int), queries, truth["track_object"] - 1)
    error = np.linalg.norm(xy * (256 / held) - truth["tracks"] * (256 / source), axis=-1)
    return f"{error.mean():.2f} | {np.median(error, axis=1).mean():.2f} | {error[~truth['visible']].mean():.2f}"


def rotation_error(truth: dict[str, np.ndarray], motions: list[ObjectMotion]) -> float:
    """Mean degrees between the poses' turn since frame 0 and that of the true points (best rigid fit)."""
    errors = []
    for k, motion in enumerate(motions):
        points = truth["track_xyz"][truth["track_object"] == k + 1].astype(np.float64)
        points -= points.mean(axis=0)
        for t in range(len(motion.pose)):
            u, _, vt = np.linalg.svd(points[:, 0].T @ points[:, t])
            true = vt.T @ np.diag([1, 1, np.sign(np.linalg.det(vt.T @ u.T))]) @ u.T
            ours = motion.pose[t, :3, :3] @ motion.pose[0, :3, :3].T
            errors.append(np.degrees(np.arccos(np.clip((np.trace(ours @ true.T) - 1) / 2, -1, 1))))
    return float(np.mean(errors))


if __name__ == "__main__":
    main()
