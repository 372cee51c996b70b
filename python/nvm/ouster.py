# SPDX-License-Identifier: MIT
# Copyright (c) 2026 The nvm authors
"""Recordings of Ouster's sensors, read by ouster-sdk."""

from __future__ import annotations

import pathlib
from collections.abc import Iterator

import numpy as np

from .ros1_messages import Readings, Sweep
from .transforms import TransformTree

MAX_METADATA = 1 << 20  # [bytes]
VALID = 1  # bit of the status of a column, and of a reading


def has_metadata(path: pathlib.Path) -> bool:
    """Whether a file of a sensor's calibration lies beside a pcap."""
    beside = (file for file in path.parent.glob("*.json") if file.stat().st_size < MAX_METADATA)
    return any(b"beam_altitude_angles" in file.read_bytes() for file in beside)


class Sensor:
    """What is known of one of the sensors of a file."""

    def __init__(self, info, number: int, count: int):
        from ouster.sdk.core import XYZLut

        self.info = info
        self.name = "ouster" if count == 1 else f"ouster{number}"
        self._to_points = XYZLut(info, False)

    def sweep(self, frame) -> Sweep | None:
        """None when no beam has come back."""
        is_valid = (np.asarray(frame.status) & VALID).astype(bool)
        distances = frame.field("RANGE")
        columns, rings = np.nonzero((distances > 0).T & is_valid[:, None])
        if not columns.size:
            return None
        name = next((n for n in ("REFLECTIVITY", "SIGNAL") if frame.has_field(n)), "RANGE")
        return Sweep(
            f"/{self.name}/points",
            f"{self.name}_sensor",
            self._to_points(frame)[rings, columns],
            seconds(frame.timestamp[columns]),
            frame.field(name)[rings, columns],
            rings,
        )

    def readings(self, times, gyro, accel, status) -> Readings | None:
        is_valid = (np.asarray(status) & VALID).astype(bool)
        if not is_valid.any():
            return None
        values = (seconds(times)[is_valid], np.asarray(gyro)[is_valid], np.asarray(accel)[is_valid])
        return Readings(f"/{self.name}/imu", f"{self.name}_imu", *values)

    def add_transforms(self, tree: TransformTree) -> None:
        in_metres = np.array(self.info.imu_to_sensor_transform, float)
        in_metres[:3, 3] *= 1e-3
        tree.link(f"{self.name}_sensor", f"{self.name}_imu", in_metres)
        tree.link("body", f"{self.name}_sensor", np.array(self.info.sensor_to_body, float))


def seconds(nanoseconds) -> np.ndarray:
    return np.asarray(nanoseconds).astype(np.float64) * 1e-9


class OusterFile:
    def __init__(self, infos):
        self.sensors = [Sensor(info, i, len(infos)) for i, info in enumerate(infos)]

    def transforms(self) -> TransformTree:
        tree = TransformTree()
        for sensor in self.sensors:
            sensor.add_transforms(tree)
        return tree


class OsfFile(OusterFile):
    """Frames, and the readings in them where the sensor's firmware puts them there."""

    format = "Ouster OSF"

    def __init__(self, path: pathlib.Path):
        self._path = str(path)
        source = self._source()
        super().__init__(source.sensor_info)
        self._count = len(source)

    def _source(self):
        from ouster.sdk import open_source

        return open_source(self._path)

    def sweep_count(self) -> int:
        return self._count

    def items(self) -> Iterator[Sweep | Readings]:
        for frames in self._source():
            for sensor, frame in zip(self.sensors, frames):
                if frame is not None:
                    yield from found(readings_of(sensor, frame), sensor.sweep(frame))


def readings_of(sensor: Sensor, frame) -> Readings | None:
    if not frame.has_field("IMU_ACC"):
        return None
    return sensor.readings(*(frame.field(f"IMU_{name}") for name in ("TIMESTAMP", "GYRO", "ACC", "STATUS")))


def found(*items) -> list:
    return [item for item in items if item is not None]


class PcapFile(OusterFile):
    """Packets of LiDARs and IMUs."""

    format = "pcap of an Ouster"

    def __init__(self, path: pathlib.Path):
        self._path = path
        super().__init__(self._source().sensor_info)

    def _source(self):
        from ouster.sdk import open_packet_source

        return open_packet_source(str(self._path))

    def sweep_count(self) -> int:
        from ouster.sdk.core import PacketFormat

        sizes = (s.info.format.lidar_packets_per_frame() * PacketFormat(s.info).lidar_packet_size for s in self.sensors)
        return self._path.stat().st_size // max(sum(sizes), 1)

    def items(self) -> Iterator[Sweep | Readings]:
        from ouster.sdk.core import FrameBatcher, ImuPacket, LidarFrame, LidarPacket

        batchers = [FrameBatcher(sensor.info) for sensor in self.sensors]
        frames = [LidarFrame(sensor.info) for sensor in self.sensors]
        for number, packet in self._source():
            sensor = self.sensors[number]
            if isinstance(packet, ImuPacket):
                yield from found(sensor.readings(packet.timestamp(), packet.gyro(), packet.accel(), packet.status()))
            elif isinstance(packet, LidarPacket) and batchers[number](packet, frames[number]):
                yield from found(sensor.sweep(frames[number]))
                frames[number] = LidarFrame(sensor.info)
        for sensor, frame in zip(self.sensors, frames):
            yield from found(sensor.sweep(frame))  # the last one, as far as it goes
