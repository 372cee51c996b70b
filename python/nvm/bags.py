# SPDX-License-Identifier: MIT
# Copyright (c) 2026 The nvm authors
"""Recordings of ROS 1 and ROS 2: what they hold, and their messages one after the other.

Read by the package rosbags: ``.bag`` files, folders of ROS 2 bags (``.db3``, ``.mcap``, compressed,
split) and single files of them. Messages come as ROS 1 serialises them, whatever the bag.
"""

from __future__ import annotations

import dataclasses
import pathlib
import statistics
from collections.abc import Iterator

import numpy as np

from .imu import IMU
from .livox import FIELDS as LIVOX_FIELDS
from .livox import is_livox, register_livox
from .serialization import ros1_of, ros2_typestore
from .transforms import TransformTree

CLOUD = "sensor_msgs/msg/PointCloud2"
TRANSFORMS = "tf2_msgs/msg/TFMessage"
TIME_FIELDS = ("time", "t", "timestamp", "offset_time", "time_stamp")
SCALARS = {1: "i1", 2: "u1", 3: "i2", 4: "u2", 5: "i4", 6: "u4", 7: "f4", 8: "f8"}
ROS2 = (".db3", ".mcap")
SCANS = (".pcd", ".ply", ".bin")
HINTS = {  # of what rosbags says
    "File end magic is invalid": "it was cut off or never closed, of which `mcap recover` makes a whole file",
    "Profile is not ros2": "of MCAP files those with messages of ROS 2 are read",
    "disk image is malformed": "it was cut off or damaged, of which `sqlite3 FILE .recover` saves what there is",
}
SAMPLES = 10  # messages of a topic that are looked at


class BagError(RuntimeError):
    """What is wrong with a recording, in one line."""


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

    @property
    def is_cloud(self) -> bool:
        return self.type == CLOUD or is_livox(self.type)

    @property
    def is_imu(self) -> bool:
        return self.type == IMU

    @property
    def points_per_second(self) -> float:
        return self.points * self.rate


@dataclasses.dataclass(frozen=True)
class Message:
    topic: str
    type: str  # as ROS 1 writes it: sensor_msgs/Imu
    record_time: float  # [s]
    data: bytes | memoryview  # as ROS 1 serialises it


def is_bag(path: str | pathlib.Path) -> bool:
    """Whether `path` is a recording of ROS 1 or ROS 2."""
    return bool(bags_of(pathlib.Path(path)))


def bags_of(path: pathlib.Path) -> list[pathlib.Path]:
    """What rosbags is to open for `path`: a folder may hold the parts of a recording alone, as the
    program has it (src/io/open_sequence.cpp)."""
    if not path.is_dir():
        return [path] if path.suffix in (".bag", ".zstd", *ROS2) else []
    metadata = path / "metadata.yaml"
    if metadata.is_file() and b"rosbag2_bagfile_information" in metadata.read_bytes():
        return [path]
    files = sorted(file for file in path.iterdir() if file.is_file())
    if any(file.name == "scans.csv" for file in files):
        return []
    ros2 = [file for file in files if file.suffix in ROS2]
    if ros2 and not any(file.suffix.lower() in SCANS for file in files):
        return ros2
    return [file for file in files if file.suffix == ".bag"]


def is_ros1(path: str | pathlib.Path) -> bool:
    """Whether `path` is there and names bags of ROS 1 alone."""
    path = pathlib.Path(path)
    return path.exists() and is_bag(path) and all(bag.suffix == ".bag" for bag in bags_of(path))


class Recording:
    """A recording of ROS 1 or ROS 2.

    Parameters
    ----------
    path : path
        A ``.bag``, ``.mcap`` or ``.db3`` file, or a folder of them; a file of a split ROS 2 bag stands
        for the whole.

    Raises
    ------
    BagError
        When it cannot be read, or rosbags is not installed.
    """

    def __init__(self, path: str | pathlib.Path):
        try:
            from rosbags.highlevel import AnyReader, AnyReaderError
        except ImportError as error:
            raise BagError(f"{path}: bags are read by rosbags: pip install rosbags") from error
        self.path = pathlib.Path(path)
        if not self.path.exists():
            raise BagError(f"{path}: does not exist")
        others = list(self.path.glob("*.bag")) if self.path.is_dir() else []
        if others and bags_of(self.path)[0].suffix in ROS2:
            raise BagError(f"{path}: holds bags of ROS 1 ({others[0].name}) and of ROS 2: name one of them")
        folder = self.path.parent
        is_part = self.path.suffix != ".bag" and self.path.is_file() and bags_of(folder) == [folder]
        bags = [folder] if is_part else bags_of(self.path) or [self.path]
        try:
            self._reader = AnyReader(bags, default_typestore=ros2_typestore())
            self._reader.open()
        except (AnyReaderError, OSError, ValueError) as error:
            hints = (f": {hint}" for problem, hint in HINTS.items() if problem in str(error))
            raise BagError(f"{path}: {str(error).rstrip('.')}" + next(hints, "")) from error
        except KeyError as error:  # of an encoding, in MCAP
            raise BagError(f"{path}: holds messages that are none of ROS 2: {error}") from error
        except Exception as error:  # rosbags lets what yaml, sqlite and mcap find wrong pass
            raise BagError(f"{path}: is no readable bag: {error}") from error
        register_livox(self._reader.typestore)

    def __enter__(self) -> Recording:
        return self

    def __exit__(self, *_) -> None:
        self._reader.close()

    @property
    def format(self) -> str:
        return "ROS 2 bag" if self._reader.is2 else "ROS 1 bag"

    @property
    def begin(self) -> float:
        """Time of recording of the first message [s]."""
        return self._reader.start_time * 1e-9

    @property
    def duration(self) -> float:
        """[s]"""
        return self._reader.duration * 1e-9 if self._reader.message_count else 0.0

    def topics(self) -> list[Topic]:
        """All topics, in the order of their names."""
        found: dict[tuple[str, str], int] = {}
        for connection in self._reader.connections:
            key = (connection.topic, connection.msgtype)
            found[key] = found.get(key, 0) + connection.msgcount
        return [self._topic(name, kind, count) for (name, kind), count in sorted(found.items())]

    def transforms(self) -> TransformTree:
        """The static transforms, from /tf_static."""
        tree = TransformTree()
        for connection, _, raw in self._messages(
            lambda c: c.msgtype == TRANSFORMS and c.topic.endswith("tf_static")
        ):
            for transform in self._reader.deserialize(raw, connection.msgtype).transforms:
                tree.add(transform)
        return tree

    def messages(self, topics: list[str]) -> Iterator[Message]:
        """The messages of the topics in the order of recording."""
        for connection, time, raw in self._messages(lambda c: c.topic in topics):
            seconds, nanoseconds = divmod(time, 10**9)
            yield Message(
                connection.topic,
                connection.msgtype.replace("/msg/", "/"),
                seconds + 1e-9 * nanoseconds,  # the bits that ROS makes of it
                self._as_ros1(raw, connection.msgtype),
            )

    def _messages(self, accepts):
        connections = [c for c in self._reader.connections if accepts(c)]
        return self._reader.messages(connections=connections) if connections else iter(())

    def _as_ros1(self, raw, kind: str) -> bytes | memoryview:
        return ros1_of(raw, kind, self._reader.typestore) if self._reader.is2 else raw

    def _topic(self, name: str, kind: str, count: int) -> Topic:
        rate = (count - 1) / self.duration if count > 1 and self.duration > 0 else 0.0
        topic = Topic(name, kind, count, rate)
        if not (topic.is_cloud or topic.is_imu):
            return topic
        samples = []
        for connection, _, raw in self._messages(lambda c: (c.topic, c.msgtype) == (name, kind)):
            samples.append(self._reader.deserialize(raw, connection.msgtype))
            if len(samples) == SAMPLES:
                break
        return dataclasses.replace(topic, **described(samples, is_livox(kind))) if samples else topic


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
