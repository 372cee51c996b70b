# SPDX-License-Identifier: MIT
# Copyright (c) 2026 The nvm authors
"""Which topics of a recording are used, and why."""

from __future__ import annotations

import dataclasses
import math

import numpy as np

from .bags import BagError, Recording
from .topics import Topic
from .transforms import TransformTree, quaternion


@dataclasses.dataclass(frozen=True)
class Choice:
    """Topics, the extrinsic, and a line about each."""

    lidar: Topic
    imu: Topic | None
    T_imu_lidar: np.ndarray | None  # (4, 4); None when nothing tells it
    reasons: tuple[str, ...]

    def extrinsic_numbers(self) -> list[float]:
        """x y z [m] qx qy qz qw, as input.T_imu_lidar wants them."""
        T = self.T_imu_lidar
        return [float(v) for v in (*T[:3, 3], *quaternion(T[:3, :3]))]


def choose(recording: Recording, lidar: str = "", imu: str = "") -> Choice:
    """Chooses topics: the wanted ones, else the clouds with the most points per second among those
    with times of points, and the IMU that is nearest to them in the tree of /tf_static.

    Raises
    ------
    BagError
        When there are no clouds, or not the wanted topic.
    """
    topics = recording.topics()
    tree = recording.transforms()
    clouds = [t for t in topics if t.is_cloud and t.count]
    imus = [t for t in topics if t.is_imu and t.count]
    if not clouds:
        kinds = ", ".join(sorted({kind_of(t) for t in topics if t.count})) or "nothing"
        empty = "".join(f"; {t.name} has no messages" for t in topics if t.is_cloud)
        wrong = "".join(f"; {problem}" for problem in recording.problems)
        raise BagError(
            f"{recording.path}: has no clouds (PointCloud2 or Livox CustomMsg); it holds: {kinds}{empty}{wrong}"
        )
    chosen, why = pick(recording, "lidar", clouds, lidar, lidar_rank)
    reasons = [f"lidar: {chosen.name}, {why or lidar_reason(chosen, clouds)}"]
    if not imus and not imu:
        return Choice(chosen, None, None, (*reasons, "IMU: none in the recording"))

    def rank(topic: Topic):
        return imu_rank(topic, chosen, tree)

    sensor, why = pick(recording, "imu", imus, imu, rank)
    found = tree.find(sensor.frame, chosen.frame)
    reasons.append(f"IMU: {sensor.name}, {why or imu_reason(sensor, imus, found)}")
    reasons.append(extrinsic_reason(sensor, chosen, found, recording.transforms_from))
    return Choice(chosen, sensor, found[0] if found else None, tuple(reasons))


def kind_of(topic: Topic) -> str:
    return topic.type if topic.is_ros else f"{topic.type or 'messages'} ({topic.encoding})"


def pick(recording, kind, topics, wanted, rank) -> tuple[Topic, str]:
    """The wanted topic, or the first by `rank`; and why, where it was wanted."""
    if not wanted:
        return min(topics, key=rank), ""
    for topic in topics:
        if topic.name == wanted:
            return topic, "as input.%s_topic says" % kind
    names = ", ".join(t.name for t in topics) or "none"
    raise BagError(f"{recording.path}: has no {kind} topic '{wanted}'; there are: {names}")


def lidar_rank(topic: Topic):
    return (not topic.time_field, -topic.points_per_second, topic.name)


def imu_rank(topic: Topic, lidar: Topic, tree: TransformTree):
    found = tree.find(topic.frame, lidar.frame)
    steps = found[1] if found else math.inf
    shared = len(common_namespace(topic.name, lidar.name))
    return (steps, -shared, -topic.rate, topic.name)


def common_namespace(a: str, b: str) -> list[str]:
    parts = []
    for x, y in zip(a.strip("/").split("/")[:-1], b.strip("/").split("/")[:-1]):
        if x != y:
            break
        parts.append(x)
    return parts


def others(topics: list[Topic], chosen: Topic) -> str:
    names = ", ".join(t.name for t in topics if t.name != chosen.name)
    return f"; others: {names}" if names else ""


def lidar_reason(chosen: Topic, clouds: list[Topic]) -> str:
    if len(clouds) == 1:
        return "the only one with clouds"
    times = f"times in '{chosen.time_field}'" if chosen.time_field else "no times of points"
    return f"{chosen.points_per_second:.0f} points/s, {times}" + others(clouds, chosen)


def imu_reason(chosen: Topic, imus: list[Topic], found) -> str:
    if len(imus) == 1:
        return "the only one"
    near = f"{found[1]} transforms from the LiDAR" if found else f"{chosen.rate:.0f} Hz"
    return near + others(imus, chosen)


def extrinsic_reason(imu: Topic, lidar: Topic, found, source: str) -> str:
    frames = f"'{imu.frame}' and '{lidar.frame}'"
    if found is None:
        return (
            f"T_imu_lidar: {source} does not link {frames}: the identity is assumed; "
            "set input.T_imu_lidar=[x, y, z, qx, qy, qz, qw]"
        )
    if found[1] == 0:
        return f"T_imu_lidar: the identity, both are in the frame '{imu.frame}'"
    x, y, z = found[0][:3, 3]
    return f"T_imu_lidar: from {source}, {frames} are {x:.3f} {y:.3f} {z:.3f} m apart"
