# SPDX-License-Identifier: MIT
# Copyright (c) 2026 The nvm authors
import numpy as np
import pytest
from support import box_room, pose

import nvm


def plane_of(points):
    """The unit normal of the least-squares plane of `points`."""
    return np.linalg.svd(points - points.mean(axis=0))[2][2]


def test_normals_are_those_of_the_neighbourhoods(rng):
    points = box_room(rng, 6000, noise=0.005)
    result = nvm.NormalEstimator(min_radius=0.3, max_radius=0.3).estimate(points)
    checked = 0
    for i in range(0, len(points), 50):
        neighbors = points[np.linalg.norm(points - points[i], axis=1) <= 0.3]
        if result.status[i] == 0:
            expected = plane_of(neighbors)
            assert abs(result.normals[i] @ expected) > 1 - 1e-4
            assert result.normals[i] @ points[i] <= 0  # looks back at the origin
            checked += 1
    assert checked > 60


def test_normals_follow_the_viewpoint(rng):
    points = box_room(rng, 3000)
    inside = nvm.estimate_normals(points, viewpoint=(0, 0, 0), min_radius=0.5, max_radius=0.5)
    per_point = nvm.estimate_normals(
        points, viewpoint=np.zeros((3000, 3)), min_radius=0.5, max_radius=0.5
    )
    assert inside.dtype == np.float32 and np.array_equal(inside, per_point)
    valid = inside.any(axis=1)
    assert valid.mean() > 0.3
    assert np.allclose(np.linalg.norm(inside[valid], axis=1), 1, atol=1e-5)


def test_a_point_without_a_normal_says_why():
    points = np.array([[np.nan, 0, 0], [0.01, 0, 0], [500, 0, 0], [5, 5, 5]])
    result = nvm.NormalEstimator().estimate(points)
    names = [result.STATUS[s] for s in result.status]
    assert names == ["non_finite", "too_near", "too_far", "few_neighbors"]
    assert not result.normals.any()


def test_threads_change_nothing(rng):
    points = box_room(rng, 20000, noise=0.01)
    estimator = nvm.NormalEstimator()
    one, two = (estimator.estimate(points, threads=t) for t in (1, 2))
    assert np.array_equal(one.normals, two.normals)


def test_bad_options_are_refused():
    with pytest.raises(ValueError, match="max_radius"):
        nvm.NormalEstimator(max_radius=-1.0)
    with pytest.raises(TypeError, match="unknown option '"):
        nvm.estimate_normals(np.zeros((1, 3)), radius=1.0)
    with pytest.raises(ValueError, match="viewpoint"):
        nvm.estimate_normals(np.zeros((1, 3)), viewpoint=(0, 0))
    with pytest.raises(ValueError, match="viewpoint must be finite"):
        nvm.estimate_normals(np.zeros((1, 3)), viewpoint=(0, np.nan, 0))


def test_a_scan_is_aligned_to_the_map(rng):
    points = box_room(rng, 30000, noise=0.002)
    voxel_map = nvm.VoxelMap()
    voxel_map.insert(points, nvm.estimate_normals(points))
    T = pose(0.03, (0.10, -0.05, 0.04))
    scan = (box_room(rng, 5000, noise=0.002) - T[:3, 3]) @ T[:3, :3]
    origin = -T[:3, 3] @ T[:3, :3]
    normals = nvm.estimate_normals(scan, origin, min_radius=0.3, max_radius=0.5)
    result = nvm.ScanAligner().align(voxel_map, scan, normals)
    assert result.status == "converged" and result.degenerate_directions == 0
    assert np.allclose(result.T_map_scan, T, atol=3e-3)
    assert result.inlier_share > 0.6 and result.information.shape == (6, 6)


def test_a_scan_that_fits_nowhere_keeps_the_start(rng):
    start = pose(0.1, (50.0, 0.0, 0.0))
    result = nvm.ScanAligner().align(
        nvm.VoxelMap(), np.zeros((10, 3)), np.tile([0.0, 0, 1], (10, 1)), start
    )
    assert result.status == "too_few_residuals" and np.array_equal(result.T_map_scan, start)
    with pytest.raises(ValueError, match="max_iterations"):
        nvm.ScanAligner(max_iterations=0)
