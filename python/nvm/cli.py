# SPDX-License-Identifier: MIT
# Copyright (c) 2026 The nvm authors
"""The command ``nvm`` of the Python package."""

from __future__ import annotations

import argparse
import sys

from . import __version__
from .bags import BagError, Recording, is_bag


def info(arguments) -> None:
    """Says what a recording or a saved map holds."""
    from .info import described

    if is_bag(arguments.path):
        with Recording(arguments.path) as recording:
            print(described(recording))
        return
    from . import load

    voxel_map = load(arguments.path)
    print(voxel_map)
    for name, value in voxel_map.options.items():
        print(f"{name:<20} {value}")


PROGRAM_COMMANDS = {
    "run": "estimate the trajectory and the two-sided map of a recording",
    "map": "build a two-sided map from scans at known poses",
    "export": "write a saved map as points with normals and sides",
    "simulate": "simulate a LiDAR and an IMU in a scene",
    "evaluate": "compare trajectories and maps of runs with the truth",
}


def parser() -> argparse.ArgumentParser:
    top = argparse.ArgumentParser("nvm", description="Two-sided, normal-aware mapping with LiDAR")
    top.add_argument("--version", action="version", version=f"nvm {__version__}")
    commands = top.add_subparsers(required=True, metavar="COMMAND")
    command = commands.add_parser("info", help="say what a recording or a saved map holds")
    command.add_argument("path", help="a bag of ROS 1 or ROS 2, or a map.nvm file")
    command.set_defaults(run=info)
    for name, text in PROGRAM_COMMANDS.items():  # main() hands them over, with all their options
        commands.add_parser(name, help=text, add_help=False)
    return top


def main(argv: list[str] | None = None) -> int:
    """Runs the command; what is wrong goes to standard error in one line."""
    argv = sys.argv[1:] if argv is None else argv
    try:
        if argv and argv[0] in PROGRAM_COMMANDS:
            from .program import run_program

            return run_program(argv)
        arguments = parser().parse_args(argv)
        arguments.run(arguments)
    except (BagError, ValueError, RuntimeError, OSError) as error:
        message = str(error)
        print(message if message.startswith("nvm: ") else f"nvm: {message}", file=sys.stderr)
        return 1
    return 0
