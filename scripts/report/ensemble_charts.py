# SPDX-License-Identifier: MIT
"""The charts of ensembles, one function each: results and a scene (index) give a Drawing, or None where there is nothing for it."""
import numpy

from .drawing import GREY, INK, Drawing, number
from .plots import Point, at_frame, devices, draw_forest, draw_points, slug
from .results import real


def ensemble_label(r, c, f):
    return r.configurations[c].label + at_frame(r, f)


def ensemble_cells(r, scene):
    return [(c, f, cell) for s, c, f, cell in r.measured() if s == scene]


def energy(r, scene):
    """Mean luminance against the reference's, with the band that a verdict needs."""
    cells = ensemble_cells(r, scene)
    if not cells:
        return None
    d = Drawing(slug(r.scenes[scene], "energy"), "Energy against the reference, 95 % intervals", height=0.5 + 0.16 * len(cells))
    names = [ensemble_label(r, c, f) for c, f, _ in cells]
    middles = [100 * r.difference[scene, c, f] for c, f, _ in cells]
    halves = [100 * r.half_width[scene, c, f] for c, f, _ in cells]
    band = 100 * r.summary["halfWidth"]
    about = [f"{name}: {number(value)} ± {number(half, 2)} %, {cell['verdict']}" for name, value, half, (*_, cell) in zip(names, middles, halves, cells)]
    axes = d.axes
    axes.axvspan(-band, band, color="#e4eff7", linewidth=0, zorder=0)
    spans = [(middle, middle - half, middle + half) for middle, half in zip(middles, halves)]
    draw_forest(d, names, spans, [cell["verdict"] == "unbiased" for *_, cell in cells], about, "difference of mean luminance (%)", 0.0)
    low, high = axes.get_xlim()
    axes.set_xlim(min(low, -1.1 * band), max(high, 1.1 * band))
    d.note = "Band: the half-width that was asked for. Diamonds: not judged unbiased."
    return d


def blocks(r, scene):
    """Maps of the sigmas of each block's mean, in the colour that differs most."""
    cells = ensemble_cells(r, scene)
    cells = [entry for entry in cells if entry[2]["blockSigmas"]]
    if not cells:
        return None
    columns = min(4, len(cells))
    rows = -(-len(cells) // columns)
    width, height = r.summary["scenes"][scene]["size"]
    high = 0.35 + rows * (3.1 / columns * height / width + 0.2)
    d = Drawing(slug(r.scenes[scene], "blocks"), "Blocks: sigmas against the reference", height=high, axes=False)
    grid = d.figure.subplots(rows, columns, squeeze=False)
    image = None
    for axes, entry in zip(grid.flat, cells + [None] * (rows * columns - len(cells))):
        axes.axis("off")
        if entry is None:
            continue
        c, f, cell = entry
        sigmas = numpy.array([real(value) for value in cell["blockSigmas"]], float)
        values = sigmas.reshape(-1, cell["blockColumns"])
        image = axes.pcolormesh(values, cmap="RdBu_r", vmin=-5, vmax=5, edgecolors="white", linewidth=0.3)
        axes.set(aspect="equal", ylim=(values.shape[0], 0))
        axes.set_title(ensemble_label(r, c, f), fontsize=6, pad=2)
        for (y, x), value in numpy.ndenumerate(values):
            (cell_artist,) = axes.bar(x + 0.5, 1, width=1, bottom=y, color=(0, 0, 0, 0), linewidth=0)
            d.hint(cell_artist, f"block ({x}, {y}): {value:+.2f} sigmas".replace("-", "−"))
    bar = d.figure.colorbar(image, ax=grid, orientation="horizontal", shrink=0.5, aspect=30, pad=0.04)
    bar.outline.set_linewidth(0.4)
    bar.set_label("sigmas of the block's mean (red: too bright, blue: too dark)")
    return d


def convergence(r, scene):
    """RelMSE of the mean over more and more runs against the time that they take."""
    curves = {}
    for c, f, cell in ensemble_cells(r, scene):
        if "convergence" not in cell:
            continue
        label = ensemble_label(r, c, f)
        points = []
        for p in cell["convergence"]["points"]:
            error = numpy.nan if p["relmse"] is None else p["relmse"]
            points.append(Point(p["runs"] * cell["ms"], error, f"{label}: {p['runs']:g} runs, RelMSE {number(error)}"))
        curves[label] = ((len(curves),), points)
    if not curves:
        return None
    d = Drawing(slug(r.scenes[scene], "convergence"), "Error of the mean over runs")
    draw_points(d, curves, f"time of the frame in all runs (ms, {devices(r)})", "RelMSE of luminance", True, True)
    points = [p for _, all_of_curve in curves.values() for p in all_of_curve if p.x > 0 and p.y > 0]
    if points:  # what has no bias falls by the number of runs
        (low, high), corner = d.axes.get_xlim(), min(points, key=lambda p: p.x)
        product = corner.x * corner.y
        d.axes.plot([low, high], [product / low, product / high], color=GREY, linewidth=0.5, linestyle=":", zorder=0, scalex=False, scaley=False)
        d.note = "Dotted: falling with the number of runs, as noise alone does. " + d.note
    return d


def power(r, scene):
    """How often faults planted on purpose are caught."""
    cells = [entry for entry in ensemble_cells(r, scene) if entry[2]["faults"]]
    if not cells:
        return None
    faults = [f"{100 * fault['size']:g} %\n{'in one block' if fault['block'] else 'everywhere'}" for fault in cells[0][2]["faults"]] + ["false\nalarms"]
    d = Drawing(slug(r.scenes[scene], "power"), "Power: planted faults caught", height=0.5 + 0.19 * len(cells))
    axes = d.axes
    for row, (c, f, cell) in enumerate(cells):
        for column, fault in enumerate(cell["faults"] + [None]):
            share = fault["caught"] if fault else cell["falseAlarms"]
            wrong = (fault["needed"] and share < 0.95) if fault else share > 0.02
            color = "#e08a5b" if wrong else ("#cfe3f2" if fault is None or share >= 0.95 else "#f3eedd")
            (artist,) = axes.bar(column, 1, width=1, bottom=row - 0.5, color=color, edgecolor="white", linewidth=1)
            needed = " (needed)" if fault and fault["needed"] else ""
            d.hint(artist, f"{ensemble_label(r, c, f)}, {faults[column]}: {100 * share:.1f} %{needed}".replace("\n", " "))
            axes.text(column, row, f"{100 * share:.{0 if fault else 1}f} %", ha="center", va="center", fontsize=6.5, color=INK)
    axes.set_xticks(range(len(faults)), faults, fontsize=5.5)
    axes.xaxis.tick_top()
    axes.set_yticks(range(len(cells)), [ensemble_label(r, c, f) for c, f, _ in cells])
    axes.set(xlim=(-0.5, len(faults) - 0.5), ylim=(len(cells) - 0.5, -0.5))
    axes.grid(False)
    axes.tick_params(length=0)
    for side in ("left", "bottom"):
        axes.spines[side].set_visible(False)
    d.note = ("Share of bootstrapped ensembles in which a fault is seen whose size is a share of the whole image's energy, appearing or lost. "
              f"Faults of {300 * r.summary['halfWidth']:g} % and more have to be seen (blue: at least 95 times in 100; orange: too seldom). "
              "False alarms: the same without a fault; 0.2 % are expected.")
    return d
