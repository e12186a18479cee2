"""The deformation field: zero at the start, bounded by its bases, box-safe (METHOD.md appendix B)."""

import torch

from genmojo_core.scene.deform import DeformationField, FieldShape


def field(frames: int = 5, appearance: bool = True) -> tuple[DeformationField, torch.Tensor]:
    generator = torch.Generator().manual_seed(3)
    points = torch.rand(60, 3, generator=generator) - 0.5
    box = torch.tensor([[-0.7, -0.7, -0.7], [0.7, 0.7, 0.7]])
    shape = FieldShape(frames, bases=4, resolution=8, levels=(1, 2), channels=8, width=16, appearance=appearance)
    return DeformationField(box, points[:4], shape, generator), points


def test_nothing_moves_before_the_first_step() -> None:
    model, points = field()
    d = model(points, torch.arange(5))
    for part in (d.d_means, d.d_log_scales, d.d_quats, d.d_dc):
        assert float(part.abs().max()) == 0.0
    assert d.d_means.shape == (5, 60, 3)


def test_without_appearance_change_there_is_no_colour_head() -> None:
    with_color, points = field(appearance=True)
    without, _ = field(appearance=False)
    assert without(points, torch.arange(2)).d_dc is None
    assert without.head.weight.numel() < with_color.head.weight.numel()


def test_motion_lies_in_the_hull_of_the_bases() -> None:
    model, points = field()
    with torch.no_grad():
        model.bases.normal_(generator=torch.Generator().manual_seed(1))
        model.head.weight.normal_(0, 2.0, generator=torch.Generator().manual_seed(2))
    moved = model(points, torch.arange(5)).d_means
    low, high = model.bases.amin(dim=1), model.bases.amax(dim=1)
    assert bool((moved >= low[:, None] - 1e-5).all())
    assert bool((moved <= high[:, None] + 1e-5).all())


def test_the_bases_part_from_the_first_gradient_on() -> None:
    model, points = field()
    target = points * torch.tensor([1.0, -1.0, 0.5])
    loss = ((model(points, torch.tensor([2])).d_means[0] - target) ** 2).mean()
    loss.backward()
    gradient = model.bases.grad[2]
    assert float((gradient - gradient.mean(dim=0)).norm()) > 1e-3 * float(gradient.norm())


def test_n29_flat_boxes_and_points_outside_stay_finite() -> None:
    generator = torch.Generator().manual_seed(0)
    points = torch.rand(30, 3, generator=generator)
    points[:, 2] = 0.25
    box = torch.stack([points.amin(0), points.amax(0)])
    model = DeformationField(box, points[:2], FieldShape(3, 2, 8, (1,), 8, 16), generator)
    d = model(points * 3.0, torch.arange(3))
    (d.d_means.sum() + d.d_log_scales.sum()).backward()
    assert torch.isfinite(d.d_means).all()
    assert all(torch.isfinite(p.grad).all() for p in model.parameters() if p.grad is not None)
    assert float(model.head.bias.grad.abs().sum()) > 0.0


def test_n19_one_frame_works() -> None:
    model, points = field(frames=1)
    assert torch.isfinite(model(points, torch.tensor([0])).d_means).all()
    assert float(model.smoothness()) == 0.0
