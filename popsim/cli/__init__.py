"""The command line: parses options, makes one library call, prints what came of it.

Exit codes: 0 success, 1 a design failed verification, 2 something about the input, the options or the output
folder is wrong; then one line on stderr says what.
"""

import sys
from typing import NoReturn


def main() -> NoReturn:
    """Run the command `popsim`."""
    from popsim.cli.app import app
    from popsim.errors import PopsimError

    try:
        app(prog_name="popsim")
    except PopsimError as error:
        sys.stderr.write(f"popsim: {' '.join(str(error).split())}\n")
        sys.exit(2)
    except KeyboardInterrupt:
        sys.stderr.write("popsim: interrupted\n")
        sys.exit(130)
    sys.exit(0)
