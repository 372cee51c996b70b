# SPDX-License-Identifier: MIT
# Copyright (c) 2026 The nvm authors
"""Messages of ROS 2 as ROS 1 serialises them, which is how the compiled part reads them."""

from __future__ import annotations

import functools

from .imu import IMU, imu_cdr_to_ros1
from .livox import is_livox, livox_cdr_to_ros1, register_livox

TRANSFORMS = "tf2_msgs/msg/TFMessage"


def ros1_of(raw: bytes | memoryview, kind: str) -> bytes | memoryview:
    """A message of ROS 2 (CDR) as ROS 1 serialises it.

    Parameters
    ----------
    raw : bytes
        As a raw subscription or a bag gives it.
    kind : str
        ``sensor_msgs/msg/PointCloud2``.

    Raises
    ------
    Exception
        Of whatever kind rosbags has it, for one that is truncated.
    """
    if is_livox(kind):
        return livox_cdr_to_ros1(raw)
    short = imu_cdr_to_ros1(raw) if kind == IMU else None
    return short or ros2_typestore().cdr_to_ros1(raw, kind)


@functools.cache
def ros1_typestore():
    """The types of ROS 1 and of Livox's drivers, for rosbags."""
    from rosbags.typesys import Stores, get_types_from_msg, get_typestore

    store = get_typestore(Stores.ROS1_NOETIC)
    register_livox(store)
    if TRANSFORMS not in store.types:
        store.register(get_types_from_msg("geometry_msgs/TransformStamped[] transforms", TRANSFORMS))
    return store


@functools.cache
def ros2_typestore():
    """The types of ROS 2 and of Livox's drivers, for rosbags."""
    from rosbags.typesys import Stores, get_typestore

    store = get_typestore(Stores.ROS2_HUMBLE)
    register_livox(store)
    return store
