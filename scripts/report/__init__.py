# SPDX-License-Identifier: MIT
"""Charts, page and arrays of a study's results.

    import sys; sys.path.insert(0, "scripts")   # of the source tree, or PREFIX/share/lodestir/scripts
    from report import load
    r = load("out/equal_cost")
    r.error["relmse"][r.scene("rock"), r.configuration("ReSTIR PT, neighbours 3"), r.frame(0)]
"""
from .results import load  # noqa: F401
