#!/usr/bin/env python3
"""plot.py OUT: draws OUT/bouaraquia2024.png from OUT/results.csv and OUT/histories.csv."""
import csv
import sys
from collections import defaultdict
from pathlib import Path

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
import numpy as np

INK = "#22303c"
KERNELS = {"constant": ("constant", "#3d6f8e"), "gaussian2": ("Gaussian, p = 2", "#c8553d")}
RULES = {"corrected": "volume correction of eq. (36), as in fig. 12", "uncorrected": "no volume correction",
         "normalised": "normalised: the family exact for uniform strain"}
ENDS = {"odd/even": "odd wall, even wall", "odd/free": "odd wall, free", "surface_nodes/free": "surface nodes, free",
        "zero_layer/free": "zero layer, free"}


def read_results(file):
    with open(file, newline="") as lines:
        return {(r["quantity"], r["body"], round(float(r["horizon"]), 9), round(float(r["at"]), 9)): float(r["value"])
                for r in csv.DictReader(lines)}


def read_histories(file):
    curves = defaultdict(list)
    with open(file, newline="") as lines:
        for r in csv.DictReader(lines):
            curves[r["curve"]].append((1e3 * float(r["time"]), float(r["strain"])))
    return {name: np.array(points).T for name, points in curves.items()}


def history(axes, histories, rule, rate):
    t, exact = histories["exact"]
    axes.plot(t, exact, color=INK, lw=1.2, label="exact (classical)", zorder=3)
    for kernel, (label, colour) in KERNELS.items():
        t, strain = histories[f"{kernel} {rule} odd/even m=5 N=800"]
        axes.plot(t, strain, color=colour, lw=0.9, label=f"{label}: L2 error {rate(kernel):.3f}")
    axes.set(title=RULES[rule], xlabel="time, ms", ylabel="strain at x = 1/2, / e0", xlim=(0, t[-1]), ylim=(-1.55, 1.75))
    axes.legend(frameon=False, fontsize=7.5, loc="upper left", ncols=3, columnspacing=0.8, handlelength=1.2)


def bars(axes, values, title):
    """Groups of bars: {group: {kernel: value}}."""
    for place, (group, of_kernel) in enumerate(values.items()):
        for offset, (kernel, value) in zip((-0.2, 0.2), of_kernel.items()):
            axes.bar(place + offset, value, 0.36, color=KERNELS[kernel][1])
            axes.annotate(f"{value:.3f}", (place + offset, value), xytext=(0, 3), textcoords="offset points", ha="center",
                          fontsize=8, color=INK)
    axes.set_xticks(range(len(values)), list(values), fontsize=8)
    axes.set(title=title, ylabel="relative L2 error over a period")


def main(out):
    results, histories = read_results(out / "results.csv"), read_histories(out / "histories.csv")

    def l2(kernel, rule, ends="odd/even", horizon=0.00625):
        return results["l2_error", f"{kernel} {rule} {ends}", horizon, 1.0]

    figure, grid = plt.subplots(2, 3, figsize=(17, 8.4), layout="constrained")
    for axes, rule in zip(grid[0], RULES):
        history(axes, histories, rule, lambda kernel, rule=rule: l2(kernel, rule))
    axes = grid[1, 0]
    history(axes, histories, "corrected", lambda kernel: l2(kernel, "corrected"))
    axes.set(title="the first panel near the first two jumps", xlim=(0.07, 0.33), ylim=(-1.4, 1.4))
    axes.get_legend().remove()
    bars(grid[1, 1], {"corrected": {k: l2(k, "corrected") for k in KERNELS},
                      "uncorrected": {k: l2(k, "uncorrected") for k in KERNELS},
                      "normalised": {k: l2(k, "normalised") for k in KERNELS}},
         "which kernel is better depends on the sum")
    bars(grid[1, 2], {label: {k: l2(k, "corrected", ends) for k in KERNELS} for ends, label in ENDS.items()},
         "ends of the bar (volume correction)")
    grid[1, 2].set_ylim(0, 0.32)
    for axes in grid.flat:
        axes.spines[["top", "right"]].set_visible(False)
        axes.grid(which="major", color="0.92", lw=0.8, axis="both")
        axes.set_axisbelow(True)
        axes.title.set_color(INK)
    figure.suptitle("A steel bar let go from a uniform strain: 800 cells, horizon of 5 cells (fig. 12)", fontsize=13, color=INK)
    figure.savefig(out / "bouaraquia2024.png", dpi=110)


if __name__ == "__main__":
    if len(sys.argv) != 2:
        sys.exit("usage: plot.py OUT")
    main(Path(sys.argv[1]))
