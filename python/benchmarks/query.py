# SPDX-License-Identifier: MIT
# Copyright (c) 2026 The nvm authors
"""Five neighbours of 100 000 points: nvm beside scipy and small_gicp, in one run.

usage: query.py [ROUNDS]

All answer the same queries on the same points (those that nvm stores), one thread each; each figure
is CPU time, the best of ROUNDS (9) rounds, in which they take turns.
"""

import sys
import time

import numpy as np
import small_gicp
from scipy.spatial import cKDTree

import nvm

COUNT = 100_000
K = 5


def room(rng, count):
    """Points on the faces of a room of 20 x 15 x 4 m, with their normals."""
    half = np.array([10.0, 7.5, 2.0])
    points = rng.uniform(-half, half, (count, 3))
    axis, sign = rng.integers(0, 3, count), rng.choice([-1.0, 1.0], count)
    points[np.arange(count), axis] = sign * half[axis] + rng.normal(0, 0.01, count)
    normals = np.zeros((count, 3))
    normals[np.arange(count), axis] = -sign
    return points, normals


def contestants(rng):
    """Functions that answer the queries, by name."""
    voxel_map = nvm.VoxelMap()
    voxel_map.insert(*room(rng, 300_000))
    stored = voxel_map.points
    queries, normals = room(rng, COUNT)
    tree = cKDTree(stored)
    gicp_tree = small_gicp.KdTree(small_gicp.PointCloud(stored), num_threads=1)
    return len(voxel_map), {
        "nvm, with normals": lambda: voxel_map.nearest(queries, normals, k=K, threads=1),
        "nvm, without normals": lambda: voxel_map.nearest(queries, k=K, threads=1),
        "scipy cKDTree": lambda: tree.query(queries, K, distance_upper_bound=1.0),
        "small_gicp KdTree": lambda: gicp_tree.batch_knn_search(queries, K, num_threads=1),
    }


def main(rounds):
    size, functions = contestants(np.random.default_rng(1))
    best = dict.fromkeys(functions, np.inf)
    for _ in range(rounds):
        for name, function in functions.items():
            begin = time.process_time()
            function()
            best[name] = min(best[name], time.process_time() - begin)
    print(f"{K} neighbours of {COUNT} points in {size} points")
    for name, seconds in best.items():
        print(f"{name:<30} {1e3 * seconds:8.1f} ms  {seconds / best['nvm, with normals']:6.2f}")


if __name__ == "__main__":
    main(int(sys.argv[1]) if len(sys.argv) > 1 else 9)
