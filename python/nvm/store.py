# SPDX-License-Identifier: MIT
# Copyright (c) 2026 The nvm authors
"""A map in tiles, larger than one machine's memory: a folder, on a disk or behind a URL, with a ``.nvm`` file per tile
and an index.

docs/living_maps.md describes the format.
"""

from __future__ import annotations

import json
import zlib
from collections import OrderedDict

import numpy as np

from ._nvm import VoxelMap
from .folders import LocalFolder, RemoteFolder, folder_at

FORMAT = "nvm-store"
VERSION = 1
INDEX = "index.json"
FOLDER = "tiles"
PARTS = "parts"  # folder of a build that goes on
FARTHEST = 1e9  # [m], beyond any tile

Tile = tuple[int, int, int]


def tile_name(tile: Tile) -> str:
    return f"{FOLDER}/{'_'.join(map(str, tile))}.nvm"


def bytes_of(voxel_map: VoxelMap) -> bytes:
    """What `VoxelMap.save` would write."""
    return voxel_map.__getstate__()


def map_of(data: bytes) -> VoxelMap:
    """What `load` would read. RuntimeError when `data` are no map."""
    voxel_map = VoxelMap.__new__(VoxelMap)
    try:
        voxel_map.__setstate__(data)
    except ValueError as error:
        raise RuntimeError(str(error)) from error
    return voxel_map


class Store:
    """The tiles of a map, opened as one map: they are loaded as queries need them.

    Attributes
    ----------
    path : Path, or str of a URL
    options : dict
        Of each tile's map.
    tile_size : float
        Edge of a tile's cube [m].
    tiles : dict
        From the index of a tile, (x, y, z), to what the store's index says of it.
    """

    def __init__(self, path, *, max_tiles: int = 16):
        """Opens the store in the folder at `path`, or at a URL; at most `max_tiles` tiles stay in memory."""
        if max_tiles < 1:
            raise ValueError(f"max_tiles must be 1 or more, not {max_tiles}")
        self._folder = folder_at(path)
        self.path = self._folder.path
        index = read_index(self._folder)
        self.options: dict = index["options"]
        self.tile_size: float = index["tile_size"]
        self.tiles: dict[Tile, dict] = {tuple(entry["tile"]): entry for entry in index["tiles"]}
        self._max_tiles = max_tiles
        self._loaded: OrderedDict[Tile, tuple[VoxelMap, np.ndarray]] = OrderedDict()

    def __len__(self) -> int:
        """Points, each counted in the tile that it lies in."""
        return sum(entry["points"] for entry in self.tiles.values())

    def __repr__(self) -> str:
        return f"<nvm.Store: {len(self)} points in {len(self.tiles)} tiles of {self.tile_size} m>"

    def load(self, tile: Tile) -> VoxelMap:
        """The map of a tile, with a margin of what its neighbours hold. KeyError when it is empty."""
        return self._with_points(tile)[0]

    def _with_points(self, tile: Tile) -> tuple[VoxelMap, np.ndarray]:
        if tile not in self._loaded:
            voxel_map = self._read(self.tiles[tile])
            self._loaded[tile] = (voxel_map, voxel_map.points)
            if len(self._loaded) > self._max_tiles:
                self._loaded.popitem(last=False)
        self._loaded.move_to_end(tile)
        return self._loaded[tile]

    def _read(self, entry: dict) -> VoxelMap:
        """The map of a tile. OSError when it cannot be read, RuntimeError when it is not what was written."""
        data = self._bytes(entry)
        try:
            return map_of(data)
        except RuntimeError as error:
            raise RuntimeError(f"{self._folder}/{entry['file']}: {error}") from error

    def _bytes(self, entry: dict) -> bytes:
        data = self._folder.read(entry["file"])
        if len(data) != entry["bytes"] or zlib.crc32(data) != entry["crc32"]:
            name = f"{self._folder}/{entry['file']}"
            raise RuntimeError(f"{name}: is not the file that the index tells of: build again")
        return data

    def copy_to(self, path) -> None:
        """Copies the store into the folder at `path`."""
        folder = folder_at(path)
        folder.make(FOLDER)
        for entry in self.tiles.values():
            folder.write(entry["file"], self._bytes(entry))
        folder.write(INDEX, self._folder.read(INDEX))

    def tile_of(self, points: np.ndarray) -> np.ndarray:
        """(M, 3) int64: the tiles in which `points` (M, 3) [m] lie."""
        return np.floor(np.asarray(points, dtype=float) / self.tile_size).astype(np.int64)

    def nearest(self, points, normals=None, k: int = 5, max_distance: float = 1.0):
        """What `VoxelMap.nearest` of the whole map would find.

        Returns
        -------
        distances : (M, k) float64
            [m], ascending; inf where there are fewer than k.
        positions : (M, k, 3) float64
            [m]; NaN where there are fewer than k.
        counts : (M,) int64
        """
        # An empty map finds nothing, and refuses what is to be refused.
        distances, _, counts = VoxelMap(capacity=1).nearest(points, normals, k, max_distance)
        points = np.asarray(points, dtype=float).reshape(-1, 3)
        normals = None if normals is None else np.asarray(normals, dtype=float)
        positions = np.full((*distances.shape, 3), np.nan)
        usable = np.flatnonzero((np.abs(points) < FARTHEST).all(axis=1))
        tiles, inverse = np.unique(self.tile_of(points[usable]), axis=0, return_inverse=True)
        for i, tile in enumerate(map(tuple, tiles.tolist())):
            if tile not in self.tiles:
                continue
            rows = usable[inverse.reshape(-1) == i]
            voxel_map, stored = self._with_points(tile)
            found = voxel_map.nearest(
                points[rows], None if normals is None else normals[rows], k, max_distance, threads=1
            )
            distances[rows], counts[rows] = found[0], found[2]
            is_there = found[1] < len(stored)
            positions[rows] = np.where(
                is_there[..., None], stored[np.minimum(found[1], len(stored) - 1)], np.nan
            )
        return distances, positions, counts

    def check(self) -> list[str]:
        """Reads every tile; what is wrong, a line each."""
        problems = []
        for entry in self.tiles.values():
            try:
                self._read(entry)
            except (OSError, RuntimeError) as error:
                problems.append(str(error))
        return problems


def read_index(folder: LocalFolder | RemoteFolder) -> dict:
    """The index of a store; RuntimeError, in one line, when there is none that this nvm reads."""
    file = f"{folder}/{INDEX}"
    try:
        text = folder.read(INDEX)
    except (FileNotFoundError, NotADirectoryError) as error:
        why = "its build has not come to its end: build again" if has_begun(folder) else f"has no {INDEX}"
        raise RuntimeError(f"{folder}: is no store: {why}") from error
    try:
        index = json.loads(text)
        if index["format"] != FORMAT:
            raise ValueError
        version = int(index["version"])
        if version <= VERSION:
            for entry in index["tiles"]:
                _ = entry["points"], entry["bytes"], entry["crc32"]
                if entry["file"] != tile_name(tuple(map(int, entry["tile"]))):
                    raise ValueError  # and nothing outside the store is read
            _ = index["options"], index["tile_size"]
    except (ValueError, KeyError, TypeError) as error:
        raise RuntimeError(f"{file}: is not the index of a store, or is damaged") from error
    if version > VERSION:
        raise RuntimeError(f"{file}: has version {version}; this nvm reads up to {VERSION}")
    return index


def has_begun(folder: LocalFolder | RemoteFolder) -> bool:
    """Whether a build has left something there."""
    try:
        return bool(folder.sizes(FOLDER) or folder.sizes(PARTS))
    except (OSError, NotImplementedError):  # where files are not listed, as on a web server
        return False


def open_store(path, *, max_tiles: int = 16) -> Store:
    """Opens what `nvm.distributed.build` made, as one map.

    `path` is that of a folder, or a URL that fsspec opens: ``s3://bucket/campus``. RuntimeError when it is no store,
    OSError when it cannot be read. At most `max_tiles` tiles, those that were used last, stay in memory.
    """
    return Store(path, max_tiles=max_tiles)
