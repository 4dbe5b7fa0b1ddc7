# SPDX-License-Identifier: MIT
"""report.html of one study: conditions, images, and of each scene charts and tables, in one file that needs no other."""
import json
import pathlib
from types import SimpleNamespace

import jinja2
import numpy
from markupsafe import Markup

from . import charts, images
from .drawing import number
from .results import configuration_of

HERE = pathlib.Path(__file__).parent


def script_json(value):
    """JSON inside a <script>, where "</" would end it."""
    return Markup(json.dumps(value, separators=(",", ":")).replace("<", "\\u003c"))


def render(template, **values):
    environment = jinja2.Environment(loader=jinja2.FileSystemLoader(HERE / "templates"), autoescape=True, trim_blocks=True, undefined=jinja2.StrictUndefined)
    environment.filters["json"] = script_json
    for name in ("page.css", "hints.js", "viewer.js"):
        values[name.replace("page.", "").replace(".", "_")] = Markup((HERE / name).read_text())
    return environment.get_template(template).render(values)


def listed(parts):
    parts = list(parts)
    return ", ".join(parts[:-1]) + " and " + parts[-1] if len(parts) > 1 else "".join(parts)


def cell(text="", value=None, interval="", kind=""):
    return SimpleNamespace(text=text, value=None if value is None or not numpy.isfinite(value) else repr(float(value)), interval=interval, kind=kind)


def measured(mean, half_width, kind=""):
    return cell(number(mean) if numpy.isfinite(mean) else "", mean, number(half_width, 2) if numpy.isfinite(half_width) else "", kind)


def table(slug, head, rows, note="", title=""):
    return SimpleNamespace(slug=slug, head=head, rows=rows, note=note, title=title)


# What is said of both kinds.
def facts(r):
    s = r.summary
    sizes = dict.fromkeys(f"{scene['size'][0]} × {scene['size'][1]}" for scene in s["scenes"])
    frames = f"{s['warmup']} of warm-up, then " + listed(str(offset) for offset in s["frames"]) if s["warmup"] else listed(str(offset) for offset in s["frames"])
    return [("device", listed(s["devices"]) or "no device yet"), ("machine", s["machine"]), ("date", s["date"].replace("T", " ").replace("Z", " UTC")),
            ("Lodestir", f"{s['lodestir']} ({s['revision']})"), ("pixels", ", ".join(sizes)), ("seeds" if r.kind == "error" else "runs", str(s["seeds"])),
            ("frames", frames), ("reference", f"{s['referenceSamples']} samples a pixel")]


def pairing(r):
    if r.summary["paired"]:
        return "Every technique draws the same seeds, so that differences between techniques can be taken run by run; what all of them show alike is one observation."
    return "Every technique and value of a knob draws seeds of its own."


def missing(r):
    count = r.summary["missing"]
    what = "runs" if r.kind == "error" else "chunks of runs"
    return f"{count} {what} are still missing." if count else ""


# Studies of errors.
def reading_error(r):
    clean, noisy = (list(dict.fromkeys(m["metric"] for m in r.metrics if m["noiseFree"] == free)) for free in (True, False))
    be = lambda names: "is" if len(names) == 1 else "are"  # noqa: E731
    sentences = ["Times are the device's own and medians over seeds (bars: fastest to slowest); errors are means over seeds with 95 % intervals of Student's t."]
    sentences.append("References are rendered in two independent halves A and B" + (
        f"; {listed(clean)} {be(clean)} the mean of (x − A)(x − B), which the noise of the reference does not raise (and which may fall below 0 where the error "
        "is far smaller than that noise)." if clean else "."))
    sentences.append("All seeds are judged by one reference: intervals tell the spread of the technique" +
                     (", those of bias the reference's noise as well." if "bias" in noisy else " and not of the reference."))
    sentences.append(pairing(r))
    if noisy:
        sentences.append(f"{listed(noisy)} {be(noisy)} measured against (A + B) / 2 and include{'s' if len(noisy) == 1 else ''} that image's noise.")
    if any("llvmpipe" in device for device in r.summary["devices"]):
        sentences.append("Times on a CPU driver say nothing of a GPU; rays and ratios do.")
    sentences += [f"{m['metric']}: {m['about']}." for m in {m["metric"]: m for m in r.metrics}.values()]
    for mask in dict.fromkeys(m["mask"] for m in r.metrics if m["mask"]):
        sentences.append(f".{mask}: only where " + ("objects are seen that take another level at frame 0 or later." if mask == "switched" else "the study's mask of that name isn't 0."))
    if any(m["finest"] for m in r.metrics):
        sentences.append(".finest: against the scene at its finest levels, so that what a coarser level loses counts too.")
    return sentences


def error_table(r, s):
    rows, noise = [], {}
    for place, c, f, found in r.measured():
        if place != s:
            continue
        at = s, c, f
        rows.append([cell(r.labels[c]), cell(str(r.frames[f])), cell(str(len(found["seeds"]))), cell(number(r.ms[at]), r.ms[at]),
                     cell(f"{number(r.ms_range[at][0])} – {number(r.ms_range[at][1])}"), cell(number(r.rays[at]), r.rays[at])]
                    + [measured(r.error[m["name"]][at], r.half_width[m["name"]][at]) for m in r.metrics])
        noise = noise or found["referenceNoise"]
    head = ["technique", "frame", "seeds", "ms", "fastest – slowest", "rays a pixel"] + [m["name"] for m in r.metrics]
    taken = ", ".join(f"{name} {number(value, 3)}" for name, value in noise.items())
    return table(f"table.{charts.slug(r.scenes[s])}", head, rows, f"Noise of the reference itself, taken out above: {taken}." if taken else "")


def comparison_tables(r, s):
    """Against the baseline, and of each technique without its parts."""
    tables = []
    for ablation in (False, True):
        rows, baselines = [], {}
        for at, found in r.compared.items():
            if at[0] != s or (found["without"] is not None) != ablation:
                continue
            baselines[charts.baseline_of(found)] = None
            label = " and ".join(found["without"]) if ablation else r.labels[at[1]]
            row = [cell(label), cell(str(found["frame"])), cell(charts.baseline_of(found), kind="text")]
            for difference in [found["metrics"].get(m["name"]) for m in r.metrics] + [found["ms"], found["rays"]]:
                if difference is None:
                    row.append(cell())
                    continue
                span = [numpy.nan if difference[key] is None else difference[key] for key in ("middle", "low", "high")]
                row.append(cell(("× " if difference["ratio"] else "") + charts.span_text(span), span[0]))
            rows.append(row)
        if rows:
            title = "What each part is worth" if ablation else f"Against {next(iter(baselines)) if len(baselines) == 1 else r.summary['baseline']}"
            tables.append(table(f"{'ablation' if ablation else 'comparison'}.{charts.slug(r.scenes[s])}", ["without" if ablation else "technique", "frame", "held against"]
                                + [m["name"] for m in r.metrics] + ["ms", "rays"], rows,
                                "×: geometric means of ratios with their 95 % intervals" + (", seed by seed" if all(found["rays"]["paired"] for found in r.compared.values()) else "")
                                + "; else, where some values aren't positive, differences.", title))
    return tables


def exponent_table(r, s):
    rows = []
    for found in r.summary["exponents"]:
        configuration = configuration_of(found)
        if found["scene"] == r.scenes[s] and configuration in r.configurations:
            e = found["exponent"]
            rows.append([cell(configuration.curve if found["over"] else configuration.label), cell(found["over"].split(".", 1)[-1] or "frames", kind="text"), cell(found["metric"], kind="text"),
                         measured(*(numpy.nan if e[key] is None else e[key] for key in ("mean", "halfWidth")))])
    return [table(f"exponents.{charts.slug(r.scenes[s])}", ["technique", "over", "metric", "exponent"], rows,
                  "p of error ~ n^p: −1 of squared errors of independent samples, nearer to 0 where frames share history or a bias stays.", "How errors fall")] if rows else []


def budget_table(r, s):
    rows = []
    for place, c, f, found in r.measured():
        if place == s and "budget" in found:
            b = found["budget"]
            took = r.ms[s, c, f] if r.summary["equal"] == "ms" else r.rays[s, c, f]
            rows.append([cell(r.labels[c]), cell(str(r.frames[f])), cell(number(b["given"]), b["given"]), cell(number(b["reached"]), b["reached"]), cell(number(took), took),
                         cell("" if b["inRange"] else "out of its knob's range", kind="text")])
    return [table(f"budget.{charts.slug(r.scenes[s])}", ["technique", "frame", f"given ({r.summary['equal']})", "when chosen", "measured", ""], rows, title="Equal budgets")] if rows else []


# Ensembles.
def reading_ensemble(r):
    s = r.summary
    return [f"{s['seeds']} independent runs of each technique, whose measured frames are averaged and held against a path-traced reference in {s['batches']} batches.",
            f"Two tests, each blaming correct code once in a thousand: of the energy (luminance and the three colours), and of the means of blocks of {s['blockSize']} × {s['blockSize']} "
            "pixels and three colours. Both are Welch's t over runs, corrected for skewness (Johnson 1978, Hall 1992), with Bonferroni's correction; the reference's noise counts.",
            f"Unbiased: neither test rejects, the energy is known to ±{100 * s['halfWidth']:g} % (95 %), and planted faults that such an interval promises to show are caught at least 95 times in 100. "
            "Inconclusive is a failure, too.", pairing(r),
            "All are held against one draw of a scene's reference, whose error they share: signs that agree within its noise say nothing."]


def percent(value, digits=3):
    return f"{100 * value:+.{digits}f} %".replace("-", "−") if numpy.isfinite(value) else "unknown"


def ensemble_tables(r, s):
    cells = charts.ensemble_cells(r, s)
    roles = {t["name"]: "control" if t["control"] else "planted fault" if t["planted"] else "" for t in r.summary["techniques"]}
    rows, halves = [], {}
    for c, f, found in cells:
        at = s, c, f
        halves[f] = found["halvesSigmas"]
        rows.append([cell(charts.ensemble_label(r, c, f)), cell(roles[r.configurations[c].technique], kind="text"), cell(str(found["runs"])), cell(found["verdict"], kind=found["verdict"]),
                     cell(percent(r.difference[at]), r.difference[at], f"{100 * r.half_width[at]:.3f} %"), cell(number(r.energy_p[at], 2), r.energy_p[at]),
                     cell(number(r.block_p[at], 2), r.block_p[at]), cell(number(r.ms[at]), r.ms[at]), cell(number(r.rays[at]), r.rays[at]), cell(found["reason"], kind="reason")])
    apart = ", ".join(f"{value:+.2f} sigmas{f' (frame {r.frames[f]})' if len(halves) > 1 else ''}".replace("-", "−") for f, value in halves.items() if value is not None)
    tables = [table(f"table.{charts.slug(r.scenes[s])}", ["technique", "role", "runs", "verdict", "energy against the reference", "p of energy", "p of blocks", "ms", "rays a pixel", "because"],
                    rows, f"The reference's halves differ by {apart}.")]
    rows = []
    for c, f, found in cells:
        k = found.get("convergence")
        if k:
            deviation = k["biasDeviation"]
            rows.append([cell(charts.ensemble_label(r, c, f)), cell(number(k["noise"]), k["noise"]), cell(number(k["bias"], 2), k["bias"], number(2 * deviation, 2) if deviation is not None else ""),
                         cell(f"{100 * k['difference']:.2f} %", k["difference"]), cell(f"{100 * k['differenceOfNoise']:.2f} %", k["differenceOfNoise"])])
    if rows:
        tables.append(table(f"convergence.{charts.slug(r.scenes[s])}", ["technique", "noise of a run", "bias", "mean difference", "that of noise"], rows,
                            "Of luminance, by pixel; the reference's noise is taken out, so that what has no bias may fall below 0. Noise of a run and bias are RelMSE: by the spread of the runs, and of "
                            "the mean over endlessly many (± two standard deviations, by leaving out chunks of runs). One run's error is their sum, that of the mean over n runs noise / n + bias. "
                            "Mean difference: |mean over all runs − reference| / reference; beside it what noise alone makes of it.", "Convergence"))
    return tables


# The page.
class Figures:
    """Draws charts, each once: SVG for the page, PDF beside it."""

    def __init__(self, folder):
        self.folder = folder
        self.count = 0

    def draw(self, chart, *arguments):
        drawing = chart(*arguments)
        return [] if drawing is None else self.finish(drawing)

    def finish(self, drawing):
        svg = Markup(drawing.svg())
        if self.folder:
            drawing.save_pdf(self.folder)
        drawing.close()
        self.count += 1
        pdf = f"{self.folder.name}/{drawing.slug}.pdf" if self.folder else None
        return [SimpleNamespace(slug=drawing.slug, title=drawing.title, note=drawing.note, svg=svg, pdf=pdf)]


def drawings_of(r, s, names, figures):
    known, drawn = charts.ERROR if r.kind == "error" else charts.ENSEMBLE, []
    for name in names:
        chart = known.get(name)
        if chart and chart.of == "metric":
            for metric in r.metrics:
                drawn += figures.draw(chart.draw, r, s, metric)
        elif chart and chart.of == "scene":
            drawn += figures.draw(chart.draw, r, s)
    return drawn


def chart_names(r):
    return r.summary["charts"] if r.kind == "error" else list(charts.ENSEMBLE)


def section(r, s, figures):
    found = any(place == s for place, *_ in r.measured())
    if not found:
        return SimpleNamespace(id=charts.slug(r.scenes[s]), name=r.scenes[s], drawings=[], tables=[], empty="Nothing measured yet.")
    tables = [error_table(r, s)] + budget_table(r, s) + comparison_tables(r, s) + exponent_table(r, s) if r.kind == "error" else ensemble_tables(r, s)
    return SimpleNamespace(id=charts.slug(r.scenes[s]), name=r.scenes[s], drawings=drawings_of(r, s, chart_names(r), figures), tables=tables, empty="")


def over_scenes(r, figures):
    """Sections that no scene is alone in."""
    if r.kind != "error":
        return []
    sections = []
    drawn = [drawing for metric in r.metrics for drawing in figures.draw(charts.stability_matrix, r, metric)] if "stability_matrix" in chart_names(r) else []
    if drawn:
        sections.append(SimpleNamespace(id="stability-by-case", name="Stability by case", drawings=drawn, tables=[], empty=""))
    files = [scene["file"] for scene in r.summary["scenes"]]
    drawn = []
    for file in dict.fromkeys(files):
        if files.count(file) > 1:
            for time in (True, False):
                drawn += figures.draw(charts.cost_vs_pixels, r, file, time)
    if drawn:
        sections.append(SimpleNamespace(id="cost-with-resolution", name="Cost with resolution", drawings=drawn, tables=[], empty=""))
    return sections


def report(r, figures, limit):
    found, left_out = images.embedded(r, limit)
    note = ("The last measured frame of the first seed, linear radiance in half floats" if r.kind == "error" else "Means over all runs, linear radiance in half floats")
    note += "; exposure 0 EV brings the reference's median luminance to 0.18; magenta is no number."
    if left_out:
        note += f" Left out to keep the page small (--embed): {listed(left_out)}."
    sections = [section(r, s, figures) for s in range(len(r.scenes))]
    return render("report.html", title=r.name, about=r.summary["about"], facts=facts(r), missing=missing(r), reading=reading_error(r) if r.kind == "error" else reading_ensemble(r),
                  images=found, images_note=note, sections=over_scenes(r, figures) + sections)
