# SPDX-License-Identifier: MIT
# Copyright (c) 2026 The nvm authors
"""The work of a worker: cut scans into tiles, and build the map of a tile.

Both tasks may run anywhere, in any order and again after a worker was killed: what they write
depends on what they are given alone, and takes its place all at once.
"""

from __future__ import annotations

import io
import itertools
import zlib
from dataclasses import dataclass, field

import numpy as np

from .._nvm import NormalEstimator, VoxelMap
from ..folders import LocalFolder, RemoteFolder, folder_at
from ..store import PARTS, Tile, bytes_of, map_of, tile_name
from .session import read_scan

MARGIN_VOXELS = 2  # a query sees one voxel around its own, whose points may heed the next ones


@dataclass(frozen=True)
class Plan:
    """What all tasks of a build share."""

    store: str  # path or URL
    tile_voxels: int  # edge of a tile
    map_options: dict = field(default_factory=dict)
    normal_options: dict = field(default_factory=dict)

    @property
    def voxel_size(self) -> float:
        return self.map_options["voxel_size"]


def tiles_of(voxels: np.ndarray, plan: Plan) -> list[tuple[Tile, np.ndarray]]:
    """For voxels (N, 3): each tile that they belong to, or to the margin of, and which do."""
    low = (voxels - MARGIN_VOXELS) // plan.tile_voxels
    high = (voxels + MARGIN_VOXELS) // plan.tile_voxels
    tiles = np.unique(np.concatenate([np.unique(low, axis=0), np.unique(high, axis=0)]), axis=0)
    ranges = [range(tiles[:, axis].min(), tiles[:, axis].max() + 1) for axis in range(3)]
    chosen = []
    for tile in itertools.product(*ranges):
        rows = np.flatnonzero(((low <= tile) & (tile <= high)).all(axis=1))
        if len(rows):
            chosen.append((tile, rows))
    return chosen


def cut(plan: Plan, number: int, scans: list) -> dict[Tile, str]:
    """Estimates the normals of `scans`, pairs of a scan and its pose, and cuts them into tiles.

    Returns the file of each tile's points.
    """
    estimator = NormalEstimator(**plan.normal_options)
    pieces: dict[Tile, list] = {}
    for scan, pose in scans:
        points = read_scan(scan)
        points = points[np.isfinite(points).all(axis=1)]
        if not len(points):
            continue
        normals = estimator.estimate(points, threads=1).normals
        placed = points.astype(float) @ pose[:3, :3].T + pose[:3, 3]
        voxels = np.floor(placed / plan.voxel_size).astype(np.int64)
        for tile, rows in tiles_of(voxels, plan):
            pieces.setdefault(tile, []).append((points[rows], normals[rows], pose))
    return {tile: write_part(plan, number, tile, piece) for tile, piece in pieces.items()}


def write_part(plan: Plan, number: int, tile: Tile, pieces: list) -> str:
    name = f"{PARTS}/{'_'.join(map(str, tile))}.{number}.npz"
    file = io.BytesIO()
    np.savez(
        file,
        points=np.concatenate([points for points, _, _ in pieces]),
        normals=np.concatenate([normals for _, normals, _ in pieces]),
        poses=np.stack([pose for _, _, pose in pieces]),
        ends=np.cumsum([len(points) for points, _, _ in pieces]),
    )
    folder_at(plan.store).write(name, file.getvalue(), is_to_last=False)
    return name


def read_part(folder: LocalFolder | RemoteFolder, name: str) -> bytes:
    try:
        return folder.read(name)
    except FileNotFoundError as error:
        raise RuntimeError(lacking(f"{folder}/{name}")) from error


def lacking(file: str) -> str:
    """What is wrong when a file that a task has written is not there for another."""
    return f"{file}: was written, but is not there: workers see another folder of this name"


def build_tile(plan: Plan, tile: Tile, parts: list[str]) -> dict | None:
    """Builds and saves the map of a tile from `parts`, in their order; None when nothing is in it."""
    folder = folder_at(plan.store)
    voxel_map = VoxelMap(**plan.map_options)
    for part in parts:
        with np.load(io.BytesIO(read_part(folder, part)), allow_pickle=False) as piece:
            points, normals = piece["points"], piece["normals"]
            begin = 0
            for pose, end in zip(piece["poses"], piece["ends"]):
                stats = voxel_map.insert(points[begin:end], normals[begin:end], pose)
                begin = end
                if stats.evicted_points or stats.map_full:
                    raise ValueError(
                        f"tile {tile} has more than capacity={plan.map_options['capacity']} voxels: "
                        "build with a smaller tile_size, or a larger capacity"
                    )
    size = plan.tile_voxels * plan.voxel_size
    inside = int((np.floor(voxel_map.points / size) == tile).all(axis=1).sum())
    if not inside:
        return None
    name = tile_name(tile)
    data = bytes_of(voxel_map)
    map_of(data)  # as `save` does: what cannot be read back is not written
    folder.write(name, data)
    return {
        "tile": list(tile),
        "file": name,
        "points": inside,
        "bytes": len(data),
        "crc32": zlib.crc32(data),
    }
