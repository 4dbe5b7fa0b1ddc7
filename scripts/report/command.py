# SPDX-License-Identifier: MIT
"""The command line of scripts/report."""
import argparse
import os
import pathlib
import socket
import sys

from . import charts, compare, index, page
from .drawing import use_style
from .results import Missing, load


def runs(pid):
    try:
        os.kill(pid, 0)
    except ProcessLookupError:
        return False
    except PermissionError:
        pass
    return True


def write(path, text):
    """Aside and then renamed: whoever looks finds the old page or the new one. What killed ones left on this machine goes."""
    start = f".{path.name}.{socket.gethostname()}."
    for left in path.parent.glob(start + "*"):
        if not runs(int(left.name[len(start):])):
            left.unlink(missing_ok=True)
    aside = path.with_name(start + str(os.getpid()))
    aside.write_text(text, encoding="utf-8")
    aside.replace(path)


def draw_report(folder, options):
    r = load(folder, options.only)
    if options.charts:
        r.summary["charts"] = options.charts
    figures = page.Figures(pathlib.Path(folder) / "figures")
    path = pathlib.Path(folder) / "report.html"
    write(path, page.report(r, figures, options.embed * 2**20))
    return [path, f"{figures.count} figures in {figures.folder}"]


def draw_index(folder, options):
    studies = sorted(path.parent for path in folder.glob("*/summary.json"))
    if not studies:
        raise Missing(f"{folder} holds no summary.json, nor does a folder in it; lodestir study STUDY --out FOLDER writes it")
    for study in studies:
        if not (study / "report.html").exists():
            draw_report(study, options)
    path = folder / "index.html"
    write(path, index.page_of(folder, studies))
    return [path]


def run(arguments):
    parser = argparse.ArgumentParser(prog="scripts/report", description="Draws what `lodestir study` measured: OUT/report.html and OUT/figures/*.pdf.",
                                     epilog="With --compare two results stand side by side. A folder of several results gets an index.html.")
    parser.add_argument("out", nargs="*", type=pathlib.Path, metavar="OUT", help="folder of results, or of several of them")
    parser.add_argument("--style", metavar="FILE", help="matplotlib style (.mplstyle) applied on top of lodestir.mplstyle")
    parser.add_argument("--only", nargs="+", default=[], metavar="TECHNIQUE", help="report on these alone")
    parser.add_argument("--charts", nargs="+", choices=list(charts.ERROR), metavar="CHART", help="instead of the study's own: " + ", ".join(charts.ERROR))
    parser.add_argument("--compare", nargs=2, type=pathlib.Path, metavar=("A", "B"), help="two folders of results side by side")
    parser.add_argument("--to", type=pathlib.Path, default=pathlib.Path("compare.html"), metavar="FILE", help="page that --compare writes (compare.html)")
    parser.add_argument("--embed", type=float, default=64, metavar="MIB", help="most that images may take in a page (64)")
    parser.add_argument("--quiet", action="store_true", help="say nothing but what is wrong")
    options = parser.parse_args(arguments)
    if bool(options.out) == bool(options.compare):
        parser.error("name a folder of results, or two with --compare")
    try:
        use_style(options.style)
        said = []
        if options.compare:
            write(options.to, compare.page_of(*(load(folder, options.only) for folder in options.compare)))
            said = [options.to]
        for folder in options.out:
            single = (folder / "summary.json").exists() or any(folder.glob("results*.jsonl")) or not folder.is_dir()
            said += draw_report(folder, options) if single else draw_index(folder, options)
        if not options.quiet:
            print(*said, sep="\n")
    except (Missing, OSError, ValueError) as error:
        print(f"report: {error}", file=sys.stderr)
        return 1
    except KeyboardInterrupt:
        return 130
    return 0
