# SPDX-License-Identifier: MIT
# Copyright (c) 2026 The nvm authors
"""A walk around a thin wall, as a folder that the program reads (docs/formats.md), without a simulator."""

import json
import pathlib

import numpy as np
from support import unit

RECORD = np.dtype([("xyz", "<f4", 3), ("intensity", "<f4"), ("dt", "<f4"), ("ring", "<u2"), ("pad", "<u2")])
ROOM = np.array([[-4.0, -3.0, -1.2], [4.5, 3.5, 1.8]])  # [m], seen from inside
WALL = np.array([[-0.9, -0.05, -1.2], [0.9, 0.05, 1.2]])
SOLIDS = [WALL, [[3.2, -3.0, -1.2], [4.5, -2.2, 0.3]], [[-4.0, 2.0, -1.2], [-3.1, 3.5, 0.9]], [[2, 3, -1.2], [3, 3.5, 1]]]
GRAVITY = 9.80665  # [m/s^2]
SECONDS = 8
PERIOD = 0.1  # of a scan [s]
RADIUS = 1.8  # of the walk [m]


def ranges(origins, directions):
    """To the first surface along each ray [m]."""

    def crossings(box):
        times = (np.asarray(box)[:, None, :] - origins) / directions
        return times.min(axis=0).max(axis=1), times.max(axis=0).min(axis=1)

    nearest = crossings(ROOM)[1]
    for box in SOLIDS:
        enters, leaves = crossings(box)
        nearest = np.where((enters > 0) & (enters < leaves), np.minimum(nearest, enters), nearest)
    return nearest


def positions(times):
    """Of the sensor, which goes once around the wall without turning, from rest to rest [m]."""
    u = np.clip((np.asarray(times) - 1.0) / (SECONDS - 1.5), 0.0, 1.0)
    angle = 2 * np.pi * u**3 * (10 - 15 * u + 6 * u**2)
    return RADIUS * np.stack([np.cos(angle) - 0.2, np.sin(angle), 0.1 * np.sin(2 * angle)], axis=-1)


def scan(rng, begin, count=3000, sweep=0.99 * PERIOD):
    """Points in the sensor's frame, each at its own time, and those times after `begin` [s]."""
    dt = np.linspace(0.0, sweep, count)
    directions = unit(rng.normal(size=(count, 3)) * (1, 1, 0.6))
    distances = ranges(positions(begin + dt), directions) + rng.normal(0.0, 0.005, count)
    return distances[:, None] * directions, dt


def readings(rng, rate=200.0):
    """Times [s], gyro [rad/s] and specific force [m/s^2] of the IMU at the sensor's place."""
    times = np.arange(0.0, SECONDS + 0.1, 1.0 / rate)
    step = 1e-3
    accel = (positions(times - step) - 2 * positions(times) + positions(times + step)) / step**2
    accel = accel + (0, 0, GRAVITY) + rng.normal(0.0, 0.02, accel.shape)
    return times, rng.normal(0.0, 0.002, accel.shape), accel


def write_sequence(folder, rng):
    """The walk as an nvm sequence with its truth; returns `folder`."""
    (folder / "scans").mkdir(parents=True)
    begins = [PERIOD * i for i in range(round(SECONDS / PERIOD))]
    lines = ["index,t_begin,t_end,file"]
    for i, begin in enumerate(begins):
        records = np.zeros(3000, RECORD)
        records["xyz"], records["dt"] = scan(rng, begin)
        records.tofile(folder / f"scans/{i:06}.bin")
        lines.append(f"{i},{begin!r},{begin + PERIOD!r},scans/{i:06}.bin")
    (folder / "scans.csv").write_text("\n".join(lines) + "\n")
    times, gyro, accel = readings(rng)
    rows = np.column_stack([times, gyro, accel])
    np.savetxt(folder / "imu.csv", rows, "%.17g", ",", header="t,gx,gy,gz,ax,ay,az", comments="")
    write_truth(folder / "groundtruth.tum", np.array(begins) + PERIOD)
    extrinsic = {"translation": [0, 0, 0], "quaternion_xyzw": [0, 0, 0, 1]}
    (folder / "meta.json").write_text(json.dumps({"T_imu_lidar": extrinsic}))
    return folder


def write_truth(path, times):
    poses = np.column_stack([times, positions(times), np.tile([0, 0, 0, 1], (len(times), 1))])
    np.savetxt(path, poses, "%.9f")


def write_walk(path):
    """The walk as a ROS 2 bag in the folder `path`, where it may be from a notebook before; returns it."""
    from recordings import write

    path = pathlib.Path(path)
    return path if path.exists() else write(path, "mcap", walk(np.random.default_rng(5)))


def walk(rng):
    """A maker of the walk as messages."""
    from recordings import CLOUD, IMU, POINT

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
