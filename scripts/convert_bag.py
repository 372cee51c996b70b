#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
# Copyright (c) 2026 The nvm authors
"""Converts a ROS 2 bag (mcap or db3) or a ROS 1 bag into an nvm sequence folder.

usage: convert_bag.py BAG FOLDER [options]

BAG is a ROS 2 bag's folder or .mcap/.db3 file, or a ROS 1 .bag file; FOLDER must not exist. Clouds
are sensor_msgs/PointCloud2 with any fields, or Livox CustomMsg; IMU samples are sensor_msgs/Imu.
One message is in memory at a time. Needs the Python package rosbags. See docs/formats.md.
"""

import argparse
import itertools
import json
import math
import pathlib
import shutil
import sys

CUSTOM_POINT = """
uint32 offset_time
float32 x
float32 y
float32 z
uint8 reflectivity
uint8 tag
uint8 line
"""
CUSTOM_MSG = """
std_msgs/Header header
uint64 timebase
uint32 point_num
uint8 lidar_id
uint8[3] rsvd
CustomPoint[] points
"""
LIVOX_PACKAGES = ("livox_ros_driver", "livox_ros_driver2", "livox_interfaces")
CLOUD_TYPES = ("sensor_msgs/msg/PointCloud2",) + tuple(f"{p}/msg/CustomMsg" for p in LIVOX_PACKAGES)
IMU_TYPE = "sensor_msgs/msg/Imu"

FIELD_TYPES = {1: "i1", 2: "u1", 3: "i2", 4: "u2", 5: "i4", 6: "u4", 7: "f4", 8: "f8"}
TIME_FIELDS = ("time", "t", "timestamp", "offset_time", "time_stamp")
TICKS_PER_SECOND = {"s": 1.0, "ms": 1e3, "us": 1e6, "ns": 1e9}
STANDARD_GRAVITY = 9.80665


class BagError(Exception):
    """What is wrong with the bag, in one line."""


try:
    import numpy as np
    from rosbags.highlevel import AnyReader, AnyReaderError
    from rosbags.typesys import Stores, get_types_from_msg, get_typestore
except ImportError as error:
    sys.exit(f"error: {error}; install it with: pip install rosbags")

RECORD = np.dtype(
    {
        "names": ["x", "y", "z", "intensity", "dt", "ring"],
        "formats": ["<f4", "<f4", "<f4", "<f4", "<f4", "<u2"],
        "offsets": [0, 4, 8, 12, 16, 20],
        "itemsize": 24,
    }
)


def typestore_with_livox():
    """The types for bags that do not hold their own message definitions."""
    store = get_typestore(Stores.ROS2_HUMBLE)
    for package in LIVOX_PACKAGES:
        store.register(get_types_from_msg(CUSTOM_POINT, f"{package}/msg/CustomPoint"))
        store.register(get_types_from_msg(CUSTOM_MSG, f"{package}/msg/CustomMsg"))
    return store


def stamp_of(message):
    return message.header.stamp.sec + 1e-9 * message.header.stamp.nanosec


def find_field(points, names):
    """The first of the names that is a field of the structured array; None without one."""
    return next((name for name in names if name in (points.dtype.names or ())), None)


def column(points, name):
    """The first value of a field of all points, as float64."""
    values = points[name]
    return (values if values.ndim == 1 else values[:, 0]).astype(np.float64)


def cloud_points(message):
    """The points of a PointCloud2 as a structured array; padding between rows is left out."""
    order = ">" if message.is_bigendian else "<"
    fields = [f for f in message.fields if f.datatype in FIELD_TYPES]
    dtype = np.dtype(
        {
            "names": [f.name for f in fields],
            "formats": [(order + FIELD_TYPES[f.datatype], (max(f.count, 1),)) for f in fields],
            "offsets": [f.offset for f in fields],
            "itemsize": message.point_step,
        }
    )
    row_size = message.width * message.point_step
    row_step = row_size if message.height == 1 else message.row_step
    data = np.ascontiguousarray(message.data, dtype=np.uint8)
    if message.height == 0 or message.width == 0:
        return np.zeros(0, dtype)
    if row_step < row_size or len(data) < (message.height - 1) * row_step + row_size:
        raise BagError("a cloud has fewer data than its size says")
    rows = [data[i * row_step : i * row_step + row_size] for i in range(message.height)]
    return np.concatenate(rows).view(dtype)


def livox_points(message):
    dtype = np.dtype(
        [("offset_time", "u4"), ("x", "f4"), ("y", "f4"), ("z", "f4")]
        + [("reflectivity", "u1"), ("line", "u1")]
    )
    return np.array([tuple(getattr(p, n) for n in dtype.names) for p in message.points], dtype)


def likely_unit(duration, is_whole):
    """The unit that makes `duration` nearest to 0.1 s on a logarithmic scale."""
    units = [unit for unit in TICKS_PER_SECOND if not (is_whole and unit == "s")]
    return min(units, key=lambda u: abs(math.log10(duration / TICKS_PER_SECOND[u] / 0.1)))


def begin_time(first, stamp):
    """The time of a scan's first point, whose time field says `first` [s]; see docs/formats.md."""
    if abs(first - stamp) < min(abs(first), 10.0) or first > 1e8:
        return first
    return stamp + first if abs(first) <= 10.0 else stamp


def untimed_records(points):
    """Records of all points, with dt = 0."""
    records = np.zeros(len(points), RECORD)
    for target, names in (
        ("x", ("x",)),
        ("y", ("y",)),
        ("z", ("z",)),
        ("intensity", ("intensity", "reflectivity")),
        ("ring", ("ring", "line", "channel")),
    ):
        name = find_field(points, names)
        if name is not None:
            values = column(points, name)
            records[target] = np.clip(values, 0, 65535) if target == "ring" else values
        elif target in ("x", "y", "z"):
            raise BagError(f"a cloud has no field '{target}'")
    return records


class ScanConverter:
    """Turns cloud messages into records of a scan file; keeps the time unit of the first scan."""

    def __init__(self, unit):
        self.unit = unit

    def convert(self, message):
        """t_begin, t_end [s] and the records, sorted by time, without points that are not finite."""
        is_livox = hasattr(message, "points")
        points = livox_points(message) if is_livox else cloud_points(message)
        records = untimed_records(points)
        time_field = find_field(points, TIME_FIELDS)
        ticks = np.zeros(len(points)) if time_field is None else column(points, time_field)
        stamp = stamp_of(message)
        finite = np.isfinite(ticks)
        for name in ("x", "y", "z"):
            finite &= np.isfinite(records[name])
        records, ticks = records[finite], ticks[finite]
        if time_field is None or len(ticks) == 0:
            return stamp, stamp, records
        order = np.argsort(ticks, kind="stable")
        records, ticks = records[order], ticks[order]
        is_whole = points.dtype[time_field].base.kind in "iu"
        unit = "ns" if is_livox else self._unit(ticks[-1] - ticks[0], is_whole)
        records["dt"] = (ticks - ticks[0]) / TICKS_PER_SECOND[unit]
        t_begin = begin_time(ticks[0] / TICKS_PER_SECOND[unit], stamp)
        return t_begin, t_begin + (ticks[-1] - ticks[0]) / TICKS_PER_SECOND[unit], records

    def _unit(self, duration, is_whole):
        if self.unit is None and duration > 0:
            self.unit = likely_unit(duration, is_whole)
        return self.unit or "s"


class SequenceFolder:
    """Writes an nvm sequence folder; it appears under its name when it is complete."""

    def __init__(self, folder):
        self.folder = folder
        self.partial = folder.with_name(folder.name + ".partial")
        if folder.exists():
            raise BagError(f"{folder} exists already")
        shutil.rmtree(self.partial, ignore_errors=True)
        (self.partial / "scans").mkdir(parents=True)
        self.scan_list = open(self.partial / "scans.csv", "w", encoding="ascii")
        self.scan_list.write("index,t_begin,t_end,file\n")
        self.imu = None
        self.counts = {"scans": 0, "points": 0, "imu_samples": 0}
        self.previous_scan = -math.inf
        self.previous_imu = -math.inf
        self.bad_imu_count = 0

    def add_scan(self, t_begin, t_end, records):
        if t_begin <= self.previous_scan:
            raise BagError(f"the scan at {t_begin:.6f} s is not after the one before")
        self.previous_scan = t_begin
        name = f"scans/{self.counts['scans']:06d}.bin"
        records.tofile(self.partial / name)
        self.scan_list.write(f"{self.counts['scans']},{t_begin:.9f},{t_end:.9f},{name}\n")
        self.counts["scans"] += 1
        self.counts["points"] += len(records)

    def add_imu(self, time, gyro, accel):
        """Samples that repeat or go back in time, or are not finite, are left out and counted."""
        values = (*gyro, *accel)
        if time <= self.previous_imu or not all(math.isfinite(value) for value in values):
            self.bad_imu_count += 1
            return
        self.previous_imu = time
        if self.imu is None:
            self.imu = open(self.partial / "imu.csv", "w", encoding="ascii")
            self.imu.write("t,gx,gy,gz,ax,ay,az\n")
        self.imu.write(f"{time:.9f}," + ",".join(f"{value:.9g}" for value in values) + "\n")
        self.counts["imu_samples"] += 1

    def commit(self, meta):
        if self.counts["scans"] == 0:
            raise BagError("there is no scan in it")
        self.close()
        meta = {"format": "nvm sequence", "version": 1, **meta, "counts": self.counts}
        (self.partial / "meta.json").write_text(json.dumps(meta, indent=2) + "\n")
        self.partial.rename(self.folder)

    def close(self):
        self.scan_list.close()
        if self.imu is not None:
            self.imu.close()

    def discard(self):
        self.close()
        shutil.rmtree(self.partial, ignore_errors=True)


def choose_topic(kind, connections, types, wanted):
    """The connections of the wanted topic, or of the first one with a message of the types."""
    topics = {}
    for connection in connections:
        if connection.msgtype in types:
            topics.setdefault(connection.topic, []).append(connection)
    if wanted is not None and wanted not in topics:
        raise BagError(f"no {kind} topic '{wanted}'; there are: {', '.join(topics) or 'none'}")
    if wanted is None and len(topics) > 1:
        print(f"{kind} topic {next(iter(topics))} is read, out of {', '.join(topics)}")
    return topics.get(wanted or next(iter(topics), None), [])


def vector(message):
    return np.array((message.x, message.y, message.z))


def accel_scale(reader, connections, unit):
    """The factor that makes m/s^2 of the bag's accelerations; g when the median is below 3."""
    if unit is None and connections:
        messages = itertools.islice(reader.messages(connections=connections), 100)
        samples = [reader.deserialize(raw, c.msgtype) for c, _, raw in messages]
        norms = [float(np.linalg.norm(vector(sample.linear_acceleration))) for sample in samples]
        unit = "g" if norms and np.median(norms) < 3.0 else "m/s2"
    return STANDARD_GRAVITY if unit == "g" else 1.0


def convert(reader, sequence, options):
    clouds = choose_topic("lidar", reader.connections, CLOUD_TYPES, options.lidar_topic)
    imus = choose_topic("IMU", reader.connections, (IMU_TYPE,), options.imu_topic)
    if not clouds:
        raise BagError("no topic with PointCloud2 or CustomMsg messages")
    scale = accel_scale(reader, imus, options.accel_unit)
    converter = ScanConverter(options.point_time_unit)
    for connection, _, raw in reader.messages(connections=clouds + imus):
        message = reader.deserialize(raw, connection.msgtype)
        if connection.msgtype == IMU_TYPE:
            accel = scale * vector(message.linear_acceleration)
            sequence.add_imu(stamp_of(message), vector(message.angular_velocity), accel)
        else:
            sequence.add_scan(*converter.convert(message))
    if sequence.bad_imu_count > 0:
        print(f"{sequence.bad_imu_count} bad or repeated IMU messages are left out")
    translation, quaternion = options.T_imu_lidar[:3], options.T_imu_lidar[3:]
    return {
        "sensor": clouds[0].topic,
        "source": options.bag.name,
        "T_imu_lidar": {"translation": translation, "quaternion_xyzw": quaternion},
    }


def bag_path(path):
    """What the reader wants: the folder of a ROS 2 bag when one of its files is given."""
    is_part = path.is_file() and (path.parent / "metadata.yaml").exists()
    return path.parent if is_part and path.suffix != ".bag" else path


def parse_arguments(arguments):
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("bag", type=pathlib.Path)
    parser.add_argument("folder", type=pathlib.Path)
    parser.add_argument("--lidar-topic", help="default: the first one with clouds")
    parser.add_argument("--imu-topic", help="default: the first one with IMU messages")
    parser.add_argument("--accel-unit", choices=("m/s2", "g"), help="default: by its size")
    parser.add_argument(
        "--point-time-unit", choices=tuple(TICKS_PER_SECOND), help="default: by the duration"
    )
    parser.add_argument(
        "--T-imu-lidar",
        type=float,
        nargs=7,
        default=[0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 1.0],
        metavar=("X", "Y", "Z", "QX", "QY", "QZ", "QW"),
        help="maps LiDAR to IMU coordinates [m, unit quaternion]; default: identity",
    )
    return parser.parse_args(arguments)


def main(arguments):
    """Nothing, or one line that says what is wrong."""
    options = parse_arguments(arguments)
    sequence = None
    try:
        with AnyReader(
            [bag_path(options.bag)], default_typestore=typestore_with_livox()
        ) as reader:
            sequence = SequenceFolder(options.folder)
            sequence.commit(convert(reader, sequence, options))
    except (BagError, AnyReaderError, OSError, ValueError) as error:
        if sequence is not None:
            sequence.discard()
        return f"error: {options.bag}: {error}"
    counts = ", ".join(f"{count} {name}" for name, count in sequence.counts.items())
    print(f"{options.folder}: {counts}".replace("_", " "))
    return None


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
