# SPDX-License-Identifier: MIT
# Copyright (c) 2026 The nvm authors
"""Topics of a recording, and what their messages tell of them."""

from __future__ import annotations

import dataclasses
import statistics

import numpy as np

from .imu import IMU
from .livox import FIELDS as LIVOX_FIELDS
from .livox import is_livox

CLOUD = "sensor_msgs/msg/PointCloud2"
ROS = ("ros1", "cdr")  # encodings of messages
TIME_FIELDS = ("time", "t", "timestamp", "offset_time", "time_stamp")
SCALARS = {1: "i1", 2: "u1", 3: "i2", 4: "u2", 5: "i4", 6: "u4", 7: "f4", 8: "f8"}


@dataclasses.dataclass(frozen=True)
class Topic:
    """What is known of a topic from its first messages."""

    name: str
    type: str
    count: int
    rate: float  # [Hz], 0 when unknown
    frame: str = ""  # without a leading slash
    points: float = 0.0  # of a cloud, on average
    fields: tuple[str, ...] = ()  # of a cloud: name:type
    time_field: str = ""  # of a cloud; empty without
    time_range: tuple[float, float] | None = None  # of that field in the first cloud, as it stands
    acceleration: float | None = None  # of an IMU: median length, as it stands
    encoding: str = ROS[0]  # of the messages

    @property
    def is_ros(self) -> bool:
        return self.encoding in ROS

    @property
    def is_cloud(self) -> bool:
        return self.is_ros and (self.type == CLOUD or is_livox(self.type))

    @property
    def is_imu(self) -> bool:
        return self.is_ros and self.type == IMU

    @property
    def points_per_second(self) -> float:
        return self.points * self.rate


def described(samples, livox: bool) -> dict:
    """What the messages of a topic tell of it."""
    frame = samples[0].header.frame_id.lstrip("/")
    if livox:
        times = [point.offset_time for point in samples[0].points]
        return {
            "frame": frame,
            "points": statistics.fmean(len(s.points) for s in samples),
            "fields": LIVOX_FIELDS,
            "time_field": "offset_time",
            "time_range": (min(times), max(times)) if times else None,
        }
    if not hasattr(samples[0], "fields"):
        lengths = [np.hypot(np.hypot(a.x, a.y), a.z) for a in (s.linear_acceleration for s in samples)]
        return {"frame": frame, "acceleration": float(np.median(lengths))}
    names = [field.name for field in samples[0].fields]
    time_field = next((name for name in TIME_FIELDS if name in names), "")
    return {
        "frame": frame,
        "points": statistics.fmean(s.width * s.height for s in samples),
        "fields": tuple(f"{f.name}:{SCALARS.get(f.datatype, '?')}" for f in samples[0].fields),
        "time_field": time_field,
        "time_range": range_of(samples[0], time_field) if time_field else None,
    }


def range_of(cloud, name: str) -> tuple[float, float] | None:
    """The smallest and the largest value of a field of a PointCloud2; None when it has none."""
    field = next(f for f in cloud.fields if f.name == name)
    order = ">" if cloud.is_bigendian else "<"
    kind = np.dtype(order + SCALARS.get(field.datatype, "u1"))
    count = cloud.width * cloud.height
    steps = (cloud.row_step, cloud.point_step) if cloud.height > 1 else (0, cloud.point_step)
    end = (cloud.height - 1) * steps[0] + (cloud.width - 1) * steps[1] + field.offset + kind.itemsize
    if count == 0 or end > len(cloud.data):
        return None
    data = np.ascontiguousarray(cloud.data, np.uint8)
    values = np.ndarray((cloud.height, cloud.width), kind, data, field.offset, steps)
    values = values[np.isfinite(values)]
    return (float(values.min()), float(values.max())) if values.size else None
