# SPDX-License-Identifier: MIT
"""What charts are drawn with: points on curves, intervals below each other, words."""
import re
from dataclasses import dataclass

import numpy
from matplotlib.lines import Line2D

from .drawing import INK, color_of, curve_style, scale
from .results import STEPS


def slug(*parts):
    return re.sub(r"[^A-Za-z0-9.-]+", "_", ".".join(part for part in parts if part))


def devices(r):
    return " and ".join(device.split(",")[0].split(" (")[0] for device in r.summary["devices"]) or "no device yet"


def with_unit(metric):
    return metric["name"] + (f" ({metric['unit']})" if metric["unit"] else "")


def count_with_unit(count):
    return count + (" a pixel" if count == STEPS else "")


def at_frame(r, frame):
    return f", frame {r.frames[frame]}" if len(r.frames) > 1 else ""


@dataclass
class Point:
    x: float
    y: float
    about: str
    y_range: tuple = (numpy.nan, numpy.nan)
    x_range: tuple = (numpy.nan, numpy.nan)
    label: str = ""


def draw_points(d, curves, x_label, y_label, log_x, log_y, frames=False):
    """Curves: {name: (arguments of curve_style, points)}. Points that have no place on the axes are counted below the chart, never moved. `frames`: all curves
    have the same x, so that intervals are bands and names stand at the curves' ends."""
    axes = d.axes
    fits = lambda p: numpy.isfinite([p.x, p.y]).all() and (not log_x or p.x > 0) and (not log_y or p.y > 0)  # noqa: E731
    drawn = [p for _, points in curves.values() for p in points if fits(p)]
    scale(axes.xaxis, [value for p in drawn for value in (p.x, *p.x_range)], log_x)
    low = scale(axes.yaxis, [value for p in drawn for value in (p.y, *p.y_range)], log_y)[0]
    ends, handles = [], []
    for name, (place, points) in curves.items():
        style, points = curve_style(*place), [p for p in points if fits(p)]
        axes.plot([p.x for p in points], [p.y for p in points], color=style["color"], linestyle=style["linestyle"])
        if frames:
            spans = [p for p in points if numpy.isfinite(p.y_range).all()]
            axes.fill_between([p.x for p in spans], [max(p.y_range[0], low) if log_y else p.y_range[0] for p in spans], [p.y_range[1] for p in spans],
                              color=style["color"], alpha=0.14, linewidth=0)
        for p in points:
            if numpy.isfinite(p.y_range).all() and not frames:
                axes.plot([p.x, p.x], [p.y_range[0] if not log_y or p.y_range[0] > 0 else low, p.y_range[1]], color=style["color"], linewidth=0.7)
            if numpy.isfinite(p.x_range).all():
                axes.plot(p.x_range, [p.y, p.y], color=style["color"], linewidth=0.7)
            (mark,) = axes.plot([p.x], [p.y], **{**style, "linestyle": "none"}, markeredgecolor="white", markeredgewidth=0.4)
            d.hint(mark, p.about)
        if points:
            ends.append((points[-1].y, name, style["color"]))
        handles.append(Line2D([], [], **style))
    axes.set(xlabel=x_label, ylabel=y_label)
    if frames and ends and len(ends) <= 6 and max(len(name) for _, name, _ in ends) <= 20:
        d.label_ends(ends)
    else:
        d.legend(handles, list(curves))
    hidden = sum(not fits(p) for _, points in curves.values() for p in points)
    if frames and any(numpy.isfinite(p.y_range).all() for p in drawn):
        d.note = "Bands: 95 % intervals. "
    if hidden:
        what, stands = ("point has", "stands") if hidden == 1 else ("points have", "stand")
        d.note += f"{hidden} {what} no place on these axes and {stands} in the table only. "
    return d


def draw_forest(d, names, spans, good, about, x_label, reference, log=False):
    """Intervals (middle, low, high) one below the other, `reference` a line through all."""
    axes = d.axes
    first = scale(axes.xaxis, [value for span in spans for value in span] + [reference], log)[0]
    axes.axvline(reference, color=INK, linewidth=0.7, zorder=1)
    for row, (middle, low, high) in enumerate(spans):
        if not numpy.isfinite(middle) or (log and middle <= 0):
            continue
        color = color_of(0) if good[row] else color_of(1)
        if numpy.isfinite([low, high]).all():
            axes.plot([max(low, first) if log else low, high], [row, row], color=color, linewidth=1.1)
        (mark,) = axes.plot([middle], [row], marker="o" if good[row] else "D", color=color, markersize=3.5, linestyle="none")
        d.hint(mark, about[row])
    axes.set_yticks(range(len(names)), names)
    axes.set(ylim=(len(names) - 0.4, -0.6), xlabel=x_label)
    axes.grid(axis="y", visible=False)
    axes.tick_params(axis="y", length=0)
    return d
