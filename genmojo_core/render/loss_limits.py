"""Limits of the data terms, shared by plain torch and the kernels (optimise/losses.py says what they are for)."""

SHOWN = 0.5  # share by which a pixel shows its own object, or any
LABEL_FLOOR = 1e-2  # of a label's share: below, the logarithm goes on as its tangent
ALPHA_FLOOR = 1e-4  # coverage under which a depth says nothing
FEWEST = 16  # pixels with depth that an object needs
GUESSED_DEPTH = 0.1  # weight of a guessed depth's shape against a measured depth's value
FLOW_LIMIT = 10.0  # flow errors above this many percent of the diagonal are taken for wrong flow
