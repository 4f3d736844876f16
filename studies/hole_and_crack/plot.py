#!/usr/bin/env python3
"""plot.py OUT: draws OUT/hole_and_crack.png from OUT/load_curve.csv, OUT/crack_path.csv and OUT/damage.csv."""
import csv
import sys
from pathlib import Path

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
import numpy as np

INK = "#22303c"
HOLE, CRACK, MM = (58.0, 61.0, 12.0), (25.0, 50.0), 1e3


def columns(file):
    with open(file, newline="") as lines:
        rows = list(csv.DictReader(lines))
    return {name: np.array([float(row[name]) for row in rows]) for name in rows[0]}


def main(out):
    curve, path, field = (columns(out / f"{name}.csv") for name in ("load_curve", "crack_path", "damage"))
    events = curve["event"][-1]
    figure, (left, right, energy) = plt.subplots(1, 3, figsize=(18, 5.8), layout="constrained",
                                                 gridspec_kw={"width_ratios": [1.05, 1.15, 1]})

    spacing = np.min(np.diff(np.unique(field["x"].round(9)))) * MM
    cells = round(100.0 / spacing)
    image = np.full((cells, cells), np.nan)
    image[(field["y"] * MM / spacing).astype(int), (field["x"] * MM / spacing).astype(int)] = field["damage"]
    shades = left.imshow(image, origin="lower", extent=(0, 100, 0, 100), cmap="Greys", vmin=0, vmax=1)
    dots = left.scatter(path["x"] * MM, path["y"] * MM, c=path["event"], s=1.2 * spacing * spacing, cmap="viridis", vmin=1, vmax=events, lw=0)
    left.add_patch(plt.Circle(HOLE[:2], HOLE[2], fc="none", ec=INK, lw=1.2))
    left.plot([0, CRACK[0]], [CRACK[1]] * 2, color="#c8553d", lw=2.2, label="pre-crack")
    left.set(title="damage, and where bonds broke", xlabel="x, mm", ylabel="y, mm", xlim=(0, 100), ylim=(20, 95), aspect="equal")
    left.legend(frameon=False, loc="lower left", fontsize=9)
    figure.colorbar(shades, ax=left, shrink=0.55, label="damage", location="left", pad=0.02)
    figure.colorbar(dots, ax=left, shrink=0.55, label="event")

    motion, force = curve["motion"] * MM, curve["force"]
    right.plot(motion, force, color="0.8", lw=0.5, zorder=1)
    right.scatter(motion, force, c=curve["event"], s=5, cmap="viridis", vmin=1, vmax=events, lw=0, zorder=2)
    right.plot([0, motion[0]], [0, force[0]], color=INK, lw=1.2)
    shown = force > 0.05 * force.max()
    right.set(title="every event: load factor found, not stepped to", xlabel="motion of the grip, mm", ylabel="force, N",
              xlim=(0, 1.05 * motion[shown].max()), ylim=(0, 1.08 * force.max()))
    beyond = np.flatnonzero(curve["event"] == path["event"][path["x"] * MM > HOLE[0]].min())[0]
    for index, text, shift in ((0, "first break", (-62, 6)), (int(force.argmax()), "largest load", (14, 4)),
                               (beyond, "out of the hole", (-78, 8))):
        right.annotate(text, (motion[index], force[index]), xytext=shift, textcoords="offset points", fontsize=9, color=INK,
                       arrowprops={"arrowstyle": "-", "color": INK, "lw": 0.7})

    crack = curve["crack_length"] * MM
    last = np.flatnonzero(shown)[-1]
    for name, colour, label in (("work", INK, "external work"), ("released", "#c8553d", "energy of the bonds as they broke"),
                                ("relaxation", "#d9a441", "work of their forces as they are let go"), ("stored", "#3d6f8e", "stored")):
        energy.plot(crack[:last], curve[name][:last], color=colour, lw=1.1, label=label)
    energy.set(title="energies along the path", xlabel="length of crack, mm", ylabel="J")
    energy.set_ylim(0, 1.45 * curve["work"][:last].max())
    energy.legend(frameon=False, fontsize=9, loc="upper left")

    for axes in (left, right, energy):
        axes.spines[["top", "right"]].set_visible(False)
        axes.title.set_color(INK)
    right.grid(color="0.92", lw=0.8)
    energy.grid(color="0.92", lw=0.8)
    figure.suptitle(f"A crack into a hole and out of it: {events:.0f} events, from the first broken bond to separation", fontsize=13, color=INK)
    figure.savefig(out / "hole_and_crack.png", dpi=110)


if __name__ == "__main__":
    if len(sys.argv) != 2:
        sys.exit("usage: plot.py OUT")
    main(Path(sys.argv[1]))
