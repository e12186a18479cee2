"""What a run tells a view besides its Gaussians."""

from __future__ import annotations

import threading
from types import SimpleNamespace

import numpy as np

from genmojo_core.effects.decide import plan
from genmojo_core.measure import effect_costs
from genmojo_core.store import scene_hdf5
from genmojo_studio.worker import first_cloud, host, preparing
from genmojo_studio.worker.preparing import Directions
from genmojo_studio.worker.protocol import RunRequest
from tests.effects.test_effects import CONFIG, two_apart


def test_supervised_directions_come_once_each_and_in_order():
    """A map on show only ever gets more rows behind those it knows."""
    directions = Directions()
    own = [[0, 0, 0], [0, 0, 1]]
    np.testing.assert_array_equal(directions.rows(None, 2), own)
    prior = SimpleNamespace(seen=[(10.2, 90.0, 1), (9.9, 90.3, 0)])
    first = directions.rows(prior, 2)
    np.testing.assert_allclose(first, [*own, [10.2, 90.0, 1]], rtol=1e-6)
    prior.seen.append((-20.0, -45.0, 1))
    again = directions.rows(prior, 2)
    np.testing.assert_array_equal(again[:3], first)
    np.testing.assert_array_equal(again[3:], [[-20.0, -45.0, 1]])


def test_a_run_of_the_app_keeps_what_its_effects_cost(tmp_path, monkeypatch):
    """As the command line does: the table of effects shows it the next time."""
    measured, kept, done = plan(two_apart(), CONFIG).changed("flow", measured_ms=4.5), [], []
    run = SimpleNamespace(run=SimpleNamespace(plan=measured, scene=None, bake=lambda: "scene"))
    clip = two_apart()
    monkeypatch.setattr(first_cloud, "first_cloud", lambda request: None)
    monkeypatch.setattr(preparing, "load_and_compile", lambda *_: SimpleNamespace(join=lambda: None))
    monkeypatch.setattr(preparing, "prepare", lambda *_: (clip, plan(clip, CONFIG), CONFIG))
    monkeypatch.setattr(preparing, "build", lambda *_: run)
    monkeypatch.setattr(host, "drive", lambda _host, driven: done.append(driven))
    monkeypatch.setattr(scene_hdf5, "write", lambda scene, path: done.append(path))
    monkeypatch.setattr(effect_costs, "keep_run", lambda name, of: kept.append((name, of)))
    session = SimpleNamespace(enter=lambda *_: None, stop_asked=threading.Event(), keep=True, failure=None)
    job = SimpleNamespace(session=session, request=RunRequest("clip", str(tmp_path)), announce=lambda *_: None,
                          tell=lambda _: None, folder=tmp_path)  # fmt: skip
    host.Optimise().run(job)
    assert kept == [(clip.name, measured)] and done == [run, tmp_path / "scene.h5"]
