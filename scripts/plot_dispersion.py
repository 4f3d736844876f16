#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Draws the result of perimode dispersion: the curves along the path (with the optimised lattice and the spectrum of a
run where there are any) and, if it was asked for, the polar diagram. plot_dispersion.py FOLDER [PICTURE.png]"""
import csv
import math
import pathlib
import sys

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt  # noqa: E402
import numpy as np  # noqa: E402


def columns(file):
    """The columns of a table; numbers as arrays, empty fields as NaN."""
    with open(file, newline="", encoding="utf-8") as stream:
        rows = list(csv.DictReader(stream))
    result = {}
    for name in rows[0]:
        texts = [row[name] for row in rows]
        try:
            result[name] = np.array([float(t) if t else math.nan for t in texts])
        except ValueError:
            result[name] = np.array(texts)
    return result


def along_path(table, branch):
    """Lengths along the path of one branch's points, and which rows they are."""
    rows = np.flatnonzero(table["branch"] == branch)
    k = np.array([table[name][rows] for name in ("k_x", "k_y", "k_z") if name in table])
    return np.concatenate([[0.0], np.cumsum(np.linalg.norm(np.diff(k), axis=0))]), rows


def draw_spectrum(axes, folder):
    """The grey map of all branches, each wave by its own largest amplitude, over two decades."""
    table = columns(folder / "spectrum.csv")
    branches = list(dict.fromkeys(table["branch"]))
    length = np.unique(table["path_length"])
    omega = np.unique(table["angular_frequency"])
    if len(length) < 2:
        return
    total = np.zeros((len(length), len(omega)))
    for branch in branches:
        total = np.maximum(total, table["amplitude"][table["branch"] == branch].reshape(len(length), len(omega)))
    largest = np.maximum(total.max(axis=1, keepdims=True), 1e-4 * total.max())  # quieter waves stay pale
    shade = np.log10(np.maximum(total / largest, 1e-2))
    axes.pcolormesh(length, omega, shade.T, cmap="Greys", shading="nearest", vmin=-2, vmax=0.5, rasterized=True)


def draw_curves(axes, folder):
    table = columns(folder / "dispersion.csv")
    better = columns(folder / "optimised.csv") if (folder / "optimised.csv").exists() else None
    for number, branch in enumerate(dict.fromkeys(table["branch"])):
        length, rows = along_path(table, branch)
        colour = f"C{number}"
        axes.plot(length, table["angular_frequency"][rows], colour, label=f"{branch}, lattice")
        axes.plot(length, table["classical_angular_frequency"][rows], colour, ls=":", lw=1, label=f"{branch}, classical")
        axes.plot(length, table["continuum_angular_frequency"][rows], colour, ls="-.", lw=1, label=f"{branch}, continuum")
        if better is not None:
            axes.plot(length, better["angular_frequency"][rows], colour, ls="--", label=f"{branch}, optimised")
    top = max(np.nanmax(t["angular_frequency"]) for t in (table, better) if t is not None)
    axes.set(xlabel="along the path, rad/m", ylabel="angular frequency, rad/s", ylim=(0, 1.1 * top), xlim=(0, length[-1]))
    axes.legend(fontsize="small")


def draw_polar(axes, folder):
    table = columns(folder / "polar.csv")
    for number, branch in enumerate(dict.fromkeys(table["branch"])):
        rows = table["branch"] == branch
        axes.plot(table["angle"][rows], table["phase_velocity"][rows], f"C{number}", label=branch)
        axes.plot(table["angle"][rows], table["classical_velocity"][rows], f"C{number}", ls=":", lw=1)
    axes.set_title("phase speed, m/s (dotted: classical)", fontsize="medium")


def main():
    if len(sys.argv) not in (2, 3):
        sys.exit(__doc__)
    folder = pathlib.Path(sys.argv[1])
    if not (folder / "dispersion.csv").exists():
        sys.exit(f"expected a result of perimode dispersion, got no {folder / 'dispersion.csv'}")
    picture = pathlib.Path(sys.argv[2]) if len(sys.argv) == 3 else folder / "dispersion.png"
    polar = (folder / "polar.csv").exists()
    figure = plt.figure(figsize=(12 if polar else 7, 5), layout="constrained")
    axes = figure.add_subplot(1, 2 if polar else 1, 1)
    if (folder / "spectrum.csv").exists():
        draw_spectrum(axes, folder)
    draw_curves(axes, folder)
    if polar:
        draw_polar(figure.add_subplot(1, 2, 2, projection="polar"), folder)
    figure.savefig(picture, dpi=150)
    print(picture)


if __name__ == "__main__":
    main()
