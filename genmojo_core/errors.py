"""One error type for everything a user or a file can cause.

A `GenmojoError` carries a stable code, what is wrong, where, and what to do. The command line prints `sentence()` and
exits 2; the app shows the same sentence in a dialog. A fault that is ours is any other exception.
"""

from __future__ import annotations

from typing import Literal

Code = Literal[
    "argument",  # a command-line value or option
    "config",  # a preset or configuration value
    "io",  # a file or folder that cannot be read or written
    "format",  # contents are not what the name or magic bytes say
    "schema",  # a channel, dataset or key of another name, rank, dtype or size
    "value",  # numbers out of range or not finite
    "size",  # declared or real size over a limit (clip/limits.py)
    "empty",  # nothing there: no frame, no object, no valid depth
    "camera",  # intrinsics or poses that are no camera
    "video",  # a container or codec that cannot be decoded
    "unsafe_pickle",  # a file that would run code when read
    "hdf5_link",  # external, virtual or soft links in an HDF5 file
    "corrupt",  # a checksum does not match
    "version",  # a file of a newer format
    "missing_package",  # an optional package or local model is not there
    "budget",  # would need more memory or time than allowed
    "numeric",  # the optimisation cannot go on (repeated non-finite steps)
]


class GenmojoError(Exception):
    """A fault in the input, told in one sentence.

    Args:
        code: stable machine-readable code.
        what: what is wrong, without a full stop, e.g. "the mask is 128 x 96 but its frame is 256 x 192".
        where: file, folder, dataset or option it is about; empty if there is none.
        hint: what to do about it, as an imperative; empty if there is nothing to say.
    """

    def __init__(self, code: Code, what: str, where: str = "", hint: str = "") -> None:
        self.code: Code = code
        self.what = what
        self.where = str(where)
        self.hint = hint
        super().__init__(self.sentence())

    def sentence(self) -> str:
        """The whole message on one line: where, what, what to do."""
        text = f"{self.where}: {self.what}" if self.where else self.what
        if self.hint:
            text = f"{text}; {self.hint}"
        return " ".join(text.split()) + "."
