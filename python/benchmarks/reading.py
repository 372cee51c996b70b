# SPDX-License-Identifier: MIT
# Copyright (c) 2026 The nvm authors
"""What reading a recording by Python costs ``nvm run``, beside the program's own reader.

usage: reading.py SEQUENCE [ROUNDS]

SEQUENCE is an nvm sequence (nvm simulate). It is written as a ROS 1 bag and as ROS 2 bags; the program
runs on the ROS 1 bag by itself, and each of them is run through the package, in turns. CPU time of the
program and of Python, and the time on the wall: those of the round of ROUNDS (5) with the least CPU time.
"""

import json
import pathlib
import resource
import subprocess
import sys
import tempfile
import time

import numpy as np

sys.path.append(str(pathlib.Path(__file__).parents[1] / "tests"))
from recordings import CLOUD, IMU, TF, write  # noqa: E402
from sequences import RECORD  # noqa: E402

from nvm.program import find_program  # noqa: E402

POINT = np.dtype([("x", "f4"), ("y", "f4"), ("z", "f4"), ("intensity", "f4"), ("t", "u4"), ("ring", "u2"), ("pad", "u2")])
COMMAND = [sys.executable, "-c", "import sys; from nvm_command import main; sys.exit(main())"]
OWN = "bag, the program's own reader"


def extrinsic(sequence):
    """Translation [m] and quaternion of T_imu_lidar."""
    pose = json.loads((sequence / "meta.json").read_text())["T_imu_lidar"]
    return pose["translation"], pose["quaternion_xyzw"]


def messages(sequence):
    """A maker of the messages of a sequence, in order of time."""

    def make(m):
        imu = np.loadtxt(sequence / "imu.csv", delimiter=",", skiprows=1)
        scans = np.genfromtxt(sequence / "scans.csv", delimiter=",", names=True, dtype=None, encoding="utf-8")
        yield "/tf_static", TF, imu[0, 0], m.transforms(("imu", "lidar", *extrinsic(sequence)))
        done = 0
        for _, begin, end, file in scans:
            while done < len(imu) and imu[done, 0] <= end:
                row = imu[done]
                yield "/imu", IMU, row[0], m.imu(row[0], row[1:4], row[4:7])
                done += 1
            scan = np.fromfile(sequence / file, RECORD)
            points = np.zeros(len(scan), POINT)
            points["x"], points["y"], points["z"] = scan["xyz"].T
            points["intensity"], points["ring"] = scan["intensity"], scan["ring"]
            points["t"] = np.round(1e9 * np.maximum(scan["dt"], 0.0))
            yield "/points", CLOUD, end, m.cloud(begin, points)

    return make


def measured(command):
    """CPU time of a command with all that it starts, and its time on the wall [s]."""
    before, begin = resource.getrusage(resource.RUSAGE_CHILDREN), time.perf_counter()
    done = subprocess.run(command, capture_output=True, text=True)
    wall, after = time.perf_counter() - begin, resource.getrusage(resource.RUSAGE_CHILDREN)
    if done.returncode != 0:
        sys.exit(f"{command}: {done.stderr}")
    return after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime, wall


def main(sequence, rounds):
    with tempfile.TemporaryDirectory() as folder:
        folder = pathlib.Path(folder)
        bags = {form: write(folder / f"walk_{form}", form, messages(sequence)) for form in ("bag", "mcap", "db3", "zstd")}
        numbers = [value for part in extrinsic(sequence) for value in part]
        options = ["--out", folder / "out"]
        setting = ["--set", f"input.T_imu_lidar={numbers}"]
        commands = {OWN: [find_program(), "run", bags["bag"], *options, *setting]}
        commands |= {f"{form}, through Python": [*COMMAND, "run", bag, *options] for form, bag in bags.items()}
        best = {name: (np.inf, np.inf) for name in commands}
        for _ in range(rounds):
            for name, command in commands.items():
                best[name] = min(best[name], measured(command))
        size = bags["bag"].stat().st_size
    print(f"{sequence}: {size / 1e6:.0f} MB")
    for name, (cpu, wall) in best.items():
        print(f"{name:<30} CPU {cpu:7.2f} s {cpu / best[OWN][0]:6.3f}   wall {wall:7.2f} s {wall / best[OWN][1]:6.3f}")


if __name__ == "__main__":
    main(pathlib.Path(sys.argv[1]), int(sys.argv[2]) if len(sys.argv) > 2 else 5)
