"""The program: ``wildpoint`` and ``python -m wildpoint``."""

import signal
import sys

from . import _wildpoint


def main() -> int:
    # The program has its own answers to signals; those of Python would only be heard when it has ended.
    signal.signal(signal.SIGINT, signal.SIG_DFL)
    return _wildpoint.main(["wildpoint", *sys.argv[1:]])


if __name__ == "__main__":
    sys.exit(main())
