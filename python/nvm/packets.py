# SPDX-License-Identifier: MIT
# Copyright (c) 2026 The nvm authors
"""Recordings of a sensor's packets: pcap of Ouster and Velodyne, and Ouster's OSF.

The makers' formats are read by ouster-sdk and velodyne-decoder, which are no dependencies of this package
(docs/python.md, "Packets"); what they give becomes the messages that a driver of ROS would have recorded.
"""

from __future__ import annotations

import contextlib
import dataclasses
import itertools
import pathlib
import statistics
from collections.abc import Iterator

import numpy as np

from .bags import SAMPLES, BagError, Message
from .imu import IMU
from .ros1_messages import Readings, Sweep, cloud_bytes, imu_bytes
from .serialization import ros1_typestore
from .topics import CLOUD, Topic, described
from .transforms import TransformTree

ENDINGS = (".pcap", ".pcapng", ".osf")
MAX_TIME = 2.0**32 - 1  # [s]
MAX_SPAN = 4.0  # [s], of nanoseconds in 32 bits
VELODYNE = "pip install velodyne-decoder"
INSTALL = {
    "ouster": "pip install ouster-sdk, and then pip install 'rosbags>=0.10', of which it asks for an older version",
    "velodyne_decoder": VELODYNE,
    "dpkt": VELODYNE,
}


def is_packets(path: str | pathlib.Path) -> bool:
    """Whether `path` is named as a recording of packets is."""
    return pathlib.Path(path).suffix.lower() in ENDINGS


class PacketRecording:
    """A recording of packets, with what ``bags.Recording`` has of one of messages.

    Parameters
    ----------
    path : path
        A ``.pcap``, ``.pcapng`` or ``.osf`` file. Beside a pcap of an Ouster lies its metadata, ``.json``.

    Raises
    ------
    BagError
        When it cannot be read, is of another maker, or the package that reads it is not installed.
    """

    problems: tuple[str, ...] = ()
    transforms_from = "the metadata"

    def __init__(self, path: str | pathlib.Path):
        self.path = pathlib.Path(path)
        if not self.path.is_file():
            raise BagError(f"{path}: does not exist")
        with explained(self.path):
            self._file = opened(self.path)
            first = first_sweeps(self._file.items())
        self._topics = {topic.name: topic for topic in self._described(first)}

    def __enter__(self) -> PacketRecording:
        return self

    def __exit__(self, *_) -> None:
        pass

    @property
    def format(self) -> str:
        return self._file.format

    @property
    def begin(self) -> float:
        """Time of the first sweep or reading that was looked at [s]."""
        return self._begin

    @property
    def duration(self) -> float:
        """[s], as far as the size of the file tells it."""
        return max((t.count / t.rate for t in self._topics.values() if t.is_cloud and t.rate), default=0.0)

    def topics(self) -> list[Topic]:
        """All topics, in the order of their names. How many messages they have is told by the size of the file."""
        return [topic for _, topic in sorted(self._topics.items())]

    def transforms(self) -> TransformTree:
        """What the maker says of where IMU and LiDAR sit."""
        return self._file.transforms()

    def messages(self, topics: list[str]) -> Iterator[Message]:
        """The messages of the topics in the order of recording. BagError when the file is damaged."""
        with explained(self.path):
            for item in self._file.items():
                if item.topic in topics:
                    yield from messages_of(item)

    def _described(self, first: list[Sweep | Readings]) -> list[Topic]:
        if not first:
            raise BagError(f"{self.path}: holds no whole sweep")
        self._begin = min(item.times[0] for item in first)
        found = []
        for name in {item.topic: None for item in first}:
            items = [item for item in first if item.topic == name]
            messages = list(itertools.islice(itertools.chain.from_iterable(map(messages_of, items)), SAMPLES))
            messages = [message for message in messages if message.data]
            times = [message.record_time for message in messages]
            steps = [b - a for a, b in itertools.pairwise(times) if b > a]
            rate = 1.0 / statistics.median(steps) if steps else 0.0
            kind = IMU if isinstance(items[0], Readings) else CLOUD
            samples = [ros1_typestore().deserialize_ros1(message.data, kind) for message in messages]
            about = described(samples, False) if samples else {}
            found.append(Topic(name, kind, len(messages), rate, **about))
        return self._counted(found)

    def _counted(self, topics: list[Topic]) -> list[Topic]:
        sweeps = self._file.sweep_count()
        duration = max((sweeps / t.rate for t in topics if t.is_cloud and t.rate), default=0.0)
        return [dataclasses.replace(t, count=max(t.count, round(duration * t.rate))) for t in topics]


def first_sweeps(items) -> list[Sweep | Readings]:
    """As many sweeps as tell what there is, and the readings among them."""
    first, sweeps = [], 0
    for item in items:
        first.append(item)
        sweeps += isinstance(item, Sweep)
        if sweeps == SAMPLES:
            break
    return first


def opened(path: pathlib.Path):
    """The file by whoever made the sensor."""
    from . import ouster, velodyne

    if path.suffix.lower() == ".osf":
        return ouster.OsfFile(path)
    if ouster.has_metadata(path):
        return ouster.PcapFile(path)
    if velodyne.is_velodyne(path):
        return velodyne.VelodyneFile(path)
    seen = velodyne.kinds_of_packets(path)
    sizes = ", ".join(f"{count} of {size} bytes to port {port}" for (port, size), count in seen.most_common(4))
    raise BagError(
        f"{path}: its packets are no Velodyne's ({sizes or 'it holds none'}); those of an Ouster need the metadata "
        "of the sensor beside them (FILE.json), and other makers' programs write bags or PCD files"
    )


@contextlib.contextmanager
def explained(path: pathlib.Path):
    """Makes a BagError of whatever the makers' packages raise."""
    try:
        yield
    except BagError:
        raise
    except ImportError as error:
        package = (error.name or str(error)).split(".")[0]
        raise BagError(f"{path}: packets are read with the package {package}: {INSTALL.get(package, '')}") from error
    except Exception as error:
        raise BagError(f"{path}: cannot be read: {' '.join(str(error).split())}") from error


def messages_of(item: Sweep | Readings) -> Iterator[Message]:
    """Those whose times no message can hold are empty, as damaged ones of bags are: the program counts them."""
    if isinstance(item, Readings):
        for time, gyro, accel in zip(item.times, item.gyro, item.accel):
            data = imu_bytes(item.frame, time, gyro, accel) if is_dated([time]) else b""
            yield Message(item.topic, "sensor_msgs/Imu", float(time), data)
    else:
        data = cloud_bytes(item) if is_dated(item.times) else b""
        yield Message(item.topic, "sensor_msgs/PointCloud2", float(item.times[-1]), data)


def is_dated(times) -> bool:
    """Whether a message can hold times that begin with its own, all [s]."""
    since = np.subtract(times, times[0])
    return bool(0.0 <= times[0] < MAX_TIME and since.min() >= 0.0 and since.max() < MAX_SPAN)
