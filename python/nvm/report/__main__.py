# SPDX-License-Identifier: MIT
# Copyright (c) 2026 The nvm authors
"""usage: python -m report FOLDER: draws what nvm evaluate has left there."""

import sys

from . import write_report

if len(sys.argv) != 2:
    sys.exit(__doc__)
try:
    for path in write_report(sys.argv[1]):
        print(path)
except (RuntimeError, OSError) as error:
    sys.exit(f"nvm: {error}")
