"""The calibration of a machine: a few optimiser steps on a clip made on the spot (effects/machine.py keeps it)."""

from __future__ import annotations

import json
from dataclasses import asdict, replace

import numpy as np

from genmojo_core.clip import synthetic
from genmojo_core.clip.synthetic_specs import spec
from genmojo_core.config import preset
from genmojo_core.effects import decide, machine
from genmojo_core.effects.forecast import REFERENCE_STEP_MS
from genmojo_core.effects.machine import Machine, contention
from genmojo_core.errors import GenmojoError
from genmojo_core.estimate.complete import complete
from genmojo_core.optimise.run import Run
from genmojo_core.store.atomic import write_bytes

_WARM, _STEPS = 3, 10
_BUSY = 1.5  # wall seconds per CPU second from which the machine is too busy for a figure worth keeping


def calibrated() -> Machine:
    """This machine's calibration: the stored one, else measured now (a few seconds), and stored if it is not busy."""
    known = machine.load()
    if known is not None:
        return known
    measured = measure()
    if measured.contention < _BUSY:
        keep(measured)
    return measured


def keep(calibration: Machine) -> bool:
    """Store it for later runs; False where the user's cache folder cannot be written, which is no fault."""
    try:
        write_bytes(machine.machine_file(), json.dumps(asdict(calibration)).encode())
    except GenmojoError:
        return False
    return True


def measure() -> Machine:
    """Speed against the reference machine from the median CPU time of joint steps, and wall seconds per CPU second."""
    wall, cpu = np.array(reference_steps()).T
    return Machine(
        speed=REFERENCE_STEP_MS / (1000 * float(np.median(cpu))),
        wall_per_cpu=float(wall.sum() / cpu.sum()), contention=contention(),
    )  # fmt: skip


def reference_steps() -> list[tuple[float, float]]:
    """(wall, CPU) seconds of the steps that machines are compared by; the first ones, which warm up, are left out."""
    made, _ = synthetic.generate(replace(spec("crossing-shapes"), frames=6, size=(224, 126)))
    config = preset("draft", short_side=126, gaussians_per_object=1000, background_gaussians=4000)
    clip = complete(made)
    run = Run(clip, decide.plan(clip, config, {"camera_motion": True}), config)  # whole frames in every step
    return run.timed_steps(_WARM + _STEPS)[_WARM:]
