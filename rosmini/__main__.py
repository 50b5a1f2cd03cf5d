"""`python -m rosmini` is the `rosmini` command."""

import sys

from rosmini.cli.main import main

sys.exit(main())
