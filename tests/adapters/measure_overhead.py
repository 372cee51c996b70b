#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
# Copyright (c) 2026 The nvm authors
"""measure_overhead.py PROGRAM: instructions per point of each adapter and of the map's own calls.

PROGRAM is the built target nvm_adapters_overhead. Needs valgrind. Instruction counts do not depend
on what else the machine does.
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
        command = ["valgrind", "--tool=callgrind", "--callgrind-out-file=/dev/null", program, work]
        run = subprocess.run(command, capture_output=True, text=True, check=True)
        cache[work] = int(re.search(r"Collected : (\d+)", run.stderr).group(1))
    return cache[work]


def main():
    if len(sys.argv) != 2:
        sys.exit(__doc__)
    print("| adapter | instructions per point | the map's own calls | overhead |")
    print("|---|---|---|---|")
    for adapter, core, base in COMPARED:
        setup = instructions(sys.argv[1], base)
        ours = (instructions(sys.argv[1], adapter) - setup) / POINTS
        own = (instructions(sys.argv[1], core) - setup) / POINTS
        print(f"| {adapter} | {ours:.0f} | {own:.0f} | {100 * (ours / own - 1):+.1f} % |", flush=True)


if __name__ == "__main__":
    main()
