"""Seams for external models: fakes, empty folders, depth files; no network is loaded."""

import numpy as np
import pytest
from estimate_pictures import clip_of, squares

from genmojo_core.errors import GenmojoError
from genmojo_core.estimate.complete import complete
from genmojo_core.estimate.models import DepthFile, Detection, Models
from genmojo_core.estimate.network_masks import SegmentAnything
from genmojo_core.estimate.network_text import TextDetector, _without_doubles, overlap


def test_names_become_boxes_become_masks():
    frames, labels, _ = squares(count=3)

    class Finds:
        name = "a fake detector"

        def find(self, frame, phrases):
            return [Detection(phrases[0], (2, 34, 30, 62), 0.9)]

    class Cuts:
        name = "a fake cutter"

        def segment(self, frame, box):
            mask = np.zeros(frame.shape[:2], bool)
            mask[int(box[1]) + 2 : int(box[3]) - 2, int(box[0]) + 2 : int(box[2]) - 2] = True
            return mask

    done = complete(clip_of(frames), models=Models(detector=Finds(), masks=Cuts(), phrases=("square",)))
    assert done.objects == 1 and "a fake detector" in done.masks.source and "a fake cutter" in done.masks.source
    assert ((done.masks.value[0] == 1) == (labels[0] == 1)).mean() > 0.97


def test_doubles_are_dropped():
    found = [
        Detection("a", (0, 0, 10, 10), 0.9),
        Detection("b", (1, 0, 10, 10), 0.5),
        Detection("a", (20, 0, 30, 9), 0.4),
    ]
    assert [d.score for d in _without_doubles(found)] == [0.9, 0.4]
    assert overlap((0, 0, 2, 2), (1, 0, 3, 2)) == pytest.approx(1 / 3) and overlap((0, 0, 0, 0), (0, 0, 0, 0)) == 0


@pytest.mark.parametrize("make", [SegmentAnything, TextDetector])
def test_a_folder_without_a_model_is_said(tmp_path, make):
    with pytest.raises(GenmojoError) as fault:
        make(tmp_path)
    assert fault.value.code == "missing_package" and str(tmp_path) in fault.value.sentence()


def test_depth_files_by_clip_and_by_source_number(tmp_path):
    frames, labels, _ = squares(count=3)
    clip = clip_of(frames, labels).with_channels(frame_index=np.array([1, 3, 4]))
    planes = np.stack([np.full((48, 48), n, np.float16) for n in range(1, 7)])
    planes[3, 0, 0] = np.nan
    np.savez(tmp_path / "whole.npz", depth=planes)
    found = DepthFile(tmp_path / "whole.npz").predict(clip)
    assert found.kind == "disparity" and found.value[:, 50, 50].tolist() == [2, 4, 5] and not found.valid[1, 0, 0]
    np.savez(tmp_path / "cut.npz", depths=planes[:3])
    assert DepthFile(tmp_path / "cut.npz", "metric").predict(clip).value[:, 50, 50].tolist() == [1, 2, 3]
    np.savez(tmp_path / "short.npz", depth=planes[:2])
    with pytest.raises(GenmojoError) as fault:
        DepthFile(tmp_path / "short.npz").predict(clip)
    assert fault.value.code == "schema"
