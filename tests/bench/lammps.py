#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Explicit steps of one block on one core: LAMMPS (peri/pmb, pmb.lmp beside this file) and Perimode.

    tests/bench/lammps.py [--benches build/release/tests/bench] [--lmp lmp] [--repeats 3]

Prints particle-steps per second of processor time (the best of the repeats, the programs taking turns; set-up
left out) and the largest resident memory of each program, and the ratio to LAMMPS.
"""
import argparse
import json
import os
import pathlib
import re
import subprocess
import sys
import tempfile

CELLS = 47
# Rows of the table: what they say, the program and the benchmark they run.
ROWS = [
    ("Perimode, linear, stencil", "bench_transient", f"block/3D/{CELLS}/1"),
    ("Perimode, linear, breaking", "bench_bond_forces", f"linear/3D/{CELLS}/1"),
    ("Perimode, large rotation, breaking", "bench_bond_forces", f"elastic/3D/{CELLS}/1"),
    ("  the same, energies every step", "bench_bond_forces", f"history/3D/{CELLS}/1"),
]


def run(command, core):
    """Output, processor seconds and MiB of a program on one core."""
    environment = dict(os.environ, OMP_NUM_THREADS="1")
    with tempfile.TemporaryFile("w+") as output:
        process = subprocess.Popen(command, stdout=output, stderr=subprocess.STDOUT, env=environment,
                                   preexec_fn=lambda: os.sched_setaffinity(0, {core}))
        _, status, usage = os.wait4(process.pid, 0)
        process.returncode = os.waitstatus_to_exitcode(status)
        output.seek(0)
        text = output.read()
    if process.returncode != 0:
        sys.exit(f"{' '.join(map(str, command))} failed:\n{text[-2000:]}")
    return text, usage.ru_utime + usage.ru_stime, usage.ru_maxrss / 1024.0


def lammps(program, steps, core):
    """Particle-steps per processor second from two runs, one longer than the other, and MiB."""
    script = pathlib.Path(__file__).resolve().parent / "pmb.lmp"
    seconds, memory, atoms = [], 0.0, 0
    for count in (10, 10 + steps):
        text, used, mib = run([program, "-in", script, "-log", "none", "-var", "nx", str(CELLS),
                               "-var", "steps", str(count)], core)
        atoms = int(re.search(r"Loop time of .* with (\d+) atoms", text).group(1))
        seconds.append(used)
        memory = max(memory, mib)
    if atoms != CELLS**3:
        sys.exit(f"LAMMPS made {atoms} particles, not {CELLS**3}")
    return atoms * steps / (seconds[1] - seconds[0]), memory


def perimode(program, name, core):
    """Particle-steps per processor second of a benchmark, and MiB."""
    with tempfile.TemporaryDirectory() as folder:
        result = pathlib.Path(folder) / "result.json"
        _, _, mib = run([program, f"--benchmark_filter=^{name}$", "--benchmark_min_time=1",
                         f"--benchmark_out={result}"], core)
        found = json.loads(result.read_text())["benchmarks"]
    if len(found) != 1:
        sys.exit(f"no benchmark {name}")
    return 1e6 * found[0]["Mparticles/s"], mib


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--benches", type=pathlib.Path, default=pathlib.Path("build/release/tests/bench"),
                        help="folder of the benchmarks")
    parser.add_argument("--lmp", default="lmp", help="the program LAMMPS")
    parser.add_argument("--repeats", type=int, default=3)
    parser.add_argument("--steps", type=int, default=60, help="of LAMMPS, timed")
    parser.add_argument("--core", type=int, default=min(os.sched_getaffinity(0)))
    arguments = parser.parse_args()

    names = ["LAMMPS, peri/pmb", *(row[0] for row in ROWS)]
    rate, memory = [0.0] * len(names), [0.0] * len(names)
    for _ in range(arguments.repeats):
        figures = [lammps(arguments.lmp, arguments.steps, arguments.core),
                   *(perimode(arguments.benches / row[1], row[2], arguments.core) for row in ROWS)]
        for k, (particle_steps, mib) in enumerate(figures):
            rate[k] = max(rate[k], particle_steps)
            memory[k] = max(memory[k], mib)
    print(f"{CELLS}^3 particles, horizon 3.01 spacings, one core, best of {arguments.repeats}")
    print(f"{'':36}{'M particle-steps/CPU s':>24}{'x LAMMPS':>10}{'MiB':>8}")
    for name, particle_steps, mib in zip(names, rate, memory):
        print(f"{name:36}{1e-6 * particle_steps:>24.2f}{particle_steps / rate[0]:>10.1f}{mib:>8.0f}")


if __name__ == "__main__":
    main()
