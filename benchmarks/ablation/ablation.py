#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
# Copyright (c) 2026 The nvm authors
"""Runs every (sequence x pipeline x map), scores it, and writes tables.

    benchmarks/ablation/ablation.py                                   # all of it: hours
    benchmarks/ablation/ablation.py --scenes wall5 --pipelines fast_lio --maps nvm voxel
    benchmarks/ablation/ablation.py --setting noisy                   # 2 cm of range noise

A run that has been scored is not repeated: stop and resume as you like; delete its folder to repeat it. Results do not depend on
the order or the number of jobs; times do. Writes OUT/figures.json (a list of rows), OUT/report.html and OUT/tables.md, and with
--docs replaces the tables between the markers of a page.
"""
import argparse
import json
import sys
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

import report
from cases import MAPS, PIPELINES, SCENES, SENSORS, SETTINGS, TEST_SEEDS, Sequence, measure

BEGIN, END = "<!-- ablation: begin -->", "<!-- ablation: end -->"


def replace_tables(page: Path, tables: str) -> None:
    text = page.read_text()
    if text.count(BEGIN) != 1 or text.count(END) != 1:
        sys.exit(f"ablation: {page} needs the markers {BEGIN} and {END} once each")
    before, rest = text.split(BEGIN)
    page.write_text(before + BEGIN + "\n" + tables + END + rest.split(END)[1])


def parse_arguments() -> argparse.Namespace:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--program", type=Path, default=Path("build/release/bin/nvm"))
    parser.add_argument("--out", type=Path, default=Path("build/ablation"))
    parser.add_argument("--scenes", nargs="+", default=SCENES)
    parser.add_argument("--sensors", nargs="+", default=SENSORS, choices=SENSORS)
    parser.add_argument("--seeds", nargs="+", type=int, default=TEST_SEEDS)
    parser.add_argument("--setting", default="plain", choices=list(SETTINGS))
    parser.add_argument("--pipelines", nargs="+", default=list(PIPELINES), choices=list(PIPELINES))
    parser.add_argument("--maps", nargs="+", default=list(MAPS), choices=list(MAPS))
    parser.add_argument("--duration", type=float, default=0.0, help="[s]; 0: the whole route")
    parser.add_argument("--jobs", type=int, default=1, help="runs at once; more make times less certain")
    parser.add_argument("--discard-sequences", action="store_true", help="delete the scans once a sequence is done")
    parser.add_argument("--docs", type=Path, help="page whose tables to replace")
    return parser.parse_args()


def main() -> None:
    arguments = parse_arguments()
    arguments.out.mkdir(parents=True, exist_ok=True)
    for scene in arguments.scenes:
        for sensor in arguments.sensors:
            for seed in arguments.seeds:
                sequence = Sequence(scene, sensor, seed, arguments.setting, arguments.duration)
                cases = [(pipeline, map_name) for pipeline in arguments.pipelines for map_name in arguments.maps]
                with ThreadPoolExecutor(arguments.jobs) as pool:
                    for line in pool.map(lambda case: measure(arguments, sequence, *case), cases):
                        print(line, flush=True)
                if arguments.discard_sequences:
                    sequence.discard_scans(arguments.out)
    rows = [json.loads(path.read_text()) for path in sorted(arguments.out.glob("runs/*/*/*/row.json"))]
    (arguments.out / "figures.json").write_text(json.dumps(rows, indent=1) + "\n")
    tables = report.tables(rows)
    (arguments.out / "tables.md").write_text(tables)
    (arguments.out / "report.html").write_text(report.page(rows))
    if arguments.docs:
        replace_tables(arguments.docs, tables)
    print(f"{arguments.out}: {len(rows)} rows in figures.json, report.html, tables.md")


if __name__ == "__main__":
    main()
