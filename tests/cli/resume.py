# SPDX-License-Identifier: BSD-3-Clause
"""Kills transient runs at random moments, resumes them, and compares what they leave with an uninterrupted run,
bit for bit. Bits of the latest checkpoint are flipped now and then. The seed is fixed; where a kill falls is not."""
import json
import random
import subprocess
import time

import exodus
from program import PROGRAM, ProgramTest, main

EXPLICIT = """\
title: bar
body:
  dimension: 1
  particles: { grid: { lower: [0], upper: [1], spacing: 0.005 } }
  horizon: { ratio: 3 }
material: { youngs_modulus: 68.0e+9, density: 2700, volume_correction: linear }
boundary:
  - { wall: x-, type: odd }
  - { prescribe: { x: 1.0e-5 }, at: { face: x+, layers: 3 }, time: { half_sine: 1.0e-4 } }
analysis:
  transient:
    end: 1.5e-3
    initial: { displacement: ["1.0e-3*exp(-100*(x-0.5)^2)"], velocity: ["x"] }
    damping: { rayleigh: [100, 1.0e-9] }
    loads: [ { body_force: [1.0e+5], time: { ricker: 2.0e+4 } } ]
    probes: { middle: { displacement_at: [0.5] }, end: { velocity_at: [0.9] } }
    history_every: 7
    fields_every: 200
    checkpoint_every: 100
output: { directory: out/run, fields: [displacement, velocity, strain, damage] }
"""

SETS = {
    "explicit": (),
    "newmark": ("analysis.transient.method=newmark", "analysis.transient.dt=1.0e-6"),
    "hht": ("analysis.transient.method=hht", "analysis.transient.alpha=-0.1", "analysis.transient.dt=1.0e-6",
            "analysis.transient.solver=cg"),
    "modal": ("analysis.transient.method=modal", "analysis.transient.dt=1.0e-6",
              "analysis.transient.damping.rayleigh=[100, 0]"),
    "breaking": ("kinematics=large_rotation", "material.critical_stretch=6.0e-3",
                 "analysis.transient.damping.rayleigh=[100, 0]"),
}
KILLS = 50  # of every kind of run
RUN_AGAIN = ("timings_s", "peak_memory_mb", "resumed_from", "particle_steps_per_second")  # differ from run to run


class Resume(ProgramTest):
    def arguments(self, sets, output, *more):
        options = [word for text in sets for word in ("--set", text)]
        return [PROGRAM, "transient", "case.yaml", "--threads", "1", "--quiet", "--output", output, *options, *more]

    def left(self, output):
        """Everything of a result that has to be the same."""
        folder = self.folder / output
        self.assertEqual(sorted(p.name for p in folder.iterdir()), ["fields.exo", "history.csv", "summary.json"])
        summary = json.loads((folder / "summary.json").read_text())
        for key in RUN_AGAIN:
            summary.pop(key)
        return (folder / "history.csv").read_bytes(), exodus.variables(folder / "fields.exo"), summary

    def once(self, arguments, seconds):
        """Runs for a while, then kills; the exit code, or None where it was killed."""
        run = subprocess.Popen(arguments, cwd=self.folder, stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL,
                               stderr=subprocess.PIPE, text=True)
        try:
            errors = run.communicate(timeout=seconds)[1]
        except subprocess.TimeoutExpired:
            run.kill()
            run.communicate()
            return None
        self.assertEqual(run.returncode, 0, errors)
        return 0

    def damage(self, file, chance):
        """Flips a bit, or cuts the file."""
        data = bytearray(file.read_bytes())
        if chance.random() < 0.5:
            data[chance.randrange(len(data))] ^= 1 << chance.randrange(8)
        else:
            del data[chance.randrange(len(data)):]
        file.write_bytes(data)

    def next_arguments(self, sets, unfinished):
        """Resumes where there is a checkpoint."""
        have = (unfinished / "checkpoint.h5").exists() or (unfinished / "checkpoint.previous.h5").exists()
        return self.arguments(sets, "out/run", *(["--resume"] if have else []), "--force")

    def run_with_kills(self, name):
        self.write("case.yaml", EXPLICIT)
        sets, chance = SETS[name], random.Random(name)
        began = time.monotonic()
        self.assertEqual(self.once(self.arguments(sets, "out/whole"), 300), 0)
        whole_seconds = time.monotonic() - began
        expected = self.left("out/whole")
        unfinished = self.folder / "out/run.unfinished"
        kills = resumed = damaged = 0
        while kills < KILLS:
            if (unfinished / "checkpoint.h5").exists() and (unfinished / "checkpoint.previous.h5").exists() and \
                    chance.random() < 0.2:
                self.damage(unfinished / "checkpoint.h5", chance)
                damaged += 1
            arguments = self.next_arguments(sets, unfinished)
            resumed += "--resume" in arguments
            if self.once(arguments, chance.uniform(0.0, whole_seconds)) is None:
                kills += 1
            else:
                self.assertEqual(self.left("out/run"), expected)
        self.assertEqual(self.once(self.next_arguments(sets, unfinished), 300), 0)
        self.assertEqual(self.left("out/run"), expected)
        self.assertGreater(resumed, 0)


for kind in SETS:
    setattr(Resume, "test_kills_of_" + kind, lambda self, kind=kind: self.run_with_kills(kind))

if __name__ == "__main__":
    main()
