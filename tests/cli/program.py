# SPDX-License-Identifier: BSD-3-Clause
"""Runs the perimode program in an empty folder of its own. Each script is called with the program's path."""
import csv
import os
import pathlib
import re
import subprocess
import sys
import tempfile
import unittest

PROGRAM = os.path.abspath(sys.argv[1])

FILES = ["modes.csv", "modes.exo", "summary.json"]
STAGE = re.compile(r"^ *\d+\.\d s  ")

PLATE = """\
title: plate
body:
  dimension: 2
  plane: stress
  thickness: 0.01
  particles: { grid: { lower: [0, 0], upper: [1, 0.5], spacing: 0.1 } }
  horizon: { ratio: 3 }
material:
  youngs_modulus: 210.0e+9
  density: 7850
  micromodulus: { kernel: constant }
  volume_correction: linear
boundary:
  - { fix: [x, y], at: { face: x-, layers: 1 } }
analysis: { modal: { modes: 6 } }
output: { directory: out/plate }
"""

BAR = """\
title: bar
body:
  dimension: 1
  particles: { grid: { lower: [0], upper: [1], spacing: 0.01 } }
  horizon: { ratio: 3 }
material:
  youngs_modulus: 68.0e+9
  density: 2700
  volume_correction: linear
boundary:
  - { wall: x-, type: odd }
  - { wall: x+, type: odd }
analysis: { modal: { modes: 10, reference: closed_form } }
output: { directory: out/bar }
"""

BLOCK = """\
title: block
body:
  dimension: 3
  particles: { grid: { lower: [0, 0, 0], upper: [1, 1, 1], spacing: 0.2 } }
  horizon: { ratio: 2 }
material:
  youngs_modulus: 68.0e+9
  density: 2700
analysis: { modal: { modes: 8 } }
output: { directory: out/block }
"""

CLOUD = """\
title: cloud
body:
  dimension: 2
  particles: { file: cloud.csv }
  horizon: { length: 0.25 }
material:
  youngs_modulus: 210.0e+9
  density: 7850
analysis: { modal: { modes: 6 } }
output: { directory: out/cloud }
"""


def cloud_csv(nx=6, ny=4, spacing=0.1):
    lines = ["x,y,volume,block"]
    for j in range(ny):
        for i in range(nx):
            block = "core" if i > 2 else ""
            lines.append(f"{(i + 0.5) * spacing!r},{(j + 0.5) * spacing!r},{spacing * spacing!r},{block}")
    return "\n".join(lines) + "\n"


def rows(path):
    with open(path, newline="") as file:
        return list(csv.DictReader(file))


class ProgramTest(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory(prefix="perimode_cli_")
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)

    def write(self, name, text):
        path = self.folder / name
        path.write_bytes(text if isinstance(text, bytes) else text.encode())
        return path

    def files(self):
        return sorted(str(p.relative_to(self.folder)) for p in self.folder.rglob("*"))

    def perimode(self, *arguments, timeout=300):
        return subprocess.run([PROGRAM, *map(str, arguments)], cwd=self.folder, stdin=subprocess.DEVNULL,
                              stdout=subprocess.PIPE, stderr=subprocess.PIPE, timeout=timeout, text=True,
                              errors="replace")

    def good(self, *arguments):
        run = self.perimode(*arguments)
        self.assertEqual(run.returncode, 0, run.stderr)
        return run

    def one_error(self, run, code, stdout=r"\A\Z"):
        """The run failed with one line, besides those of stages it went through before; returns it."""
        self.assertEqual(run.returncode, code, run.stderr)
        lines = [line for line in run.stderr.splitlines() if not STAGE.match(line)]
        self.assertEqual(len(lines), 1, run.stderr)
        self.assertTrue(lines[0].startswith("perimode: error: "), run.stderr)
        self.assertRegex(run.stdout, stdout)
        return lines[0]

    def complaint(self, run, code=2):
        """The one line says what was expected, what came, and a remedy."""
        line = self.one_error(run, code)
        for part in ("expected ", ", got ", "; "):
            self.assertIn(part, line)
        self.assertGreater(len(line.rsplit("; ", 1)[1]), 5, "a remedy: " + line)
        return line


def main():
    unittest.main(argv=[sys.argv[0], *sys.argv[2:]])
