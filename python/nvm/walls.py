# SPDX-License-Identifier: MIT
# Copyright (c) 2026 The nvm authors
"""The walls of a map, measured: ``nvm walls`` as a function."""

from __future__ import annotations

import json
import os
import warnings

import numpy as np

from . import _nvm
from .folders import is_url
from .store import INDEX, Store


def survey(map, out=None, **options) -> dict:
    """List the walls, slabs and doors of a map with their thickness, without being told where they are.

    Parameters
    ----------
    map : VoxelMap, Store, (points, normals) or path
        Points (N, 3) [m], and normals (N, 3) of unit length that look at where a point was seen from. The path is that of
        a store (or its URL), of a map.nvm, or of a folder of ``nvm run``, whose keyframes tell which sides were seen in one pass, and
        how far poses drift between.
    out : path, optional
        Folder for what ``nvm walls`` writes: list, plan and page.
    **options
        ``min_area`` 0.6, seen from both sides [m^2]; ``max_thickness`` 0.6, ``min_thickness`` 0.01,
        ``max_gap`` 1.6, that a face goes on behind, ``plan_height`` 1.2, above the floor, ``drift`` 0.0,
        standard deviation of the pose between two passes, and ``patch_size`` 0.25 [m].

    Returns
    -------
    dict
        What walls.json holds (docs/walls.md), all lengths in metres in the map's frame: ``walls``, seen from both
        sides, with ``thickness``, ``thickness_std``, ``kind``, ``faces`` and ``openings``; ``bodies``, which are
        columns and furniture; ``faces``, seen from one side. Polygons are lists of [x, y, z].

    Raises
    ------
    ValueError
        For a bad option, and when no point has a normal.
    RuntimeError
        When a file cannot be written, or a tile read.
    """
    run_map = ""
    if isinstance(map, (str, os.PathLike)):
        if is_url(map) or os.path.isfile(os.path.join(map, INDEX)):
            map = Store(map)
        else:
            run_map = os.path.join(map, "map.nvm") if os.path.isdir(map) else os.fspath(map)
            map = _nvm.load(run_map)
    points, normals = points_of(map)
    found = json.loads(_nvm.survey(points, normals, "" if out is None else os.fspath(out), run_map, **options))
    if found["inside_out"]:
        warnings.warn("normals seem to point into the walls instead of to where points were seen from", stacklevel=2)
    return found


def points_of(map):
    """Points and normals of whatever holds them."""
    if isinstance(map, Store):
        nothing = np.zeros((0, 3))
        tiles = [(nothing, nothing), *(own_points(map, tile) for tile in map.tiles)]
        return tuple(np.concatenate(column) for column in zip(*tiles))
    if isinstance(map, _nvm.VoxelMap):
        return map.points, map.normals
    if not isinstance(map, (tuple, list)) or len(map) != 2:
        raise ValueError("map must be a VoxelMap, a Store, the folder of a run, or a pair of points and normals")
    return map


def own_points(store: Store, tile):
    """Those that lie in the tile, not in its margin."""
    voxel_map = store.load(tile)
    points = voxel_map.points
    rows = (store.tile_of(points) == tile).all(axis=1)
    return points[rows], voxel_map.normals[rows]
