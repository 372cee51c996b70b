#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
# Copyright (c) 2026 The nvm authors
"""measure_overhead.py PROGRAM: what each adapter costs beside the map's own calls.

PROGRAM is the built target nvm_adapters_overhead. Instructions are counted by valgrind and do not
depend on what else the machine does; times do, though a little.
"""
import re
import subprocess
import sys

POINTS = 20000
# adapter's work, the map's own for the same, the work that both contain
COMPARED = [
    ("query_ikd_tree", "query_core_5", "filled"),
    ("query_ivox", "query_core_5", "filled"),
    ("query_kiss_icp", "query_core_1", "filled"),
    ("query_small_gicp", "query_core_1", "filled"),
    ("query_ct_lio", "query_core_20", "filled"),
    ("query_ct_lio_ring_2", "query_core_20", "filled"),
    ("insert_ikd_tree", "insert_core", "empty"),
    ("insert_ivox", "insert_core", "empty"),
    ("insert_kiss_icp", "insert_core_eigen", "empty"),
    ("insert_ct_lio", "insert_core_eigen", "empty"),
]


def instructions(program, work, cache={}):
    if work not in cache:
        command = ["valgrind", "--tool=callgrind", "--callgrind-out-file=/dev/null", program, *work]
        run = subprocess.run(command, capture_output=True, text=True, check=True)
        cache[work] = int(re.search(r"Collected : (\d+)", run.stderr).group(1))
    return cache[work]


def measured_times(program, normals):
    run = subprocess.run([program, "time", *normals], capture_output=True, text=True, check=True)
    return {name: float(ns) for name, ns in (line.split() for line in run.stdout.splitlines())}


def compare(ours, own, unit):
    return f"{ours:.0f}, {own:.0f}{unit}: {100 * (ours / own - 1):+.1f} %"


def main():
    if len(sys.argv) != 2:
        sys.exit(__doc__)
    program = sys.argv[1]
    print("| adapter | instructions per point: adapter, the map's own | time |")
    print("|---|---|---|")
    for normals in ((), ("ungated",)):
        times = measured_times(program, normals)
        for adapter, core, base in COMPARED:
            if normals and not adapter.startswith("query"):
                continue
            setup = instructions(program, (base, *normals))
            ours, own = (
                (instructions(program, (work, *normals)) - setup) / POINTS
                for work in (adapter, core)
            )
            time = compare(times[adapter], times[core], " ns") if adapter in times else ""
            name = " ".join((adapter, *normals))
            print(f"| {name} | {compare(ours, own, '')} | {time} |", flush=True)


if __name__ == "__main__":
    main()
