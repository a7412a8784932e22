"""The command line: parses options, makes one library call, prints what came of it.

Exit codes: 0 success, 1 a design failed verification, 2 something about the input, the options or the output
folder is wrong; then one line on stderr says what.
"""

import gc
import os
import sys
from typing import NoReturn

THREADS = "OPENBLAS_NUM_THREADS"
"""Environment variable of numpy's linear algebra, read at its import."""


def main() -> NoReturn:
    """Run the command `popsim`.

    Matrices here are small and many: threads would wait for each other, and cost thirty times what they gain.
    """
    os.environ.setdefault(THREADS, "1")
    from popsim.errors import PopsimError
    from popsim.garbage import seldom_collected

    try:
        with seldom_collected():
            from popsim.cli.app import app

            app(prog_name="popsim")
    except PopsimError as error:
        sys.stderr.write(f"popsim: {' '.join(str(error).split())}\n")
        sys.exit(2)
    except KeyboardInterrupt:
        sys.stderr.write("popsim: interrupted\n")
        sys.exit(130)
    finally:
        gc.freeze()  # Python looks for garbage thrice as it ends, for more than a second
    sys.exit(0)
