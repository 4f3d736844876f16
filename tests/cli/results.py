# SPDX-License-Identifier: BSD-3-Clause
"""What good cases write and print."""
import json
import math
import struct

from program import BAR, BLOCK, CLOUD, FILES, PLATE, ProgramTest, cloud_csv, main, rows

COLUMNS = ["mode", "kind", "eigenvalue", "angular_frequency", "frequency_hz", "residual", "exact_angular_frequency",
           "relative_error", "nonlocal_angular_frequency", "classical_angular_frequency", "effective_mass_x"]


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

    def test_frequencies_of_a_growing_crack(self):
        cracked = PLATE.replace("  horizon:", "  precracks: [{ from: [0.6, 0.0], to: [0.6, 0.3] }]\n  horizon:")
        run = self.run_case(cracked, "--crack-growth", "3")
        self.assertEqual(sorted(p.name for p in (self.folder / "out/plate").iterdir()), ["crack_growth.csv", "summary.json"])
        table = rows(self.folder / "out/plate/crack_growth.csv")
        self.assertEqual(list(table[0]), ["step", "fraction", "crack_length", "cut_bonds", "factor", "mode", "frequency_hz",
                                          "relative_change", "residual"])
        self.assertEqual([(int(r["step"]), int(r["mode"])) for r in table], [(k, m) for k in range(4) for m in range(1, 7)])
        summary = json.loads((self.folder / "out/plate/summary.json").read_text())
        self.assertEqual((summary["analysis"], summary["status"], len(summary["crack_growth"])), ("modal", "done", 4))
        for r in table:
            step = summary["crack_growth"][int(r["step"])]
            self.assertIn(r["factor"], ("updated", "fresh"))
            self.assertEqual(int(r["cut_bonds"]), step["cut_bonds"])
            self.assertAlmostEqual(float(r["crack_length"]), 0.1 * int(r["step"]), delta=1e-15)
            self.assertEqual(float(r["frequency_hz"]), step["frequency_hz"][int(r["mode"]) - 1])
            self.assertLessEqual(float(r["relative_change"]), 1e-12)
        self.assertIn("cut bonds", run.stdout)
        self.assertGreaterEqual(len(run.stdout.splitlines()), 5)
        # The last line is the case itself, the first the case without its crack.
        for text, step in ((cracked, 3), (PLATE, 0)):
            self.run_case(text, "--force")
            for mode, frequency in zip(rows(self.folder / "out/plate/modes.csv"), summary["crack_growth"][step]["frequency_hz"]):
                self.assertAlmostEqual(float(mode["frequency_hz"]) / frequency, 1.0, delta=1e-9)

    def test_cracks_that_cannot_grow(self):
        self.write("case.yaml", PLATE)
        self.assertIn("expected pre-cracks that grow", self.complaint(self.perimode("modal", "case.yaml", "--crack-growth", "3")))
        self.write("case.yaml", PLATE.replace("  horizon:", "  precracks: [{ from: [2, 0], to: [2, 1] }]\n  horizon:"))
        self.assertIn("case.yaml:", self.complaint(self.perimode("modal", "case.yaml", "--crack-growth", "3")))

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


if __name__ == "__main__":
    main()
