# SPDX-License-Identifier: MIT
# Copyright (c) 2026 The nvm authors
"""The node's parameters. Those of the odometry have the names of `nvm run --config`, with dots:
map.voxel_size."""

import dataclasses


@dataclasses.dataclass
class Options:
    lidar_topic: str = ""  # empty: found by type
    imu_topic: str = ""  # empty: found by type; "none": odometry from scans alone
    T_imu_lidar: list = dataclasses.field(default_factory=list)  # empty: from TF
    detection_time: float = 3.0  # [s]
    queue_size: int = 10  # scans
    imu_timeout: float = 0.25  # how long a scan waits for readings [s]
    odom_frame: str = "odom"
    base_frame: str = ""  # empty: the IMU's (or LiDAR's)
    publish_tf: bool = True
    tf_timeout: float = 0.5  # [s]
    map_period: float = 2.0  # [s]; 0: no map
    save_folder: str = ""  # empty: ~/.ros/nvm


def split(parameters: dict) -> tuple[Options, dict]:
    """The node's own options, and what remains as the nested configuration of nvm.Odometry, which
    refuses unknown keys. Keys of ROS itself are left out.

    Raises
    ------
    ValueError
        For a value of another type than the default's.
    """
    options, config = Options(), {}
    for name, value in parameters.items():
        if name in ("use_sim_time", "start_type_description_service") or name.startswith("qos_"):
            continue
        if name in Options.__dataclass_fields__:
            kind = type(getattr(options, name))
            if not isinstance(value, kind) and not (kind is float and isinstance(value, int)):
                value = list(value) if kind is list and not isinstance(value, str) else value
                if not isinstance(value, kind):
                    raise ValueError(f"{name} = {value!r} must be a {kind.__name__}")
            setattr(options, name, value)
            continue
        at = config
        *sections, key = name.split(".")
        for section in sections:
            at = at.setdefault(section, {})
        at[key] = list(value) if hasattr(value, "tolist") else value
    return options, config
