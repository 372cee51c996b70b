# SPDX-License-Identifier: MIT
# Copyright (c) 2026 The nvm authors
"""Commands of the C++ program as functions: ``nvm export``, ``nvm simulate`` and ``nvm evaluate``."""

from __future__ import annotations

import contextlib
import json
import os
import pathlib
import subprocess
import tempfile

from ._nvm import VoxelMap
from .program import find_program, started

INTERRUPTED = 130  # the program's exit code then


def call(*arguments) -> None:
    """Runs the program; what it says when it fails becomes a RuntimeError."""
    command = [find_program(), *map(os.fspath, map(str_or_path, arguments))]
    with started(command, stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True) as process:
        errors = process.communicate()[1].strip()
    if process.returncode == INTERRUPTED:
        raise KeyboardInterrupt(errors)
    if process.returncode != 0:
        raise RuntimeError(errors or f"nvm {arguments[0]} ended with {process.returncode}")


def str_or_path(argument):
    return argument if isinstance(argument, os.PathLike) else str(argument)


def export(voxel_map, out) -> pathlib.Path:
    """Write a map as points with normals and sides, for CloudCompare, MeshLab, PCL and others.

    Parameters
    ----------
    voxel_map : VoxelMap or path
        A map, or a file of one: that of ``nvm run`` lies where ``map_origin.txt`` beside it says.
    out : path
        A ``.ply`` or ``.pcd`` file, or a ``.image``, which `load` has in milliseconds and programs share.

    Returns
    -------
    pathlib.Path
        `out`.

    Raises
    ------
    RuntimeError
        With what the program says.
    """
    with contextlib.ExitStack() as files:
        if isinstance(voxel_map, VoxelMap):
            folder = files.enter_context(tempfile.TemporaryDirectory(prefix="nvm-export-"))
            saved = pathlib.Path(folder) / "map.nvm"
            voxel_map.save(saved)
            voxel_map = saved
        call("export", voxel_map, "--out", out)
    return pathlib.Path(out)


def simulate(scene, out, *, sensor="mid360", seed=1, duration=0.0, settings=None) -> pathlib.Path:
    """Simulate a LiDAR and an IMU in a scene, as a sequence for ``nvm run`` with its truth.

    Parameters
    ----------
    scene : str or path
        Name of a shipped scene (``nvm simulate --list-scenes``), or a scene file.
    out : path
        Folder of the sequence, which must not exist.
    sensor : str
        See ``nvm simulate --list-sensors``.
    seed : int
        Of all noise and of the walk's details.
    duration : float
        [s]; 0: to the end of the route.
    settings : dict, optional
        As behind ``--set``: ``{"lidar.range_noise": 0.02}``.

    Returns
    -------
    pathlib.Path
        `out`.

    Raises
    ------
    ValueError
        For settings that are no dict.
    RuntimeError
        With what the program says.
    """
    if not isinstance(settings or {}, dict):
        raise ValueError(f"settings must be a dict of keys and values, not {settings!r}")
    words = ["--sensor", sensor, "--seed", seed, "--duration", duration]
    for key, value in (settings or {}).items():
        words += ["--set", f"{key}={json.dumps(value, default=float)}"]
    name = os.fspath(scene)
    call("simulate", f"./{name}" if name.startswith("-") else name, "--out", out, *words)  # else an option
    return pathlib.Path(out)


def evaluate(runs, out, *, truth=None, align="se3", regions=None) -> dict:
    """Compare trajectories and maps of runs with the truth.

    Parameters
    ----------
    runs : path or sequence of paths
        Folders of ``nvm run``, or TUM files.
    out : path
        Folder of evaluation.json and, where matplotlib and jinja2 are installed, report.html.
    truth : path, optional
        Sequence folder or TUM file.
    align : 'se3', 'sim3' or 'none'
    regions : path, optional
        YAML file of boxes around walls.

    Returns
    -------
    dict
        What evaluation.json holds.

    Raises
    ------
    RuntimeError
        With what the program says.
    """
    folders = [runs] if isinstance(runs, (str, os.PathLike)) else list(runs)
    words = ["--align", align]
    for name, value in (("--truth", truth), ("--regions", regions)):
        words += [name, value] if value is not None else []
    call("evaluate", *folders, "--out", out, *words)
    with contextlib.suppress(ImportError):
        from .report import write_report

        write_report(out)
    return json.loads((pathlib.Path(out) / "evaluation.json").read_text())
