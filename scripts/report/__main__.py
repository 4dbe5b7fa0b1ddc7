# SPDX-License-Identifier: MIT
"""python3 scripts/report OUT: see command.py. Says in one sentence which package is missing, if one is."""
import importlib.util
import os
import pathlib
import sys

PACKAGES = {"numpy": "python3-numpy", "matplotlib": "python3-matplotlib", "jinja2": "python3-jinja2"}
SYSTEM = "/usr/bin/python3"  # the one that Debian's packages are for; another may stand before it on the PATH


def main():
    missing = [name for name in PACKAGES if importlib.util.find_spec(name) is None]
    if missing and os.path.exists(SYSTEM) and os.path.realpath(sys.executable) != os.path.realpath(SYSTEM):
        os.execv(SYSTEM, [SYSTEM, *sys.argv])
    if missing:
        packages = " ".join(PACKAGES[name] for name in missing)
        sys.exit(f"report: {sys.executable} has no {' and no '.join(missing)}; install {packages} (scripts/setup does), then run python3 "
                 + " ".join(sys.argv))
    sys.path[0] = str(pathlib.Path(__file__).resolve().parent.parent)  # this folder becomes the package `report`
    from report.command import run
    sys.exit(run(sys.argv[1:]))


main()
