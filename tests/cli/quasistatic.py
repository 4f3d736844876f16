# SPDX-License-Identifier: BSD-3-Clause
"""perimode quasistatic: files and their columns, numbers against each other, bad input, kills and resumption."""
import json
import math
import random
import signal
import subprocess
import time

import exodus
from program import PROGRAM, STAGE, ProgramTest, main, rows

PLATE = """\
title: plate
body:
  dimension: 2
  plane: stress
  thickness: 0.005
  particles: { grid: { lower: [0, 0], upper: [0.1, 0.05], spacing: 0.005 } }
  horizon: { ratio: 3 }
  precracks: [ { from: [0.05, 0.0], to: [0.05, 0.015] } ]
material: { youngs_modulus: 72.0e+9, density: 2440, calibration: discrete, volume_correction: linear, fracture_energy: 3.8 }
boundary:
  - { fix: [x, y], at: { face: x-, layers: 3 } }
analysis:
  quasistatic:
    loads: [ { traction: [1.0e+6, 0], at: { face: x+, layers: 3 } } ]
    no_fail: [ { face: x-, layers: 5 }, { face: x+, layers: 5 } ]
    solver: update
    fields_every: 10
    checkpoint_every: 10
output: { directory: out/plate, fields: [displacement, damage, energy] }
"""

STEPS = PLATE.replace("    loads: [ { traction: [1.0e+6, 0], at: { face: x+, layers: 3 } } ]\n",
                      "    control: steps\n    steps: 20\n    end: 2\n").replace(
    "analysis:", "  - { prescribe: { x: 2.0e-5 }, at: { face: x+, layers: 3 }, time: { ramp: 2 } }\nanalysis:")

FILES = ["crack_path.csv", "fields.exo", "load_curve.csv", "summary.json"]
CURVE = ["event", "load_factor", "displacement", "stored_energy", "dissipated_energy", "bond_energy_released",
         "external_work", "broken_bonds", "crack_length", "force", "relaxation_energy", "balance", "breaking_bonds",
         "total_force", "mean_displacement"]
START_ALONE = r"\A(\d+ particles, \d+ bonds, \d+ dofs\nsolver  .*\n(rigid motions .*\n)?)?\Z"


class QuasistaticTest(ProgramTest):
    def run_case(self, text, *options, code=0):
        self.write("case.yaml", text)
        run = self.perimode("quasistatic", "case.yaml", *options)
        self.assertEqual(run.returncode, code, run.stderr)
        return run

    @property
    def result(self):
        return self.folder / "out/plate"

    def summary(self):
        return json.loads((self.result / "summary.json").read_text())

    def curve(self):
        return [{key: float(value) for key, value in row.items()} for row in rows(self.result / "load_curve.csv")]


class Results(QuasistaticTest):
    def test_the_template_separates(self):
        self.good("new", "quasistatic", "case.yaml")
        check = self.good("check", "case.yaml")
        for word in ("quasistatic", "solver", "dofs", "memory"):
            self.assertIn(word, check.stdout)
        run = self.good("quasistatic", "case.yaml")
        summary = self.summary()
        self.assertEqual(summary["status"], "separated")
        for word in ("particles", "first failure", "peak", "Griffith", "ended            after", "events: separated, a piece",
                     "J/m2 at load factor 1", "crack length",
                     "energy [J]", "balance", "G0 3.8", "results in"):
            self.assertIn(word, run.stdout)
        # The crack ran through what was left of the plate, a little more than straight on at most.
        self.assertGreater(summary["crack_length"], 0.9 * 0.05)
        self.assertLess(summary["crack_length"], 2.0 * 0.05)
        self.assertEqual(summary["griffith"]["fracture_energy"], 3.8)

    def test_files_and_columns(self):
        self.run_case(PLATE)
        self.assertEqual(sorted(p.name for p in self.result.iterdir()), FILES)
        self.assertEqual(list(rows(self.result / "load_curve.csv")[0]), CURVE)
        path = rows(self.result / "crack_path.csv")
        self.assertEqual(list(path[0]), ["event", "first", "second", "x", "y", "energy"])
        summary, curve = self.summary(), self.curve()
        for key in ("analysis", "title", "particles", "bonds", "dofs", "engine", "solver", "status", "message", "control",
                    "rigid_modes", "events", "first_load", "peak_load", "peak_event", "griffith", "broken_bonds",
                    "initial_crack_length", "crack_length", "energies", "energy_per_area", "worst_balance",
                    "worst_residual", "resumed_from", "ways", "loose_pieces", "timings_s", "peak_memory_mb", "threads", "version"):
            self.assertIn(key, summary)
        self.assertEqual(summary["analysis"], "quasistatic")
        self.assertEqual(summary["events"], len(curve))
        self.assertEqual(summary["first_load"], curve[0]["load_factor"])
        self.assertEqual(summary["peak_load"], max(row["load_factor"] for row in curve))
        self.assertEqual(summary["initial_crack_length"], 0.015)
        self.assertEqual(sum(row["breaking_bonds"] for row in curve), len(path))
        self.assertEqual(summary["broken_bonds"], len(path))
        ways = summary["ways"]
        self.assertEqual(ways["stale"]["solves"] + ways["iterate"]["solves"], 0)
        self.assertGreater(ways["update"]["columns"], 0.9 * len(path))

    def test_rows_tell_the_same_story(self):
        self.run_case(PLATE)
        curve, broken = self.curve(), 0
        path = rows(self.result / "crack_path.csv")
        released = {}
        for bond in path:
            released[int(bond["event"])] = released.get(int(bond["event"]), 0.0) + float(bond["energy"])
        # f of 1 MPa shared by volume over three layers: equal forces on 30 particles
        f = 1e6 / (3 * 0.005) * 0.005**2 * 0.005
        total, length = 0.0, 0.0
        for n, row in enumerate(curve):
            self.assertEqual(row["event"], n + 1)
            self.assertEqual(row["broken_bonds"], broken)
            broken += row["breaking_bonds"]
            self.assertGreaterEqual(row["crack_length"], length)
            length = row["crack_length"]
            self.assertAlmostEqual(row["force"] / (row["load_factor"] * f * math.sqrt(30)), 1.0, delta=1e-12)
            # what to plot: f on each of 30 particles, and the work as it was
            self.assertAlmostEqual(row["total_force"] / (row["load_factor"] * f * 30), 1.0, delta=1e-12)
            self.assertAlmostEqual(row["total_force"] * row["mean_displacement"] / (row["force"] * row["displacement"]), 1.0,
                                   delta=1e-12)
            # Clapeyron at equilibrium: U = load_factor f.u / 2, summed bond by bond on the left
            self.assertAlmostEqual(2.0 * row["stored_energy"] / (row["force"] * row["displacement"]), 1.0, delta=1e-9)
            self.assertLess(abs(row["balance"]), 1e-10 * row["external_work"])
            self.assertAlmostEqual(row["bond_energy_released"], total, delta=1e-12 * max(total, 1e-300))
            total += released[n + 1]
        self.assertEqual(curve[0]["crack_length"], 0.015)

    def test_frames_of_fields(self):
        self.run_case(PLATE)
        file, curve = self.result / "fields.exo", self.curve()
        times = exodus.doubles(exodus.variables(file)["time_whole"])
        events = sorted({1, *range(10, len(curve) + 1, 10), len(curve)})
        self.assertEqual(list(times), events)
        loads = exodus.doubles(exodus.variables(file)["vals_glo_var"])
        self.assertEqual(list(loads), [curve[event - 1]["load_factor"] for event in events])
        self.assertLess(max(exodus.nodal(file, "damage", 1)), max(exodus.nodal(file, "damage", len(events))))

    def test_stops(self):
        run = self.run_case(PLATE, "--set", "analysis.quasistatic.stop.events=7")
        self.assertIn("\nended            after 7 events, as asked\n", run.stdout)
        self.assertEqual(self.summary()["status"], "events")
        self.assertEqual(len(self.curve()), 7)
        self.run_case(PLATE, "--force", "--set", "analysis.quasistatic.stop.load_drop=0.3")
        self.assertEqual(self.summary()["status"], "load_drop")
        curve = self.curve()
        peak = max(row["force"] for row in curve)
        self.assertLess(curve[-1]["force"], 0.7 * peak)
        self.assertGreaterEqual(min(row["force"] for row in curve[:-1]), 0.7 * peak)

    def test_given_motion_is_scaled_where_there_are_no_loads(self):
        self.run_case(STEPS.replace("    control: steps\n    steps: 20\n    end: 2\n", "").replace(", time: { ramp: 2 }", ""))
        curve = self.curve()
        for row in curve[:5]:  # load_factor |g| of 30 particles
            self.assertAlmostEqual(row["displacement"] / (row["load_factor"] * 2e-5 * math.sqrt(30)), 1.0, delta=1e-12)
        self.assertIn(self.summary()["status"], ("separated",))

    def test_steps(self):
        run = self.run_case(STEPS)
        self.assertRegex(run.stdout, r"\nended            after \d+ steps: (done|separated, )")
        table = self.curve()
        self.assertEqual(list(table[0]), [*CURVE, "time", "iterations"])
        self.assertIn(self.summary()["status"], ("done", "separated"))
        for n, row in enumerate(table):
            self.assertAlmostEqual(row["time"], 2.0 * (n + 1) / 20, delta=1e-14)
        self.assertGreater(self.summary()["broken_bonds"], 0)
        self.assertTrue(any(row["breaking_bonds"] > 0 and row["iterations"] > 1 for row in table))
        self.assertIsNone(self.summary()["first_load"])

    def test_steps_break_one_bond_at_a_time_or_all(self):
        """All that are over-stretched at once need fewer solutions."""
        solutions, broken = {}, {}
        for most in ("1", "all"):
            self.run_case(STEPS, "--force", "--set", f"analysis.quasistatic.break_at_once={most}")
            solutions[most] = sum(row["iterations"] for row in self.curve())
            broken[most] = self.summary()["broken_bonds"]
        self.assertGreater(solutions["1"], solutions["all"])
        self.assertGreater(min(broken.values()), 0)
        self.run_case(STEPS, "--force")
        self.assertEqual(self.summary()["broken_bonds"], broken["1"])  # the default

    def test_velocity_is_left_out_with_a_warning(self):
        run = self.run_case(PLATE, "--set", "output.fields=[displacement, velocity]", "--set", "analysis.quasistatic.stop.events=1")
        self.assertIn("no velocity", run.stderr)
        self.assertNotIn("energies do not balance", run.stderr)

    def test_cuts_of_a_bar(self):
        bar = """\
body: { dimension: 1, area: 1.0e-4, particles: { grid: { lower: [0], upper: [1], spacing: 0.05 } }, horizon: { ratio: 2 },
        precracks: [ { at: [0.5] } ] }
material: { youngs_modulus: 70.0e+9, density: 2700, critical_stretch: 1.0e-3 }
boundary: [ { fix: [x], at: { face: x-, layers: 2 } }, { fix: [x], at: { face: x+, layers: 2 } } ]
analysis: { quasistatic: { loads: [ { force: [1.0], at: { nearest: [0.3] } } ], stop: { events: 1 } } }
output: { directory: out/bar }
"""
        self.assertRegex(self.run_case(bar).stdout, r"\ncuts             [0-9.]+, from 1\n")

    def test_threads_and_ways_of_solving_break_the_same_bonds(self):
        found, loads = set(), []
        for solver, threads in (("update", 1), ("update", 2), ("auto", 1), ("stale", 1), ("refactor", 1), ("iterate", 1)):
            self.run_case(PLATE, "--force", "--threads", threads, "--set", f"analysis.quasistatic.solver={solver}", "--set",
                          "analysis.quasistatic.stop.events=60")
            found.add(tuple((row["event"], row["first"], row["second"]) for row in rows(self.result / "crack_path.csv")))
            loads.append([row["load_factor"] for row in self.curve()])
            if solver not in ("auto", "refactor"):
                self.assertGreater(self.summary()["ways"][solver]["solves"], 0)
        self.assertEqual(len(found), 1)
        for other in loads[1:]:  # residuals of 1e-10 times the condition of the body
            for a, b in zip(loads[0], other):
                self.assertAlmostEqual(a / b, 1.0, delta=1e-7)

    def test_a_loose_piece_is_told_and_the_run_goes_on(self):
        run = self.run_case(PLATE)
        self.assertRegex(run.stderr, r"has lost its support and carries load\n")  # it ends the run: not held
        separated = self.summary()
        self.assertEqual(separated["status"], "separated")
        self.assertTrue(separated["loose_pieces"][-1]["loaded"])
        self.run_case(PLATE, "--force", "--set", "analysis.quasistatic.stop.separated=false", "--set",
                      f"analysis.quasistatic.stop.events={separated['events'] + 5}")
        summary = self.summary()
        self.assertEqual(summary["events"], separated["events"] + 5)
        self.assertGreater(len(summary["loose_pieces"]), 0)
        for piece in summary["loose_pieces"]:
            self.assertEqual(sorted(piece), ["centre", "event", "loaded", "particles"])
            self.assertEqual(len(piece["centre"]), 2)


class BadInput(QuasistaticTest):
    def refused(self, words, text, *overrides):
        self.write("case.yaml", text)
        options = [word for override in overrides for word in ("--set", override)]
        run = self.perimode("quasistatic", "case.yaml", *options)
        line = self.one_error(run, 2, START_ALONE)
        for part in ("expected ", ", got ", "; ", *words):
            self.assertIn(part, line)
        self.assertEqual([f for f in self.files() if f.startswith("out")], [])
        return line

    def test_no_support_under_unbalanced_load(self):
        line = self.refused(["equilibrium"], PLATE, "boundary=[]")
        self.assertRegex(line, "fix|boundary|load")

    def test_balanced_load_without_support_is_none(self):
        self.run_case(PLATE.replace("loads: [", "loads: [ { traction: [-1.0e+6, 0], at: { face: x-, layers: 3 } },"), "--set",
                      "boundary=[]", "--set", "analysis.quasistatic.stop.events=3")
        self.assertEqual(self.summary()["rigid_modes"], 3)

    def test_nothing_loads_the_body(self):
        self.refused(["loads or moves the body", "case.yaml:"], PLATE, "analysis.quasistatic.loads=[]")
        self.refused(["loads or moves the body"], PLATE,
                     "analysis.quasistatic.loads=[ { traction: [0, 0], at: { face: x+, layers: 3 } } ]")

    def test_zero_loads_beside_the_griffith_load(self):
        line = self.refused(["loads or moves the body", "analysis.quasistatic.loads"], PLATE,
                            "analysis.quasistatic.loads=[ { traction: [0, 0], at: { face: x+, layers: 3 } } ]",
                            "analysis.quasistatic.griffith=true")
        self.assertNotIn("analysis.static", line)

    def test_a_crack_that_cuts_nothing(self):
        for crack in ("{ from: [0.2, 0], to: [0.2, 0.05] }", "{ from: [0.05, 0], to: [0.05, 1.0e-4] }"):
            line = self.refused(["pre-crack"], PLATE, f"body.precracks=[ {crack} ]")
            self.assertIn("crosses none", line)

    def test_dead_loads_that_break_the_body_alone(self):
        self.refused(["critical stretch at load factor 0", "dead_loads"], PLATE,
                     "analysis.quasistatic.dead_loads=[ { traction: [1.0e+9, 0], at: { face: x+, layers: 3 } } ]")

    def test_given_motion_beside_loads_that_breaks_the_body_alone(self):
        self.refused(["critical stretch at load factor 0", "prescribed"], PLATE,
                     "boundary.1={ prescribe: { y: 1.0e-3 }, at: { face: x+, layers: 3 } }")

    def test_nothing_that_can_break(self):
        self.refused(["fracture_energy", "case.yaml:"], PLATE.replace(", fracture_energy: 3.8", ""))
        self.refused(["no_fail"], PLATE, "analysis.quasistatic.no_fail=[ { box: { lower: [0, 0], upper: [1, 1] } } ]")

    def test_a_region_without_particles(self):
        self.refused(["no_fail", "case.yaml:"], PLATE.replace("{ face: x-, layers: 5 }, ", "{ ball: { centre: [9, 9], radius: 1 } }, "))

    def test_an_unsymmetric_wall(self):
        self.refused(["symmetric boundary", "surface_nodes"], PLATE, "boundary.1={ wall: y+, type: surface_nodes }")

    def test_keys_of_steps_in_event_control(self):
        for key, value in (("steps", "10"), ("end", "1.0"), ("break_at_once", "3")):
            self.refused([f"no `{key}` with event control", "control: steps"], PLATE, f"analysis.quasistatic.{key}={value}")

    def test_functions_of_time_in_event_control(self):
        self.refused(["control: steps", "case.yaml:"], PLATE.replace("layers: 3 } } ]", "layers: 3 }, time: { ramp: 1 } } ]"))
        self.refused(["act in full"], PLATE, "analysis.quasistatic.dead_loads=[ { force: [1, 0], time: { ramp: 1 } } ]")
        self.refused(["control: steps"], PLATE, "boundary.1={ prescribe: { y: 0.0 }, at: { face: y+, layers: 1 }, time: { ramp: 1 } }")

    def test_large_rotations(self):
        self.refused(["kinematics: linear"], PLATE, "kinematics=large_rotation")

    def test_no_section(self):
        self.refused(["analysis.quasistatic"], PLATE[:PLATE.index("  quasistatic:")] + "  modal:\n")


class Unfinished(QuasistaticTest):
    """Runs that did not come to their end, and what the next one makes of them."""

    RUN_AGAIN = ("timings_s", "peak_memory_mb", "ways", "factor_seconds", "resumed_from")  # differ from run to run

    def left(self, folder):
        """Everything of a result that has to be the same."""
        self.assertEqual(sorted(p.name for p in folder.iterdir()), FILES)
        summary = json.loads((folder / "summary.json").read_text())
        for key in self.RUN_AGAIN:
            summary.pop(key)
        return ((folder / "load_curve.csv").read_bytes(), (folder / "crack_path.csv").read_bytes(),
                exodus.variables(folder / "fields.exo"), summary)

    def start(self, *arguments):
        return subprocess.Popen([PROGRAM, "quasistatic", "case.yaml", "--threads", "1", "--quiet", *arguments],
                                cwd=self.folder, stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL,
                                stderr=subprocess.PIPE, text=True)

    def have_checkpoint(self):
        return any((self.folder / "out/plate.unfinished" / name).exists()
                   for name in ("checkpoint.h5", "checkpoint.previous.h5"))

    def test_kills_change_no_byte(self):
        """Checkpoints at the same events: a resumed run makes fresh factors where the whole one does."""
        for control, text in (("event", PLATE), ("steps", STEPS.replace("checkpoint_every: 10", "checkpoint_every: 3"))):
            with self.subTest(control):
                self.write("case.yaml", text)
                began = time.monotonic()
                run = self.start("--output", "out/whole", "--force")
                self.assertEqual(run.wait(timeout=300), 0, run.stderr.read())
                run.stderr.close()
                seconds, expected = time.monotonic() - began, self.left(self.folder / "out/whole")
                chance, resumed, kills = random.Random(control), 0, 0
                while kills < 8:
                    more = ["--resume"] if self.have_checkpoint() else []
                    resumed += bool(more)
                    run = self.start("--force", *more)
                    try:
                        errors = run.communicate(timeout=chance.uniform(0.0, seconds))[1]
                        self.assertEqual(run.returncode, 0, errors)
                        self.assertEqual(self.left(self.result), expected)
                    except subprocess.TimeoutExpired:
                        run.kill()
                        run.communicate()
                        kills += 1
                more = ["--resume"] if self.have_checkpoint() else []
                run = self.good("quasistatic", "case.yaml", "--threads", "1", "--force", *more)
                self.assertEqual(self.left(self.result), expected)
                since = self.summary()["resumed_from"]
                self.assertEqual(since is not None, bool(more))
                if more:
                    self.assertIn(f"\nresumed          from {control.removesuffix('s')} {since}\n", run.stdout)

    def test_an_interrupt_leaves_a_checkpoint_to_go_on_from(self):
        text = PLATE.replace("spacing: 0.005", "spacing: 0.001").replace("    checkpoint_every: 10\n", "").replace(
            "analysis:", "analysis:\n  transient: { end: 1.0e-5 }")
        self.write("case.yaml", text)
        for seconds in (2, 4, 8):  # until an event is over, however slow the program
            run = subprocess.Popen([PROGRAM, "quasistatic", "case.yaml", "--threads", "1"], cwd=self.folder,
                                   stdin=subprocess.DEVNULL, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
            end = time.monotonic() + 120
            while not (self.folder / "out/plate.unfinished/fields.exo").exists():
                self.assertLess(time.monotonic(), end)
                time.sleep(0.02)
            time.sleep(seconds)
            run.send_signal(signal.SIGINT)
            errors = run.communicate(timeout=120)[1]
            if "nothing was written" not in errors:
                break
        self.assertEqual(run.returncode, 130, errors)
        lines = [line for line in errors.splitlines() if not STAGE.match(line)]
        self.assertRegex(lines[-1], r"^perimode: interrupted after event \d+; go on with: "
                                    r"perimode quasistatic case.yaml --threads 1 --resume$")
        self.assertFalse(self.result.exists())
        line = self.complaint(self.perimode("quasistatic", "case.yaml"))
        self.assertIn("--resume", line)
        # Another analysis of the same case does not go on from it.
        self.assertIn("another case or analysis", self.complaint(self.perimode("transient", "case.yaml", "--resume")))


if __name__ == "__main__":
    main()
