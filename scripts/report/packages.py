# SPDX-License-Identifier: MIT
"""What the report needs beside Python's own library. Imported before the package, by the programs that begin with it."""
import importlib.util
import os
import sys

PACKAGES = {"numpy": "python3-numpy", "matplotlib": "python3-matplotlib", "jinja2": "python3-jinja2"}
SYSTEM = "/usr/bin/python3"  # the one that Debian's packages are for; another may stand before it on the PATH


def need(program):
    """Goes on in the system's Python where this one lacks something; says in one sentence what is missing there, too."""
    missing = [name for name in PACKAGES if importlib.util.find_spec(name) is None]
    if missing and os.path.exists(SYSTEM) and os.path.realpath(sys.executable) != os.path.realpath(SYSTEM):
        os.execv(SYSTEM, [SYSTEM, *sys.argv])
    if missing:
        packages = " ".join(PACKAGES[name] for name in missing)
        sys.exit(f"{program}: {sys.executable} has no {' and no '.join(missing)}; install {packages} (scripts/setup does), then run python3 "
                 + " ".join(sys.argv))
