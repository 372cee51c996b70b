# SPDX-License-Identifier: MIT
# Copyright (c) 2026 The nvm authors
"""Walls of maps in memory, of clouds and of stores: as the program finds them."""

import json

import numpy as np
import pytest
from support import nvm as program
from support import wall

import nvm


def thin_wall(rng, count=6000):
    """Points and normals of the two faces of a wall of 80 mm."""
    faces = [wall(rng, count, y, side, extent=1.5) for y, side in ((-0.04, -1.0), (0.04, 1.0))]
    points = np.concatenate([points for points, _ in faces])
    points[:, 1] += rng.normal(0.0, 0.003, len(points))
    return points, np.concatenate([normals for _, normals in faces])


def test_a_cloud_a_map_and_the_program_agree(rng, tmp_path):
    points, normals = thin_wall(rng)
    found = nvm.survey((points, normals))["walls"]
    assert [w["thickness"] for w in found] == [pytest.approx(0.08, abs=0.0005)]
    assert found[0]["length"] == pytest.approx(3.0, abs=0.05) and len(found[0]["faces"]) == 2
    voxel_map = nvm.VoxelMap()
    voxel_map.insert(points, normals)
    voxel_map.save(tmp_path / "map.nvm")
    of_map = nvm.survey(voxel_map, tmp_path / "a")
    assert of_map["walls"][0]["thickness"] == pytest.approx(0.08, abs=0.003)
    assert program("walls", tmp_path / "map.nvm", "--out", tmp_path / "b").returncode == 0
    assert of_map == json.loads((tmp_path / "a" / "walls.json").read_text())
    of_program = json.loads((tmp_path / "b" / "walls.json").read_text())
    assert of_map["walls"][0]["thickness"] == pytest.approx(of_program["walls"][0]["thickness"], abs=1e-6)
    for path in (tmp_path, tmp_path / "map.nvm"):
        assert nvm.survey(path)["walls"][0]["thickness"] == pytest.approx(of_program["walls"][0]["thickness"], abs=1e-6)
    assert {path.name for path in (tmp_path / "a").iterdir()} == {path.name for path in (tmp_path / "b").iterdir()}


def test_options_take_effect_and_bad_ones_are_named(rng):
    points, normals = thin_wall(rng)
    assert not nvm.survey((points, normals), max_thickness=0.06)["walls"]
    with pytest.raises(ValueError, match="max_thickness"):
        nvm.survey((points, normals), max_thickness=-1.0)
    with pytest.raises(TypeError, match="there are: patch_size"):
        nvm.survey((points, normals), thickness=1.0)
    with pytest.raises(ValueError, match="normals"):
        nvm.survey((points, normals[:-1]))
    with pytest.raises(ValueError, match="normal"):
        nvm.survey((points, np.zeros_like(normals)))
    with pytest.raises(ValueError):
        nvm.survey((np.zeros((0, 3)), np.zeros((0, 3))))
    for other in (None, (points,), (points, normals, normals), 5):
        with pytest.raises(ValueError, match="a pair of points and normals"):
            nvm.survey(other)


def test_a_map_far_from_zero_is_where_the_program_has_it(rng, tmp_path):
    voxel_map = nvm.VoxelMap()
    voxel_map.insert(*thin_wall(rng))
    voxel_map.save(tmp_path / "map.nvm")
    (tmp_path / "map_origin.txt").write_text("480000 5500000 0\n")
    assert program("walls", tmp_path, "--out", tmp_path / "out").returncode == 0
    of_program = json.loads((tmp_path / "out" / "walls.json").read_text())
    faces = [found["walls"][0]["faces"][0] for found in (nvm.survey(tmp_path), of_program)]
    assert faces[0]["d"] == pytest.approx(faces[1]["d"], abs=1e-6)
    assert faces[0]["polygon"][0][0] == pytest.approx(480000.0, abs=10.0)


def test_normals_that_point_into_walls_are_warned_of(rng):
    points, normals = thin_wall(rng)
    with pytest.warns(UserWarning, match="into the walls"):
        assert not nvm.survey((points, -normals))["walls"]


def test_a_store_is_one_map(rng, tmp_path):
    from nvm.distributed import Session, build

    points, normals = thin_wall(rng)
    scans = [points[normals[:, 1] == side] - (0.0, 1.5 * side, 0.0) for side in (-1.0, 1.0)]
    poses = np.stack([np.eye(4), np.eye(4)])
    poses[:, 1, 3] = -1.5, 1.5
    store = build([Session(scans=scans, poses=poses)], tmp_path / "store", tile_size=2.0)
    found = nvm.survey(store)
    assert nvm.survey(tmp_path / "store") == found
    assert [w["thickness"] for w in found["walls"]] == [pytest.approx(0.08, abs=0.003)]
    done = program("walls", tmp_path / "store", "--out", tmp_path / "out")
    assert done.returncode == 0, done.stderr
    of_program = json.loads((tmp_path / "out" / "walls.json").read_text())
    assert len(of_program["walls"]) == 1
    assert of_program["walls"][0]["thickness"] == pytest.approx(found["walls"][0]["thickness"], abs=1e-6)
    assert sum(face["points"] for face in of_program["walls"][0]["faces"]) <= len(store)
