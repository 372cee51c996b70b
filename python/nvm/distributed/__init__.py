# SPDX-License-Identifier: MIT
# Copyright (c) 2026 The nvm authors
"""Maps that outgrow one machine: built in tiles by the workers of a Dask cluster.

``pip install nvm[distributed]``; docs/living_maps.md has an example, the format and a real cluster.
"""

from .build import build
from .session import Session

__all__ = ["Session", "build"]
