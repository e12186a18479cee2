"""The prior that a run's configuration names."""

from __future__ import annotations

from genmojo_core.errors import GenmojoError
from genmojo_core.priors.prior import ViewPrior


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
    raise GenmojoError("argument", f"there is no prior '{name}'", "--prior", "use embedded, none or zero123:DIR")
