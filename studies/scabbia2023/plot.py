#!/usr/bin/env python3
"""plot.py OUT: draws OUT/scabbia2023.png from OUT/results.csv and OUT/profiles.csv."""
import csv
import sys
from collections import defaultdict
from pathlib import Path

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
import numpy as np

INK = "#22303c"
TIMES = (0.05e-3, 0.10e-3, 0.15e-3, 0.20e-3)
ENDS = {"surface_nodes": ("surface nodes", "#c8553d", "s"), "odd": ("odd walls", "#3d6f8e", "o"),
        "zero_layer": ("zero layers", "#d9a441", "D"), "free": ("free (truncated)", "#8a6fae", "v")}
DOTS = {10: ("#d9a441", 3.4), 25: ("#7fb0a6", 2.6), 100: ("#c8553d", 1.4)}


def read_results(file):
    with open(file, newline="") as lines:
        return {(r["quantity"], r["body"], int(r["ratio"]), round(float(r["at"]), 9)): float(r["value"])
                for r in csv.DictReader(lines)}


def read_profiles(file):
    curves = defaultdict(list)
    with open(file, newline="") as lines:
        for r in csv.DictReader(lines):
            curves[r["curve"], round(float(r["time"]), 9)].append((float(r["x"]), float(r["u"])))
    return {key: np.array(points).T for key, points in curves.items()}


def waves(axes, profiles, time):
    """One panel of fig. 5: the classical wave, the peridynamic series, the lattice for three m."""
    scale = 1e3
    x, u = profiles["classical", time]
    axes.plot(x, scale * u, color="0.6", lw=1.2, ls="--", label="classical")
    x, u = profiles["series", time]
    axes.plot(x, scale * u, color=INK, lw=1.0, label="peridynamic series", zorder=3)
    for m, (colour, size) in DOTS.items():
        x, u = profiles[f"surface_nodes m={m}", time]
        axes.plot(x, scale * u, ls="", marker="o", ms=size, mec="none", color=colour, label=f"surface nodes, m = {m}")
    axes.set(title=f"t = {1e3 * time:.2f} ms", xlabel="x, m", ylabel="u, mm", xlim=(0, 1))


def errors(axes, results, suffix, names):
    for name in names:
        label, colour, marker = ENDS[name]
        points = sorted((key[2], value) for key, value in results.items()
                        if key[0] == "max_error" and key[1] == name + suffix and key[3] == TIMES[-1])
        m, error = np.array(points).T
        axes.loglog(m, error, color=colour, marker=marker, ms=5, lw=1.6, label=label)
    axes.set(xlabel="m = horizon / spacing", ylabel="max |u - series|, m")
    axes.set_xticks([10, 25, 50, 100, 200, 400, 800], ["10", "25", "50", "100", "200", "400", "800"])
    axes.minorticks_off()


def slope(axes, x, y, order, text):
    x = np.array(x)
    axes.plot(x, y * (x / x[0]) ** order, color="0.45", lw=1, ls="--", zorder=0)
    axes.annotate(text, (x[-1], y * (x[-1] / x[0]) ** order), xytext=(-4, -4), textcoords="offset points", color="0.35",
                  fontsize=9, ha="right", va="top")


def main(out):
    results, profiles = read_results(out / "results.csv"), read_profiles(out / "profiles.csv")
    figure, grid = plt.subplots(2, 4, figsize=(17, 8), layout="constrained")
    for axes, time in zip((grid[0, 0], grid[0, 1], grid[1, 0], grid[1, 1]), TIMES):
        waves(axes, profiles, time)
    grid[0, 1].legend(frameon=False, fontsize=9, loc="upper center", bbox_to_anchor=(0.5, 0.95), markerscale=1.6)

    errors(grid[0, 2], results, "", ENDS)
    slope(grid[0, 2], (25, 200), 5e-4, -1, "order 1")
    grid[0, 2].set_title("error at 0.2 ms")
    grid[0, 2].legend(frameon=False, fontsize=8, loc="lower left")
    errors(grid[0, 3], results, " self_cell fine", ("odd",))
    errors(grid[0, 3], results, " self_cell", ("surface_nodes",))
    slope(grid[0, 3], (25, 100), 1.4e-6, -2, "order 2")
    grid[0, 3].set_title("the same with the self-cell term")

    axes = grid[1, 2]
    for curve, time_marks in (("zero_layer", "--"), ("free", ":"), ("odd", "-")):
        label, colour, _ = ENDS[curve]
        x, u = profiles[f"{curve} m=100", TIMES[-1]]
        axes.plot(x, 1e3 * u, color=colour, lw=1.6, ls=time_marks, label=label)
    axes.set(title="t = 0.20 ms, m = 100, other ends", xlabel="x, m", ylabel="u, mm", xlim=(0, 1))
    axes.legend(frameon=False, fontsize=8)

    axes = grid[1, 3]
    for name, m, line in (("surface_nodes", 10, "-"), ("surface_nodes", 100, "-"), ("odd", 10, "--"), ("odd", 100, "--")):
        label, colour, marker = ENDS[name]
        points = sorted((1e3 * key[3], value) for key, value in results.items()
                        if key[0] == "max_error" and key[1] == name and key[2] == m and key[3] >= TIMES[-1])
        t, error = np.array(points).T
        axes.loglog(t, error, color=colour, ls=line, marker=marker, ms=4, lw=1.4, label=label if m == 10 else None)
        if name == "odd":
            continue
        axes.annotate(f"m = {m}", (t[0], error[0]), xytext=(0, 26), textcoords="offset points", color="0.35", fontsize=9)
    axes.set(title="long times: dispersion of the quadrature", xlabel="time, ms", ylabel="max |u - series|, m")
    axes.legend(frameon=False, fontsize=8, loc="lower right")

    for axes in grid.flat:
        axes.spines[["top", "right"]].set_visible(False)
        axes.grid(which="major", color="0.92", lw=0.8)
        axes.title.set_color(INK)
    figure.suptitle("A pulse in a peridynamic bar of horizon 0.1 m: surface nodes and other ends against separation of variables",
                    fontsize=13, color=INK)
    figure.savefig(out / "scabbia2023.png", dpi=110)


if __name__ == "__main__":
    if len(sys.argv) != 2:
        sys.exit("usage: plot.py OUT")
    main(Path(sys.argv[1]))
