"""Scenes of clips whose masks grew from boxes are scored on those masks."""

import shutil
from dataclasses import replace

import numpy as np

from genmojo_core.clip import synthetic, synthetic_files
from genmojo_core.clip.synthetic_specs import spec
from genmojo_core.estimate.complete import complete
from genmojo_core.measure.scoring import Scorer


def test_masks_that_lie_nowhere_are_those_of_the_completed_clip(tmp_path):
    made, truth = synthetic.generate(replace(spec("crossing-shapes"), frames=3, size=(112, 63)))
    synthetic_files.write(made, truth, tmp_path)
    completed = complete(made)
    given = Scorer(str(tmp_path)).measured()
    shutil.rmtree(tmp_path / "Annotations")
    assert Scorer(str(tmp_path)).measured().masks is None
    grown = Scorer(str(tmp_path), None, completed).measured()
    assert np.array_equal(grown.masks.value, given.masks.value)
    assert list(grown.object_ids) == list(given.object_ids)
