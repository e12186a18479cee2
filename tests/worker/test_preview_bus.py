"""The preview bus: what is read is what was written, whole, latest first, whatever the two sides do."""

from __future__ import annotations

import subprocess
import sys
import time
from pathlib import Path

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from genmojo_core.errors import GenmojoError
from genmojo_studio.worker.preview_bus import BusReader, BusWriter, size_of

ROOT = Path(__file__).resolve().parents[2]
WRITER = """
import sys, time, numpy as np
from genmojo_studio.worker.preview_bus import BusWriter
path, seconds = sys.argv[1], float(sys.argv[2])
dice = np.random.default_rng(0)
with BusWriter(path, 4 << 20) as bus:
    sys.stdout.write("ready\\n"); sys.stdout.flush()
    end, i, slowest = time.monotonic() + seconds, 0, 0.0
    while time.monotonic() < end:
        i += 1
        begun = time.monotonic()
        bus.publish({"i": i}, {"a": np.full(int(dice.integers(1, 250000)), i, np.uint64), "b": np.full(64, i, "f4")})
        slowest = max(slowest, time.monotonic() - begun)
sys.stdout.write(f"{i} {slowest}\\n")
"""


@given(
    st.lists(st.integers(0, 4000), min_size=1, max_size=12),
    st.lists(st.booleans(), min_size=12, max_size=12),
    st.sampled_from(["u1", "u2", "i8", "f2", "f4", "f8"]),
)
@settings(max_examples=40, deadline=None)
def test_the_latest_is_read_and_only_once(tmp_path_factory, sizes, reads, dtype):
    path = tmp_path_factory.mktemp("bus") / "a.bus"
    with BusWriter(path, 1 << 16) as writer:
        reader = BusReader(path)
        assert reader.latest() is None
        for i, (size, read) in enumerate(zip(sizes, reads, strict=False)):
            array = np.arange(size).astype(dtype)
            assert writer.publish({"i": i, "name": "ä"}, {"x": array, "none": np.zeros((0, 3), "f4")}) == i + 1
            if read:
                found = reader.latest()
                assert found.meta == {"i": i, "name": "ä"} and found.sequence == i + 1
                np.testing.assert_array_equal(found.arrays["x"], array)
                assert found.arrays["none"].shape == (0, 3) and abs(time.monotonic() - found.published) < 60
                assert reader.latest() is None
        assert not reader.closed
    assert reader.closed
    reader.close()


def test_what_was_read_stays_while_more_is_written(tmp_path):
    with BusWriter(tmp_path / "a.bus", 1 << 12) as writer:
        reader = BusReader(tmp_path / "a.bus")
        writer.publish({}, {"x": np.zeros(100)})
        kept = reader.latest().arrays["x"]
        for i in range(1, 9):
            writer.publish({}, {"x": np.full(100, float(i))})
        assert (kept == 0).all() and reader.latest().arrays["x"][0] == 8


def test_no_torn_read_and_no_waiting_writer(tmp_path):
    """Two readers in this process, a writer in another, megabytes at full speed: every copy is of one preview."""
    path = tmp_path / "a.bus"
    with subprocess.Popen(
        [sys.executable, "-c", WRITER, str(path), "4"], stdout=subprocess.PIPE, text=True, cwd=ROOT
    ) as child:
        child.stdout.readline()
        readers = [BusReader(path), BusReader(path)]
        seen = [0, 0]
        while child.poll() is None:
            for k, reader in enumerate(readers):
                found = reader.latest(attempts=2)
                if found is None:
                    continue
                i = found.meta["i"]
                assert (found.arrays["a"] == i).all() and (found.arrays["b"] == i).all() and found.sequence == i
                assert i > seen[k]
                seen[k] = i
        written, slowest = child.stdout.read().split()
    assert min(seen) > 20 and int(written) > 100, (seen, written)
    assert float(slowest) < 3.0  # of 4: it never waited for a reader, only for a busy machine


def test_a_disturbed_copy_is_noticed(tmp_path):
    """A slot that is being written, or whose bytes changed, is not given out."""
    path = tmp_path / "a.bus"
    with BusWriter(path, 1 << 12) as writer:
        reader = BusReader(path)
        writer.publish({}, {"x": np.zeros(100)})
        slot = int(writer._words[2])
        words = writer._slot_words(slot)
        words[0] += np.uint64(1)
        assert reader.latest() is None
        words[0] += np.uint64(1)
        writer._map[4096 + slot * writer.capacity + 200] ^= 1
        assert reader.latest() is None
        writer._map[4096 + slot * writer.capacity + 200] ^= 1
        assert reader.latest() is not None


def test_what_is_too_large_or_no_bus_is_refused(tmp_path):
    with BusWriter(tmp_path / "a.bus", 5000) as writer:
        large = {"x": np.zeros(2000)}
        assert not writer.fits({}, large) and size_of({}, large) > 8192
        with pytest.raises(GenmojoError):
            writer.publish({}, large)
        with pytest.raises(GenmojoError):
            writer.publish({}, {"x": np.array([None])})
    for content in (b"", b"x" * 100_000):
        (tmp_path / "b.bus").write_bytes(content)
        with pytest.raises(GenmojoError):
            BusReader(tmp_path / "b.bus")
    with pytest.raises(GenmojoError):
        BusReader(tmp_path / "c.bus")
