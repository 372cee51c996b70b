#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
# Copyright (c) 2026 The nvm authors
"""Runs every (sequence x pipeline x map), scores it, and writes tables.

    benchmarks/ablation/ablation.py                                   # all of it: hours
    benchmarks/ablation/ablation.py --scenes wall5 --pipelines fast_lio --maps nvm voxel
    benchmarks/ablation/ablation.py --setting noisy                   # 2 cm of range noise
    benchmarks/ablation/ablation.py --grid --out build/grid           # hard scenes x sensors x grades of IMU
    benchmarks/ablation/ablation.py --grid --out build/grid --imu-grades 1 --setting rough late

A run that has been scored is not repeated: stop and resume as you like; delete its folder to repeat it. Results do not depend on
the order or the number of jobs; times do. Writes OUT/figures.json (a list of rows), OUT/report.html and OUT/tables.md, and with
--docs replaces the tables between the markers of a page. --grid asks how the default fares where it is hard, instead of what its parts
are worth: other cases unless you name them, and other tables, of all rows in OUT.
"""
import argparse
import itertools
import json
import sys
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

import grid
import report
from cases import (GRID_SCENES, GRID_SENSORS, IMU_GRADES, MAPS, PIPELINES, SCENES, SENSORS, SETTINGS, TEST_SEEDS, Sequence,
                   measure)


def replace_tables(page: Path, name: str, tables: str) -> None:
    begin, end = f"<!-- {name}: begin -->", f"<!-- {name}: end -->"
    text = page.read_text()
    if text.count(begin) != 1 or text.count(end) != 1:
        sys.exit(f"ablation: {page} needs the markers {begin} and {end} once each")
    before, rest = text.split(begin)
    page.write_text(before + begin + "\n" + tables + end + rest.split(end)[1])


def parse_arguments() -> argparse.Namespace:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--program", type=Path, default=Path("build/release/bin/nvm"))
    parser.add_argument("--out", type=Path, default=Path("build/ablation"))
    parser.add_argument("--grid", action="store_true", help="hard scenes, every grade of IMU, fast_lio on nvm alone")
    parser.add_argument("--scenes", nargs="+")
    parser.add_argument("--sensors", nargs="+", choices=GRID_SENSORS)
    parser.add_argument("--imu-grades", nargs="+", type=float, help="factors of the IMU's errors")
    parser.add_argument("--seeds", nargs="+", type=int)
    parser.add_argument("--setting", nargs="+", default=["plain"], choices=list(SETTINGS))
    parser.add_argument("--pipelines", nargs="+", choices=list(PIPELINES))
    parser.add_argument("--maps", nargs="+", choices=list(MAPS))
    parser.add_argument("--duration", type=float, default=0.0, help="[s]; 0: the whole route")
    parser.add_argument("--jobs", type=int, default=1, help="runs at once; more make times less certain")
    parser.add_argument("--discard-sequences", action="store_true", help="delete the scans once a sequence is done")
    parser.add_argument("--docs", type=Path, help="page whose tables to replace")
    defaults = {"scenes": SCENES, "sensors": SENSORS, "imu_grades": [1.0], "seeds": TEST_SEEDS, "pipelines": list(PIPELINES),
                "maps": list(MAPS)}
    if parser.parse_known_args()[0].grid:
        defaults.update(scenes=GRID_SCENES, sensors=GRID_SENSORS, imu_grades=IMU_GRADES, seeds=TEST_SEEDS[:1],
                        pipelines=["fast_lio"], maps=["nvm"])
    parser.set_defaults(**defaults)
    return parser.parse_args()


def run_sequence(arguments: argparse.Namespace, sequence: Sequence) -> None:
    cases = [(pipeline, map_name) for pipeline in arguments.pipelines for map_name in arguments.maps]
    with ThreadPoolExecutor(arguments.jobs) as pool:
        for line in pool.map(lambda case: measure(arguments, sequence, *case), cases):
            print(line, flush=True)
    if arguments.discard_sequences:
        sequence.discard_scans(arguments.out)


def write_results(arguments: argparse.Namespace) -> None:
    rows = [json.loads(path.read_text()) for path in sorted(arguments.out.glob("runs/*/*/*/row.json"))]
    (arguments.out / "figures.json").write_text(json.dumps(rows, indent=1) + "\n")
    study = grid if arguments.grid else report
    tables = report.markdown(study.all_tables(rows), rows)
    (arguments.out / "tables.md").write_text(tables)
    (arguments.out / "report.html").write_text(report.page(study.all_tables(rows), rows))
    if arguments.docs:
        replace_tables(arguments.docs, "grid" if arguments.grid else "ablation", tables)
    print(f"{arguments.out}: {len(rows)} rows in figures.json, report.html, tables.md")


def main() -> None:
    arguments = parse_arguments()
    arguments.out.mkdir(parents=True, exist_ok=True)
    places = itertools.product(arguments.scenes, arguments.sensors, arguments.imu_grades, arguments.setting, arguments.seeds)
    for scene, sensor, imu_grade, setting, seed in places:
        run_sequence(arguments, Sequence(scene, sensor, seed, setting, arguments.duration, imu_grade))
    write_results(arguments)


if __name__ == "__main__":
    main()
