# SPDX-License-Identifier: GPL-3.0-or-later
"""`python -m ccdm_batch`."""

import sys

from ccdm_batch.cli import main

if __name__ == "__main__":
    sys.exit(main())
