#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
# Copyright (c) 2026 The nvm authors
"""Build a real host with its own map and with nvm's, and run both on a simulated sequence.

small_gicp comes from its PyPI source package. KISS-ICP's holds no C++ and fetches it when it is
built, so KISS-ICP comes from --source or else from its repository. What cannot be had is skipped
(exit code 77) with a message.
"""
import argparse
import os
import pathlib
import shutil
import subprocess
import sys
import tarfile

HERE = pathlib.Path(__file__).resolve().parent
ROOT = HERE.parents[2]
SKIPPED = 77


def skip(message, command_output=""):
    reason = (command_output.strip().splitlines() or ["no reason given"])[-1]
    print(f"skipped: {message}: {reason}")
    sys.exit(SKIPPED)


def download(package, version, folder):
    """Folder of a PyPI package's sources, downloaded unless it is there."""
    sources = folder / f"{package}-{version}"
    if not sources.exists():
        command = [sys.executable, "-m", "pip", "download", "--no-deps", "--no-binary", package]
        run = subprocess.run(
            command + [f"{package}=={version}", "-d", str(folder)], capture_output=True, text=True
        )
        if run.returncode != 0:
            skip(f"pip cannot download {package} {version}", run.stderr)
        with tarfile.open(folder / f"{package}-{version}.tar.gz") as archive:
            archive.extractall(folder)
    return sources


def clone(repository, tag, folder):
    """Folder of a repository at a tag, cloned unless it is there."""
    sources = folder / f"{repository.split('/')[-1]}-{tag}"
    if not sources.exists():
        command = ["git", "clone", "--quiet", "--depth", "1", "--branch", tag]
        run = subprocess.run(
            command + [f"https://github.com/{repository}", str(sources)],
            capture_output=True,
            text=True,
        )
        if run.returncode != 0:
            skip(f"no --source, and git cannot clone {repository}", run.stderr)
    return sources


def compile_program(arguments, program, sources, includes, libraries=()):
    command = [arguments.compiler, "-std=c++17", "-O2"]
    command += [f"-I{folder}" for folder in (ROOT, ROOT / "include", HERE, *includes)]
    for folder in (*arguments.include, arguments.eigen):
        command += ["-isystem", str(folder)]
    subprocess.run([*command, *map(str, sources), *libraries, "-o", str(program)], check=True)
    return program


def build_small_gicp(arguments):
    sources = arguments.source or download("small_gicp", "1.0.1", arguments.folder)
    program = compile_program(
        arguments,
        arguments.folder / "small_gicp_odometry",
        [HERE / "small_gicp_odometry.cpp"],
        [sources / "include"],
    )
    return {"own": program, "transparent": program, "nvm": program}


def replace_map(sources, folder):
    """A copy of KISS-ICP that has been changed as docs/adapters/kiss_icp.md says."""
    shutil.rmtree(folder, ignore_errors=True)
    shutil.copytree(sources / "cpp", folder / "cpp")
    core = folder / "cpp" / "kiss_icp" / "core"
    shutil.copy(ROOT / "adapters" / "kiss_icp" / "shim" / "VoxelHashMap.hpp", core)
    (core / "VoxelHashMap.cpp").unlink()
    return folder


def build_kiss_icp(arguments):
    sources = arguments.source or clone("PRBonn/kiss-icp", "v1.2.3", arguments.folder)
    if not arguments.include:
        arguments.include.append(clone("strasdat/Sophus", "1.24.6", arguments.folder))
    programs = {}
    for kind in ("own", "nvm"):
        tree = sources if kind == "own" else replace_map(sources, arguments.folder / "kiss_icp_nvm")
        host = tree / "cpp" / "kiss_icp"
        programs[kind] = compile_program(
            arguments,
            arguments.folder / f"kiss_icp_odometry_{kind}",
            [*host.glob("core/*.cpp"), *host.glob("pipeline/*.cpp"), HERE / "kiss_icp_odometry.cpp"],
            [tree / "cpp"],
            ["-DSOPHUS_USE_BASIC_LOGGING", "-ltbb"],
        )
    return {"own": programs["own"], "transparent": programs["nvm"], "nvm": programs["nvm"]}


HOSTS = {"small_gicp": build_small_gicp, "kiss_icp": build_kiss_icp}


def simulate(nvm, folder):
    """A short sequence past a 5 cm wall, made unless it is there."""
    sequence = folder / "wall5"
    if not sequence.exists():
        command = [nvm, "simulate", "wall5", "--sensor", "vlp16", "--duration", "8"]
        subprocess.run(command + ["--out", str(sequence)], check=True)
    return sequence


def parse():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("host", choices=HOSTS)
    parser.add_argument("folder", type=pathlib.Path, help="for downloads, programs and results")
    parser.add_argument(
        "--source", type=pathlib.Path, help="the host's sources; default: $NVM_<HOST>_SOURCE"
    )
    parser.add_argument(
        "--include", type=pathlib.Path, action="append", default=[], help="for the host's libraries"
    )
    parser.add_argument("--nvm", help="the nvm program; without it the host is only compiled")
    parser.add_argument("--sequence", help="nvm sequence to run on; default: a short simulated one")
    parser.add_argument("--compiler", default="c++")
    parser.add_argument("--eigen", default="/usr/include/eigen3", help="include directory")
    arguments = parser.parse_args()
    source = os.environ.get(f"NVM_{arguments.host.upper()}_SOURCE")
    if arguments.source is None and source:
        arguments.source = pathlib.Path(source)
    return arguments


def main():
    arguments = parse()
    arguments.folder.mkdir(parents=True, exist_ok=True)
    programs = HOSTS[arguments.host](arguments)
    if not arguments.nvm:
        return
    sequence = arguments.sequence or simulate(arguments.nvm, arguments.folder)
    results = [arguments.folder / f"results_{arguments.host}" / kind for kind in programs]
    for result in results:
        subprocess.run([programs[result.name], result.name, sequence, result], check=True)
    report = arguments.folder / f"report_{arguments.host}"
    command = [arguments.nvm, "evaluate", *results, "--truth", sequence, "--out", report]
    subprocess.run(command, check=True)


if __name__ == "__main__":
    main()
