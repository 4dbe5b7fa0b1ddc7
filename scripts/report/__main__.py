# SPDX-License-Identifier: MIT
"""python3 scripts/report OUT: see command.py."""
import pathlib
import sys

from packages import need

need("report")
sys.path[0] = str(pathlib.Path(__file__).resolve().parent.parent)  # this folder becomes the package `report`
from report.command import run  # noqa: E402

sys.exit(run(sys.argv[1:]))
