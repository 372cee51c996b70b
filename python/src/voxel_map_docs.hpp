// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#pragma once

namespace nvm::python {

inline constexpr char kVoxelMapDoc[] = R"(A voxel map that tells the two faces of a thin wall apart.

Points are stored with their normals, in voxels that keep a front and a back surface; queries with
a normal meet only the faces that look back at it. Bounded: a full map drops the voxels that were
not used for longest. The same input gives the same map and the same answers, for any number of
threads.

Arrays may be float32 or float64, of any strides; they are read where they lie. Threads may use one
map at once: queries run side by side, a change waits for them and they for it. Maps can be pickled
and copied. Points are told by their row in `points`, `normals` and `sides`, which holds until the
map is next changed.)";

inline constexpr char kInsertDoc[] = R"(Insert a scan.

Parameters
----------
points : (N, 3) float
    [m], in the frame scan.
normals : (N, 3) float or None
    Unit vectors in the frame scan that look back at the sensor, from `estimate_normals` or
    `view_directions`. None: all points go to the front, and only queries without a normal find
    them.
T_map_scan : (4, 4) float, optional
    Pose of the scan in the map; the identity without it.
intensity, time, color, label : (N,) number, color (N, 3), optional
    What points carry beside, kept by a map that was made with ``intensity=True`` and so on: float32,
    float64 [s], 0 to 255, and 0 to 65535. Zero where they are not given. A point that is moved to a
    mean plane keeps those that it came with.

Returns
-------
InsertStats
    How many points were stored, and why the others were not. Bad points are no error.

Raises
------
ValueError
    For arrays of other shapes, unequal lengths, a pose that is not rigid, or a column that the map
    does not keep.)";

inline constexpr char kColumnDoc[] =
    R"(What the points carry beside: a copy, in the order of `points`.

Parameters
----------
name : str
    ``"intensity"``, ``"time"``, ``"color"`` or ``"label"``, of those that the map keeps.

Returns
-------
(N,) float32, float64 or uint16, or (N, 3) uint8 for the colour

Raises
------
ValueError
    For another name, or a column that the map does not keep.)";

inline constexpr char kNearestDoc[] = R"(Find the nearest stored points of many points.

Looks at the 27 voxels around each point, so neighbours lie at most one to two voxel sizes away;
with more `rings` farther, and more slowly.

Parameters
----------
points : (M, 3) float
    [m], map frame.
normals : (M, 3) float, optional
    Unit vectors in the map frame that look back at the sensor. Only surfaces and points that agree
    with them are found, none for a vector that is not of unit length. None: both sides.
k : int
    How many, 1 to 64.
max_distance : float
    [m].
rings : int
    Of voxels around that of the point: 1 for the 27, n for (2 n + 1)**3.
threads : int
    0: all cores, for batches that are worth it. The answer does not depend on it.

Returns
-------
distances : (M, k) float64
    [m], ascending; inf where there are fewer than k.
indices : (M, k) int64
    Rows of `points`, `normals` and `sides`; ``len(map)`` where there are fewer than k.
counts : (M,) int64
    How many were found.)";

inline constexpr char kWithinDoc[] = R"(Find all stored points in a ball.

Parameters
----------
center : (3,) float
    [m], map frame.
radius : float
    [m], of any size.

Returns
-------
(K,) int64
    Rows of `points`, `normals` and `sides`, ascending.)";

}  // namespace nvm::python
