// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#pragma once

namespace nvm::python {

inline constexpr char kRawScanDoc[] = R"(A scan as it was measured, for `Odometry.register`.

Attributes
----------
points : (N, 3) float32
    [m], in the LiDAR's frame at each point's own time; `len` gives N.
times : (N,) float64
    When each was seen [s], ascending.
begin, end : float
    Of the sweep [s].)";

inline constexpr char kScanStreamDoc[] =
    R"(The clouds of a topic as scans of one LiDAR, each once: as ``nvm run`` reads them from a bag.

Units of point times, what they count from, and whether a stamp dates the begin or the end of a
sweep are inferred; points without a return and times that fit into no sweep are left out.

Parameters
----------
input : dict, optional
    Settings of the section ``input`` of a configuration: ``{"point_time_unit": "us"}``.

Raises
------
ValueError
    For an unknown key, or a value out of range.)";

inline constexpr char kLearnDoc[] =
    R"(Judge by the first clouds how points are dated; without it, the first of `convert` alone tells.

Parameters
----------
messages : list of bytes
    In order, as for `convert`, to which they are given again. Some twenty, as any one may be bad.
type : str
    Of the messages.

Returns
-------
int
    How many of them can be read. With none, nothing is learned.)";

inline constexpr char kConvertDoc[] = R"(The scan of the next cloud.

Parameters
----------
message : bytes or memoryview
    As ROS 1 serialises it (`nvm.serialization.ros1_of` makes it of a ROS 2 message).
type : str
    ``sensor_msgs/PointCloud2``, or ``CustomMsg`` of one of Livox's drivers.

Returns
-------
Scan

Raises
------
ValueError
    For another type.
RuntimeError
    For a cloud that is truncated, has no x y z, comes from another LiDAR, or was sent before.)";

inline constexpr char kNotesDoc[] = R"(What was inferred, mended and left out so far.

Returns
-------
list of str
    One line each.)";

inline constexpr char kScanFindingsDoc[] = R"(Those of `notes` that call for action.

Returns
-------
list of str
    One line each.)";

}  // namespace nvm::python
