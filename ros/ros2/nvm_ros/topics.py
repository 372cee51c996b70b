# SPDX-License-Identifier: MIT
# Copyright (c) 2026 The nvm authors
"""Which topics are read, and how."""

import dataclasses
import importlib

from nvm.livox import is_livox
from rclpy.qos import QoSProfile, ReliabilityPolicy

CLOUD, IMU = "sensor_msgs/msg/PointCloud2", "sensor_msgs/msg/Imu"


@dataclasses.dataclass
class Topics:
    """The chosen ones, empty where there is none, and what was left to choose."""

    lidar: str
    imu: str
    notes: list[str]
    lidar_type: str = CLOUD


def choose(names_and_types, options, wants_imu: bool, own) -> Topics:
    """The topics that `options` name, else the first of each type by name that is not among `own`."""
    found = {kind: [] for kind in (CLOUD, IMU)}
    livox = {}
    for name, kinds in sorted(names_and_types):
        livox |= {name: kind for kind in kinds if is_livox(kind)}
        for kind in {CLOUD if is_livox(kind) else kind for kind in kinds} & set(found):
            if name not in own:
                found[kind].append(name)
    topics = Topics(options.lidar_topic or next(iter(found[CLOUD]), ""), "", [])
    topics.lidar_type = livox.get(topics.lidar, CLOUD)
    if wants_imu:
        topics.imu = options.imu_topic or next(iter(found[IMU]), "")
    for kind, chosen, parameter in ((CLOUD, topics.lidar, "lidar_topic"), (IMU, topics.imu, "imu_topic")):
        if len(found[kind]) > 1 and chosen and not getattr(options, parameter):
            others = ", ".join(found[kind])
            topics.notes.append(f"{chosen} is read, out of {others}: set {parameter} for another one")
    return topics


def message_class(kind: str):
    """The class of messages of a type.

    Raises
    ------
    ValueError
        When its package is not there.
    """
    package, _, name = kind.split("/")
    try:
        return getattr(importlib.import_module(f"{package}.msg"), name)
    except (ImportError, AttributeError) as error:
        raise ValueError(f"messages are {kind}: source the workspace that has {package}") from error


def profile_for(node, topic: str, depth: int) -> QoSProfile:
    """Reliable where all publishers are; best effort, which meets every kind, else."""
    kinds = {info.qos_profile.reliability for info in node.get_publishers_info_by_topic(topic)}
    is_reliable = kinds == {ReliabilityPolicy.RELIABLE}
    policy = ReliabilityPolicy.RELIABLE if is_reliable else ReliabilityPolicy.BEST_EFFORT
    return QoSProfile(depth=depth, reliability=policy)
