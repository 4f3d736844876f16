# SPDX-License-Identifier: BSD-3-Clause
"""What `perimode check` predicts of memory against what the run then takes: within 20 %, for every solver."""
import json
import random
import re

from program import ProgramTest, main

UNITS = {"MiB": 2.0 ** 20, "GiB": 2.0 ** 30}
TOLERANCE = 0.2


def box(cells, analysis):
    axes = "xyz"[:len(cells)]
    return f"""\
body:
  dimension: {len(cells)}
  particles: {{ grid: {{ lower: {[0] * len(cells)}, upper: {[float(n) for n in cells]}, spacing: 1.0 }} }}
  horizon: {{ ratio: 3 }}
material: {{ youngs_modulus: 1, density: 1 }}
boundary: [ {{ fix: [{", ".join(axes)}], at: {{ face: x-, layers: 3 }} }} ]
analysis: {analysis}
output: {{ directory: out }}
"""


def modal(solver, modes=20):
    return f"{{ modal: {{ modes: {modes}, solver: {solver} }} }}"


def static(solver, dimension):
    force = [1.0] + [0.0] * (dimension - 1)
    return f"{{ static: {{ loads: [ {{ force: {force}, at: {{ face: x+, layers: 1 }} }} ], solver: {solver} }} }}"


class Memory(ProgramTest):
    def compare(self, kind, text):
        case = self.write("case.yaml", text)
        found = re.search(r"memory +about ([\d.]+) (MiB|GiB)", self.good("check", case).stdout)
        predicted = float(found[1]) * UNITS[found[2]]
        self.good(kind, case, "--threads", "1", "--quiet", "--force")
        measured = json.loads((self.folder / "out/summary.json").read_text())["peak_memory_mb"] * 1e6
        print(f"{self.id().split('.')[-1]}: predicted {predicted / 1e6:.0f} MB, measured {measured / 1e6:.0f} MB, "
              f"ratio {predicted / measured:.2f}")
        self.assertLess(abs(predicted / measured - 1.0), TOLERANCE)

    def test_modal_chebyshev_2d(self):
        self.compare("modal", box([260, 240], modal("chebyshev")))

    def test_modal_chebyshev_of_few_modes(self):
        self.compare("modal", box([300, 240], modal("chebyshev", 3)))

    def test_modal_chebyshev_of_many_modes(self):
        self.compare("modal", box([180, 140], modal("chebyshev", 60)))

    def test_modal_chebyshev_3d(self):
        self.compare("modal", box([34, 32, 30], modal("chebyshev")))

    def test_modal_inverse(self):
        self.compare("modal", box([200, 150], modal("inverse", 6)))

    def test_modal_lanczos_2d(self):
        self.compare("modal", box([140, 120], modal("lanczos")))

    def test_modal_lanczos_3d(self):
        self.compare("modal", box([16, 15, 14], modal("lanczos")))

    def test_modal_arpack(self):
        self.compare("modal", box([100, 90], modal("arpack")))

    def test_modal_dense(self):
        self.compare("modal", box([40, 24], modal("dense")))

    def test_modal_of_a_cloud(self):
        rng = random.Random(1)
        rows = [f"{i + 0.2 * rng.random()!r},{j + 0.2 * rng.random()!r},1.0" for j in range(120) for i in range(110)]
        self.write("cloud.csv", "x,y,volume\n" + "\n".join(rows) + "\n")
        text = box([1, 1], modal("auto"))
        text = re.sub(r"particles: .*", "particles: { file: cloud.csv }", text)
        text = text.replace("{ ratio: 3 }", "{ length: 3.0 }").replace("layers: 3", "depth: 3.0")
        self.compare("modal", text)

    def test_static_multigrid_2d(self):
        self.compare("static", box([500, 400], static("multigrid", 2)))

    def test_static_multigrid_3d(self):
        self.compare("static", box([48, 44, 40], static("multigrid", 3)))

    def test_static_jacobi(self):
        self.compare("static", box([44, 40, 40], static("jacobi", 3)))

    def test_static_cholesky(self):
        self.compare("static", box([140, 120], static("cholesky", 2)))


if __name__ == "__main__":
    main()
