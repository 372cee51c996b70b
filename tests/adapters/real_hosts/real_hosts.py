#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
# Copyright (c) 2026 The nvm authors
"""Build small_gicp from its PyPI source package against nvm's adapter and run both maps.

Without a package index the test is skipped (exit code 77) with a message. KISS-ICP cannot be had
this way: its source package holds no C++ and fetches it elsewhere when it is built.
"""
import argparse
import pathlib
import subprocess
import sys
import tarfile

ROOT = pathlib.Path(__file__).resolve().parents[3]
PACKAGE = "small_gicp"
VERSION = "1.0.1"
SKIPPED = 77


def fetch(folder):
    """Folder of the package's sources, downloaded unless it is there."""
    sources = folder / f"{PACKAGE}-{VERSION}"
    if sources.exists():
        return sources
    command = [sys.executable, "-m", "pip", "download", "--no-deps", "--no-binary", PACKAGE]
    download = subprocess.run(
        command + [f"{PACKAGE}=={VERSION}", "-d", str(folder)], capture_output=True, text=True
    )
    if download.returncode != 0:
        reason = (download.stderr.strip().splitlines() or ["no reason given"])[-1]
        print(f"skipped: pip cannot download {PACKAGE} {VERSION}: {reason}")
        sys.exit(SKIPPED)
    with tarfile.open(folder / f"{PACKAGE}-{VERSION}.tar.gz") as archive:
        archive.extractall(folder)
    return sources


def build(sources, folder, compiler, eigen):
    program = folder / "small_gicp_odometry"
    source = pathlib.Path(__file__).with_name("small_gicp_odometry.cpp")
    includes = [f"-I{ROOT}", f"-I{ROOT / 'include'}", f"-I{sources / 'include'}"]
    command = [compiler, "-std=c++17", "-O2", *includes, "-isystem", eigen, str(source)]
    subprocess.run(command + ["-o", str(program)], check=True)
    return program


def simulate(nvm, folder):
    """A short sequence past a 5 cm wall, made unless it is there."""
    sequence = folder / "wall5"
    if not sequence.exists():
        command = [nvm, "simulate", "wall5", "--sensor", "vlp16", "--duration", "8"]
        subprocess.run(command + ["--out", str(sequence)], check=True)
    return sequence


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("folder", type=pathlib.Path, help="for downloads, programs and results")
    parser.add_argument("--nvm", help="the nvm program; without it the host is only compiled")
    parser.add_argument("--sequence", help="nvm sequence to run on; default: a short simulated one")
    parser.add_argument("--compiler", default="c++")
    parser.add_argument("--eigen", default="/usr/include/eigen3", help="include directory")
    arguments = parser.parse_args()
    arguments.folder.mkdir(parents=True, exist_ok=True)
    sources = fetch(arguments.folder)
    program = build(sources, arguments.folder, arguments.compiler, arguments.eigen)
    if not arguments.nvm:
        return
    sequence = arguments.sequence or simulate(arguments.nvm, arguments.folder)
    results = [arguments.folder / "results" / kind for kind in ("own", "transparent", "nvm")]
    for result in results:
        subprocess.run([program, result.name, sequence, result], check=True)
    command = [arguments.nvm, "evaluate", *results, "--truth", sequence]
    subprocess.run(command + ["--out", arguments.folder / "report"], check=True)


if __name__ == "__main__":
    main()
