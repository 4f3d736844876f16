# SPDX-License-Identifier: BSD-3-Clause
"""Adds up ctest's JUnit reports: one line, 'N passed, N failed'. A missing report is a failure."""

import pathlib
import sys
import xml.etree.ElementTree as xml

passed = failed = 0
for name in map(pathlib.Path, sys.argv[1:]):
    if not name.exists():
        print(f"no report {name.name}: that step ended before its tests")
        failed += 1
        continue
    for case in xml.parse(name).getroot().iter("testcase"):
        if case.get("status") == "run":
            passed += 1
        else:
            failed += 1
            print(f"{name.stem}: {case.get('name')} {case.get('status')}")
print(f"{passed} passed, {failed} failed")
sys.exit(1 if failed else 0)
