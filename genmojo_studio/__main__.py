"""`python -m genmojo_studio [PATH]`."""

from __future__ import annotations

import sys

from genmojo_studio.app import main

if __name__ == "__main__":
    sys.exit(main())
