# SPDX-License-Identifier: MIT
# Copyright (c) 2026 The nvm authors
"""Arrays of any kind are read rightly or refused, and nothing crashes."""

import gc
import os
import threading

import numpy as np
import pytest
from support import wall

import nvm


def forms_of(points):
    """The same numbers in arrays of other layouts."""
    wide = np.zeros((len(points), 7))
    wide[:, 1:6:2] = points
    packed = np.zeros(len(points), [("tag", "u1"), ("p", "f8", 3)])
    packed["p"] = points
    read_only = points.copy()
    read_only.flags.writeable = False
    return {
        "fortran": np.asfortranarray(points),
        "reversed": points[::-1].copy()[::-1],
        "mirrored": points[:, ::-1].copy()[:, ::-1],
        "columns": wide[:, 1:6:2],
        "packed": packed["p"],
        "big endian": points.astype(">f8"),
        "list": points.tolist(),
        "read only": read_only,
        "float128": points.astype(np.longdouble),
    }


@pytest.fixture
def cloud(rng):
    points, normals = wall(rng, 400, 0.1, 1.0)
    return points, normals


@pytest.mark.parametrize("form", sorted(forms_of(np.zeros((1, 3)))))
def test_every_layout_gives_the_same(cloud, form):
    points, normals = cloud
    plain = nvm.VoxelMap()
    plain.insert(points, normals)
    other = nvm.VoxelMap()
    other.insert(forms_of(points)[form], forms_of(normals)[form])
    assert len(plain) > 0 and np.array_equal(plain.points, other.points)
    expected = plain.nearest(points, normals)
    found = other.nearest(forms_of(points)[form], forms_of(normals)[form])
    assert all(np.array_equal(a, b) for a, b in zip(expected, found))


def test_float32_and_whole_numbers_are_read(cloud):
    points, normals = cloud
    single, double = nvm.VoxelMap(), nvm.VoxelMap()
    single.insert(points.astype(np.float32), normals.astype(np.float32))
    double.insert(points.astype(np.float32).astype(np.float64), normals)
    assert np.array_equal(single.points, double.points)
    whole = nvm.VoxelMap()
    whole.insert(np.array([[1, 2, 3]], np.int16), [[0, 0, 1]])
    assert np.allclose(whole.points, [[1, 2, 3]], atol=1e-4)


def test_a_broadcast_row_is_read():
    voxel_map = nvm.VoxelMap()
    points = np.arange(30.0).reshape(10, 3)
    stats = voxel_map.insert(points, np.broadcast_to([0.0, 0.0, 1.0], (10, 3)))
    assert stats.stored == 10


@pytest.mark.parametrize(
    "points",
    [
        np.zeros(3),
        np.zeros((4, 2)),
        np.zeros((4, 4)),
        np.zeros((2, 4, 3)),
        np.float64(1.0),
        np.zeros((4, 3), complex),
        np.zeros((4, 3), bool),
        np.array([["a", "b", "c"]]),
        np.array([[object()] * 3]),
        [[1.0, 2.0], [1.0, 2.0, 3.0]],
        "points",
        None,
    ],
    ids=str,
)
def test_other_arrays_are_refused(points):
    voxel_map = nvm.VoxelMap()
    with pytest.raises(ValueError, match="nvm: points"):
        voxel_map.nearest(points)
    with pytest.raises(ValueError, match="nvm: points"):
        voxel_map.insert(points, np.zeros((4, 3)))
    with pytest.raises(ValueError, match="nvm: points"):
        nvm.estimate_normals(points)


def test_masked_elements_are_refused_and_masks_without_any_read(cloud):
    """numpy.asarray drops a mask, and what was struck out would be in the map without a word."""
    points, normals = cloud
    voxel_map = nvm.VoxelMap()
    assert voxel_map.insert(np.ma.array(points), normals).stored > 0
    struck_out = np.ma.masked_greater(points, 3.0)
    for call in (
        lambda: voxel_map.insert(struck_out, normals),
        lambda: voxel_map.insert(points, np.ma.masked_less(normals, 0.5)),
        lambda: voxel_map.nearest(struck_out),
        lambda: nvm.estimate_normals(struck_out),
    ):
        with pytest.raises(ValueError, match="has masked elements"):
            call()
    filled = voxel_map.insert(np.ma.filled(struck_out, np.nan), normals)
    assert filled.non_finite == (points > 3.0).any(axis=1).sum() > 0


@pytest.mark.parametrize("empty", [[], np.zeros((0, 3)), np.zeros((0, 3), np.float32)], ids=repr)
def test_empty_arrays_give_empty_results(empty):
    voxel_map = nvm.VoxelMap()
    assert voxel_map.insert(empty, empty).stored == 0
    distances, indices, counts = voxel_map.nearest(empty, empty, k=3)
    assert distances.shape == indices.shape == (0, 3) and counts.shape == (0,)
    assert nvm.estimate_normals(empty).shape == (0, 3)
    assert nvm.view_directions(empty, (0, 0, 0)).shape == (0, 3)
    assert voxel_map.points.shape == voxel_map.normals.shape == (0, 3)


def test_empty_map_finds_nothing():
    distances, indices, counts = nvm.VoxelMap().nearest(np.zeros((2, 3)), k=1)
    assert np.isinf(distances).all() and not indices.any() and not counts.any()


def test_unequal_lengths_are_refused(cloud):
    points, normals = cloud
    with pytest.raises(ValueError, match="normals has 399 rows, but points has 400"):
        nvm.VoxelMap().insert(points, normals[1:])
    with pytest.raises(ValueError, match="normals"):
        nvm.VoxelMap().nearest(points, normals[1:])
    with pytest.raises(ValueError, match="viewpoint"):
        nvm.estimate_normals(points, normals[1:])


@pytest.mark.parametrize("k, distance", [(0, 1), (5, -1), (5, np.nan)])
def test_impossible_searches_are_refused(cloud, k, distance):
    with pytest.raises(ValueError):
        nvm.VoxelMap().nearest(cloud[0], k=k, max_distance=distance)


@pytest.mark.parametrize("radius", [-1.0, np.nan])
@pytest.mark.parametrize("method", ["within", "erase_within", "erase_voxels_beyond"])
def test_radii_that_are_none_are_refused(cloud, method, radius):
    voxel_map = nvm.VoxelMap()
    voxel_map.insert(*cloud)
    before = len(voxel_map)
    with pytest.raises(ValueError, match="radius"):
        getattr(voxel_map, method)((0, 0, 0), radius)
    assert len(voxel_map) == before


def test_what_an_array_throws_is_said_in_one_line():
    class Broken:
        def __array__(self, *_, **__):
            raise RuntimeError("no points today")

    with pytest.raises(ValueError, match="points is no array of numbers: no points today$"):
        nvm.VoxelMap().nearest(Broken())


def test_paths_are_those_of_the_system(cloud, tmp_path):
    voxel_map = nvm.VoxelMap()
    voxel_map.insert(*cloud)
    named = os.fsencode(tmp_path) + b"/\xff.nvm"  # no UTF-8
    for path in (tmp_path / "map.nvm", str(tmp_path / "map.nvm"), named, os.fsdecode(named)):
        voxel_map.save(path)
        assert len(nvm.load(path)) == len(voxel_map)
    for other in (5, None, ["map.nvm"]):
        with pytest.raises(TypeError):
            voxel_map.save(other)
        with pytest.raises(TypeError):
            nvm.load(other)
    with pytest.raises(ValueError, match="null"):
        voxel_map.save(f"{tmp_path}/a\0b")
    with pytest.raises((RuntimeError, ValueError)):
        nvm.load(named + b".lost")


def test_an_infinite_distance_means_no_limit(cloud):
    voxel_map = nvm.VoxelMap()
    voxel_map.insert(*cloud)
    near, far = (voxel_map.nearest(cloud[0], max_distance=d) for d in (100.0, np.inf))
    assert all(np.array_equal(a, b) for a, b in zip(near, far))


@pytest.mark.parametrize(
    "pose",
    [np.eye(3), np.zeros((4, 4)), 2 * np.eye(4), np.diag([1, 1, -1, 1]), np.full((4, 4), np.nan), "T"],
    ids=str,
)
def test_poses_that_are_none_are_refused(cloud, pose):
    voxel_map = nvm.VoxelMap()
    with pytest.raises(ValueError, match="T_map_scan"):
        voxel_map.insert(*cloud, pose)
    assert len(voxel_map) == 0


def test_queries_that_are_not_finite_find_nothing(cloud):
    voxel_map = nvm.VoxelMap()
    voxel_map.insert(*cloud)
    queries = np.array([[np.nan, 0, 0], [np.inf, 0, 0], [1e300, 0, 0], cloud[0][0]])
    assert list(voxel_map.nearest(queries, k=1)[2]) == [0, 0, 0, 1]


def test_arrays_outlive_the_map(cloud):
    voxel_map = nvm.VoxelMap()
    voxel_map.insert(*cloud)
    points, before = voxel_map.points, voxel_map.points.copy()
    distances = voxel_map.nearest(cloud[0])[0]
    del voxel_map
    gc.collect()
    assert np.array_equal(points, before) and np.isfinite(distances[:, 0]).all()


def test_changes_and_queries_from_many_threads(rng):
    voxel_map = nvm.VoxelMap(capacity=2000)
    failures = []

    def work(seed):
        own = np.random.default_rng(seed)
        for _ in range(20):
            points, normals = wall(own, 5000, 0.1, 1.0, 20.0)
            voxel_map.insert(points, normals)
            distances, indices, counts = voxel_map.nearest(points, normals, k=4)
            if not (np.diff(distances[counts == 4]) >= 0).all() or indices.max() > 10**7:
                failures.append(seed)
            voxel_map.erase_within(points[0], 1.0)
            assert len(voxel_map.points) >= 0

    threads = [threading.Thread(target=work, args=(seed,)) for seed in range(4)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    assert not failures and voxel_map.stats().voxels <= 2000


def test_an_uninitialised_map_is_refused():
    with pytest.warns(RuntimeWarning), pytest.raises(TypeError):
        nvm.VoxelMap.__new__(nvm.VoxelMap).insert([], [])
