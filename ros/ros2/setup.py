# SPDX-License-Identifier: MIT
# Copyright (c) 2026 The nvm authors
from glob import glob

from setuptools import setup

setup(
    name="nvm_ros",
    version="0.1.0",
    packages=["nvm_ros"],
    data_files=[
        ("share/ament_index/resource_index/packages", ["resource/nvm_ros"]),
        ("share/nvm_ros", ["package.xml"]),
        ("share/nvm_ros/launch", glob("launch/*.launch.py")),
    ],
    install_requires=["setuptools", "numpy", "nvm"],
    entry_points={"console_scripts": ["odometry_node = nvm_ros.odometry_node:main"]},
    license="MIT",
)
