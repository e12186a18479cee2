"""The hard cases every installation carries (`genmojo selftest --hard`), one test each, named after their rows.

Whole runs take a second or two each; those are slow tests, a few stay in the quick suite.
"""

from __future__ import annotations

import sys

import pytest

from genmojo_core.cli.main import main
from genmojo_core.hard_cases import suite
from genmojo_core.hard_cases.case import Case, hold, verdicts

QUICK = {
    "1 frame", "one-pixel mask", "no object is ever seen", "no depth at all", "frames of 5 x 7 pixels",
    "a Gaussian becomes nan", "a gradient of nan in one row", "a gradient of nan in a placement",
    "depths at and behind the camera", "quaternions without length", "scales without measure",
    "a prior that says nan", "a prior that says 1e+06",
}  # fmt: skip


def _test_of(case: Case):
    def test() -> None:
        (verdict,) = verdicts([case])
        assert verdict.holds, verdict.happened

    return test if case.name in QUICK else pytest.mark.slow(test)


for _case in suite.CASES:
    _name = f"test_{_case.row.lower()}_" + "".join(c if c.isalnum() else "_" for c in _case.name.lower())
    setattr(sys.modules[__name__], _name, _test_of(_case))


def test_names_are_unique_and_every_quick_one_exists() -> None:
    names = [case.name for case in suite.CASES]
    assert len(names) == len(set(names))
    assert set(names) >= QUICK


def test_a_case_that_breaks_or_crashes_is_a_verdict_and_the_next_one_runs() -> None:
    def breaks() -> str:
        hold(False, "seen instead")
        return ""

    cases = [Case("N00", "breaks", breaks), Case("N00", "crashes", lambda: str(1 // 0)),
             Case("N00", "holds", lambda: "fine")]  # fmt: skip
    found = list(verdicts(cases))
    assert [v.holds for v in found] == [False, False, True]
    assert found[0].happened == "seen instead"
    assert "ZeroDivisionError" in found[1].happened


def test_selftest_prints_a_table_and_tells_by_its_exit_code(capsys, monkeypatch) -> None:
    assert main(["selftest", "--rows", "N26"]) == 0
    shown = capsys.readouterr().out
    assert "a prior that says nan" in shown
    assert "holds" in shown
    broken = Case("N26", "broken on purpose", lambda: str([][1]))
    monkeypatch.setattr(suite, "CASES", (*suite.CASES, broken))
    assert main(["selftest", "--rows", "N26", "--json"]) == 1
    assert '"failed": 1' in capsys.readouterr().out.replace('"failed":1', '"failed": 1')


def test_selftest_of_an_unknown_row_is_one_sentence(capsys) -> None:
    assert main(["selftest", "--rows", "N99"]) == 2
    assert "N99" in capsys.readouterr().err
