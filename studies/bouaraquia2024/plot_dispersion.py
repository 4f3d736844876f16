#!/usr/bin/env python3
"""plot_dispersion.py OUT: draws OUT/bouaraquia2024_dispersion.png from OUT/waves.csv, shapes.csv and dispersion.csv."""
import csv
import sys
from collections import defaultdict
from pathlib import Path

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
import numpy as np
from matplotlib.lines import Line2D

INK, FAINT = "#22303c", "0.55"
KERNELS = {"constant": ("constant", "#3d6f8e"), "gaussian1": ("Gaussian, p = 1", "#d9a441"),
           "gaussian2": ("Gaussian, p = 2", "#c8553d"), "gaussian3": ("Gaussian, p = 3", "#7a5195")}
SERIES = ["#c8553d", "#d9a441", "#4f9d69", "#3d6f8e"]  # coarse to fine
SUMS = {"uncorrected": "sum as printed, eqs. (49), (50)", "corrected": "sum with eq. (36)"}
COLUMNS = ["gaussian1", "gaussian2", "constant"]


def read_curves(file):
    """{(figure, kernel, sum, ratio, spacing in mm): (k, omega)}"""
    curves = defaultdict(list)
    with open(file, newline="") as lines:
        for r in csv.DictReader(lines):
            key = int(r["figure"]), r["kernel"], r["sum"], int(r["ratio"]), round(1e3 * float(r["spacing"]), 4)
            curves[key].append((float(r["k"]), float(r["omega"])))
    return {key: np.array(points).T for key, points in curves.items()}


def read_long_waves(file):
    with open(file, newline="") as lines:
        return {(r["body"], int(r["ratio"]), round(1e3 * float(r["horizon"]), 4)): float(r["value"])
                for r in csv.DictReader(lines) if r["quantity"] == "long_wave"}


def draw(axes, k, omega, spacing, **style):
    """A lattice's curve: full up to the zone's end pi/spacing, marked by a dot, faint beyond, where waves are aliases."""
    end = 1e3 * np.pi / spacing
    inside, beyond = k <= end, k >= end
    axes.plot(k[inside], omega[inside], lw=1.5, **style)
    style.pop("label", None)
    axes.plot(k[beyond], omega[beyond], lw=1.1, ls=(0, (1, 1.4)), **style)
    if beyond.any():
        axes.plot(end, np.interp(end, k, omega), marker="o", ms=5, **style)


def frame(axes, title, top):
    axes.plot([0, 2500], [0, 2500], color=INK, lw=1.0, ls="--", label="classical", zorder=1)
    axes.set(title=title, xlabel="k, rad/m", ylabel="ω/v, rad/m", xlim=(0, 2500), ylim=(0, top),
             yticks=range(0, top + 1, top // 5))


def legend(axes, **options):
    axes.legend(**{"frameon": False, "fontsize": 9, "loc": "upper left", "handlelength": 1.6, "labelspacing": 0.3, **options})


def spacings(axes, curves, figure, kernel, rule):
    found = sorted((key for key in curves if key[:3] == (figure, kernel, rule)), key=lambda key: -key[4])
    frame(axes, f"fig. {figure}: {KERNELS[kernel][0]}, m = 3\n{SUMS[rule]}", 2500)
    for key, colour in zip(found, SERIES):
        draw(axes, *curves[key], key[4], color=colour, label=f"Δx = {key[4]:g} mm")
    if figure == 6:
        k, omega = curves[6, "differences", "C=0.5", 1, 2.0]
        draw(axes, k, omega, 2.0, color=FAINT, label="FD, Δx = 2 mm, C = 0.5")
    legend(axes)


def ratios(axes, curves, figure, kernel, rule):
    found = sorted((key for key in curves if key[:3] == (figure, kernel, rule)), key=lambda key: key[3])
    frame(axes, f"fig. {figure}: {KERNELS[kernel][0]}, δ = 4 mm\n{SUMS[rule]}", 1500)
    for key, colour in zip(found, SERIES):
        draw(axes, *curves[key], key[4], color=colour, label=f"m = {key[3]}")
    k, omega = curves[figure, kernel, "continuum", 0, 0.0]
    axes.plot(k, omega, color=INK, lw=2.2, alpha=0.45, label="nonlocal continuum", zorder=1)
    legend(axes, loc="lower right", ncols=2)


def shapes(axes, file):
    curves = defaultdict(list)
    with open(file, newline="") as lines:
        for r in csv.DictReader(lines):
            curves[r["kernel"]].append((float(r["r"]), float(r["shape"])))
    for kernel, (label, colour) in KERNELS.items():
        r, g = np.array(curves[kernel]).T
        axes.plot(np.r_[-r[::-1], r], np.r_[g[::-1], g], color=colour, lw=1.6, label=label)
        axes.plot([-1, -1, np.nan, 1, 1], [0, g[-1], np.nan, g[-1], 0], color=colour, lw=0.8, ls=":")
    axes.set(title="fig. 2: micromodulus\nc(ξ)/c0", xlabel="ξ/δ", xlim=(-1.25, 1.25), ylim=(0, 1.45))
    legend(axes, ncols=2)


def kernels(axes, curves):
    frame(axes, "fig. 10: kernels\nm = 10, δ = 4 mm", 1500)
    for kernel in ("constant", "gaussian1", "gaussian2"):
        label, colour = KERNELS[kernel]
        for rule, style in (("corrected", "-"), ("uncorrected", (0, (4, 2)))):
            k, omega = curves[10, kernel, rule, 10, 0.4]
            axes.plot(k, omega, color=colour, lw=1.4, ls=style, label=label if style == "-" else None)
    handles = axes.get_legend_handles_labels()[0]
    handles.append(Line2D([], [], color=FAINT, ls="-", label="with eq. (36)"))
    handles.append(Line2D([], [], color=FAINT, ls=(0, (4, 2)), label="as printed"))
    legend(axes, handles=handles, ncols=2, loc="lower right")


def speeds(axes, curves, long_waves):
    """Phase speed of the lattices of figs. 4 to 6, whatever their spacing, over k delta."""
    styles = {"uncorrected": ((0, (4, 2)), "as printed"), "corrected": ("-", "with eq. (36)"), "normalised": ((0, (1, 1.2)), "normalised")}
    for figure, kernel in ((6, "constant"), (5, "gaussian2")):
        for rule, (style, label) in styles.items():
            if kernel == "constant" and rule == "normalised":
                continue  # the same as with eq. (36)
            k, omega = curves[figure, kernel, rule, 3, 1.0]
            x = np.r_[0.0, 0.003 * k]
            y = np.r_[long_waves[f"{kernel} {rule}", 3, 3.0], omega / k]
            axes.plot(x, y, color=KERNELS[kernel][1], ls=style, lw=1.6, label=f"{KERNELS[kernel][0]}, {label}")
    axes.axhline(1.0, color=INK, lw=1.0, ls="--")
    axes.axhspan(0.95, 1.05, color="0.93", zorder=0)
    axes.annotate("within 5 %", (2.95, 1.035), ha="right", fontsize=9, color=FAINT)
    axes.set(title="phase speed at m = 3:\nrefined at fixed m, every wave moves to k δ = 0", xlabel="k δ", ylabel="ω/(v k)", xlim=(0, 3),
             ylim=(0.6, 1.2))
    legend(axes, loc="lower left")


def main(out):
    curves, long_waves = read_curves(out / "dispersion.csv"), read_long_waves(out / "waves.csv")
    figure, grid = plt.subplots(5, 3, figsize=(16, 23), layout="constrained")
    for column, kernel in enumerate(COLUMNS):
        for row, rule in enumerate(SUMS):
            spacings(grid[row, column], curves, 4 + column, kernel, rule)
            ratios(grid[row + 2, column], curves, 7 + column, kernel, rule)
    shapes(grid[4, 0], out / "shapes.csv")
    kernels(grid[4, 1], curves)
    speeds(grid[4, 2], curves, long_waves)
    for axes in grid.flat:
        axes.spines[["top", "right"]].set_visible(False)
        axes.grid(color="0.92", lw=0.8)
        axes.set_axisbelow(True)
        axes.title.set(color=INK, fontsize=11.5)
    figure.suptitle("Waves in a bar: figs. 2 and 4 to 10 of [bouaraquia2024]\n"
                    "dots: end of the zone, k = π/Δx; dotted beyond it: aliases of waves within", fontsize=14, color=INK)
    figure.savefig(out / "bouaraquia2024_dispersion.png", dpi=90)


if __name__ == "__main__":
    if len(sys.argv) != 2:
        sys.exit("usage: plot_dispersion.py OUT")
    main(Path(sys.argv[1]))
