# SPDX-License-Identifier: MIT
# Copyright (c) 2026 The nvm authors
"""Sweeps and IMU readings as messages that ROS 1 has serialised."""

from __future__ import annotations

import dataclasses
import struct

import numpy as np

POINT = np.dtype([("x", "<f4"), ("y", "<f4"), ("z", "<f4"), ("intensity", "<f4"), ("t", "<u4"), ("ring", "<u2")])
DATATYPES = {"<f4": 7, "<u4": 6, "<u2": 4}  # of sensor_msgs/PointField
UNKNOWN = (0.0,) * 9  # a covariance


@dataclasses.dataclass(frozen=True)
class Sweep:
    """Points in the order of their times."""

    topic: str
    frame: str
    points: np.ndarray  # (N, 3) [m]
    times: np.ndarray  # (N,) [s], float64
    intensity: np.ndarray  # (N,)
    ring: np.ndarray  # (N,)


@dataclasses.dataclass(frozen=True)
class Readings:
    """Of an IMU."""

    topic: str
    frame: str
    times: np.ndarray  # (N,) [s], float64
    gyro: np.ndarray  # (N, 3) [rad/s]
    accel: np.ndarray  # (N, 3) [m/s^2]


def header_bytes(frame: str, time: float) -> bytes:
    seconds, nanoseconds = divmod(round(time * 1e9), 10**9)
    name = frame.encode()
    return struct.pack(f"<4I{len(name)}s", 0, seconds, nanoseconds, len(name), name)


def cloud_bytes(sweep: Sweep) -> bytes:
    """A PointCloud2 that is dated when its first point was measured."""
    size = len(sweep.points)
    records = np.zeros(size, POINT)
    for axis, name in enumerate("xyz"):
        records[name] = sweep.points[:, axis]
    records["intensity"], records["ring"] = sweep.intensity, sweep.ring
    records["t"] = np.round((sweep.times - sweep.times[0]) * 1e9)
    fields = [struct.pack("<I", len(POINT))]
    for name in POINT.names:
        kind, offset = POINT.fields[name][:2]
        text = name.encode()
        fields.append(struct.pack(f"<I{len(text)}sIBI", len(text), text, offset, DATATYPES[kind.str], 1))
    step = POINT.itemsize
    return b"".join(
        (
            header_bytes(sweep.frame, sweep.times[0]),
            struct.pack("<2I", 1, size),
            *fields,
            struct.pack("<B3I", 0, step, step * size, step * size),
            records.tobytes(),
            b"\1",
        )
    )


def imu_bytes(frame: str, time: float, gyro, accel) -> bytes:
    """An Imu without orientation."""
    no_orientation = (0.0, 0.0, 0.0, 1.0, -1.0, *UNKNOWN[1:])
    return header_bytes(frame, time) + struct.pack(
        "<37d", *no_orientation, *gyro, *UNKNOWN, *accel, *UNKNOWN
    )
