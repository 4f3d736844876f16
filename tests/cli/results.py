# SPDX-License-Identifier: BSD-3-Clause
"""What good cases write and print."""
import csv
import json
import math
import os
import pty
import select
import struct
import subprocess

from program import BAR, BLOCK, CLOUD, PLATE, PROGRAM, STAGE, ProgramTest, cloud_csv, main

COLUMNS = ["mode", "kind", "eigenvalue", "angular_frequency", "frequency_hz", "residual", "exact_angular_frequency",
           "relative_error", "nonlocal_angular_frequency", "classical_angular_frequency", "effective_mass_x"]
FILES = ["modes.csv", "modes.exo", "summary.json"]


def rows(path):
    with open(path, newline="") as file:
        return list(csv.DictReader(file))


class ClassicNetcdf:
    """Dimensions and variables of a NetCDF classic file (what Exodus II is), 64-bit offsets."""

    SIZES = {1: 1, 2: 1, 3: 2, 4: 4, 5: 4, 6: 8}

    def __init__(self, path):
        self.data, self.at = path.read_bytes(), 4
        assert self.data[:4] == b"CDF\x02", self.data[:4]
        self.records = self.number()
        self.dimensions = self.listing(lambda: (self.name(), self.number()))
        self.listing(self.attribute)
        self.variables = dict(self.listing(self.variable))
        length = [v["size"] for v in self.variables.values() if v["record"]]
        self.record_size = sum(length)

    def number(self):
        self.at += 4
        return struct.unpack(">i", self.data[self.at - 4: self.at])[0]

    def name(self):
        length = self.number()
        text = self.data[self.at: self.at + length].decode()
        self.at += -(-length // 4) * 4
        return text

    def listing(self, item):
        self.number()
        return [item() for _ in range(self.number())]

    def attribute(self):
        name, kind, count = self.name(), self.number(), self.number()
        self.at += -(-count * self.SIZES[kind] // 4) * 4
        return name

    def variable(self):
        name = self.name()
        shape = [self.number() for _ in range(self.number())]
        self.listing(self.attribute)
        kind, size = self.number(), self.number()
        begin = struct.unpack(">q", self.data[self.at: self.at + 8])[0]
        self.at += 8
        record = bool(shape) and self.dimensions[shape[0]][1] == 0
        lengths = [self.dimensions[d][1] for d in shape]
        return name, {"shape": lengths, "kind": kind, "size": size, "begin": begin, "record": record}

    def doubles(self, name, record=0):
        v = self.variables[name]
        count = math.prod(v["shape"][1:] if v["record"] else v["shape"])
        begin = v["begin"] + (record * self.record_size if v["record"] else 0)
        assert v["kind"] == 6, "a variable of doubles"
        return struct.unpack(f">{count}d", self.data[begin: begin + 8 * count])


class Results(ProgramTest):
    def run_case(self, text, *arguments):
        self.write("case.yaml", text)
        return self.good("modal", "case.yaml", *arguments)

    def test_the_three_files_and_nothing_else(self):
        self.run_case(PLATE)
        self.assertEqual(self.files(), ["case.yaml", "out", "out/plate", *("out/plate/" + f for f in FILES)])

    def test_columns_by_dimension(self):
        self.write("cloud.csv", cloud_csv())
        for text, name, axes in ((BAR, "bar", "x"), (PLATE, "plate", "xy"), (CLOUD, "cloud", "xy"), (BLOCK, "block", "xyz")):
            with self.subTest(name):
                self.run_case(text)
                header = (self.folder / "out" / name / "modes.csv").read_text().splitlines()[0]
                self.assertEqual(header.split(","), COLUMNS[:-1] + ["effective_mass_" + a for a in axes])

    def test_values_of_the_table_agree_with_each_other(self):
        self.run_case(BLOCK)
        table = rows(self.folder / "out/block/modes.csv")
        self.assertEqual([int(r["mode"]) for r in table], list(range(1, 9)))
        self.assertEqual([r["kind"] for r in table], ["rigid"] * 6 + ["elastic"] * 2)
        for r in table:
            self.assertEqual(float(r["angular_frequency"]), math.sqrt(float(r["eigenvalue"])))
            self.assertAlmostEqual(float(r["frequency_hz"]) * 2 * math.pi, float(r["angular_frequency"]), delta=1e-9)
            self.assertLess(float(r["residual"]), 1e-9)
            self.assertEqual(r["exact_angular_frequency"], "")
            if r["kind"] == "rigid":
                self.assertEqual(float(r["eigenvalue"]), 0.0)
        mass = 2700.0  # of the unit cube: the rigid modes carry all of it along each axis
        for axis in "xyz":
            self.assertAlmostEqual(sum(float(r["effective_mass_" + axis]) for r in table[:6]), mass, delta=1e-8)

    def test_closed_form_reference(self):
        self.run_case(BAR)
        for r in rows(self.folder / "out/bar/modes.csv"):
            exact = float(r["exact_angular_frequency"])
            self.assertAlmostEqual(float(r["angular_frequency"]) / exact, 1.0, delta=1e-10)
            self.assertAlmostEqual(float(r["relative_error"]), float(r["angular_frequency"]) / exact - 1, delta=1e-15)
            classical = int(r["mode"]) * math.pi * math.sqrt(68.0e9 / 2700)
            self.assertAlmostEqual(float(r["classical_angular_frequency"]) / classical, 1.0, delta=1e-12)
            self.assertLess(float(r["nonlocal_angular_frequency"]), classical)

    def test_a_reference_that_does_not_exist_is_a_warning(self):
        run = self.run_case(PLATE.replace("modes: 6", "modes: 6, reference: closed_form"))
        self.assertIn("perimode: warning: no closed form: ", run.stderr)
        self.assertEqual(rows(self.folder / "out/plate/modes.csv")[0]["exact_angular_frequency"], "")

    def test_the_table_is_printed(self):
        run = self.run_case(BAR)
        for word in ("mode", "frequency [Hz]", "exact [Hz]", "rel. error", "residual", "complete by", "out/bar"):
            self.assertIn(word, run.stdout)
        self.assertGreaterEqual(len(run.stdout.splitlines()), 12)

    def test_summary(self):
        self.run_case(PLATE)
        summary = json.loads((self.folder / "out/plate/summary.json").read_text())
        self.assertEqual(summary["analysis"], "modal")
        self.assertEqual(summary["status"], "done")
        self.assertEqual(summary["particles"], 50)
        self.assertEqual(summary["dofs"], 90)
        for key in ("bonds", "engine", "solver", "peak_memory_mb", "threads", "version"):
            self.assertTrue(summary[key], key)
        self.assertTrue(all(t >= 0 for t in summary["timings_s"].values()))
        self.assertIs(summary["certificate"]["complete"], True)
        self.assertTrue(summary["certificate"]["method"])
        self.assertGreaterEqual(summary["certificate"]["count"], 6)
        table = rows(self.folder / "out/plate/modes.csv")
        self.assertEqual(len(summary["modes"]), len(table))
        for mode, row in zip(summary["modes"], table):
            self.assertEqual(list(mode), list(row))
            for key, text in row.items():
                self.assertEqual(mode[key] if mode[key] is not None else "", text if key == "kind" or text == "" else float(text))

    def test_exodus(self):
        self.run_case(PLATE)
        exo = ClassicNetcdf(self.folder / "out/plate/modes.exo")
        self.assertEqual(exo.records, 6)
        self.assertEqual(len(exo.doubles("coordx")), 50)
        self.assertAlmostEqual(exo.doubles("coordx")[0], 0.05)
        table = rows(self.folder / "out/plate/modes.csv")
        for k in range(6):
            self.assertEqual(exo.doubles("time_whole", k), (k + 1.0,))
            self.assertAlmostEqual(exo.doubles("vals_glo_var", k)[0], float(table[k]["frequency_hz"]), delta=1e-9)
            u = [exo.doubles(f"vals_nod_var{a}", k) for a in (1, 2, 3)]
            mass = 7850 * 0.01 * 0.1 * 0.1
            self.assertAlmostEqual(mass * sum(x * x for c in u for x in c), 1.0, delta=1e-9)
            self.assertEqual([u[0][i] for i in range(0, 50, 10)], [0.0] * 5)  # the fixed layer
            self.assertEqual(max(map(abs, u[2])), 0.0)

    def test_matrices(self):
        self.run_case(PLATE, "--matrices")
        self.assertEqual(sorted(p.name for p in (self.folder / "out/plate").iterdir()), ["K.mtx", "M.mtx", *FILES])
        def read(name):
            lines = [l for l in (self.folder / "out/plate" / name).read_text().splitlines()]
            self.assertEqual(lines[0], "%%MatrixMarket matrix coordinate real symmetric")
            body = [l.split() for l in lines[1:] if not l.startswith("%")]
            self.assertEqual(body[0][:2], ["90", "90"])
            self.assertEqual(len(body) - 1, int(body[0][2]))
            return {(int(i) - 1, int(j) - 1): float(v) for i, j, v in body[1:]}
        k, m = read("K.mtx"), read("M.mtx")
        self.assertEqual(sorted(m), [(i, i) for i in range(90)])
        self.assertAlmostEqual(sum(m.values()), 2 * 7850 * 0.01 * 0.45, delta=1e-10)
        # A mode read back from the Exodus file solves K x = omega^2 M x.
        exo = ClassicNetcdf(self.folder / "out/plate/modes.exo")
        x = [c for pair in zip(exo.doubles("vals_nod_var1", 0), exo.doubles("vals_nod_var2", 0)) for c in pair]
        free = [x[2 * i + a] for i in range(50) if i % 10 > 0 for a in (0, 1)]
        kx = [0.0] * 90
        for (i, j), v in k.items():
            kx[i] += v * free[j]
            if i != j:
                kx[j] += v * free[i]
        value = float(rows(self.folder / "out/plate/modes.csv")[0]["eigenvalue"])
        scale = max(abs(value * m[i, i] * free[i]) for i in range(90))
        for i in range(90):
            self.assertAlmostEqual(kx[i], value * m[i, i] * free[i], delta=1e-8 * scale)

    def test_json_and_yaml_give_the_same(self):
        self.run_case(PLATE)
        case = {"title": "plate",
                "body": {"dimension": 2, "plane": "stress", "thickness": 0.01,
                         "particles": {"grid": {"lower": [0, 0], "upper": [1, 0.5], "spacing": 0.1}},
                         "horizon": {"ratio": 3}},
                "material": {"youngs_modulus": 210.0e9, "density": 7850, "micromodulus": {"kernel": "constant"},
                             "volume_correction": "linear"},
                "boundary": [{"fix": ["x", "y"], "at": {"face": "x-", "layers": 1}}],
                "analysis": {"modal": {"modes": 6}}, "output": {"directory": "out/json"}}
        for name, text in (("case.json", json.dumps(case, indent=1)), ("line.json", json.dumps(case))):
            self.write(name, text)
            self.good("modal", name, "--force")
            self.assertEqual((self.folder / "out/json/modes.csv").read_bytes(),
                             (self.folder / "out/plate/modes.csv").read_bytes())

    def test_quoted_numbers_are_numbers(self):
        self.run_case(PLATE)
        plain = (self.folder / "out/plate/modes.csv").read_bytes()
        self.run_case(PLATE.replace("210.0e+9", '"210.0e+9"').replace("modes: 6", 'modes: "6"'), "--force")
        self.assertEqual((self.folder / "out/plate/modes.csv").read_bytes(), plain)

    def test_running_twice_gives_the_same_bytes(self):
        for text, name in ((BLOCK, "block"), (PLATE.replace("spacing: 0.1", "spacing: 0.02"), "plate")):
            found = set()
            for _ in range(2):
                self.run_case(text, "--force", "--threads", "1")
                found.add((self.folder / "out" / name / "modes.csv").read_bytes())
            self.assertEqual(len(found), 1)

    def test_threads_do_not_change_frequencies(self):
        tables = []
        for threads in ("1", "2"):
            self.run_case(PLATE.replace("spacing: 0.1", "spacing: 0.02"), "--force", "--threads", threads)
            summary = json.loads((self.folder / "out/plate/summary.json").read_text())
            self.assertEqual(summary["threads"], int(threads))
            tables.append(rows(self.folder / "out/plate/modes.csv"))
        for one, two in zip(*tables):
            self.assertAlmostEqual(float(one["frequency_hz"]) / float(two["frequency_hz"]), 1.0, delta=1e-12)

    def test_solvers_agree(self):
        found = []
        for solver in ("dense", "lanczos", "arpack"):
            self.run_case(PLATE, "--force", "--set", "analysis.modal.solver=" + solver)
            summary = json.loads((self.folder / "out/plate/summary.json").read_text())
            self.assertEqual(summary["solver"], solver)
            found.append([m["frequency_hz"] for m in summary["modes"]])
        for other in found[1:]:
            for a, b in zip(found[0], other):
                self.assertAlmostEqual(a / b, 1.0, delta=1e-11)

    def test_range_and_shift_are_in_hertz(self):
        self.run_case(PLATE, "--set", "analysis.modal.modes=12")
        all_hz = [float(r["frequency_hz"]) for r in rows(self.folder / "out/plate/modes.csv")]
        inside = PLATE.replace("modes: 6", f"range: [{all_hz[2] * 0.999!r}, {all_hz[7] * 1.0001!r}]")
        self.run_case(inside, "--force")
        table = rows(self.folder / "out/plate/modes.csv")
        self.assertEqual(len(table), 6)
        for r, hz in zip(table, all_hz[2:8]):
            self.assertAlmostEqual(float(r["frequency_hz"]) / hz, 1.0, delta=1e-11)
        self.run_case(PLATE.replace("modes: 6", f"modes: 1, shift: {all_hz[4] * 1.001!r}"), "--force")
        table = rows(self.folder / "out/plate/modes.csv")
        self.assertEqual(len(table), 1)
        self.assertAlmostEqual(float(table[0]["frequency_hz"]) / all_hz[4], 1.0, delta=1e-11)


class Goals(ProgramTest):
    # Where an odd and an even wall meet, eigenvalues of the plate are complex: there are no such modes to give.
    COMPLEX = PLATE.replace("  - { fix: [x, y], at: { face: x-, layers: 1 } }",
                            "  - { wall: x-, type: odd }\n  - { wall: y-, type: even }").replace("modes: 6", "modes: 20")

    def test_a_goal_that_is_not_reached_is_exit_code_1_and_the_result_says_so(self):
        self.write("case.yaml", self.COMPLEX)
        run = self.perimode("modal", "case.yaml", "--quiet")
        self.assertEqual(run.returncode, 1)
        self.assertEqual(len(run.stderr.splitlines()), 1)
        self.assertTrue(run.stderr.startswith("perimode: error: eigenvalues are not real"), run.stderr)
        self.assertEqual(sorted(p.name for p in (self.folder / "out/plate").iterdir()), FILES)
        summary = json.loads((self.folder / "out/plate/summary.json").read_text())
        self.assertEqual(summary["status"], "not_converged")
        self.assertIn("not real", summary["message"])

    def test_a_certificate_that_is_not_asked_for_is_not_missed(self):
        self.write("case.yaml", PLATE)
        run = self.good("modal", "case.yaml", "--set", "analysis.modal={ modes: 6, certificate: none, solver: lanczos }")
        self.assertIn("completeness not checked", run.stdout)
        summary = json.loads((self.folder / "out/plate/summary.json").read_text())
        self.assertEqual(summary["certificate"]["method"], "none")
        self.assertIs(summary["certificate"]["complete"], False)

    def test_certificates_by_inertia_and_by_restart(self):
        self.write("case.yaml", BLOCK)
        for method in ("inertia", "restart"):
            self.good("modal", "case.yaml", "--force",
                      "--set", "analysis.modal={ modes: 20, certificate: %s, solver: lanczos }" % method)
            certificate = json.loads((self.folder / "out/block/summary.json").read_text())["certificate"]
            self.assertEqual(certificate["method"], method)
            self.assertIs(certificate["complete"], True)
            self.assertGreaterEqual(certificate["count"], 20)


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
                          ["new", "modal", "--help"]):
            with self.subTest(" ".join(arguments)):
                run = self.good(*arguments)
                self.assertEqual(run.stderr, "")
                self.assertIn("Example", run.stdout)
                self.assertIn("perimode " + (arguments[0] if arguments[0] != "--help" else "modal"), run.stdout)

    def test_help_lists_the_options(self):
        text = self.good("modal", "--help").stdout + self.good("--help").stdout
        for option in ("--set", "--output", "--force", "--threads", "--quiet", "--version", "--matrices"):
            self.assertIn(option, text)

    def test_a_new_case_is_complete(self):
        printed = self.good("new", "modal").stdout
        self.good("new", "modal", "mine.yaml")
        self.assertEqual((self.folder / "mine.yaml").read_text(), printed)
        self.good("check", "mine.yaml")
        self.good("modal", "mine.yaml", "--set", "body.particles.grid.spacing=0.02")
        self.good("new", "modal", "mine.yaml", "--force")

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
