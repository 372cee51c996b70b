# SPDX-License-Identifier: MIT
# Copyright (c) 2026 The nvm authors
"""Every line of docs/tutorials.md, in their order, in one folder."""

import pathlib
import re
import shlex

import numpy as np
import pytest

pytest.importorskip("rosbags")
from recordings import CLOUD, IMU, POINT, write
from sequences import PERIOD, SECONDS, readings, scan
from support import nvm

PAGE = pathlib.Path(__file__).parents[2] / "docs" / "tutorials.md"


def walk(rng):
    """A maker of the walk as messages."""

    def make(m):
        for time, gyro, accel in zip(*readings(rng)):
            yield "/imu", IMU, 100.0 + time, m.imu(100.0 + time, gyro, accel, frame="lidar")
        for i in range(round(SECONDS / PERIOD)):
            begin = PERIOD * i
            records = np.zeros(3000, POINT)
            points, dt = scan(rng, begin)
            records["x"], records["y"], records["z"] = points.T
            records["t"] = np.round(1e9 * dt)
            yield "/points", CLOUD, 100.0 + begin + PERIOD, m.cloud(100.0 + begin, records)

    return make


def test_every_line(tmp_path, monkeypatch):
    write(tmp_path / "walk", "mcap", walk(np.random.default_rng(5)))
    monkeypatch.chdir(tmp_path)
    names = {}
    for language, code in re.findall(r"```(python|sh)\n(.*?)```", PAGE.read_text(), re.DOTALL):
        if language == "python":
            exec(compile(code, PAGE.name, "exec"), names)
            continue
        for line in code.splitlines():
            done = nvm(*shlex.split(line)[1:])
            assert done.returncode == 0, f"{line}: {done.stderr}"
    assert names["voxel_map"].stats().two_sided_voxels > 20
    assert np.ptp(names["y_without"]) > 0.03 and np.all(names["y_with"] < 0.1)
    assert names["result"].status == "converged" and names["result"].degenerate_directions == 3
    assert names["result"].T_map_scan[1, 3] == pytest.approx(-2.0, abs=0.002)
    assert [wall["thickness"] for wall in names["walls"]] == [pytest.approx(0.1, abs=0.002)]
