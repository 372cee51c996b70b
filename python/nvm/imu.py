# SPDX-License-Identifier: MIT
# Copyright (c) 2026 The nvm authors
"""sensor_msgs/Imu: of some hundred a second, each of which would take rosbags' converter longer than a cloud."""

import struct

IMU = "sensor_msgs/msg/Imu"
NUMBERS_SIZE = 37 * 8  # [bytes]: orientation, rate and acceleration, each with its covariance
LITTLE_ENDIAN = b"\0\1"  # in front of CDR


def imu_cdr_to_ros1(raw) -> bytes | None:
    """A message of ROS 2 as ROS 1 serialises it; None for one that is not little endian.

    Raises
    ------
    ValueError
        When it is truncated.
    """
    raw = bytes(raw)
    if not raw.startswith(LITTLE_ENDIAN):
        return None
    try:
        seconds, nanoseconds, length = struct.unpack_from("<iII", raw, 4)
    except struct.error as error:
        raise ValueError("an Imu is truncated") from error
    frame = raw[16 : 16 + length].rstrip(b"\0")
    at = 4 + -(-(12 + length) // 8) * 8
    numbers = raw[at : at + NUMBERS_SIZE]
    if len(numbers) < NUMBERS_SIZE:
        raise ValueError("an Imu is truncated")
    return struct.pack("<IiII", 0, seconds, nanoseconds, len(frame)) + frame + numbers
