"""The child process that turns a torch `.bin` into safetensors: tensors by name, and nothing else of what it holds.

    python -m genmojo_core.priors.bin_weights_process WEIGHTS.bin WEIGHTS.safetensors

Exit 0: written; 3: the file asks for more than tensors; 2: it cannot be read.
"""

from __future__ import annotations

import pickle
import sys
from collections.abc import Sequence

import torch
from safetensors.torch import save_file


def main(arguments: Sequence[str]) -> int:
    """Convert one file."""
    source, target = arguments
    try:
        held = torch.load(source, map_location="cpu", weights_only=True)
        save_file({name: value.contiguous().clone() for name, value in held.items()}, target)
    except pickle.UnpicklingError:
        sys.stderr.write("holds more than tensors, which could run code when read\n")
        return 3
    except (OSError, RuntimeError, EOFError, AttributeError, ValueError, TypeError) as error:
        sys.stderr.write(f"holds no tensors by name ({type(error).__name__})\n")
        return 2
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
