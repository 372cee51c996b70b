# SPDX-License-Identifier: MIT
# Copyright (c) 2026 The nvm authors
"""The frames of a run (REP 105) and where they are on the robot."""

import dataclasses
import time

import numpy as np
from nvm.transforms import rotation

try:
    from tf2_ros import Buffer, StaticTransformBroadcaster, TransformBroadcaster, TransformListener
except ImportError:  # not among the packages of PyPI
    Buffer = StaticTransformBroadcaster = TransformBroadcaster = TransformListener = None


@dataclasses.dataclass
class Frames:
    base: str
    T_body_lidar: np.ndarray
    T_body_base: np.ndarray
    notes: list[str]  # what had to be assumed


def pose_of(numbers) -> np.ndarray:
    """(4, 4) of x y z qx qy qz qw.

    Raises
    ------
    ValueError
        For other numbers than these.
    """
    if len(numbers) != 7 or abs(np.linalg.norm(numbers[3:]) - 1.0) > 0.01:
        raise ValueError("T_imu_lidar must be seven numbers x y z qx qy qz qw with a unit quaternion")
    pose = np.eye(4)
    pose[:3, :3] = rotation(*numbers[3:])
    pose[:3, 3] = numbers[:3]
    return pose


class Transforms:
    """What TF says; nothing where tf2_ros is not installed."""

    def __init__(self, node):
        self._buffer = Buffer() if Buffer else None
        self._listener = TransformListener(self._buffer, node) if Buffer else None

    def find(self, target: str, source: str):
        """T_target_source, or None."""
        if target == source:
            return np.eye(4)
        if self._buffer is None:
            return None
        import rclpy.time
        from tf2_ros import TransformException

        try:
            found = self._buffer.lookup_transform(target, source, rclpy.time.Time()).transform
        except TransformException:
            return None
        t, q = found.translation, found.rotation
        return pose_of([t.x, t.y, t.z, q.x, q.y, q.z, q.w])

    def find_frames(self, lidar: str, imu: str | None, options) -> Frames:
        """The frames of messages in `lidar` and `imu`; waits up to options.tf_timeout for TF."""
        body = lidar if imu is None else imu
        base = options.base_frame or body
        deadline = time.monotonic() + options.tf_timeout
        while True:
            T_body_lidar, T_body_base = self.find(body, lidar), self.find(body, base)
            is_complete = T_body_lidar is not None and T_body_base is not None
            if is_complete or self._buffer is None or time.monotonic() >= deadline:
                break
            time.sleep(0.02)
        frames = Frames(base or "base_link", T_body_lidar, T_body_base, [])
        if imu is not None and options.T_imu_lidar:
            frames.T_body_lidar = pose_of(options.T_imu_lidar)
        for name, other in (("T_body_lidar", lidar), ("T_body_base", base)):
            if getattr(frames, name) is None:
                setattr(frames, name, np.eye(4))
                frames.notes.append(
                    f"TF has no transform between '{body}' and '{other}': they are taken to be in one "
                    "place and not turned; publish it on /tf_static"
                    + (" or set T_imu_lidar" if other == lidar else " or leave base_frame empty")
                )
        return frames
