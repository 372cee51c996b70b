# SPDX-License-Identifier: MIT
# Copyright (c) 2026 The nvm authors
"""What ``nvm run``, ``nvm map`` and ``nvm evaluate`` leave in a folder."""

from __future__ import annotations

import csv
import dataclasses
import json
import pathlib

import numpy as np

from . import load

TEXTS = ("status", "why", "unobserved")  # columns of frames.csv
SIDE_COLORS = ("#1f77b4", "#ff7f0e")  # front, back
STAGES = ("deskew", "normals", "optimize", "map_update")
MAX_DRAWN = 300_000  # points


class ResultError(RuntimeError):
    """A folder or file that holds no results, and what is wrong with it."""


@dataclasses.dataclass
class Trajectory:
    """Poses T_map_body: times (N,) [s], positions (N, 3) [m], quaternions (N, 4) as x y z w."""

    times: np.ndarray
    positions: np.ndarray
    quaternions: np.ndarray


@dataclasses.dataclass
class Cloud:
    """Points of a map: positions (N, 3) [m], normals (N, 3), sides (N,) with 0 front and 1 back."""

    positions: np.ndarray
    normals: np.ndarray
    sides: np.ndarray


@dataclasses.dataclass
class Results:
    """The parts that a folder has; `frames` has a column of frames.csv under each name."""

    path: pathlib.Path
    trajectory: Trajectory | None = None
    frames: dict | None = None
    cloud: Cloud | None = None


def read_trajectory(path) -> Trajectory:
    """Reads a TUM file: t x y z qx qy qz qw; of a sequence that of its truth."""
    path = pathlib.Path(path)
    path = path / "groundtruth.tum" if path.is_dir() else path
    try:
        rows = np.loadtxt(path, ndmin=2)
    except ValueError as error:
        raise ResultError(f"{path}: is no TUM file: {error}") from error
    if rows.size == 0 or rows.shape[1] != 8:
        raise ResultError(f"{path}: is no TUM file: it needs 8 numbers a line")
    return Trajectory(rows[:, 0], rows[:, 1:4], rows[:, 4:])


def read_cloud(path) -> Cloud:
    """Reads a saved map, where the file with its origin beside it says that it lies."""
    path = pathlib.Path(path)
    voxel_map = load(path)
    origin = np.zeros(3)
    for name in (f"{path.stem}_origin.txt", "map_origin.txt"):  # or a map.nvm was renamed
        if (path.parent / name).is_file():
            origin = np.loadtxt(path.parent / name)
            break
    return Cloud(voxel_map.points + origin, voxel_map.normals, voxel_map.sides)


def read_frames(path) -> dict:
    """Reads a frames.csv: numbers as float arrays, texts as lists."""
    with open(path, newline="", encoding="utf-8") as file:
        rows = list(csv.DictReader(file))
    names = rows[0].keys() if rows else ()
    columns = {name: [row[name] for row in rows] for name in names}
    return {k: v if k in TEXTS else np.array(v, dtype=float) for k, v in columns.items()}


def read_results(path) -> Results:
    """Reads a folder of results, a saved map or a TUM file."""
    path = pathlib.Path(path)
    if path.is_file():
        if path.suffix == ".nvm":
            return Results(path, cloud=read_cloud(path))
        return Results(path, trajectory=read_trajectory(path))
    if not path.exists():
        raise ResultError(f"{path}: does not exist")
    results = Results(path)
    readers = {
        "trajectory": ("trajectory.tum", read_trajectory),
        "frames": ("frames.csv", read_frames),
        "cloud": ("map.nvm", read_cloud),
    }
    for part, (name, read) in readers.items():
        if (path / name).is_file():
            setattr(results, part, read(path / name))
    if results.trajectory is None and results.cloud is None:
        raise ResultError(f"{path}: has neither trajectory.tum nor map.nvm: give a folder of nvm run")
    return results


def read_evaluation(path) -> tuple[dict, dict]:
    """Reads evaluation.json and drawing.json of a folder of ``nvm evaluate``."""
    files = [pathlib.Path(path) / name for name in ("evaluation.json", "drawing.json")]
    try:
        return tuple(json.loads(file.read_text(encoding="utf-8")) for file in files)
    except (OSError, ValueError) as error:
        raise ResultError(f"{path}: is no whole folder of nvm evaluate: {error}") from error


def thinned(cloud: Cloud, keep=None) -> Cloud:
    """At most MAX_DRAWN points, evenly, of those where `keep` holds."""
    rows = np.flatnonzero(keep) if keep is not None else np.arange(len(cloud.sides))
    rows = rows[:: max(1, -(-len(rows) // MAX_DRAWN))]
    return Cloud(cloud.positions[rows], cloud.normals[rows], cloud.sides[rows])
