#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
# Copyright (c) 2026 The nvm authors
"""Runs the micro-benchmarks and writes what they say.

    benchmarks/run.py [--build build/bench] [--repetitions 5] [--filter REGEX]

Repetitions of all benchmarks are interleaved, so that a machine that is slower for a while is slower for all of them; medians and
the spread are over the repetitions, in CPU time. Writes BUILD/report.md and BUILD/figures.json.
"""
import argparse
import json
import os
import platform
import re
import shutil
import statistics
import subprocess
import sys
from collections import defaultdict
from pathlib import Path


def run_benchmark(program: Path, repetitions: int, pattern: str) -> dict:
    """Name -> list of one record per repetition."""
    out = program.parent / f"{program.name}.json"
    subprocess.run(
        [program, f"--benchmark_repetitions={repetitions}", "--benchmark_enable_random_interleaving=true",
         "--benchmark_min_time=0.2", f"--benchmark_filter={pattern}", f"--benchmark_out={out}",
         "--benchmark_out_format=json"],
        check=True, stdout=subprocess.DEVNULL)
    records = defaultdict(list)
    for record in json.loads(out.read_text())["benchmarks"]:
        if record.get("run_type") == "iteration":
            records[record["name"].split("/iterations:")[0]].append(record)
    return records


def median(records: list, counter: str = "cpu_time"):
    return statistics.median(record[counter] for record in records) if records else None


def ratio(records: dict, rival: str, ours: str, counter: str = "cpu_time"):
    a, b = median(records.get(rival, []), counter), median(records.get(ours, []), counter)
    return a / b if a is not None and b else None


def difference(records: dict, costly: str, cheap: str, counter: str):
    a, b = median(records.get(costly, []), counter), median(records.get(cheap, []), counter)
    return a - b if a is not None and b is not None else None


def count_instructions(program: Path):
    """Per gated query of 5 neighbours; nothing where valgrind is missing."""
    if not shutil.which("valgrind") or not program.exists():
        return None
    run = subprocess.run(
        ["valgrind", "--tool=callgrind", f"--callgrind-out-file={program}.callgrind",
         "--toggle-collect=nvm_probe_queries*", program], capture_output=True, text=True, check=False)
    collected = re.search(r"Collected : (\d+)", run.stderr)
    queries = re.search(r"queries (\d+)", run.stdout)
    return int(collected[1]) / int(queries[1]) if collected and queries else None


def plain_flags_ratios(folder: Path, repetitions: int) -> dict:
    """Time with -O2 -march=native / time with -O2 alone: 1 is as fast without as with the machine's flags."""
    programs = {flags: folder / f"nvm_flags_probe_{flags}" for flags in ("plain", "native")}
    if not all(program.exists() for program in programs.values()):
        return {}
    runs = defaultdict(list)
    for _ in range(repetitions):
        for flags, program in programs.items():
            runs[flags].append(json.loads(subprocess.run([program], capture_output=True, text=True, check=True).stdout))
    return {f"{key}_plain_flags_ratio": statistics.median(run[key] for run in runs["native"])
            / statistics.median(run[key] for run in runs["plain"]) for key in runs["plain"][0]}


def include_ratios(repetitions: int) -> dict:
    """What the compiler takes for a file that only includes nvm / for one that only includes Eigen/Dense: least CPU time, and memory."""
    runs = defaultdict(list)
    for _ in range(repetitions):
        for name, header in (("eigen", "Eigen/Dense"), ("nvm", "nvm/nvm.hpp"), ("map", "nvm/map/voxel_map.hpp")):
            compiler = subprocess.Popen(["c++", "-std=c++17", "-O2", "-fsyntax-only", "-Iinclude", "-I/usr/include/eigen3", "-xc++", "-"],
                                        stdin=subprocess.PIPE)
            compiler.stdin.write(f"#include <{header}>\n".encode())
            compiler.stdin.close()
            _, compiler.returncode, usage = os.wait4(compiler.pid, 0)
            runs[name].append((usage.ru_utime + usage.ru_stime, usage.ru_maxrss))
    least = {name: [min(values) for values in zip(*pairs)] for name, pairs in runs.items()}
    return {"include_ratio_eigen": least["nvm"][0] / least["eigen"][0],
            "include_memory_ratio_eigen": least["nvm"][1] / least["eigen"][1],
            "map_include_ratio_eigen": least["map"][0] / least["eigen"][0],
            "map_include_memory_ratio_eigen": least["map"][1] / least["eigen"][1]}


def figures(records: dict, instructions) -> dict:
    scan_order, per_point = "/0", "ns_per_point"
    return {
        "query5_gated_ns": median(records.get(f"nearest<Nvm>/5{scan_order}", [])),
        "query5_gated_instructions": instructions,
        "query5_ratio_kiss": ratio(records, f"nearest<KissStyle>/5{scan_order}", f"nearest<Nvm>/5{scan_order}"),
        "query5_ratio_small_gicp": ratio(records, f"nearest<SmallGicp>/5{scan_order}", f"nearest<Nvm>/5{scan_order}"),
        "query20_ratio_kiss": ratio(records, f"nearest<KissStyle>/20{scan_order}", f"nearest<Nvm>/20{scan_order}"),
        "insert_raw_ratio_kiss": ratio(records, "insert_raw<KissStyle>", "insert_raw<Nvm>", per_point),
        "insert_new_ratio_kiss": ratio(records, "insert_new<KissStyle>", "insert_new<Nvm>", per_point),
        "insert_worst_scan_ms": median(records.get("grow<Nvm>/10000000", []), "worst_patch_ms"),
        "bytes_per_point": median(records.get("memory", []), "bytes_per_point"),
        "normals_radius_ratio_pcl": ratio(records, "pcl_baseline/scan:0", "estimate/fixed_block_tree/scan:0"),
        "normals_adaptive_ratio_nanoflann": ratio(records, "nanoflann_baseline/adaptive/scan:0", "estimate/adaptive_block_tree/scan:0"),
        "query_growth_1e4_1e7": ratio(records, "grow<Nvm>/10000000", "grow<Nvm>/10000", "query5_ns"),
        "query_growth_shuffled_1e4_1e7": ratio(records, "grow<Nvm>/10000000", "grow<Nvm>/10000", "query5_shuffled_ns"),
        "query20_ratio_small_gicp": ratio(records, f"nearest<SmallGicp>/20{scan_order}", f"nearest<Nvm>/20{scan_order}"),
        "eviction_ns_per_point": difference(records, "walk_on/20000", "walk_on/4000000", per_point),
    }


def table(records: dict) -> str:
    lines = ["| benchmark | median CPU | min | max | counters |", "|---|---|---|---|---|"]
    for name, runs in sorted(records.items()):
        times = [run["cpu_time"] for run in runs]
        known = {"name", "run_name", "run_type", "repetitions", "repetition_index", "threads", "iterations", "real_time",
                 "cpu_time", "time_unit", "family_index", "per_family_instance_index", "aggregate_name"}
        counters = ", ".join(f"{key} {median(runs, key):.4g}" for key in runs[0] if key not in known)
        unit = runs[0]["time_unit"]
        lines.append(f"| {name} | {statistics.median(times):.4g} {unit} | {min(times):.4g} | {max(times):.4g} | {counters} |")
    return "\n".join(lines)


def machine() -> str:
    cpu = next((line.split(":")[1].strip() for line in Path("/proc/cpuinfo").read_text().splitlines()
                if line.startswith("model name")), platform.processor())
    compiler = subprocess.run(["c++", "--version"], capture_output=True, text=True, check=False).stdout.split("\n")[0]
    commit = subprocess.run(["git", "rev-parse", "--short", "HEAD"], capture_output=True, text=True, check=False).stdout.strip()
    return f"{cpu}; {compiler}; preset bench (-O3 -march=native); commit {commit}"


def main() -> int:
    arguments = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    arguments.add_argument("--build", type=Path, default=Path("build/bench"))
    arguments.add_argument("--repetitions", type=int, default=5)
    arguments.add_argument("--filter", default=".")
    options = arguments.parse_args()

    records = {}
    for name in ("nvm_map_benchmark", "nvm_normals_benchmark"):
        program = options.build / "benchmarks" / name
        if program.exists():
            records.update(run_benchmark(program, options.repetitions, options.filter))
        else:
            print(f"run.py: {program} is not built: skipped", file=sys.stderr)
    instructions = count_instructions(options.build / "benchmarks" / "nvm_query_probe")
    values = (figures(records, instructions) | plain_flags_ratios(options.build / "benchmarks", options.repetitions)
              | include_ratios(options.repetitions))
    (options.build / "figures.json").write_text(json.dumps(values, indent=2) + "\n")
    summary = "\n".join(f"| {key} | {'not measured' if value is None else f'{value:.4g}'} |" for key, value in values.items())
    report = f"{machine()}\n\n| figure | value |\n|---|---|\n{summary}\n\n{table(records)}\n"
    (options.build / "report.md").write_text(report)
    print(report)
    return 0


if __name__ == "__main__":
    sys.exit(main())
