# SPDX-License-Identifier: GPL-3.0-or-later
"""All nasty inputs: each module adds its own to CASES, in the order of the page."""
import needles_and_sizes  # noqa: F401
import flat_and_thin  # noqa: F401
import arrangements  # noqa: F401
import spoilt  # noqa: F401
from cases import CASES  # noqa: F401
