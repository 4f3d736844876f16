# SPDX-License-Identifier: BSD-3-Clause
"""perimode transient: files, numbers against closed forms, bad input, interruptions, unfinished folders."""
import json
import math
import os
import signal
import subprocess
import time

import exodus
from program import PROGRAM, STAGE, ProgramTest, main, rows

# Mode 1 of this bar is exactly sin(pi x), whatever the horizon: walls reflect it into itself.
BAR = """\
title: bar
body:
  dimension: 1
  particles: { grid: { lower: [0], upper: [1], spacing: 0.02 } }
  horizon: { ratio: 3 }
material: { youngs_modulus: 68.0e+9, density: 2700, volume_correction: linear }
boundary:
  - { wall: x-, type: odd }
  - { wall: x+, type: odd }
analysis:
  modal: { modes: 1, reference: closed_form }
  transient:
    end: 4.0e-4
    initial: { displacement: ["1.0e-3*sin(pi*x)"] }
    probes:
      middle: { displacement_at: [0.51] }
      speed: { velocity_at: [0.51] }
      stretch: { strain_between: [[0.01], [0.03]] }
    fields_at: [0, 2.0e-4, 4.0e-4]
    checkpoint_every: 10
output: { directory: out/bar, fields: [displacement, velocity, energy] }
"""

PLATE = """\
title: plate
body:
  dimension: 2
  plane: stress
  thickness: 0.01
  particles: { grid: { lower: [0, 0], upper: [1, 0.5], spacing: 0.05 } }
  horizon: { ratio: 3 }
material: { youngs_modulus: 210.0e+9, density: 7850, volume_correction: linear }
boundary:
  - { fix: [x, y], at: { face: x-, layers: 2 } }
analysis:
  transient:
    end: 3.0e-4
    loads:
      - { traction: [1.0e+6, -2.0e+5], at: { face: x+, layers: 1 }, time: { ramp: 1.0e-4 } }
    probes: { corner: { displacement_at: [0.975, 0.475] } }
    history_every: 3
    fields_every: 20
output: { directory: out/plate, fields: [displacement, strain, damage] }
"""

# So many steps that a run is still at work when it is interrupted.
LONG = BAR.replace("end: 4.0e-4", "end: 40").replace("checkpoint_every: 10", "history_every: 100000").replace(
    "    fields_at: [0, 2.0e-4, 4.0e-4]\n", "")

FILES = ["fields.exo", "history.csv", "summary.json"]

PLAN_ALONE = r"\nsteps +\d+, to \S+ s\n\Z"  # what a run says before its first step, and no result


class TransientTest(ProgramTest):
    def run_case(self, text, *options):
        self.write("case.yaml", text)
        return self.good("transient", "case.yaml", *options)

    def result(self, name="bar"):
        return self.folder / "out" / name

    def summary(self, name="bar"):
        return json.loads((self.result(name) / "summary.json").read_text())


class Results(TransientTest):
    def test_a_standing_wave_is_that_of_the_scheme(self):
        run = self.run_case(BAR)
        self.assertEqual(sorted(p.name for p in self.result().iterdir()), FILES)
        self.assertEqual(sorted(p.name for p in (self.folder / "out").iterdir()), ["bar"])
        table = rows(self.result() / "history.csv")
        self.assertEqual(list(table[0]), ["step", "time", "kinetic", "strain", "external_work", "damping", "broken",
                                          "balance", "middle_x", "speed_x", "stretch"])
        summary = self.summary()
        self.assertEqual(len(table), summary["steps"] + 1)
        self.good("modal", "case.yaml", "--output", "out/modes")
        omega = float(rows(self.folder / "out/modes/modes.csv")[0]["exact_angular_frequency"])
        dt = summary["dt"]
        # Central differences turn a mode by theta in a step, sin(theta/2) = omega dt/2, from rest exactly.
        theta = 2.0 * math.asin(0.5 * omega * dt)
        self.assertAlmostEqual(dt * summary["steps"], 4e-4, delta=1e-15)
        for n, row in enumerate(table):
            self.assertEqual(int(row["step"]), n)
            self.assertAlmostEqual(float(row["time"]), n * dt, delta=1e-12 * 4e-4)
            shape = 1e-3 * math.sin(math.pi * 0.51)
            self.assertAlmostEqual(float(row["middle_x"]), shape * math.cos(n * theta), delta=1e-12)
            # (u_{n+1} - u_{n-1}) / (2 dt) = -sin(theta)/dt of the mode
            self.assertAlmostEqual(float(row["speed_x"]), -shape * math.sin(theta) / dt * math.sin(n * theta),
                                   delta=1e-8)
            strain = 1e-3 * (math.sin(math.pi * 0.03) - math.sin(math.pi * 0.01)) / 0.02
            self.assertAlmostEqual(float(row["stretch"]), strain * math.cos(n * theta), delta=1e-10)
            self.assertLess(abs(float(row["balance"])), 1e-11 * summary["energies"]["initial"])
        for word in ("50 particles", "central_difference", "stable step", "balance", "results in"):
            self.assertIn(word, run.stdout)

    def test_frames_of_fields(self):
        self.run_case(BAR)
        summary, file = self.summary(), self.result() / "fields.exo"
        times = exodus.doubles(exodus.variables(file)["time_whole"])
        self.assertEqual(len(times), 3)
        for time_of_frame, asked in zip(times, (0.0, 2e-4, 4e-4)):
            self.assertLessEqual(abs(time_of_frame - asked), 0.5001 * summary["dt"])
        table = rows(self.result() / "history.csv")
        for step in (1, 2, 3):
            row = table[round(times[step - 1] / summary["dt"])]
            self.assertEqual(exodus.nodal(file, "displacement_x", step)[25], float(row["middle_x"]))
            self.assertEqual(exodus.nodal(file, "velocity_x", step)[25], float(row["speed_x"]))
        self.assertGreater(exodus.nodal(file, "energy", 1)[0], 0.0)

    def test_summary(self):
        self.run_case(PLATE)
        summary = self.summary("plate")
        for key in ("analysis", "title", "particles", "bonds", "dofs", "engine", "method", "operator", "solver", "status",
                    "message", "dt", "steps", "time", "stable_step", "symmetric", "energies", "balance", "broken_bonds",
                    "iterations", "resumed_from", "particle_steps_per_second", "timings_s", "peak_memory_mb", "threads",
                    "version"):
            self.assertIn(key, summary)
        self.assertEqual(summary["analysis"], "transient")
        self.assertEqual(summary["status"], "done")
        self.assertEqual(summary["particles"], 200)
        self.assertIsNone(summary["resumed_from"])
        self.assertLessEqual(summary["dt"], 0.9 * summary["stable_step"]["limit"])
        self.assertLessEqual(summary["stable_step"]["bound"], summary["stable_step"]["limit"])
        self.assertLess(summary["balance"], 1e-10)
        steps = [int(row["step"]) for row in rows(self.result("plate") / "history.csv")]
        last = summary["steps"]
        self.assertEqual(steps, sorted({*range(0, last + 1, 3), last}))
        frames = len(exodus.doubles(exodus.variables(self.result("plate") / "fields.exo")["time_whole"]))
        self.assertEqual(frames, len({*range(0, last + 1, 20), last}))

    def test_an_unsymmetric_boundary_shows_its_work(self):
        self.run_case(BAR.replace("{ wall: x+, type: odd }", "{ wall: x+, type: surface_nodes }"))
        table = rows(self.result() / "history.csv")
        self.assertEqual(list(table[0])[-1], "boundary_work")
        self.assertEqual({row["boundary_work"] == row["balance"] for row in table}, {True})
        self.assertGreater(abs(float(table[-1]["boundary_work"])), 0.0)
        self.assertFalse(self.summary()["symmetric"])

    def test_threads_change_no_bit(self):
        found = set()
        for threads in (1, 2, 2):
            self.run_case(PLATE, "--force", "--threads", threads)
            found.add(tuple((self.result("plate") / name).read_bytes() for name in ("history.csv", "fields.exo")))
        self.assertEqual(len(found), 1)

    def test_methods_agree_on_a_smooth_motion(self):
        ends = {}
        for method in ("central_difference", "newmark", "hht", "modal"):
            more = ["--set", "analysis.transient.modes=20"] if method == "modal" else []
            if method == "hht":
                more = ["--set", "analysis.transient.alpha=-0.05"]
            self.run_case(BAR, "--force", "--set", "analysis.transient.method=" + method, "--set",
                          "analysis.transient.dt=2.0e-7", *more)
            ends[method] = float(rows(self.result() / "history.csv")[-1]["middle_x"])
        # phase errors: (omega dt)^2/24 and /12 of omega t = 6.3 rad with omega dt = 0.003, times 1e-3 m
        for method, end in ends.items():
            self.assertAlmostEqual(end, ends["modal"], delta=2e-8, msg=method)

    def test_check_tells_the_plan(self):
        self.write("case.yaml", PLATE)
        run = self.good("check", "case.yaml")
        for word in ("transient", "central_difference", "operator stencil", "stable step", "sufficient bound", "steps",
                     "memory"):
            self.assertIn(word, run.stdout)
        self.assertEqual(self.files(), ["case.yaml"])


class BadInput(TransientTest):
    def refused(self, text, *options):
        self.write("case.yaml", text)
        line = self.complaint(self.perimode("transient", "case.yaml", *options))
        self.assertEqual([f for f in self.files() if f.startswith("out")], [])
        return line

    def test_values_out_of_range(self):
        for key, values, words in (("dt", ("0", "-1.0e-7"), ("dt",)), ("end", ("0", "-1.0"), ("end",)),
                                   ("history_every", ("0",), ("history_every",)),
                                   ("checkpoint_every", ("-1", "1.5"), ("checkpoint_every",))):
            for value in values:
                with self.subTest(key, value=value):
                    line = self.refused(BAR, "--set", f"analysis.transient.{key}={value}")
                    for word in words:
                        self.assertIn(word, line)

    def test_a_step_beyond_the_stable_one_names_both(self):
        line = self.refused(BAR, "--set", "analysis.transient.dt=1.0e-5")
        self.assertIn("stable step", line)
        self.assertIn("1e-05 s", line)
        self.assertIn("sufficient", line)

    def test_a_probe_outside(self):
        self.assertIn("probe", self.refused(BAR.replace("displacement_at: [0.51]", "displacement_at: [1.5]")))

    def test_an_empty_region_of_a_load(self):
        line = self.refused(PLATE.replace("at: { face: x+, layers: 1 }, time",
                                          "at: { box: { lower: [2, 2], upper: [3, 3] } }, time").replace(
                                              "traction: [1.0e+6, -2.0e+5]", "force: [1, 1]"))
        self.assertIn("particle", line)

    def test_formulas(self):
        for formula in ("sin(pi*x", "sin(pi*q)", "1/0*x", "log(-1-x)"):
            with self.subTest(formula):
                self.assertIn("case.yaml:", self.refused(BAR.replace("1.0e-3*sin(pi*x)", formula)))

    def test_a_case_without_the_section(self):
        text = BAR[:BAR.index("  transient:")] + "output: { directory: out/bar }\n"
        self.assertIn("analysis.transient", self.refused(text))

    def test_fields_no_one_knows(self):
        self.assertIn("velocity", self.refused(BAR.replace("velocity, energy", "speed")))


class Unfinished(TransientTest):
    """Runs that did not come to their end, and what the next one makes of them."""

    def start(self, *arguments, text=LONG):
        self.write("case.yaml", text)
        self.began = time.time() - 0.02  # times of files are coarse
        run = subprocess.Popen([PROGRAM, "transient", "case.yaml", "--threads", "1", *arguments], cwd=self.folder,
                               stdin=subprocess.DEVNULL, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
        self.addCleanup(self.end, run)
        return run

    def end(self, run):
        run.kill()
        run.communicate()

    def wait_for(self, name):
        """Until the run steps: its history is there."""
        end = time.monotonic() + 120
        file = self.unfinished / name  # of this run: a resumed one finds the file of the run before
        while not (file.exists() and file.stat().st_mtime > self.began):
            self.assertLess(time.monotonic(), end, name)
            time.sleep(0.02)
        time.sleep(0.3)

    @property
    def unfinished(self):
        return self.folder / "out/bar.unfinished"

    def interrupted(self, number=signal.SIGINT, *arguments):
        run = self.start(*arguments)
        self.wait_for("history.csv")
        self.assertIsNone(run.poll(), "still at work")
        run.send_signal(number)
        output, errors = run.communicate(timeout=120)
        self.assertEqual(run.returncode, 130, errors)
        self.assertRegex(output, PLAN_ALONE)
        lines = [line for line in errors.splitlines() if not STAGE.match(line)]
        self.assertEqual(len(lines), 1, errors)
        return lines[0]

    def test_signals_leave_a_checkpoint_and_say_how_to_go_on(self):
        for number in (signal.SIGINT, signal.SIGTERM):
            with self.subTest(number.name):
                line = self.interrupted(number, "--force")
                self.assertRegex(line, r"^perimode: interrupted at step \d+ of \d+; go on with: "
                                       r"perimode transient case.yaml --threads 1 --force --resume$")
                self.assertTrue((self.unfinished / "checkpoint.h5").exists())
                self.assertFalse(self.result().exists())

    def test_a_resumed_run_goes_on_and_can_be_interrupted_again(self):
        step = []
        for options in ((), ("--resume",), ("--resume",)):
            step.append(int(self.interrupted(signal.SIGTERM, *options).split(" of ")[0].rsplit(" ", 1)[1]))
        self.assertEqual(step, sorted(set(step)))

    def test_a_second_run_at_work_is_refused(self):
        run = self.start()
        self.wait_for("history.csv")
        self.assertIn("in use", self.complaint(self.perimode("transient", "case.yaml", "--force")))
        self.assertIsNone(run.poll())
        self.assertTrue((self.unfinished / "history.csv").exists())

    def test_an_unfinished_run_is_not_lost_by_accident(self):
        self.interrupted()
        before = (self.unfinished / "checkpoint.h5").read_bytes()
        line = self.complaint(self.perimode("transient", "case.yaml"))
        self.assertIn("--resume", line)
        self.assertIn("--force", line)
        self.assertEqual((self.unfinished / "checkpoint.h5").read_bytes(), before)
        self.write("case.yaml", BAR)
        self.good("transient", "case.yaml", "--force")
        self.assertFalse(self.unfinished.exists())
        self.assertEqual(sorted(p.name for p in self.result().iterdir()), FILES)

    def test_a_folder_without_a_checkpoint_is_replaced(self):
        self.unfinished.mkdir(parents=True)
        (self.unfinished / "history.csv").write_text("of a killed run\n")
        self.run_case(BAR)
        self.assertFalse(self.unfinished.exists())
        self.assertEqual(sorted(p.name for p in self.result().iterdir()), FILES)

    def test_resume_needs_a_checkpoint(self):
        self.write("case.yaml", BAR)
        self.assertIn("no unfinished run", self.complaint(self.perimode("transient", "case.yaml", "--resume")))
        self.unfinished.mkdir(parents=True)
        self.assertIn("without one", self.complaint(self.perimode("transient", "case.yaml", "--resume")))
        self.good("transient", "case.yaml")
        self.assertIn("checkpoint", self.complaint(self.perimode("transient", "case.yaml", "--resume")))

    def test_another_case_cannot_be_resumed(self):
        self.interrupted()
        before = {p.name: p.read_bytes() for p in self.unfinished.iterdir()}
        line = self.complaint(self.perimode("transient", "case.yaml", "--resume", "--set", "material.density=2701"))
        self.assertIn("another case", line)
        self.assertEqual({p.name: p.read_bytes() for p in self.unfinished.iterdir()}, before)

    def test_comments_and_layout_are_no_other_case(self):
        self.interrupted()
        run = self.start("--resume", text="# the same\n" + LONG.replace("{ ratio: 3 }", "\n    ratio: 3"))
        time.sleep(1.0)
        self.assertIsNone(run.poll(), "still at work")

    def test_a_full_disk_is_one_error_and_leaves_the_checkpoint(self):
        """A limit on the size of files stands for the disk: writing fails with an error of the system."""
        def limited():
            import resource
            signal.signal(signal.SIGXFSZ, signal.SIG_IGN)
            resource.setrlimit(resource.RLIMIT_FSIZE, (60000, resource.RLIM_INFINITY))

        text = LONG.replace("history_every: 100000", "history_every: 1\n    checkpoint_every: 50")
        self.write("case.yaml", text)
        run = subprocess.run([PROGRAM, "transient", "case.yaml", "--threads", "1"], cwd=self.folder,
                             stdin=subprocess.DEVNULL, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True,
                             timeout=300, preexec_fn=limited)
        line = self.one_error(run, 3, PLAN_ALONE)
        self.assertIn("free space", line)
        self.assertIn("go on with: perimode transient case.yaml --threads 1 --resume", line)
        again = self.start("--resume", text=text)  # with room
        time.sleep(1.0)
        again.send_signal(signal.SIGINT)
        errors = again.communicate(timeout=120)[1]
        self.assertEqual(again.returncode, 130, errors)
        table = rows(self.unfinished / "history.csv")
        self.assertEqual([int(row["step"]) for row in table], list(range(len(table))))
        self.assertGreater(os.path.getsize(self.unfinished / "history.csv"), 60000)


if __name__ == "__main__":
    main()
