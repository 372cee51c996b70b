# SPDX-License-Identifier: MIT
# Copyright (c) 2026 The nvm authors
"""Messages of ROS 2 as ROS 1 serialises them, which is how the compiled part reads them."""

from __future__ import annotations

import functools

from .imu import IMU, imu_cdr_to_ros1
from .livox import is_livox, livox_cdr_to_ros1, register_livox
from .message_definitions import DEFINITIONS, HEADER, ROS1_HEADER


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


def typestore(header: str):
    """The types that are read, for rosbags."""
    from rosbags.typesys import Stores, get_types_from_msg, get_typestore

    types = get_types_from_msg(header, "std_msgs/msg/Header")
    for name, text in DEFINITIONS.items():
        types.update(get_types_from_msg(text, name))
    store = get_typestore(Stores.EMPTY)
    store.register(types)
    register_livox(store)
    return store


ros1_typestore = functools.cache(functools.partial(typestore, ROS1_HEADER))
ros2_typestore = functools.cache(functools.partial(typestore, HEADER))
