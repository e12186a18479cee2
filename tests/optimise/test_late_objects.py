"""Objects that are not there in frame 0, come late, leave and return: whole small runs from clip to tracks."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from genmojo_core.clip.synthetic import generate
from genmojo_core.clip.synthetic_specs import BALL, CUBE, SyntheticSpec, spec
from genmojo_core.estimate.complete import complete
from genmojo_core.measure.views import Look, render_frame
from genmojo_core.optimise.absences import out_of_view
from genmojo_core.optimise.motion import initial_motion
from genmojo_core.trackers.scene import track
from genmojo_core.tracks.model import OUT_OF_VIEW, VISIBLE
from tests.optimise.small_runs import small_run

AWAY, HERE = (4.2, -1.0, 0.5), (0.3, -1.0, 0.5)
PATHS = {"comes late": (AWAY, AWAY, HERE), "leaves and returns": (HERE, AWAY, HERE), "leaves": (HERE, AWAY, AWAY)}


@pytest.mark.parametrize("path", PATHS.values(), ids=PATHS)
def test_an_object_that_is_not_always_there(path):
    """The canonical frame shows it; where it is absent nothing of it is drawn; tracks say when it is out of view."""
    ball = replace(BALL, path=path, spin=30.0)
    cube = replace(CUBE, path=((-0.7, 0.6, 0.5),), spin=20.0)
    what = SyntheticSpec("late", (ball, cube), frames=10, size=(112, 63), novel_every=0)
    clip = complete(generate(what)[0])
    run = small_run(clip, lift_steps=10, joint_steps=20)
    for _ in run:
        pass
    scene = run.bake()
    area = clip.object_mask(0).sum(axis=(1, 2))
    row = next(i for i, o in enumerate(scene.objects) if o.id == 1)
    assert (area == 0).any() and area[scene.ref_frame[row]] >= 0.6 * area.max()
    for t in np.flatnonzero((area == 0) | (area > 0.9 * area.max())):
        picture = render_frame(scene, int(t), scene.cameras.view(int(t)), Look(objects_only=True))
        shown, mask = picture.instance() == row, clip.object_mask(0)[t]
        if area[t] == 0:
            assert shown.sum() <= 3, f"frame {t} shows what is not there"
        else:
            least = 0.6 if t == scene.ref_frame[row] else 0.35  # it moves by half its own width from frame to frame
            assert (shown & mask).sum() > least * (shown | mask).sum(), f"frame {t}"
    best = int(np.argmax(area))
    middle = np.argwhere(clip.object_mask(0)[best]).mean(axis=0)[::-1] + 0.5
    found = track(scene, np.array([best]), middle[None])
    assert found.object.tolist() == [1]
    assert (found.state[0][area == 0] == OUT_OF_VIEW).all()
    assert (found.state[0][area > 0.9 * area.max()] == VISIBLE).all()


def test_an_absent_object_that_something_hides_stays_where_it_is():
    """Only what would show is moved; what no border cut was hidden, or is gone, in its place."""
    clip = complete(generate(replace(spec("crossing-shapes"), frames=4, size=(112, 63), novel_every=0))[0])
    motions = initial_motion(clip)
    masks = clip.masks.value.copy()
    masks[2][masks[2] == 1] = 2
    hidden = clip.with_channels(masks=replace(clip.masks, value=masks))
    assert out_of_view(hidden, motions)[0] is motions[0]
    masks[2][masks[2] == 2] = 0
    gone = clip.with_channels(masks=replace(clip.masks, value=masks))
    assert out_of_view(gone, motions)[0] is motions[0], "no border cut it"
