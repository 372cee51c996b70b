# SPDX-License-Identifier: MIT
# Copyright (c) 2026 The nvm authors
import pickle

import numpy as np
import pytest
from support import wall

import nvm


def numbered(rng, count=500):
    """Points of a wall, and values of each column that tell them apart."""
    points, normals = wall(rng, count, 1.0, -1.0)
    rows = np.arange(count)
    return points, normals, {
        "intensity": (rows / 2).astype(np.float32),
        "time": 1e9 + rows / 1000,
        "color": np.stack([rows % 256, rows // 256, rows * 0], axis=1),
        "label": rows,
    }


def test_columns_are_rows_of_their_points(rng, tmp_path):
    points, normals, values = numbered(rng)
    voxel_map = nvm.VoxelMap(**dict.fromkeys(values, True))
    voxel_map.insert(points, normals, **values)
    voxel_map.save(tmp_path / "map.nvm")
    for kept in (voxel_map, nvm.load(tmp_path / "map.nvm"), pickle.loads(pickle.dumps(voxel_map))):
        came_from = np.linalg.norm(kept.points[:, None] - points, axis=2).argmin(axis=1)
        assert len(kept) > 50
        for name, dtype in (("intensity", "f4"), ("time", "f8"), ("color", "u1"), ("label", "u2")):
            column = kept.column(name)
            assert column.dtype == dtype and np.array_equal(column, values[name][came_from])
    _, indices, _ = voxel_map.nearest(voxel_map.points[:7], k=1)
    assert np.array_equal(voxel_map.column("label")[indices[:, 0]], voxel_map.column("label")[:7])


def test_what_is_not_given_is_zero(rng):
    points, normals, values = numbered(rng)
    voxel_map = nvm.VoxelMap(intensity=True, label=True)
    voxel_map.insert(points, None, label=values["label"])
    assert not voxel_map.column("intensity").any() and voxel_map.column("label").any()
    assert voxel_map.options["intensity"] and not voxel_map.options["time"]


def test_columns_that_are_not_kept_are_refused(rng):
    points, normals, values = numbered(rng)
    voxel_map = nvm.VoxelMap(label=True)
    with pytest.raises(ValueError, match=r"keeps no intensity: make it with VoxelMap\(intensity=True\)"):
        voxel_map.insert(points, normals, intensity=values["intensity"])
    with pytest.raises(ValueError, match="keeps no time"):
        voxel_map.column("time")
    with pytest.raises(ValueError, match="no column colour"):
        voxel_map.column("colour")
    assert len(voxel_map) == 0


@pytest.mark.parametrize("label", [[1.5] * 500, [-1] * 500, [65536] * 500, [np.nan] * 500, [1] * 499, "ab"])
def test_labels_that_no_label_is_are_refused(rng, label):
    points, normals, _ = numbered(rng)
    voxel_map = nvm.VoxelMap(label=True)
    with pytest.raises(ValueError, match="label"):
        voxel_map.insert(points, normals, label=label)
    assert len(voxel_map) == 0


def test_colors_are_three_of_256(rng):
    points, normals, values = numbered(rng)
    voxel_map = nvm.VoxelMap(color=True)
    for color in (values["color"] + 256, values["color"] / 255, values["color"][:, :2]):
        with pytest.raises(ValueError, match="color"):
            voxel_map.insert(points, normals, color=color)
