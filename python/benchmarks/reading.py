# SPDX-License-Identifier: MIT
# Copyright (c) 2026 The nvm authors
"""What reading a recording by Python costs ``nvm run``, beside the program's own reader.

usage: reading.py SEQUENCE [ROUNDS]

SEQUENCE is an nvm sequence (nvm simulate). It is written as a ROS 1 bag and as ROS 2 bags; the program
runs on the ROS 1 bag by itself, and on each of them through the package. CPU time of the program and of
Python, and the time on the wall, the best of ROUNDS (3).
"""

import pathlib
import resource
import subprocess
import sys
import tempfile
import time

import numpy as np

sys.path.append(str(pathlib.Path(__file__).parents[1] / "tests"))
from recordings import CLOUD, IMU, write  # noqa: E402
from sequences import RECORD  # noqa: E402

from nvm.program import find_program, run_program  # noqa: E402

POINT = np.dtype([("x", "f4"), ("y", "f4"), ("z", "f4"), ("intensity", "f4"), ("t", "u4"), ("ring", "u2"), ("pad", "u2")])


def messages(sequence):
    """A maker of the messages of a sequence, in order of time."""

    def make(m):
        imu = np.loadtxt(sequence / "imu.csv", delimiter=",", skiprows=1)
        scans = np.genfromtxt(sequence / "scans.csv", delimiter=",", names=True, dtype=None, encoding="utf-8")
        done = 0
        for _, begin, end, file in scans:
            while done < len(imu) and imu[done, 0] <= end:
                row = imu[done]
                yield "/imu", IMU, row[0], m.imu(row[0], row[1:4], row[4:7], frame="lidar")
                done += 1
            scan = np.fromfile(sequence / file, RECORD)
            points = np.zeros(len(scan), POINT)
            points["x"], points["y"], points["z"] = scan["xyz"].T
            points["intensity"], points["ring"] = scan["intensity"], scan["ring"]
            points["t"] = np.round(1e9 * np.maximum(scan["dt"], 0.0))
            yield "/points", CLOUD, end, m.cloud(begin, points)

    return make


def used(who):
    usage = resource.getrusage(who)
    return usage.ru_utime + usage.ru_stime


def measured(action, rounds):
    """CPU time of children and of this process, and time on the wall [s]: of the round with the least CPU."""
    results = []
    for _ in range(rounds):
        before = used(resource.RUSAGE_CHILDREN), used(resource.RUSAGE_SELF), time.perf_counter()
        if action() != 0:
            sys.exit("the run failed")
        after = used(resource.RUSAGE_CHILDREN), used(resource.RUSAGE_SELF), time.perf_counter()
        results.append([b - a for a, b in zip(before, after)])
    return min(results, key=lambda r: r[0] + r[1])


def main(sequence, rounds):
    with tempfile.TemporaryDirectory() as folder:
        folder = pathlib.Path(folder)
        bags = {form: write(folder / f"walk_{form}", form, messages(sequence)) for form in ("bag", "mcap", "db3")}
        out = str(folder / "out")

        def by_the_program():
            return subprocess.run([find_program(), "run", bags["bag"], "--out", out], capture_output=True).returncode

        rows = {"ROS 1 bag, the program's own reader": measured(by_the_program, rounds)}
        for form, bag in bags.items():
            action = lambda bag=bag: run_program(["run", str(bag), "--out", out])  # noqa: E731
            rows[f"{form}, through Python"] = measured(action, rounds)
        size = bags["bag"].stat().st_size
    reference = rows["ROS 1 bag, the program's own reader"]
    print(f"{sequence}: {size / 1e6:.0f} MB")
    for name, (program, python, wall) in rows.items():
        share = (program + python) / reference[0]
        print(f"{name:<38} CPU {program:6.2f} + {python:5.2f} s {share:6.3f}   wall {wall:6.2f} s {wall / reference[2]:6.3f}")


if __name__ == "__main__":
    main(pathlib.Path(sys.argv[1]), int(sys.argv[2]) if len(sys.argv) > 2 else 3)
