# SPDX-License-Identifier: MIT
# Copyright (c) 2026 The nvm authors
"""Writes recordings of every kind with rosbags, as other people's drivers would."""

import dataclasses
import functools

import numpy as np
from rosbags.rosbag1 import Writer as Writer1
from rosbags.rosbag2 import CompressionFormat, CompressionMode, StoragePlugin
from rosbags.rosbag2 import Writer as Writer2
from rosbags.typesys import Stores, get_types_from_msg, get_typestore

from nvm.livox import register_livox

CLOUD = "sensor_msgs/msg/PointCloud2"
IMU = "sensor_msgs/msg/Imu"
LIVOX = "livox_ros_driver2/msg/CustomMsg"
TF = "tf2_msgs/msg/TFMessage"
DATATYPES = {"f4": 7, "f8": 8, "u1": 2, "u2": 4, "u4": 6, "i4": 5}


@functools.cache
def typestore(ros1):
    store = get_typestore(Stores.ROS1_NOETIC if ros1 else Stores.ROS2_HUMBLE)
    register_livox(store)
    if TF not in store.types:
        store.register(get_types_from_msg("geometry_msgs/TransformStamped[] transforms", TF))
    return store


class Messages:
    """Makers of messages."""

    def __init__(self, store):
        self.store = store
        self.types = store.types

    def header(self, time, frame):
        extra = {"seq": 0} if "seq" in self._names("std_msgs/msg/Header") else {}
        return self.types["std_msgs/msg/Header"](stamp=self.stamp(time), frame_id=frame, **extra)

    def _names(self, kind):
        return [field.name for field in dataclasses.fields(self.types[kind])]

    def stamp(self, time):
        seconds, nanoseconds = divmod(round(time * 1e9), 10**9)
        return self.types["builtin_interfaces/msg/Time"](sec=seconds, nanosec=nanoseconds)

    def cloud(self, time, records, frame="lidar"):
        """A PointCloud2 of a structured array, laid out as it is."""
        fields = [
            self.types["sensor_msgs/msg/PointField"](
                name=name, offset=offset, datatype=DATATYPES[kind.str[1:]], count=1
            )
            for name, (kind, offset) in records.dtype.fields.items()
        ]
        return self.types[CLOUD](
            header=self.header(time, frame),
            height=1,
            width=len(records),
            fields=fields,
            is_bigendian=False,
            point_step=records.dtype.itemsize,
            row_step=records.nbytes,
            data=np.frombuffer(records.tobytes(), np.uint8),
            is_dense=True,
        )

    def livox(self, time, records, frame="livox"):
        """A CustomMsg of an array with x y z, offset_time [ns], reflectivity, tag and line."""
        Point = self.types["livox_ros_driver2/msg/CustomPoint"]
        points = [Point(**{n: p[n].item() for n in records.dtype.names}) for p in records]
        return self.types[LIVOX](
            header=self.header(time, frame),
            timebase=round(time * 1e9),
            point_num=len(points),
            lidar_id=1,
            rsvd=np.zeros(3, np.uint8),
            points=points,
        )

    def imu(self, time, gyro, accel, frame="imu"):
        Vector3 = self.types["geometry_msgs/msg/Vector3"]
        nothing = np.zeros(9)
        return self.types[IMU](
            header=self.header(time, frame),
            orientation=self.types["geometry_msgs/msg/Quaternion"](x=0.0, y=0.0, z=0.0, w=1.0),
            orientation_covariance=nothing,
            angular_velocity=Vector3(*map(float, gyro)),
            angular_velocity_covariance=nothing,
            linear_acceleration=Vector3(*map(float, accel)),
            linear_acceleration_covariance=nothing,
        )

    def transforms(self, *edges):
        """A TFMessage of (parent, child, translation, quaternion)."""
        Vector3 = self.types["geometry_msgs/msg/Vector3"]
        Quaternion = self.types["geometry_msgs/msg/Quaternion"]
        return self.types[TF](
            transforms=[
                self.types["geometry_msgs/msg/TransformStamped"](
                    header=self.header(0.0, parent),
                    child_frame_id=child,
                    transform=self.types["geometry_msgs/msg/Transform"](
                        translation=Vector3(*map(float, t)), rotation=Quaternion(*map(float, q))
                    ),
                )
                for parent, child, t, q in edges
            ]
        )


FORMATS = ("bag", "db3", "mcap", "zstd", "ros1.mcap")


def write(path, form, make):
    """Writes the recording that make(Messages) gives as (topic, type, time [s], message); returns
    the path that a user would name."""
    store = typestore(form in ("bag", "ros1.mcap"))
    messages = list(make(Messages(store)))
    if form == "ros1.mcap":
        return write_mcap(path.with_suffix(".mcap"), store, messages)
    if form == "bag":
        path = path.with_suffix(".bag")
        with Writer1(path) as writer:
            fill(writer, store.serialize_ros1, store, messages)
        return path
    plugin = StoragePlugin.SQLITE3 if form == "db3" else StoragePlugin.MCAP
    writer = Writer2(path, version=9, storage_plugin=plugin)
    if form == "zstd":
        writer.set_compression(CompressionMode.STORAGE, CompressionFormat.ZSTD)
    with writer:
        fill(writer, store.serialize_cdr, store, messages)
    return path


def write_mcap(path, store, messages, others=(), profile="ros1", **options):
    """Writes messages of ROS 1 as `mcap convert` does, and (topic, encoding, schema, time [s], bytes) of `others`."""
    from mcap.writer import Writer

    with path.open("wb") as file:
        writer = Writer(file, **options)
        writer.start(profile=profile, library="mcap go v1")
        channels = {}
        for topic, kind, time, message in messages:
            if topic not in channels:
                text, digest = store.generate_msgdef(kind)
                schema = writer.register_schema(kind.replace("/msg/", "/"), "ros1msg", text.encode())
                about = {"md5sum": digest, "topic": topic, "type": kind.replace("/msg/", "/")}
                channels[topic] = writer.register_channel(topic, "ros1", schema, about)
            stamp = round(time * 1e9)
            writer.add_message(channels[topic], stamp, bytes(store.serialize_ros1(message, kind)), stamp)
        for topic, encoding, (name, schema_encoding, data), time, value in others:
            if topic not in channels:
                channels[topic] = writer.register_channel(
                    topic, encoding, writer.register_schema(name, schema_encoding, data)
                )
            writer.add_message(channels[topic], round(time * 1e9), value, round(time * 1e9))
        writer.finish()
    return path


def fill(writer, serialize, store, messages):
    connections = {}
    for topic, kind, time, message in messages:
        if topic not in connections:
            connections[topic] = writer.add_connection(topic, kind, typestore=store)
        writer.write(connections[topic], round(time * 1e9), serialize(message, kind))


POINT = np.dtype([("x", "f4"), ("y", "f4"), ("z", "f4"), ("intensity", "f4"), ("t", "u4")])


def records(rng, count=50, dtype=POINT):
    """Random points; `t` goes to 0.1 s in nanoseconds."""
    values = np.zeros(count, dtype)
    for name in "xyz":
        values[name] = rng.uniform(-5, 5, count)
    if "t" in dtype.names:
        values["t"] = np.linspace(0, 99_000_000, count)
    return values


LIVOX_POINT = np.dtype(
    [("offset_time", "u4"), ("x", "f4"), ("y", "f4"), ("z", "f4")]
    + [("reflectivity", "u1"), ("tag", "u1"), ("line", "u1")]
)


def livox_records(rng, count=50):
    values = np.zeros(count, LIVOX_POINT)
    for name in "xyz":
        values[name] = rng.uniform(-5, 5, count)
    values["offset_time"] = np.arange(count) * 1000
    values["line"] = np.arange(count) % 4
    values["reflectivity"] = rng.integers(0, 255, count)
    return values
