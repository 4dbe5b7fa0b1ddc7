# SPDX-License-Identifier: MIT
"""studies/results/STUDY.json: of the summary.json of a study's results what a document and a later comparison need. `load` reads it as it reads a folder."""
import json
import math
import os
import pathlib
import re
import socket

from .results import Missing, load

DIGITS = 6


def study_of(summary, root):
    """Its name in the tree: that of the file that asks what the summary says."""
    studies = root / "studies"
    found = [path for path in sorted(studies.rglob(summary["study"] + ".json"))
             if path.relative_to(studies).parts[0] != "results" and json.loads(path.read_text())["about"] == summary["about"]]
    if len(found) != 1:
        raise Missing(f"{len(found)} files {summary['study']}.json below {studies} have the \"about\" of these results; keep them in the tree of their study")
    return str(found[0].relative_to(studies).with_suffix(""))


def machine_of(summary):
    """What it is rather than what it is called, where it is this one."""
    processors = pathlib.Path("/proc/cpuinfo")
    model = re.search(r"^model name\s*:\s*(.+)$", processors.read_text(), re.M) if processors.exists() else None
    return f"{os.cpu_count()} cores of {model[1]}" if model and summary["machine"] == socket.gethostname() else summary["machine"]


def rounded(value):
    if isinstance(value, dict):
        return {key: rounded(member) for key, member in value.items()}
    if isinstance(value, list):
        return [rounded(member) for member in value]
    if isinstance(value, float) and math.isfinite(value):
        short = float(f"{value:.{DIGITS}g}")
        return int(short) if short.is_integer() else short
    return value


def without(cell, *names):
    return {name: member for name, member in cell.items() if name not in names}


def reduced_cell(cell, rows):
    """Of an error study. `rows`: those of its runs and frame, whose times and rays come to stand beside the values of metrics, seed by seed."""
    short = without(cell, "runs", "image", "exposure", "referenceNoise")
    short["ms"] = {**cell["ms"], "values": [row["ms"] for row in rows]}
    short["rays"] = {**cell["rays"], "values": [sum(sum(cost["rays"].values()) for cost in row["passes"].values()) for row in rows]}
    traced = {name: {purpose: rays for purpose, rays in cost["rays"].items() if rays} for name, cost in cell["passes"].items()}
    short["passes"] = {name: {"ms": cost["ms"], "rays": traced[name]} for name, cost in cell["passes"].items()}
    short["metrics"] = {name: without(found, "againstStart") for name, found in cell["metrics"].items()}
    return short


def reduced(folder):
    """The summary of a folder of results. Left out is what follows from values seed by seed."""
    r = load(folder)
    summary = r.summary
    if summary["missing"]:
        raise Missing(f"{folder}: {summary['missing']} runs are still missing; lodestir study STUDY --out {folder} --resume makes them")
    short = {**summary, "machine": machine_of(summary), "scenes": [without(scene, "reference") for scene in summary["scenes"]]}
    if r.kind == "error":
        rows = {(row["run"], row["frame"]): row for row in r.rows()}
        short["cells"] = [reduced_cell(cell, [rows[run, cell["frame"]] for run in cell["runs"]]) for cell in summary["cells"]]
        short["comparisons"] = [found for found in summary["comparisons"] if found["without"]]
        short["charts"] = [name for name in summary["charts"] if name not in ("stability", "stability_matrix")]
        short.update(sequences=[], exponents=[])
    else:
        short["cells"] = [without(cell, "chunks", "image") for cell in summary["cells"]]
    return rounded(short)


def keep(folder, root):
    """Writes the archive of a folder of results into the tree, and says where."""
    short = reduced(folder)
    path = root / "studies/results" / (study_of(short, root) + ".json")
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_text(json.dumps(short, separators=(",", ":"), ensure_ascii=False) + "\n", encoding="utf-8")
    return path
