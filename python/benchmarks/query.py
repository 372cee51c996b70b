# SPDX-License-Identifier: MIT
# Copyright (c) 2026 The nvm authors
"""Five neighbours of 100 000 points: nvm beside C++, scipy and small_gicp, in one run.

usage: query.py [ROUNDS]

All answer the same queries on the same points (those that nvm stores), one thread each; each figure
is CPU time, the best of ROUNDS (9) rounds, in which they take turns. The loop in C++ (query.cpp) is
built here, by $CXX (c++) with -O3 as the package is; Eigen is looked for in $EIGEN_INCLUDE.
"""

import os
import pathlib
import subprocess
import sys
import tempfile
import time

import numpy as np
import small_gicp
from scipy.spatial import cKDTree

import nvm

COUNT = 100_000
K = 5
HERE = pathlib.Path(__file__).parent


def room(rng, count):
    """Points on the faces of a room of 20 x 15 x 4 m, with their normals."""
    half = np.array([10.0, 7.5, 2.0])
    points = rng.uniform(-half, half, (count, 3))
    axis, sign = rng.integers(0, 3, count), rng.choice([-1.0, 1.0], count)
    points[np.arange(count), axis] = sign * half[axis] + rng.normal(0, 0.01, count)
    normals = np.zeros((count, 3))
    normals[np.arange(count), axis] = -sign
    return points, normals


class InCpp:
    """The C++ program, which holds the map and the queries and answers when asked."""

    def __init__(self, folder, map_file, queries, normals):
        np.hstack([queries, normals]).tofile(folder / "queries")
        eigen = os.environ.get("EIGEN_INCLUDE", "/usr/include/eigen3")
        include = ["-I", HERE.parents[1] / "include", "-isystem", eigen]
        compiler = [os.environ.get("CXX", "c++"), "-std=c++17", "-O3", "-DNDEBUG"]
        subprocess.run([*compiler, *include, HERE / "query.cpp", "-o", folder / "query"], check=True)
        command = [folder / "query", map_file, folder / "queries"]
        self._process = subprocess.Popen(command, stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True)

    def __call__(self):
        """CPU time [s] and the sum of all distances."""
        self._process.stdin.write("\n")
        self._process.stdin.flush()
        return map(float, self._process.stdout.readline().split())


def here(function):
    """The same of a function of this process, which returns distances."""

    def measured():
        begin = time.process_time()
        distances = np.asarray(function())
        seconds = time.process_time() - begin
        return seconds, distances[np.isfinite(distances)].sum()

    return measured


def contestants(rng, folder):
    """Functions that answer the queries, by name."""
    voxel_map = nvm.VoxelMap()
    voxel_map.insert(*room(rng, 300_000))
    voxel_map.save(folder / "map.nvm")
    voxel_map = nvm.load(folder / "map.nvm")
    stored = voxel_map.points
    queries, normals = room(rng, COUNT)
    tree = cKDTree(stored)
    gicp_tree = small_gicp.KdTree(small_gicp.PointCloud(stored), num_threads=1)
    return len(voxel_map), {
        "nvm in C++, with normals": InCpp(folder, folder / "map.nvm", queries, normals),
        "nvm, with normals": here(lambda: voxel_map.nearest(queries, normals, k=K, threads=1)[0]),
        "nvm, without normals": here(lambda: voxel_map.nearest(queries, k=K, threads=1)[0]),
        "small_gicp KdTree": here(lambda: np.sqrt(gicp_tree.batch_knn_search(queries, K, num_threads=1)[1])),
        "scipy cKDTree": here(lambda: tree.query(queries, K, distance_upper_bound=1.0)[0]),
    }


def main(rounds):
    with tempfile.TemporaryDirectory() as folder:
        size, functions = contestants(np.random.default_rng(1), pathlib.Path(folder))
        best, sums = dict.fromkeys(functions, np.inf), {}
        for _ in range(rounds):
            for name, function in functions.items():
                seconds, sums[name] = function()
                best[name] = min(best[name], seconds)
    reference, *others = functions
    assert np.isclose(sums[reference], sums[others[0]], rtol=1e-12), sums
    print(f"{K} neighbours of {COUNT} points in {size} points")
    for name, seconds in best.items():
        print(f"{name:<30} {1e3 * seconds:8.1f} ms  {seconds / best[reference]:6.2f}")


if __name__ == "__main__":
    main(int(sys.argv[1]) if len(sys.argv) > 1 else 9)
