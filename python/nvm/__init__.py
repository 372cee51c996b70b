# SPDX-License-Identifier: MIT
# Copyright (c) 2026 The nvm authors
"""A LiDAR voxel map that tells the two faces of a thin wall apart, and odometry on it.

Metres, seconds, radians. ``T_map_scan`` maps scan coordinates to map coordinates. Normals have unit
length and look back at the sensor. ``ValueError`` is for what a call was given, ``RuntimeError`` for
files.
"""

from ._nvm import (
    AlignResult,
    FrameResult,
    InsertStats,
    MapStats,
    NormalEstimator,
    NormalResult,
    Odometry,
    Scan,
    ScanAligner,
    ScanStream,
    VoxelMap,
    __version__,
    estimate_normals,
    load,
    view_directions,
)
from .commands import evaluate, export, simulate
from .store import Store, open_store
from .walls import survey

__all__ = [
    "AlignResult",
    "FrameResult",
    "InsertStats",
    "MapStats",
    "NormalEstimator",
    "NormalResult",
    "Odometry",
    "Scan",
    "ScanAligner",
    "ScanStream",
    "Store",
    "VoxelMap",
    "__version__",
    "estimate_normals",
    "evaluate",
    "export",
    "load",
    "open_store",
    "simulate",
    "survey",
    "view_directions",
]
