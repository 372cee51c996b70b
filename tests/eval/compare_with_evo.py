#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
# Copyright (c) 2026 The nvm authors
"""Checks ATE and RPE of `nvm evaluate` against the evo package, to 1e-6.

usage: compare_with_evo.py NVM_PROGRAM

Exit status 77 (a skipped test) when evo is not installed.
"""
import json
import math
import pathlib
import subprocess
import sys
import tempfile

try:
    import numpy
    from evo.core import metrics, trajectory
    from evo.tools import file_interface
    from scipy.spatial.transform import Rotation, Slerp
except ImportError as error:
    print(f"skipped: {error}")
    sys.exit(77)

TOLERANCE = 1e-6


def random_walk(rng, times):
    """A smooth trajectory: TUM rows t x y z qx qy qz qw."""
    phases = rng.uniform(0, 2 * math.pi, (6, 4))
    scales = rng.uniform(0.2, 1.0, (6, 4))
    waves = [
        sum(s * numpy.sin(0.3 * (k + 1) * times + p) for k, (s, p) in enumerate(zip(*pair)))
        for pair in zip(scales, phases)
    ]
    quaternions = Rotation.from_rotvec(0.6 * numpy.array(waves[3:]).T).as_quat()
    return numpy.column_stack([times, 2.0 * numpy.array(waves[:3]).T, quaternions])


def disturbed(rng, rows, scale):
    """`rows` in another frame, with drift, noise and a scale."""
    turn = Rotation.from_rotvec(rng.uniform(-2, 2, 3))
    drift = numpy.outer(rows[:, 0] - rows[0, 0], rng.uniform(-0.01, 0.01, 3))
    positions = scale * turn.apply(rows[:, 1:4] + drift) + rng.uniform(-50, 50, 3)
    positions += rng.normal(0, 0.01, positions.shape)
    noise = Rotation.from_rotvec(rng.normal(0, 0.01, (len(rows), 3)))
    quaternions = (turn * Rotation.from_quat(rows[:, 4:]) * noise).as_quat()
    return numpy.column_stack([rows[:, 0], positions, quaternions])


def interpolated(rows, times):
    """The poses of `rows` at `times`: straight lines and slerp."""
    positions = [numpy.interp(times, rows[:, 0], rows[:, i]) for i in (1, 2, 3)]
    quaternions = Slerp(rows[:, 0], Rotation.from_quat(rows[:, 4:]))(times).as_quat()
    return numpy.column_stack([times, *positions, quaternions])


def write_tum(path, rows):
    numpy.savetxt(path, rows, fmt="%.12f")


def evo_trajectory(rows):
    quaternions_wxyz = numpy.roll(rows[:, 4:], 1, axis=1)
    return trajectory.PoseTrajectory3D(rows[:, 1:4], quaternions_wxyz, rows[:, 0])


def evaluated(program, folder, alignment):
    subprocess.run(
        [program, "evaluate", folder / "run", "--truth", folder / "truth.tum"]
        + ["--out", folder / "report", "--align", alignment],
        check=True,
        stdout=subprocess.DEVNULL,
    )
    report = json.loads((folder / "report" / "evaluation.json").read_text())
    return report["runs"][0]["trajectory"]


def check(label, ours, theirs):
    for key in ("rmse", "mean", "median", "max"):
        if not abs(ours[key] - theirs[key]) < TOLERANCE:
            sys.exit(f"{label} {key}: nvm {ours[key]!r}, evo {theirs[key]!r}")


def statistics_of(errors):
    errors = numpy.asarray(errors)
    return {
        "rmse": math.sqrt(numpy.mean(errors**2)),
        "mean": numpy.mean(errors),
        "median": numpy.median(errors),
        "max": numpy.max(errors),
    }


def check_ate(ours, truth, estimate, alignment):
    if alignment != "none":
        estimate.align(truth, correct_scale=alignment == "sim3")
    ape = metrics.APE(metrics.PoseRelation.translation_part)
    ape.process_data((truth, estimate))
    check(f"ATE, {alignment}", ours["ate_m"], ape.get_all_statistics())


def check_rpe_per_frame(ours, truth, estimate):
    for relation, key in (
        (metrics.PoseRelation.translation_part, "translation_m"),
        (metrics.PoseRelation.rotation_angle_deg, "rotation_deg"),
    ):
        rpe = metrics.RPE(relation, delta=1, delta_unit=metrics.Unit.frames, all_pairs=True)
        rpe.process_data((truth, estimate))
        check(f"RPE per frame, {key}", ours["rpe_per_frame"][key], rpe.get_all_statistics())


def check_rpe_per(ours, name, progress, truth, estimate):
    """Steps as nvm takes them (to the first pose a unit later), errors by evo's formula."""
    errors = []
    for i, start in enumerate(progress):
        later = numpy.nonzero(progress[i:] - start >= 1 - 1e-6)[0]
        if later.size:
            j = i + later[0]
            true, estimated = truth.poses_se3, estimate.poses_se3
            errors.append(metrics.RPE.rpe_base(true[i], true[j], estimated[i], estimated[j]))
    translations = [numpy.linalg.norm(e[:3, 3]) for e in errors]
    rotations = [numpy.degrees(Rotation.from_matrix(e[:3, :3]).magnitude()) for e in errors]
    check(f"RPE per {name}", ours[f"rpe_per_{name}"]["translation_m"], statistics_of(translations))
    check(f"RPE per {name}", ours[f"rpe_per_{name}"]["rotation_deg"], statistics_of(rotations))


def check_case(program, folder, seed, alignment):
    rng = numpy.random.default_rng(seed)
    on_grid = seed % 2 == 0
    grid = 100.0 + 0.01 * numpy.arange(3001)
    times = grid[5:-5:10] + (0.0 if on_grid else rng.uniform(0.0, 0.0099, 300))
    truth = random_walk(rng, grid)
    truth_at_times = interpolated(truth, times)
    scale = 1.03 if alignment == "sim3" else 1.0
    estimate = disturbed(rng, truth_at_times, scale)
    if alignment == "none":
        estimate[:, 1:4] = truth_at_times[:, 1:4] + rng.normal(0, 0.02, (len(times), 3))
    write_tum(folder / "truth.tum", truth)
    write_tum(folder / "run" / "trajectory.tum", estimate)

    ours = evaluated(program, folder, alignment)
    assert ours["poses"] == len(times) and ours["unmatched_poses"] == 0
    # evo interpolates nothing: between the truth's times it gets the truth that scipy interpolates
    true_poses = file_interface.read_tum_trajectory_file(str(folder / "truth.tum"))
    if on_grid:
        true_poses.reduce_to_ids(list(range(5, 2996, 10)))
    else:
        true_poses = evo_trajectory(truth_at_times)
    estimated_poses = evo_trajectory(estimate)
    check_rpe_per_frame(ours, true_poses, estimated_poses)
    check_rpe_per(ours, "second", times, true_poses, estimated_poses)
    check_rpe_per(ours, "metre", true_poses.distances, true_poses, estimated_poses)
    check_ate(ours, true_poses, estimated_poses, alignment)


def main():
    program = sys.argv[1]
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        (folder / "run").mkdir()
        header = "ply\nformat binary_little_endian 1.0\nelement vertex 0\n"
        fields = "".join(f"property float {axis}\n" for axis in "xyz")
        (folder / "run" / "map.ply").write_text(header + fields + "end_header\n")
        for seed in range(4):
            for alignment in ("se3", "sim3", "none"):
                check_case(program, folder, seed, alignment)
    print(f"ATE and RPE agree with evo to {TOLERANCE}")


if __name__ == "__main__":
    main()
