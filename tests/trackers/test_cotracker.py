"""CoTracker through its child process, against a stand-in with the real interface: axis orders, half pixels, windows,
weights only, faults in one sentence. Not covered: CoTracker itself."""

from __future__ import annotations

import subprocess
import sys
import time
from pathlib import Path

import numpy as np
import pytest

from genmojo_core.clip.clip import Clip
from genmojo_core.errors import GenmojoError
from genmojo_core.store.npz import read_arrays, write_arrays
from genmojo_core.trackers import cotracker_process
from genmojo_core.trackers.cotracker import HUB_MODELS, CoTrackerSeeder, Limits, in_windows, machine_gib
from genmojo_core.trackers.seeding import Queries, make
from genmojo_core.tracks.model import OCCLUDED, OUT_OF_VIEW, VISIBLE

STAND_IN = '''
import torch

class CoTrackerPredictor(torch.nn.Module):
    """Moves every point 2 px right and 1 px down a frame; hides it from frame 6; checks what it is given."""

    def __init__(self, checkpoint="x", offline=True, v2=False, window_len=60):
        super().__init__()
        self.speed = torch.nn.Parameter(torch.load(checkpoint)["speed"])

    @torch.no_grad()
    def forward(self, video, queries=None, segm_mask=None, grid_size=0, grid_query_frame=0, backward_tracking=False):
        B, T, C, H, W = video.shape
        if (B, C, H, W) != (1, 3, 40, 60) or video.dtype != torch.float32 or not backward_tracking:
            raise ValueError(f"video {tuple(video.shape)} {video.dtype}")
        if video.max() <= 1.0 or video[0, 0, 0].mean() < video[0, 0, 2].mean():
            raise ValueError("expected 0..255 and RGB")
        t = torch.arange(T, dtype=torch.float32)[None, :, None, None]
        tracks = queries[:, None, :, 1:] + (t - queries[:, None, :, :1]) * self.speed
        visibility = (t[..., 0] < 6).expand(B, T, queries.shape[1])
        return tracks, visibility
'''


@pytest.fixture()
def checkout(tmp_path: Path) -> tuple[Path, Path]:
    torch = pytest.importorskip("torch")
    package = tmp_path / "checkout" / "cotracker"
    package.mkdir(parents=True)
    (package / "__init__.py").write_text("")
    (package / "predictor.py").write_text(STAND_IN)
    weights = tmp_path / "scaled_offline.pth"
    torch.save({"speed": torch.tensor([2.0, 1.0])}, weights)
    return package.parent, weights


def red_clip(frames: int = 10) -> Clip:
    """Held at half the size of its source."""
    pictures = np.zeros((frames, 40, 60, 3), np.uint8)
    pictures[..., 0] = 200
    return Clip("red", "procedural", pictures, np.arange(frames), np.arange(frames) / 24.0,
                tuple(map(str, range(frames))), (120, 80))  # fmt: skip


def test_axes_pixels_and_states_are_converted_exactly(checkout: tuple[Path, Path]) -> None:
    seeder = make("cotracker", checkout[0], checkpoint=str(checkout[1]))
    queries = Queries(np.array([0, 3]), np.array([[20.0, 10.0], [112.0, 30.0]]), np.array([1, 2]))
    tracks = seeder.seed(red_clip(), queries)
    frames = np.arange(10)
    expected = queries.xy[:, None] + (frames[None] - queries.t[:, None])[..., None] * np.array([4.0, 2.0])
    assert np.abs(tracks.xy - expected).max() < 1e-4
    assert tracks.state[0].tolist() == [VISIBLE] * 6 + [OCCLUDED] * 4
    assert tracks.state[1, 9] == OUT_OF_VIEW
    assert tracks.object.tolist() == [1, 2]
    assert "CC BY-NC" in seeder.licence


def test_long_clips_go_in_windows_that_continue_one_another(checkout: tuple[Path, Path]) -> None:
    limits = Limits(window=20)
    frames = np.zeros((50, 4, 4, 3), np.uint8)
    lengths = []

    def run(part: np.ndarray, asked: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        lengths.append(len(part))
        t = np.arange(len(part))[:, None, None]
        return asked[None, :, 1:] + (t - asked[None, :, :1]) * 3.0, np.ones((len(part), len(asked)), bool)

    for start in (0, 17, 49):
        xy, seen = in_windows(frames, np.array([[start, 5.0, 6.0]]), limits.window, run)
        assert np.allclose(xy[:, 0], np.array([5.0, 6.0]) + (np.arange(50)[:, None] - start) * 3.0)
        assert seen.all()
    assert max(lengths) == 20


def test_queries_of_different_times_each_go_through_all_windows() -> None:
    """A tracker that is exact: a point is where its query was plus 3 px a frame, however late the query is."""
    frames, batches = np.zeros((160, 4, 4, 3), np.uint8), []

    def run(part: np.ndarray, asked: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        batches.append(len(asked))
        t = np.arange(len(part))[:, None, None]
        return asked[None, :, 1:] + (t - asked[None, :, :1]) * 3.0, np.ones((len(part), len(asked)), bool)

    start = np.array([0, 100, 60, 159])
    queries = np.stack([start, 5.0 + start, 6.0 + np.zeros(4)], axis=1)
    shares: list[float] = []
    xy, seen = in_windows(frames, queries, 64, run, shares.append)
    expected = queries[None, :, 1:] + (np.arange(160)[:, None, None] - start[None, :, None]) * 3.0
    assert np.abs(xy - expected).max() < 1e-3 and seen.all()
    assert len(batches) <= 6 and shares == sorted(shares) and shares[-1] == 1.0


SECOND = """
import torch

class CoTrackerPredictor(torch.nn.Module):  # as in the source of CoTracker 2

    def __init__(self, checkpoint="./checkpoints/cotracker2.pth", window_len=8):
        super().__init__()
        model = torch.nn.Module()
        model.time_emb = torch.nn.Parameter(torch.zeros(1, window_len))
        model.load_state_dict(torch.load(checkpoint))

    def forward(self, video, queries=None, segm_mask=None, grid_size=0, grid_query_frame=0, backward_tracking=False):
        T = video.shape[1]
        return queries[:, None, :, 1:].expand(1, T, -1, 2), torch.ones(1, T, queries.shape[1], dtype=torch.bool)
"""
THIRD = """
from cotracker.second import CoTrackerPredictor as Second

class CoTrackerPredictor(Second):  # as in the source of CoTracker 3

    def __init__(self, checkpoint="./checkpoints/scaled_offline.pth", offline=True, v2=False, window_len=60):
        if not v2 and window_len != (60 if offline else 16):
            raise ValueError("no model of that kind")
        super().__init__(checkpoint, window_len)
"""


@pytest.mark.parametrize(
    ("source", "weights", "window"),
    [("2", "cotracker2", 8), ("2", "cotracker2v1", 16), ("3", "cotracker2", 8), ("3", "scaled_online", 16),
     ("3", "scaled_offline", 60), ("3", "mine", 8)],
)  # fmt: skip
def test_every_generation_of_source_and_weights(tmp_path: Path, source: str, weights: str, window: int) -> None:
    torch = pytest.importorskip("torch")
    package = tmp_path / "checkout" / "cotracker"
    package.mkdir(parents=True)
    (package / "__init__.py").write_text("")
    (package / "second.py").write_text(SECOND)
    (package / "predictor.py").write_text(SECOND if source == "2" else THIRD)
    torch.save({"time_emb": torch.zeros(1, window)}, tmp_path / f"{weights}.pth")
    queries = np.array([[0.0, 5.0, 6.0]], np.float32)
    write_arrays(tmp_path / "asked.npz", {"video": np.zeros((3, 4, 6, 3), np.uint8), "queries": queries})
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr("sys.path", list(sys.path))
        for name in [m for m in sys.modules if m.split(".")[0] == "cotracker"]:
            patch.delitem(sys.modules, name)
        asked, answer = str(tmp_path / "asked.npz"), str(tmp_path / "answer.npz")
        assert cotracker_process.main([asked, answer, str(package.parent), f"{tmp_path}/{weights}.pth", "", "0"]) == 0
        for name in [m for m in sys.modules if m.split(".")[0] == "cotracker"]:
            del sys.modules[name]
    assert (read_arrays(tmp_path / "answer.npz")["tracks"] == queries[0, 1:]).all()


def test_a_checkpoint_that_would_run_code_is_refused(checkout: tuple[Path, Path]) -> None:
    torch = pytest.importorskip("torch")
    torch.save({"speed": Path("x")}, checkout[1])  # any class at all
    queries = Queries(np.array([0]), np.array([[20.0, 10.0]]), np.array([1]))
    with pytest.raises(GenmojoError, match="CoTracker stopped"):
        CoTrackerSeeder(*checkout).seed(red_clip(), queries)


def test_what_is_missing_is_said(tmp_path: Path, checkout: tuple[Path, Path]) -> None:
    with pytest.raises(GenmojoError, match="holds no cotracker/predictor.py"):
        CoTrackerSeeder(tmp_path, checkout[1])
    with pytest.raises(GenmojoError, match="no checkpoint"):
        CoTrackerSeeder(checkout[0], tmp_path / "none.pth")
    with pytest.raises(GenmojoError, match="agree first"):
        make("cotracker", "hub:cotracker3_offline")


def test_where_memory_runs_out_smaller_windows_are_tried(checkout: tuple[Path, Path]) -> None:
    predictor = checkout[0] / "cotracker" / "predictor.py"
    greedy = STAND_IN.replace("B, T, C, H, W = video.shape", "B, T, C, H, W = video.shape\n"
                              "        if T > 16:\n            raise MemoryError(T)")  # fmt: skip
    predictor.write_text(greedy)
    queries = Queries(np.array([0]), np.array([[20.0, 10.0]]), np.array([1]))
    found = CoTrackerSeeder(*checkout, Limits(window=32)).seed(red_clip(20), queries)
    assert found.xy[0, 10] == pytest.approx((20 + 40, 10 + 20), abs=1e-3)
    predictor.write_text(greedy.replace("T > 16", "T > 1"))
    with pytest.raises(GenmojoError, match="ran out of memory"):
        CoTrackerSeeder(*checkout, Limits(window=16)).seed(red_clip(20), queries)


def test_limits_are_checked_and_fit_the_machine() -> None:
    assert 0 < Limits().memory_gib <= machine_gib()
    for wrong in ({"window": 4}, {"window": 100_000}, {"memory_gib": -1.0}, {"memory_gib": float("nan")}):
        with pytest.raises(GenmojoError, match="no limits"):
            Limits(**wrong)
    with pytest.raises(GenmojoError, match="no limits"):
        make("cotracker", "hub:cotracker3_offline", consent="yes", window="3")


ONLINE = """
import torch

class CoTrackerOnlinePredictor(torch.nn.Module):  # as in the sources: bits of two steps, everything so far comes back

    def __init__(self, step=4):
        super().__init__()
        self.step, self.seen = step, None

    @torch.no_grad()
    def forward(self, video_chunk, is_first_step=False, queries=None, grid_size=10, add_support_grid=False):
        if is_first_step:
            self.queries, self.seen = queries, 0
            return None, None
        T = video_chunk.shape[1]
        if T > 2 * self.step:
            raise ValueError("video chunk must be <= window size")
        self.seen = T if not self.seen else self.seen + min(self.step, T - self.step)
        t = torch.arange(self.seen, dtype=torch.float32)[None, :, None, None]
        way = t - self.queries[:, None, :, :1]
        tracks = self.queries[:, None, :, 1:] + way * torch.tensor([2.0, 1.0])
        tracks = torch.where(way < 0, torch.zeros_like(tracks), tracks)  # nothing is known before the query
        return tracks, (way[..., 0] >= 0) & (way[..., 0] < 5)
"""
STEPS = """
import torch

class Model(torch.nn.Module):
    def __init__(self, window_len):
        super().__init__()
        self.window_len, self.updateformer, self.fnet = window_len, torch.nn.Identity(), torch.nn.Identity()

class Sliding(Model):
    def init_video_online_processing(self):
        pass

class CoTrackerPredictor(torch.nn.Module):
    def __init__(self, checkpoint="x", offline=True, v2=False, window_len=60):
        super().__init__()
        self.model = Model(60) if torch.load(checkpoint)["offline"] else Sliding(8)

    def forward(self, video, queries=None, segm_mask=None, grid_size=0, grid_query_frame=0, backward_tracking=False):
        T = video.shape[1]
        windows = 1 if not isinstance(self.model, Sliding) else max(-(-(T - 8) // 4), 0) + 1
        for _ in range(2):
            self.model.fnet(video)
            for _ in range(6 * windows):
                self.model.updateformer(queries)
        return queries[:, None, :, 1:].expand(1, T, -1, 2), torch.ones(1, T, queries.shape[1], dtype=torch.bool)
"""


@pytest.mark.parametrize(
    ("name", "version"),
    [("cotracker2", "2"), ("cotracker2_online", "2"), ("cotracker2v1", None), ("cotracker2v1_online", None),
     ("cotracker3_offline", None), ("cotracker3_online", None)],
)  # fmt: skip
def test_every_model_of_the_hub_is_the_one_that_its_name_says(name: str, version: str | None) -> None:
    """Its entry points `cotracker2*` make version 3 unless the version is given; the others give it themselves, and
    twice is a fault."""
    called: list[tuple[tuple, dict]] = []

    class Torch:
        class hub:  # noqa: N801
            @staticmethod
            def load(*words: str, **options: object) -> str:
                called.append((words, options))
                return "model"

    assert cotracker_process._from_hub(Torch, name) == "model"
    ((words, options),) = called
    assert words == ("facebookresearch/co-tracker", name) and options.pop("trust_repo") is True
    assert options == ({} if version is None else {"version": version})
    assert name in HUB_MODELS and make("cotracker", f"hub:{name}", consent="yes").name == "cotracker"


def test_a_model_that_the_hub_does_not_have_is_refused() -> None:
    with pytest.raises(GenmojoError, match="no model 'cotracker4'.*cotracker3_offline"):
        make("cotracker", "hub:cotracker4", consent="yes")


@pytest.mark.parametrize("frames", [3, 4, 8, 9, 21])
def test_online_models_are_given_the_video_bit_by_bit_and_both_ways(frames: int) -> None:
    torch = pytest.importorskip("torch")
    made: dict = {}
    exec(compile(ONLINE, "online", "exec"), made)  # noqa: S102
    model, last = made["CoTrackerOnlinePredictor"](), frames - 1
    queries = torch.tensor([[[0.0, 5.0, 6.0], [float(last), 50.0, 60.0], [1.0, 7.0, 8.0]]])
    video = torch.zeros(1, frames, 3, 2, 2)
    xy, seen = cotracker_process._both_ways(model, video, queries, cotracker_process.Shares(None))
    way = torch.arange(frames)[:, None] - queries[0, :, 0]
    speed = torch.tensor([2.0, 1.0])
    expected = queries[0, None, :, 1:] + way.abs()[..., None] * speed
    assert torch.allclose(xy[0], expected) and (seen[0] == (way.abs() < 5)).all()


@pytest.mark.parametrize(("offline", "frames"), [(True, 10), (False, 10), (False, 30), (False, 6)])
def test_progress_goes_on_within_a_window(tmp_path: Path, offline: bool, frames: int) -> None:
    torch = pytest.importorskip("torch")
    package = tmp_path / "checkout" / "cotracker"
    package.mkdir(parents=True)
    (package / "__init__.py").write_text("")
    slow = STEPS.replace("self.model.updateformer(queries)",
                         "self.model.updateformer(queries), __import__('time').sleep(0.07)")  # fmt: skip
    (package / "predictor.py").write_text(slow if frames == 10 and offline else STEPS)
    torch.save({"offline": offline}, tmp_path / "w.pth")
    told = tmp_path / "shares.txt"
    queries = np.array([[0.0, 5.0, 6.0]], np.float32)
    write_arrays(tmp_path / "asked.npz", {"video": np.zeros((frames, 4, 6, 3), np.uint8), "queries": queries})
    command = [sys.executable, "-m", "genmojo_core.trackers.cotracker_process", *map(str, (
        tmp_path / "asked.npz", tmp_path / "answer.npz", package.parent, tmp_path / "w.pth", "", 0, told))]  # fmt: skip
    subprocess.run(command, check=True)
    shares = [float(line) for line in told.read_text().split()]
    assert shares == sorted(shares) and shares[-1] == 1.0 and len(set(shares)) == len(shares) > 10
    if offline:
        heard: list[float] = []
        seeder = CoTrackerSeeder(package.parent, tmp_path / "w.pth")
        seeder.seed(red_clip(), Queries(np.array([0]), np.array([[20.0, 10.0]]), np.array([1])), heard.append)
        assert heard == sorted(heard) and heard[-1] == 1.0 and len(heard) > 3, "more than one window's end"


def test_cancelling_ends_the_child(checkout: tuple[Path, Path]) -> None:
    """Its process is gone before the answer: the file that it writes to stays as it is."""
    alive = checkout[0] / "alive.txt"
    (checkout[0] / "cotracker" / "predictor.py").write_text(
        f"import time\nwhile True:\n    open({str(alive)!r}, 'a').write('.')\n    time.sleep(0.01)\n")  # fmt: skip
    queries = Queries(np.array([0]), np.array([[20.0, 10.0]]), np.array([1]))
    with pytest.raises(GenmojoError, match="was stopped"):
        CoTrackerSeeder(*checkout).seed(red_clip(), queries, cancelled=alive.exists)
    left = alive.read_text()
    time.sleep(0.1)
    assert alive.read_text() == left
