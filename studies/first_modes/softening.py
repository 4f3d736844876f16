#!/usr/bin/env python3
"""softening.py BUILD: what the horizon and free edges cost. First bending mode of a narrow free plate, against
Timoshenko's beam, for m = 2, 3, 4, three grids and two calibrations. Prints a table."""
import csv
import subprocess
import sys
import tempfile
from pathlib import Path

import numpy as np
from scipy.optimize import brentq

LENGTH, HEIGHT = 1.0, 0.1
E, RHO, NU = 210e9, 7850.0, 1 / 3
SHEAR = 5 * (1 + NU) / (6 + 5 * NU)  # shear coefficient of a rectangle in plane stress


def timoshenko():
    """First bending frequency (Hz) of the free beam: the smallest root of the determinant of the end conditions
    M = Q = 0, for deflection w and rotation p ~ exp(s x)."""
    g = E / (2 * (1 + NU))
    inertia, area = HEIGHT**3 / 12, HEIGHT

    def determinant(omega):
        # k G A (w'' - p') + rho A w2 w = 0 and E I p'' + k G A (w' - p) + rho I w2 p = 0
        kga = SHEAR * g * area
        a, b = RHO * area * omega**2, RHO * inertia * omega**2
        squares = np.roots([kga * E * inertia, kga * b + a * E * inertia, a * (b - kga)])
        s = np.concatenate([np.sqrt(squares.astype(complex)), -np.sqrt(squares.astype(complex))])
        p = (kga * s**2 + a) / (kga * s)  # rotation for deflection 1
        ends = [f * np.exp(s * x) for x in (0.0, LENGTH) for f in (s * p, s - p)]
        scale = np.exp(np.abs(s.real) * LENGTH)
        matrix = np.array(ends) / scale
        # Columns are s, -s pairs of one real and one imaginary root: the determinant is real up to a fixed phase.
        return (np.linalg.det(matrix) * 1j).real, (np.linalg.det(matrix)).real

    euler = (4.730040744862704 / LENGTH) ** 2 * np.sqrt(E * HEIGHT**2 / (12 * RHO))
    part = int(abs(determinant(0.8 * euler)[1]) > abs(determinant(0.8 * euler)[0]))
    root = brentq(lambda omega: determinant(omega)[part], 0.8 * euler, 1.05 * euler, xtol=1e-9)
    return root / (2 * np.pi), euler / (2 * np.pi)


def lattice(ratio):
    """Frequency factor of a slender strip in the bulk of the lattice, sqrt(E_x / E) - 1: no free edges, delta/height
    to 0. From C_abcd = (1/2) sum_j c beta V n_a n_b n_c n_d |xi| with c = 9 E / (pi delta^3 thickness)."""
    x, y = np.meshgrid(*[np.arange(-ratio - 1, ratio + 2)] * 2)
    r = np.hypot(x, y)
    x, y, r = x[r > 0], y[r > 0], r[r > 0]
    c = 4.5 / (np.pi * ratio**3) * np.clip(ratio + 0.5 - r, 0, 1)
    c11, c12 = np.sum(c * x**4 / r**3), np.sum(c * x**2 * y**2 / r**3)
    return np.sqrt(c11 - c12**2 / c11) - 1


def first_bending(program, spacing, ratio, calibration):
    """Hz: the lowest mode above the three rigid ones."""
    with tempfile.TemporaryDirectory() as folder:
        out = Path(folder) / "strip"
        subprocess.run([program, "modal", Path(__file__).with_name("strip.yaml"), "--quiet", "--output", out,
                        "--set", f"body.particles.grid.spacing={spacing}", "--set", f"body.horizon.ratio={ratio}",
                        "--set", f"material.calibration={calibration}"],
                       check=True, stdout=subprocess.DEVNULL)
        with open(out / "modes.csv", newline="") as file:
            return float(next(row for row in csv.DictReader(file) if row["kind"] == "elastic")["frequency_hz"])


def main(build):
    program = Path(build) / "src" / "cli" / "perimode"
    classical, euler = timoshenko()
    print(f"narrow free plate {LENGTH} m x {HEIGHT} m, first bending mode: Timoshenko {classical:.3f} Hz, "
          f"Euler-Bernoulli {euler:.3f} Hz\n")
    print("error = f / Timoshenko - 1 = lattice (of m alone) + rest (free edges, falls with delta/height)\n")
    print(f"{'':31}{'lattice':>10}{'continuum calibration':>33}{'discrete calibration':>24}")
    print(f"{'height/spacing':>14}{'m':>3}{'delta/height':>14}{'':>10}{'f [Hz]':>13}{'error':>10}{'rest':>10}"
          f"{'f [Hz]':>14}{'error':>10}")
    for ratio in (2, 3, 4):
        bulk = lattice(ratio)
        for cells in (10, 20, 40):
            hz = [first_bending(program, HEIGHT / cells, ratio, c) for c in ("continuum", "discrete")]
            error = [f / classical - 1 for f in hz]
            print(f"{cells:>14}{ratio:>3}{ratio / cells:>14.3f}{bulk:>10.2%}{hz[0]:>13.3f}{error[0]:>10.2%}"
                  f"{error[0] - bulk:>10.2%}{hz[1]:>14.3f}{error[1]:>10.2%}")


if __name__ == "__main__":
    if len(sys.argv) != 2:
        sys.exit("usage: softening.py BUILD")
    main(sys.argv[1])
