# SPDX-License-Identifier: MIT
# Copyright (c) 2026 The nvm authors
"""The tree of a recording's static transforms."""

from __future__ import annotations

import numpy as np


def rotation(x: float, y: float, z: float, w: float) -> np.ndarray:
    """(3, 3) of a quaternion of any length."""
    n = x * x + y * y + z * z + w * w
    x, y, z, w = np.array([x, y, z, w]) / np.sqrt(n)
    return np.array(
        [
            [1 - 2 * (y * y + z * z), 2 * (x * y - z * w), 2 * (x * z + y * w)],
            [2 * (x * y + z * w), 1 - 2 * (x * x + z * z), 2 * (y * z - x * w)],
            [2 * (x * z - y * w), 2 * (y * z + x * w), 1 - 2 * (x * x + y * y)],
        ]
    )


def quaternion(R: np.ndarray) -> np.ndarray:
    """x y z w of a rotation (3, 3), w not negative."""
    # The eigenvector of the largest eigenvalue (Bar-Itzhack): safe for every angle.
    K = np.array(
        [
            [R[0, 0] - R[1, 1] - R[2, 2], 0, 0, 0],
            [R[0, 1] + R[1, 0], R[1, 1] - R[0, 0] - R[2, 2], 0, 0],
            [R[0, 2] + R[2, 0], R[1, 2] + R[2, 1], R[2, 2] - R[0, 0] - R[1, 1], 0],
            [R[2, 1] - R[1, 2], R[0, 2] - R[2, 0], R[1, 0] - R[0, 1], np.trace(R)],
        ]
    )
    q = np.linalg.eigh(K)[1][:, 3]
    return -q if q[3] < 0 else q


class TransformTree:
    """Frames and the transforms between them. Frames are named without a leading slash."""

    def __init__(self):
        self._neighbors: dict[str, dict[str, np.ndarray]] = {}

    def __bool__(self) -> bool:
        return bool(self._neighbors)

    @property
    def frames(self) -> list[str]:
        return sorted(self._neighbors)

    def add(self, stamped) -> None:
        """Takes a geometry_msgs/TransformStamped: the pose of its child in its header's frame. One
        that is not finite, or without a rotation, is left out."""
        t, q = stamped.transform.translation, stamped.transform.rotation
        T = np.eye(4)
        T[:3, 3] = (t.x, t.y, t.z)
        with np.errstate(invalid="ignore", divide="ignore"):
            T[:3, :3] = rotation(q.x, q.y, q.z, q.w)
        if not np.isfinite(T).all():
            return
        self.link(stamped.header.frame_id.lstrip("/"), stamped.child_frame_id.lstrip("/"), T)

    def link(self, parent: str, child: str, T: np.ndarray) -> None:
        """Takes T_parent_child (4, 4), finite."""
        self._neighbors.setdefault(parent, {})[child] = T
        self._neighbors.setdefault(child, {})[parent] = np.linalg.inv(T)

    def find(self, target: str, source: str) -> tuple[np.ndarray, int] | None:
        """T_target_source (4, 4), which maps coordinates of `source` to `target`, and over how many
        transforms; None when they are not linked."""
        if target == source:
            return np.eye(4), 0
        found = {target: (np.eye(4), 0)}
        queue = [target]
        for frame in queue:
            T, steps = found[frame]
            for neighbor, T_frame_neighbor in self._neighbors.get(frame, {}).items():
                if neighbor not in found:
                    found[neighbor] = (T @ T_frame_neighbor, steps + 1)
                    queue.append(neighbor)
        return found.get(source)
