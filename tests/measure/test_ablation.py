"""The ablation: rows are measured, kept and compared fairly; the table says which is best."""

import json
from dataclasses import replace

import numpy as np
import pytest

from genmojo_core.clip import synthetic, synthetic_files
from genmojo_core.clip.synthetic_specs import spec
from genmojo_core.errors import GenmojoError
from genmojo_core.measure import ablation, ablation_table
from tests.optimise.small_runs import small_clip, small_config


def entry(name, title, **mean):
    return {"variant": name, "title": title, "seeds": 2, "mean": mean, "spread": dict.fromkeys(mean, 0.1), "notes": []}


def test_table_marks_the_best_and_leaves_out_what_nobody_has(tmp_path):
    entries = [entry("full", "full <b>", ate=1.0, psnr=20.0), entry("no_prior", "w/o prior", ate=2.0, psnr=21.0)]
    heads, texts, best = ablation_table.cells(entries)
    assert heads == ["variant", "ATE", "PSNR"]
    assert texts[0][1] == "1.00 ±0.10" and best == [[False, True, False], [False, False, True]]
    ablation_table.write_html(entries, "on <clip>", tmp_path / "t.html")
    page = (tmp_path / "t.html").read_text()
    assert "full &lt;b&gt;" in page and page.count("class=best") == 2 and "<clip>" not in page
    ablation_table.write_png(entries, "on clip", tmp_path / "t.png")
    assert (tmp_path / "t.png").read_bytes()[:4] == b"\x89PNG"


def test_summary_averages_over_seeds_and_counts_what_is_saved():
    rows = [{"variant": v, "seed": s, "psnr": 20.0 + s, "cpu_seconds": c, "notes": ["x"] if s else []}
            for v, c in (("full", 30.0), ("no_prior", 20.0)) for s in (0, 1)]  # fmt: skip
    full, without = ablation.summary(rows)
    assert full["mean"]["psnr"] == 20.5 and full["spread"]["psnr"] == 0.5 and full["notes"] == ["x"]
    assert without["mean"]["saves"] == 10.0 and "saves" not in full["mean"]
    heads, texts, best = ablation_table.cells([full, without])
    assert heads[-1] == "saves s" and texts[1][-1] == "10 ±0" and not best[1][-1]


def test_jitter_keeps_the_picture_of_depth_and_changes_its_scale():
    clip = small_clip()
    worse = ablation.with_jitter(clip, 3)
    ratio = worse.depth.value / clip.depth.value
    assert np.ptp(ratio, axis=(1, 2)).max() < 1e-5 and np.std(ratio[:, 0, 0]) > 0.01 and not worse.depth.given


def test_unknown_variants_are_named(tmp_path):
    with pytest.raises(GenmojoError, match="no variant colour"):
        ablation.ablate("nowhere", ablation.Plan(("colour",), (0,), small_config()), tmp_path, lambda *_: None)


def test_a_row_that_the_budget_cut_short_says_so(tmp_path):
    base = replace(spec("crossing-shapes"), frames=3, size=(80, 45), novel_every=0)
    synthetic_files.write(*synthetic.generate(base), tmp_path / "clip")
    plan = ablation.Plan(("full",), (0,), small_config(lift_steps=2, joint_steps=500, budget_seconds=1.0, prior="none"))
    row = ablation.ablate(str(tmp_path / "clip"), plan, tmp_path / "out", lambda *_: None)[0]
    assert row["steps"] < 502 and any("the budget ended a run" in note for note in row["notes"])


def test_rows_of_another_program_are_not_mixed_in(tmp_path, monkeypatch):
    ran = []
    monkeypatch.setattr(ablation, "run_variant", lambda *_: ran.append(1) or {"psnr": 20.0 + len(ran)})
    plan = ablation.Plan(("full", "no_prior"), (0,), small_config())
    (tmp_path / "runs").mkdir()
    first = ablation.ablate("clip", plan, tmp_path, lambda *_: None)
    assert ablation.ablate("clip", plan, tmp_path, lambda *_: None) == first and len(ran) == 2
    monkeypatch.setattr(ablation.sources, "digest", lambda: "another")
    again = ablation.ablate("clip", plan, tmp_path, lambda *_: None)
    assert len(ran) == 4 and [row["psnr"] for row in again] == [23.0, 24.0]


@pytest.mark.slow
def test_rows_are_measured_against_truth_and_not_run_twice(tmp_path):
    base = replace(spec("crossing-shapes"), frames=4, size=(112, 63))
    synthetic_files.write(*synthetic.generate(base), tmp_path / "clip")
    plan = ablation.Plan(
        ("full", "no_joint", "worse_depth", *ablation.OTHERS), (0,), small_config(lift_steps=2, joint_steps=2)
    )
    heard = []
    args = (str(tmp_path / "clip"), plan, tmp_path / "out", lambda name, event: heard.append(name))
    rows = ablation.ablate(*args)
    assert [r["variant"] for r in rows] == list(plan.variants)
    assert all({"psnr", "ate", "oa", "iou_90", "psnr_union_180", "cpu_seconds"} <= set(r) for r in rows)
    count = len(heard)
    assert ablation.ablate(*args) == json.loads(json.dumps(rows)) and len(heard) == count, "nothing ran again"
