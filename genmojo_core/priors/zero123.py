"""Zero123, Stable-Zero123 and ZeroNVS from a local folder in diffusers' layout, component by component.

The folder holds `unet/`, `vae/`, `image_encoder/`, `scheduler/` and `clip_camera_projection/` or `cc_projection/`
(METHOD.md section 2, PRIOR.md section 9). Nothing is downloaded and no code of the folder is run; weights must be
safetensors. Pictures are RGB on white; the network works on latents of 32 x 32.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Any, Literal

import torch
from torch import Tensor
from torch.nn import functional

from genmojo_core.priors.embedded import view_cameras
from genmojo_core.priors.prior import Judgement, Reference, ViewOffsets

Camera = Literal["zero123", "stable", "zeronvs"]
SIDE = 256
STEPS = (20, 980)  # noise levels 0 and 1
DISTANCE = 2.0  # of its cameras to the object's centre; the lens spans 49.1 degrees
FIELD = math.radians(49.1)
NEAR_DEPTH = 1.5  # the depth that a fifth of an object's pixels undercut: what ZeroNVS scales translations by
_CLIP_MEAN, _CLIP_STD = (0.48145466, 0.4578275, 0.40821073), (0.26862954, 0.26130258, 0.27577711)


@dataclass(frozen=True)
class Networks:
    """The frozen parts: UNet, VAE, image encoder, Linear to a cross-attention token; alphas (1000,) of the schedule.

    camera: what the Linear is told of the target camera besides the image's embedding.
    """

    unet: Any
    vae: Any
    image_encoder: Any
    projection: torch.nn.Linear
    alphas: Tensor
    camera: Camera


@dataclass(frozen=True)
class Condition:
    """One reference: latent (1, 4, 32, 32) of its picture, unscaled; embedding (1, 1, E); its geometry."""

    latent: Tensor
    embedding: Tensor
    reference: Reference


class Zero123Prior:
    """A pose-conditioned image diffusion model as a view prior.

    Args:
        networks: see there. scale: classifier-free guidance. chunk: views per pass (fewer need less memory; the result
            is the same).
    """

    resolution = 64  # renders are this times the schedule's factors: 128, 192, 256
    channels: Literal["rgb", "rgba"] = "rgb"

    def __init__(self, networks: Networks, scale: float = 5.0, chunk: int = 8) -> None:
        self.networks, self.scale, self.chunk = networks, scale, chunk
        self.kind: Literal["embedded", "zero123", "zeronvs"] = "zeronvs" if networks.camera == "zeronvs" else "zero123"
        self.scope: Literal["object", "scene"] = "scene" if self.kind == "zeronvs" else "object"
        self._where = networks.projection.weight.device
        self._unet_type = next(networks.unet.parameters()).dtype

    def distance(self, reference: Reference) -> float:
        """The distance it was trained at, whatever the clip's lens."""
        return DISTANCE

    @torch.no_grad()
    def encode(self, reference: Reference) -> Condition:
        """The latent's mode without the VAE's scale (as it was trained) and the image encoder's embedding."""
        picture = _on_white(reference.picture[None, :3] * reference.picture[None, 3:], reference.picture[None, 3:])
        picture = _resized(picture.to(self._where), SIDE)
        latent = self.networks.vae.encode(2.0 * picture - 1.0).latent_dist.mode()
        side = int(self.networks.image_encoder.config.image_size)
        small = functional.interpolate(picture, (side, side), mode="bicubic", antialias=True)
        mean, std = (torch.tensor(v, device=self._where)[None, :, None, None] for v in (_CLIP_MEAN, _CLIP_STD))
        embedding = self.networks.image_encoder((small - mean) / std).image_embeds
        return Condition(latent, embedding[:, None].float(), reference)

    def embed(self, renders: Tensor) -> Tensor:
        """Latents of renders on white, scaled; the VAE works in float32 and in chunks, gradients pass through it.

        The latent distribution's mean is taken where the original samples it: the same on average, without noise.
        """
        picture = _resized(_on_white(renders[:, :3], renders[:, 3:]).to(self._where), SIDE)
        parts = [self.networks.vae.encode(2.0 * p - 1.0).latent_dist.mode() for p in picture.split(self.chunk)]
        return torch.cat(parts) * self.networks.vae.config.scaling_factor

    @torch.no_grad()
    def judge(
        self, embedded: Tensor, condition: Condition, views: ViewOffsets, level: float, generator: torch.Generator
    ) -> Judgement:
        """Classifier-free guidance at one noise level; x - clean times the weight is w (noise guessed - noise)."""
        step = self.timestep(level)
        keep = float(self.networks.alphas[step])
        noise = torch.randn(embedded.shape, generator=generator).to(embedded)
        noisy = math.sqrt(keep) * embedded + math.sqrt(1.0 - keep) * noise
        tokens = self.tokens(condition, views)
        guesses = []
        for rows in torch.arange(len(embedded)).split(self.chunk):
            guesses.append(self._guess(noisy[rows], tokens[rows], condition.latent, step))
        guess = torch.cat(guesses)
        clean = (noisy - math.sqrt(1.0 - keep) * guess) / math.sqrt(keep)
        weight = torch.full((len(embedded),), math.sqrt((1.0 - keep) * keep), device=embedded.device)
        return Judgement(clean, weight, None, torch.ones_like(embedded[:, :1]))

    def predict(self, condition: Condition, views: ViewOffsets) -> Tensor | None:
        """None: it has no mean views."""
        return None

    def tokens(self, condition: Condition, views: ViewOffsets) -> Tensor:
        """(B, 1, 768) cross-attention tokens: embedding and camera through the Linear."""
        told = camera_numbers(self.networks.camera, condition.reference, views).to(self._where)
        embedding = condition.embedding.expand(len(told), -1, -1)
        return self.networks.projection(torch.cat([embedding, told[:, None]], dim=-1))

    def timestep(self, level: float) -> int:
        """Step 20..980 of a noise level 0..1."""
        low, high = STEPS
        return round(low + (high - low) * min(max(level, 0.0), 1.0))

    def forecast_mb(self, views: int, side: int = SIDE) -> float:
        """Predicted peak in MiB: weights, plus per view of a chunk the VAE encoder's activations with gradient.

        The activations are 2 200 float32 values per pixel (the encoder's first blocks at full size, times two for the
        backward pass); an estimate, not measured on the published weights.
        """
        nets = (self.networks.unet, self.networks.vae, self.networks.image_encoder)
        weights = sum(p.numel() * p.element_size() for net in nets for p in net.parameters())
        return (weights + min(views, self.chunk) * side * side * 2200 * 4) / (1 << 20)

    def _guess(self, noisy: Tensor, tokens: Tensor, latent: Tensor, step: int) -> Tensor:
        """Noise with guidance; without condition both the token and the picture are zero."""
        picture = latent.expand(len(noisy), -1, -1, -1)
        shown = torch.cat([torch.cat([noisy, noisy]), torch.cat([torch.zeros_like(picture), picture])], dim=1)
        told = torch.cat([torch.zeros_like(tokens), tokens])
        when = torch.full((len(shown),), step, device=self._where)
        kind = self._unet_type
        guess = self.networks.unet(shown.to(kind), when, encoder_hidden_states=told.to(kind)).sample.float()
        without, given = guess.chunk(2)
        return without + self.scale * (given - without)


def camera_numbers(camera: Camera, reference: Reference, views: ViewOffsets) -> Tensor:
    """What a model is told of the target cameras, (B, 4) or (B, 19) float32.

    zero123: polar angle from above, target minus reference (so looking from higher is negative), sine and cosine of
    the azimuth (+ = camera to its right), radius. stable: the reference's own polar angle in the radius' place.
    zeronvs: target camera in the reference camera's axes (OpenGL), translation tamed as in its training, field of view.
    """
    elevation, azimuth = torch.deg2rad(views.elevation.float()), torch.deg2rad(views.azimuth.float())
    if camera == "zeronvs":
        return _relative_cameras(reference, views)
    last = views.radius.float()
    if camera == "stable":
        last = torch.full_like(azimuth, math.radians(90.0 - reference.elevation))
    return torch.stack([-elevation, azimuth.sin(), azimuth.cos(), last], dim=1)


def _relative_cameras(reference: Reference, views: ViewOffsets) -> Tensor:
    """(B, 19): 16 numbers of inv(reference pose) target pose with OpenGL axes, field of view, its sine and cosine."""
    start = torch.eye(4, dtype=torch.float64)
    start[2, 3] = DISTANCE
    flip = torch.diag(torch.tensor([1.0, -1.0, -1.0, 1.0], dtype=torch.float64))
    targets = torch.from_numpy(view_cameras(reference, views, DISTANCE))
    relative = flip @ start @ torch.linalg.inv(targets) @ flip
    relative[:, :3, 3] = 5.0 * torch.tanh(relative[:, :3, 3] / NEAR_DEPTH / 10.0)
    lens = torch.tensor([FIELD, math.sin(FIELD), math.cos(FIELD)], dtype=torch.float64)
    return torch.cat([relative.flatten(1), lens.expand(len(targets), 3)], dim=1).float()


def _on_white(rgb: Tensor, alpha: Tensor) -> Tensor:
    """Premultiplied colour over white, 0..1."""
    return (rgb + (1.0 - alpha)).clamp(0.0, 1.0)


def _resized(picture: Tensor, side: int) -> Tensor:
    """Bilinear to a square."""
    if picture.shape[-1] == side:
        return picture
    return functional.interpolate(picture, (side, side), mode="bilinear", align_corners=False)
