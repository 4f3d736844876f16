#!/usr/bin/env python3
"""plot.py OUT: draws OUT/ganzenmueller2013.png from OUT/results.csv and OUT/profiles.csv."""
import csv
import sys
from collections import defaultdict
from pathlib import Path

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
import numpy as np

INK, ORIGINAL, NORMALISED = "#22303c", "#d9a441", "#3d6f8e"
WIDTH, CLOUD_WIDTH, TRAVEL = 0.03, 0.1, 0.7


def read_results(file):
    with open(file, newline="") as lines:
        return {(r["quantity"], r["body"], int(r["ratio"]), float(r["at"])): float(r["value"]) for r in csv.DictReader(lines)}


def read_profiles(file):
    curves = defaultdict(list)
    with open(file, newline="") as lines:
        for r in csv.DictReader(lines):
            curves[r["curve"]].append((float(r["x"]), float(r["u"])))
    return {name: np.array(points).T for name, points in curves.items()}


def theory(axes, width):
    x = np.linspace(0.0, 1.0, 801)
    axes.plot(x, 0.5 * np.exp(-((x - TRAVEL) / width) ** 2), color=INK, lw=1.2, ls="--", label="classical")
    axes.axvline(TRAVEL, color="0.75", lw=1, ls="--", zorder=0)


def by_ratio(results, quantity, body, at=0.0):
    points = sorted((np.sqrt(key[2]), value) for key, value in results.items()
                    if key[0] == quantity and key[1] == body and key[3] == at)
    return np.array(points).T


def main(out):
    results, profiles = read_results(out / "results.csv"), read_profiles(out / "profiles.csv")
    figure, grid = plt.subplots(2, 3, figsize=(17, 8.4), layout="constrained")

    axes = grid[0, 0]
    x, error = profiles["energy original"]
    axes.plot(x, 100 * error, color=ORIGINAL, lw=1.2, label="original")
    m, error = by_ratio(results, "energy_error", "original")
    axes.plot(m, 100 * error, color=ORIGINAL, ls="", marker="o", ms=5, mec=INK)
    m, error = by_ratio(results, "energy_error", "normalised")
    axes.plot(m, 100 * error, color=NORMALISED, marker="s", ms=5, lw=1.4,
              label=f"normalised, at most {np.abs(error).max():.0e}")
    axes.set(title="strain energy of pure dilation", xlabel="horizon / spacing", ylabel="error, %")
    axes.legend(frameon=False, fontsize=9)

    axes = grid[0, 1]
    for body, colour, marker in (("original", ORIGINAL, "o"), ("normalised", NORMALISED, "s")):
        m, speed = by_ratio(results, "speed", body)
        axes.plot(m, 100 * (speed - 1), color=colour, marker=marker, ms=5, lw=1.4, label=f"{body}, from the symbol")
        m, speed = by_ratio(results, "signal_speed", body)
        axes.plot(m, 100 * (speed - 1), color=INK, marker="x", ms=8, ls="",
                  label="from a signal in time" if body == "original" else None)
    axes.set(title="speed of long waves along [100]", xlabel="horizon / spacing", ylabel="difference from classical, %")
    axes.legend(frameon=False, fontsize=9)

    axes = grid[0, 2]
    theory(axes, WIDTH)
    for body, colour in (("original", ORIGINAL), ("normalised", NORMALISED)):
        axes.plot(*profiles[f"{body} 6 200"], color=colour, lw=1.5, label=body)
    axes.set(title="pulse, 200 planes, horizon sqrt(6) spacings", xlabel="x", ylabel="u", xlim=(0.4, 1))
    axes.legend(frameon=False, fontsize=9, loc="upper left")

    axes = grid[1, 0]
    theory(axes, WIDTH)
    for r, colour in ((4, "#c8553d"), (6, NORMALISED), (9, "#7fb0a6"), (16, "#8a6fae")):
        axes.plot(*profiles[f"normalised {r} 400"], color=colour, lw=1.3, label=f"horizon {np.sqrt(r):.3g}")
    axes.set(title="pulse, normalised, 400 planes", xlabel="x", ylabel="u", xlim=(0.4, 1))
    axes.legend(frameon=False, fontsize=9, loc="upper left")

    axes = grid[1, 1]
    for (cells, marker, size) in ((200, "o", 6), (400, "s", 6)):
        m, peak = by_ratio(results, "peak", "normalised", cells)
        axes.plot(m, peak, color=NORMALISED, marker=marker, ms=size, lw=1.4, ls="-" if cells == 400 else ":",
                  label=f"normalised, {cells} planes")
    m, peak = by_ratio(results, "peak", "original", 200)
    axes.plot(m, peak, color=ORIGINAL, marker="o", ms=6, lw=1.4, ls=":", label="original, 200 planes")
    m, speed = by_ratio(results, "speed", "normalised")
    axes.plot(m[m <= 4], TRAVEL * speed[m <= 4], color=INK, marker="x", ms=7, lw=1, ls="--", label="speed of long waves, normalised")
    axes.axhline(TRAVEL, color="0.6", lw=1, ls="--")
    axes.set(title="top of the pulse; classical 0.7", xlabel="horizon / spacing", ylabel="x")
    axes.legend(frameon=False, fontsize=9)

    axes = grid[1, 2]
    theory(axes, CLOUD_WIDTH)
    levels = sorted(key[3] for key in results if key[0] == "peak" and key[1] == "tetrahedra")
    for level, colour in zip(levels, ("#d9a441", "#7fb0a6", "#c8553d")):
        count, peak = (results[q, "tetrahedra", 0, level] for q in ("particles", "peak"))
        axes.plot(*profiles[f"tetrahedra {level:g}"], color=colour, lw=1.5, label=f"{count:.0f}: top at {peak:.3f}")
    ratio = results["radius_ratio", "tetrahedra", 0, levels[0]]
    axes.set(title=f"pulse in tetrahedra, radii 1 : {ratio:.0f}, 30 neighbours", xlabel="x", ylabel="mean u of slices", xlim=(0, 1))
    axes.legend(frameon=False, fontsize=9, loc="upper left")

    for axes in grid.flat:
        axes.spines[["top", "right"]].set_visible(False)
        axes.grid(which="major", color="0.92", lw=0.8)
        axes.title.set_color(INK)
    figure.suptitle("Original and normalised constants: energy, speed of sound, pulse", fontsize=13, color=INK)
    figure.savefig(out / "ganzenmueller2013.png", dpi=110)


if __name__ == "__main__":
    if len(sys.argv) != 2:
        sys.exit("usage: plot.py OUT")
    main(Path(sys.argv[1]))
