"""The embedded prior: geometry that needs no training, the shipped file's promises, training that resumes.

Thresholds are those of issue 6, on the frozen test set. The fit's gain on real clips is not covered here.
"""

import json

import numpy as np
import pytest
import torch

from genmojo_core.errors import GenmojoError
from genmojo_core.priors import make, weights
from genmojo_core.priors.agreement import Seen, disagreement, training_percentile
from genmojo_core.priors.batches import batch_of, make_batch
from genmojo_core.priors.completion import surface_points, thinned, unseen_only
from genmojo_core.priors.denoiser import SPREAD, Denoiser
from genmojo_core.priors.embedded import BODY, EmbeddedPrior
from genmojo_core.priors.generator import FRONT, Variation, example
from genmojo_core.priors.held_out import inflated, table
from genmojo_core.priors.prior import Reference, ViewOffsets
from genmojo_core.priors.tasks import RAYS, DenoiserTask, VolumeTask, _chosen_rays, _overlap, scores
from genmojo_core.priors.test_set import frozen_examples
from genmojo_core.priors.training import TrainingPlan, train
from genmojo_core.priors.volume import FAR, NEAR, Rays, VolumeNet, picture_rays, render
from genmojo_core.scene.initialise import Points
from tests.priors.test_references import clip_with


@pytest.fixture(autouse=True)
def one_thread():
    torch.manual_seed(0)
    torch.set_num_threads(1)


@pytest.fixture(scope="module")
def shipped():
    return weights.read(weights.SHIPPED)


@pytest.fixture(scope="module")
def figures(shipped):
    return table(shipped.volume, objects=20)


def test_a_uniform_ball_of_fog_is_rendered_by_the_formula():
    """Density inside a ball: alpha through its centre is 1 - exp(-density x diameter)."""
    bins, side = 48, 64
    z = torch.linspace(NEAR, FAR, 2 * bins + 1)[1::2]
    ticks = (torch.arange(side) + 0.5) / side * 2 - 1
    depth, y, x = torch.meshgrid(z, ticks, ticks, indexing="ij")
    reach = 0.9136 * (depth + 4.0) / 4.0
    inside = (x * reach) ** 2 + (y * reach) ** 2 + depth**2 < 0.6**2
    volume = torch.stack([torch.full_like(depth, 0.25)] * 3 + [inside * 1.5])[None]
    start = torch.eye(4)
    start[2, 3] = -4.0
    rays = Rays(start[None, None], torch.tensor([4.0]), torch.zeros(1, 1, 1, 2))
    got = render(volume, rays, samples=200)[0, 0, 0]
    alpha = 1 - np.exp(-1.5 * 1.2)
    np.testing.assert_allclose(got[:4], [0.25 * alpha] * 3 + [alpha], rtol=0.03)


def test_the_gradient_of_rendering_is_right_in_float64():
    volume = torch.rand(1, 4, 3, 4, 4, dtype=torch.float64, requires_grad=True)
    start = torch.eye(4, dtype=torch.float64)
    start[2, 3] = -3.0
    rays = picture_rays(start[None, None], torch.tensor([3.0], dtype=torch.float64), 2)
    rays = Rays(rays.to_space, rays.distance, rays.xy.double())
    assert torch.autograd.gradcheck(lambda v: render(v, rays, samples=5), (volume,), atol=1e-6)


def reference(one):
    c = torch.from_numpy(one.condition)
    angle = np.deg2rad(one.elevation)
    up = (0.0, float(-np.cos(angle)), float(-np.sin(angle)))
    return Reference(c[:4], c[4], c[5], c[6], one.elevation, one.distance, up)


def offsets(*pairs):
    both = torch.tensor(pairs, dtype=torch.float32)
    return ViewOffsets(both[:, 0], both[:, 1], torch.zeros(len(pairs)))


def test_predictions_are_those_that_were_measured(shipped):
    """The prior as a run uses it (references, views by offsets) gives what the table's code gives."""
    one = example(np.random.default_rng(1), np.array([[0.0, 60.0], [20.0, -90.0]]), variation=Variation())
    ours = shipped.predict(shipped.encode(reference(one)), offsets((0, 60), (20, -90)))
    theirs = VolumeTask(shipped.volume).predict(batch_of([one]))[0].clamp(0, 1)
    torch.testing.assert_close(ours, theirs, rtol=1e-3, atol=2e-3)


def test_shipped_file_keeps_its_promises(figures):
    ours, by_hand = figures["prior"], figures["inflated silhouette"]
    assert ours["all"] >= by_hand["all"] + 1.3 and ours["all"] >= figures["empty"]["all"] + 3.5
    assert ours["all"] >= figures["mean silhouette"]["all"] + 1.5
    assert ours["iou"] > by_hand["iou"] and ours["inside"] >= by_hand["inside"] + 1.0
    assert figures["prior, another object's condition"]["all"] <= ours["all"] - 1.0
    assert figures["prior without depth"]["all"] >= figures["mean silhouette"]["all"] + 1.5


def test_an_untrained_network_would_not_keep_them():
    batch = batch_of(frozen_examples()[:16])
    with torch.no_grad():
        ours = scores(VolumeTask(VolumeNet()).predict(batch), batch.targets)
        by_hand = scores(inflated(batch, 1.2), batch.targets)
    assert ours["psnr"] < by_hand["psnr"] + 1.0


def test_shipped_file_is_small_and_describes_itself():
    assert weights.SHIPPED.stat().st_size <= 4 << 20
    about = weights.describe()
    ours, by_hand = about["held_out"]["prior"], about["held_out"]["inflated silhouette"]
    assert ours["all"] >= by_hand["all"] + 1.3
    assert "no third-party" in about["data"] and about["objects_seen"]["volume"] > 1000


def test_mirrored_conditions_give_mirrored_views_from_the_other_side(shipped):
    one = example(np.random.default_rng(5), np.zeros((1, 2)), variation=Variation())
    mirrored = type(one)(np.ascontiguousarray(one.condition[..., ::-1]), *list(vars(one).values())[1:])
    right = shipped.predict(shipped.encode(reference(one)), offsets((0, 90), (0, -90)))
    left = shipped.predict(shipped.encode(reference(mirrored)), offsets((0, -90), (0, 90))).flip(-1)
    swapped = (right - left.flip(0)).abs().mean()
    assert (right - left).abs().mean() < swapped, "+90 of the mirror image is the mirror image of -90"


@pytest.mark.parametrize("case", ["empty", "one pixel", "all hidden"])
def test_hard_conditions_give_finite_views(shipped, case):
    nothing = torch.zeros(64, 64)
    picture, hidden = torch.zeros(4, 64, 64), nothing.clone()
    if case == "one pixel":
        picture[:, 32, 32] = 1.0
    if case == "all hidden":
        hidden[:] = 1.0
    condition = shipped.encode(Reference(picture, hidden, nothing, nothing, 0.0, 3.0, (0.0, -1.0, 0.0)))
    judged = shipped.judge(torch.rand(1, 4, 32, 32), condition, offsets((0, 90)), 0.5, torch.Generator().manual_seed(0))
    for value in (judged.clean, judged.mean, judged.confidence):
        assert torch.isfinite(value).all()
    points = surface_points(shipped, condition)
    assert np.isfinite(points.xyz).all()
    if case == "empty":
        assert not judged.mean.any() and len(points) == 0


def test_confidence_is_nothing_near_the_reference_and_between_inside_and_outside(shipped):
    one = frozen_examples()[0]
    condition = shipped.encode(reference(one))
    views = offsets((0, 10), (0, 170))
    judged = shipped.judge(torch.rand(2, 4, 32, 32), condition, views, 0.5, torch.Generator().manual_seed(0))
    assert not judged.confidence[0].any() and judged.confidence[1].max() > 0.5
    coverage = shipped.predict(condition, views)[1, 3]
    unsure = (coverage - BODY).abs() < 0.05
    assert not unsure.any() or judged.confidence[1, 0][unsure].max() < 0.05
    assert torch.equal(judged.mean[1, 3], (coverage >= BODY).float()), "objects are solid"


def test_points_of_the_surface_lie_on_the_object(shipped):
    """Of a held-out object: most points within the true silhouette of every view around it."""
    one = frozen_examples()[3]
    points = surface_points(shipped, shipped.encode(reference(one)))
    assert len(points) > 50
    assert np.abs(points.xyz).max() < 1.6 and np.median(points.xyz[:, 2]) > -FRONT


@pytest.mark.parametrize("count", [1, 40, 900])
def test_fewer_points_are_wider_so_that_a_surface_stays_closed(count):
    """A sphere of many small pieces, thinned: no place of it is farther from a piece than its cell is wide."""
    direction = np.random.default_rng(0).normal(size=(20_000, 3))
    xyz = direction / np.linalg.norm(direction, axis=1, keepdims=True)
    side = np.cross(xyz, [0.3, 0.5, 0.8])
    side /= np.linalg.norm(side, axis=1, keepdims=True)
    tangents = 1e-3 * np.stack([side, np.cross(xyz, side)], axis=1)
    kept = thinned(Points(xyz, np.full_like(xyz, 0.5), np.full(len(xyz), 1e-3), tangents), count, 0.01)
    assert 0 < len(kept) <= count
    reach = np.linalg.norm(kept.tangents, axis=2).min(axis=1)
    distance = np.linalg.norm(xyz[:500, None] - kept.xyz[None], axis=2)
    assert (distance <= 3.47 * reach).any(axis=1).all()  # the diagonal of a cell whose half is the reach


def test_points_are_denied_by_what_frames_show():
    clip = clip_with([(40, 30, 80, 60)])
    shown = np.array([[0, 0, 4.5], [0, 0, 3.0], [0, 0, 4.0], [-2.5, 0, 5.0], [-90, 0, 5.0]])
    assert unseen_only(shown, clip, 0, 0).tolist() == [True, False, False, False, True]


def test_the_denoiser_starts_as_the_best_linear_filter_about_the_mean():
    net, mean = Denoiser(), torch.rand(2, 5, 32, 32)
    clean = net(mean[:, :4] + 1.0, mean, torch.tensor([SPREAD, 4.0]))
    np.testing.assert_allclose((clean - mean[:, :4])[0].detach(), 0.5, atol=1e-5)
    assert (clean - mean[:, :4])[1].abs().max() < 0.01


def test_the_volume_learns_from_rays_on_and_near_the_object_and_from_overlap():
    alpha = torch.zeros(1, 2, 32, 32)
    alpha[:, :, 12:20, 12:20] = 1.0
    chosen = _chosen_rays(alpha, torch.Generator().manual_seed(0))
    assert all(len(set(one.tolist())) == RAYS for one in chosen[0])
    row, column = chosen // 32, chosen % 32
    near = (row >= 10) & (row < 22) & (column >= 10) & (column < 22)
    assert 0.3 < near.float().mean() < 0.5, "14 % of the pixels, four times as likely"
    half = torch.tensor([1.0, 1.0, 0.0, 0.0]).repeat(1, 1, 50)
    assert float(_overlap(half, half)) == 1.0 and float(_overlap(half, 1 - half)) < 0.01
    assert float(_overlap(half, 0.9 * half + 0.05)) < float(_overlap(half, 0.95 * half + 0.02)) < 1.0


def test_training_resumes_where_it_was(tmp_path, monkeypatch):
    """Steps counted instead of seconds, so that two runs are comparable: cut after 2 of 4 steps, then gone on."""
    monkeypatch.setattr("genmojo_core.priors.training.REPORT_EVERY", 0.0)
    monkeypatch.setattr("genmojo_core.priors.training._clock", lambda plan: iter_clock())
    monkeypatch.setattr(VolumeTask, "measure", lambda self, batch: {})
    plan = TrainingPlan(4.0, objects=2)

    def fresh():
        torch.manual_seed(1)
        return VolumeTask(VolumeNet())

    whole = train(fresh(), make_folder(tmp_path / "whole"), plan, lambda progress: True)
    folder = make_folder(tmp_path / "cut")
    train(fresh(), folder, plan, lambda progress: progress.step < 2)
    gone_on = train(fresh(), folder, plan, lambda progress: True)
    for one, two in zip(whole.parameters(), gone_on.parameters(), strict=True):
        torch.testing.assert_close(one, two)
    assert [json.loads(line)["step"] for line in (folder / "training.jsonl").read_text().splitlines()] == [1, 2, 3, 4]


def iter_clock():
    """A clock whose every reading after the first two is a second later: one per step."""
    state = {"now": -1.0}

    def read():
        state["now"] += 1.0
        return state["now"]

    return read


def make_folder(path):
    path.mkdir()
    return path


def test_a_file_survives_writing_and_a_damaged_one_is_refused(tmp_path):
    prior = EmbeddedPrior(VolumeNet(), Denoiser())
    weights.write(tmp_path / "p.safetensors", prior, {"note": "x"})
    again = weights.read(tmp_path / "p.safetensors")
    for one, two in zip(prior.volume.parameters(), again.volume.parameters(), strict=True):
        torch.testing.assert_close(one, two, rtol=1e-3, atol=1e-4)
    data = bytearray((tmp_path / "p.safetensors").read_bytes())
    data[-5] ^= 0x10
    (tmp_path / "p.safetensors").write_bytes(data)
    with pytest.raises(GenmojoError, match="checksum"):
        weights.read(tmp_path / "p.safetensors")
    (tmp_path / "p.safetensors").write_bytes(b"\x80\x04pickle")
    with pytest.raises(GenmojoError, match="no safetensors"):
        weights.read(tmp_path / "p.safetensors")


@pytest.mark.slow
def test_the_figures_it_tells_are_true(shipped):
    ours, told = table(shipped.volume), weights.describe()["held_out"]
    for name, figures in ours.items():
        assert figures["all"] == pytest.approx(told[name]["all"], abs=0.02)


@pytest.mark.slow
def test_train_prior_from_nothing_to_a_described_file(tmp_path):
    path = make.make_prior(tmp_path, make.Times(1.0, 1.0, objects=2), lambda part, progress: None)
    about = weights.describe(path)
    assert about["objects_seen"]["volume"] > 0 and about["held_out"]["empty"]["iou"] == 0.0
    assert weights.read(path).kind == "embedded"
    batch = make_batch(np.random.default_rng(0), 2)
    loss = DenoiserTask(Denoiser(), VolumeNet()).loss(batch, torch.Generator().manual_seed(0))
    assert torch.isfinite(loss)


def test_volumes_of_one_object_agree_and_of_two_objects_do_not(shipped):
    """The same volume agrees with itself wherever it is moved; unlike objects differ by more than the limit."""
    one, two = (reference(frozen_examples()[i]) for i in (3, 12))
    first, second = (Seen(shipped.encode(r).volume, r.elevation, r.distance) for r in (one, two))
    assert disagreement(first, first, np.eye(4)) < 1e-3
    grown = np.diag([1.3, 1.3, 1.3, 1.0])
    assert 0.1 < disagreement(first, first, grown) < 0.8
    assert disagreement(first, second, np.eye(4)) > 0.3


def test_two_shots_of_training_objects_agree_better_than_shots_of_different_ones(shipped):
    """The limit that is stored with a file separates something: most pairs of unlike objects lie above it."""
    limit = training_percentile(shipped.volume, 24)
    assert 0.2 < limit < 0.8
    seen = [reference(one) for one in frozen_examples()[:12]]
    volumes = [Seen(shipped.encode(r).volume, r.elevation, r.distance) for r in seen]
    unlike = [disagreement(volumes[i], volumes[i - 1], np.eye(4)) for i in range(12)]
    same = [disagreement(volume, volume, np.eye(4)) for volume in volumes]
    assert max(same) < min(unlike) and np.median(unlike) > 0.8 * limit
