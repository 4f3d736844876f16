#!/usr/bin/env python3
"""plot.py OUT: draws OUT/fig04.png ... OUT/fig11.png from the tables of the same names."""
import csv
import sys
from collections import defaultdict
from pathlib import Path

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
import numpy as np

INK, BLUE, RED, GOLD, GREEN, PURPLE, GREY = "#22303c", "#3d6f8e", "#c8553d", "#d9a441", "#5b9a8b", "#8a6fae", "0.55"
METHOD = {"P.C": (GOLD, "point collocation"), "S.C": (BLUE, "sub-domain collocation"), "L.S": (PURPLE, "least squares"),
          "G": (GREEN, "Galerkin"), "L1": (RED, "least possible (L1)"), "original": (GREY, "original")}
# The contour O-M-Y-O of the paper, its M at (1, 0) and its Y at (1, 1), in pi/spacing.
CORNERS = np.array([0.0, 1.0, 2.0, 2.0 + np.sqrt(2.0)]) * np.pi


def read_curves(file):
    panels = defaultdict(lambda: defaultdict(list))
    with open(file, newline="") as lines:
        for r in csv.DictReader(lines):
            panels[r["panel"]][r["curve"]].append((float(r["x"] or "nan"), float(r["y"] or "nan")))
    return {p: {name: np.array(points).T for name, points in curves.items()} for p, curves in panels.items()}


def read_map(file):
    cells = defaultdict(dict)
    with open(file, newline="") as lines:
        for r in csv.DictReader(lines):
            cells[r["panel"]][float(r["x"]), float(r["y"])] = float(r["level_dB"])
    maps = {}
    for panel, levels in cells.items():
        x, y = (np.array(sorted({key[axis] for key in levels})) for axis in (0, 1))
        maps[panel] = x, y, np.array([[levels[a, b] for a in x] for b in y])
    return maps


def tidy(axes, **what):
    axes.spines[["top", "right"]].set_visible(False)
    axes.grid(which="major", color="0.92", lw=0.8)
    axes.set_axisbelow(True)
    axes.set(**what)
    axes.title.set_color(INK)


def save(figure, out, name, title):
    figure.suptitle(title, fontsize=12.5, color=INK)
    figure.savefig(out / f"{name}.png", dpi=110)
    plt.close(figure)


def contour_ticks(axes, sides=3):
    axes.set_xticks(CORNERS[:sides + 1], list("OMYO")[:sides + 1])
    axes.set_xlim(0, CORNERS[sides])
    for corner in CORNERS[1:sides]:
        axes.axvline(corner, color="0.75", lw=0.8, zorder=0)


def fig04(out):
    panels = read_curves(out / "fig04.csv")
    figure = plt.figure(figsize=(15, 5), layout="constrained")
    for place, panel, title in ((131, "a", "a  pressure waves"), (132, "b", "b  shear waves")):
        axes = figure.add_subplot(place, projection="polar")
        for (name, (degrees, speed)), colour in zip(panels[panel].items(), (RED, BLUE, GREEN)):
            axes.plot(np.radians(degrees), speed, color=colour, lw=1.7, label=name)
        axes.plot(np.linspace(0, 2 * np.pi, 200), np.ones(200), color=INK, lw=0.9, ls="--", label="classical")
        axes.set_rlim(0, 1.25)
        axes.set_rticks([0.25, 0.5, 0.75, 1.0])
        axes.set_rlabel_position(22.5)
        axes.tick_params(labelsize=8)
        axes.grid(color="0.9")
        axes.set_title(title, color=INK)
    figure.axes[0].legend(frameon=False, fontsize=9, loc="lower left", bbox_to_anchor=(-0.12, -0.12))
    axes = figure.add_subplot(133)
    for name, colour, mark in (("P 0", RED, "o-"), ("P 45", RED, "s--"), ("S 0", BLUE, "o-"), ("S 45", BLUE, "s--")):
        n, speed = panels["c"][name]
        axes.plot(n, speed, mark, color=colour, ms=4.5, lw=1.4, mfc="w" if "45" in name else colour,
                  label=f"{name[0]} at {name[2:]} degrees")
    axes.axhline(1, color=INK, lw=0.9, ls="--")
    tidy(axes, title="c  over N", xlabel="N = horizon / spacing", ylabel="speed / classical speed", ylim=(-0.05, 2.05))
    axes.set_xticks(range(1, 11))
    axes.legend(frameon=False, fontsize=9)
    save(figure, out, "fig04", "Speed of long waves over the classical one in the original plates")


def spectrum(axes, map_, floor=-70, shading="nearest"):
    x, y, level = map_
    axes.pcolormesh(x, y, np.clip(level, floor, 0), cmap="Greys", vmin=floor, vmax=0, shading=shading, rasterized=True)


def under_curve(axes, curves, every):
    axes.plot(*curves["local"], color=BLUE, lw=1.1, ls="--", label="classical")
    x, y = curves["lattice"]
    axes.plot(x[::every], y[::every], ls="", marker="o", ms=4.5, mfc="none", mec=RED, mew=1.1, label="lattice, eq. (10)/(15)")


def fig05(out):
    panels, maps = read_curves(out / "fig05.csv"), read_map(out / "fig05_map.csv")
    figure, grid = plt.subplots(2, 3, figsize=(15, 8.2), layout="constrained", sharex=True, sharey=True)
    titles = ("original, N = 1", "original, N = 2", "original, N = 3", "alpha = 1/2", "alpha = 3.72, -0.86",
              "Galerkin, N = 3")
    for axes, panel, title in zip(grid.flat, "abcdef", titles):
        spectrum(axes, maps[panel])
        under_curve(axes, panels[panel], 9)
        tidy(axes, title=f"{panel}  {title}", xlim=(0, np.pi), ylim=(0, 3.6))
        axes.grid(visible=False)
    for axes in grid[:, 0]:
        axes.set_ylabel("omega, rad/s")
    for axes in grid[1]:
        axes.set_xlabel("k, rad/m")
        axes.set_xticks([0, np.pi / 4, np.pi / 2, 3 * np.pi / 4, np.pi], ["0", "π/4", "π/2", "3π/4", "π"])
    grid[0, 0].legend(frameon=False, fontsize=9, loc="upper left")
    save(figure, out, "fig05", "Bars: the curve of the lattice on the spectrum of a simulation (grey, 70 dB below its top at every k)")


def fig06(out):
    panels = read_curves(out / "fig06.csv")
    figure, (a, b) = plt.subplots(1, 2, figsize=(13, 5), layout="constrained")
    for n, colour, size in ((10, BLUE, 4), (5, GREEN, 5), (3, RED, 6)):
        a.plot(*panels["a"][f"N={n}"], "-o", color=colour, ms=size, lw=1.3, label=f"N = {n}")
        a.plot(*panels["a"][f"N={n} printed"], ls="", marker="x", ms=8, mew=1.1, color=INK,
               label="printed, table 1" if n == 3 else None)
    a.axhline(0, color=INK, lw=0.8)
    tidy(a, title="a  multipliers by point collocation", xlabel="i", ylabel="alpha_i")
    a.set_xticks(range(1, 11))
    a.legend(frameon=False, fontsize=9)
    for name, (colour, label) in METHOD.items():
        if name in panels["b"]:
            b.semilogy(*panels["b"][name], marker="o", color=colour, ms=4, lw=1.5, label=label,
                       ls="--" if name == "L1" else "-")
    tidy(b, title="b  eq. (49) over that of the original N = 3", xlabel="N", ylabel="error")
    b.set_xticks(range(1, 11))
    b.legend(frameon=False, fontsize=9)
    save(figure, out, "fig06", "Bars: multipliers, and the error over the horizon")


def grouped(axes, groups, labels, colours, digits="{:.3f}", hatch=()):
    """Bars in groups: {series: {group: value}}."""
    wide = 0.84 / len(groups)
    for place, (series, values) in enumerate(groups.items()):
        for group, value in values.items():
            x = labels.index(group) + (place - 0.5 * (len(groups) - 1)) * wide
            axes.bar(x, value, 0.92 * wide, color=colours[series], hatch="///" if series in hatch else None, edgecolor="w",
                     lw=0.4, label=series if group == next(iter(values)) else None)
            axes.annotate(digits.format(value), (x, value), xytext=(0, 3), textcoords="offset points", ha="center",
                          fontsize=6.5, rotation=90, va="bottom", color=INK)
    axes.set_xticks(range(len(labels)), labels)


def fig07(out):
    panels = read_curves(out / "fig07.csv")
    figure, grid = plt.subplots(1, 3, figsize=(17, 5.4), layout="constrained")
    for axes, panel, n in zip(grid, "ab", (3, 5)):
        axes.plot(*panels[panel]["classical"], color=INK, lw=1, ls="--", label="classical")
        for name in ("original", "P.C", "S.C", "L.S", "G"):
            axes.plot(*panels[panel][name], color=METHOD[name][0], lw=1.6, label=METHOD[name][1])
        axes.plot(*panels[panel]["L.S printed"], color=PURPLE, lw=1.1, ls=":", label="least squares as printed")
        tidy(axes, title=f"{panel}  N = {n}", xlabel="k, rad/m", ylabel="omega, rad/s", xlim=(0, np.pi), ylim=(0, 3.4))
        axes.set_xticks([0, np.pi / 2, np.pi], ["0", "π/2", "π"])
    grid[0].legend(frameon=False, fontsize=9)
    axes = grid[2]
    groups, colours = {}, {}
    for name in ("P.C", "S.C", "L.S", "G"):
        for suffix, label in (("", ""), (" printed", " printed")):
            n, error = panels["c"][name + suffix]
            groups[name + label] = {f"N = {int(a)}": e for a, e in zip(n, error)}
            colours[name + label] = METHOD[name][0]
    groups["L1"] = {f"N = {int(a)}": e for a, e in zip(*panels["c"]["L1"])}
    colours["L1"] = RED
    grouped(axes, groups, ["N = 3", "N = 5", "N = 10"], colours, "{:.4f}", [g for g in groups if "printed" in g])
    axes.set_yscale("log")
    tidy(axes, title="c  eq. (49) over that of the original N = 3", ylim=(6e-3, 0.6))
    axes.grid(axis="x", visible=False)
    axes.legend(frameon=False, fontsize=8, ncols=2)
    save(figure, out, "fig07", "Bars: original and optimised; hatched and dotted: the multipliers as printed in table 1")


def fig08(out):
    panels, maps = read_curves(out / "fig08.csv"), read_map(out / "fig08_map.csv")
    figure, grid = plt.subplots(3, 4, figsize=(18, 12), layout="constrained")
    titles = [f"{wave}, {kind}, N = {n}" for n in (2, 3) for kind in ("original", "QP") for wave in ("P", "S")]
    for axes, panel, title in zip(grid[:2].flat, "abcdefgh", titles):
        spectrum(axes, maps[panel])
        under_curve(axes, panels[panel], 4)
        tidy(axes, title=f"{panel}  {title}", ylim=(0, 4.2))
        axes.grid(visible=False)
        contour_ticks(axes)
    for axes in grid[:, 0]:
        axes.set_ylabel("omega, rad/s")
    grid[0, 0].legend(frameon=False, fontsize=9, loc="upper left")
    for n, (bare, named) in zip((2, 3), (grid[2, :2], grid[2, 2:])):
        name = f"row N={n}"
        for axes, title in ((bare, f"one row of nodes, original, N = {n}"), (named, "the same: where d omega/d k_y = 0")):
            spectrum(axes, maps[name], -45, "gouraud")
            tidy(axes, title=title, xlabel="k_x, rad/m", xlim=(0, np.pi), ylim=(0, 2.4))
            axes.grid(visible=False)
            axes.set_xticks([0, np.pi / 2, np.pi], ["0", "π/2", "π"])
        for place, colour, label in (("k_y=0", RED, "k_y = 0: the branch"), ("k_y=pi", BLUE, "k_y = π: ghost"),
                                     ("between", GOLD, "k_y between: ghosts")):
            named.plot(*panels[name][place], ls="", marker="o", ms=3.2, color=colour, mec="w", mew=0.3, label=label)
        named.legend(frameon=False, fontsize=9, loc="upper left")
    save(figure, out, "fig08", "Plates: the curves of the lattice on the spectrum of a simulation; below: where ghosts come from")


def fig09(out):
    panels = read_curves(out / "fig09.csv")
    figure, grid = plt.subplots(2, 2, figsize=(14, 9.4), layout="constrained")
    for axes, panel, title in zip(grid.flat, "abcd", ("P, optimal", "S, optimal", "P, positive only", "S, positive only")):
        for name, (x, y) in panels[panel].items():
            method = name.split()[0]
            colour, width, line, label = METHOD.get(method, (RED, 1.8, "-", name))[0], 1.2, "-", f"{name}, table 2"
            if name == "classical":
                colour, width, line, label = INK, 1.1, "--", "classical"
            elif name == "original":
                colour, width, line, label = GREY, 1.4, "-", "original"
            elif method in ("QP", "L1"):
                colour, width, line = (RED, 1.9, "-") if name in ("QP", "QP 0.5") else ("#7a2d1d", 1.4, "-.")
                label = f"ours: {name}" if " " not in name else f"ours: {name.split()[0]}, alpha >= {name.split()[1]}"
            axes.plot(x, y, color=colour, lw=width, ls=line, label=label)
        tidy(axes, title=f"{panel}  {title}", ylabel="omega, rad/s", ylim=(0, {"b": 4.3, "d": 3.0}.get(panel, 4.9)))
        contour_ticks(axes)
        axes.legend(frameon=False, fontsize=8)
    save(figure, out, "fig09", "Plates of N = 3 over the contour O-M-Y-O: the columns of table 2 and ours")


def fig10(out):
    curves = read_curves(out / "fig10.csv")["a"]
    figure, axes = plt.subplots(figsize=(8, 5.2), layout="constrained")
    axes.plot(*curves["eq. 50"], color=INK, lw=1.5, ls="--", label="eq. (50)")
    axes.plot(*curves["fit"], color=BLUE, lw=1.5, label="our fit")
    axes.plot(*curves["S.C positive"], ls="", marker="o", ms=8, mfc="none", mec=RED, mew=1.6, label="S.C positive, table 2")
    axes.plot(*curves["QP 0.5"], ls="", marker="x", ms=8, color=BLUE, mew=1.8, label="ours: QP, alpha >= 0.5")
    axes.axhline(1, color="0.7", lw=0.9)
    tidy(axes, xlabel="|xi| / spacing", ylabel="alpha", xlim=(0, 3.1))
    axes.legend(frameon=False)
    save(figure, out, "fig10", "Influence function, N = 3")


def fig11(out):
    panels = read_curves(out / "fig11.csv")
    figure, grid = plt.subplots(1, 3, figsize=(19, 5.8), layout="constrained", gridspec_kw={"width_ratios": (1, 1, 1.35)})
    for axes, panel, title in zip(grid, "ab", ("optimal", "positive only")):
        for name, (x, y) in panels[panel].items():
            branch, kernel = name.split(" ", 1)
            method = kernel.split()[0]
            colour, width, line = METHOD.get(method, (RED,))[0], 1.1, "-"
            if kernel == "classical":
                colour, width, line = INK, 1.6, "-"
            elif method in ("QP", "L1"):
                colour, width, line = (RED, 1.8, "-") if kernel in ("QP", "QP 0.5") else ("#7a2d1d", 1.3, "-.")
            axes.plot(x, y, color=colour, lw=width, ls=line, label=kernel if branch == "P" else None)
        tidy(axes, title=f"{panel}  {title}", ylabel="omega, rad/s", ylim=(0, 4.9))
        contour_ticks(axes, 2)
        axes.annotate("P", (5.2, 4.55), color=INK)
        axes.annotate("S", (5.9, 2.25), color=INK)
        axes.legend(frameon=False, fontsize=8)
    series, colours = {}, {}
    for error, label, hatched in (("error51", "eq. (51)", False), ("error45", "eq. (45)", True)):
        values = {}
        for name, (n, value) in panels["c"].items():
            kind, kernel = name.split(" ", 1)
            if kind == error and kernel != "original":
                values.update({f"{int(a)} {kernel}": v for a, v in zip(n, value) if a <= 3})
        series[label] = values
        colours[label] = "#9db8c9" if hatched else BLUE
    order = [f"{n} {name}" for n in (2, 3) for name in ("P.C optimal", "S.C optimal", "L.S optimal", "G optimal", "QP", "L1")]
    order += [f"3 {name}" for name in ("P.C positive", "S.C positive", "L.S positive", "G positive", "QP 0.5", "QP 0")]
    axes = grid[2]
    grouped(axes, {s: {g: v[g] for g in order if g in v} for s, v in series.items()}, order, colours)
    axes.set_xlim(-0.7, len(order) - 0.3)
    axes.set_xticks(range(len(order)), [o.replace(" optimal", "").replace(" positive", "+") for o in order], rotation=60, fontsize=8)
    for tick, name in zip(axes.get_xticklabels(), order):
        tick.set_color(RED if name.split()[1] in ("QP", "L1") else INK)
    tidy(axes, title="c  errors over the original's (red: ours)", ylim=(0, 1.12))
    axes.grid(axis="x", visible=False)
    axes.legend(frameon=False, fontsize=9, loc="upper left")
    save(figure, out, "fig11", "Plates of N = 3 over O-M-Y, and the errors of the columns of table 2 beside ours")


if __name__ == "__main__":
    if len(sys.argv) != 2:
        sys.exit("usage: plot.py OUT")
    for draw in (fig04, fig05, fig06, fig07, fig08, fig09, fig10, fig11):
        draw(Path(sys.argv[1]))
