#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Checks who includes whom.

A room includes itself and the rooms before it; a public header includes no third party but Eigen and
the standard library. No two headers define a type of the same name: both would be one to the linker.
Files longer than 400 lines are named, which is a warning only.
"""

import pathlib
import re
import sys

ROOMS = ["core", "geometry", "linalg", "bonds", "material", "boundary", "assembly", "modal", "statics", "dynamics",
         "fracture", "dispersion", "reference", "io", "cli"]
LONG = 400
TYPE = re.compile(r"^(?:struct|class|enum class) (\w+)(?: final)?(?: : [^;]*)? \{", re.MULTILINE)
INCLUDE = re.compile(r'^\s*#\s*include\s*([<"])([^>"]+)[>"]')


def room_of(included: str) -> str | None:
    """The room an include path points into, None for anything else."""
    parts = pathlib.PurePosixPath(included).parts
    if parts and parts[0] == "perimode":
        parts = parts[1:]
    return parts[0] if len(parts) > 1 and parts[0] in ROOMS else None


def is_standard(included: str) -> bool:
    return "/" not in included and "." not in included


def problems_of(path: pathlib.Path, room: str, public: bool) -> list[str]:
    found = []
    for number, line in enumerate(path.read_text(encoding="utf-8").splitlines(), start=1):
        match = INCLUDE.match(line)
        if not match:
            continue
        included = match.group(2)
        target = room_of(included)
        if target is not None:
            if ROOMS.index(target) > ROOMS.index(room):
                found.append(f"{path}:{number}: room '{room}' includes '{included}' of the later room '{target}'")
        elif included.startswith("perimode/"):
            found.append(f"{path}:{number}: '{included}' lies in no known room")
        elif public and not is_standard(included) and not included.startswith("Eigen/"):
            found.append(f"{path}:{number}: a public header includes '{included}'; only Eigen is allowed there")
    return found


def twice_defined(headers: list[pathlib.Path]) -> list[str]:
    first, found = {}, []
    for path in headers:
        for name in TYPE.findall(path.read_text(encoding="utf-8")):
            if first.setdefault(name, path) != path:
                found.append(f"{path}: {name} is defined in {first[name]} too; give one of them another name")
    return found


def main() -> int:
    root = pathlib.Path(__file__).resolve().parent.parent
    problems, long_files = [], []
    for base, public in ((pathlib.Path("include/perimode"), True), (pathlib.Path("src"), False)):
        for path in sorted((root / base).rglob("*.[ch]pp")):
            relative = path.relative_to(root)
            room = path.relative_to(root / base).parts[0]
            if room not in ROOMS:
                problems.append(f"{relative}: '{room}' is no known room")
                continue
            problems += [p.replace(f"{root}/", "") for p in problems_of(path, room, public)]
    problems += [p.replace(f"{root}/", "") for p in twice_defined(
        [path for base in ("include/perimode", "src") for path in sorted((root / base).rglob("*.hpp"))])]
    for folder in ("include", "src", "tests", "studies"):
        for path in sorted((root / folder).rglob("*.[ch]pp")):
            lines = path.read_text(encoding="utf-8").count("\n")
            if lines > LONG:
                long_files.append(f"{path.relative_to(root)}: {lines} lines (aim under {LONG})")
    for text in long_files:
        print(f"warning: {text}")
    for text in problems:
        print(text)
    return 1 if problems else 0


if __name__ == "__main__":
    sys.exit(main())
