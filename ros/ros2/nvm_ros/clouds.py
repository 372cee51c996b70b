# SPDX-License-Identifier: MIT
# Copyright (c) 2026 The nvm authors
"""Clouds as they come, serialised, and clouds that are made of arrays."""

import dataclasses
import struct

import numpy as np
from nvm.serialization import ros1_of
from sensor_msgs.msg import PointCloud2, PointField

HEADER = struct.Struct("iII")  # of a message: seconds, nanoseconds, length of the frame
CDR_SIZE = 4  # [bytes], of what is in front of it


@dataclasses.dataclass(frozen=True)
class RawCloud:
    """A cloud whose points nobody has looked at yet: the receiving thread has no time for it."""

    kind: str  # sensor_msgs/msg/PointCloud2
    stamp: float  # [s]
    frame: str  # without a leading slash
    arrival: float  # time.monotonic() [s]
    cdr: bytes

    def ros1(self) -> bytes | memoryview:
        """As nvm.ScanStream takes it.

        Raises
        ------
        ValueError
            When it is truncated.
        """
        try:
            return ros1_of(self.cdr, self.kind)
        except Exception as error:  # rosbags lets what struct and numpy find wrong pass
            raise ValueError(f"cannot be read: {error}") from error


def raw_cloud(cdr: bytes, kind: str, arrival: float) -> RawCloud:
    """What the header of a serialised cloud tells."""
    order = "<" if cdr[1] & 1 else ">"
    seconds, nanoseconds, length = struct.unpack_from(order + HEADER.format, cdr, CDR_SIZE)
    begin = CDR_SIZE + HEADER.size
    frame = cdr[begin : begin + length].rstrip(b"\0").decode(errors="replace")
    return RawCloud(kind, seconds + 1e-9 * nanoseconds, frame.lstrip("/"), arrival, cdr)


def cloud_message(stamp, frame: str, columns: dict[str, np.ndarray]) -> PointCloud2:
    """An unorganised cloud of float32 or uint8 columns of equal length."""
    kind = np.dtype([(name, values.dtype) for name, values in columns.items()])
    size = len(next(iter(columns.values())))
    records = np.empty(size, kind)
    cloud = PointCloud2(height=1, width=size, point_step=kind.itemsize, row_step=size * kind.itemsize)
    cloud.header.stamp, cloud.header.frame_id, cloud.is_dense = stamp, frame, True
    for name, values in columns.items():
        records[name] = values
        datatype = PointField.UINT8 if values.dtype == np.uint8 else PointField.FLOAT32
        offset = kind.fields[name][1]
        cloud.fields.append(PointField(name=name, offset=offset, datatype=datatype, count=1))
    cloud.data.frombytes(records.tobytes())
    return cloud
