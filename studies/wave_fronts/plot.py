#!/usr/bin/env python3
"""plot.py OUT: draws OUT/kernels.png (dispersion) and OUT/fronts_m.png (waves of a point force) from the CSVs."""
import csv
import sys
from pathlib import Path

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
import numpy as np

INK, ORIGINAL, CONTOUR, ZONE = "#22303c", "#c8553d", "#d9a441", "#3d6f8e"
CORNERS = ["O", "X", "M", "R", "O"]
ALPHA, BETA = np.sqrt(1.2), np.sqrt(0.4)


def rows(file):
    with open(file, newline="") as lines:
        return list(csv.DictReader(lines))


def kernels(out):
    table = rows(out / "dispersion.csv")
    figure, axes = plt.subplots(1, 2, figsize=(14, 5.2), layout="constrained", sharey=True)
    for ax, m in zip(axes, ("2", "3")):
        for name, colour in (("original", ORIGINAL), ("contour", CONTOUR), ("zone", ZONE)):
            mine = [row for row in table if row["m"] == m and row["kernel"] == name]
            path, k = (np.array([float(row[c]) for row in mine]) for c in ("path", "k"))
            for branch, style in (("P", "-"), ("S1", "--"), ("S2", "--")):
                ax.plot(path, [float(row[branch] or "nan") for row in mine], style, color=colour, lw=1.3,
                        label=f"{name}, {branch[0]}" if branch != "S2" else None)
        ax.plot(path, ALPHA * k, "-", color=INK, lw=0.8, label="classical, P")
        ax.plot(path, BETA * k, "--", color=INK, lw=0.8, label="classical, S")
        sides = np.cumsum([0, np.pi, np.pi, np.pi, np.pi * np.sqrt(3)])
        ax.set_xticks(sides, CORNERS)
        for x in sides:
            ax.axvline(x, color="0.9", lw=0.8, zorder=0)
        ax.set(title=f"m = {m}", xlim=(0, sides[-1]), ylim=(0, None))
        ax.spines[["top", "right"]].set_visible(False)
    axes[0].set_ylabel(r"$\omega\,\Delta x\,\sqrt{\rho/E}$")
    axes[0].legend(frameon=False, fontsize=9, loc="upper left")
    figure.suptitle("Waves of the cubic lattice along the contour of its irreducible zone", color=INK)
    figure.savefig(out / "kernels.png", dpi=110)


def image(table, names):
    x, z = (np.array([float(row[c]) for row in table]) for c in ("x", "z"))
    values = np.sqrt(sum(np.array([float(row[c] or "nan") for row in table]) ** 2 for c in names))
    cells = round(x.max() - x.min()) + 1
    field = np.full((cells, cells), np.nan)
    field[np.rint(z - z.min()).astype(int), np.rint(x - x.min()).astype(int)] = values
    return field, x.max() + 0.5


def fronts(out, m):
    tables = {name: rows(out / f"front_{m}_{name}.csv") for name in ("original", "zone")}
    shown = [(f"original, m = {m}", *image(tables["original"], ("u_x", "u_z"))),
             (f"optimised, m = {m}", *image(tables["zone"], ("u_x", "u_z"))),
             ("Stokes' solution", *image(tables["zone"], ("exact_x", "exact_z")))]
    exact = shown[2][1]
    centre = exact.shape[0] // 2
    away = np.hypot(*np.meshgrid(*2 * [np.arange(exact.shape[0]) - centre]))
    top = np.nanmax(np.where(away > 12, exact, np.nan))
    figure, axes = plt.subplots(1, 3, figsize=(16, 5.6), layout="constrained")
    for ax, (title, field, half) in zip(axes, shown):
        shades = ax.imshow(field / top, origin="lower", extent=(-half, half, -half, half), cmap="inferno", vmin=0, vmax=1)
        ax.set(title=title, xlabel="x, spacings")
    axes[0].set_ylabel("z, spacings (the force acts along z)")
    figure.colorbar(shades, ax=axes, shrink=0.8, label="|u| over the largest of Stokes' far from the source")
    figure.suptitle("A Ricker force on one particle: the shear waves are 6 spacings long at their peak frequency", color=INK)
    figure.savefig(out / f"fronts_{m}.png", dpi=110)


def main(out):
    kernels(out)
    for m in (2, 3):
        fronts(out, m)


if __name__ == "__main__":
    if len(sys.argv) != 2:
        sys.exit("usage: plot.py OUT")
    main(Path(sys.argv[1]))
