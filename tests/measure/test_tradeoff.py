"""The tradeoff report: fronts, shares, exponents, costs and gains are exact; rows are kept; the page is whole."""

import json
from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from genmojo_core.cli.main import main
from genmojo_core.clip import synthetic, synthetic_files
from genmojo_core.clip.cut import cut
from genmojo_core.clip.synthetic_specs import spec
from genmojo_core.config import preset
from genmojo_core.effects.auto import for_budget
from genmojo_core.measure import tradeoff, tradeoff_figures, tradeoff_page
from genmojo_core.measure.charts import Chart, Series
from genmojo_core.measure.tradeoff_figures import Point, exponent, pareto, seconds_to_share
from genmojo_core.measure.trials import Source
from tests.optimise.small_runs import small_clip


@given(st.lists(st.tuples(st.floats(0.1, 1e3), st.floats(5, 40)), min_size=1, max_size=30))
def test_the_front_holds_what_nothing_beats_and_nothing_else(pairs):
    points = [Point(s, p, str(i)) for i, (s, p) in enumerate(pairs)]
    front = pareto(points)

    def beaten(p: Point) -> bool:
        return any(q.seconds <= p.seconds and q.psnr >= p.psnr and (q.seconds, q.psnr) != (p.seconds, p.psnr)
                   for q in points)  # fmt: skip

    assert {(p.seconds, p.psnr) for p in front} == {(p.seconds, p.psnr) for p in points if not beaten(p)}
    assert [p.seconds for p in front] == sorted(p.seconds for p in front)


def test_shares_are_reached_between_points_and_dips_count_for_nothing():
    curve = [(10.0, 20.0), (20.0, 28.0), (30.0, 24.0), (40.0, 30.0)]
    assert seconds_to_share(curve, 0.4) == pytest.approx(15.0)
    assert seconds_to_share(curve, 0.8) == pytest.approx(20.0)
    assert seconds_to_share(curve, 0.9) == pytest.approx(35.0)
    assert seconds_to_share(curve, 1.0) == pytest.approx(40.0)
    assert seconds_to_share([(1.0, 5.0), (2.0, 5.0)], 0.9) is None and seconds_to_share(curve[:1], 0.9) is None


def test_exponents_are_exact_on_power_laws_and_their_error_on_two_residuals():
    x = [1.0, 2.0, 4.0, 8.0]
    slope, error = exponent(x, [3.0 * v**1.5 for v in x])
    assert slope == pytest.approx(1.5) and error == pytest.approx(0.0, abs=1e-9)
    ys = np.exp(np.array([0.0, 1.0, 0.0, 1.0]))  # around ln x in equal steps: residuals by hand
    slope, error = exponent(np.exp([0.0, 1.0, 2.0, 3.0]).tolist(), ys.tolist())
    assert slope == pytest.approx(0.2) and error == pytest.approx(np.sqrt(0.8 / 2 / 5))
    assert exponent([2.0, 2.0], [1.0, 3.0]) is None


def row(key, kind, title, psnr, ms, seed=0, **more):
    stages = {"joint": {"seconds": ms * 0.1, "cpu_seconds": ms * 0.1, "steps": 100.0}}
    curve = [{"seconds": s, "cpu_seconds": 2 * s, "step": s, "psnr_held_out": p} for s, p in ((5, psnr - 4), (9, psnr))]
    return {"key": key, "kind": kind, "title": title, "seed": seed, "psnr": psnr, "psnr_held_out": psnr - 1,
            "took": 12.0, "stages": stages, "model_mb": ms / 10, "curve": curve, "seconds": 10.0, "cpu_seconds": 20.0,
            "steps": 120,
            "moment": 0.0, "reason": "budget", "gaussians": 900, "size": [64, 36], "frames": 5, "objects": 2,
            "vary": "", "config": {"clock": "wall"}, **more}  # fmt: skip


def rows():
    made = [row(f"base-{s}", "effect", "as planned", 25.0 + s, 50.0, s, ate=2.0) for s in (0, 1)]
    made += [row(f"effect-flow-{s}", "effect", "without flow", 24.5 + s, 40.0, s, ate=2.5) for s in (0, 1)]
    made += [row("effect-x-0", "effect", "with appearance change", 24.0, 80.0, ate=2.0)]
    made += [row("loss-ssim-0", "loss", "without ssim", 25.25, 35.0, ate=2.0)]
    made += [row("a", "preset", "draft, 30 s", 22.0, 50.0, moment=30.0, reason="done"),
             row("b", "preset", "auto, 30 s", 24.0, 50.0, moment=30.0),
             row("c", "preset", "auto, 60 s", 26.0, 50.0, moment=60.0, seconds=20.0),
             row("d", "preset", "standard, 60 s", 23.0, 50.0, moment=60.0, seconds=59.0)]  # fmt: skip
    for n in (2, 4, 8):
        made.append({**row(f"g{n}", "growth", f"{n} frames", 0.0, 1.0), "vary": "frames", "frames": n, "step_ms": 5.0,
                     "motion_seconds": 0.5 * n, "on": []})  # fmt: skip
    return made


def test_costs_and_gains_are_with_minus_without_seed_by_seed():
    found = {e["title"]: e for e in tradeoff_figures.parts_table(rows())}
    flow = found["flow"]
    assert (flow["ms"], flow["mb"], flow["runs"], flow["on"]) == (pytest.approx(10.0), pytest.approx(1.0), 2, True)
    assert flow["gain"]["psnr"] == pytest.approx(0.5) and flow["gain"]["ate"] == pytest.approx(-0.5)
    added = found["appearance change"]
    assert added["ms"] == pytest.approx(30.0) and added["gain"]["psnr"] == pytest.approx(-1.0) and not added["on"]
    assert found["ssim"]["kind"] == "loss" and found["ssim"]["gain"]["psnr"] == pytest.approx(-0.25)


def test_what_a_run_took_out_of_one_step_counts_before_the_difference_of_two_runs():
    base = row("base-0", "effect", "as planned", 25.0, 80.0, costs={"flow": 7.0}, term_costs={"hull": 3.0})
    without = row("effect-flow-0", "effect", "without flow", 24.5, 200.0, costs={})
    added = row("effect-shading-0", "effect", "with shading", 25.5, 20.0, costs={"flow": 7.0, "shading": 2.0})
    less = row("loss-hull-0", "loss", "without hull", 24.9, 300.0)
    none = row("effect-camera_motion-0", "effect", "with camera motion", 25.0, 90.0, costs={"flow": 7.0})
    prior = row("effect-unseen_views-0", "effect", "with unseen views", 25.0, 95.0, costs={"flow": 7.0})
    found = {e["title"]: e["ms"] for e in tradeoff_figures.parts_table([base, without, added, less, none, prior])}
    assert found == {"flow": 7.0, "shading": 2.0, "hull": 3.0, "camera motion": 0.0,
                     "unseen views": pytest.approx(15.0)}  # fmt: skip


def test_auto_is_compared_with_what_stood_at_its_moment():
    first, second = tradeoff_figures.against_auto(rows())
    assert first["others"]["draft"]["lead"] == pytest.approx(2.0)
    assert second["others"]["draft"]["lead"] == pytest.approx(4.0)  # it had ended by itself
    assert second["others"]["standard"]["lead"] == pytest.approx(3.0)


def test_growth_and_advice_say_numbers():
    motion = next(e for e in tradeoff_figures.growth_table(rows()) if e["what"] == "search for motion")
    assert motion["exponent"] == pytest.approx(1.0) and motion["error"] == pytest.approx(0.0, abs=1e-9)
    said = " ".join(tradeoff_figures.advice(rows()))
    assert "26.0 dB" in said and "Ssim takes 30 % of a step here and gains -0.25 dB" in said


def test_the_page_stands_alone(tmp_path):
    told = tradeoff_page.write("<clip>", rows(), ["draft, 9 s, seed 1"], tmp_path)
    page = (tmp_path / "tradeoff.html").read_text()
    assert "&lt;clip&gt;" in page and "<clip>" not in page and page.count("<svg") >= 3
    assert not any(word in page for word in ("http://", "https://", "src=", "<script", "@import", "url("))
    assert "draft, 9 s, seed 1" in page and "w/o" not in page
    assert (tmp_path / "tradeoff.png").read_bytes()[:4] == b"\x89PNG"
    stored = json.loads((tmp_path / "tradeoff.json").read_text())
    assert stored["advice"] == told["advice"] and len(stored["rows"]) == len(rows())


def test_charts_put_points_where_their_values_are():
    chart = Chart(
        "s", "dB", [Series("a", [(1.0, 10.0), (100.0, 20.0), (10.0, 15.0)], "#000000", False, True)], log_x=True
    )
    (x0, y0), (x1, y1), (x2, y2) = [(s[1], s[2]) for s in chart.shapes() if s[0] == "dot"][:3]
    assert x0 < x2 < x1 and x2 - x0 == pytest.approx(x1 - x2)
    assert y0 > y2 > y1 and y0 - y2 == pytest.approx(y2 - y1)


def test_a_cut_takes_every_channel():
    clip = small_clip(frames=5)
    short = cut(clip, 0, 3)
    assert (
        len(short) == len(short.masks.value) == len(short.depth.valid) == len(short.cameras.value.world_to_camera) == 3
    )
    assert not short.flow.valid[-1].any() and clip.flow.valid[2].any()


def test_more_time_never_means_less_and_the_user_wins():
    clip = small_clip()
    chosen = [for_budget(s, replace(clip, source_size=(1920, 1080))) for s in (10, 30, 60, 120, 300, 900, 3600)]
    for name in ("short_side", "gaussians_per_object", "background_gaussians", "frames_per_step"):
        values = [getattr(config, name) for config in chosen]
        assert values == sorted(values), name
    assert all(
        c.paced and c.budget_seconds == s for c, s in zip(chosen, (10, 30, 60, 120, 300, 900, 3600), strict=True)
    )
    crowd = replace(clip, object_ids=tuple(range(1, 6)), object_names=("a", "b", "c", "d", "e"))
    one = replace(clip, object_ids=(1,), object_names=("a",))
    shared = [for_budget(s, crowd).gaussians_per_object for s in (10, 30, 60, 120, 300, 900)]
    alone = [for_budget(s, one).gaussians_per_object for s in (10, 30, 60, 120, 300, 900)]
    assert shared == sorted(shared) and shared[2] * 5 <= 2 * alone[2] + 5 and shared[-1] == alone[-1]
    assert for_budget(60, clip, speed=10.0, short_side=96).short_side == 96
    assert for_budget(5, clip).short_side <= min(clip.source_size)


def test_a_row_is_kept_until_its_settings_change(tmp_path):
    trial = tradeoff.Trial("k", "preset", "t", preset("draft"))
    source = Source("clip")
    digest = tradeoff._digest(trial, source)
    assert digest != tradeoff._digest(replace(trial, config=preset("draft", seed=1)), source)
    assert digest != tradeoff._digest(replace(trial, effects={"flow": False}), source)
    path = tmp_path / "k.json"
    for text in ("", "[]", "{", json.dumps({"digest": "x", "took": 1}), json.dumps({"digest": digest})):
        path.write_text(text)
        assert tradeoff._kept(path, digest) is None
    path.write_text(json.dumps({"digest": digest, "took": 1}))
    assert tradeoff._kept(path, digest) is not None


@pytest.mark.slow
def test_the_command_runs_what_is_missing_and_nothing_twice(tmp_path, capsys):
    base = replace(spec("crossing-shapes"), frames=12, size=(112, 63))
    synthetic_files.write(*synthetic.generate(base), tmp_path / "clip")
    command = ["tradeoff", str(tmp_path / "clip"), "-o", str(tmp_path / "out"), "--moments", "1s", "--seeds", "1"]
    assert main([*command, "--budget", "2s", "--json"]) == 0
    first = json.loads(capsys.readouterr().out)
    assert first["trials"] >= 1 and first["left_out"]
    times = {p: p.stat().st_mtime_ns for p in (tmp_path / "out" / "rows").glob("*.json")}
    assert main([*command, "--budget", "400s", "--json"]) == 0
    second = json.loads(capsys.readouterr().out)
    assert second["trials"] > first["trials"] and not second["left_out"]
    assert all(p.stat().st_mtime_ns == t for p, t in times.items())
    assert {e["vary"] for e in second["growth"]} == {"pixels", "Gaussians", "objects", "frames"}
    assert {"flow", "ssim"} <= {e["title"] for e in second["parts"]} and second["auto"][0]["others"]
    assert any("psnr_held_frames" in e for e in second["runs"])


def test_bad_input_is_one_sentence(tmp_path, capsys):
    assert main(["tradeoff", str(tmp_path / "nothing"), "-o", str(tmp_path / "out"), "--seeds", "0"]) == 2
    assert main(["tradeoff", str(tmp_path / "nothing"), "-o", str(tmp_path / "out")]) == 2
    assert len(capsys.readouterr().err.strip().splitlines()) >= 2 and not list((tmp_path / "out").glob("*"))


@pytest.mark.parametrize("values", [(85.3, 96.0), (1.0, 1.02), (56.4, 77.6), (0.3, 3000.0), (7.0, 7.0)])
def test_axes_of_charts_are_labelled_however_close_their_values_lie(values: tuple[float, float]) -> None:
    for log in (True, False):
        shapes = Chart("x", "y", [Series("one", [(1.0, values[0]), (2.0, values[1])], "#000000")], log_y=log).shapes()
        labels = [shape[3] for shape in shapes if shape[0] == "text" and shape[4] == "end"]
        assert 2 <= len(labels) <= 13 and len(set(labels)) == len(labels)
