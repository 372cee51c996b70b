# SPDX-License-Identifier: MIT
# Copyright (c) 2026 The nvm authors
"""nvm.Odometry against the truth of simple motions, and against `nvm run` bit by bit."""

import json
import os
import pathlib

import numpy as np
import pytest
from sequences import RECORD, write_sequence
from support import box_room
from support import nvm as command

import nvm
from nvm.transforms import rotation

STEP = np.array([0.04, 0.02, 0.0])  # between two scans [m]
PERIOD = 0.1  # [s]


def walk(rng, scans=12, begin=0.0):
    """Scans (points, time) of a room by a sensor that walks without turning."""
    for i in range(scans):
        yield box_room(rng, 4000, noise=0.003) - i * STEP, begin + i * PERIOD


def still_imu(begin, end, rate=200.0):
    times = np.arange(begin, end, 1.0 / rate)
    return times, np.zeros((len(times), 3)), np.tile([0.0, 0.0, 9.80665], (len(times), 1))


def test_scans_alone_give_the_walk(rng):
    odometry = nvm.Odometry()
    frames = [odometry.register(points, time) for points, time in walk(rng)]
    assert {frame.status for frame in frames} == {"tracking"}
    np.testing.assert_allclose(frames[-1].T_map_body[:3, 3], 11 * STEP, atol=0.005)
    np.testing.assert_allclose(frames[-1].velocity, STEP / PERIOD, atol=0.05)
    assert 0 < frames[-1].pose_covariance[0, 0] < 1e-4
    assert frames[-1].time == pytest.approx(1.1) and frames[-1].points == 4000
    assert len(odometry.map) > 1000 and isinstance(odometry.map, nvm.VoxelMap)


def test_what_a_floor_alone_does_not_tell_is_said(rng):
    odometry = nvm.Odometry()
    for i in range(5):
        floor = np.column_stack([rng.uniform(-5, 5, (4000, 2)), rng.normal(-1.0, 0.003, 4000)])
        frame = odometry.register(floor, i * PERIOD)
    assert frame.inlier_share > 0.9
    assert frame.degenerate_directions == 3
    assert frame.unobserved_translations.shape == (2, 3) and frame.unobserved_rotations.shape == (1, 3)
    np.testing.assert_allclose(frame.unobserved_translations[:, 2], 0.0, atol=0.05)
    np.testing.assert_allclose(np.abs(frame.unobserved_rotations[0]), [0, 0, 1], atol=0.05)


def test_an_extrinsic_that_was_not_given_is_said():
    for odometry, expected in (
        (nvm.Odometry(), True),
        (nvm.Odometry(None, np.eye(4)), False),
        (nvm.Odometry({"pipeline": "lidar_only"}), False),
    ):
        assert odometry.findings() == []
        odometry.add_imu(*still_imu(0.0, 0.1))
        assert any("T_imu_lidar" in finding for finding in odometry.findings()) == expected


def test_accelerations_in_g_are_a_finding(rng):
    odometry = nvm.Odometry()
    assert odometry.findings() == []
    times, gyro, accel = still_imu(-2.0, 4.0)
    gyro += rng.normal(0.0, 0.002, gyro.shape)
    accel += rng.normal(0.0, 0.02, accel.shape)
    odometry.add_imu(times, gyro, accel / 9.80665)  # in g
    for i in range(30):
        odometry.register(box_room(rng, 4000, noise=0.003), i * PERIOD)
    assert any(" g" in finding for finding in odometry.findings()), odometry.findings()


def test_a_sweep_is_deskewed(rng):
    """Points at their own times, in any order, dated absolutely or from the begin."""
    ends = []
    for is_absolute in (True, False):
        odometry = nvm.Odometry()
        seeded = np.random.default_rng(3)
        places = []
        for i in range(10):
            begin = 1e9 + i * PERIOD
            after = seeded.permutation(np.linspace(0.0, 0.09, 4000))
            moved = ((i * PERIOD + after) / PERIOD)[:, None] * STEP
            points = box_room(seeded, 4000, noise=0.003) - moved
            if is_absolute:
                frame = odometry.register(points, begin + after)
            else:
                frame = odometry.register(points, after.astype(np.float32), begin=begin)
            places.append(frame.T_map_body[:3, 3])
        assert frame.status == "tracking"
        assert frame.time == pytest.approx(begin + 0.09, abs=1e-6)
        ends.append(places[-1])
        np.testing.assert_allclose(places[9] - places[4], 5 * STEP, atol=0.005)
        assert all(part.shape == odometry.scan[0].shape for part in odometry.scan)
    np.testing.assert_allclose(*ends, atol=1e-3)


def test_with_an_imu_at_rest(rng):
    odometry = nvm.Odometry({"pipeline": "fast_lio", "map.voxel_size": 0.25})
    odometry.add_imu(*still_imu(0.0, 1.0))
    for row in zip(*still_imu(1.0, 2.6)):  # one by one is the same
        odometry.add_imu(*row)
    frames = [odometry.register(box_room(rng, 4000, noise=0.003), 0.1 * i) for i in range(1, 26)]
    assert frames[0].status == "initializing" and frames[0].message
    assert frames[-1].status == "tracking"
    np.testing.assert_allclose(frames[-1].T_map_body, np.eye(4), atol=0.005)
    assert odometry.map.options["voxel_size"] == 0.25


def test_the_clock_of_the_imu_tells_which_readings_a_scan_needs():
    assert nvm.Odometry().imu_needed_until(5.0) == 5.0
    assert nvm.Odometry({"imu.time_offset": -0.25}).imu_needed_until(5.0) == 5.25


def test_readings_after_the_first_scan_are_refused_rather_than_ignored(rng):
    odometry = nvm.Odometry()
    odometry.register(*next(walk(rng)))
    with pytest.raises(RuntimeError, match="before scans"):
        odometry.add_imu(*still_imu(0.0, 0.1))
    alone = nvm.Odometry({"pipeline": "lidar_only"})
    alone.register(*next(walk(rng)))
    alone.add_imu(*still_imu(0.0, 0.1))


@pytest.mark.parametrize(
    "config, text",
    [
        ({"map": {"voxelsize": 1}}, "map.voxel_size"),
        ({"map.voxel_size": -1}, "voxel_size"),
        ({"pipeline": "slam"}, "fast_lio"),
        ({"map": 3}, "map"),
    ],
)
def test_bad_settings_are_named(config, text):
    with pytest.raises((ValueError, RuntimeError), match=text):
        nvm.Odometry(config)


def test_settings_come_from_a_file_or_from_numpy(tmp_path):
    (tmp_path / "nvm.yaml").write_text("map:\n  voxel_size: 0.2\n")
    assert nvm.Odometry(tmp_path / "nvm.yaml").map.options["voxel_size"] == 0.2
    settings = {"map": {"voxel_size": np.float64(0.2), "capacity": np.int64(1000)}}
    assert nvm.Odometry(settings).map.options["capacity"] == 1000
    with pytest.raises((RuntimeError, ValueError), match="none.yaml"):
        nvm.Odometry(tmp_path / "none.yaml")


@pytest.mark.parametrize(
    "arguments, text",
    [
        ((np.zeros((5, 2)), np.zeros(5)), r"points must have the shape \(N, 3\)"),
        ((np.zeros((5, 3)), np.zeros(4)), "times has 4 rows"),
        ((np.zeros((5, 3)), np.nan), "times must be a finite number"),
        ((np.zeros((5, 3)), np.full(5, 1e9, np.float32)), "too coarse"),
        ((np.zeros((5, 3)), 1e18 + np.linspace(0, 1e8, 5)), "span 1e.08 s: give them in seconds"),
        ((np.zeros((5, 3)), np.linspace(0, 100, 5), 10.0), "span 100 s"),
        ((np.zeros((5, 3)), np.full(5, -0.1), 10.0), "from begin to end"),
        ((np.zeros((5, 3)), np.full(5, 0.3), 10.0, 10.1), "from begin to end"),
        ((np.zeros((5, 3)), np.zeros(5), "now"), "begin must be a finite number"),
    ],
)
def test_bad_scans_are_named(arguments, text):
    with pytest.raises(ValueError, match=text):
        nvm.Odometry().register(*arguments)


def test_scans_without_use_are_skipped_and_odd_points_left_out(rng):
    odometry = nvm.Odometry()
    points, time = next(walk(rng))
    points[:100] = np.nan
    assert odometry.register(points[::-1], time).points == 3900
    assert odometry.register(np.empty((0, 3)), 1.0).status == "skipped"
    again = odometry.register(points, time)
    assert again.status == "skipped" and "newer" in again.message


def test_bad_readings_are_named_and_none_is_taken():
    odometry = nvm.Odometry()
    times, gyro, accel = still_imu(0.0, 0.1)
    accel[7, 1] = np.inf
    with pytest.raises(ValueError, match="row 7"):
        odometry.add_imu(times, gyro, accel)
    with pytest.raises(ValueError, match="gyro has"):
        odometry.add_imu(times, gyro[:-1], accel)
    with pytest.raises(ValueError, match="gyro must have the shape"):
        odometry.add_imu(0.0, [0, 0], [0, 0, 9.8])
    assert odometry.register(np.zeros((0, 3)), 0.0).status == "skipped"  # as without an IMU


def run_sequence(folder):
    """Times and T_map_body that nvm.Odometry makes of an nvm sequence."""
    extrinsic = json.loads((folder / "meta.json").read_text())["T_imu_lidar"]
    T = np.eye(4)
    T[:3, :3], T[:3, 3] = rotation(*extrinsic["quaternion_xyzw"]), extrinsic["translation"]
    odometry = nvm.Odometry(T_imu_lidar=T)
    imu = np.loadtxt(folder / "imu.csv", delimiter=",", skiprows=1)
    lines = (folder / "scans.csv").read_text().splitlines()[1:]
    given, poses = 0, []
    for begin, end, file in ((float(b), float(e), f) for _, b, e, f in (line.split(",") for line in lines)):
        ready = np.searchsorted(imu[:, 0], end, side="right")
        odometry.add_imu(imu[given:ready, 0], imu[given:ready, 1:4], imu[given:ready, 4:7])
        given = ready
        points = np.fromfile(folder / file, RECORD)
        frame = odometry.register(points["xyz"], points["dt"], begin=begin, end=end)
        if frame.status in ("tracking", "degenerate", "weak"):
            poses.append([frame.time, *frame.T_map_body[:3, 3]])
    return np.array(poses), odometry.map


TOOLS = os.environ.get("NVM_TOOLS")  # the folder of a program that is linked with Debian's libraries


@pytest.mark.parametrize(
    "program", ["", pytest.param(TOOLS, marks=pytest.mark.skipif(not TOOLS, reason="needs $NVM_TOOLS"))]
)
def test_gives_the_bits_of_nvm_run(rng, tmp_path, monkeypatch, program):
    """Those of the package's program, and of one built with Debian's libraries."""
    if program:
        monkeypatch.setenv("NVM_PROGRAM", str(pathlib.Path(program) / "nvm"))
    sequence = write_sequence(tmp_path / "walk", rng)
    done = command("run", sequence, "--out", tmp_path / "out")
    assert done.returncode == 0, done.stderr
    poses, voxel_map = run_sequence(sequence)
    expected = np.loadtxt(tmp_path / "out" / "trajectory.tum")
    assert len(expected) > 60
    np.testing.assert_allclose(poses, expected[:, :4], rtol=0, atol=1e-9)  # as TUM files print them
    np.testing.assert_array_equal(voxel_map.points, nvm.load(tmp_path / "out" / "map.nvm").points)


def test_maps_carry_the_intensities_of_the_returns(rng):
    odometry = nvm.Odometry()
    clouds = []
    for i, (points, time) in enumerate(walk(rng)):
        order = rng.permutation(len(points))
        odometry.register(points[order], time, intensity=10_000 * i + order)
        clouds.append(points)
        scan = odometry.scan[0]
        assert odometry.scan_intensity.shape == (len(scan),)
        rows = odometry.scan_intensity.astype(int) - 10_000 * i
        np.testing.assert_allclose(scan, points[rows], atol=0.05)  # deskewed
    assert len(odometry.map) > 100
    for number, point in zip(odometry.map.column("intensity").astype(int), odometry.map.points):
        scan, row = divmod(number, 10_000)
        np.testing.assert_allclose(point, clouds[scan][row] + scan * STEP, atol=0.03)
    with pytest.raises(ValueError, match="intensity"):
        odometry.register(points, time + 1, intensity=[1.0])
