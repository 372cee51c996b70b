# SPDX-License-Identifier: MIT
# Copyright (c) 2026 The nvm authors
"""Recordings of any kind that is read here, for the program."""

from __future__ import annotations

import pathlib

from .bags import Recording, is_bag
from .packets import PacketRecording, is_packets


def is_recording(path: str | pathlib.Path) -> bool:
    """Whether `path` is a recording of ROS, or of packets."""
    return is_packets(path) or is_bag(path)


def open_recording(path: str | pathlib.Path) -> Recording | PacketRecording:
    """BagError when it cannot be read."""
    return PacketRecording(path) if is_packets(path) else Recording(path)
