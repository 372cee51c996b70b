# SPDX-License-Identifier: MIT
# Copyright (c) 2026 The nvm authors
"""Odometry and map from a LiDAR and an IMU.

ros2 launch nvm_ros odometry.launch.py                            topics found by their types
ros2 launch nvm_ros odometry.launch.py lidar_topic:=/points base_frame:=base_link
ros2 launch nvm_ros odometry.launch.py config:=/path/options.yaml options of `nvm run --config`
"""

import yaml
from launch import LaunchDescription
from launch.actions import DeclareLaunchArgument, OpaqueFunction
from launch.substitutions import LaunchConfiguration
from launch_ros.actions import Node

ARGUMENTS = {
    "config": ("", "YAML of options, as of nvm run --config"),
    "lidar_topic": ("", "empty: the first PointCloud2"),
    "imu_topic": ("", "empty: the first Imu; none: without"),
    "odom_frame": ("odom", ""),
    "base_frame": ("", "empty: the IMU's (or LiDAR's)"),
    "save_folder": ("", "of the service nvm/save; empty: ~/.ros/nvm"),
}


def flat(mapping: dict, prefix: str = "") -> dict:
    """Nested options as parameters with dots."""
    parameters = {}
    for key, value in mapping.items():
        if isinstance(value, dict):
            parameters |= flat(value, f"{prefix}{key}.")
        else:
            parameters[prefix + key] = value
    return parameters


def nodes(context):
    given = {name: LaunchConfiguration(name).perform(context) for name in ARGUMENTS}
    config = given.pop("config")
    parameters = {}
    if config:
        with open(config) as file:
            parameters = flat(yaml.safe_load(file) or {})
    parameters |= {name: value for name, value in given.items() if value}
    return [
        Node(package="nvm_ros", executable="odometry_node", output="screen", parameters=[parameters])
    ]


def generate_launch_description() -> LaunchDescription:
    declared = [
        DeclareLaunchArgument(name, default_value=default, description=text)
        for name, (default, text) in ARGUMENTS.items()
    ]
    return LaunchDescription([*declared, OpaqueFunction(function=nodes)])
