# SPDX-License-Identifier: BSD-3-Clause
"""perimode static: files, numbers, and every kind of bad input."""
import json

from program import ProgramTest, cloud_csv, main, rows

PLATE = """\
title: plate
body:
  dimension: 2
  plane: stress
  thickness: 0.01
  particles: { grid: { lower: [0, 0], upper: [1, 0.5], spacing: 0.05 } }
  horizon: { ratio: 3 }
material:
  youngs_modulus: 210.0e+9
  density: 7850
  volume_correction: linear
boundary:
  - { fix: [x, y], at: { face: x-, layers: 2 } }
analysis:
  static:
    loads:
      - { traction: [1.0e+6, -2.0e+5], at: { face: x+, layers: 1 }, time: { ramp: 1.0 } }
output: { directory: out/plate, fields: [displacement, damage, strain, stress, energy] }
"""

BAR = """\
title: bar
body:
  dimension: 1
  area: 1.0e-4
  particles: { grid: { lower: [0], upper: [1], spacing: 0.01 } }
  horizon: { ratio: 3 }
material: { youngs_modulus: 68.0e+9, density: 2700, volume_correction: linear }
boundary:
  - { fix: [x], at: { face: x-, layers: 3 } }
  - { prescribe: { x: 1.0e-4 }, at: { face: x+, layers: 3 } }
analysis: { static: {} }
output: { directory: out/bar }
"""

CLOUD = """\
title: cloud
body:
  dimension: 2
  particles: { file: cloud.csv }
  horizon: { length: 0.25 }
material: { youngs_modulus: 210.0e+9, density: 7850 }
boundary:
  - { fix: [x, y], at: { face: x-, depth: 0.05 } }
analysis: { static: { loads: [ { force: [0, -3], at: { block: core } } ] } }
output: { directory: out/cloud }
"""

FILES = ["fields.exo", "reactions.csv", "summary.json"]


class Results(ProgramTest):
    def run_case(self, text, *options):
        self.write("case.yaml", text)
        return self.good("static", "case.yaml", *options)

    def summary(self, name):
        return json.loads((self.folder / "out" / name / "summary.json").read_text())

    def test_files_reactions_and_summary(self):
        run = self.run_case(PLATE)
        self.assertEqual(sorted(p.name for p in (self.folder / "out/plate").iterdir()), FILES)
        table = rows(self.folder / "out/plate/reactions.csv")
        self.assertEqual(list(table[0]), ["region", "force_x", "force_y"])
        self.assertEqual([r["region"] for r in table], ["fix x-"])
        self.assertAlmostEqual(float(table[0]["force_x"]), -1e6 * 0.5 * 0.01, delta=1e-6)
        self.assertAlmostEqual(float(table[0]["force_y"]), 2e5 * 0.5 * 0.01, delta=1e-6)
        summary = self.summary("plate")
        for key in ("analysis", "title", "particles", "bonds", "dofs", "engine", "solver", "reason", "status", "timings_s",
                    "peak_memory_mb", "threads", "version", "strain_energy", "external_work", "residual", "iterations",
                    "balance", "reactions", "rigid_modes"):
            self.assertIn(key, summary)
        self.assertEqual(summary["analysis"], "static")
        self.assertEqual(summary["status"], "done")
        self.assertEqual(summary["particles"], 200)
        self.assertEqual(summary["dofs"], 360)
        self.assertLess(summary["residual"], 1e-8)
        self.assertLess(summary["balance"], 1e-10)
        self.assertAlmostEqual(summary["strain_energy"] / summary["external_work"], 1.0, delta=1e-9)
        self.assertEqual(summary["reactions"][0]["region"], "fix x-")
        for word in ("200 particles", "cholesky", "residual", "fix x-", "balance", "strain energy", "displacement"):
            self.assertIn(word, run.stdout)

    def test_a_bar_pulled_by_a_traction_lengthens_as_hooke_says(self):
        pulled = BAR.replace("  - { prescribe: { x: 1.0e-4 }, at: { face: x+, layers: 3 } }\n", "").replace(
            "static: {}", "static: { loads: [ { traction: [1.0e+6], at: { face: x+, layers: 1 } } ] }")
        self.run_case(pulled)
        summary = self.summary("bar")
        # U = sigma^2 A L / (2 E), but for the two ends: the held layers do not stretch, free ends are softer.
        hooke = 1e6 ** 2 * 1e-4 * 1.0 / (2 * 68e9)
        self.assertAlmostEqual(summary["strain_energy"] / hooke, 1.0, delta=0.03)

    def test_a_prescribed_bar_needs_no_loads(self):
        run = self.run_case(BAR)
        table = rows(self.folder / "out/bar/reactions.csv")
        self.assertEqual([r["region"] for r in table], ["fix x-", "prescribe x+"])
        force = float(table[1]["force_x"])
        self.assertAlmostEqual(float(table[0]["force_x"]), -force, delta=1e-9 * force)
        # E A times the strain of the 94 free particles and the half cells next to them
        self.assertAlmostEqual(force / (68e9 * 1e-4 * 1e-4 / 0.95), 1.0, delta=0.03)
        self.assertIn("at most 1.000000e-04 m", run.stdout)

    def test_a_cloud(self):
        self.write("cloud.csv", cloud_csv())
        self.run_case(CLOUD)
        table = rows(self.folder / "out/cloud/reactions.csv")
        self.assertAlmostEqual(float(table[0]["force_y"]), 3.0, delta=1e-9)
        self.assertLess(self.summary("cloud")["balance"], 1e-10)

    def test_a_free_body_under_loads_in_equilibrium(self):
        free = PLATE.replace("boundary:\n  - { fix: [x, y], at: { face: x-, layers: 2 } }\n", "").replace(
            "- { traction: [1.0e+6, -2.0e+5], at: { face: x+, layers: 1 }, time: { ramp: 1.0 } }",
            "- { traction: [1.0e+6, 0], at: { face: x+, layers: 1 } }\n"
            "      - { traction: [-1.0e+6, 0], at: { face: x-, layers: 1 } }")
        run = self.run_case(free)
        self.assertIn("3 rigid motions", run.stderr)
        self.assertIn("projected out", run.stdout)
        self.assertEqual(self.summary("plate")["rigid_modes"], 3)
        self.assertEqual(self.summary("plate")["reactions"], [])
        self.assertEqual((self.folder / "out/plate/reactions.csv").read_text(), "region,force_x,force_y\n")

    def test_solvers_agree(self):
        energies = []
        for solver in ("auto", "cholesky", "multigrid", "jacobi", "lu"):
            self.run_case(PLATE, "--force", "--set", "analysis.static.solver=" + solver, "--set",
                          "analysis.static.tolerance=1e-11")
            energies.append(self.summary("plate")["strain_energy"])
        for energy in energies[1:]:
            self.assertAlmostEqual(energy / energies[0], 1.0, delta=1e-9)

    def test_running_twice_gives_the_same_bytes(self):
        found = set()
        for _ in range(2):
            self.run_case(PLATE, "--force", "--threads", "1")
            found.add((self.folder / "out/plate/reactions.csv").read_bytes() +
                      (self.folder / "out/plate/fields.exo").read_bytes())
        self.assertEqual(len(found), 1)

    def test_fields_are_those_asked_for(self):
        self.run_case(PLATE)
        full = (self.folder / "out/plate/fields.exo").read_bytes()
        for name in (b"displacement_x", b"strain_xy", b"stress_yy", b"energy", b"damage"):
            self.assertIn(name, full)
        self.run_case(PLATE, "--force", "--set", "output.fields=[displacement]")
        short = (self.folder / "out/plate/fields.exo").read_bytes()
        for name in (b"strain_xy", b"stress_yy", b"energy", b"damage"):
            self.assertNotIn(name, short)

    def test_iterations_on_a_mechanism_end_in_one_error_and_leave_nothing(self):
        # Nearest neighbours only, the fourth column free to slide: conjugate gradients would find no end.
        text = PLATE.replace("ratio: 3", "ratio: 1").replace("  volume_correction: linear\n", "").replace(
            "  - { fix: [x, y], at: { face: x-, layers: 2 } }",
            "  - { fix: [x, y], at: { face: x-, layers: 2 } }\n"
            "  - { fix: [y], at: { box: { lower: [0, 0], upper: [0.5, 0.05] } } }\n"
            "  - { fix: [y], at: { box: { lower: [0.55, 0], upper: [1, 0.05] } } }").replace(
            "    loads:\n", "    solver: jacobi\n    loads:\n      - { body_force: [0, 1.0e+3] }\n")
        for solver in ("jacobi", "multigrid", "cholesky"):
            self.write("case.yaml", text.replace("solver: jacobi", "solver: " + solver))
            run = self.perimode("static", "case.yaml", "--quiet")
            self.assertIn("stretches no bond", self.complaint(run))
            self.assertEqual(self.files(), ["case.yaml"])

    def test_check_prints_the_plan(self):
        self.write("case.yaml", PLATE)
        run = self.good("check", "case.yaml")
        for word in ("reads well", "static", "particles        200", "solver           cholesky: ", "memory"):
            self.assertIn(word, run.stdout)
        self.assertNotIn("modes", run.stdout)
        self.assertEqual(self.files(), ["case.yaml"])
        self.good("check", "case.yaml", "--set", "analysis.modal.modes=3")

    def test_a_new_case_runs(self):
        printed = self.good("new", "static").stdout
        self.good("new", "static", "mine.yaml")
        self.assertEqual((self.folder / "mine.yaml").read_text(), printed)
        self.good("check", "mine.yaml")
        run = self.good("static", "mine.yaml", "--set", "body.particles.grid.spacing=0.01")
        self.assertIn("fix x-", run.stdout)
        self.assertIn("Example: perimode static", self.good("static", "--help").stdout)


LOADS = "    loads: [ %s ]"
# name: base, line to replace (by its first word), new line with ^ where the error is, words of the message
CASES = {
    "no loads section": (PLATE, "static", "    ^load: []", "loads"),
    "unknown load": (PLATE, "loads", LOADS % "{ ^pressure: [1, 0], at: { face: x+, layers: 1 } }", "traction"),
    "load of no kind": (PLATE, "loads", LOADS % "^{ at: { face: x+, layers: 1 } }", "traction, body_force, force"),
    "load of two kinds": (PLATE, "loads", LOADS % "{ force: [1, 0], ^body_force: [1, 0] }", "both"),
    "components": (PLATE, "loads", LOADS % "{ traction: ^[1], at: { face: x+, layers: 1 } }", "2 numbers in Pa"),
    "force of three components": (PLATE, "loads", LOADS % "{ force: ^[1, 0, 0] }", "2 numbers in N"),
    "component with a unit": (PLATE, "loads", LOADS % "{ force: [^1 kN, 0] }", "units"),
    "traction without a face": (PLATE, "loads", LOADS % "^{ traction: [1, 0] }", "'at'"),
    "traction on a ball": (PLATE, "loads",
                           LOADS % "{ traction: [1, 0], at: ^{ ball: { centre: [0, 0], radius: 1 } } }", "face"),
    "more layers than the body has": (PLATE, "loads",
                                      LOADS % "{ traction: [1, 0], at: ^{ face: x+, layers: 21 } }", "20 layers"),
    "empty region": (PLATE, "loads",
                     LOADS % "{ force: [1, 0], at: ^{ ball: { centre: [7, 7], radius: 1 } } }", "particle"),
    "unknown block": (PLATE, "loads", LOADS % "{ force: [1, 0], at: ^{ block: core } }", "'core'"),
    "unknown time": (PLATE, "loads", LOADS % "{ force: [1, 0], time: { ^rampe: 1 } }", "ramp"),
    "loads that are a map": (PLATE, "loads", "    loads: ^{ force: [1, 0] }", "a list"),
    "unknown solver": (PLATE, "loads", "    solver: ^mumps", "cholesky"),
    "no tolerance": (PLATE, "loads", "    tolerance: ^0", "> 0"),
    "coarse tolerance": (PLATE, "loads", "    tolerance: ^2", "< 1"),
    "nothing loaded": (PLATE, "loads", "    tolerance: 1e-8", "loads or moves"),
    "unsupported": (PLATE, "- { fix", "  - { fix: [x], at: { face: x-, layers: 2 } }", "free translation along y"),
    "multigrid of a cloud": (CLOUD, "analysis",
                             "analysis: { static: { solver: ^multigrid, loads: [ { force: [0, 1] } ] } }", "cloud"),
    "unsymmetric": (PLATE, "- { fix", "  - { wall: x-, type: odd }", "unsymmetric", "solver: cholesky\n    loads"),
}


class BadCases(ProgramTest):
    pass


def make_test(name, base, first_word, new_line, words, loads="loads"):
    def test(self):
        lines = base.replace("loads:", loads + ":").splitlines()
        found = [i for i, line in enumerate(lines) if line.strip().startswith(first_word)]
        end = found[0] + 1
        if first_word in ("loads", "static"):
            while end < len(lines) and lines[end].startswith("     "):
                end += 1
            if first_word == "static":
                found[0] += 1
        lines[found[0]:end] = [new_line]
        text = "\n".join(lines) + "\n"
        place = None
        if "^" in text:
            before = text[: text.index("^")]
            place = (before.count("\n") + 1, len(before) - before.rfind("\n"))
            text = text.replace("^", "")
        self.write("case.yaml", text)
        self.write("cloud.csv", cloud_csv())
        before = self.files()
        for command in ("static", "check"):
            line = self.complaint(self.perimode(command, "case.yaml"))
            self.assertIn(words, line)
            self.assertIn("case.yaml:%d:%d: " % place if place else "case.yaml:", line)
            self.assertEqual(self.files(), before, "nothing is written")

    test.__name__ = "test_" + "".join(c if c.isalnum() else "_" for c in name)
    setattr(BadCases, test.__name__, test)


for case_name, row in CASES.items():
    make_test(case_name, *row)


class Mechanism(ProgramTest):
    def test_bonds_along_the_axes_alone_do_not_hold_the_shape(self):
        text = PLATE.replace("ratio: 3", "ratio: 1").replace("linear", "none").replace("-2.0e+5", "0")
        text = text.replace("  - { fix: [x, y]", "  - { fix: [y], at: { nearest: [0.5, 0.25] } }\n  - { fix: [x]")
        self.write("case.yaml", text)
        line = self.complaint(self.perimode("static", "case.yaml", "--set", "analysis.static.solver=cholesky"))
        self.assertIn("case.yaml:17:5: ", line)
        self.assertIn("hold its shape", line)
        self.assertEqual(self.files(), ["case.yaml"], "nothing is written")


class NoSection(ProgramTest):
    def test_a_case_without_a_static_section(self):
        self.write("case.yaml", PLATE[: PLATE.index("analysis:")])
        self.assertIn("analysis.static", self.complaint(self.perimode("static", "case.yaml")))


if __name__ == "__main__":
    main()
