"""Loops over cells and pixels: what fitting does thousands of times, in machine code.

Numba compiles each function when it is first called, and keeps what it made beside the file, or in the user's
cache where it may not write there: the first design after an installation takes some seconds longer, unless
``python -m popsim.fitting.kernels`` ran before. Import these modules where they are used, since Numba itself takes
a third of a second.
"""
