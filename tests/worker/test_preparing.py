"""What a run tells a view besides its Gaussians."""

from __future__ import annotations

from types import SimpleNamespace

import numpy as np

from genmojo_studio.worker.preparing import Directions


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
