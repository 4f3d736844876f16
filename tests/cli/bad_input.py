# SPDX-License-Identifier: BSD-3-Clause
"""Every kind of bad input: exit code 2, one line with the place, what was expected, what came and how to mend it,
and nothing written."""
from program import BAR, BLOCK, CLOUD, PLATE, ProgramTest, cloud_csv, main

BASES = {"plate": PLATE, "bar": BAR, "block": BLOCK, "cloud": CLOUD}

# name: base, line to replace (by its first word), new line with ^ where the error is, words of the message
CASES = {
    # the text
    "tab": ("plate", "plane", "^\tplane: stress", "tab"),
    "open list": ("plate", "output", "output: { fields: [displacement ^}", ""),
    "open quote": ("plate", "title", 'title: ^"plate', 'closing "'),
    "two documents": ("plate", "output", "^---\ntitle: again", "one YAML document"),
    "duplicate key": ("plate", "plane", "  plane: stress\n  ^plane: strain", "'plane' again"),
    "duplicate key in braces": ("plate", "horizon", "  horizon: { ratio: 3, ^ratio: 3 }", "'ratio' again"),
    "duplicate section": ("plate", "title", "title: a\n^title: b", "'title' again"),
    # keys
    "unknown key of the case": ("plate", "title", "^titel: plate", "title"),
    "unknown key of the body": ("plate", "thickness", "  ^thicknes: 1", "thickness"),
    "unknown key of the grid": ("plate", "particles",
        "  particles: { grid: { lower: [0, 0], upper: [1, 0.5], ^spacng: 0.1 } }", "spacing"),
    "unknown key of the analysis": ("plate", "analysis", "analysis: { modal: { ^mode: 6 } }", "modes"),
    "unknown key of a condition": ("plate", "- { fix", "  - { ^fixed: [x], at: { face: x-, layers: 1 } }", "fix"),
    "unknown key of a region": ("plate", "- { fix", "  - { fix: [x], at: { face: x-, ^layer: 1 } }", "layers"),
    "no colon blank": ("plate", "horizon", "  horizon: { ^ratio:3 }", "space"),
    # numbers
    "unit": ("plate", "youngs_modulus", "  youngs_modulus: ^210 GPa", "units are not read"),
    "unit in quotes": ("plate", "youngs_modulus", '  youngs_modulus: ^"210 GPa"', "plain SI number in Pa"),
    "word for a number": ("plate", "density", "  density: ^heavy", "a number > 0"),
    "nan": ("plate", "density", "  density: ^nan", "finite"),
    "yaml nan": ("plate", "density", "  density: ^.nan", "a number"),
    "infinity": ("plate", "density", "  density: ^inf", "finite"),
    "too large for a double": ("plate", "density", "  density: ^1.0e+999", "double"),
    "negative density": ("plate", "density", "  density: ^-7850", "> 0"),
    "zero modulus": ("plate", "youngs_modulus", "  youngs_modulus: ^0", "> 0"),
    "zero thickness": ("plate", "thickness", "  thickness: ^0", "> 0"),
    "negative horizon": ("plate", "horizon", "  horizon: { ratio: ^-3 }", "> 0"),
    "list for a number": ("plate", "density", "  density: ^[7850]", "a list"),
    "nothing for a number": ("plate", "density", "  ^density:", "nothing"),
    # the body
    "dimension 4": ("plate", "dimension", "  dimension: ^4", "1, 2, 3"),
    "dimension in words": ("plate", "dimension", "  dimension: ^two", "1, 2, 3"),
    "plane of a block": ("block", "horizon", "  horizon: { ratio: 2 }\n  ^plane: stress", "dimension 2"),
    "area of a plate": ("plate", "thickness", "  ^area: 1", "dimension 1"),
    "unknown plane": ("plate", "plane", "  plane: ^strian", "strain"),
    "no body": ("plate", "title", None, "'body'"),
    "missing horizon": ("plate", "horizon", "", "'horizon'"),
    "missing spacing": ("plate", "particles", "  particles: { grid: { lower: [0, 0], upper: [1, 0.5] } }", "'spacing'"),
    "missing density": ("plate", "density", "", "'density'"),
    "no particles rule": ("plate", "particles", "  ^particles: {}", "grid, file"),
    "both particles rules": ("plate", "particles",
        "  particles: { grid: { lower: [0, 0], upper: [1, 0.5], spacing: 0.1 }, ^file: a.csv }", "both"),
    "no horizon rule": ("plate", "horizon", "  ^horizon: {}", "ratio, length, neighbours"),
    "both horizon rules": ("plate", "horizon", "  horizon: { ratio: 3, ^length: 0.3 }", "both"),
    "box not of whole cells": ("plate", "particles",
        "  particles: { grid: ^{ lower: [0, 0], upper: [1, 0.55], spacing: 0.1 } }", "whole number"),
    "spacing zero": ("plate", "particles",
        "  particles: { grid: { lower: [0, 0], upper: [1, 0.5], spacing: ^0 } }", "> 0"),
    "box upside down": ("plate", "particles",
        "  particles: { grid: { lower: [0, 1], upper: ^[1, 0.5], spacing: 0.1 } }", "lower"),
    "vector too short": ("plate", "particles",
        "  particles: { grid: { lower: ^[0], upper: [1, 0.5], spacing: 0.1 } }", "2 numbers"),
    "vector too long": ("plate", "particles",
        "  particles: { grid: { lower: [0, 0], upper: ^[1, 0.5, 1], spacing: 0.1 } }", "2 numbers"),
    "everything removed": ("plate", "particles",
        "  particles: { grid: { lower: [0, 0], upper: [1, 0.5], spacing: 0.1,"
        " remove: [ { ball: { centre: [0, 0], radius: 9 } } ] } }", ""),
    "horizon below a spacing": ("plate", "horizon", "  horizon: { ratio: ^0.4 }", "1/2 spacing"),
    "horizon without end": ("plate", "horizon", "  horizon: { ratio: ^1.0e+8 }", "at most"),
    "mesh of another kind": ("cloud", "particles", "  particles: { file: ^plate.vtk }", ".msh"),
    "mesh file that is not there": ("cloud", "particles", "  particles: { file: ^nowhere.msh }", "nowhere.msh"),
    "cloud file that is not there": ("cloud", "particles", "  particles: { file: ^nowhere.csv }", "nowhere.csv"),
    "ratio on a cloud": ("cloud", "horizon", "  horizon: { ^ratio: 3 }", "cloud"),
    "periodic cloud without a period": ("cloud", "horizon", "  horizon: { length: 0.25 }\n  periodic: ^[x]", "period"),
    "period of a grid": ("plate", "particles",
        "  particles: { grid: { lower: [0, 0], upper: [1, 0.5], spacing: 0.1 }, ^period: [1, 0.5] }", "box"),
    "cloud longer than its period": ("cloud", "particles",
        "  periodic: [x]\n  particles: { file: ^cloud.csv, period: [0.5, 1] }", "within one period"),
    "period shorter than two bonds": ("cloud", "horizon",
        "  horizon: { length: ^0.35 }\n  periodic: [x]", "twice the longest reach",
        ("cloud.csv }", "cloud.csv, period: [0.6, 1] }")),
    "more neighbours than particles": ("cloud", "horizon", "  horizon: { neighbours: ^500 }", ""),
    "no whole neighbours": ("cloud", "horizon", "  horizon: { neighbours: ^7.5 }", "whole number"),
    "periodic along z in 2D": ("plate", "horizon", "  horizon: { ratio: 3 }\n  periodic: [^z]", "x, y"),
    "periodic twice": ("plate", "horizon", "  horizon: { ratio: 3 }\n  periodic: [x, ^x]", "once"),
    # cracks
    "crack without an end": ("plate", "horizon", "  horizon: { ratio: 3 }\n  precracks: [ ^{ from: [0, 0] } ]", "'to'"),
    "crack of no length": ("plate", "horizon",
        "  horizon: { ratio: 3 }\n  precracks: [ { from: [0, 0], to: ^[0, 0] } ]", "length"),
    "crack with a short end": ("plate", "horizon",
        "  horizon: { ratio: 3 }\n  precracks: [ { from: [0, 0], to: ^[1] } ]", "2 numbers"),
    "polygon in 2D": ("plate", "horizon",
        "  horizon: { ratio: 3 }\n  precracks: [ { ^polygon: [[0, 0], [1, 1], [1, 0]] } ]", "3D"),
    "segment in 3D": ("block", "horizon",
        "  horizon: { ratio: 2 }\n  precracks: [ { ^from: [0, 0, 0], to: [1, 1, 1] } ]", "polygon"),
    "polygon of two corners": ("block", "horizon",
        "  horizon: { ratio: 2 }\n  precracks: [ { polygon: ^[[0, 0, 0], [1, 1, 1]] } ]", "3 corners"),
    "polygon that is not plane": ("block", "horizon",
        "  horizon: { ratio: 2 }\n  precracks: [ { polygon: [[0, 0, .5], [1, 0, .5], [1, 1, .5], [0, 1, .9]] } ]", "plane"),
    "crack that is a word": ("plate", "horizon", "  horizon: { ratio: 3 }\n  precracks: [ ^edge ]", "a map"),
    # the material
    "poisson's ratio": ("plate", "density", "  density: 7850\n  poissons_ratio: ^0.3", "1/3"),
    "poisson's ratio in 3D": ("block", "density", "  density: 7850\n  poissons_ratio: ^0.3", "1/4"),
    "unknown kernel": ("plate", "micromodulus", "  micromodulus: { kernel: ^konstant }", "constant"),
    "p of a constant kernel": ("plate", "micromodulus", "  micromodulus: { kernel: constant, ^p: 2 }", "gaussian"),
    "unknown calibration": ("plate", "micromodulus", "  calibration: ^discret", "discrete"),
    "exact volumes in 2D": ("plate", "volume_correction", "  volume_correction: ^exact", "dimension 1"),
    "two strengths": ("plate", "density", "  density: 7850\n  fracture_energy: 1\n  ^critical_stretch: 1", "both"),
    "self cell of a constant kernel": ("bar", "density", "  density: 2700\n  self_cell: ^true", "inverse_distance"),
    "no truth": ("bar", "density", "  density: 2700\n  self_cell: ^perhaps", "true, false"),
    "material of an unknown block": ("plate", "boundary", "materials: { ^core: { density: 1 } }\nboundary:", "'core'"),
    # the boundary
    "condition of no kind": ("plate", "- { fix", "  - ^{ at: { face: x-, layers: 1 } }", "fix, prescribe, wall"),
    "condition of two kinds": ("plate", "- { fix", "  - { fix: [x], ^wall: x- }", "both"),
    "fix of nothing": ("plate", "- { fix", "  - { fix: ^[], at: { face: x-, layers: 1 } }", "one component"),
    "fix along z in 2D": ("plate", "- { fix", "  - { fix: [^z], at: { face: x-, layers: 1 } }", "x, y"),
    "fix nowhere": ("plate", "- { fix", "  - ^{ fix: [x] }", "'at'"),
    "unknown face": ("plate", "- { fix", "  - { fix: [x], at: { face: ^left, layers: 1 } }", "x-"),
    "layers below one": ("plate", "- { fix", "  - { fix: [x], at: { face: x-, layers: ^0 } }", "whole number >= 1"),
    "half a layer": ("plate", "- { fix", "  - { fix: [x], at: { face: x-, layers: ^1.5 } }", "whole number"),
    "depth on a grid": ("plate", "- { fix", "  - { fix: [x], at: { face: x-, ^depth: 0.1 } }", "layers"),
    "region of two shapes": ("plate", "- { fix",
        "  - { fix: [x], at: { face: x-, layers: 1, ^nearest: [0, 0] } }", "both"),
    "region that holds nothing": ("plate", "- { fix",
        "  - { fix: [x], at: ^{ ball: { centre: [7, 7], radius: 1 } } }", "particle"),
    "region in an unknown block": ("plate", "- { fix", "  - { fix: [x], at: ^{ block: core } }", "'core'"),
    "centre of a ball in 3D": ("plate", "- { fix",
        "  - { fix: [x], at: { ball: { centre: ^[0, 0, 0], radius: 1 } } }", "2 numbers"),
    "wall on a cloud": ("cloud", "analysis",
        "boundary:\n  - { wall: ^x-, type: mirror }\nanalysis: { modal: { modes: 6 } }", "grid"),
    "layers on a cloud": ("cloud", "analysis",
        "boundary:\n  - { fix: [x], at: { face: x-, ^layers: 1 } }\nanalysis: { modal: { modes: 6 } }", "depth"),
    "wall without a type": ("plate", "- { fix", "  - ^{ wall: x- }", "'type'"),
    "unknown wall": ("plate", "- { fix", "  - { wall: x-, type: ^miror }", "mirror"),
    "two walls on a face": ("plate", "- { fix",
        "  - { wall: x-, type: mirror }\n  - { wall: ^x-, type: antimirror }", "line"),
    "traction of surface nodes in 2D": ("plate", "- { fix", "  - { wall: x-, type: surface_nodes, ^traction: 1 }", "2D"),
    "displacement of a mirror": ("plate", "- { fix", "  - { wall: x-, type: mirror, ^displacement: [0, 0] }", "surface_nodes"),
    "wall where it is periodic": ("plate", "boundary",
        "boundary:\n  - { wall: x-, type: mirror }", "periodic", ("  horizon: { ratio: 3 }", "  horizon: { ratio: 3 }\n  periodic: [x]")),
    "everything fixed": ("plate", "- { fix", "  - { fix: [x, y], at: { box: { lower: [0, 0], upper: [1, 1] } } }",
        "free degree of freedom"),
    # the analysis
    "no modal section": ("plate", "analysis", "", "analysis.modal"),
    "no modes": ("plate", "analysis", "analysis: { modal: { modes: ^0 } }", "whole number >= 1"),
    "negative modes": ("plate", "analysis", "analysis: { modal: { modes: ^-3 } }", "whole number >= 1"),
    "half a mode": ("plate", "analysis", "analysis: { modal: { modes: ^2.5 } }", "whole number"),
    "more modes than dofs": ("plate", "analysis", "analysis: { modal: { modes: 1000 } }", "degrees of freedom"),
    "range upside down": ("plate", "analysis", "analysis: { modal: { range: [500, ^100] } }", "> 500"),
    "range of one": ("plate", "analysis", "analysis: { modal: { range: ^[500] } }", "2 frequencies"),
    "range and modes": ("plate", "analysis", "analysis: { modal: { modes: 3, ^range: [0, 9] } }", "both"),
    "range and shift": ("plate", "analysis", "analysis: { modal: { shift: 3, ^range: [0, 9] } }", "both"),
    "negative shift": ("plate", "analysis", "analysis: { modal: { shift: ^-1 } }", ">= 0"),
    "unknown solver": ("plate", "analysis", "analysis: { modal: { solver: ^lapack } }", "lanczos"),
    "unknown certificate": ("plate", "analysis", "analysis: { modal: { certificate: ^yes } }", "inertia"),
    "unknown reference": ("plate", "analysis", "analysis: { modal: { reference: ^exact } }", "closed_form"),
    "unknown field": ("plate", "output", "output: { fields: [^colour] }", "displacement"),
    # motion in time
    "end before start": ("plate", "analysis", "analysis: { transient: { end: ^-1.0e-3 } }", "> 0"),
    "no end": ("plate", "analysis", "analysis: { ^transient: { dt: 1.0e-7 } }", "'end'"),
    "no time step": ("plate", "analysis", "analysis: { transient: { end: 1, dt: ^0 } }", "> 0"),
    "negative time step": ("plate", "analysis", "analysis: { transient: { end: 1, dt: ^-1.0e-7 } }", "> 0"),
    "probe outside": ("plate", "analysis",
        "analysis: { transient: { end: 1, probes: { tip: { displacement_at: ^[2, 0] } } } }", "0 <= x <= 1"),
    "formula that does not parse": ("plate", "analysis",
        'analysis: { transient: { end: 1, initial: { displacement: [^"sin(pi*x", 0] } } }', "a formula"),
    "formula of something else": ("plate", "analysis",
        'analysis: { transient: { end: 1, initial: { velocity: [0, ^"2*velocity"] } } }', "velocity"),
    "load that varies in an unknown way": ("plate", "analysis",
        "analysis: { transient: { end: 1, loads: [ { body_force: [1, 0], time: { ^sine: 1 } } ] } }", "half_sine"),
    "load on an unknown block": ("plate", "analysis",
        "analysis: { transient: { end: 1, loads: [ { body_force: [1, 0], at: ^{ block: core } } ] } }", "core"),
    "time table that is not there": ("plate", "analysis",
        "analysis: { transient: { end: 1, loads: [ { body_force: [1, 0], time: { table: ^nowhere.csv } } ] } }", "nowhere.csv"),
    "large rotations of an implicit method": ("plate", "analysis",
        "kinematics: large_rotation\nanalysis: { transient: { end: 1, method: ^hht } }", "central_difference"),
    "directory that is a list": ("plate", "output", "output: { directory: ^[out] }", "text"),
}

CLOUDS = {  # name: file, line:column, words
    "empty": (b"", None, ""),
    "header only": (b"x,y,volume\n", None, "particle"),
    "no header": (b"0,0,1\n1,0,1\n", "1:1", "x,y,volume"),
    "header of 3D": (b"x,y,z,volume\n0,0,0,1\n", None, "x,y,volume"),
    "missing volume": (b"x,y\n0,0\n", None, "volume"),
    "too few fields": (b"x,y,volume\n0,0,1\n0.1,0\n", "3:", "3"),
    "too many fields": (b"x,y,volume\n0,0,1,2\n", "2:", "3"),
    "word": (b"x,y,volume\n0,0,1\n0.1,zero,1\n", "3:5", "zero"),
    "nan": (b"x,y,volume\n0,nan,1\n", "2:3", "nan"),
    "negative volume": (b"x,y,volume\n0,0,-1\n", "2:5", "-1"),
    "one place twice": (b"x,y,volume\n0,0,1\n0.1,0,1\n0,0,1\n", "4:", ""),
    "garbage": (bytes(range(256)), None, ""),
}


class BadCases(ProgramTest):
    def refuse(self, text, words, place):
        case = self.write("case.yaml", text)
        self.write("cloud.csv", cloud_csv())
        before = self.files()
        for command in ("modal", "check"):
            if command == "check" and words == "analysis.modal":
                continue  # a case without an analysis may be checked
            line = self.complaint(self.perimode(command, case.name))
            self.assertIn(words, line)
            if place:
                self.assertIn(f"case.yaml:{place[0]}:{place[1]}: ", line)
            self.assertEqual(self.files(), before, "nothing is written")


def make_test(name, base, first_word, new_line, words, *substitutions):
    def test(self):
        text = BASES[base]
        for old, new in substitutions:
            text = text.replace(old, new)
        if new_line is None:
            text = "title: nothing else\n"
        else:
            lines = text.splitlines()
            found = [i for i, line in enumerate(lines) if line.strip().startswith(first_word)]
            lines[found[0]] = new_line
            text = "\n".join(lines) + "\n"
        place = None
        if "^" in text:
            before = text[: text.index("^")]
            place = (before.count("\n") + 1, len(before) - before.rfind("\n"))
            text = text.replace("^", "")
        self.refuse(text, words, place)

    test.__name__ = "test_" + "".join(c if c.isalnum() else "_" for c in name)
    setattr(BadCases, test.__name__, test)


for case_name, row in CASES.items():
    make_test(case_name, *row)


class BadClouds(ProgramTest):
    def test_every_one_is_refused(self):
        for name, (content, place, words) in CLOUDS.items():
            with self.subTest(name):
                self.write("case.yaml", CLOUD)
                self.write("cloud.csv", content)
                before = self.files()
                line = self.complaint(self.perimode("modal", "case.yaml"))
                self.assertIn("cloud.csv", line)
                self.assertIn(words, line)
                if place:
                    self.assertIn("cloud.csv:" + place, line)
                self.assertEqual(self.files(), before)


class Streams(ProgramTest):
    def test_an_error_found_while_the_body_is_built_is_the_only_line(self):
        self.write("case.yaml", PLATE.replace("{ face: x-, layers: 1 }", "{ ball: { centre: [7, 7], radius: 1 } }"))
        for quiet in ([], ["--quiet"]):
            with self.subTest(quiet=quiet):
                run = self.perimode("modal", "case.yaml", *quiet)
                self.assertEqual(len(run.stderr.splitlines()), 1, run.stderr)


class BadFiles(ProgramTest):
    def test_files_that_are_no_case(self):
        self.write("empty.yaml", "")
        self.write("blank.yaml", "\n\n# nothing but a comment\n")
        self.write("garbage.yaml", bytes((i * 37 + 11) % 256 for i in range(5000)))
        self.write("zeros.yaml", bytes(64))
        self.write("list.yaml", "- a\n- b\n")
        self.write("word.yaml", "plate\n")
        self.write("exodus.yaml", b"CDF\x02" + bytes(200))
        (self.folder / "folder.yaml").mkdir()
        before = self.files()
        for name in ["missing.yaml", "no/such/folder.yaml", *before]:
            for command in ("modal", "check"):
                with self.subTest(name, command=command):
                    line = self.complaint(self.perimode(command, name))
                    self.assertIn(name, line)
        self.assertEqual(self.files(), before)

    def test_bad_json(self):
        self.write("case.json", '{ "title": "a", "body": { "dimension": 2, "dimension": 3 } }\n')
        line = self.complaint(self.perimode("modal", "case.json"))
        self.assertIn("case.json:1:43", line)


class BadArguments(ProgramTest):
    def test_every_one_is_refused_with_one_line(self):
        self.write("case.yaml", PLATE)
        before = self.files()
        for arguments, words in [
            ([], ""),
            (["modal"], "case"),
            (["model", "case.yaml"], ""),
            (["modal", "case.yaml", "--ouput", "x"], "--ouput"),
            (["modal", "case.yaml", "other.yaml"], "other.yaml"),
            (["modal", "case.yaml", "--threads", "0"], "threads"),
            (["modal", "case.yaml", "--threads", "many"], "threads"),
            (["modal", "case.yaml", "--threads", "100000"], "threads"),
            (["modal", "case.yaml", "--output"], "output"),
            (["new"], ""),
            (["new", "dynamic"], ""),
            (["-x"], "-x"),
        ]:
            with self.subTest(" ".join(arguments)):
                line = self.one_error(self.perimode(*arguments), 2)
                self.assertIn(words, line)
        self.assertEqual(self.files(), before)

    def test_every_bad_override_is_refused(self):
        self.write("case.yaml", PLATE)
        before = self.files()
        for override, words in [
            ("body.horizon.ratio", "key=value"),
            ("=3", "key=value"),
            ("body..ratio=3", "dotted path"),
            ("body.horizon.ratoi=3", "ratio"),
            ("body.horizon.ratio=three", "a number > 0"),
            ("body.horizon.ratio=3 m", "units"),
            ("body.horizon.ratio.value=3", "body.horizon.ratio"),
            ("body.horizon.length=0.3", "both"),
            ("boundary.first.fix=[x]", "number from 0"),
            ("boundary.7.fix=[x]", "number from 0"),
            ("analysis.modal.modes=[1", ""),
            ("colour=red", "title"),
        ]:
            with self.subTest(override):
                line = self.complaint(self.perimode("modal", "case.yaml", "--set", override))
                self.assertIn("--set " + override, line)
                self.assertIn(words, line)
        self.assertEqual(self.files(), before)

    def test_a_result_is_not_written_over_what_is_none(self):
        self.write("case.yaml", PLATE)
        self.write("taken", "a file")
        (self.folder / "diary").mkdir()
        self.write("diary/monday.txt", "dear diary")
        before = self.files()
        for target in ("taken", "diary", "taken/below"):
            for force in ([], ["--force"]):
                with self.subTest(target, force=force):
                    run = self.perimode("modal", "case.yaml", "--output", target, *force)
                    self.assertIn(run.returncode, (2, 3) if target == "taken/below" else (2,))
                    self.complaint(run, run.returncode)
        self.assertEqual(self.files(), before)

    def test_a_template_replaces_no_file(self):
        self.write("mine.yaml", "precious")
        line = self.complaint(self.perimode("new", "modal", "mine.yaml"))
        self.assertIn("--force", line)
        self.assertEqual((self.folder / "mine.yaml").read_text(), "precious")


if __name__ == "__main__":
    main()
