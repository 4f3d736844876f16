# SPDX-License-Identifier: BSD-3-Clause
"""How the program treats folders, overrides, streams and its smaller commands."""
import os
import pty
import select
import subprocess

from program import CLOUD, FILES, PLATE, PROGRAM, STAGE, ProgramTest, cloud_csv, main, rows


class Folders(ProgramTest):
    def test_a_result_is_replaced_only_by_force(self):
        self.write("case.yaml", PLATE)
        self.good("modal", "case.yaml")
        before = (self.folder / "out/plate/summary.json").read_bytes()
        line = self.complaint(self.perimode("modal", "case.yaml"))
        self.assertIn("--force", line)
        self.assertEqual((self.folder / "out/plate/summary.json").read_bytes(), before)
        self.good("modal", "case.yaml", "--force", "--set", "analysis.modal.modes=3")
        self.assertEqual(len(rows(self.folder / "out/plate/modes.csv")), 3)
        self.assertEqual(sorted(p.name for p in (self.folder / "out").iterdir()), ["plate"])

    def test_a_failed_run_leaves_the_earlier_result_alone(self):
        self.write("case.yaml", PLATE)
        self.good("modal", "case.yaml")
        before = (self.folder / "out/plate/summary.json").read_bytes()
        self.complaint(self.perimode("modal", "case.yaml", "--force", "--set", "analysis.modal.modes=1000"))
        self.assertEqual((self.folder / "out/plate/summary.json").read_bytes(), before)
        self.assertEqual(sorted(p.name for p in (self.folder / "out").iterdir()), ["plate"])

    def test_output_goes_to_the_working_folder_and_input_comes_from_the_case(self):
        (self.folder / "cases").mkdir()
        self.write("cases/cloud.yaml", CLOUD)
        self.write("cases/cloud.csv", cloud_csv())
        self.good("modal", "cases/cloud.yaml")
        self.good("modal", "cases/cloud.yaml", "--output", "elsewhere/deep/cloud")
        for folder in ("out/cloud", "elsewhere/deep/cloud"):
            self.assertEqual(sorted(p.name for p in (self.folder / folder).iterdir()), FILES)
        self.assertFalse((self.folder / "cases/out").exists())

    def test_an_empty_folder_may_be_filled(self):
        self.write("case.yaml", PLATE)
        (self.folder / "out/plate").mkdir(parents=True)
        self.good("modal", "case.yaml")
        self.assertEqual(sorted(p.name for p in (self.folder / "out/plate").iterdir()), FILES)


class Overrides(ProgramTest):
    def test_values_lists_and_sections_can_be_set(self):
        self.write("case.yaml", PLATE)
        self.good("modal", "case.yaml", "--set", "body.horizon.ratio=2", "--set", "analysis.modal.modes=4",
                  "--set", "boundary.1={ wall: y-, type: mirror }", "--set", "material.density=1.0e+3")
        self.write("same.yaml", PLATE.replace("ratio: 3", "ratio: 2").replace("modes: 6", "modes: 4")
                   .replace("7850", "1000").replace("analysis", "  - { wall: y-, type: mirror }\nanalysis"))
        self.good("modal", "same.yaml", "--output", "out/same")
        self.assertEqual((self.folder / "out/plate/modes.csv").read_bytes(),
                         (self.folder / "out/same/modes.csv").read_bytes())


class Streams(ProgramTest):
    def test_piped_progress_is_plain_lines(self):
        self.write("case.yaml", PLATE)
        run = subprocess.run([PROGRAM, "modal", "case.yaml"], cwd=self.folder, capture_output=True, timeout=300)
        self.assertEqual(run.returncode, 0)
        for byte in (b"\r", b"\x1b"):
            self.assertNotIn(byte, run.stderr + run.stdout)
        for line in run.stderr.decode().splitlines():
            self.assertRegex(line, STAGE)

    def test_quiet_says_nothing_but_results(self):
        self.write("case.yaml", PLATE.replace("modes: 6", "modes: 6, reference: closed_form"))
        run = self.good("modal", "case.yaml", "--quiet")
        self.assertEqual(run.stderr, "")
        self.assertIn("frequency [Hz]", run.stdout)

    def test_a_terminal_shows_one_line_that_is_rewritten_and_erased(self):
        self.write("case.yaml", PLATE)
        leader, follower = pty.openpty()
        run = subprocess.Popen([PROGRAM, "modal", "case.yaml"], cwd=self.folder, stdout=subprocess.PIPE, stderr=follower)
        os.close(follower)
        shown = b""
        while True:
            if not select.select([leader], [], [], 300)[0]:
                break
            try:
                chunk = os.read(leader, 4096)
            except OSError:
                break  # the other end is closed
            if not chunk:
                break
            shown += chunk
        self.assertEqual(run.wait(timeout=300), 0)
        run.stdout.close()
        os.close(leader)
        self.assertIn(b"\r\x1b[K", shown)
        self.assertIn(b"assembling", shown)
        self.assertNotIn(b"\n", shown)
        self.assertTrue(shown.endswith(b"\r\x1b[K"), shown)


class Commands(ProgramTest):
    def test_version_names_what_is_compiled_in(self):
        run = self.good("--version")
        self.assertRegex(run.stdout, r"^perimode \d+\.\d+\.\d+\n")
        for word in ("Eigen", "CHOLMOD", "ARPACK", "LAPACK", "Exodus", "yaml-cpp"):
            self.assertIn(word.lower(), run.stdout.lower())

    def test_help_has_examples(self):
        for arguments in (["--help"], ["modal", "--help"], ["check", "--help"], ["new", "--help"],
                          ["new", "modal", "--help"], ["new", "transient", "--help"], ["dispersion", "--help"]):
            with self.subTest(" ".join(arguments)):
                run = self.good(*arguments)
                self.assertEqual(run.stderr, "")
                self.assertIn("Example", run.stdout)
                self.assertIn("perimode " + (arguments[0] if arguments[0] != "--help" else "modal"), run.stdout)

    def test_help_lists_the_options(self):
        text = self.good("modal", "--help").stdout + self.good("--help").stdout
        for option in ("--set", "--output", "--force", "--threads", "--quiet", "--version", "--matrices", "--crack-growth"):
            self.assertIn(option, text)

    def test_a_new_case_is_complete(self):
        printed = self.good("new", "modal").stdout
        self.good("new", "modal", "mine.yaml")
        self.assertEqual((self.folder / "mine.yaml").read_text(), printed)
        self.good("check", "mine.yaml")
        self.good("modal", "mine.yaml", "--set", "body.particles.grid.spacing=0.02")
        self.good("new", "modal", "mine.yaml", "--force")
        self.good("new", "transient", "wave.yaml")
        self.good("check", "wave.yaml")

    def test_check_predicts_and_writes_nothing(self):
        self.write("case.yaml", PLATE.replace("spacing: 0.1", "spacing: 0.02"))
        run = self.good("check", "case.yaml")
        for word in ("particles        1250", "bonds", "dofs             2450", "nonzeros", "factor", "memory",
                     "solver           lanczos: ", "rigid modes      0", "pieces           1"):
            self.assertIn(word, run.stdout)
        self.assertEqual(self.files(), ["case.yaml"])

    def test_check_warns_of_mechanisms_pieces_and_lone_particles(self):
        cut = "precracks: [ { from: [0.5, -1], to: [0.5, 2] } ]"
        lone = "0.0,0.0,0.01\n0.1,0.0,0.01\n0.0,0.1,0.01\n0.1,0.1,0.01\n5.0,5.0,0.01\n"
        self.write("cloud.csv", "x,y,volume\n" + lone)
        for text, words in ((PLATE.replace("ratio: 3", "ratio: 1"), "mechanism"),
                            (PLATE.replace("ratio: 3 }", "ratio: 3 }\n  " + cut), "pieces"),
                            (CLOUD.replace("modes: 6", "modes: 2"), "without any bond")):
            with self.subTest(words):
                self.write("case.yaml", text)
                run = self.good("check", "case.yaml")
                self.assertIn("perimode: warning: ", run.stderr)
                self.assertIn(words, run.stderr)


if __name__ == "__main__":
    main()
