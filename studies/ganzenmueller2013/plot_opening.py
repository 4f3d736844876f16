#!/usr/bin/env python3
"""plot_opening.py OUT: draws OUT/crack_opening.png from OUT/opening.csv."""
import csv
import sys
from pathlib import Path

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
import numpy as np

INK, FULL, CUT, BULK = "#22303c", "#3d6f8e", "#c8553d", "#d9a441"
COLOURS = {"full": FULL, "cut": CUT, "bulk": BULK}


def main(out):
    with open(out / "opening.csv", newline="") as lines:
        results = {(r["quantity"], r["body"], int(r["ratio"]), float(r["horizon"]), float(r["at"])): float(r["value"])
                   for r in csv.DictReader(lines)}

    def series(quantity, body, ratio):
        points = sorted((1.0 / k[4], v) for k, v in results.items() if k[:4] == (quantity, body, ratio, 0.0))
        return np.array(points).T

    figure, (left, middle, right) = plt.subplots(1, 3, figsize=(17, 5.4), layout="constrained", sharex=True)
    for body, colour in COLOURS.items():
        h, load = series("griffith", body, 3)
        left.plot(h, load, color=colour, marker="o", ms=5, lw=1.4, label=f"{body}, horizon 3")
    h, load = series("griffith", "full", 4)
    left.plot(h, load, color=FULL, marker="s", ms=4, lw=1, ls=":", label="full, horizon 4")
    left.set(title="load by compliance (Griffith): converges to LEFM", ylim=(0.9, 1.02))

    for ratio, style, marker in ((2, "-", "^"), (3, "-", "o"), (4, "-", "s"), (5, "-", "D")):
        h, load = series("first", "cut", ratio)
        middle.plot(h, load, color=CUT, ls=style, marker=marker, ms=5, lw=1.2)
        middle.annotate(f"horizon {ratio}", (h[-1], load[-1]), xytext=(6, -3), textcoords="offset points", fontsize=9, color=CUT)
    h, load = series("first", "full", 3)
    middle.plot(h, load, color=FULL, marker="o", ms=5, lw=1.2, label="full, horizon 3")
    for seconds, marker in ((10, "x"), (60, "+")):
        point = results.get(("ramp_first", "full", 3, float(seconds), 40.0))
        if point is not None:
            middle.plot(1 / 40, point, marker=marker, ms=9, color=INK, ls="", label=f"ramped in {seconds} s")
    middle.set(title="first failure: tends to a value of its own for every horizon", ylim=(0.7, 1.5))

    for ratio, marker in ((2, "^"), (3, "o"), (4, "s"), (5, "D")):
        h, load = series("peak", "cut", ratio)
        right.plot(h, load, color=CUT, marker=marker, ms=5, lw=1.2, label=f"cut, horizon {ratio}")
    h, load = series("peak", "full", 3)
    right.plot(h, load, color=FULL, marker="o", ms=5, lw=1.2, label="full, horizon 3")
    for seconds, marker in ((10, "x"), (60, "+")):
        point = results.get(("ramp_collapse", "full", 3, float(seconds), 40.0))
        if point is not None:
            right.plot(1 / 40, point, marker=marker, ms=9, color=INK, ls="", label=f"ramped in {seconds} s, collapse")
    right.set(title="largest load: the lattice traps the crack", ylim=(0.7, 1.5))

    for axes in (left, middle, right):
        axes.axhline(1.0, color=INK, lw=1, ls="--")
        axes.axhline(np.sqrt(2.0), color="0.6", lw=1, ls=":")
        axes.set(xlabel="spacing / width", ylabel="load / LEFM", xlim=(0, 0.047))
        axes.spines[["top", "right"]].set_visible(False)
        axes.grid(color="0.92", lw=0.8)
        axes.title.set_color(INK)
        axes.legend(frameon=False, fontsize=9, loc="lower left")
    middle.annotate("1 with the critical stretch as printed", (0.0005, np.sqrt(2.0)), xytext=(0, 4), textcoords="offset points",
                    fontsize=8, color="0.45")
    figure.suptitle("Crack opening: which load converges to linear elastic fracture mechanics", fontsize=13, color=INK)
    figure.savefig(out / "crack_opening.png", dpi=110)


if __name__ == "__main__":
    if len(sys.argv) != 2:
        sys.exit("usage: plot_opening.py OUT")
    main(Path(sys.argv[1]))
