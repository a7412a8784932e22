"""`python -m popsim` is the command `popsim`."""

from popsim.cli import main

main()
