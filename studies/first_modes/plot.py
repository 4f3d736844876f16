#!/usr/bin/env python3
"""plot.py OUT: draws OUT/modes.png from the results run.sh leaves in OUT: mode shapes of the plate without and
with crack, the frequency drops, and the first shapes of the bar."""
import csv
import sys
from pathlib import Path

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
import numpy as np
from scipy.io import netcdf_file

CRACK = np.array([[0.3, 0.0], [0.3, 0.2]])
SIZE = (1.0, 0.5)
SHOWN = 4
INK, CRACKED, WHOLE = "#22303c", "#c8553d", "#3d6f8e"


def read_modes(file):
    """Positions (n x 2), shapes (modes x n x 2) and frequencies in Hz of an Exodus II file."""
    with netcdf_file(file, "r", mmap=False) as data:
        names = [b"".join(row).split(b"\0")[0].decode() for row in data.variables["name_nod_var"][:]]
        x = np.stack([data.variables["coordx"][:], data.variables["coordy"][:]], axis=1)
        u = [data.variables[f"vals_nod_var{names.index('displacement_' + a) + 1}"][:] for a in "xy"]
        return x.copy(), np.stack(u, axis=2).copy(), data.variables["vals_glo_var"][:, 0].copy()


def draw_plate(axes, x, u, colour_limit, title):
    """Particles moved by the mode, coloured by how far they move, over the outline at rest."""
    width, height = SIZE
    axes.plot([0, width, width, 0, 0], [0, 0, height, height, 0], color="0.75", lw=0.8, zorder=0)
    moved = x + 0.09 * u
    axes.scatter(*moved.T, c=np.hypot(*u.T), s=2.2, marker="s", lw=0, cmap="viridis", vmin=0,
                 vmax=colour_limit, rasterized=True)
    axes.plot([0, 0], [-0.02, height + 0.02], color=INK, lw=4, solid_capstyle="butt")
    axes.set_title(title, fontsize=10.5, color=INK)
    axes.set(aspect="equal", xlim=(-0.06, 1.16), ylim=(-0.13, 0.63), xticks=[], yticks=[])
    axes.set_axis_off()


def crack_faces(x):
    """Particles of the columns left and right of the crack, from its mouth to its tip."""
    for side in (-1, 1):
        distance = side * (x[:, 0] - CRACK[0, 0])
        face = np.flatnonzero((distance > 0) & (distance < 0.004) & (x[:, 1] < CRACK[1, 1]))
        yield face[np.argsort(x[face, 1])]


def opening(x, u):
    """Mean opening of the crack; shapes are drawn with the sign that opens it (the linear body lets faces overlap)."""
    left, right = crack_faces(x)
    return np.mean(u[right, 0]) - np.mean(u[left, 0])


def draw_crack(axes, x, u):
    for face in crack_faces(x):
        axes.plot(*(x + 0.09 * u)[face].T, color=CRACKED, lw=1.6)


def main(out):
    with open(out / "modes_table.csv", newline="") as file:
        rows = list(csv.DictReader(file))
    cracked_rows = [row for row in rows if row["paired_mode"]]
    bar_rows = [row for row in rows if row["body"] == "bar"]
    x, whole, whole_hz = read_modes(out / "plate" / "modes.exo")
    _, cracked, cracked_hz = read_modes(out / "plate_cracked" / "modes.exo")

    figure = plt.figure(figsize=(13.5, 8.6), layout="constrained")
    upper, lower = figure.subfigures(2, 1, height_ratios=[1.55, 1])
    grid = upper.subplots(2, SHOWN)
    for column, row in enumerate(sorted(cracked_rows, key=lambda r: int(r["paired_mode"]))[:SHOWN]):
        i, j = int(row["paired_mode"]) - 1, int(row["mode"]) - 1
        a, b = whole[i], cracked[j]
        b = b * np.sign(opening(x, b))
        a = a * np.sign(np.sum(a * b))
        a, b = a / np.hypot(*a.T).max(), b / np.hypot(*b.T).max()
        draw_plate(grid[0, column], x, a, 1.0, f"mode {i + 1}:  {whole_hz[i]:.1f} Hz")
        drop = 100 * float(row["frequency_drop"])
        draw_plate(grid[1, column], x, b, 1.0, f"{cracked_hz[j]:.1f} Hz   ({-drop:+.1f} %)")
        draw_crack(grid[1, column], x, b)
    upper.suptitle("Steel plate 1 m x 0.5 m, clamped at its left edge: modes without and with an edge crack of 0.2 m",
                   fontsize=13, color=INK)
    colours = upper.colorbar(grid[0, 0].collections[0], ax=grid, shrink=0.75, pad=0.01, ticks=[0, 1])
    colours.set_label("displacement / largest", color=INK)

    bars, shapes = lower.subplots(1, 2)
    order = sorted(cracked_rows, key=lambda r: int(r["paired_mode"]))
    drops = [100 * float(row["frequency_drop"]) for row in order]
    places = np.arange(len(order))
    bars.bar(places, drops, color=CRACKED, width=0.62)
    for place, drop, row in zip(places, drops, order):
        bars.annotate(f"{drop:.1f} %\nMAC {float(row['mac']):.2f}", (place, drop), xytext=(0, 4),
                      textcoords="offset points", ha="center", fontsize=9, color=INK)
    bars.set_xticks(places, [row["paired_mode"] for row in order])
    bars.set(xlabel="mode of the plate without crack", ylabel="frequency drop, %", ylim=(0, 1.22 * max(drops)),
             title="What the crack costs")

    bar_x, bar_u, _ = read_modes(out / "bar" / "modes.exo")
    for n, row in enumerate(bar_rows[:3]):
        u = bar_u[n, :, 0]
        u = u / np.abs(u).max() * np.sign(u[0])
        shapes.plot(bar_x[:, 0], u, color=plt.cm.viridis(0.1 + 0.35 * n), lw=2,
                    label=f"{float(row['frequency_hz']):.1f} Hz (classical {float(row['classical_hz']):.1f}, "
                          f"FE {float(row['finite_element_hz']):.1f})")
    shapes.set(xlabel="x, m", ylabel="displacement / largest", xlim=(0, 1), ylim=(-1.15, 1.95),
               yticks=[-1, 0, 1], title="Fixed-fixed aluminium bar")
    shapes.legend(loc="upper center", frameon=False, fontsize=9.5)
    for axes in (bars, shapes):
        axes.spines[["top", "right"]].set_visible(False)
        axes.title.set_color(INK)

    figure.savefig(out / "modes.png", dpi=130)


if __name__ == "__main__":
    if len(sys.argv) != 2:
        sys.exit("usage: plot.py OUT")
    main(Path(sys.argv[1]))
