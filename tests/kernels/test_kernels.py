"""Kernels: the lanes compute right, the cache sees every change, nothing names a processor, failures fall back."""

from __future__ import annotations

import os
import re
import shutil
import subprocess
import sys
import threading
from pathlib import Path

import numba
import numpy as np
import pytest
import torch

from genmojo_core.kernels import cache, probe, threads
from genmojo_core.kernels.cache import kernel
from genmojo_core.kernels.simd import (
    EXP2_FLOATS,
    exp2_8,
    exp2_table,
    load4x2,
    load8,
    prepare_exp2,
    store4x2,
    store8,
    sum_rows,
)
from genmojo_core.render import backend, torch_tiles

ROOT = Path(cache.__file__).resolve().parents[2]


@kernel
def _powers(values: np.ndarray, out: np.ndarray, table: np.ndarray) -> None:
    prepare_exp2(table)
    for i in range(0, values.size, 8):
        store8(out, i, exp2_8(load8(values, i), exp2_table(table)))


@kernel
def _moves(values: np.ndarray, out: np.ndarray) -> None:
    store4x2(out, 0, 8, load4x2(values, 0, 100))
    store8(out, 16, sum_rows(values, 0))


def test_powers_of_two_are_right_to_two_parts_in_ten_million() -> None:
    values = np.linspace(-12, 1, 80_000, dtype=np.float32)
    out = np.empty_like(values)
    _powers(values, out, np.empty(EXP2_FLOATS, np.float32))
    assert np.abs(out / np.exp2(values.astype(np.float64)) - 1).max() < 2.5e-7


def test_blocks_and_row_sums_keep_their_order() -> None:
    values, out = np.arange(128, dtype=np.float32), np.zeros(24, np.float32)
    _moves(values, out)
    assert out[:4].tolist() == [0, 1, 2, 3]
    assert out[8:12].tolist() == [100, 101, 102, 103]
    assert out[16:].tolist() == values[:64].reshape(8, 8).sum(axis=1).tolist()


def _copied(package: Path) -> Path:
    """The sources of the kernels in a package of their own."""
    for name in cache.SOURCES:
        source, target = cache.PACKAGE / name, package / name
        target.parent.mkdir(parents=True, exist_ok=True)
        if source.is_dir():
            shutil.copytree(source, target, ignore=shutil.ignore_patterns("__pycache__"))
        else:
            shutil.copy(source, target)
    return package


def test_a_changed_instruction_changes_the_cache_folder(tmp_path: Path) -> None:
    _copied(tmp_path)
    before = cache.fingerprint(tmp_path)
    assert before == cache.fingerprint(cache.PACKAGE)
    for name in ("kernels/simd.py", "render/cpu/forward.py", "scene/planes_cpu/planes.py", "render/rasterizer.py"):
        path = tmp_path / name
        text = path.read_text()
        path.write_text(text + "\n# changed\n")
        assert cache.fingerprint(tmp_path) != before, name
        path.write_text(text)
    assert cache.fingerprint(tmp_path) == before


def test_a_changed_instruction_is_compiled_again(tmp_path: Path) -> None:
    """The fault this guards against: numba alone would run the old code."""
    package = _copied(tmp_path / "genmojo_core")
    program = "from genmojo_core.kernels import trial; print(repr(trial.run()))"
    home = str(tmp_path / "home")
    environment = {**os.environ, "PYTHONPATH": str(tmp_path), "PYTHONDONTWRITEBYTECODE": "1"}
    environment.update({"XDG_CACHE_HOME": home, "LOCALAPPDATA": home, "HOME": home})

    def answer() -> str:
        command = [sys.executable, "-c", program]
        done = subprocess.run(command, env=environment, capture_output=True, text=True, cwd=tmp_path)
        assert done.returncode == 0, done.stderr
        return done.stdout.strip()

    assert answer() == "''"
    assert list(tmp_path.rglob("*.nbc")), "nothing was kept on disk"
    simd = package / "kernels" / "simd.py"
    simd.write_text(simd.read_text().replace("0.2402224208", "0.5402224208"))
    assert "wrong result" in answer()


def test_emitted_code_names_no_processor() -> None:
    """Generic LLVM only, so that ARM compiles the same kernels."""
    from genmojo_core.render.cpu import joint_loss, rasterize
    from genmojo_core.render.cpu.passes import bin_and_draw, find_gradients
    from tests.render.scenes import NAMES, camera, random_splats

    splats = random_splats(5, 3, 0)
    drawn = rasterize.draw(rasterize.Splats(*(getattr(splats, n).numpy() for n in NAMES)), camera(16, 16))
    rasterize.backward(drawn, drawn.rendering())
    joint_loss.warm_up()
    for function in (bin_and_draw, find_gradients, joint_loss.compare_rows):
        fresh = numba.njit(nogil=True, error_model="numpy")(function.py_func)  # code from the cache cannot be read
        fresh.compile(function.signatures[0])
        text = fresh.inspect_llvm(function.signatures[0])
        assert "<8 x float>" in text
        # numba's own reference counts become llvm.x86.atomic.* when LLVM optimises for this machine
        assert re.findall(r"llvm\.(?:x86\.(?!atomic)|aarch64|arm)[\w.]*", text) == []


@pytest.fixture
def fresh_probe():
    probe.kernels_work.cache_clear()
    yield
    probe.kernels_work.cache_clear()


def test_where_compilation_fails_plain_torch_draws_with_one_warning(fresh_probe, monkeypatch) -> None:
    from genmojo_core.kernels import trial

    monkeypatch.setattr(trial, "run", lambda: "LoweringError: no such vector")
    with pytest.warns(RuntimeWarning, match="plain torch is used") as caught:
        assert backend.choose("cpu") is torch_tiles.splat
        assert backend.choose("auto") is torch_tiles.splat
    assert len(caught) == 1


def test_warm_up_compiles_everything(tmp_path: Path) -> None:
    """In a fresh process: after warm_up, drawing and comparing compile nothing more."""
    program = """
import torch
from genmojo_core.render import autograd, backend
from genmojo_core.optimise.joint_loss import Wanted, data_terms
from tests.optimise.test_joint_loss import case, slopes
from tests.render.scenes import camera, random_splats, run, upstream
said = []
backend.warm_up(said.append).join()
from numba.core import event
with event.install_recorder("numba:compile") as recorder:
    view = camera(30, 20)
    run(backend.choose("cpu"), random_splats(50, 7, 0), view, upstream(view, 7), detached_channels=2)
    target, layout, picture = case(24, 33, 2, True, True)
    slopes(data_terms, picture, layout, target, Wanted(True, True, True))
print(len(recorder.buffer))
"""
    environment = {**os.environ, "PYTHONPATH": str(ROOT)}
    done = subprocess.run([sys.executable, "-c", program], env=environment, capture_output=True, text=True, check=True,
                          cwd=ROOT)  # fmt: skip
    assert done.stdout.split() == ["0"]


def test_unknown_devices_are_refused() -> None:
    from genmojo_core.errors import GenmojoError

    with pytest.raises(GenmojoError, match="no rasteriser for device 'tpu'"):
        backend.choose("tpu")
    if not torch.cuda.is_available():
        with pytest.raises(GenmojoError, match="CUDA|gsplat"):
            backend.choose("cuda")


@pytest.mark.parametrize("count", [1, 2, 4])
@pytest.mark.parametrize("jobs", [0, 1, 3, 8])
def test_large_jobs_are_all_done_once_and_may_use_threads_themselves(count: int, jobs: int) -> None:
    done = np.zeros((jobs, 50), np.int64)

    def job(index: int) -> None:
        def add(start: int, stop: int) -> None:
            done[index, start:stop] += 1

        threads.run_ranges(add, 50, 7)

    try:
        threads.set_threads(count)
        threads.run_whole(job, jobs)
    finally:
        threads.set_threads(0)
    assert (done == 1).all()


def test_threads_share_work_again_after_a_large_job_on_one() -> None:
    met = threading.Barrier(2)
    try:
        threads.set_threads(1)
        threads.run_whole(lambda index: None, 2)
        threads.set_threads(2)
        threads.run_jobs(lambda index: met.wait(timeout=120), 2)  # breaks where one thread does both
    finally:
        threads.set_threads(0)


def test_what_a_large_job_raises_reaches_the_caller() -> None:
    def job(index: int) -> None:
        if index == 2:
            raise ValueError("picture 2")

    with pytest.raises(ValueError, match="picture 2"):
        threads.run_whole(job, 4)
    threads.run_whole(lambda index: None, 4)  # and the threads go on
