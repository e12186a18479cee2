"""Loading Zero123-like models from a local folder: every component on its own, every fault in one sentence."""

from __future__ import annotations

import importlib
import json
import shutil
import subprocess
import sys
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Any

import torch
from safetensors import SafetensorError
from safetensors.torch import load_file

from genmojo_core.errors import GenmojoError
from genmojo_core.priors.zero123 import Camera, Networks, Zero123Prior

PARTS = {"unet": ("diffusers", "UNet2DConditionModel"), "vae": ("diffusers", "AutoencoderKL"),
         "image_encoder": ("transformers", "CLIPVisionModelWithProjection")}  # fmt: skip
PROJECTIONS = {"clip_camera_projection": "proj", "cc_projection": "projection"}  # folder: name of its Linear
_FAULTS = (OSError, ValueError, KeyError, RuntimeError, ImportError, TypeError, SafetensorError)
_ZERONVS_NUMBERS = 19


def load(
    folder: str | Path, camera: Camera | None = None, device: str = "cpu", half: bool = False, scale: float = 5.0
) -> Zero123Prior:
    """The prior of a folder.

    Args:
        camera: what its projection is told; None: 19 numbers mean ZeroNVS, a model_index.json that says "stable" means
            Stable-Zero123, anything else Zero123. half: UNet in float16; VAE and image encoder stay float32.
        scale: classifier-free guidance.

    Weights are safetensors, or else torch's `.bin`, which a process of its own turns into safetensors.

    Raises GenmojoError: "missing_package" for a missing library or component, "format" for a component without weights,
    "unsafe_pickle" for a `.bin` that holds more than tensors, "schema" for a projection of another size.
    """
    folder = Path(folder)
    if not folder.is_dir():
        raise GenmojoError("missing_package", "is no folder", str(folder), "give a model in diffusers' layout")
    if not any((folder / name).is_dir() for name in PARTS) and list(folder.glob("*.ckpt")):
        raise GenmojoError("format", "holds an original checkpoint", str(folder),
                           "convert it first with the script for Zero123 in diffusers/scripts")  # fmt: skip
    parts = {name: _component(folder / name, *PARTS[name]).to(device).eval().requires_grad_(False) for name in PARTS}
    if half:
        parts["unet"] = parts["unet"].half()
    projection = _projection(folder).to(device).requires_grad_(False)
    numbers = projection.in_features - int(parts["image_encoder"].config.projection_dim)
    camera = camera or _guess_camera(folder, numbers)
    if numbers != (_ZERONVS_NUMBERS if camera == "zeronvs" else 4):
        raise GenmojoError("schema", f"is told {numbers} numbers of a camera, {camera} gives another count",
                           str(folder), "name the kind of model it is")  # fmt: skip
    return Zero123Prior(Networks(**parts, projection=projection, alphas=alphas_of(folder), camera=camera), scale)


def alphas_of(folder: Path) -> torch.Tensor:
    """(1000,) cumulative alphas of the folder's schedule: square roots of betas on a line from .00085 to .012, squared.

    Raises GenmojoError("format") for a schedule of another kind.
    """
    about = _json(folder / "scheduler" / "scheduler_config.json")
    kind, target = about.get("beta_schedule", "scaled_linear"), about.get("prediction_type", "epsilon")
    if kind != "scaled_linear" or target != "epsilon":
        raise GenmojoError("format", f"has a schedule '{kind}' predicting '{target}'", str(folder / "scheduler"),
                           "use a model with scaled_linear betas that predicts epsilon")  # fmt: skip
    first, last = float(about.get("beta_start", 0.00085)), float(about.get("beta_end", 0.012))
    steps = int(about.get("num_train_timesteps", 1000))
    betas = torch.linspace(first**0.5, last**0.5, steps, dtype=torch.float64) ** 2
    return torch.cumprod(1.0 - betas, dim=0)


def _component(folder: Path, library: str, name: str) -> Any:
    """One frozen network of a folder."""
    if not (folder / "config.json").is_file():
        raise GenmojoError("missing_package", "is missing or holds no config.json", str(folder),
                           "give a complete model in diffusers' layout")  # fmt: skip
    try:
        loader = getattr(importlib.import_module(library), name)
    except (ImportError, AttributeError) as error:
        raise GenmojoError("missing_package", f"the package {library} is not installed", "--prior",
                           "install genmojo-studio[zero123]") from error  # fmt: skip
    try:
        with _safe_folder(folder) as safe:
            return loader.from_pretrained(str(safe), local_files_only=True, use_safetensors=True)
    except _FAULTS as error:
        reason = str(error).splitlines()[0][:120]
        raise GenmojoError("missing_package", f"cannot be loaded as {name} ({reason})", str(folder),
                           "give a complete model in diffusers' layout") from error  # fmt: skip


def _projection(folder: Path) -> torch.nn.Linear:
    """The Linear from embedding and camera to a token, under either of its two names."""
    for name, key in PROJECTIONS.items():
        if not (folder / name).is_dir():
            continue
        try:
            with _safe_folder(folder / name) as safe:
                file = sorted(safe.glob("*.safetensors"))[0]
                tensors = load_file(file)
            weight, bias = tensors[f"{key}.weight"].float(), tensors[f"{key}.bias"].float()
        except (SafetensorError, KeyError, OSError) as error:
            raise GenmojoError("format", f"holds no Linear '{key}'", str(file)) from error
        linear = torch.nn.Linear(weight.shape[1], weight.shape[0])
        linear.weight.data.copy_(weight)
        linear.bias.data.copy_(bias)
        return linear
    raise GenmojoError("missing_package", f"has neither {' nor '.join(PROJECTIONS)}", str(folder),
                       "give a complete model in diffusers' layout")  # fmt: skip


@contextmanager
def _safe_folder(folder: Path) -> Iterator[Path]:
    """The folder if it holds safetensors, else a temporary one with its `.bin` as safetensors and its config.

    Raises GenmojoError: "format" without weights or with several `.bin`, "unsafe_pickle" for more than tensors.
    """
    if list(folder.glob("*.safetensors")):
        yield folder
        return
    files = list(folder.glob("*.bin"))
    if len(files) != 1:
        raise GenmojoError("format", f"holds no safetensors and {len(files)} bin files", str(folder),
                           "save the model as safetensors")  # fmt: skip
    with TemporaryDirectory() as made:
        if (folder / "config.json").is_file():
            shutil.copy(folder / "config.json", made)
        target = Path(made) / f"{files[0].stem.removeprefix('pytorch_')}.safetensors"
        command = [sys.executable, "-m", "genmojo_core.priors.bin_weights_process", str(files[0]), str(target)]
        done = subprocess.run(command, capture_output=True, check=False)
        if done.returncode:
            words = done.stderr.decode(errors="replace").strip().splitlines() or ["cannot be read"]
            raise GenmojoError("unsafe_pickle" if done.returncode == 3 else "format", words[-1][:200], str(files[0]),
                               "get the model as safetensors")  # fmt: skip
        yield Path(made)


def _guess_camera(folder: Path, numbers: int) -> Camera:
    """Which kind of model a folder holds."""
    if numbers == _ZERONVS_NUMBERS:
        return "zeronvs"
    said = f"{folder.name} {json.dumps(_json(folder / 'model_index.json'))}"
    return "stable" if "stable" in said.lower().replace("stablediffusion", "") else "zero123"


def _json(path: Path) -> dict[str, Any]:
    """A file's data; empty where there is none or it is damaged."""
    try:
        data = json.loads(path.read_text("utf-8"))
    except (OSError, ValueError):
        return {}
    return data if isinstance(data, dict) else {}
