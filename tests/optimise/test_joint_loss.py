"""The fused data terms mean what the plain ones mean: float64 as the oracle, differences, edges, threads."""

from __future__ import annotations

import pytest
import torch
from torch import Tensor

from genmojo_core.kernels import threads
from genmojo_core.optimise import joint_loss
from genmojo_core.optimise.joint_loss import NAMES, Wanted, data_terms, data_terms_torch
from genmojo_core.optimise.targets import FrameTargets
from genmojo_core.render.rasterizer import Rendering
from genmojo_core.scene.scene4d import Layout

FACTORS = dict(zip(NAMES, (1.0, 0.7, 0.3, 0.4, 2.0, 0.5), strict=True))
# height, width, objects, measured depth, background, flow; widths that are no multiple of eight, a picture of one pixel
CASES = [
    (40, 37, 3, True, True, True),
    (24, 32, 2, False, True, True),
    (24, 33, 1, True, False, False),
    (9, 7, 1, False, True, True),
    (1, 1, 1, True, True, True),
]


def case(height: int, width: int, objects: int, scaled: bool, flow: bool) -> tuple[FrameTargets, Layout, list[Tensor]]:
    """Random targets with void pixels, and a random picture that mostly shows the right objects."""
    g = torch.Generator().manual_seed(height + width)
    labels = torch.zeros(height, width, dtype=torch.int64)
    for k in range(objects):
        labels[height * k // (objects + 1) : height * (k + 1) // (objects + 1), width // 6 : width // 2 + 3 * k] = k + 1
    seen = (torch.rand(height, width, generator=g) > 0.1).float()
    target = FrameTargets(
        torch.rand(height, width, 3, generator=g), labels, seen, seen < 0, 2 + torch.rand(height, width, generator=g),
        seen.clone(), 3 * torch.randn(height, width, 2, generator=g), seen.clone(), scaled,
    )  # fmt: skip
    layout = Layout(objects, flow)
    features = torch.rand(height, width, layout.channels, generator=g)
    own = torch.nn.functional.one_hot(labels, objects + 1)[..., 1:].float()
    features[..., 3 : 3 + objects] = 0.75 * own + 0.2 * features[..., 3 : 3 + objects] / objects
    alpha = 0.3 + 0.7 * torch.rand(height, width, generator=g)
    return target, layout, [features, alpha * (2 + torch.rand(height, width, generator=g)), alpha]


def slopes(terms: object, picture: list[Tensor], *arguments: object) -> tuple[dict[str, float], list[Tensor]]:
    """Every term, and the gradient of their weighted sum."""
    leaves = [one.clone().requires_grad_() for one in picture]
    values = terms(Rendering(*leaves), *arguments)
    sum(FACTORS[name] * value for name, value in values.items()).backward()
    grads = [torch.zeros_like(leaf) if leaf.grad is None else leaf.grad for leaf in leaves]
    return {name: float(value.detach()) for name, value in values.items()}, grads


@pytest.mark.parametrize(("height", "width", "objects", "scaled", "background", "flow"), CASES)
def test_values_and_gradients_equal_float64(
    height: int, width: int, objects: int, scaled: bool, background: bool, flow: bool
) -> None:  # fmt: skip
    target, layout, picture = case(height, width, objects, scaled, flow)
    wanted = Wanted(background, objects > 1, depth=True)
    values, grads = slopes(data_terms, picture, layout, target, wanted)
    exact, oracle = slopes(data_terms_torch, [one.double() for one in picture], layout, target, wanted)
    assert values.keys() == exact.keys()
    for name, value in values.items():
        assert value == pytest.approx(exact[name], rel=2e-6, abs=1e-7), name
    for ours, right in zip(grads, oracle, strict=True):
        assert float((ours.double() - right).norm()) <= 1e-6 * float(right.norm())


@pytest.mark.parametrize(
    ("part", "channels"), [(0, slice(0, 3)), (0, slice(3, 6)), (0, slice(6, 8)), (1, ...), (2, ...)]
)
@pytest.mark.parametrize("scaled", [True, False])
def test_gradients_are_what_differences_say(part: int, channels: slice, scaled: bool) -> None:
    """Along random lines; labels without the flow term, for which coverage is a given."""
    labels_move = channels == slice(3, 6)
    target, layout, picture = case(40, 37, 3, scaled, flow=not labels_move)
    wanted = Wanted(background=True, labels=True, depth=True)
    _, grads = slopes(data_terms, picture, layout, target, wanted)
    way, step = torch.zeros_like(picture[part]).double(), 1e-7
    way[..., channels] = torch.randn(way[..., channels].shape, generator=torch.Generator().manual_seed(5)).double()
    ends = []
    for sign in (1, -1):
        moved = [one.double() + (sign * step * way if i == part else 0) for i, one in enumerate(picture)]
        terms = data_terms_torch(Rendering(*moved), layout, target, wanted)
        ends.append(sum(FACTORS[name] * float(value) for name, value in terms.items()))
    assert (ends[0] - ends[1]) / (2 * step) == pytest.approx(float((grads[part] * way).sum()), rel=2e-3, abs=1e-4)


def test_same_bits_for_any_number_of_threads() -> None:
    target, layout, picture = case(70, 37, 3, scaled=False, flow=True)
    found, wanted = [], Wanted(background=True, labels=True, depth=True)
    try:
        for count in (1, 2, 4, 1):
            threads.set_threads(count)
            values, grads = slopes(data_terms, picture, layout, target, wanted)
            found.append((values, [one.numpy().tobytes() for one in grads]))
    finally:
        threads.set_threads(0)
    assert all(one == found[0] for one in found)


def test_void_pixels_neither_count_nor_pull() -> None:
    target, layout, picture = case(24, 33, 2, scaled=True, flow=True)
    wanted = Wanted(background=True, labels=True, depth=True)
    before, _ = slopes(data_terms, picture, layout, target, wanted)
    void = target.seen == 0
    picture[0][void] = 9.0
    after, grads = slopes(data_terms, picture, layout, target, wanted)
    assert before == after
    assert all(float(one[void].abs().max()) == 0 for one in grads)


def test_a_number_that_is_none_is_not_hidden() -> None:
    target, layout, picture = case(24, 33, 2, scaled=True, flow=True)
    row, column = (int(i) for i in torch.nonzero(target.seen * (target.labels == 0))[0])
    for channel, name in ((0, "rgb"), (3, "alpha"), (3, "spill")):
        spoiled = [picture[0].clone(), *picture[1:]]
        spoiled[0][row, column, channel] = float("nan")
        terms = data_terms(Rendering(*spoiled), layout, target, Wanted(background=True, labels=True, depth=True))
        assert bool(terms[name].isnan()), name


def test_where_kernels_do_not_work_plain_torch_gives_the_same(monkeypatch: pytest.MonkeyPatch) -> None:
    target, layout, picture = case(24, 33, 2, scaled=True, flow=True)
    wanted = Wanted(background=True, labels=True, depth=True)
    fused, _ = slopes(data_terms, picture, layout, target, wanted)
    monkeypatch.setattr(joint_loss, "kernels_work", lambda: False)
    assert slopes(data_terms, picture, layout, target, wanted)[0] == pytest.approx(fused, rel=1e-5)
