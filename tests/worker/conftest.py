"""Runs of tests lie in a folder of their own."""

import pytest


@pytest.fixture(autouse=True)
def _own_runs(tmp_path, monkeypatch):
    monkeypatch.setenv("GENMOJO_RUNS", str(tmp_path / "runs"))
