# SPDX-License-Identifier: MIT
# Copyright (c) 2026 The nvm authors
"""What a map is built from: scans with poses."""

from __future__ import annotations

import io
from dataclasses import dataclass
from pathlib import Path
from typing import Sequence

import numpy as np

from ..folders import is_url, read_url


@dataclass(frozen=True)
class Session:
    """One recording whose poses are known.

    Attributes
    ----------
    scans : sequence
        Each a path or a URL of a ``.npy`` file that every worker can read, or an array: (N, 3) [m],
        in the sensor's frame, deskewed.
    poses : (K, 4, 4) float
        T_map_scan of each scan.
    """

    scans: Sequence
    poses: np.ndarray

    def __post_init__(self):
        poses = np.asarray(self.poses, dtype=float)
        if poses.ndim != 3 or poses.shape[1:] != (4, 4):
            raise ValueError(f"poses must be (K, 4, 4), not {poses.shape}")
        if len(poses) != len(self.scans):
            raise ValueError(f"there are {len(self.scans)} scans and {len(poses)} poses")
        bad = np.flatnonzero(~np.isfinite(poses).all(axis=(1, 2)))
        if len(bad):
            raise ValueError(f"the pose of scan {bad[0]} is not finite")
        object.__setattr__(self, "poses", poses)


def read_scan(scan) -> np.ndarray:
    """(N, 3) float32 [m]; ValueError or OSError, naming the file, when it is none."""
    name = scan if isinstance(scan, (str, Path)) else "a scan"
    points = read_array(scan) if isinstance(scan, (str, Path)) else np.asarray(scan)
    if points.ndim != 2 or points.shape[1] < 3 or not np.issubdtype(points.dtype, np.number):
        raise ValueError(f"{name}: must be (N, 3) numbers, not {points.dtype} {points.shape}")
    return np.ascontiguousarray(points[:, :3], dtype=np.float32)


def read_array(file) -> np.ndarray:
    """What the ``.npy`` file at a path or URL holds."""
    source = io.BytesIO(read_url(file)) if is_url(file) else file
    try:
        return np.load(source, allow_pickle=False)
    except (ValueError, EOFError) as error:
        raise ValueError(f"{file}: is no .npy file, or is damaged: {error}") from error
