"""The prior that a run's configuration names."""

from __future__ import annotations

from typing import TYPE_CHECKING

import torch

from genmojo_core.errors import GenmojoError
from genmojo_core.priors.prior import ViewPrior

if TYPE_CHECKING:
    from genmojo_core.priors.zero123 import Camera


def choose(name: str) -> ViewPrior | None:
    """The prior "embedded", "zero123:DIR" or "zeronvs:DIR"; None for "none".

    Raises GenmojoError: "argument" for another name, and as the weights' readers.
    """
    kind, _, folder = name.partition(":")
    if kind == "none":
        return None
    if kind == "embedded":
        from genmojo_core.priors import weights

        return weights.shipped()
    if kind in ("zero123", "zeronvs") and folder:
        from genmojo_core.priors import zero123_folder

        device = "cuda" if torch.cuda.is_available() else "cpu"
        camera: Camera | None = "zeronvs" if kind == "zeronvs" else None
        return zero123_folder.load(folder, camera, device, half=device == "cuda")
    raise GenmojoError("argument", f"there is no prior '{name}'", "--prior", "use embedded, none or zero123:DIR")
