"""Checkpoints: safetensors for every tensor, JSON beside it; written atomically, never unpickled.

A run directory holds checkpoint.safetensors and checkpoint.json; the JSON names the tensors' sha256 and is replaced
last, so a crash leaves the previous pair or the new one.
"""

from __future__ import annotations

import hashlib
import json
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

import torch
from safetensors import SafetensorError, safe_open
from safetensors.torch import load as load_tensors
from safetensors.torch import save as save_tensors
from torch import Tensor

from genmojo_core.errors import GenmojoError
from genmojo_core.optimise.density import GradientStatistics
from genmojo_core.optimise.objective import Objective
from genmojo_core.optimise.regularise import Neighbours
from genmojo_core.scene.gaussians import Gaussians
from genmojo_core.scene.scene4d import Scene4D
from genmojo_core.store.atomic import write_bytes

FORMAT = 1


def save(
    folder: Path, scene: Scene4D, optimiser: torch.optim.Optimizer, meta: Mapping[str, Any],
    extra: Mapping[str, Tensor],
) -> Path:  # fmt: skip
    """Write the scene, the optimiser's moments, `extra` tensors and JSON-able `meta`; returns the JSON's path.

    Raises GenmojoError("io") when the folder cannot be written.
    """
    tensors = {f"scene/{name}": value.detach().contiguous() for name, value in scene.state_dict().items()}
    for name, parameter in scene.named_parameters():
        for key, value in optimiser.state.get(parameter, {}).items():
            if torch.is_tensor(value):
                tensors[f"optimiser/{name}/{key}"] = value.detach().contiguous()
    tensors.update({f"extra/{name}": value for name, value in extra.items()})
    data = save_tensors(_unshared(tensors))
    digest = hashlib.sha256(data).hexdigest()
    path = folder / f"checkpoint-{digest[:16]}.safetensors"
    if not path.exists():
        write_bytes(path, data)
    header = {
        "format": FORMAT, "tensors": path.name, "sha256": digest,
        "next_uid": [g.next_uid for g in _gaussians(scene)], "meta": dict(meta),
    }  # fmt: skip
    target = folder / "checkpoint.json"
    write_bytes(target, json.dumps(header, indent=1).encode())
    for old in folder.glob("checkpoint-*.safetensors"):
        if old != path:
            old.unlink(missing_ok=True)
    return target


def load(folder: Path, scene: Scene4D, optimiser: torch.optim.Optimizer) -> tuple[dict[str, Any], dict[str, Tensor]]:
    """Put a checkpoint's tensors into a freshly lifted scene and its optimiser; returns the saved `meta` and `extra`.

    Raises:
        GenmojoError: "io" when there is none, "corrupt" when the checksum does not match, "version" for a newer
            format, "schema" when it belongs to another clip or effect plan.
    """
    header, tensors = _read(folder)
    ours = {f"scene/{name}" for name in scene.state_dict()}
    theirs = {name for name in tensors if name.startswith("scene/")}
    if ours != theirs:
        names = ", ".join(sorted(n.removeprefix("scene/") for n in ours ^ theirs)[:3])
        raise GenmojoError("schema", f"the checkpoint is of another clip or effect plan (differs in {names})",
                           str(folder), "start without --resume or use the run folder of this clip")  # fmt: skip
    owners = dict(scene.named_modules())
    for name in sorted(theirs):
        path, _, leaf = name.removeprefix("scene/").rpartition(".")
        _put(owners[path], leaf, tensors[name], optimiser)
    for gaussians, uid in zip(_gaussians(scene), header["next_uid"], strict=True):
        gaussians.next_uid = int(uid)
    by_name = dict(scene.named_parameters())
    for name, value in tensors.items():
        if name.startswith("optimiser/"):
            parameter, key = name.removeprefix("optimiser/").rsplit("/", 1)
            optimiser.state[by_name[parameter]][key] = value
    extra = {name.removeprefix("extra/"): value for name, value in tensors.items() if name.startswith("extra/")}
    return dict(header["meta"]), extra


def peek(folder: Path) -> dict[str, Any]:
    """The saved `meta` alone. Raises as `load`."""
    return dict(_header(folder)["meta"])


def holds(folder: Path, name: str) -> bool:
    """True if the checkpoint has the scene's parameter of that name; reads no tensors. Raises as `load`."""
    try:
        with safe_open(_tensors(folder, _header(folder)), "pt") as tensors:
            return f"scene/{name}" in tensors.keys()  # noqa: SIM118 - it is no mapping
    except OSError as error:
        raise _missing(folder) from error
    except SafetensorError as error:
        raise GenmojoError("corrupt", "the checkpoint's tensors cannot be read", str(folder),
                           "start without --resume") from error  # fmt: skip


def exists(folder: Path) -> bool:
    """True if the run folder holds a checkpoint."""
    return (folder / "checkpoint.json").is_file()


def _read(folder: Path) -> tuple[dict[str, Any], dict[str, Tensor]]:
    """The JSON and the verified tensors."""
    header = _header(folder)
    try:
        data = _tensors(folder, header).read_bytes()
    except OSError as error:
        raise _missing(folder) from error
    if hashlib.sha256(data).hexdigest() != header["sha256"]:
        raise GenmojoError("corrupt", "the checkpoint's tensors do not match their checksum", str(folder),
                           "start without --resume")  # fmt: skip
    return header, load_tensors(data)


def _header(folder: Path) -> dict[str, Any]:
    """The JSON, of a format that we know."""
    path = folder / "checkpoint.json"
    try:
        header = dict(json.loads(path.read_bytes()))
        if header["format"] > FORMAT:
            raise GenmojoError("version", f"checkpoint format {header['format']} is newer than {FORMAT}", str(path),
                               "update GenMOJO Studio")  # fmt: skip
        _tensors(folder, header)
    except OSError as error:
        raise _missing(folder) from error
    except (ValueError, KeyError, TypeError) as error:
        raise GenmojoError("corrupt", "the checkpoint's JSON cannot be read", str(path),
                           "start without --resume") from error  # fmt: skip
    return header


def _tensors(folder: Path, header: Mapping[str, Any]) -> Path:
    """The tensors' file."""
    return folder / Path(header["tensors"]).name


def _missing(folder: Path) -> GenmojoError:
    return GenmojoError("io", "there is no checkpoint to resume from", str(folder), "start without --resume")


def _put(owner: torch.nn.Module, leaf: str, value: Tensor, optimiser: torch.optim.Optimizer) -> None:
    """Set a parameter or buffer to a value, which may have another number of rows."""
    current = getattr(owner, leaf, None)
    if isinstance(owner, torch.nn.ParameterList):
        current = owner[int(leaf)]
    if isinstance(current, torch.nn.Parameter):
        with torch.no_grad():
            if current.shape == value.shape:
                current.copy_(value)
                return
        fresh = torch.nn.Parameter(value.clone(), requires_grad=current.requires_grad)
        for group in optimiser.param_groups:
            group["params"] = [fresh if p is current else p for p in group["params"]]
        setattr(owner, leaf, fresh)
    else:
        setattr(owner, leaf, value.clone())


def _gaussians(scene: Scene4D) -> list[Gaussians]:
    return [m for m in scene.modules() if isinstance(m, Gaussians)]


def _unshared(tensors: dict[str, Tensor]) -> dict[str, Tensor]:
    """safetensors refuses tensors that share memory; those are copied."""
    seen: set[int] = set()
    result = {}
    for name, value in tensors.items():
        pointer = value.untyped_storage().data_ptr()
        result[name] = value.clone() if pointer in seen else value
        seen.add(pointer)
    return result


Statistics = Sequence[tuple[Gaussians, GradientStatistics]]


def working_state(statistics: Statistics, objective: Objective) -> dict[str, Tensor]:
    """What the loop carries from step to step besides the scene and the optimiser."""
    state = {}
    for i, (_, one) in enumerate(statistics):
        state[f"total.{i}"], state[f"seen.{i}"] = one.total, one.seen
    for i, near in enumerate(objective.neighbours):
        if near is not None:
            state[f"index.{i}"], state[f"weight.{i}"] = near.index, near.weight
    return state


def restore_working_state(statistics: Statistics, objective: Objective, state: Mapping[str, Tensor]) -> None:
    """The inverse of `working_state`."""
    for i, (_, one) in enumerate(statistics):
        one.total, one.seen = state[f"total.{i}"], state[f"seen.{i}"]
    objective.neighbours = [
        None if near is None else Neighbours(state[f"index.{i}"], state[f"weight.{i}"])
        for i, near in enumerate(objective.neighbours)
    ]
