# SPDX-License-Identifier: MIT
# Copyright (c) 2026 The nvm authors
"""Builds a tile store from sessions."""

from __future__ import annotations

import json
import math
import re

from .._nvm import VoxelMap
from ..folders import LocalFolder, RemoteFolder, folder_at
from ..store import FOLDER, FORMAT, INDEX, PARTS, VERSION, Store, open_store
from .session import Session
from .tiling import MARGIN_VOXELS, Plan, build_tile, cut, lacking

_INDEX = r"-?\d+_-?\d+_-?\d+"  # of a tile
OURS = re.compile(rf"({FOLDER}/{_INDEX}\.nvm|{PARTS}/{_INDEX}\.\d+\.npz)((\.\w+)?\.part)?")


def build(
    sessions: list[Session],
    store,
    *,
    client=None,
    tile_size: float = 20.0,
    scans_per_task: int = 20,
    map_options: dict | None = None,
    normal_options: dict | None = None,
) -> Store:
    """Builds the map of all sessions, in tiles, and opens it.

    Points come into each tile in the order of the sessions and of their scans: the bytes of the
    store are the same whoever builds it, in whatever order tasks come to their end.

    Parameters
    ----------
    sessions : list of Session
    store : path
        A folder that all workers see, or a URL that fsspec opens: ``s3://bucket/campus``. It must not
        hold a store; what a killed build has left there is built again.
    client : distributed.Client, optional
        Whose workers build; None: this process does, one task after the other.
    tile_size : float
        Edge of a tile [m], rounded up to whole voxels.
    scans_per_task : int
        A worker holds so many scans, or one tile, at a time.
    map_options, normal_options : dict, optional
        As for `VoxelMap` and `NormalEstimator`.

    Raises
    ------
    ValueError
        For sessions without scans, bad options, and a store that exists.
    OSError
        When the disk is full, or the network fails. There is no store then, and the next build begins anew.
    RuntimeError
        When a package for the URL is missing, or workers see another folder at `store`.
    """
    folder = folder_at(store)
    plan = _plan(str(folder), tile_size, dict(map_options or {}), dict(normal_options or {}))
    blocks = _blocks(sessions, scans_per_task)
    _make_room(folder)
    run = _serially if client is None else _Cluster(client)
    parts: dict[tuple, list[str]] = {}
    for files in run(cut, [(plan, number, scans) for number, scans in enumerate(blocks)]):
        for tile, file in files.items():
            parts.setdefault(tile, []).append(file)
    built = run(build_tile, [(plan, tile, parts[tile]) for tile in sorted(parts)])
    tiles = [tile for tile in built if tile is not None]
    _check_places(folder, tiles)
    folder.remove(PARTS)
    index = {
        "format": FORMAT,
        "version": VERSION,
        "tile_size": plan.tile_voxels * plan.voxel_size,
        "margin": MARGIN_VOXELS * plan.voxel_size,
        "options": plan.map_options,
        "tiles": tiles,
    }
    folder.write(INDEX, (json.dumps(index, indent=1) + "\n").encode())
    return open_store(store)


def _plan(store: str, tile_size: float, map_options: dict, normal_options: dict) -> Plan:
    options = VoxelMap(**map_options).options
    for column in ("intensity", "time", "color", "label"):
        if options[column]:
            raise ValueError(f"nvm: {column}=True: the scans of a store carry points and no {column}")
    if not (math.isfinite(tile_size) and tile_size > 0.0):
        raise ValueError(f"tile_size must be positive [m], not {tile_size}")
    voxels = math.ceil(tile_size / options["voxel_size"] - 1e-9)
    if voxels <= 2 * MARGIN_VOXELS:
        raise ValueError(
            f"tile_size={tile_size} must be more than {2 * MARGIN_VOXELS} voxels of "
            f"{options['voxel_size']} m"
        )
    return Plan(store, voxels, options, normal_options)


def _blocks(sessions: list[Session], scans_per_task: int) -> list[list]:
    if scans_per_task < 1:
        raise ValueError(f"scans_per_task must be 1 or more, not {scans_per_task}")
    scans = [pair for session in sessions for pair in zip(session.scans, session.poses)]
    if not scans:
        raise ValueError("the sessions have no scans")
    return [scans[i : i + scans_per_task] for i in range(0, len(scans), scans_per_task)]


def _make_room(folder: LocalFolder | RemoteFolder) -> None:
    if folder.has(INDEX):
        raise ValueError(f"{folder}: holds a store already; give another folder, or remove it")
    names = (PARTS, FOLDER)
    for file in (file for name in names for file in folder.sizes(name)):
        if not OURS.fullmatch(file):
            raise ValueError(f"{folder}/{file}: is of no build of a store, and would be removed; give another folder")
    for name in names:  # of a build that was killed
        folder.remove(name)
        folder.make(name)


def _check_places(folder: LocalFolder | RemoteFolder, tiles: list[dict]) -> None:
    """Sees to it that the tiles, and they alone, are where this process will look for them."""
    found = folder.sizes(FOLDER)
    wanted = {tile["file"]: tile["bytes"] for tile in tiles}
    for file, size in wanted.items():
        if found.get(file) != size and not _is_there(folder, file, size):
            raise RuntimeError(lacking(f"{folder}/{file}"))
    for file in found.keys() - wanted.keys():  # of a worker that was killed
        folder.remove(file)


def _is_there(folder: LocalFolder | RemoteFolder, file: str, size: int) -> bool:
    """Whether a file can be read; a list of files may be an old one, as on NFS."""
    try:
        return len(folder.read(file)) == size
    except OSError:
        return False


def _serially(task, arguments: list[tuple]) -> list:
    return [task(*each) for each in arguments]


class _Cluster:
    """Runs tasks on the workers of a client; those of a worker that dies run again elsewhere."""

    def __init__(self, client):
        self._client = client

    def __call__(self, task, arguments: list[tuple]) -> list:
        futures = [self._client.submit(task, *each, pure=False, retries=3) for each in arguments]
        return self._client.gather(futures)
