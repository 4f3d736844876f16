# SPDX-License-Identifier: BSD-3-Clause
"""readme_test.py SOURCE PERIMODE: the README's C++ program is the tested one, and its Python reader
agrees with SciPy on a case made by the README's own commands."""
import pathlib
import re
import subprocess
import sys
import tempfile

source, perimode = pathlib.Path(sys.argv[1]), sys.argv[2]
readme = (source / "README.md").read_text(encoding="utf-8")


def block(language):
    return re.search(rf"```{language}\n(.*?)```", readme, re.S).group(1)


consumer = (source / "tests/install/consumer/main.cpp").read_text(encoding="utf-8")
assert consumer.split("\n", 1)[1] == block("cpp"), "the C++ example of the README is not tests/install/consumer/main.cpp"

python = next((p for p in ("/usr/bin/python3", sys.executable, "python3")
               if subprocess.run([p, "-c", "import scipy"], capture_output=True).returncode == 0), None)
assert python, "no python with scipy"
with tempfile.TemporaryDirectory() as folder:
    run = lambda *command: subprocess.run(command, cwd=folder, check=True, capture_output=True, text=True).stdout
    run(perimode, "new", "modal", "plate.yaml")
    run(perimode, "modal", "plate.yaml", "--matrices")
    printed = run(python, "-c", block("python"))
ours, scipys = ([float(x) for x in re.findall(r"\d+\.\d*", line)] for line in printed.strip().splitlines())
assert len(ours) == 5 and len(scipys) == 5, printed
assert all(abs(a - b) <= 2e-3 for a, b in zip(ours, scipys)), printed
