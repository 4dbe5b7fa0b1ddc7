# SPDX-License-Identifier: MIT
"""Two results side by side: of different dates, devices or versions."""
from types import SimpleNamespace

import numpy

from . import charts, page
from .plots import slug
from .results import Missing
from .tables import cell, measured, table
from .words import facts, listed


def ratio_of(b, a):
    """b / a of two independent means (mean, half-width): the interval is that of the linearised ratio."""
    if not (numpy.isfinite(a[0]) and numpy.isfinite(b[0]) and a[0] != 0):
        return numpy.nan, numpy.nan
    ratio = b[0] / a[0]
    return ratio, abs(ratio) * float(numpy.hypot(a[1] / a[0], b[1] / b[0])) if b[0] != 0 else numpy.nan


def common(a, b):
    """((scene, configuration, frame) of A, the same of B) of what both have measured."""
    for s, c, f, _ in a.measured():
        scene, label, offset = a.scenes[s], a.labels[c], a.frames[f]
        if scene in b.scenes and label in b.labels and offset in b.frames:
            other = b.scene(scene), b.configuration(label), b.frame(offset)
            if b.cell(*other):
                yield (s, c, f), other


def columns(a, b):
    """(name, A's mean and half-width at a place, B's) of all that is compared."""
    of = lambda r, mean, half: lambda at: (mean(r)[at], half(r)[at])  # noqa: E731
    alone = lambda r, mean: lambda at: (mean(r)[at], numpy.nan)  # noqa: E731
    yield "ms", alone(a, lambda r: r.ms), alone(b, lambda r: r.ms)
    yield "rays a pixel", alone(a, lambda r: r.rays), alone(b, lambda r: r.rays)
    if a.kind == "error":
        for name in (m["name"] for m in a.metrics if m["name"] in b.error):
            error, half_width = (lambda r, n=name: r.error[n]), (lambda r, n=name: r.half_width[n])
            yield name, of(a, error, half_width), of(b, error, half_width)
    else:
        yield "energy against the reference", of(a, lambda r: r.difference, lambda r: r.half_width), of(b, lambda r: r.difference, lambda r: r.half_width)


def comparison(a, b, scene, pairs):
    compared = list(columns(a, b))
    pairs = [(left, right) for left, right in pairs if left[0] == scene]
    named = a.kind == "error" and all("runs" in r.cell(*at) for pair in pairs for r, at in zip((a, b), pair))  # what was archived has no hashes
    head = ["technique", "frame"] + [text for name, *_ in compared for text in (f"{name}: A", "B", "ratio")] + (["same image"] if named else [])
    rows = []
    for left, right in pairs:
        row = [cell(a.labels[left[1]]), cell(str(a.frames[left[2]]))]
        for name, of_a, of_b in compared:
            one, two = of_a(left), of_b(right)
            ratio = ratio_of(two, one) if name != "energy against the reference" else (numpy.nan, numpy.nan)
            row += [measured(*one, kind="first"), measured(*two), measured(*ratio)]
        if named:
            row.append(cell("yes" if a.cell(*left)["runs"] == b.cell(*right)["runs"] else "no"))
        rows.append(row)
    note = "Ratios are B to A, with 95 % intervals of independent means."
    if named:
        note += " Same image: both ran the same scene, graph, shaders and framework, by their hashes; what differs then is the device."
    return table(f"compare.{slug(a.scenes[scene])}", head, rows, note)


def share_axes(one, two):
    """The same limits, so that what is moved is seen."""
    for axis in ("xaxis", "yaxis"):
        mine, other = getattr(one.axes, axis), getattr(two.axes, axis)
        if mine.get_scale() == other.get_scale():
            low, high = zip(mine.get_view_interval(), other.get_view_interval())
            for d in (one, two):
                d.axes.set(**{f"{mine.axis_name}lim": (min(low), max(high))})


def side_by_side(a, b, s, other, figures):
    """The charts of A that B has too, for a scene's index in both."""
    known = charts.ERROR if a.kind == "error" else charts.ENSEMBLE
    for name in page.chart_names(a):
        chart = known.get(name)
        if chart is None or chart.of in ("study", "whole"):
            continue
        for metric in a.metrics if chart.of == "metric" else [None]:
            if metric and metric["name"] not in b.error:
                continue
            pair = [chart.draw(r, place, *([metric] if metric else [])) for r, place in ((a, s), (b, other))]
            if None in pair:
                continue
            if name in ("error_vs_time", "error_vs_rays", "frontier"):
                share_axes(*pair)
            yield [figures.finish(drawing) for drawing in pair]


def page_of(a, b):
    if a.kind != b.kind:
        raise Missing(f"{a.folder} is of kind {a.kind} and {b.folder} of kind {b.kind}: they cannot be compared")
    pairs = list(common(a, b))
    if not pairs:
        raise Missing(f"{a.folder} and {b.folder} have no scene, technique and frame in common")
    figures, sections = page.Figures(None), []
    for s in dict.fromkeys(left[0] for left, _ in pairs):
        other = b.scene(a.scenes[s])
        both = list(side_by_side(a, b, s, other, figures))
        sections.append(SimpleNamespace(id=slug(a.scenes[s]), name=a.scenes[s], tables=[comparison(a, b, s, pairs)], pairs=both))
    alone = sorted(set(a.labels) ^ set(b.labels))
    sides = [SimpleNamespace(name=f"{place}: {r.folder.resolve().name}", facts=facts(r)) for place, r in zip("AB", (a, b))]
    return page.render("compare.html", title=f"{a.name}: {a.folder.resolve().name} and {b.folder.resolve().name}", sides=sides, sections=sections,
                       only=f"In one of them alone: {listed(alone)}." if alone else "")
