# SPDX-License-Identifier: MIT
"""How much model a scene needs: errors against what is counted beside time and rays, such as triangles, and levels chosen against fixed ones."""
import numpy

from .drawing import GREY, Drawing, curve_style, number, with_interval
from .error_charts import decompositions_of, shown_frame
from .plots import Point, at_frame, count_with_unit, devices, draw_points, slug, with_unit
from .results import STEPS
from .statistics import estimate_difference

ENOUGH = 1.1  # times the least error: what no eye asks more for


def point_of(r, scene, c, frame, metric, count):
    error, half = r.error[metric["name"]][scene, c, frame], r.half_width[metric["name"]][scene, c, frame]
    x = r.counts[count][scene, c, frame]
    return Point(x, error, f"{r.labels[c]}: {number(x)} {count}, {metric['name']} {with_interval(error, half)}", (error - half, error + half))


def measured_at(r, scene, frame):
    return [c for c in range(len(r.configurations)) if r.cell(scene, c, frame)]


def error_vs_count(r, scene, metric, count):
    frame, curves = shown_frame(r, metric), {}
    for c in measured_at(r, scene, frame):
        curve = r.configurations[c].curve
        curves.setdefault(curve, ((r.place[r.labels[c]][0],), []))[1].append(point_of(r, scene, c, frame, metric, count))
    d = Drawing(slug(r.scenes[scene], f"error_vs_{count}", metric["name"]), f"{metric['name']} against {count}{at_frame(r, frame)}")
    return draw_points(d, curves, count_with_unit(count), with_unit(metric), True, metric["fromZero"])


def knee(points):
    """The point with the least x whose y is within ENOUGH of the least; None where no point has a place on the axes."""
    points = [p for p in points if p.x > 0 and p.y > 0]
    least = min((p.y for p in points), default=None)
    return min((p for p in points if p.y <= ENOUGH * least), key=lambda p: p.x, default=None)


def needs(r, scene, metric, count):
    """Of the baseline, which has a knob for the model and, last, one for the effort: the error against the size of the model, a curve an effort, and what of
    it is the model's. Of each curve the least model that is enough is marked."""
    if not metric["fromZero"] or count == STEPS:  # which are the effort's as well
        return None
    frame, curves = shown_frame(r, metric), {}
    parts, geometry = decompositions_of(r, scene, frame, metric), {}  # of each model where the effort tells it best
    for c in measured_at(r, scene, frame):
        configuration = r.configurations[c]
        if configuration.technique != r.summary["baseline"] or len(configuration.knobs) < 2:
            continue
        effort = configuration.point
        curves.setdefault(effort, []).append(point_of(r, scene, c, frame, metric, count))
        if configuration in parts:
            mean, half = parts[configuration]["squaredBias"]
            about = f"{configuration.curve}: {number(r.counts[count][scene, c, frame])} {count}, squared bias {with_interval(mean, half)}"
            told = half if numpy.isfinite(half) else numpy.inf
            if configuration.curve not in geometry or told < geometry[configuration.curve][0]:
                geometry[configuration.curve] = told, Point(r.counts[count][scene, c, frame], mean, about, (mean - half, mean + half))
    if not curves:
        return None
    drawn = {f"all, {effort}": ((i,), sorted(points, key=lambda p: p.x)) for i, (effort, points) in enumerate(curves.items())}
    efforts = list(drawn.values())
    if geometry:
        drawn["geometry alone"] = ((len(drawn),), sorted((point for _, point in geometry.values()), key=lambda p: p.x))
    d = Drawing(slug(r.scenes[scene], f"needs_{count}", metric["name"]), f"What the scene needs: {metric['name']} against {count}{at_frame(r, frame)}")
    draw_points(d, drawn, count_with_unit(count), with_unit(metric), True, True)
    low, high = d.axes.get_ylim()
    least = min((p.y for points in curves.values() for p in points if p.y > 0), default=high)
    d.axes.set_ylim(max(low, least / 30), high)  # further down the model is as good as the finest
    for place, points in efforts:
        found = knee(points)
        if not found:
            continue
        color = curve_style(*place)["color"]
        (mark,) = d.axes.plot([found.x], [found.y], marker="o", markersize=9, markerfacecolor="none", markeredgecolor=color, linestyle="none")
        d.hint(mark, f"enough: {found.about}")
    d.note = f"Circles: the least {count} whose error is within {round(100 * (ENOUGH - 1))} % of the curve's least. " + d.note
    return d


def cost_vs_model(r, count):
    """What a frame costs in each scene against the model that the baseline shows of it: `count` of the baseline, which has no knob. None of several sizes,
    where pixels are what grows."""
    f, curves = shown_frame(r), {}
    base = [c for c, configuration in enumerate(r.configurations) if configuration.technique == r.summary["baseline"]]
    if len(base) != 1 or len(r.scenes) < 2 or len(set(r.pixels)) > 1 or count == STEPS:
        return None
    for c, configuration in enumerate(r.configurations):
        for s in numpy.argsort(r.counts[count][:, base[0], f]):
            x, y = r.counts[count][s, base[0], f], cost_of(r, s, c, f)
            if numpy.isfinite([x, y]).all():
                about = f"{configuration.label}, {r.scenes[s]}: {number(y)} {cost_name(r)} where {r.summary['baseline']} shows {number(x)} {count}"
                curves.setdefault(configuration.label, ((r.place[configuration.label][0],), []))[1].append(Point(x, y, about))
    if not curves:
        return None
    d = Drawing(slug("cost_vs_model", count), f"Cost of a frame against the model, in {count}")
    d = draw_points(d, curves, f"{count} of {r.summary['baseline']}", cost_name(r), True, False)
    d.axes.set_ylim(bottom=0)
    return d


def cost_name(r):
    return count_with_unit(STEPS) if STEPS in r.counts else f"time of the frame (ms, {devices(r)})"


def cost_of(r, scene, c, frame):
    return r.counts[STEPS][scene, c, frame] if STEPS in r.counts else r.ms[scene, c, frame]


def error_at(cost, points):
    """Of one curve, seed by seed: errors at a cost, between measured ones. Error is a + b / cost where samples are independent, so that it is straight over
    1 / cost; beyond the dearest it goes on along the last one, but never faster than 1 / cost itself falls. None where nothing so cheap was measured,
    and where a single point tells of no line."""
    points = sorted(points, key=lambda p: p[0])
    if abs(cost - points[0][0]) <= 1e-9 * cost:
        return points[0][1]
    if cost < points[0][0] or len(points) == 1:
        return None
    after = next((i for i, (x, _) in enumerate(points) if x >= cost), len(points) - 1)
    (x0, y0), (x1, y1) = points[after - 1], points[after]
    share = (1 / x0 - 1 / cost) / (1 / x0 - 1 / x1)
    on_line, unbiased = y0 + share * (y1 - y0), y1 * x1 / cost
    return unbiased if cost > x1 and numpy.nansum(on_line - unbiased) < 0 else on_line


def advantages(r, scene, metric, frame=None):
    """Rows (configuration, cost, curve of the baseline that is best at that cost, ratio of the errors, half of its interval in logarithms)."""
    frame = shown_frame(r, metric) if frame is None else frame
    values, curves, rows = r.values[metric["name"]], {}, []
    measured = measured_at(r, scene, frame)
    for c in measured:
        if r.configurations[c].technique == r.summary["baseline"]:
            curves.setdefault(r.configurations[c].curve, []).append((cost_of(r, scene, c, frame), values[scene, c, frame]))
    for c in measured:
        configuration = r.configurations[c]
        if configuration.technique == r.summary["baseline"]:
            continue
        cost = cost_of(r, scene, c, frame)
        found = {curve: error_at(cost, points) for curve, points in curves.items()}
        means = {curve: numpy.mean(errors[numpy.isfinite(errors)]) for curve, errors in found.items() if errors is not None and numpy.isfinite(errors).any()}
        best = min((curve for curve in means if means[curve] > 0), key=means.get, default=None)  # nothing is a multiple of an error at the noise's edge
        if best is None:
            continue
        rows.append((c, cost, best, *ratio(values[scene, c, frame], found[best])))
    return rows


def ratio(mine, other):
    """Of independent runs: the geometric mean, and half of the 95 % interval of its logarithm; NaN where an error isn't above 0."""
    mine, other = mine[numpy.isfinite(mine)], other[numpy.isfinite(other)]
    if not len(mine) or min(*mine, *other) <= 0:
        return numpy.nan, numpy.nan
    middle, half = estimate_difference(numpy.log(mine), numpy.log(other))
    return numpy.exp(middle), half


def advantage(r, scene, metric):
    """Errors as multiples of the best that any curve of the baseline has at the same cost."""
    if not metric["fromZero"]:
        return None
    curves = {}
    for c, cost, best, middle, half in advantages(r, scene, metric):
        configuration = r.configurations[c]
        low, high = middle * numpy.exp(-half), middle * numpy.exp(half)
        about = f"{configuration.label}: {number(middle)} ({number(low, 3)} to {number(high, 3)}) times {best} at {number(cost)}"
        curves.setdefault(configuration.curve, ((r.place[configuration.label][0],), []))[1].append(Point(cost, middle, about, (low, high)))
    if not curves:
        return None
    frame = shown_frame(r, metric)
    d = Drawing(slug(r.scenes[scene], "advantage", metric["name"]), f"{metric['name']} against the best of {r.summary['baseline']}{at_frame(r, frame)}")
    draw_points(d, curves, cost_name(r), f"{metric['name']} ÷ the least of {r.summary['baseline']} at that cost", True, True)
    d.axes.axhline(1, color=GREY, linewidth=0.8, zorder=1)
    d.note = "Below 1: nearer than any of them at equal cost, which is taken between measured ones or just beyond. Lines: 95 %. " + d.note
    return d
