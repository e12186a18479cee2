"""The embedded prior's file: half-precision tensors with a description, checked before they are used."""

from __future__ import annotations

import hashlib
import json
from collections.abc import Mapping
from dataclasses import asdict
from functools import lru_cache
from pathlib import Path
from typing import Any

import torch
from safetensors import SafetensorError
from safetensors.torch import load as load_tensors
from safetensors.torch import save as save_tensors
from torch import Tensor, nn

from genmojo_core.errors import GenmojoError
from genmojo_core.priors.denoiser import Denoiser, DenoiserShape
from genmojo_core.priors.embedded import EmbeddedPrior
from genmojo_core.priors.training import read_metadata
from genmojo_core.priors.volume import VolumeNet, VolumeShape
from genmojo_core.store.atomic import write_bytes

FORMAT = "1"
SHIPPED = Path(__file__).resolve().parents[2] / "resources" / "prior.safetensors"
MAX_BYTES = 64 << 20


def write(path: Path, prior: EmbeddedPrior, description: Mapping[str, Any]) -> None:
    """Write both networks in half precision with their architecture, `description` and the tensors' sha256."""
    tensors = {name: value.detach().cpu().half().contiguous() for name, value in _named(prior).items()}
    header = {
        "format": FORMAT, "volume": json.dumps(asdict(prior.volume.shape)),
        "denoiser": json.dumps(asdict(prior.denoiser.shape)), "sha256": digest(tensors),
        "agreement": repr(prior.agreement),
        "description": json.dumps(dict(description)),
    }  # fmt: skip
    write_bytes(path, save_tensors(tensors, metadata=header))


def read(path: Path) -> EmbeddedPrior:
    """The prior of a file.

    Raises GenmojoError: "io" missing, "corrupt" no such file or damaged, "version" newer format, "schema" tensors that
    do not fit the architecture it names.
    """
    if not path.is_file():
        raise GenmojoError(
            "io", "does not exist", str(path), "train one with `genmojo train-prior` or use --prior none"
        )
    if path.stat().st_size > MAX_BYTES:
        raise GenmojoError("size", f"is larger than {MAX_BYTES >> 20} MiB", str(path))
    header = read_metadata(path)
    if header.get("format") != FORMAT:
        raise GenmojoError("version", f"has format {header.get('format')}, this program reads {FORMAT}", str(path))
    try:
        tensors = load_tensors(path.read_bytes())
        shapes = VolumeShape(**json.loads(header["volume"])), DenoiserShape(**json.loads(header["denoiser"]))
        agreement = float(header.get("agreement", "1"))
    except (SafetensorError, ValueError, KeyError, TypeError) as error:
        raise GenmojoError("corrupt", "is damaged", str(path), "get the file again") from error
    if digest(tensors) != header.get("sha256"):
        raise GenmojoError("corrupt", "does not match its checksum", str(path), "get the file again")
    with torch.random.fork_rng(devices=[]):  # first weights are drawn and thrown away; nobody's numbers change by it
        prior = EmbeddedPrior(VolumeNet(shapes[0]), Denoiser(shapes[1]), agreement)
    wanted = _named(prior)
    if {n: v.shape for n, v in wanted.items()} != {n: v.shape for n, v in tensors.items()}:
        raise GenmojoError("schema", "holds tensors that its architecture has not", str(path), "get the file again")
    with torch.no_grad():
        for name, value in wanted.items():
            value.copy_(tensors[name].float())
    return prior


@lru_cache(maxsize=1)
def shipped() -> EmbeddedPrior:
    """The prior that comes with the project. Raises as `read`."""
    return read(SHIPPED)


def describe(path: Path = SHIPPED) -> dict[str, Any]:
    """What a file says about itself."""
    return dict(json.loads(read_metadata(path).get("description", "{}")))


def digest(tensors: Mapping[str, Tensor]) -> str:
    """sha256 over names and bytes, in order of the names."""
    total = hashlib.sha256()
    for name in sorted(tensors):
        total.update(name.encode() + b"\0" + tensors[name].contiguous().numpy().tobytes())
    return total.hexdigest()


def _named(prior: EmbeddedPrior) -> dict[str, Tensor]:
    """All parameters by name; buffers are constants and not stored."""
    parts: dict[str, nn.Module] = {"volume": prior.volume, "denoiser": prior.denoiser}
    return {f"{part}.{name}": p for part, net in parts.items() for name, p in net.named_parameters()}
