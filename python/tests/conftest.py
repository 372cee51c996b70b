# SPDX-License-Identifier: MIT
# Copyright (c) 2026 The nvm authors
import zlib

import numpy as np
import pytest


@pytest.fixture
def rng(request):
    """Random numbers seeded by the test's name."""
    return np.random.default_rng(zlib.crc32(request.node.name.encode()))
