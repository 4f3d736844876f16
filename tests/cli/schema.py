# SPDX-License-Identifier: BSD-3-Clause
"""docs/case.schema.json against the reader: both take the same cases. schema.py PERIMODE READ_CASES"""
import copy
import json
import pathlib
import re
import subprocess
import sys
import tempfile
import unittest

import jsonschema
import yaml

PROGRAM, READER = sys.argv[1:3]
ROOT = pathlib.Path(__file__).resolve().parents[2]
SCHEMA = json.loads((ROOT / "docs/case.schema.json").read_text(encoding="utf-8"))
VALID = jsonschema.Draft7Validator(SCHEMA)
# What the cases name; initial fields have to be there, but are looked into when a run begins.
FILES = {"cloud.csv": "x,y,volume,block\n0,0,0.5,core\n1,0,0.5,\n0,1,0.5,core\n", "a.csv": "time,value\n0,0\n1,1\n",
         "u0.csv": "", "modes.exo": "", "coefficients.csv": "dx,dy,dz,distance,alpha\n1,0,0,0.1,2\n1,1,0,0.14,-1\n"}

# Cases that between them use every key of the schema.
FULL = {
    "plate": """
title: plate
kinematics: linear
body:
  dimension: 2
  plane: stress
  thickness: 0.01
  particles: { grid: { lower: [0, 0], upper: [1, 0.5], spacing: 0.1,
                       remove: [ { ball: { centre: [0.5, 0.25], radius: 0.1 } }, { nearest: [1, 0.5] } ] } }
  horizon: { ratio: 3 }
  periodic: [x]
  precracks: [ { from: [0.5, 0], to: [0.5, 0.2] } ]
  blocks: { inclusion: { box: { lower: [0.4, 0.2], upper: [0.6, 0.3] } }, edge: { face: y-, layers: 1 } }
material: { youngs_modulus: 210.0e+9, density: 7850, micromodulus: { kernel: gaussian, p: 3 }, calibration: discrete,
            volume_correction: linear, self_cell: false, fracture_energy: 135, poissons_ratio: 0.3333 }
materials: { inclusion: { density: 2700, micromodulus: { kernel: conical }, critical_stretch: 1.0e-3,
                          youngs_modulus: 7.0e+10, poissons_ratio: 0.3333 }, edge: { fracture_energy: 5, micromodulus: { p: 4 } } }
boundary:
  - { fix: [x, y], at: { face: y-, layers: 2 } }
  - { prescribe: { x: 0, y: 1.0e-4 }, at: { block: inclusion }, time: { ramp: 1 } }
  - { wall: y+, type: mirror }
analysis:
  modal: { modes: 10, shift: 100, solver: lanczos, certificate: inertia, reference: none }
  static:
    loads:
      - { traction: [0, 1.0e+6], at: { face: y+, layers: 1 }, time: constant }
      - { body_force: [0, -9.81], at: { box: { lower: [0, 0], upper: [1, 1] } }, time: { step: 2 } }
      - { force: [1, 0], at: { nearest: [0, 0] }, time: { table: a.csv } }
      - { force: [1, 0] }
    solver: cholesky
    tolerance: 1.0e-9
  transient:
    method: central_difference
    dt: 1.0e-7
    end: 1.0e-3
    operator: stencil
    initial: { displacement: ["1e-3*exp(-x^2)", 0], velocity: { file: u0.csv } }
    loads: [ { traction: [0, 1.0e+6], at: { face: y+, layers: 1 }, time: { ricker: 1.0e+4 } },
             { body_force: [0, 1], time: { gaussian: [1.0e-4, 2.0e-5] } }, { force: [0, 1], time: { half_sine: 1.0e-4 } } ]
    damping: { rayleigh: [10, 1.0e-9], nodal: [ { rate: 100, at: { block: edge } } ] }
    sponge: { faces: [y-, y+], width: 0.1, rate: 1.0e+4, power: 2 }
    no_fail: [ { face: y-, layers: 3 }, { block: edge }, { ball: { centre: [1, 0.25], radius: 0.1 } } ]
    probes: { tip: { displacement_at: [1, 0.25] }, v: { velocity_at: [0, 0] }, e: { strain_between: [[0.2, 0.2], [0.8, 0.2]] } }
    history_every: 10
    fields_at: [0, 5.0e-4]
    checkpoint_every: 1000
  quasistatic:
    control: event
    loads: [ { traction: [0, 1.0e+6], at: { face: y+, layers: 1 }, time: constant }, { force: [1, 0] } ]
    dead_loads: [ { body_force: [0, -9.81], at: { block: edge } } ]
    no_fail: [ { face: y-, layers: 2 }, { block: inclusion } ]
    stop: { separated: true, events: 1000, load_drop: 0.9 }
    loose: remove
    solver: update
    tolerance: 1.0e-9
    griffith: false
    fields_every: 100
    checkpoint_every: 500
output: { directory: out/plate, fields: [displacement, velocity, damage, strain, stress, energy] }
""",
    "bar": """
body: { dimension: 1, area: 1.0e-4, particles: { grid: { lower: [0], upper: [1], spacing: 0.01 } }, horizon: { length: 0.03 },
        precracks: [ { at: [0.5] }, { from: [0.2], to: [0.2] } ] }
material: { youngs_modulus: "68.0e+9", density: 2700, micromodulus: { kernel: inverse_distance }, self_cell: true,
            critical_stretch: 2.0e-3, volume_correction: exact }
boundary:
  - { wall: x-, type: surface_nodes, traction: 1.0e+6, time: { expression: "sin(pi*t)" } }
  - { wall: x+, type: surface_nodes, displacement: ["1e-3*x"], time: { step: 1.0e-4 } }
analysis: { modal: { range: [0, 5000] }, static: , transient: { method: newmark, beta: 0.3, gamma: 0.6, end: 1, solver: cg, tolerance: 1.0e-10, fields_every: 5 },
            quasistatic: { control: steps, steps: 50, end: 2, break_at_once: all, stop: { separated: false },
                           loads: [ { force: [1], at: { nearest: [1] }, time: { ramp: 2 } } ] },
            dispersion: { finite_difference: 0.5 } }
""",
    "solid": """
body: { dimension: 3, particles: { grid: { lower: [0, 0, 0], upper: [1, 1, 1], spacing: 0.1 } }, horizon: { ratio: 2 },
        precracks: [ { polygon: [[0, 0, 0.5], [0.5, 0, 0.5], [0.5, 1, 0.5]] } ] }
material: { youngs_modulus: 68.0e+9, density: 2700 }
analysis: { modal: , quasistatic: { griffith: true }, transient: { method: hht, alpha: -0.05, dt: auto, end: 1, solver: factor } }
""",
    "waves": """
body: { dimension: 2, particles: { grid: { lower: [0, 0], upper: [1, 1], spacing: 0.1 } }, horizon: { ratio: 2 } }
material: { youngs_modulus: 68.0e+9, density: 2700 }
analysis:
  dispersion:
    path: [[0, 0], [1, 0], [1, 1]]
    points: 30
    zone: 16
    time_step: 1.0e-8
    integrator: newmark
    phase_error: 0.01
    polar: { wave_number: 0.5, directions: 36 }
    spectrum: { run: out/pulse }
""",
    "shells": """
body: { dimension: 2, particles: { grid: { lower: [0, 0], upper: [1, 1], spacing: 0.1 } }, horizon: { ratio: 2 },
        blocks: { a: { nearest: [0, 0] }, b: { nearest: [1, 1] } } }
material: { youngs_modulus: 68.0e+9, density: 2700, micromodulus: { kernel: shells, alpha: [8.2, 1.5, -3] },
            break_negative: true, calibration: continuum, volume_correction: none }
materials: { a: { micromodulus: { kernel: fourier, a0: 1, a: [0.5, -0.25], w: 0.7 }, break_negative: false },
             b: { micromodulus: { alpha: [1, 1, 1] } } }
analysis: { dispersion: { optimise: { norm: l2, domain: zone, lower_bound: -5, poissons_ratio: 0.3, weights: [1, 2], fit: 3 } } }
""",
    "table": """
body: { dimension: 3, particles: { grid: { lower: [0, 0, 0], upper: [1, 1, 1], spacing: 0.1 } }, horizon: { ratio: 1.5 } }
material: { youngs_modulus: 68.0e+9, density: 2700, micromodulus: { kernel: shells, file: coefficients.csv } }
analysis: { dispersion: { optimise: } }
""",
    "fourier": """
body: { dimension: 1, particles: { grid: { lower: [0], upper: [1], spacing: 0.1 } }, horizon: { ratio: 2 } }
material: { youngs_modulus: 68.0e+9, density: 2700, micromodulus: { kernel: fourier, a0: 1, a: [0.5, -0.25], w: 0.7 } }
analysis: { dispersion: { optimise: { method: galerkin, poissons_ratio: theory } } }
""",
    "cloud": """
title: cloud
body: { dimension: 2, particles: { file: cloud.csv, period: [2, 2.5] }, horizon: { neighbours: 2 }, periodic: [y] }
material: { youngs_modulus: 68.0e+9, density: 2700 }
materials: { core: { density: 1000 } }
boundary: [ { fix: [x], at: { face: x-, depth: 0.1 } } ]
analysis:
  modal: { modes: 2 }
  quasistatic:
  dispersion: { waves: 3 }
  transient: { method: modal, modes: 2, end: 1, damping: { rayleigh: [0, 0] },
               initial: { displacement: { mode: { file: modes.exo, number: 1, scale: 1.0e-3 } } } }
""",
}


def samples():
    """Name and text of the valid cases of the project."""
    yield from FULL.items()
    for command in ("modal", "static", "transient", "quasistatic", "dispersion"):
        run = subprocess.run([PROGRAM, "new", command], capture_output=True, text=True, check=True)
        yield f"new {command}", run.stdout
    for folder in ("studies", "tests/bench", "tests/fuzz/corpus/case"):
        for file in sorted((ROOT / folder).rglob("*.[yj][as]*")):
            if file.suffix in (".yaml", ".json") and not file.name.startswith("bad_"):
                yield str(file.relative_to(ROOT)), file.read_text(encoding="utf-8")
    for document in (ROOT / "README.md", ROOT / "docs/case_reference.md"):
        for number, text in enumerate(re.findall(r"```yaml\n(.*?)```", document.read_text(encoding="utf-8"), re.S)):
            if re.search(r"^body:", text, re.M):
                yield f"{document.name} {number}", text


def read(cases):
    """What the reader says to each case."""
    with tempfile.TemporaryDirectory() as folder:
        for name, text in FILES.items():
            (pathlib.Path(folder) / name).write_text(text, encoding="utf-8")
        run = subprocess.run([READER, folder], input="".join(json.dumps(case) + "\n" for case in cases),
                             capture_output=True, text=True, check=True)
    answers = run.stdout.splitlines()
    assert len(answers) == len(cases)
    return answers


def paths(tree, at=()):
    yield at
    if isinstance(tree, dict):
        for key, value in tree.items():
            yield from paths(value, (*at, key))
    if isinstance(tree, list):
        for index, value in enumerate(tree):
            yield from paths(value, (*at, index))


def changed(case, at, change):
    """A copy of the case whose value at a path is replaced (or, for None, taken out)."""
    holder = {"": copy.deepcopy(case)}
    node, key = holder, ""
    for step in at:
        node, key = node[key], step
    if change is None:
        del node[key]
    else:
        node[key] = change(node[key])
    return holder[""]


def mutations(case):
    """(kind, path, case) of single changes. The kinds key and type concern the form alone, value what numbers mean."""
    for at in paths(case):
        value = case
        for step in at:
            value = value[step]
        if at:  # the length of a list is a matter of the body's dimension
            yield "key" if isinstance(at[-1], str) else "value", ("remove", *at), changed(case, at, None)
        if isinstance(value, dict):
            yield "key", ("add", *at), changed(case, at, lambda old: {**old, "unknown_key": 1})
        others = {dict: ["word", [1], 5], list: ["word", {}, {"a": 1}, 5]}.get(type(value), [[], [1], {}, {"a": 1}])
        if isinstance(value, (int, float)) and not isinstance(value, bool):
            others = [*others, "word", "5 mm", "", True]
            for number in (-abs(value), 0, -1, -0.5, "-1.5", "0"):
                yield "value", (number, *at), changed(case, at, lambda _old, n=number: n)
        elif isinstance(value, (str, bool)):
            others = [*others, "nonsense", 7.5]
        for other in others:
            yield "type", (str(other), *at), changed(case, at, lambda _old, o=other: o)


class Schema(unittest.TestCase):
    def test_is_a_schema_whose_every_value_is_described(self):
        jsonschema.Draft7Validator.check_schema(SCHEMA)

        def described(node):
            return "description" in node or "description" in SCHEMA["definitions"].get(node.get("$ref", "").split("/")[-1], {})

        def walk(node, at):
            if isinstance(node, dict):
                for key, value in node.get("properties", {}).items():
                    if isinstance(value, dict) and node.get("additionalProperties") is False and "if" not in at:
                        self.assertTrue(described(value), (*at, key))
                for key, value in node.items():
                    if key not in ("if", "then", "else"):
                        walk(value, (*at, key))
            if isinstance(node, list):
                for index, value in enumerate(node):
                    walk(value, (*at, index))

        walk(SCHEMA, ())

    def test_takes_every_valid_case_as_the_reader_does(self):
        names, cases = zip(*((name, yaml.safe_load(text)) for name, text in samples()))
        self.assertGreater(len(cases), 15)
        for name, case, answer in zip(names, cases, read(cases)):
            with self.subTest(name):
                self.assertEqual([error.message for error in VALID.iter_errors(case)], [])
                self.assertEqual(answer, "ok")

    def test_uses_every_key_in_the_full_cases(self):
        used = set()
        for text in FULL.values():
            used |= {step for at in paths(yaml.safe_load(text)) for step in at if isinstance(step, str)}

        def keys(node):
            if isinstance(node, dict):
                yield from node.get("properties", {})
                for value in node.values():
                    yield from keys(value)
            if isinstance(node, list):
                for value in node:
                    yield from keys(value)

        self.assertEqual(set(keys(SCHEMA)) - used - {"z"}, set())

    def test_agrees_with_the_reader_on_single_changes(self):
        changes = [change for text in FULL.values() for change in mutations(yaml.safe_load(text))]
        answers = read([case for _, _, case in changes])
        refused_by_both = taken_by_both = 0
        meaning = []  # well-formed, but it makes no sense: only the reader knows
        for (kind, at, case), answer in zip(changes, answers):
            taken = VALID.is_valid(case)
            if taken == (answer == "ok"):
                taken_by_both += taken
                refused_by_both += not taken
                continue
            with self.subTest(kind=kind, at=at, reader=answer):
                self.assertTrue(taken, "the schema refuses what the reader takes")
                meaning.append((kind, at, answer))
                self.assertTrue(kind == "value" or ABOUT_MEANING.search(answer), "the schema takes what the reader refuses")
        form = sum(kind != "value" for kind, _, _ in meaning)
        print(f"{len(changes)} changes: {taken_by_both} taken and {refused_by_both} refused by both, {len(meaning)} refused "
              f"by the reader alone: {len(meaning) - form} numbers and lengths of lists, {form} names and inherited kernels")
        self.assertGreater(refused_by_both, 1500)


# Complaints about how the parts of a case fit together, which a schema cannot know.
ABOUT_MEANING = re.compile("expected the name of a block|`[a-z0]+` with the kernel [a-z]+ only|: an existing file|expected a formula of"
                           "|a list of . numbers or formulas|a step of at most|false without a pre-crack")

if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1], verbosity=0)
