"""The kernels of one pass over a picture, there and back, each of several stages.

What a kernel does is in bins.py and forward.py, and in upstream.py, backward.py and project_backward.py. They return
how many stages are behind the calling thread (kernels/stage.py), and leave out the first `done`.
"""

from __future__ import annotations

import numpy as np

from genmojo_core.kernels.cache import kernel
from genmojo_core.kernels.stage import Stage
from genmojo_core.render.cpu.backward import Slopes, slope_tiles
from genmojo_core.render.cpu.bins import Bins, Pieces, Records, Sorting, scatter_and_gather, sort_and_count
from genmojo_core.render.cpu.forward import Drawing, draw_tiles
from genmojo_core.render.cpu.project import Ellipses
from genmojo_core.render.cpu.project_backward import Gradients, Sums, gather_gradients
from genmojo_core.render.cpu.upstream import Planes, Upstream, spread_upstream

Stages = tuple[Stage, Stage, Stage]


@kernel
def bin_and_draw(
    stages: Stages, done: int, binning: tuple[Bins, Sorting, Pieces], source: tuple[Ellipses, Records],
    drawing: Drawing, scratch: tuple[np.ndarray, np.ndarray],
) -> int:  # fmt: skip
    """Sort, hand the splats out to the tiles, draw these. scratch: as of `draw_tiles`."""
    bins, sorting, pieces = binning
    ellipses, records = source
    if done < 1 and sort_and_count(stages[0], ellipses.box, bins, sorting) == 0:
        return 1
    if done < 2 and scatter_and_gather(stages[1], pieces, bins, sorting.following, ellipses, records) == 0:
        return 2
    draw_tiles(stages[2], drawing, bins, scratch[0], scratch[1])
    return 3


@kernel
def find_gradients(
    stages: Stages, done: int, upstream: tuple[Upstream, Planes, np.ndarray], tiles: tuple[Drawing, Bins, Slopes],
    splats: tuple[tuple, Sums, Gradients], scratch: tuple[np.ndarray, np.ndarray],
) -> int:  # fmt: skip
    """Spread the upstream gradients, go through the tiles, add up each splat's. scratch: of the last two stages."""
    drawing, bins, slopes = tiles
    if done < 1 and spread_upstream(stages[0], upstream[0], upstream[1], upstream[2]) == 0:
        return 1
    if done < 2 and slope_tiles(stages[1], drawing, bins, slopes, scratch[0]) == 0:
        return 2
    gather_gradients(stages[2], bins, splats[0], splats[1], splats[2], scratch[1])
    return 3
