# SPDX-License-Identifier: MIT
# Copyright (c) 2026 The nvm authors
"""Between PointCloud2 and arrays."""

import numpy as np
from sensor_msgs.msg import PointCloud2, PointField

TIME_FIELDS = ("time", "t", "timestamp", "offset_time", "time_stamp", "time_offset")
SCALARS = {1: "i1", 2: "u1", 3: "i2", 4: "u2", 5: "i4", 6: "u4", 7: "f4", 8: "f8"}
UNITS = {"s": 1.0, "ms": 1e-3, "us": 1e-6, "ns": 1e-9}


def column(cloud, field) -> np.ndarray:
    """The values of a field, one per point.

    Raises
    ------
    ValueError
        When the cloud is shorter than it says.
    """
    kind = np.dtype((">" if cloud.is_bigendian else "<") + SCALARS[field.datatype])
    data = np.frombuffer(cloud.data, np.uint8)
    steps = (cloud.row_step if cloud.height > 1 else 0, cloud.point_step)
    shape = (cloud.height, cloud.width)
    end = (cloud.height - 1) * steps[0] + (cloud.width - 1) * steps[1] + field.offset + kind.itemsize
    if cloud.height * cloud.width > 0 and end > data.size:
        raise ValueError("the cloud has fewer data than its size says")
    return np.ndarray(shape, kind, data, field.offset, steps).ravel()


def seconds_of(cloud) -> float:
    return cloud.header.stamp.sec + 1e-9 * cloud.header.stamp.nanosec


class CloudReader:
    """From the messages of a topic to points and their times. Keeps the unit of times that the
    first scan tells, and to one LiDAR where two publish on the topic."""

    def __init__(self, unit: str = "auto"):
        self._seconds = UNITS.get(unit)
        self._frame, self._stamp = None, 0.0

    def read(self, cloud) -> tuple[np.ndarray, np.ndarray]:
        """Positions (N, 3) [m] and times (N,) [s]; all equal to the stamp without a time field.

        Raises
        ------
        ValueError
            Without x y z, for a cloud that is shorter than it says, or one of another frame while
            those of the first one go on.
        """
        self._check_frame(cloud.header.frame_id, seconds_of(cloud))
        fields = {field.name: field for field in cloud.fields if field.datatype in SCALARS}
        missing = [name for name in "xyz" if name not in fields]
        if missing:
            raise ValueError(f"the cloud has no field '{missing[0]}'")
        points = np.stack([column(cloud, fields[name]) for name in "xyz"], axis=1)
        stamp = seconds_of(cloud)
        name = next((name for name in TIME_FIELDS if name in fields), None)
        if name is None or len(points) == 0:
            return points, np.full(len(points), stamp)
        ticks = column(cloud, fields[name])
        return points, self._times(ticks.astype(np.float64), ticks.dtype.kind in "iu", stamp)

    def _check_frame(self, frame: str, stamp: float) -> None:
        gone = 1.0  # a frame that has not come for so long has a new name [s]
        if self._frame not in (None, frame) and abs(stamp - self._stamp) < gone:
            raise ValueError(f"is of frame '{frame}', not '{self._frame}' as those before: two LiDARs on one topic")
        self._frame, self._stamp = frame, stamp

    def _times(self, ticks, is_whole, stamp):
        finite = ticks[np.isfinite(ticks)]
        span = float(np.ptp(finite)) if finite.size else 0.0
        if self._seconds is None and span > 0.0:
            self._seconds = likely_unit(span, is_whole)
        times = ticks * (self._seconds or 1.0)
        first = float(np.nanmin(times)) if finite.size else 0.0
        is_relative = abs(first) < 10.0 and abs(first - stamp) > abs(first)
        is_absolute = abs(first - stamp) < 10.0 or first > 1e8
        return times + (stamp if is_relative else 0.0 if is_absolute else stamp - first)


def likely_unit(span: float, is_whole: bool) -> float:
    """The unit [s] in which a scan that lasts `span` ticks is nearest to 0.1 s; whole numbers are
    never seconds."""
    units = [unit for name, unit in UNITS.items() if not (is_whole and name == "s")]
    return min(units, key=lambda unit: abs(np.log10(span * unit / 0.1)))


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
