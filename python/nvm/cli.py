# SPDX-License-Identifier: MIT
# Copyright (c) 2026 The nvm authors
"""The command ``nvm`` of the Python package."""

from __future__ import annotations

import argparse
import os
import sys
import tempfile

from . import __version__
from .bags import BagError
from .folders import is_url
from .recordings import is_recording, open_recording


def info(arguments) -> None:
    """Says what a recording, a saved map or a tile store holds."""
    from .info import described

    if is_recording(arguments.path) and not is_url(arguments.path):
        with open_recording(arguments.path) as recording:
            print(described(recording))
        return
    from . import load, open_store

    if is_url(arguments.path):
        describe_store(open_store(arguments.path), arguments.check)
        return
    if os.path.isdir(arguments.path):
        if not os.path.exists(os.path.join(arguments.path, "index.json")):
            raise RuntimeError(
                f"{arguments.path}: is neither a bag nor a store of tiles; of a folder of results name its map.nvm; "
                "folders of scans and nvm sequences go to nvm run"
            )
        describe_store(open_store(arguments.path), arguments.check)
        return
    voxel_map = load(arguments.path)
    print(voxel_map)
    for name, value in voxel_map.options.items():
        print(f"{name:<20} {value}")


def describe_store(store, is_to_check: bool) -> None:
    print(store)
    problems = store.check() if is_to_check else []
    if problems:
        raise RuntimeError("; ".join(problems))
    if is_to_check:
        print(f"all {len(store.tiles)} tiles are whole")


PROGRAM_COMMANDS = {
    "run": "estimate the trajectory and the two-sided map of a recording",
    "map": "build a two-sided map from scans at known poses",
    "merge": "put the maps of several runs of one place together",
    "walls": "list the walls of a map",
    "export": "write a saved map as points with normals and sides",
    "simulate": "simulate a LiDAR and an IMU in a scene",
    "evaluate": "compare trajectories and maps of runs with the truth",
}


def is_evaluation(path: str) -> bool:
    return os.path.exists(os.path.join(path, "evaluation.json"))


def view(arguments) -> None:
    """Shows finished results."""
    from .results import read_evaluation, read_results

    if is_evaluation(arguments.path):
        from .evaluation_viewer import show_evaluation

        show_evaluation(*read_evaluation(arguments.path), arguments.record)
        return
    from .viewer import RunLog, open_stream

    results = read_results(arguments.path)
    RunLog(open_stream(arguments.record)).results(results)


NO_PICTURES = "pictures take matplotlib and jinja2: pip install 'nvm[plot]'"


def plot(arguments) -> None:
    """Writes pictures of finished results, or the report of an evaluation."""
    try:
        from .plots import write_plots
        from .report import write_report
    except ImportError as error:
        raise RuntimeError(NO_PICTURES) from error
    from .results import read_results, read_trajectory

    if is_evaluation(arguments.path):
        print(*write_report(arguments.path), sep="\n")
        return
    results = read_results(arguments.path)
    truth = read_trajectory(arguments.truth) if arguments.truth else None
    beside = results.path if results.path.is_dir() else results.path.parent
    for path in write_plots(results, arguments.out or beside / "plots", truth):
        print(path)


def ifc(arguments) -> None:
    """Writes walls as IFC."""
    from .ifc import write_ifc

    out = arguments.out or os.path.splitext(arguments.walls)[0] + ".ifc"
    try:
        written = write_ifc(arguments.walls, out)
    except ImportError as error:
        raise RuntimeError("IFC takes ifcopenshell: pip install 'nvm[ifc]'") from error
    print(f"{out}: " + ", ".join(f"{count} {name}" for name, count in written.items()))


def evaluate(argv: list[str]) -> int:
    """Runs the program, and draws what it found."""
    from .program import run_program

    code = run_program(argv)
    folder = value_of("--out", argv)
    if code != 0 or folder is None or "--help" in argv:
        return code
    try:
        from .report import write_report
    except ImportError:
        print(f"nvm: note: {NO_PICTURES}", file=sys.stderr)
        return code
    print(write_report(folder)[0])
    return code


def walls(argv: list[str]) -> int:
    """Runs the program; a store behind a URL is copied for it."""
    from . import open_store
    from .program import run_program

    with tempfile.TemporaryDirectory(prefix="nvm-store-") as folder:
        for i in (i for i, argument in enumerate(argv) if is_url(argument)):
            open_store(argv[i]).copy_to(folder)
            argv = [*argv[:i], folder, *argv[i + 1 :]]
        return run_program(argv)


def value_of(option: str, argv: list[str]) -> str | None:
    """What follows an option on a command line."""
    reader = argparse.ArgumentParser(add_help=False, allow_abbrev=False)
    reader.add_argument(option, dest="value")
    return reader.parse_known_args(argv)[0].value


def run_watched(argv: list[str]) -> int:
    """Runs the program; with --view or --record what it does goes to rerun meanwhile."""
    from .program import run_program

    top = argparse.ArgumentParser(add_help=False, allow_abbrev=False)
    top.add_argument("--view", action="store_true")
    top.add_argument("--record")
    watching, rest = top.parse_known_args(argv)
    if "--help" in rest:
        code = run_program(rest)
        print("  --view                      Show the run in rerun while it goes on")
        print("  --record FILE               Keep that in an .rrd file instead")
        return code
    if not (watching.view or watching.record):
        return run_program(rest)
    folder = value_of("--out", rest)
    if folder is None:
        return run_program(rest)  # which says that it needs one
    from .viewer import RunFollower, open_stream

    with RunFollower(folder, open_stream(watching.record)) as follower:
        return run_program([rest[0], "--stream", f"/dev/fd/{follower.sink}", *rest[1:]], keeps=(follower.sink,))


def parser() -> argparse.ArgumentParser:
    top = argparse.ArgumentParser("nvm", description="Two-sided, normal-aware mapping with LiDAR")
    top.add_argument("--version", action="version", version=f"nvm {__version__}")
    commands = top.add_subparsers(required=True, metavar="COMMAND")
    command = commands.add_parser("info", help="say what a recording or a saved map holds")
    command.add_argument("path", help="a bag of ROS 1 or ROS 2, a map.nvm file, or a tile store or its URL")
    command.add_argument("--check", action="store_true", help="read every tile of a store")
    command.set_defaults(run=info)
    command = commands.add_parser("view", help="show the results of a run or an evaluation in rerun")
    command.add_argument("path", help="a folder of nvm run, nvm map or nvm evaluate, a map.nvm or a TUM file")
    command.add_argument("--record", metavar="FILE", help="write an .rrd file instead")
    command.set_defaults(run=view)
    command = commands.add_parser("plot", help="draw the results of a run, or the report of an evaluation")
    command.add_argument("path", help="as for view")
    command.add_argument("--out", metavar="FOLDER", help="of the pictures; default: plots beside them")
    command.add_argument("--truth", metavar="FILE", help="TUM file or nvm sequence, for the errors")
    command.set_defaults(run=plot)
    command = commands.add_parser("ifc", help="write the walls that nvm walls has found as IFC")
    command.add_argument("walls", help="a walls.json")
    command.add_argument("--out", metavar="FILE", help="default: beside it, with .ifc")
    command.set_defaults(run=ifc)
    for name, text in PROGRAM_COMMANDS.items():  # main() hands them over, with all their options
        commands.add_parser(name, help=text, add_help=False)
    return top


def main(argv: list[str] | None = None) -> int:
    """Runs the command; what is wrong goes to standard error in one line."""
    argv = sys.argv[1:] if argv is None else argv
    try:
        if argv and argv[0] in PROGRAM_COMMANDS:
            from .program import run_program

            ours = {"run": run_watched, "evaluate": evaluate, "walls": walls}
            return ours.get(argv[0], run_program)(argv)
        arguments = parser().parse_args(argv)
        arguments.run(arguments)
    except KeyboardInterrupt:
        return 130
    except MemoryError:
        print(f"nvm: memory ran out in nvm {' '.join(argv)}", file=sys.stderr)
        return 1
    except (BagError, ValueError, RuntimeError, OSError) as error:
        message = str(error)
        print(message if message.startswith("nvm: ") else f"nvm: {message}", file=sys.stderr)
        return 1
    return 0
