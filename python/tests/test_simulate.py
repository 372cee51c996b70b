# SPDX-License-Identifier: MIT
# Copyright (c) 2026 The nvm authors
"""The simulator of the package: the same as any other build of it, and what it makes runs, also as a bag."""

import json
import os
import pathlib
import re
import signal
import subprocess
import sys
import time

import numpy as np
import pytest
from recordings import CLOUD, IMU, write
from sequences import RECORD
from support import nvm as command

import nvm

TOOLS = os.environ.get("NVM_TOOLS")  # the folder of a program with Debian's Embree

MESH_SCENE = """
meshes: [{name: screen, file: screen.obj, at: [3, 0]}]
boxes: [{name: floor, min: [-6, -6, -0.2], max: [6, 6, 0]}]
route: {speed: 0.5, waypoints: [[-2, -1], [0, 1]]}
"""


def scans(sequence):
    rows = (sequence / "scans.csv").read_text().splitlines()[1:]
    return [np.fromfile(sequence / row.split(",")[3], RECORD) for row in rows]


def test_what_is_simulated_runs_and_is_scored(tmp_path):
    sequence = nvm.simulate("wall5", tmp_path / "sequence", sensor="vlp16", duration=6.0)
    assert command("run", sequence, "--out", tmp_path / "out").returncode == 0
    report = nvm.evaluate(tmp_path / "out", tmp_path / "report", truth=sequence)
    assert json.loads((tmp_path / "report" / "evaluation.json").read_text()) == report
    assert len(report["runs"]) == 1 and (tmp_path / "report" / "report.html").is_file()


def test_seeds_and_settings_decide_what_comes(tmp_path):
    first, again, other = (
        nvm.simulate("wall5", tmp_path / name, duration=1.0, seed=seed)
        for name, seed in (("first", 1), ("again", 1), ("other", 2))
    )
    assert (first / "imu.csv").read_bytes() == (again / "imu.csv").read_bytes()
    assert all(np.array_equal(a, b) for a, b in zip(scans(first), scans(again), strict=True))
    assert (first / "imu.csv").read_bytes() != (other / "imu.csv").read_bytes()
    slow = nvm.simulate("wall5", tmp_path / "slow", duration=1.0, settings={"lidar.scan_rate": 5})
    assert len(scans(slow)) == 5
    for scene in ("no_such_scene", "--list-scenes"):
        with pytest.raises(RuntimeError, match=scene):
            nvm.simulate(scene, tmp_path / "none")
    with pytest.raises(RuntimeError, match="--seed"):
        nvm.simulate("wall5", tmp_path / "none", seed=-1)
    with pytest.raises(ValueError, match="dict"):
        nvm.simulate("wall5", tmp_path / "none", settings=[1])


def test_an_interrupted_simulation_leaves_nothing(tmp_path):
    process = subprocess.Popen(
        [sys.executable, "-c", "import nvm; nvm.simulate('rooms', 'out')"],
        cwd=tmp_path,
        stderr=subprocess.PIPE,
        preexec_fn=lambda: signal.signal(signal.SIGINT, signal.default_int_handler),
    )
    while not any(tmp_path.iterdir()):
        time.sleep(0.05)
    time.sleep(1.0)
    process.send_signal(signal.SIGINT)
    assert b"KeyboardInterrupt" in process.communicate(timeout=60)[1]
    assert list(tmp_path.iterdir()) == []


@pytest.mark.skipif(not TOOLS, reason="needs $NVM_TOOLS")
def test_another_embree_sees_the_same(tmp_path, monkeypatch):
    mine = nvm.simulate("cafe", tmp_path / "mine", sensor="vlp16", duration=1.0)
    monkeypatch.setenv("NVM_PROGRAM", str(pathlib.Path(TOOLS) / "nvm"))
    theirs = nvm.simulate("cafe", tmp_path / "theirs", sensor="vlp16", duration=1.0)
    assert (mine / "imu.csv").read_bytes() == (theirs / "imu.csv").read_bytes()
    for a, b in zip(scans(mine), scans(theirs), strict=True):
        # A ray along an edge may meet either side of it.
        assert len(a) == len(b) and np.mean(np.abs(a["xyz"] - b["xyz"]).max(axis=1) > 1e-4) < 1e-3


def test_meshes_are_seen(tmp_path):
    (tmp_path / "screen.obj").write_text("v 0 -4 0\nv 0 4 0\nv 0 4 3\nv 0 -4 3\nf 1 2 3 4\n")
    scene = tmp_path / "scene.yaml"
    scene.write_text(MESH_SCENE)
    settings = {"lidar.range_noise": 0.0}
    sequence = nvm.simulate(scene, tmp_path / "sequence", sensor="vlp16", duration=1.0, settings=settings)
    ranges = np.linalg.norm(scans(sequence)[0]["xyz"], axis=1)
    assert np.count_nonzero(ranges > 4.9) > 500  # the screen, 5 m before the start


def messages_of(sequence, m):
    """Those of a driver, an hour later."""
    rows = (sequence / "scans.csv").read_text().splitlines()[1:]
    clouds = [(float(row.split(",")[1]), scan) for row, scan in zip(rows, scans(sequence), strict=True)]
    readings = np.loadtxt(sequence / "imu.csv", delimiter=",", skiprows=1)
    messages = []
    for begin, scan in clouds:
        points = np.empty(len(scan), [("x", "f4"), ("y", "f4"), ("z", "f4"), ("intensity", "f4"), ("time", "f4")])
        points["x"], points["y"], points["z"] = scan["xyz"].T
        points["intensity"], points["time"] = scan["intensity"], scan["dt"]
        messages.append(("/points", CLOUD, begin + 3600.0, m.cloud(begin + 3600.0, points)))
    for time, *values in readings:
        messages.append(("/imu", IMU, time + 3600.0, m.imu(time + 3600.0, values[:3], values[3:])))
    return sorted(messages, key=lambda message: message[2])


def test_a_bag_comes_once_more_when_its_imu_was_late(tmp_path):
    late = {"imu.clock_offset": 0.06}
    sequence = nvm.simulate("wall5", tmp_path / "walk", sensor="vlp16", duration=14.0, seed=3, settings=late)
    bag = write(tmp_path / "bag", "mcap", lambda m: messages_of(sequence, m))
    pose = json.loads((sequence / "meta.json").read_text())["T_imu_lidar"]
    extrinsic = f"input.T_imu_lidar={pose['translation'] + pose['quaternion_xyzw']}"
    outcomes = {name: command("run", path, "--out", tmp_path / name, "--set", extrinsic) for name, path in
                (("from_bag", bag), ("from_folder", sequence))}
    for name, done in outcomes.items():
        again = re.findall(r"begins again, with imu.time_offset=-0\.0(?:5[789]|6)", done.stderr)
        assert done.returncode == 0 and len(again) == 1, done.stderr
        outcomes[name] = np.loadtxt(tmp_path / name / "trajectory.tum")
    np.testing.assert_allclose(outcomes["from_bag"][:, 1:], outcomes["from_folder"][:, 1:], rtol=0, atol=1e-3)
    assert sorted(os.listdir(tmp_path / "from_bag")) == sorted(os.listdir(tmp_path / "from_folder"))
