"""Threads that draw give way to an optimiser, and so do the helpers they share with threads that were in a hurry."""

import subprocess
import sys

import pytest

PROGRAM = """
import os, threading, time
from genmojo_core.kernels import threads
from genmojo_studio.background import give_way
threads.set_threads(3)
together = threading.Barrier(3)
threads.run_jobs(lambda _: together.wait(60), 3)  # starts both helpers
def nice(one):
    return os.getpriority(os.PRIO_PROCESS, one.native_id)
helpers = [one for one in threading.enumerate() if one.name.startswith(threads.HELPERS)]
before = [nice(one) for one in helpers]
drawing = threading.Thread(target=lambda: (give_way(), print(nice(threading.current_thread()))))
drawing.start()
drawing.join()
print(*before, *(nice(one) for one in helpers), nice(threading.main_thread()))
"""


@pytest.mark.skipif(sys.platform != "linux", reason="threads have a priority of their own on Linux only")
def test_the_helpers_of_a_drawing_thread_give_way_with_it():
    said = subprocess.run([sys.executable, "-c", PROGRAM], capture_output=True, text=True, timeout=120, check=True)
    own, *before, first, second, main = map(int, said.stdout.split())
    assert before == [main, main]  # as this test was started
    assert (own, first, second) == (max(10, main),) * 3
