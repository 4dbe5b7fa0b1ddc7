# SPDX-License-Identifier: MIT
"""index.html of a folder of several results."""
import collections
from types import SimpleNamespace

from .page import render
from .results import read_summary
from .words import listed


def outcome(summary):
    """In a few words."""
    if summary["missing"]:
        return f"{summary['missing']} still missing"
    if summary["kind"] == "ensemble":
        counts = collections.Counter(cell["verdict"] for cell in summary["cells"] if cell["complete"])
        return listed(f"{count} {verdict}" for verdict, count in counts.items())
    return f"{sum('ms' in cell for cell in summary['cells'])} cells measured: " + listed(metric["name"] for metric in summary["metrics"])


def page_of(folder, studies):
    found = []
    for study in studies:
        s = read_summary(study / "summary.json")
        scenes = listed(dict.fromkeys(scene["file"] for scene in s["scenes"]))
        found.append(SimpleNamespace(link=f"{study.name}/report.html", name=study.name, about=s["about"], outcome=outcome(s), scenes=scenes,
                                     techniques=len(s["techniques"]), seeds=s["seeds"], device=listed(s["devices"]), date=s["date"][:10]))
    return render("index.html", title=f"Studies in {folder.resolve().name}", studies=found)
