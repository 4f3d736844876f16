# SPDX-License-Identifier: BSD-3-Clause
"""perimode dispersion: files, closed forms, optimised tables in the other analyses, and every kind of bad input."""
import json
import math
import re

from program import ProgramTest, cloud_csv, main, rows

BAR = """\
title: bar
body:
  dimension: 1
  area: 1.0e-4
  particles: { grid: { lower: [0], upper: [1], spacing: 0.01 } }
  horizon: { ratio: 3 }
material: { youngs_modulus: 68.0e+9, density: 2700 }
analysis:
  dispersion: { points: 101 }
output: { directory: out/bar }
"""

# The horizon comes first: orbits (1,0), (1,1), (2,0).
PLATE = """\
title: plate
body:
  dimension: 2
  plane: strain
  particles: { grid: { lower: [0, 0], upper: [8, 8], spacing: 1 } }
  horizon: { ratio: 2 }
  periodic: [x, y]
material:
  youngs_modulus: 1
  density: 1
analysis:
  dispersion: { points: 61 }
output: { directory: out/plate }
"""

CLOUD = """\
title: cloud
body:
  dimension: 2
  particles: { file: cloud.csv, period: [0.8, 0.7] }
  horizon: { length: 0.25 }
  periodic: [x, y]
material: { youngs_modulus: 210.0e+9, density: 7850 }
analysis: { dispersion: {} }
output: { directory: out/cloud }
"""

SPEED = math.sqrt(68.0e9 / 2700)
QP = [8.1746376428, 1.4809609794, -3.0401212702]  # [alebrahim2021]'s problem, solved: N = 2, plane strain
SYMBOL_ORBITS = {(1, 0): 0, (1, 1): 1, (2, 0): 2}


def bar_squared(k, n):
    """omega^2 of the constant kernel in units of spacing and speed 1, [alebrahim2021] eq. (13)."""
    return 4.0 / n**2 * sum((1 - math.cos(i * k)) / i for i in range(1, n + 1))


def plate_squared(kx, ky, alpha):
    """Both omega^2 of the 2D lattice with horizon 2, ascending; plane strain, E = rho = spacing = 1."""
    xx = xy = yy = 0.0
    for x in range(-2, 3):
        for y in range(-2, 3):
            orbit = SYMBOL_ORBITS.get(tuple(sorted((abs(x), abs(y)), reverse=True)))
            if orbit is None:
                continue
            r = math.hypot(x, y)
            rate = 48 / (5 * math.pi * 2**3) * alpha[orbit] * (1 - math.cos(kx * x + ky * y)) / r**3
            xx, xy, yy = xx + rate * x * x, xy + rate * x * y, yy + rate * y * y
    half, root = (xx + yy) / 2, math.hypot((xx - yy) / 2, xy)
    return half - root, half + root


class DispersionTest(ProgramTest):
    def run_case(self, text, *options, name="case.yaml"):
        self.write(name, text)
        return self.good("dispersion", name, *options)

    def summary(self, name):
        return json.loads((self.folder / "out" / name / "summary.json").read_text())

    def table(self, name, file="dispersion.csv"):
        return rows(self.folder / "out" / name / file)

    def numbers(self, name, column, file="dispersion.csv", branch=None):
        return [float(r[column] or "nan") for r in self.table(name, file) if branch in (None, r["branch"])]

    def assert_close(self, one, other, relative):
        self.assertEqual(len(one), len(other))
        scale = max(abs(x) for x in other)
        for a, b in zip(one, other):
            self.assertAlmostEqual(a / scale, b / scale, delta=relative)


class Bars(DispersionTest):
    def test_waves_of_a_bar_are_the_closed_form(self):
        run = self.run_case(BAR, "--set", "analysis.dispersion.time_step=1.0e-6", "--set",
                            "analysis.dispersion.finite_difference=0.5")
        self.assertEqual(sorted(p.name for p in (self.folder / "out/bar").iterdir()),
                         ["bands.csv", "dispersion.csv", "summary.json"])
        table = self.table("bar")
        self.assertEqual(list(table[0]), ["k_x", "branch", "angular_frequency", "phase_velocity", "group_velocity",
                                          "classical_angular_frequency", "continuum_angular_frequency",
                                          "stepped_angular_frequency", "finite_difference_angular_frequency"])
        self.assertEqual(len(table), 101)
        for i, row in enumerate(table):
            k = i / 100 * math.pi  # times the spacing
            omega = math.sqrt(bar_squared(k, 3)) * SPEED / 0.01
            value = {name: float(text) for name, text in row.items() if name != "branch"}
            self.assertEqual(row["branch"], "P")
            self.assertAlmostEqual(value["k_x"] * 0.01, k, delta=1e-13)
            self.assertAlmostEqual(value["angular_frequency"] / SPEED, omega / SPEED, delta=1e-10 * 200)
            self.assertAlmostEqual(value["classical_angular_frequency"], SPEED * k / 0.01, delta=1e-8)
            if i == 0:
                limit = math.sqrt(4 / 3)  # the end bonds count in full: sqrt(1 + 1/N)
                self.assertAlmostEqual(value["phase_velocity"] / SPEED, limit, delta=1e-12)
                self.assertAlmostEqual(value["group_velocity"] / SPEED, limit, delta=1e-12)
                continue
            slope = 2 / 9 * sum(math.sin(j * k) for j in range(1, 4)) / math.sqrt(bar_squared(k, 3))
            self.assertAlmostEqual(value["phase_velocity"] / SPEED, math.sqrt(bar_squared(k, 3)) / k, delta=1e-11)
            self.assertAlmostEqual(value["group_velocity"] / SPEED, abs(slope), delta=1e-10)
            # (4/delta^2) int_0^delta (1 - cos kr)/r dr by Simpson's rule, exact to 1e-10 of it with 400 panels
            panels = 400
            parts = [(1 - math.cos(k * r)) / r if r > 0 else 0.0 for r in (3 * j / panels for j in range(panels + 1))]
            integral = (parts[0] + parts[-1] + 4 * sum(parts[1:-1:2]) + 2 * sum(parts[2:-1:2])) * 3 / panels / 3
            self.assertAlmostEqual(value["continuum_angular_frequency"] / (SPEED / 0.01), math.sqrt(4 / 9 * integral),
                                   delta=1e-8)
            self.assertAlmostEqual(value["stepped_angular_frequency"] * 1e-6, 2 * math.asin(omega * 1e-6 / 2), delta=1e-10)
            step = 0.5 * 0.01 / SPEED
            self.assertAlmostEqual(value["finite_difference_angular_frequency"] * step,
                                   2 * math.asin(0.5 * math.sin(k / 2)), delta=1e-10)
        for word in ("bar, spacing 0.01 m, horizon 0.03 m: 6 bonds per particle in 3 orbits", "constant", "1.154701",
                     "stable step", "within 5 % to k", "time step"):
            self.assertIn(word, run.stdout)

    def test_newmark_shifts_the_other_way(self):
        self.run_case(BAR, "--set", "analysis.dispersion.time_step=1.0e-6", "--set",
                      "analysis.dispersion.integrator=newmark")
        for row in self.table("bar"):
            self.assertAlmostEqual(float(row["stepped_angular_frequency"]) * 1e-6,
                                   2 * math.atan(float(row["angular_frequency"]) * 1e-6 / 2), delta=1e-10)

    def test_bands_of_two_neighbours(self):
        self.run_case(BAR, "--set", "body.horizon.ratio=2")
        band = self.summary("bar")["bands"][0]
        unit = SPEED / 0.01
        self.assertAlmostEqual(band["long_wave_ratio"], math.sqrt(1.5), delta=1e-10)
        self.assertEqual(len(band["crossings"]), 1)
        low, high = 0.5, 1.8  # the root of omega(k) = k
        while high - low > 1e-14:
            middle = (low + high) / 2
            low, high = (middle, high) if bar_squared(middle, 2) > middle**2 else (low, middle)
        self.assertAlmostEqual(band["crossings"][0] / unit, low, delta=1e-9)
        self.assertAlmostEqual(band["cut_off"] / unit, 1.5, delta=1e-9)  # omega^2 = 9/4 - (cos k + 1/2)^2
        self.assertAlmostEqual(band["cut_off_k"] * 0.01, 2 * math.pi / 3, delta=1e-6)  # flat there
        self.assertEqual(band["band_k"], 0.0)  # long waves are 22 % too fast
        zone = self.summary("bar")["zone"]
        self.assertAlmostEqual(zone["omega_max"] / unit, 1.5, delta=1e-10)
        self.assertAlmostEqual(zone["stable_step"] * zone["omega_max"], 2.0, delta=1e-12)
        self.assertGreater(zone["least_squared"], 0.0)
        row = self.table("bar", "bands.csv")[0]
        self.assertEqual((row["corner_x"], row["branch"]), ("1", "P"))
        self.assertEqual(float(row["cut_off"]), band["cut_off"])
        self.assertEqual([float(c) for c in row["crossings"].split(";")], band["crossings"])

    def test_methods_of_one_dimension(self):
        # [alebrahim2021] table 1 to the digits computed from its equations with the constraint exact
        known = {"point_collocation": [10.540805, -5.551652, 1.687500], "subdomain_collocation": [8.808243, -3.338446, 0.789550],
                 "galerkin": [9.078276, -4.343448, 1.369540], "least_squares": [9.122688, -4.698741, 1.591598]}
        for method, alpha in known.items():
            run = self.run_case(BAR, "--force", "--set", "analysis.dispersion.optimise.method=" + method)
            self.assert_close(self.summary("bar")["optimised"]["alpha"], alpha, 1e-7)
            self.assertIn(method, run.stdout)
        ratio = self.summary("bar")["certificate"]["ratio"]["l1"]
        self.assertAlmostEqual(ratio, 0.0832394039, delta=1e-8)


class Plates(DispersionTest):
    def test_waves_of_a_plate_are_the_symbol(self):
        self.run_case(PLATE)
        table = self.table("plate")
        self.assertEqual(list(table[0])[:4], ["k_x", "k_y", "branch", "angular_frequency"])
        self.assertEqual(len(table), 2 * 61)
        for p, s in zip(table[::2], table[1::2]):
            self.assertEqual((p["branch"], s["branch"]), ("P", "S"))
            found = sorted(float(r["angular_frequency"]) ** 2 for r in (p, s))
            self.assert_close([*found, 3.0], [*plate_squared(float(p["k_x"]), float(p["k_y"]), [1, 1, 1]), 3.0], 1e-12)

    def test_long_waves_of_the_original_lattices(self):
        # speeds over the classical ones along the axis and the diagonal, [alebrahim2021] eqs. (21)-(28)
        known = {2: [1.0862820709, 0.8217282015, 0.9631318639, 1.1968268412],
                 3: [1.0260450663, 1.0025590655, 1.0143700404, 1.0375887321],
                 4: [0.9870783572, 0.9626219416, 0.9749268397, 0.9990820905]}
        for ratio, speeds in known.items():
            self.run_case(PLATE, "--force", "--set", f"body.horizon.ratio={ratio}")
            bands = self.summary("plate")["bands"]
            self.assertEqual([(b["corner"], b["branch"]) for b in bands],
                             [([1, 0], "P"), ([1, 0], "S"), ([1, 1], "P"), ([1, 1], "S")])
            self.assert_close([b["long_wave_ratio"] for b in bands], speeds, 1e-9)

    def test_a_path_of_ones_own_and_the_zone(self):
        self.run_case(PLATE, "--set", "analysis.dispersion.path=[[0.5, 0.25], [1, 0.5]]", "--set",
                      "analysis.dispersion.zone=5", "--set", "analysis.dispersion.polar={ wave_number: 0.5, directions: 8 }")
        table = self.table("plate")
        self.assertAlmostEqual(float(table[0]["k_x"]), math.pi / 2, delta=1e-12)
        self.assertAlmostEqual(float(table[-1]["k_y"]), math.pi / 2, delta=1e-12)
        self.assertEqual(len(self.summary("plate")["bands"]), 2)  # both corners lie on one line
        zone = self.table("plate", "zone.csv")
        self.assertEqual(len(zone), 2 * 25)
        for p, s in zip(zone[::2], zone[1::2]):
            found = sorted(float(r["angular_frequency"]) ** 2 for r in (p, s))
            self.assert_close([*found, 3.0], [*plate_squared(float(p["k_x"]), float(p["k_y"]), [1, 1, 1]), 3.0], 1e-12)
        polar = self.table("plate", "polar.csv")
        self.assertEqual(len(polar), 16)
        for p, s in zip(polar[::2], polar[1::2]):
            kx, ky = (math.pi / 2 * f(float(p["angle"])) for f in (math.cos, math.sin))
            found = sorted(float(r["angular_frequency"]) ** 2 for r in (p, s))
            self.assert_close([*found, 3.0], [*plate_squared(kx, ky, [1, 1, 1]), 3.0], 1e-12)
            self.assertAlmostEqual(float(p["phase_velocity"]) * math.pi / 2, float(p["angular_frequency"]), delta=1e-12)

    def test_the_quadratic_programme_and_its_certificate(self):
        run = self.run_case(PLATE, "--set", "analysis.dispersion.optimise={ fit: 3 }", "--set", "material.fracture_energy=1")
        self.assertEqual(sorted(p.name for p in (self.folder / "out/plate").iterdir()),
                         ["bands.csv", "coefficients.csv", "dispersion.csv", "influence.yaml", "optimised.csv", "summary.json"])
        table = self.table("plate", "coefficients.csv")
        self.assertEqual(list(table[0]), ["dx", "dy", "distance", "alpha"])
        self.assertEqual([(r["dx"], r["dy"]) for r in table], [("1", "0"), ("1", "1"), ("2", "0")])
        self.assert_close([float(r["distance"]) for r in table], [1, math.sqrt(2), 2], 1e-15)
        self.assert_close([float(r["alpha"]) for r in table], QP, 1e-10)
        summary = self.summary("plate")
        certificate = summary["certificate"]
        self.assertTrue(certificate["feasible"] and certificate["stable"])
        self.assertLess(certificate["constraint_error"], 1e-12)
        self.assertLess(certificate["optimality"], 1e-9)
        self.assertAlmostEqual(certificate["original"]["l1"], 98.3298129445, delta=1e-8)
        # 1123.5599255 is the original's square error with roots sorted by size, as known numbers were normalised
        self.assertAlmostEqual(certificate["optimised"]["l2"] / 1123.5599255, 0.1995682119, delta=1e-9)
        self.assertAlmostEqual(certificate["ratio"]["l2"] * certificate["original"]["l2"], certificate["optimised"]["l2"],
                               delta=1e-9)
        self.assertAlmostEqual(certificate["ratio"]["l1"], 0.4756786383, delta=1e-9)
        self.assert_close([b["long_wave_ratio"] for b in summary["optimised"]["bands"]], [1, 1, 1, 1], 1e-9)
        stretch = summary["optimised"]["critical_stretch"]
        self.assertAlmostEqual(stretch["original"], math.sqrt(5 * math.pi / 24), delta=1e-12)  # eq. (52)
        self.assertIn("fitted", stretch)
        for word in ("certificate", "contour error", "l1 (eq. 51)", "0.475679", "8.1746376", "influence", "critical stretch",
                     "micromodulus: { kernel: shells, file: out/plate/coefficients.csv }"):
            self.assertIn(word, run.stdout)
        self.assertIn("break_negative", run.stderr)

    def test_bounds(self):
        self.run_case(PLATE, "--set", "analysis.dispersion.optimise.lower_bound=0.5")
        self.assert_close(self.summary("plate")["optimised"]["alpha"], [1.0943951024, 1.4809609794, 0.5], 1e-10)
        self.assertEqual(self.summary("plate")["certificate"]["active"], [2])
        self.write("case.yaml", PLATE)
        run = self.perimode("dispersion", "case.yaml", "--force", "--set", "analysis.dispersion.optimise.lower_bound=0.9")
        line = self.one_error(run, 1, stdout="infeasible")
        # alpha(1,0) + 2 alpha(2,0) = 2.0943951024
        largest = re.search(r"can be met is (\S+); give", line).group(1)
        self.assertAlmostEqual(float(largest), 2.0943951024 / 3, delta=2e-9)
        self.assertEqual(self.summary("plate")["status"], "infeasible")
        self.assertEqual(self.summary("plate")["certificate"]["feasible"], False)
        self.assertAlmostEqual(self.summary("plate")["certificate"]["largest_feasible_bound"], 2.0943951024 / 3, delta=1e-9)
        self.assertFalse((self.folder / "out/plate/coefficients.csv").exists())
        # The bound the message names can be met.
        run = self.perimode("dispersion", "case.yaml", "--force", "--set", f"analysis.dispersion.optimise.lower_bound={largest}")
        self.assertEqual(run.returncode, 0, run.stderr)

    def test_a_bar_has_no_waves_of_s_to_weigh(self):
        self.write("case.yaml", BAR)
        line = self.one_error(self.perimode("dispersion", "case.yaml", "--set", "analysis.dispersion.optimise={ weights: [0, 1] }"), 2)
        self.assertIn("a weight > 0 of P", line)
        self.assertIn("got [0, 1]", line)

    def test_what_is_left_aside_is_told(self):
        run = self.run_case(PLATE.replace("periodic: [x, y]", "precracks: [ { from: [0, 4], to: [2, 4] } ]"))
        self.assertIn("left aside       pre-cracks", run.stdout)

    def test_check_says_what_would_be_calculated(self):
        self.write("case.yaml", PLATE)
        run = self.good("check", "case.yaml", "--set", "analysis.dispersion.optimise={}")
        for word in ("reads well", "dispersion\n", "plane strain", "12 bonds per particle in 3 orbits", "61 points along (0, 0) - ",
                     "101 points per axis", "3 coefficients"):
            self.assertIn(word, run.stdout)
        self.assertNotIn("modes", run.stdout)
        self.assertEqual(self.files(), ["case.yaml"])

    def test_a_new_case_runs(self):
        printed = self.good("new", "dispersion").stdout
        self.good("new", "dispersion", "mine.yaml")
        self.assertEqual((self.folder / "mine.yaml").read_text(), printed)
        self.good("dispersion", "mine.yaml")
        self.assertIn("Example: perimode dispersion", self.good("dispersion", "--help").stdout)

    def test_running_twice_gives_the_same_bytes(self):
        found = set()
        for threads in ("1", "2"):
            self.run_case(PLATE, "--force", "--threads", threads, "--set", "analysis.dispersion.optimise={ norm: l1, fit: 2 }")
            found.add(b"".join((self.folder / "out/plate" / name).read_bytes() for name in (
                "dispersion.csv", "bands.csv", "coefficients.csv", "optimised.csv", "influence.yaml")))
        self.assertEqual(len(found), 1)


class Tables(DispersionTest):
    """What one analysis makes the others take."""

    def setUp(self):
        super().setUp()
        self.run_case(PLATE, "--set", "analysis.dispersion.optimise={ fit: 3 }")
        self.shells = PLATE.replace("  density: 1\n", "  density: 1\n  micromodulus: { kernel: shells, file: out/plate/coefficients.csv }\n"
                                    ).replace("out/plate }", "out/shells }")

    def test_the_table_has_the_waves_it_was_made_for(self):
        self.run_case(self.shells, name="shells.yaml")
        for column in ("angular_frequency", "group_velocity"):
            self.assert_close(self.numbers("shells", column), self.numbers("plate", column, "optimised.csv"), 1e-13)
        self.assertTrue(all(r["continuum_angular_frequency"] == "" for r in self.table("shells")))

    def test_the_influence_function_has_nearly_the_same_waves(self):
        # three cosines pass through three orbits; what is left is the conditioning of that fit
        snippet = (self.folder / "out/plate/influence.yaml").read_text()
        self.assertTrue(all(line.startswith(("#", " ", "micromodulus:")) for line in snippet.splitlines()))
        pasted = "".join("  " + line + "\n" for line in snippet.splitlines())
        self.run_case(PLATE.replace("  density: 1\n", "  density: 1\n" + pasted).replace("out/plate }", "out/fourier }"),
                      name="fourier.yaml")
        self.assertEqual(self.summary("fourier")["kernel"], "fourier")
        self.assert_close(self.numbers("fourier", "angular_frequency"),
                          self.numbers("plate", "angular_frequency", "optimised.csv"), 1e-7)

    def test_modes_of_the_periodic_plate_are_the_symbol(self):
        self.write("shells.yaml", self.shells)
        self.good("modal", "shells.yaml", "--set", "analysis.modal={ modes: 128, solver: dense }")
        found = sorted(float(r["eigenvalue"]) for r in self.table("shells", "modes.csv"))
        exact = sorted(w for x in range(8) for y in range(8) for w in plate_squared(math.pi * x / 4, math.pi * y / 4, QP))
        self.assert_close(found, exact, 1e-9)  # digits of QP

    def test_a_static_and_a_transient_run(self):
        held = self.shells.replace("periodic: [x, y]", "periodic: [y]").replace(
            "analysis:\n", "boundary: [ { fix: [x, y], at: { face: x-, layers: 2 } } ]\nanalysis:\n").replace(
                "youngs_modulus: 1", "youngs_modulus: 100")
        self.write("held.yaml", held)
        self.good("static", "held.yaml", "--set", "analysis.static={ loads: [ { traction: [1, 0], at: { face: x+, layers: 1 } } ] }")
        summary = self.summary("shells")
        self.assertEqual(summary["status"], "done")
        self.assertAlmostEqual(summary["strain_energy"] / summary["external_work"], 1.0, delta=1e-9)
        self.good("transient", "held.yaml", "--force", "--set",
                  "analysis.transient={ end: 2, loads: [ { traction: [1, 0], at: { face: x+, layers: 1 } } ] }")
        summary = self.summary("shells")
        self.assertEqual(summary["status"], "done")
        self.assertLess(summary["balance"], 1e-10)

    def test_a_table_of_another_horizon_is_refused(self):
        self.write("shells.yaml", self.shells)
        line = self.complaint(self.perimode("dispersion", "shells.yaml", "--set", "body.horizon.ratio=3"))
        self.assertIn("coefficients.csv: expected a line for each of the 6 orbits", line)
        line = self.complaint(self.perimode("dispersion", "shells.yaml", "--set", "body.horizon.ratio=1"))
        self.assertIn("coefficients.csv:3:1: expected one of the 1 orbits", line)


class Spectra(DispersionTest):
    def test_the_ridge_of_a_run_is_the_stepped_curve(self):
        bar = BAR.replace("upper: [1], spacing: 0.01", "upper: [0.32], spacing: 0.01").replace(
            "  horizon: { ratio: 3 }\n", "  horizon: { ratio: 3 }\n  periodic: [x]\n").replace(
                "  dispersion: { points: 101 }\n", "  transient: { dt: 1.0e-6, end: 5.11e-4, fields_every: 1,\n"
                '    initial: { displacement: ["1.0e-6*exp(-2.0e+4*(x-0.105)^2)"] } }\n'
                "  dispersion: { time_step: 1.0e-6, spectrum: { run: out/run } }\n")
        self.write("case.yaml", bar)
        self.good("transient", "case.yaml", "--output", "out/run")
        run = self.good("dispersion", "case.yaml")
        self.assertIn("spectrum", run.stdout)
        ridge = self.table("bar", "ridge.csv")
        self.assertEqual(list(ridge[0]), ["k_x", "path_length", "branch", "angular_frequency", "amplitude",
                                          "symbol_angular_frequency", "stepped_angular_frequency"])
        self.assertEqual(len(ridge), 17)
        spectrum = self.summary("bar")["spectrum"]
        self.assertEqual(spectrum["instants"], 512)
        heard = [r for r in ridge[2:] if r["angular_frequency"]]
        self.assertGreater(len(heard), 8)
        for row in heard:  # a tenth of a bin: what leaks over from the wave's mirror image, and close frequencies
            self.assertAlmostEqual(float(row["angular_frequency"]), float(row["stepped_angular_frequency"]),
                                   delta=0.1 * spectrum["resolution"])
        self.assertEqual(len(self.table("bar", "spectrum.csv")), 17 * 257)

    def test_a_run_that_is_not_there(self):
        self.write("case.yaml", PLATE)
        line = self.complaint(self.perimode("dispersion", "case.yaml", "--set", "analysis.dispersion.spectrum.run=out/no"))
        self.assertIn("result folder of a transient run, got no folder out/no", line)
        self.assertEqual(self.files(), ["case.yaml"])


class Clouds(DispersionTest):
    def test_a_regular_cloud_has_the_waves_of_its_lattice_and_no_spread(self):
        self.write("cloud.csv", cloud_csv(8, 7))
        run = self.run_case(CLOUD, "--set", "analysis.dispersion.waves=3")
        table = self.table("cloud")
        self.assertEqual(len(table), 2 * 2 * 3)
        self.assertEqual(list(table[0])[-2:], ["spread", "residual"])
        self.assertEqual(self.summary("cloud")["particles"], 56)
        lattice = CLOUD.replace("{ file: cloud.csv, period: [0.8, 0.7] }", "{ grid: { lower: [0, 0], upper: [0.8, 0.7], spacing: 0.1 } }")
        self.write("grid.yaml", lattice)
        self.good("dispersion", "grid.yaml", "--output", "out/grid", "--set", "analysis.dispersion={ path: [[0, 0], [0.75, 0]], points: 4 }")
        exact = [float(r["angular_frequency"]) for r in self.table("grid")][2:]
        self.assert_close([float(r["angular_frequency"]) for r in table[:6]], exact, 1e-10)
        for row in table:
            self.assertLess(float(row["spread"]), 1e-7 * float(row["angular_frequency"]))
        for word in ("56 particles", "spread", "Rayleigh"):
            self.assertIn(word, run.stdout)
        run = self.good("check", "case.yaml")
        self.assertIn("along x", run.stdout)

    def test_a_cloud_without_bonds_is_refused_at_its_body(self):
        self.write("cloud.csv", cloud_csv(8, 7))
        for command in ("dispersion", "check"):
            self.write("case.yaml", re.sub(r"horizon: .*", "horizon: { length: 0.05 }", CLOUD))
            line = self.one_error(self.perimode(command, "case.yaml"), 2)
            self.assertIn("bonds between the particles", line)
            self.assertIn("case.yaml:", line)
        self.assertFalse((self.folder / "out/cloud").exists())

    def test_a_cloud_with_a_surface_is_refused(self):
        self.write("cloud.csv", cloud_csv(8, 7))
        self.write("case.yaml", CLOUD.replace("  periodic: [x, y]\n", ""))
        for command in ("dispersion", "check"):
            self.assertIn("periodic", self.complaint(self.perimode(command, "case.yaml")))
        self.assertEqual(self.files(), ["case.yaml", "cloud.csv"])


SECTION = "  dispersion: %s"
# name: base, new section with ^ where the error is, words of the message
CASES = {
    "path of one point": (PLATE, "{ path: ^[[0, 0]] }", "at least 2 points"),
    "path that stands": (PLATE, "{ path: [[0, 0], ^[0, 0]] }", "other than the one before"),
    "method of 1D": (PLATE, "{ optimise: { method: ^galerkin } }", "least_squares in 2D"),
    "l1 with equations": (BAR, "{ optimise: { method: galerkin, norm: ^l1 } }", "l2 with a method of equations"),
    "negative weights": (PLATE, "{ optimise: { weights: [1, ^-1] } }", "number >= 0"),
    "more cosines than can be fitted": (PLATE, "{ optimise: { fit: ^6 } }", "6"),
    "optimise a cloud": (CLOUD, "{ ^optimise: {} }", "no `optimise` with a cloud"),
    "zone of a cloud": (CLOUD, "{ ^zone: 10 }", "no `zone` with a cloud"),
    "polar of a cloud": (CLOUD, "{ ^polar: { wave_number: 1 } }", "no `polar` with a cloud"),
    "path of a cloud": (CLOUD, "{ ^path: [[0, 0], [1, 0]] }", "no `path` with a cloud"),
}


class BadCases(ProgramTest):
    def test_a_case_without_a_dispersion_section(self):
        self.write("case.yaml", PLATE[: PLATE.index("analysis:")])
        self.assertIn("analysis.dispersion", self.complaint(self.perimode("dispersion", "case.yaml")))


def make_test(name, base, section, words):
    def test(self):
        text = base.replace("analysis: { dispersion: {} }", "analysis:\n  dispersion: {}")
        lines = [SECTION % section if line.startswith("  dispersion:") else line for line in text.splitlines()]
        text = "\n".join(lines) + "\n"
        before = text[: text.index("^")]
        place = (before.count("\n") + 1, len(before) - before.rfind("\n"))
        self.write("case.yaml", text.replace("^", ""))
        self.write("cloud.csv", cloud_csv(8, 7))
        files = self.files()
        line = self.complaint(self.perimode("dispersion", "case.yaml"))
        self.assertIn(words, line)
        self.assertIn("case.yaml:%d:%d: " % place, line)
        self.assertEqual(self.files(), files, "nothing is written")

    test.__name__ = "test_" + "".join(c if c.isalnum() else "_" for c in name)
    setattr(BadCases, test.__name__, test)


for case_name, row in CASES.items():
    make_test(case_name, *row)

if __name__ == "__main__":
    main()
