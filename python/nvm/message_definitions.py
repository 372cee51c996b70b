# SPDX-License-Identifier: MIT
# Copyright (c) 2026 The nvm authors
"""The messages of ROS that are read, as its .msg files define them: rosbags has all of them, but takes 0.1 s to begin."""

TRANSFORMS = "tf2_msgs/msg/TFMessage"

HEADER = """
builtin_interfaces/Time stamp
string frame_id
"""
ROS1_HEADER = "uint32 seq" + HEADER

DEFINITIONS = {
    "geometry_msgs/msg/Vector3": """
float64 x
float64 y
float64 z
""",
    "geometry_msgs/msg/Quaternion": """
float64 x
float64 y
float64 z
float64 w
""",
    "geometry_msgs/msg/Transform": """
Vector3 translation
Quaternion rotation
""",
    "geometry_msgs/msg/TransformStamped": """
std_msgs/Header header
string child_frame_id
Transform transform
""",
    TRANSFORMS: """
geometry_msgs/TransformStamped[] transforms
""",
    "sensor_msgs/msg/Imu": """
std_msgs/Header header
geometry_msgs/Quaternion orientation
float64[9] orientation_covariance
geometry_msgs/Vector3 angular_velocity
float64[9] angular_velocity_covariance
geometry_msgs/Vector3 linear_acceleration
float64[9] linear_acceleration_covariance
""",
    "sensor_msgs/msg/PointField": """
string name
uint32 offset
uint8 datatype
uint32 count
""",
    "sensor_msgs/msg/PointCloud2": """
std_msgs/Header header
uint32 height
uint32 width
PointField[] fields
bool is_bigendian
uint32 point_step
uint32 row_step
uint8[] data
bool is_dense
""",
}
