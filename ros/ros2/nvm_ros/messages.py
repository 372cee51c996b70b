# SPDX-License-Identifier: MIT
# Copyright (c) 2026 The nvm authors
"""From what the odometry gives to messages."""

import numpy as np
from diagnostic_msgs.msg import DiagnosticArray, DiagnosticStatus, KeyValue
from geometry_msgs.msg import PoseStamped, TransformStamped
from nav_msgs.msg import Odometry
from nvm.transforms import quaternion
from rclpy.time import Time

LEVELS = {"tracking": DiagnosticStatus.OK, "lost": DiagnosticStatus.ERROR}


def stamp_of(seconds: float):
    return Time(nanoseconds=round(max(seconds, 0.0) * 1e9)).to_msg()


def fill_pose(T: np.ndarray, pose) -> None:
    pose.position.x, pose.position.y, pose.position.z = map(float, T[:3, 3])
    q = quaternion(T[:3, :3])
    o = pose.orientation
    o.x, o.y, o.z, o.w = map(float, q)


def skew(v: np.ndarray) -> np.ndarray:
    return np.array([[0, -v[2], v[1]], [v[2], 0, -v[0]], [-v[1], v[0], 0]])


def odometry_message(frame, frames, odom: str) -> Odometry:
    """Pose and velocity of the base with their covariances: pose in `odom` as (position, rotation
    about the frame's axes), velocity in the base's frame."""
    message = Odometry()
    message.header.stamp, message.header.frame_id = stamp_of(frame.time), odom
    message.child_frame_id = frames.base
    fill_pose(frame.T_map_body @ frames.T_body_base, message.pose.pose)
    R, t = frame.T_map_body[:3, :3], frames.T_body_base[:3, 3]
    to_base = np.eye(6)
    to_base[:3, 3:] = -skew(R @ t)
    message.pose.covariance = (to_base @ frame.pose_covariance @ to_base.T).ravel()
    R_base_body = frames.T_body_base[:3, :3].T
    linear = R_base_body @ (R.T @ frame.velocity + np.cross(frame.angular_rate, t))
    angular = R_base_body @ frame.angular_rate
    twist = message.twist.twist
    twist.linear.x, twist.linear.y, twist.linear.z = map(float, linear)
    twist.angular.x, twist.angular.y, twist.angular.z = map(float, angular)
    turn = np.zeros((6, 6))
    turn[:3, :3], turn[3:, 3:] = R_base_body @ R.T, R_base_body
    message.twist.covariance = (turn @ frame.twist_covariance @ turn.T).ravel()
    return message


def transform_message(odometry: Odometry) -> TransformStamped:
    message = TransformStamped(header=odometry.header, child_frame_id=odometry.child_frame_id)
    position = odometry.pose.pose.position
    translation = message.transform.translation
    translation.x, translation.y, translation.z = position.x, position.y, position.z
    message.transform.rotation = odometry.pose.pose.orientation
    return message


def pose_message(odometry: Odometry) -> PoseStamped:
    return PoseStamped(header=odometry.header, pose=odometry.pose.pose)


def tum_line(pose: PoseStamped) -> str:
    """t x y z qx qy qz qw."""
    p, q, t = pose.pose.position, pose.pose.orientation, pose.header.stamp
    numbers = (p.x, p.y, p.z, q.x, q.y, q.z, q.w)
    return f"{t.sec}.{t.nanosec:09d} " + " ".join(f"{number:.12g}" for number in numbers) + "\n"


def status_message(stamp, status: str, message: str, level, values: dict) -> DiagnosticArray:
    entry = DiagnosticStatus(name="nvm: odometry", message=message or status, level=level)
    entry.values = [KeyValue(key=key, value=str(value)) for key, value in values.items()]
    array = DiagnosticArray(status=[entry])
    array.header.stamp = stamp
    return array
