# SPDX-License-Identifier: MIT
# Copyright (c) 2026 The nvm authors
"""CustomMsg, the cloud message of Livox's drivers."""

import struct

import numpy as np

PACKAGES = ("livox_ros_driver", "livox_ros_driver2", "livox_interfaces")
POINT = """
uint32 offset_time
float32 x
float32 y
float32 z
uint8 reflectivity
uint8 tag
uint8 line
"""
MESSAGE = """
std_msgs/Header header
uint64 timebase
uint32 point_num
uint8 lidar_id
uint8[3] rsvd
CustomPoint[] points
"""
FIELDS = ("offset_time:u4", "x:f4", "y:f4", "z:f4", "reflectivity:u1", "tag:u1", "line:u1")
POINT_SIZE = 19  # [bytes]
ALIGNED_POINT_SIZE = 20


def is_livox(kind: str) -> bool:
    """Whether messages of a type are CustomMsg, of whatever driver."""
    return kind in {f"{package}/msg/CustomMsg" for package in PACKAGES}


def register_livox(typestore) -> None:
    """Teaches `typestore` of rosbags the type, for bags that do not hold it."""
    from rosbags.typesys import get_types_from_msg

    for package in PACKAGES:
        if f"{package}/msg/CustomMsg" not in typestore.types:
            typestore.register(get_types_from_msg(POINT, f"{package}/msg/CustomPoint"))
            typestore.register(get_types_from_msg(MESSAGE, f"{package}/msg/CustomMsg"))


def livox_cdr_to_ros1(raw) -> bytes:
    """A CustomMsg of ROS 2 as ROS 1 serialises it; rosbags would go through it point by point.

    Raises
    ------
    ValueError
        When it is truncated.
    """
    raw = memoryview(raw)
    order = "<" if raw[1] & 1 else ">"
    body = raw[4:]
    try:
        seconds, nanoseconds, length = struct.unpack_from(order + "iII", body)
        frame = bytes(body[12 : 12 + length]).rstrip(b"\0")
        at = -(-(12 + length) // 8) * 8
        timebase, number, lidar_id, reserved, count = struct.unpack_from(order + "QIB3sI", body, at)
    except struct.error as error:
        raise ValueError("a CustomMsg is truncated") from error
    at += 20
    needed = max(count * ALIGNED_POINT_SIZE - 1, 0)
    if len(body) - at < needed:
        raise ValueError("a CustomMsg is truncated")
    points = np.zeros(count * ALIGNED_POINT_SIZE, np.uint8)
    points[:needed] = np.frombuffer(body, np.uint8, needed, at)
    points = points.reshape(count, ALIGNED_POINT_SIZE)[:, :POINT_SIZE]
    if order == ">":
        for begin in range(0, 16, 4):
            points[:, begin : begin + 4] = points[:, begin : begin + 4][:, ::-1].copy()
    head = struct.pack("<IiII", 0, seconds, nanoseconds, len(frame)) + frame
    middle = struct.pack("<QIB3sI", timebase, number, lidar_id, reserved, count)
    return head + middle + points.tobytes()
