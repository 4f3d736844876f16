# SPDX-License-Identifier: BSD-3-Clause
"""Runs that are stopped, or that could never fit: nothing that looks whole is left behind."""
import signal
import subprocess
import time

from program import BLOCK, PLATE, PROGRAM, STAGE, ProgramTest, main

# About 178000 dofs: minutes of factorisation on any machine that runs this test.
LONG = BLOCK.replace("spacing: 0.2", "spacing: 0.025").replace("ratio: 2", "ratio: 3").replace(
    "analysis: {", "boundary:\n  - { fix: [x, y, z], at: { face: x-, layers: 3 } }\nanalysis: {")
ENOUGH_SECONDS = 15.0  # to end; a second on an idle machine


class Interruption(ProgramTest):
    def start(self, *arguments):
        """The run once it works on its result."""
        self.write("case.yaml", LONG)
        run = subprocess.Popen([PROGRAM, "modal", "case.yaml", *arguments], cwd=self.folder, stdin=subprocess.DEVNULL,
                               stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
        self.addCleanup(run.stdout.close)
        self.addCleanup(run.stderr.close)
        self.addCleanup(run.kill)
        return run

    def wait_for(self, condition, what):
        end = time.monotonic() + 120
        while not condition():
            self.assertLess(time.monotonic(), end, what)
            time.sleep(0.02)

    def unfinished(self):
        return [f for f in self.files() if ".part-" in f]

    def test_signals_end_a_run_with_one_line_and_leave_nothing(self):
        for number in (signal.SIGINT, signal.SIGTERM):
            for seconds in (0.0, 3.0):  # while the body is built, while it is assembled or factored
                with self.subTest(number.name, seconds=seconds):
                    run = self.start()
                    self.wait_for(self.unfinished, "a temporary folder")
                    time.sleep(seconds)
                    self.assertIsNone(run.poll(), "still at work")
                    sent = time.monotonic()
                    run.send_signal(number)
                    output, errors = run.communicate(timeout=60)
                    self.assertLess(time.monotonic() - sent, ENOUGH_SECONDS)
                    self.assertEqual(run.returncode, 130)
                    lines = [line for line in errors.splitlines() if not STAGE.match(line)]
                    self.assertEqual(len(lines), 1, errors)
                    self.assertIn("interrupted", lines[0])
                    self.assertEqual(output, "")
                    self.assertEqual(self.files(), ["case.yaml"])

    def test_termination_works_at_any_moment(self):
        # Among others while METIS orders the matrix: it sets its own handler of SIGTERM meanwhile.
        for tenths in (5, 10, 15, 20, 25):
            for times in (1, 2):
                with self.subTest(tenths=tenths, times=times):
                    run = self.start("--quiet")
                    self.wait_for(self.unfinished, "a temporary folder")
                    time.sleep(0.1 * tenths)
                    for _ in range(times):
                        run.send_signal(signal.SIGTERM)
                    errors = run.communicate(timeout=60)[1]
                    self.assertEqual(run.returncode, 130, errors)
                    self.assertIn("interrupted", errors)
                    self.assertEqual(self.unfinished(), [])
                    self.assertFalse((self.folder / "out/block").exists())

    def test_an_interrupted_run_leaves_the_earlier_result(self):
        self.write("small.yaml", PLATE)
        self.good("modal", "small.yaml", "--output", "out/block")
        before = (self.folder / "out/block/summary.json").read_bytes()
        run = self.start("--force")
        self.wait_for(self.unfinished, "a temporary folder")
        run.send_signal(signal.SIGINT)
        run.communicate(timeout=60)
        self.assertEqual(run.returncode, 130)
        self.assertEqual((self.folder / "out/block/summary.json").read_bytes(), before)
        self.assertEqual(self.unfinished(), [])

    def test_a_killed_run_leaves_nothing_that_looks_whole(self):
        run = self.start()
        self.wait_for(self.unfinished, "a temporary folder")
        run.kill()
        run.communicate(timeout=60)
        self.assertFalse((self.folder / "out/block").exists())
        # The next run is not disturbed by what is left.
        self.good("modal", "case.yaml", "--set", "body.particles.grid.spacing=0.25")
        self.assertTrue((self.folder / "out/block/summary.json").exists())


class Memory(ProgramTest):
    def test_a_body_that_cannot_fit_is_refused_before_it_is_built(self):
        for name, text in (("plate", PLATE.replace("spacing: 0.1", "spacing: 2.5e-5")),  # 8e8 particles
                           ("block", BLOCK.replace("spacing: 0.2", "spacing: 1.0e-3"))):  # 1e9
            for command in ("modal", "check"):
                with self.subTest(name, command=command):
                    self.write("case.yaml", text)
                    start = time.monotonic()
                    line = self.complaint(self.perimode(command, "case.yaml"), 3)
                    self.assertLess(time.monotonic() - start, 60)  # building it would take many minutes
                    for words in ("memory", "GiB", "available"):
                        self.assertIn(words, line)
                    self.assertEqual(self.files(), ["case.yaml"])

    def test_more_particles_than_can_be_numbered_are_bad_input(self):
        self.write("case.yaml", PLATE.replace("spacing: 0.1", "spacing: 1.0e-5"))
        line = self.complaint(self.perimode("modal", "case.yaml"))
        self.assertIn("2^31", line)


if __name__ == "__main__":
    main()
