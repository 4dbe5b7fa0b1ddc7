# SPDX-License-Identifier: MIT
"""The charts of errors, one function each: results, a scene (index) and, where there is one for each, a metric give a Drawing, or None where the study has
nothing for it."""
import numpy
from matplotlib.lines import Line2D
from matplotlib.patches import Patch

from .drawing import GREY, INK, Drawing, color_of, curve_style, number, scale, with_interval
from .frontier import undominated
from .plots import Point, at_frame, devices, draw_forest, draw_points, slug, with_unit
from .results import configuration_of, real


def shown_frame(r, metric=None):
    """The frame that charts without a frame axis show: the event's own, else the last; of a metric of steps the first one after it that has it."""
    shown = r.frame(0) if 0 in r.frames else len(r.frames) - 1
    if metric:
        has = numpy.isfinite(r.error[metric["name"]]).any(axis=(0, 1))
        later = numpy.flatnonzero(has & (numpy.arange(len(r.frames)) >= shown))
        if later.size:
            return int(later[0])
    return shown


def error_curves(r, scene, metric, time):
    frame, curves, name = shown_frame(r, metric), {}, metric["name"]
    for c, configuration in enumerate(r.configurations):
        error, half = r.error[name][scene, c, frame], r.half_width[name][scene, c, frame]
        ms, rays = r.ms[scene, c, frame], r.rays[scene, c, frame]
        if r.cell(scene, c, frame) is None or numpy.isnan(ms):
            continue
        about = f"{configuration.label}: {number(ms)} ms, {number(rays)} rays a pixel, {name} {with_interval(error, half)}"
        point = Point(ms if time else rays, error, about, (error - half, error + half), tuple(r.ms_range[scene, c, frame]) if time else (numpy.nan, numpy.nan),
                      configuration.point)
        curves.setdefault(configuration.curve, ((r.place[configuration.label][0],), []))[1].append(point)
    return frame, curves


def error_vs_time(r, scene, metric):
    frame, curves = error_curves(r, scene, metric, True)
    d = Drawing(slug(r.scenes[scene], "error_vs_time", metric["name"]), f"{metric['name']} against time{at_frame(r, frame)}")
    return draw_points(d, curves, f"time of the frame (ms, {devices(r)})", with_unit(metric), True, metric["fromZero"])


def error_vs_rays(r, scene, metric):
    frame, curves = error_curves(r, scene, metric, False)
    d = Drawing(slug(r.scenes[scene], "error_vs_rays", metric["name"]), f"{metric['name']} against rays{at_frame(r, frame)}")
    return draw_points(d, curves, "rays a pixel", with_unit(metric), True, metric["fromZero"])


def frontier(r, scene, metric):
    """Error against time of every technique and knob; the undominated joined and named."""
    if not metric["fromZero"]:
        return None
    frame, curves = error_curves(r, scene, metric, True)
    points = [p for _, all_of_curve in curves.values() for p in all_of_curve if p.x > 0 and p.y > 0]
    if len(points) < 2:
        return None
    d = Drawing(slug(r.scenes[scene], "frontier", metric["name"]), f"Frontier of {metric['name']} and time{at_frame(r, frame)}")
    best = undominated(points)
    axes = d.axes
    axes.step([p.x for p in best], [p.y for p in best], where="post", color=GREY, linewidth=0.9, zorder=1)
    scale(axes.xaxis, [value for p in points for value in (p.x,)], True)
    scale(axes.yaxis, [p.y for p in points], True)
    handles, names = [], []
    for place, all_of_curve in curves.values():
        style = {**curve_style(*place), "linestyle": "none"}
        handles.append(Line2D([], [], **style))
        for p in all_of_curve:
            if not (p.x > 0 and p.y > 0):
                continue
            kept = p in best
            looks = {**style, "markersize": 1.4 * style["markersize"]} if kept else {**style, "alpha": 0.6}
            (mark,) = axes.plot([p.x], [p.y], **looks, markeredgecolor="white", markeredgewidth=0.4)
            d.hint(mark, p.about + ("; not dominated" if kept else ""))
            if kept and p.label:
                names.append((p.x, p.y, p.label, style["color"]))
    axes.set(xlabel=f"time of the frame (ms, {devices(r)})", ylabel=with_unit(metric))
    d.legend(handles, list(curves))
    d.label_points(names)
    d.note = "Joined: what nothing else measured is both faster and nearer than. Medians and means alone; intervals are in the chart of error against time."
    return d


def frame_curves(r, scene, metric, relative):
    name, curves = metric["name"], {}
    has = numpy.flatnonzero(numpy.isfinite(r.error[name][scene]).any(axis=0))
    start = int(has[0]) if has.size else 0
    for c, configuration in enumerate(r.configurations):
        for f in has:
            error, half = r.error[name][scene, c, f], r.half_width[name][scene, c, f]
            if relative:
                cell = r.cell(scene, c, int(f))
                ratio = cell["metrics"].get(name, {}).get("againstStart") if cell else None
                if ratio is None:
                    continue
                error, half = real(ratio["mean"]), real(ratio["halfWidth"])
            label = configuration.label
            curves.setdefault(label, (r.place[label], []))[1].append(
                Point(float(r.frames[f]), error, f"{label}, frame {r.frames[f]}: {with_interval(error, half)}", (error - half, error + half)))
    return start, curves


def error_vs_frame(r, scene, metric):
    if len(r.frames) < 2:
        return None
    _, curves = frame_curves(r, scene, metric, False)
    d = Drawing(slug(r.scenes[scene], "error_vs_frame", metric["name"]), f"{metric['name']} against the frame")
    return draw_points(d, curves, "frame, counted from the event", with_unit(metric), False, metric["fromZero"], frames=True)


def time_vs_frame(r, scene):
    if len(r.frames) < 2:
        return None
    curves = {}
    for c, configuration in enumerate(r.configurations):
        for f in numpy.flatnonzero(numpy.isfinite(r.ms[scene, c])):
            label, ms = configuration.label, r.ms[scene, c, f]
            about = f"{label}, frame {r.frames[f]}: {number(ms)} ms, {number(r.rays[scene, c, f])} rays a pixel"
            curves.setdefault(label, (r.place[label], []))[1].append(Point(float(r.frames[f]), ms, about, tuple(r.ms_range[scene, c, f])))
    d = Drawing(slug(r.scenes[scene], "time_vs_frame"), "Time against the frame")
    return draw_points(d, curves, "frame, counted from the event", f"time of the frame (ms, {devices(r)})", False, True, frames=True)


def stability(r, scene, metric):
    """The error as a multiple of the first measured frame's: what an event does to a technique, whatever its level."""
    if len(r.frames) < 2 or not metric["fromZero"]:
        return None
    start, curves = frame_curves(r, scene, metric, True)
    d = Drawing(slug(r.scenes[scene], "stability", metric["name"]), f"Stability: {metric['name']} against that of frame {r.frames[start]}")
    return draw_points(d, curves, "frame, counted from the event", f"{metric['name']} ÷ that of frame {r.frames[start]}", False, True, frames=True)


def weighty(*costs):
    """Places along the last axis of what makes a hundredth or more of the longest bar of any chart of the study; colours are given by them."""
    shares = []
    for values in costs:
        longest = numpy.nanmax(numpy.nansum(values, axis=-1), axis=1, keepdims=True)[..., None]  # of each scene and frame
        shares.append(numpy.nanmax(numpy.nan_to_num(values) / numpy.where(longest > 0, longest, 1), axis=(0, 1, 2)))
    return list(numpy.flatnonzero(numpy.max(shares, axis=0) >= 0.01))


def stacked(r, scene, chart, title, x_label, names, heavy, costs):
    """Horizontal bars, a configuration each, parts of one name in one colour; costs (configuration, name); `heavy`: what is told by itself."""
    shown = [c for c in range(len(r.configurations)) if numpy.isfinite(costs[c]).any()]
    if not shown or not numpy.nansum(costs) > 0:
        return None
    total = numpy.nansum(costs, axis=1)
    parts = {names[p]: (costs[:, p], color_of(place)) for place, p in enumerate(heavy) if numpy.nansum(costs[:, p]) > 0}
    rest = total - sum(numpy.nan_to_num(values) for values, _ in parts.values())
    if rest.max() > 1e-6 * total.max():
        parts["the rest"] = rest, "#bbbbbb"
    d = Drawing(slug(r.scenes[scene], chart), title, height=0.5 + 0.17 * len(shown))
    axes = d.axes
    for row, c in enumerate(shown):
        start = 0.0
        for name, (values, color) in parts.items():
            if not values[c] > 0:
                continue
            (bar,) = axes.barh(row, values[c], left=start, height=0.72, color=color, edgecolor="white", linewidth=0.3)
            d.hint(bar, f"{r.configurations[c].label}, {name}: {number(values[c])} of {number(total[c])}")
            start += values[c]
        axes.text(start, row, " " + number(start, 3), va="center", fontsize=6, color=INK)
    axes.set_yticks(range(len(shown)), [r.configurations[c].label for c in shown])
    axes.set(ylim=(len(shown) - 0.4, -0.6), xlabel=x_label)
    axes.set_xlim(0, 1.14 * max(total[shown]))
    axes.grid(axis="y", visible=False)
    axes.tick_params(axis="y", length=0)
    d.legend([Patch(color=color) for _, color in parts.values()], list(parts))
    return d


def by_pass(r, scene, chart, title, x_label, costs):
    rays = numpy.nansum(r.pass_rays, axis=-1)
    return stacked(r, scene, chart, title, x_label, r.passes, weighty(r.pass_ms, rays), costs)


def time_by_pass(r, scene):
    f = shown_frame(r)
    return by_pass(r, scene, "time_by_pass", f"Time by pass{at_frame(r, f)}", f"mean time (ms, {devices(r)})", r.pass_ms[scene, :, f])


def rays_by_pass(r, scene):
    f = shown_frame(r)
    return by_pass(r, scene, "rays_by_pass", f"Rays by pass{at_frame(r, f)}", "rays a pixel", numpy.nansum(r.pass_rays[scene, :, f], axis=-1))


def rays_by_purpose(r, scene):
    f = shown_frame(r)
    costs = numpy.nansum(r.pass_rays, axis=3)
    return stacked(r, scene, "rays_by_purpose", f"Rays by purpose{at_frame(r, f)}", "rays a pixel", r.purposes, weighty(costs), costs[scene, :, f])


def baseline_of(found):
    return configuration_of(found["baseline"]).label


def span_text(span):
    middle, low, high = span
    return number(middle) + (f" ({number(low, 3)} to {number(high, 3)})" if numpy.isfinite([low, high]).all() else "")


def draw_ratios(r, scene, metric, chart, found, names, title, x_label):
    """`found`: places in the arrays of comparisons."""
    spans = [r.comparison[metric["name"]][at] for at in found]
    about = [f"{label}: {span_text(span)} times the {metric['name']} of {baseline_of(r.compared[at])}" for label, span, at in zip(names, spans, found)]
    d = Drawing(slug(r.scenes[scene], chart, metric["name"]), title, height=0.5 + 0.16 * len(found))
    # Told apart from the baseline for the worse or not: nothing is blamed whose interval holds 1.
    draw_forest(d, names, spans, [not low > 1 for _, low, _ in spans], about, x_label, 1.0, log=True)
    paired = all(r.compared[at]["rays"]["paired"] for at in found)
    d.note = f"95 % intervals{', seed by seed' if paired else ''}. Diamonds: worse beyond the interval."
    return d


def comparisons_at(r, scene, metric, ablation):
    """Places of what is compared in the shown frame, and has a ratio."""
    f = shown_frame(r, metric)
    return [at for at, found in r.compared.items()
            if at[0] == scene and at[2] == f and (found["without"] is not None) == ablation and numpy.isfinite(r.comparison[metric["name"]][at][0])]


def comparison(r, scene, metric):
    """Errors as multiples of the baseline's."""
    found = comparisons_at(r, scene, metric, False)
    if not metric["fromZero"] or not found:
        return None
    baselines = dict.fromkeys(baseline_of(r.compared[at]) for at in found)
    against = next(iter(baselines)) if len(baselines) == 1 else r.summary["baseline"]
    names = [r.labels[at[1]] for at in found]
    title = f"{metric['name']} against {against}{at_frame(r, found[0][2])}"
    return draw_ratios(r, scene, metric, "comparison", found, names, title, f"{metric['name']} ÷ that of {against}")


def ablation(r, scene, metric):
    """What each part of a technique is worth: the error without it as a multiple of the whole's, the dearest first."""
    found = comparisons_at(r, scene, metric, True)
    if not metric["fromZero"] or not found:
        return None
    found.sort(key=lambda at: -r.comparison[metric["name"]][at][0])
    wholes = dict.fromkeys(baseline_of(r.compared[at]) for at in found)
    names = [" and ".join(r.compared[at]["without"]) + (f" ({baseline_of(r.compared[at])})" if len(wholes) > 1 else "") for at in found]
    whole = next(iter(wholes)) if len(wholes) == 1 else "the whole"
    title = f"{metric['name']} of {whole} without a part{at_frame(r, found[0][2])}"
    return draw_ratios(r, scene, metric, "ablation", found, names, title, f"{metric['name']} without ÷ with it")


def decompositions_of(r, scene, frame, metric):
    """{configuration: {"squaredBias" and "variance": mean and half of the interval}}, of those that are shown."""
    here = (r.scenes[scene], r.frames[frame], metric["name"])
    found = {configuration_of(parts): {key: (real(parts[key]["mean"]), real(parts[key]["halfWidth"])) for key in ("squaredBias", "variance")}
             for parts in r.summary["decompositions"] if (parts["scene"], parts["frame"], parts["metric"]) == here}
    return {configuration: parts for configuration, parts in found.items() if configuration in r.configurations}


def bias_variance(r, scene, metric):
    """The error of one run as what no number of runs takes away, and the rest."""
    f = shown_frame(r)
    found = decompositions_of(r, scene, f, metric)
    if not found:
        return None
    title = f"Bias and variance of {metric['name']}{at_frame(r, f)}"
    d = Drawing(slug(r.scenes[scene], "bias_variance", metric["name"]), title, height=0.5 + 0.24 * len(found))
    axes = d.axes
    for row, (configuration, parts) in enumerate(found.items()):
        for shift, (key, text, place) in zip((-0.19, 0.19), (("squaredBias", "squared bias", 1), ("variance", "variance of a run", 0))):
            mean, half = parts[key]
            (bar,) = axes.barh(row + shift, mean, height=0.36, color=color_of(place))
            d.hint(bar, f"{configuration.label}, {text}: {with_interval(mean, half)}")
            if numpy.isfinite(half):
                axes.plot([mean - half, mean + half], [row + shift] * 2, color=INK, linewidth=0.7)
    axes.axvline(0, color=INK, linewidth=0.6)
    axes.set_yticks(range(len(found)), [configuration.label for configuration in found])
    axes.set(ylim=(len(found) - 0.4, -0.6), xlabel=with_unit(metric))
    axes.grid(axis="y", visible=False)
    axes.tick_params(axis="y", length=0)
    d.legend([Patch(color=color_of(1)), Patch(color=color_of(0))], ["squared bias", "variance of a run"])
    d.note = "Their sum is the mean error of a run; the squared bias may fall below 0 where there is none. Lines: 95 % (jackknife over seeds)."
    return d


OUTCOMES = [("best, or within its interval", "#cfe3f2"), ("up to 2 times the best", "#f3eedd"), ("up to 5 times", "#f4cfa4"), ("more", "#e08a5b")]


def outcome(mean, half, best, best_half):
    if mean - (half if numpy.isfinite(half) else 0) <= best + (best_half if numpy.isfinite(best_half) else 0):
        return 0
    return 1 if mean <= 2 * best else 2 if mean <= 5 * best else 3


def stability_matrix(r, metric):
    """Technique by scene, each a case where methods fail: the mean over the measured steps."""
    if not metric["temporal"]:
        return None
    values = r.sequence[metric["name"]]
    rows = [c for c in range(len(r.configurations)) if numpy.isfinite(values[:, c, 0]).any()]
    if not rows:
        return None
    d = Drawing(slug("stability_matrix", metric["name"]), f"Stability by case: {metric['name']}", height=0.55 + 0.2 * len(rows))
    axes = d.axes
    for s in range(len(r.scenes)):
        column = values[s][rows]
        best = int(numpy.nanargmin(column[:, 0])) if numpy.isfinite(column[:, 0]).any() else 0
        for row, (mean, half) in enumerate(column):
            if not numpy.isfinite(mean):
                continue
            kind = outcome(mean, half, *column[best])
            (cell,) = axes.bar(s, 1, width=1, bottom=row - 0.5, color=OUTCOMES[kind][1], edgecolor="white", linewidth=1)
            label = r.configurations[rows[row]].label
            d.hint(cell, f"{label}, {r.scenes[s]}: {with_interval(mean, half)}; {OUTCOMES[kind][0]}")
            axes.text(s, row, number(mean, 3), ha="center", va="center", fontsize=6.5, color=INK, fontweight="bold" if mean == column[best][0] else "normal")
    axes.set_xticks(range(len(r.scenes)), r.scenes, rotation=0 if len(r.scenes) <= 4 else 35, ha="center" if len(r.scenes) <= 4 else "left")
    axes.xaxis.tick_top()
    axes.set_yticks(range(len(rows)), [r.configurations[c].label for c in rows])
    axes.set(xlim=(-0.5, len(r.scenes) - 0.5), ylim=(len(rows) - 0.5, -0.5))
    axes.grid(False)
    axes.tick_params(length=0)
    for side in ("left", "bottom"):
        axes.spines[side].set_visible(False)
    d.legend([Patch(facecolor=color) for _, color in OUTCOMES], [text for text, _ in OUTCOMES])
    d.note = f"Means of {with_unit(metric)} over the measured steps and seeds; bold: the least of a case."
    return d


JUDGED = {"holds": ("holds", "#cfe3f2"), "strained": ("is strained", "#f4cfa4"), "fails": ("fails", "#e08a5b")}


def short(text):
    """The number of a text such as "1.32 +- 0.2" or "-0.342 +- 0.57 %", to two digits; what is unsettled has none."""
    word = text.split(" ")[0]
    if word == "unsettled":
        return "∞"
    value = float(word)
    return "0" if abs(value) < 0.001 else f"{value:.2g}"


def row_label(case):
    unit, of_unit = (" (%)", 100) if case["quantity"] == "energy" else ("", 1)
    low, high = (of_unit * limit for limit in case["limits"])
    return f"{case['name']}: {case['quantity']}{unit}\n{case['measure']}, {low:g} / {high:g}"


def outcomes(r):
    """Failure case by technique, by the study's own limits: which hold, are strained, or fail."""
    matrix = r.summary.get("outcomes")
    if not matrix or not any(cell for case in matrix["cases"] for cell in case["cells"]):
        return None
    columns, cases = matrix["columns"], matrix["cases"]
    d = Drawing("outcomes", "Which techniques hold", height=0.75 + 0.3 * len(cases))
    axes = d.axes
    for row, case in enumerate(cases):
        for column, cell in enumerate(case["cells"]):
            if not cell:
                continue
            word, color = JUDGED[cell["outcome"]]
            (box,) = axes.bar(column, 1, width=1, bottom=row - 0.5, color=color, edgecolor="white", linewidth=1)
            doubt = "" if cell["certain"] else "; its 95 % interval reaches another outcome"
            d.hint(box, f"{columns[column]}, {case['name']} ({case['scene']}): {case['quantity']} of {case['measure']} {cell['text']}; {word}{doubt}")
            size = 6.5 if len(columns) <= 5 else 5.5
            axes.text(column, row, short(cell["text"]) + ("" if cell["certain"] else "?"), ha="center", va="center", fontsize=size, color=INK)
    axes.set_xticks(range(len(columns)), columns, rotation=0 if len(columns) <= 3 else 35, ha="center" if len(columns) <= 3 else "left")
    axes.xaxis.tick_top()
    axes.set_yticks(range(len(cases)), [row_label(case) for case in cases], fontsize=5.5)
    axes.set(xlim=(-0.5, len(columns) - 0.5), ylim=(len(cases) - 0.5, -0.5))
    axes.grid(False)
    axes.tick_params(length=0)
    for side in ("left", "bottom"):
        axes.spines[side].set_visible(False)
    d.legend([Patch(facecolor=color) for _, color in JUDGED.values()], [word for word, _ in JUDGED.values()])
    d.note = "A number up to the first limit of its case holds, up to the second is strained, above fails. ?: the 95 % interval reaches another outcome. ∞: not settled by the last measured frame."
    return d


def cost_vs_pixels(r, file, time):
    """What a frame takes at the sizes of its image; `file`: the scene's, which has several."""
    scenes = [s for s, scene in enumerate(r.summary["scenes"]) if scene["file"] == file]
    f, curves = shown_frame(r), {}
    for c, configuration in enumerate(r.configurations):
        for s in scenes:
            if r.cell(s, c, f) is None:
                continue
            value = r.ms[s, c, f] if time else r.rays[s, c, f]
            about = f"{configuration.label}: {r.pixels[s]:.0f} pixels, {number(value)} {'ms' if time else 'rays a pixel'}"
            curves.setdefault(configuration.label, (r.place[configuration.label], []))[1].append(
                Point(r.pixels[s], value, about, tuple(r.ms_range[s, c, f]) if time else (numpy.nan, numpy.nan)))
    what = "time" if time else "rays"
    d = Drawing(slug(file, f"{what}_vs_pixels"), f"{file}: {what} of a frame against pixels")
    return draw_points(d, curves, "pixels of the frame", f"time of the frame (ms, {devices(r)})" if time else "rays a pixel", True, time)
