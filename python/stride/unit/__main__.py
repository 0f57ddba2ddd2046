"""`python -m stride.unit`."""

import sys

from ._packing import command

sys.exit(command(sys.argv[1:]))
