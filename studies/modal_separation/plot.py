#!/usr/bin/env python3
"""plot.py OUT: draws OUT/separation.png from OUT/results.csv."""
import csv
import sys
from pathlib import Path

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
import numpy as np

HORIZON, RATIO, INK = 0.1, 10, "#22303c"
ENDS = {"odd": "odd walls", "odd-even": "odd and even wall", "surface_nodes": "surface nodes", "free": "free (truncated)",
        "zero_layer": "zero layers"}
COLOURS = {"odd": "#3d6f8e", "odd-even": "#7fb0a6", "surface_nodes": "#c8553d", "free": "#8a6fae", "zero_layer": "#d9a441"}
MARKERS = {"odd": "o", "odd-even": "^", "surface_nodes": "s", "free": "v", "zero_layer": "D"}


def read(file):
    with open(file, newline="") as lines:
        return {(r["quantity"], r["body"], round(float(r["horizon"]), 6), int(r["ratio"]), int(r["at"])):
                float(r["value"]) for r in csv.DictReader(lines)}


def against(results, quantity, body, axis, mode, horizon=HORIZON, ratio=RATIO):
    """Sorted (m, |value|) or (horizon, |value|) of one mode."""
    fixed = (2, horizon) if axis == 3 else (3, ratio)
    points = sorted((key[axis], abs(value)) for key, value in results.items()
                    if key[0] == quantity and key[1] == body and key[fixed[0]] == fixed[1] and key[4] == mode)
    return np.array(points).T


def slope(axes, x, y, order, text):
    """A line of the given order through (x[0], y), its name below it."""
    x = np.array(x)
    axes.plot(x, y * (x / x[0]) ** order, color="0.45", lw=1, ls="--", zorder=0)
    middle = np.sqrt(x[0] * x[1])
    axes.annotate(text, (middle, y * (middle / x[0]) ** order), xytext=(0, -14),
                  textcoords="offset points", color="0.35", fontsize=9, ha="right")


def convergence(axes, results, suffix, mode, title):
    for body, label in ENDS.items():
        m, error = against(results, "error", body + suffix, 3, mode)
        axes.loglog(m, error, color=COLOURS[body], marker=MARKERS[body], ms=5, lw=1.6, label=label)
    axes.set(xlabel="m = horizon / spacing", ylabel="|frequency / exact - 1|", title=title)
    axes.set_xticks([5, 10, 25, 50, 100], ["5", "10", "25", "50", "100"])
    axes.minorticks_off()


def main(out):
    results = read(out / "results.csv")
    figure, grid = plt.subplots(2, 3, figsize=(15, 8.8), layout="constrained")
    convergence(grid[0, 0], results, "", 1, "mode 1")
    convergence(grid[0, 1], results, "", 10, "mode 10")
    convergence(grid[0, 2], results, " self_cell", 1, "mode 1, with the self-cell term")
    slope(grid[0, 0], [25, 100], 7.0e-3, -1, "order 1")
    slope(grid[0, 2], [10, 50], 7.0e-7, -2, "order 2")
    grid[0, 0].legend(loc="lower left", frameon=False, fontsize=9)

    modes = np.arange(1, 21)
    for m, shade in zip((5, 10, 25, 50, 100), plt.cm.viridis(np.linspace(0.05, 0.85, 5))):
        bias = [results.get(("bias", "surface_nodes", HORIZON, m, n), np.nan) for n in modes]
        grid[1, 0].semilogy(modes, bias, color=shade, marker=".", lw=1.4, label=f"m = {m}")
    grid[1, 0].set(xlabel="mode", ylabel="surface nodes / odd walls - 1", title="What surface nodes keep, however fine the grid",
                   xticks=[1, 5, 10, 15, 20])
    grid[1, 0].legend(frameon=False, fontsize=9)

    for body in ENDS:
        x, error = against(results, "error", body + " self_cell", 2, 1)
        grid[1, 1].loglog(x, error, color=COLOURS[body], marker=MARKERS[body], ms=5, lw=1.6)
    x, classical = against(results, "classical_error", "odd self_cell", 2, 1)
    grid[1, 1].loglog(x, classical, color=INK, lw=1.6, ls=":")
    grid[1, 1].annotate("odd walls against classical", (x[0], classical[0]), xytext=(4, 14), textcoords="offset points",
                        fontsize=9, color=INK, rotation=15)
    grid[1, 1].set(xlabel="horizon, m", ylabel="|frequency / exact - 1|", title=f"mode 1 at fixed m = {RATIO}, with the self-cell term")
    grid[1, 1].set_xticks(x, [f"{v:g}" for v in x])
    grid[1, 1].minorticks_off()

    for kernel, colour in (("constant", "#3d6f8e"), ("gaussian", "#c8553d")):
        for branch, line in (("S", "-"), ("P", "--")):
            m, error = against(results, "error", f"mirror {kernel} {branch}", 3, 1, horizon=0.09375)
            grid[1, 2].loglog(m, error, color=colour, ls=line, marker="o", ms=5, lw=1.6, label=f"{kernel}, {branch}")
    grid[1, 2].set(xlabel="m = horizon / spacing", ylabel="|frequency / continuum - 1|", title="mirror plate, waves (1, 1)")
    grid[1, 2].set_xticks([3, 6, 9, 12], ["3", "6", "9", "12"])
    grid[1, 2].minorticks_off()
    grid[1, 2].legend(frameon=False, fontsize=9)

    for axes in grid.flat:
        axes.spines[["top", "right"]].set_visible(False)
        axes.grid(which="major", color="0.92", lw=0.8)
        axes.title.set_color(INK)
    figure.suptitle(f"Eigenfrequencies against separation of variables (bars: horizon {HORIZON} m, inverse-distance kernel)",
                    fontsize=13, color=INK)
    figure.savefig(out / "separation.png", dpi=120)


if __name__ == "__main__":
    if len(sys.argv) != 2:
        sys.exit("usage: plot.py OUT")
    main(Path(sys.argv[1]))
