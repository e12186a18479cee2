"""Where compiled kernels live, and how they are declared.

numba keeps compiled code on disk but judges its age by the kernel's own file only: it would go on using code made with
an older instruction (simd.py), an older inlined helper or an older constant. So the folder is named by a hash of every
source a kernel can contain, and of what compiles it; any change means another folder and a fresh compilation.
"""

from __future__ import annotations

import hashlib
import os
import platform
import sys
from collections.abc import Callable, Iterable
from functools import lru_cache
from pathlib import Path
from typing import Any

import llvmlite
import llvmlite.binding
import numba
from numba.core import types
from numba.core.caching import FunctionCache

from genmojo_core.kernels.pieces import KernelCompiler, PieceCompiler

PACKAGE = Path(__file__).resolve().parents[1]
SOURCES = (
    "kernels",
    "render/cpu",
    "scene/planes_cpu",
    "scene/motion_cpu",
    "render/rasterizer.py",
    "render/loss_limits.py",
)  # all that ends up in kernels

_JIT: Any = numba.njit  # its stub does not know every option
# Kernels only borrow their arrays, so nothing in them counts references (`_nrt`): that is a tenth of the compile time.
_OPTIONS = {"nogil": True, "error_model": "numpy", "no_cfunc_wrapper": True, "_nrt": False}


class KernelCache(FunctionCache):
    """Compiled code on disk, loaded without numba's library of array functions.

    numba would import and register it all before it looks for the code: two fifths of a start. Only a compilation needs
    it, and asks for it itself.
    """

    def load_overload(self, sig: Any, target_context: Any) -> Any:
        """The compiled code for a signature, None where there is none yet."""
        with self._guard_against_spurious_io_errors():
            return self._load_overload(sig, target_context)


def kernel(function: Callable) -> Any:
    """Compile on first call, without the interpreter lock, kept on disk where a folder can be written.

    A kernel makes and returns no arrays.
    """
    folder = cache_folder()
    if folder is None:
        return _JIT(pipeline_class=KernelCompiler, **_OPTIONS)(function)
    settings: Any = numba.config
    before = settings.CACHE_DIR
    settings.CACHE_DIR = str(folder)  # read while the function is declared, so it can be put back at once
    try:
        compiled = _JIT(pipeline_class=KernelCompiler, **_OPTIONS)(function)
        compiled._cache = KernelCache(function)
        return compiled
    finally:
        settings.CACHE_DIR = before


def inlined(function: Callable) -> Any:
    """A piece of a kernel: always inlined by LLVM, so that tuples and vectors stay in registers.

    It cannot be called from Python; leaving those wrappers out saves a fifth of the compile time.
    """
    piece = _JIT(forceinline=True, no_cpython_wrapper=True, pipeline_class=PieceCompiler, **_OPTIONS)(function)
    resolve = piece.get_call_template
    # numba would compile a piece anew for every constant it is called with; inlining finds those constants anyway
    piece.get_call_template = lambda arguments, named: resolve(tuple(types.unliteral(a) for a in arguments), named)
    return piece


def fingerprint(package: Path = PACKAGE) -> str:
    """Hexadecimal name of this state of the kernels: sources, numba, llvmlite, Python, processor."""
    digest = hashlib.sha256()
    for path in _files(package):
        digest.update(path.relative_to(package).as_posix().encode() + b"\0")
        digest.update(path.read_bytes() + b"\0")
    features = llvmlite.binding.get_host_cpu_features().flatten()
    machine = (numba.__version__, llvmlite.__version__, platform.python_version(), platform.machine(),
               llvmlite.binding.get_host_cpu_name(), features)  # fmt: skip
    digest.update("\0".join(machine).encode())
    return digest.hexdigest()[:24]


@lru_cache(maxsize=1)
def cache_folder() -> Path | None:
    """The folder of compiled kernels, made if need be; None where the user's cache folder cannot be written."""
    folder = user_cache() / "genmojo" / "kernels" / fingerprint()
    try:
        folder.mkdir(parents=True, exist_ok=True)
    except OSError:
        return None
    return folder if os.access(folder, os.W_OK) else None


def is_cold() -> bool:
    """True where nothing is compiled yet on this machine: the first use will take some seconds."""
    folder = cache_folder()
    return folder is None or next(folder.rglob("*.nbi"), None) is None


def user_cache() -> Path:
    """The user's cache folder by the custom of the system."""
    if sys.platform == "win32":
        return Path(os.environ.get("LOCALAPPDATA") or Path.home() / "AppData" / "Local")
    if sys.platform == "darwin":
        return Path.home() / "Library" / "Caches"
    return Path(os.environ.get("XDG_CACHE_HOME") or Path.home() / ".cache")


def _files(package: Path) -> Iterable[Path]:
    """The source files of `SOURCES` in a fixed order."""
    for name in SOURCES:
        place = package / name
        yield from [place] if place.suffix == ".py" else sorted(place.glob("*.py"))
