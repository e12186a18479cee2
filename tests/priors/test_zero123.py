"""Zero123-like priors: tiny models of the real classes with random weights, saved to and loaded from a folder.

What the published weights would draw is not covered: they are gigabytes and not here.
"""

import json
import math

import numpy as np
import pytest

torch = pytest.importorskip("torch")
diffusers = pytest.importorskip("diffusers")
transformers = pytest.importorskip("transformers")
pytestmark = pytest.mark.slow  # importing the libraries alone takes seconds

from safetensors.torch import load_file, save_file  # noqa: E402

from genmojo_core.errors import GenmojoError  # noqa: E402
from genmojo_core.priors import zero123_folder  # noqa: E402
from genmojo_core.priors.prior import Reference, ViewOffsets  # noqa: E402
from genmojo_core.priors.sds import distil  # noqa: E402
from genmojo_core.priors.zero123 import camera_numbers  # noqa: E402
from tests.optimise.small_runs import small_clip, small_run  # noqa: E402

EMBEDDING = 32


def save_tiny(folder, projection=("clip_camera_projection", "proj"), numbers=4, label="Zero123Pipeline"):
    torch.manual_seed(0)
    torch.set_num_threads(1)
    unet = diffusers.UNet2DConditionModel(
        sample_size=32, in_channels=8, out_channels=4, block_out_channels=(16, 32), layers_per_block=1,
        down_block_types=("CrossAttnDownBlock2D", "DownBlock2D"), up_block_types=("UpBlock2D", "CrossAttnUpBlock2D"),
        cross_attention_dim=EMBEDDING, norm_num_groups=8, attention_head_dim=8,
    )  # fmt: skip
    vae = diffusers.AutoencoderKL(
        block_out_channels=(8, 8, 8, 8), down_block_types=("DownEncoderBlock2D",) * 4,
        up_block_types=("UpDecoderBlock2D",) * 4, norm_num_groups=4, layers_per_block=1, scaling_factor=0.18215,
    )  # fmt: skip
    encoder = transformers.CLIPVisionModelWithProjection(
        transformers.CLIPVisionConfig(hidden_size=16, intermediate_size=32, num_hidden_layers=1, image_size=32,
                                      num_attention_heads=2, patch_size=16, projection_dim=EMBEDDING)
    )  # fmt: skip
    for name, part in (("unet", unet), ("vae", vae), ("image_encoder", encoder)):
        part.save_pretrained(folder / name)
    (folder / "scheduler").mkdir()
    schedule = {"beta_schedule": "scaled_linear", "beta_start": 0.00085, "beta_end": 0.012}
    (folder / "scheduler" / "scheduler_config.json").write_text(json.dumps(schedule))
    (folder / "model_index.json").write_text(json.dumps({"_class_name": label}))
    name, key = projection
    (folder / name).mkdir()
    linear = torch.nn.Linear(EMBEDDING + numbers, EMBEDDING)
    tensors = {f"{key}.weight": linear.weight.detach(), f"{key}.bias": linear.bias.detach()}
    save_file(tensors, folder / name / "model.safetensors")
    return folder


@pytest.fixture(scope="module")
def tiny(tmp_path_factory):
    return save_tiny(tmp_path_factory.mktemp("tiny"))


def reference(elevation=10.0):
    picture = torch.zeros(4, 64, 64)
    picture[0, 20:44, 20:44] = 0.8
    picture[3, 20:44, 20:44] = 1.0
    up = (0.0, -math.cos(math.radians(elevation)), -math.sin(math.radians(elevation)))
    return Reference(picture, torch.zeros(64, 64), torch.zeros(64, 64), torch.zeros(64, 64), elevation, 4.0, up)


def views(elevation=(0.0, 20.0), azimuth=(90.0, -30.0)):
    return ViewOffsets(torch.tensor(elevation), torch.tensor(azimuth), torch.zeros(len(elevation)))


def test_loads_and_gives_a_finite_repeatable_gradient(tiny):
    prior = zero123_folder.load(tiny)
    assert (prior.kind, prior.networks.camera) == ("zero123", "zero123")
    condition = prior.encode(reference())
    renders = torch.rand(2, 4, 32, 32)
    renders[:, :3] *= renders[:, 3:]
    gradients = []
    for _ in range(2):
        renders = renders.detach().requires_grad_(True)
        said = distil(prior, renders, condition, views(), 0.5, "sds", torch.Generator().manual_seed(3))
        said.loss.backward()
        assert said.gradient.shape == (2, 4, 32, 32)
        assert torch.isfinite(renders.grad).all() and renders.grad.abs().max() > 0
        gradients.append(renders.grad.clone())
    assert torch.equal(*gradients)


def test_chunks_change_nothing(tiny):
    prior = zero123_folder.load(tiny)
    condition = prior.encode(reference())
    latents = torch.randn(2, 4, 32, 32)
    whole = prior.judge(latents, condition, views(), 0.4, torch.Generator().manual_seed(0))
    prior.chunk = 1
    parts = prior.judge(latents, condition, views(), 0.4, torch.Generator().manual_seed(0))
    torch.testing.assert_close(whole.clean, parts.clean, rtol=1e-4, atol=1e-4)
    assert prior.forecast_mb(8) < zero123_folder.load(tiny).forecast_mb(8)


class SpyUNet(torch.nn.Module):
    """Notes what it is shown; guesses the noise it is told."""

    def __init__(self, noise):
        super().__init__()
        self.noise, self.calls = noise, []
        self.weight = torch.nn.Parameter(torch.zeros(1))

    def forward(self, sample, when, encoder_hidden_states):
        self.calls.append((sample, when, encoder_hidden_states))
        return type("Out", (), {"sample": torch.cat([self.noise, self.noise])})()


def spied(tiny, noise):
    prior = zero123_folder.load(tiny)
    spy = SpyUNet(noise)
    prior.networks = type(prior.networks)(**{**vars(prior.networks), "unet": spy})
    return prior, spy


def test_a_perfect_guess_of_the_noise_pulls_nowhere_and_any_other_by_w_times_the_error(tiny):
    noise = torch.randn(2, 4, 32, 32, generator=torch.Generator().manual_seed(5))
    wrong = torch.full_like(noise, 0.1)
    for error in (torch.zeros_like(noise), wrong):
        prior, _ = spied(tiny, noise + error)
        x = torch.randn(2, 4, 32, 32)
        judged = prior.judge(x, prior.encode(reference()), views(), 0.5, torch.Generator().manual_seed(5))
        pull = judged.weight[:, None, None, None] * (x - judged.clean)
        w = 1.0 - float(prior.networks.alphas[prior.timestep(0.5)])
        torch.testing.assert_close(pull, w * error, rtol=1e-4, atol=1e-4)


def test_what_the_network_is_shown(tiny):
    noise = torch.zeros(2, 4, 32, 32)
    prior, spy = spied(tiny, noise)
    condition = prior.encode(reference())
    prior.judge(torch.zeros(2, 4, 32, 32), condition, views(), 1.0, torch.Generator().manual_seed(0))
    sample, when, tokens = spy.calls[0]
    assert sample.shape == (4, 8, 32, 32) and int(when[0]) == 980
    assert not sample[:2, 4:].any() and not tokens[:2].any(), "without condition both picture and token are zero"
    torch.testing.assert_close(sample[2:, 4:], condition.latent.expand(2, -1, -1, -1))
    white = prior.networks.vae.encode(2 * torch.ones(1, 3, 256, 256) - 1).latent_dist.mode()
    empty = torch.zeros(1, 4, 256, 256)
    torch.testing.assert_close(prior.embed(empty), white * 0.18215, rtol=1e-4, atol=1e-5)


def test_camera_numbers_have_the_signs_of_the_training():
    """Camera above the reference: smaller polar angle. Camera to the right: larger azimuth."""
    told = camera_numbers("zero123", reference(), views((20.0, 0.0), (0.0, 90.0)))
    np.testing.assert_allclose(told[0], [-math.radians(20), 0, 1, 0], atol=1e-6)
    np.testing.assert_allclose(told[1], [0, 1, 0, 0], atol=1e-6)
    stable = camera_numbers("stable", reference(elevation=10.0), views())
    np.testing.assert_allclose(stable[:, 3], math.radians(80), atol=1e-6)


def test_zeronvs_is_told_the_relative_pose(tmp_path):
    prior = zero123_folder.load(save_tiny(tmp_path, ("cc_projection", "projection"), numbers=19))
    assert (prior.kind, prior.scope) == ("zeronvs", "scene")
    still = camera_numbers("zeronvs", reference(), views((0.0,), (0.0,)))
    np.testing.assert_allclose(still[0, :16].reshape(4, 4), np.eye(4), atol=1e-6)
    right = camera_numbers("zeronvs", reference(0.0), views((0.0,), (90.0,)))[0, :16].reshape(4, 4)
    assert right[0, 3] > 0.3, "a camera to the right stands at positive x of the reference"
    assert right[2, 3] < -0.3, "and further along its view, which is negative z in OpenGL axes"


def test_both_names_of_the_projection_and_stable_models(tmp_path):
    (tmp_path / "stable-zero123").mkdir()
    prior = zero123_folder.load(save_tiny(tmp_path / "stable-zero123", ("cc_projection", "projection")))
    assert prior.networks.camera == "stable"
    assert zero123_folder.load(tmp_path / "stable-zero123", camera="zero123").networks.camera == "zero123"


@pytest.mark.parametrize("part", ["unet", "vae", "image_encoder", "clip_camera_projection"])
def test_a_missing_component_is_one_sentence_that_names_it(tiny, tmp_path, part):
    for source in tiny.iterdir():
        if source.name != part:
            (tmp_path / source.name).symlink_to(source)
    with pytest.raises(GenmojoError) as caught:
        zero123_folder.load(tmp_path)
    assert part in caught.value.sentence() and "\n" not in caught.value.sentence()


def test_a_run_follows_it_by_score_distillation(tiny):
    run = small_run(small_clip(width=112), prior=f"zero123:{tiny}", lift_steps=1, joint_steps=1, prior_views=1)
    events = list(run)
    assert events[-1].reason == "done" and run.unseen.mode() == "sds"
    steps = [e for e in events if hasattr(e, "losses")]
    assert len(steps) == 2 and all(e.losses["unseen"] > 0 for e in steps)
    assert any("MiB" in e.message for e in events if hasattr(e, "message"))


def test_original_checkpoints_point_to_the_converter(tmp_path):
    (tmp_path / "zero123-xl.ckpt").write_bytes(b"x")
    with pytest.raises(GenmojoError, match="convert"):
        zero123_folder.load(tmp_path)


def as_bin(tiny, folder, held=lambda tensors: tensors):
    """The tiny model with every safetensors file as torch's own format; `held` changes what is pickled."""
    for source in tiny.rglob("*"):
        target = folder / source.relative_to(tiny)
        if source.is_dir():
            target.mkdir()
        elif source.suffix != ".safetensors":
            target.write_bytes(source.read_bytes())
        else:
            stem = "pytorch_model" if source.stem == "model" else source.stem
            torch.save(held(load_file(source)), target.with_name(f"{stem}.bin"))
    return folder


def test_bin_weights_give_the_same_prior(tiny, tmp_path):
    ours, theirs = zero123_folder.load(tiny), zero123_folder.load(as_bin(tiny, tmp_path))
    for part in ("unet", "vae", "image_encoder", "projection"):
        one, two = (getattr(prior.networks, part).state_dict() for prior in (ours, theirs))
        assert all(torch.equal(one[name], two[name]) for name in one)


class Opener:
    """Writes a file when it is unpickled by a reader that trusts it."""

    def __init__(self, path):
        self.path = path

    def __reduce__(self):
        return open, (str(self.path), "w")


def test_bin_weights_that_hold_more_than_tensors_run_nothing(tiny, tmp_path):
    trap = tmp_path / "trap"
    (tmp_path / "model").mkdir()
    folder = as_bin(tiny, tmp_path / "model", lambda tensors: {**tensors, "more": Opener(trap)})
    with pytest.raises(GenmojoError, match="more than tensors"):
        zero123_folder.load(folder)
    assert not trap.exists()
