# SPDX-License-Identifier: MIT
# Copyright (c) 2026 The nvm authors
"""Scans and oracles that several tests share."""

import subprocess
import sys

import numpy as np


def nvm(*arguments):
    """The command of the package, on the package that is tested."""
    return subprocess.run(
        [sys.executable, "-c", "import sys; from nvm_command import main; sys.exit(main())", *map(str, arguments)],
        capture_output=True,
        text=True,
        timeout=300,
    )


def unit(vectors):
    return vectors / np.linalg.norm(vectors, axis=-1, keepdims=True)


def wall(rng, count, y, normal_y, extent=4.0):
    """Points of a wall at `y` [m] and their normals, which look along `normal_y`."""
    points = rng.uniform(-extent, extent, (count, 3))
    points[:, 1] = y
    normals = np.tile([0.0, normal_y, 0.0], (count, 1))
    return points, normals


def brute_force(stored, query, k, max_distance, allowed=None):
    """Distances and rows of the k nearest of `stored`, ascending."""
    distances = np.linalg.norm(stored - query, axis=1)
    if allowed is not None:
        distances = np.where(allowed, distances, np.inf)
    rows = np.argsort(distances, kind="stable")[:k]
    rows = rows[distances[rows] <= max_distance]
    return distances[rows], rows


def box_room(rng, count, size=(8.0, 6.0, 3.0), noise=0.0):
    """Points on the six faces of a room around the origin."""
    half = np.asarray(size) / 2
    points = rng.uniform(-half, half, (count, 3))
    face = rng.integers(0, 6, count)
    axis, sign = face // 2, np.where(face % 2, 1.0, -1.0)
    points[np.arange(count), axis] = sign * half[axis] + rng.normal(0.0, 1.0, count) * noise
    return points


def pose(yaw=0.0, translation=(0.0, 0.0, 0.0)):
    """T (4, 4): a turn about z [rad], then a translation [m]."""
    T = np.eye(4)
    T[:2, :2] = [[np.cos(yaw), -np.sin(yaw)], [np.sin(yaw), np.cos(yaw)]]
    T[:3, 3] = translation
    return T
