#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
# Copyright (c) 2026 The nvm authors
"""Draws the floor plan of a sequence folder: solids, thin walls and the true trajectory.

usage: plot_scene.py FOLDER PICTURE.png [--floor 0] [--height 1.3]

The plan is cut at --height above --floor [m]: solids that reach the cut are dark, lower ones light,
listed thin walls red.
"""

import argparse
import json
import math
import pathlib

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
import numpy as np
from matplotlib.patches import Circle, Polygon


def rotation(quaternion_xyzw):
    """3x3 rotation matrix of a unit quaternion."""
    x, y, z, w = quaternion_xyzw
    return np.array(
        [
            [1 - 2 * (y * y + z * z), 2 * (x * y - z * w), 2 * (x * z + y * w)],
            [2 * (x * y + z * w), 1 - 2 * (x * x + z * z), 2 * (y * z - x * w)],
            [2 * (x * z - y * w), 2 * (y * z + x * w), 1 - 2 * (x * x + y * y)],
        ]
    )


def outline(solid):
    """The solid as a patch in x, y, and the heights [m] of its bottom and top."""
    center = np.array(solid["pose"]["translation"])
    R = rotation(solid["pose"]["quaternion_xyzw"])
    if solid["type"] == "cylinder":
        half = solid["half_height"] * abs(R[2, 2]) + solid["radius"] * math.hypot(*R[2, :2])
        return Circle(center[:2], solid["radius"]), center[2] - half, center[2] + half
    half_size = np.array(solid["half_size"])
    half = np.abs(R[2]) @ half_size
    corners = [center + R @ (half_size * [sx, sy, 0]) for sx, sy in ((1, 1), (1, -1), (-1, -1), (-1, 1))]
    return Polygon([corner[:2] for corner in corners]), center[2] - half, center[2] + half


def draw_solids(axes, scene, floor, height):
    listed = [np.mean([face["center"] for face in wall["faces"]], axis=0) for wall in scene["walls"]]
    for solid in scene["primitives"]:
        if solid["type"] == "mesh":
            vertices = np.array(solid["vertices"])
            axes.triplot(vertices[:, 0], vertices[:, 1], solid["triangles"], color="0.6", lw=0.3)
            continue
        patch, bottom, top = outline(solid)
        if top < floor + 0.02 or bottom > floor + height:
            continue  # floors, and what hangs above the cut
        center = np.array(solid["pose"]["translation"])
        is_listed = any(np.linalg.norm(center - wall) < 1e-6 for wall in listed)
        is_cut = top > floor + height
        patch.set(
            facecolor="tab:red" if is_listed else "0.35" if is_cut else "0.8",
            edgecolor="tab:red" if is_listed else "0.3",
            linewidth=0.8 if is_listed else 0.3,
            zorder=3 if is_listed else 2 if is_cut else 1,
        )
        axes.add_patch(patch)


def draw_trajectory(axes, poses):
    axes.plot(poses[:, 1], poses[:, 2], color="tab:blue", lw=1, zorder=4)
    axes.plot(*poses[0, 1:3], "o", color="tab:green", ms=5, zorder=5)
    for pose in poses[::50]:
        heading = rotation(pose[4:8])[:2, 0] * 0.4
        axes.arrow(*pose[1:3], *heading, width=0.03, color="tab:blue", zorder=4)


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("folder", type=pathlib.Path)
    parser.add_argument("picture", type=pathlib.Path)
    parser.add_argument("--floor", type=float, default=0.0, help="of the storey to draw [m]")
    parser.add_argument("--height", type=float, default=1.3, help="of the cut above it [m]")
    arguments = parser.parse_args()
    scene = json.loads((arguments.folder / "scene.json").read_text())
    figure, axes = plt.subplots(figsize=(8, 6), layout="constrained")
    draw_solids(axes, scene, arguments.floor, arguments.height)
    poses = np.loadtxt(arguments.folder / "groundtruth.tum")[::10]
    draw_trajectory(axes, poses)
    length = np.linalg.norm(np.diff(poses[:, 1:4], axis=0), axis=1).sum()
    axes.set(
        aspect="equal",
        title=f"{scene['name']}: {length:.0f} m in {poses[-1, 0] - poses[0, 0]:.0f} s",
        xlabel="x [m]",
        ylabel="y [m]",
    )
    axes.autoscale_view()
    figure.savefig(arguments.picture, dpi=90, bbox_inches="tight")


if __name__ == "__main__":
    main()
