"""The embedded prior out of its generator: crops of a clip's frames against true views of the same moment.

    python -m tests.benchmarks.prior_crops ../shared/data/blender-cross [--frames 0,12] [--weights FILE] [--sheet P.png]

Every object's volume, predicted from its crop of one frame, is drawn by the cameras of the truth and put together by
depth; beside it the hand-made inflation of the same crop (the best of its thicknesses) and the flat mean colour over
the true silhouette. PSNR on grey inside the union of both silhouettes, and the IoU of the silhouettes of all objects
together. An object that hides too much to be a reference is missing in all of them. Prints JSON.
"""

from __future__ import annotations

import argparse
import json
from collections.abc import Callable
from pathlib import Path

import cv2
import numpy as np
import torch

from genmojo_core.clip.cameras import View
from genmojo_core.clip.folders import read
from genmojo_core.estimate.complete import complete
from genmojo_core.priors import weights
from genmojo_core.priors.embedded import channels_of
from genmojo_core.priors.held_out import THICKNESSES, inflated_volume
from genmojo_core.priors.references import LEAST_VISIBLE, PlacedReference, reference_of
from genmojo_core.priors.solids import HALF_EXTENT
from genmojo_core.priors.tasks import scores
from genmojo_core.priors.volume import picture_rays, render

SIDE = 96  # pixels of the pictures of single volumes
Volumes = list[tuple[torch.Tensor, PlacedReference]]


def main() -> None:
    """One JSON object: figures by predictor."""
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("clip", type=Path)
    parser.add_argument("--frames", default="0,12")
    parser.add_argument("--weights", type=Path, default=weights.SHIPPED)
    parser.add_argument("--sheet", type=Path, help="picture of truth, prior and inflation")
    args = parser.parse_args()
    torch.set_num_threads(1)
    clip = complete(read(args.clip))
    truth = dict(np.load(args.clip / "truth.npz"))
    prior = weights.read(args.weights)
    predict: dict[str, Callable[[PlacedReference], torch.Tensor]] = {
        "prior": lambda placed: prior.encode(placed.reference).volume,
        **{f"inflated {k}": lambda placed, k=k: inflated_volume(channels_of(placed.reference), k) for k in THICKNESSES},
    }
    pictures: dict[str, list[np.ndarray]] = {name: [] for name in ("truth", "flat", *predict)}
    for t in (int(part) for part in args.frames.split(",")):
        found = [reference_of(clip, (k,), t) for k in range(clip.objects)]
        usable = [one for one in found if not isinstance(one, str) and one.visible >= LEAST_VISIBLE]
        volumes = {name: [(of(one), one) for one in usable] for name, of in predict.items()}
        for a, (elevation, azimuth) in enumerate(truth["novel_angles"].tolist()):
            view = clip.cameras.value.view(t).with_pose(truth["novel_world_to_camera"][a, t].astype(float))
            wanted = true_picture(args.clip / "novel" / f"{elevation:g}_{azimuth:g}" / f"{t:05d}.png")
            pictures["truth"].append(wanted)
            pictures["flat"].append(wanted[3] * np.append(wanted[:3].sum((1, 2)) / wanted[3].sum(), 1.0)[:, None, None])
            for name, placed in volumes.items():
                pictures[name].append(together(placed, view))
    figures = {name: figures_of(pictures[name], pictures["truth"]) for name in pictures if name != "truth"}
    thickness = max(THICKNESSES, key=lambda k: figures[f"inflated {k}"]["inside"])
    if args.sheet is not None:
        rows = [np.concatenate(pictures[n], axis=2) for n in ("truth", "prior", f"inflated {thickness}")]
        sheet = np.moveaxis(np.concatenate(rows, axis=1), 0, -1)
        on_grey = sheet[..., :3] + 0.5 * (1 - sheet[..., 3:])
        cv2.imwrite(str(args.sheet), np.round(on_grey[..., ::-1] * 255).clip(0, 255).astype(np.uint8))
    print(json.dumps({**figures, "inflated": figures[f"inflated {thickness}"], "thickness": thickness}))


def figures_of(ours: list[np.ndarray], truth: list[np.ndarray]) -> dict[str, float]:
    """psnr on grey, inside the union, silhouettes' iou: means over pictures (4, H, W), premultiplied."""
    return scores(torch.from_numpy(np.stack(ours))[None].float(), torch.from_numpy(np.stack(truth))[None].float())


def true_picture(path: Path) -> np.ndarray:  # (4, H, W) premultiplied
    """A render with straight alpha."""
    rgba = cv2.cvtColor(cv2.imread(str(path), cv2.IMREAD_UNCHANGED), cv2.COLOR_BGRA2RGBA).astype(np.float32) / 255
    rgba[..., :3] *= rgba[..., 3:]
    return np.moveaxis(rgba, -1, 0)


def together(volumes: Volumes, view: View) -> np.ndarray:  # (4, H, W) premultiplied
    """All volumes from one camera, nearer ones over farther ones at every pixel."""
    layers = np.stack([drawn(volume, placed, view) for volume, placed in volumes])
    order = np.argsort(layers[:, 4], axis=0)  # nearest first
    passed = np.ones((1, *layers.shape[2:]), np.float32)
    picture = np.zeros((4, *layers.shape[2:]), np.float32)
    for place in order:
        layer = np.take_along_axis(layers, place[None, None], axis=0)[0]
        picture += passed * layer[:4]
        passed = passed * (1 - layer[3:4])
    return picture.clip(0, 1)


def drawn(volume: torch.Tensor, placed: PlacedReference, view: View) -> np.ndarray:  # (5, H, W)
    """One volume through a camera of the world: premultiplied RGBA and depth in world units (far where nothing)."""
    pose = view.world_to_camera @ placed.to_world  # from the prior's space
    scale = np.linalg.norm(pose[:3, 0])
    centre = pose[:3, 3] / scale  # of the volume, in the camera, the prior's units
    turn = facing(centre)
    own = np.eye(4)
    own[:3, :3], own[:3, 3] = turn @ pose[:3, :3] / scale, turn @ centre
    distance = float(np.linalg.norm(centre))
    to_space = torch.tensor(np.linalg.inv(own), dtype=torch.float32)[None, None]
    rays = picture_rays(to_space, torch.tensor([placed.reference.distance]), SIDE)
    rays = type(rays)(rays.to_space, rays.distance, rays.xy, torch.tensor([[distance]]))
    with torch.no_grad():
        square = render(volume, rays, samples=48)[0, 0].numpy().reshape(SIDE, SIDE, 5)
    x = (np.arange(view.width) + 0.5 - view.cx) / view.fx
    y = (np.arange(view.height) + 0.5 - view.cy) / view.fy
    local = np.stack(np.broadcast_arrays(x[None], y[:, None], 1.0), axis=-1) @ turn.T
    slope = np.where(local[..., 2:] > 1e-3, local[..., :2] / np.maximum(local[..., 2:], 1e-3), 1e3)
    place = ((slope * distance / HALF_EXTENT + 1) / 2 * SIDE - 0.5).clip(-100, SIDE + 100).astype(np.float32)
    picture = cv2.remap(square, place[..., 0], place[..., 1], cv2.INTER_LINEAR)
    depth = np.where(picture[..., 3] > 0.02, (picture[..., 4] / picture[..., 3].clip(1e-3) + distance) * scale, 1e9)
    return np.moveaxis(np.concatenate([picture[..., :4], depth[..., None]], axis=-1), -1, 0)


def facing(direction: np.ndarray) -> np.ndarray:  # (3,) -> (3, 3)
    """A rotation that takes a direction to the z axis, with the y axis as upright as before."""
    z = direction / np.linalg.norm(direction)
    x = np.cross([0.0, 1.0, 0.0], z)
    x /= np.linalg.norm(x)
    return np.stack([x, np.cross(z, x), z])


if __name__ == "__main__":
    main()
