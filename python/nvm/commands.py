# SPDX-License-Identifier: MIT
# Copyright (c) 2026 The nvm authors
"""Commands of the C++ program as functions: ``nvm simulate`` and ``nvm evaluate``."""

from __future__ import annotations

import contextlib
import json
import os
import pathlib
import subprocess

from .program import find_program


def call(*arguments) -> None:
    """Runs the program; what it says when it fails becomes a RuntimeError."""
    command = [find_program(arguments[0]), *map(os.fspath, map(str_or_path, arguments))]
    done = subprocess.run(command, capture_output=True, text=True, check=False)
    if done.returncode != 0:
        raise RuntimeError(done.stderr.strip() or f"nvm {arguments[0]} ended with {done.returncode}")


def str_or_path(argument):
    return argument if isinstance(argument, os.PathLike) else str(argument)


def simulate(scene, out, *, sensor="mid360", seed=1, duration=0.0, settings=None) -> pathlib.Path:
    """Simulate a LiDAR and an IMU in a scene: with the program of nvm-tools on the PATH, or one that
    ``NVM_PROGRAM`` names.

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
    RuntimeError
        With what the program says.
    """
    words = ["--sensor", sensor, "--seed", seed, "--duration", duration]
    for key, value in (settings or {}).items():
        words += ["--set", f"{key}={json.dumps(value, default=float)}"]
    call("simulate", scene, "--out", out, *words)
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
