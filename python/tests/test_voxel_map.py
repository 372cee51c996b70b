# SPDX-License-Identifier: MIT
# Copyright (c) 2026 The nvm authors
import copy
import pickle

import numpy as np
import pytest
from support import brute_force, pose, unit, wall

import nvm

STEP = 1e-4  # [m]: positions are stored, and queries rounded, to 1/8192 of a voxel


def thin_wall(rng, **options):
    """A wall of 5 cm, both faces seen."""
    voxel_map = nvm.VoxelMap(**options)
    voxel_map.insert(*wall(rng, 4000, 0.10, -1.0))
    voxel_map.insert(*wall(rng, 4000, 0.15, 1.0))
    return voxel_map


def test_every_point_is_stored_or_counted(rng):
    points, normals = wall(rng, 1000, 0.1, -1.0)
    points[0], normals[1] = np.nan, 0.0
    stats = nvm.VoxelMap().insert(points, normals)
    assert (stats.non_finite, stats.no_normal) == (1, 1)
    rest = stats.stored + stats.too_close + stats.surface_full + stats.out_of_range + stats.map_full
    assert rest == 998


def test_counts_say_what_they_are(rng):
    voxel_map = nvm.VoxelMap()
    stats = voxel_map.insert(*wall(rng, 50, 0.1, -1.0))
    assert f"{stats}".startswith(f"<nvm.InsertStats: stored {stats.stored}, ") and "map_full" not in f"{stats}"
    assert f"{nvm.VoxelMap().insert([], [])}" == "<nvm.InsertStats>"
    assert f"{voxel_map.stats()}".startswith(f"<nvm.MapStats: points {len(voxel_map)}, voxels ")


def test_contents_are_rows_of_equal_number(rng):
    voxel_map = thin_wall(rng)
    count = len(voxel_map)
    assert voxel_map.points.shape == (count, 3) and voxel_map.points.dtype == np.float64
    assert voxel_map.normals.shape == (count, 3) and voxel_map.normals.dtype == np.float32
    assert voxel_map.sides.shape == (count,) and set(voxel_map.sides) == {0, 1}
    front = voxel_map.points[:, 1] < 0.125
    assert np.array_equal(front, voxel_map.normals[:, 1] < 0)
    assert voxel_map.stats().points == count


def test_poses_move_points_and_turn_normals(rng):
    points, normals = wall(rng, 300, 1.0, -1.0)
    T = pose(0.7, (1.0, -2.0, 0.5))
    voxel_map = nvm.VoxelMap()
    voxel_map.insert(points, normals, T)
    expected = points @ T[:3, :3].T + T[:3, 3]
    for stored, normal in zip(voxel_map.points, voxel_map.normals):
        assert np.linalg.norm(expected - stored, axis=1).min() < 1e-4
        assert normal @ (T[:3, :3] @ [0, -1, 0]) > np.cos(np.radians(0.5))


@pytest.mark.parametrize("k", [1, 5, 20, 64])
def test_nearest_is_brute_force(rng, k):
    voxel_map = thin_wall(rng)
    stored = voxel_map.points
    queries = rng.uniform(-4, 4, (200, 3)) * [1, 0.05, 1]
    distances, indices, counts = voxel_map.nearest(queries, k=k, max_distance=0.3)
    assert distances.shape == indices.shape == (200, k) and counts.shape == (200,)
    for row, query in enumerate(queries):
        expected, _ = brute_force(stored, query, k, 0.3 + STEP)
        found = slice(0, counts[row])
        assert (expected <= 0.3 - STEP).sum() <= counts[row] <= len(expected)
        assert np.allclose(distances[row, found], expected[found], atol=STEP)
        true = np.linalg.norm(stored[indices[row, found]] - query, axis=1)
        assert np.allclose(distances[row, found], true, atol=STEP)
        assert np.isinf(distances[row, counts[row] :]).all()
        assert (indices[row, counts[row] :] == len(voxel_map)).all()


def test_a_normal_meets_one_face_only(rng):
    voxel_map = thin_wall(rng)
    queries, normals = wall(rng, 500, 0.14, -1.0, 3.5)  # nearer to the back, looks like the front
    _, indices, counts = voxel_map.nearest(queries, normals, k=10, max_distance=0.5)
    assert (counts == 10).all()
    assert np.allclose(voxel_map.points[indices.ravel(), 1], 0.10, atol=1e-4)
    _, indices, _ = voxel_map.nearest(queries, k=10, max_distance=0.5)
    assert voxel_map.points[indices.ravel(), 1].max() > 0.14


def test_gated_nearest_is_brute_force_over_agreeing_normals(rng):
    voxel_map = thin_wall(rng)
    queries, normals = wall(rng, 200, 0.12, 1.0)
    agrees = voxel_map.normals[:, 1] > 0
    distances, _, counts = voxel_map.nearest(queries, normals, k=8, max_distance=0.3)
    for row, query in enumerate(queries):
        expected, _ = brute_force(voxel_map.points, query, 8, 0.3 + STEP, agrees)
        assert (expected <= 0.3 - STEP).sum() <= counts[row] <= len(expected)
        assert np.allclose(distances[row, : counts[row]], expected[: counts[row]], atol=STEP)


def test_view_directions_tell_the_faces_apart(rng):
    voxel_map = nvm.VoxelMap()
    for y, sensor in ((0.10, (0, -3, 0)), (0.15, (0, 3, 0))):
        points, _ = wall(rng, 2000, y, 0.0, 1.5)
        voxel_map.insert(points, nvm.view_directions(points, sensor))
    queries, _ = wall(rng, 100, 0.14, 0.0, 1.0)  # where the sensor looks head-on
    looks = nvm.view_directions(queries, (0, -3, 0))
    _, indices, counts = voxel_map.nearest(queries, looks, k=5)
    assert counts.min() > 0
    found = indices[np.arange(5) < counts[:, None]]
    assert np.allclose(voxel_map.points[found, 1], 0.10, atol=1e-4)


def test_without_normals_all_is_front_and_only_bare_queries_find_it(rng):
    points, normals = wall(rng, 500, 0.1, 1.0)
    voxel_map = nvm.VoxelMap()
    assert voxel_map.insert(points, None).stored > 0
    assert not voxel_map.normals.any() and not voxel_map.sides.any()
    assert voxel_map.nearest(points, k=1)[2].min() == 1
    assert voxel_map.nearest(points, normals, k=1)[2].max() == 0


def test_within_is_brute_force(rng):
    voxel_map = thin_wall(rng)
    for radius in (0.0, 0.2, 2.0, np.inf):
        found = voxel_map.within((0.5, 0.1, -0.5), radius)
        distances = np.linalg.norm(voxel_map.points - (0.5, 0.1, -0.5), axis=1)
        assert np.array_equal(found, np.flatnonzero(distances <= radius))


def test_erasing_erases_what_it_says(rng):
    voxel_map = thin_wall(rng)
    before = voxel_map.points
    inside = np.linalg.norm(before - (1, 0.1, 1), axis=1) <= 0.8
    assert voxel_map.erase_within((1, 0.1, 1), 0.8) == inside.sum() > 0
    assert len(voxel_map) == len(before) - inside.sum()
    in_box = (voxel_map.points[:, 0] < -1).sum()
    assert voxel_map.erase_box((-9, -9, -9), (-1.00001, 9, 9)) == in_box
    assert voxel_map.erase_voxels_beyond((0, 0, 0), 2.0) > 0
    assert np.linalg.norm(voxel_map.points, axis=1).max() < 2.6
    voxel_map.clear()
    assert len(voxel_map) == 0


def test_indices_follow_a_change(rng):
    voxel_map = thin_wall(rng)
    query = [[0.5, 0.1, 0.5]]
    voxel_map.nearest(query)
    voxel_map.erase_within((-2, 0.1, -2), 1.0)
    voxel_map.insert([[30.0, 30.0, 30.0]], [[0.0, 0.0, 1.0]])
    distances, indices, counts = voxel_map.nearest(query, k=3)
    true = np.linalg.norm(voxel_map.points[indices[0]] - query, axis=1)
    assert counts[0] == 3 and np.allclose(true, distances[0], atol=STEP)


def test_files_and_pickles_give_the_same_map(rng, tmp_path):
    voxel_map = thin_wall(rng, voxel_size=0.4, capacity=5000)
    voxel_map.save(tmp_path / "map.nvm")
    copies = [nvm.load(tmp_path / "map.nvm"), pickle.loads(pickle.dumps(voxel_map))]
    copies.append(copy.deepcopy(voxel_map))
    for other in copies:
        assert other.options == voxel_map.options
        for name in ("points", "normals", "sides"):
            assert np.array_equal(getattr(other, name), getattr(voxel_map, name))
    copies[0].clear()
    assert len(voxel_map) > 0


def test_a_bad_file_is_named(tmp_path):
    (tmp_path / "broken.nvm").write_bytes(b"no map at all, but long enough to look like one")
    with pytest.raises(RuntimeError, match="broken.nvm.*not an nvm map"):
        nvm.load(tmp_path / "broken.nvm")
    with pytest.raises(RuntimeError, match="missing.nvm"):
        nvm.load(tmp_path / "missing.nvm")
    with pytest.raises(RuntimeError, match="is a folder"):
        nvm.load(tmp_path)
    with pytest.raises(RuntimeError, match="cannot be written"):
        nvm.VoxelMap().save(tmp_path / "no" / "folder.nvm")
    with pytest.raises(ValueError, match="the state of a map is not an nvm map"):
        pickle.loads(pickle.dumps(nvm.VoxelMap()).replace(b"NVMMAP", b"NVMMUP"))


def test_states_that_are_none_of_a_map_are_refused(rng):
    good = thin_wall(rng).__getstate__()
    cut = [good[:size] for size in (*range(40), *rng.integers(40, len(good), 40))]
    flipped = [bytes(byte ^ (i == place) for i, byte in enumerate(good[:600])) + good[600:] for place in range(0, 600, 7)]
    others = [None, 3, "map", [good], bytearray(good), {}, (), (good,), (good, None), (good, {}, {}), (good, [])]
    others += [({}, good), (good, {"points": 1}), (good, {3: 1}), (good[:50], {"floor": 1}), nvm.VoxelMap().stats()]
    for state in (*cut, *flipped, *others):
        voxel_map = NamedMap.__new__(NamedMap)
        with pytest.raises(ValueError, match="^nvm: the state of a map "):
            voxel_map.__setstate__(state)
    voxel_map.__setstate__((good, {"floor": 1}))  # after all that failed
    assert voxel_map.floor == 1 and voxel_map.__getstate__()[0] == good
    with pytest.raises(TypeError, match="is no VoxelMap"):
        nvm.VoxelMap.__getstate__(5)
    with pytest.raises(RuntimeError, match="^nvm: a map has no state"):
        nvm.VoxelMap.__new__(nvm.VoxelMap).__getstate__()


def test_a_map_that_is_there_is_not_made_again(rng):
    voxel_map = thin_wall(rng)
    for again in (voxel_map.__init__, lambda: voxel_map.__setstate__(voxel_map.__getstate__())):
        with pytest.warns(RuntimeWarning, match="already-initialized"), pytest.raises(TypeError):
            again()
    assert len(voxel_map) > 0


def test_the_number_of_threads_changes_nothing(rng):
    voxel_map = thin_wall(rng)
    queries, normals = wall(rng, 20000, 0.12, 1.0)
    one = voxel_map.nearest(queries, normals, threads=1)
    many = voxel_map.nearest(queries, normals, threads=3)
    assert all(np.array_equal(a, b) for a, b in zip(one, many))


def test_options_are_those_of_the_library():
    options = nvm.VoxelMap(voxel_size=0.5, surface_rule="smallest_angle").options
    assert options["voxel_size"] == 0.5 and options["surface_rule"] == "smallest_angle"
    assert options["points_per_surface"] == 20
    with pytest.raises(ValueError, match="voxel_size = -1"):
        nvm.VoxelMap(voxel_size=-1)
    with pytest.raises(ValueError, match="voxel_size = 'wide'"):
        nvm.VoxelMap(voxel_size="wide")
    with pytest.raises(ValueError, match="'paper' 'smallest_angle'"):
        nvm.VoxelMap(surface_rule="best")
    with pytest.raises(TypeError, match="voxel_size"):
        nvm.VoxelMap(voxelsize=0.3)
    assert "min_point_distance : default" in nvm.VoxelMap.__doc__


def test_bounded_maps_stay_bounded(rng):
    voxel_map = nvm.VoxelMap(capacity=50)
    points = rng.uniform(-10, 10, (5000, 3))
    stats = voxel_map.insert(points, unit(rng.normal(size=(5000, 3))))
    assert voxel_map.stats().voxels == 50 and stats.evicted_voxels > 0


class NamedMap(nvm.VoxelMap):
    """A map of a user's own, with attributes in both places that Python has for them."""

    __slots__ = ("floor", "unset", "__dict__")


def test_pickles_and_copies_keep_what_a_subclass_has_added(rng):
    voxel_map = NamedMap(voxel_size=0.5)
    voxel_map.insert(*wall(rng, 100, 1.0, -1.0))
    voxel_map.floor, voxel_map.names = 3, ["kitchen"]
    for again in (pickle.loads(pickle.dumps(voxel_map)), copy.copy(voxel_map), copy.deepcopy(voxel_map)):
        assert type(again) is NamedMap and (again.floor, again.names) == (3, ["kitchen"])
        assert not hasattr(again, "unset")
        np.testing.assert_array_equal(again.points, voxel_map.points)
    assert copy.deepcopy(voxel_map).names is not voxel_map.names
    bare = nvm.VoxelMap(voxel_size=0.5)
    assert bare.__getstate__() == NamedMap(voxel_size=0.5).__getstate__()  # the bytes of the file
