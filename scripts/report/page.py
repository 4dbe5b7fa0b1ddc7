# SPDX-License-Identifier: MIT
"""report.html of one study: conditions, images, and of each scene charts and tables, in one file that needs no other."""
import json
import pathlib
from types import SimpleNamespace

import jinja2
from markupsafe import Markup

from . import charts, error_charts, images, needs_charts, tables, words
from .plots import slug

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
        elif chart and chart.of == "count":
            for metric in r.metrics:
                for count in r.counts:
                    drawn += figures.draw(chart.draw, r, s, metric, count)
        elif chart and chart.of == "scene":
            drawn += figures.draw(chart.draw, r, s)
    return drawn


def chart_names(r):
    return r.summary["charts"] if r.kind == "error" else list(charts.ENSEMBLE)


def section(r, s, figures):
    found = any(place == s for place, *_ in r.measured())
    if not found:
        return SimpleNamespace(id=slug(r.scenes[s]), name=r.scenes[s], drawings=[], tables=[], empty="Nothing measured yet.")
    shown = tables.of_errors(r, s) if r.kind == "error" else tables.of_ensemble(r, s)
    return SimpleNamespace(id=slug(r.scenes[s]), name=r.scenes[s], drawings=drawings_of(r, s, chart_names(r), figures), tables=shown, empty="")


def over_scenes(r, figures):
    """Sections that no scene is alone in."""
    if r.kind != "error":
        return []
    sections = []
    drawn = figures.draw(error_charts.outcomes, r) if "outcomes" in chart_names(r) else []
    if drawn:
        sections.append(SimpleNamespace(id="outcomes", name="Where methods fail", drawings=drawn, tables=[], empty=""))
    drawn = [drawing for metric in r.metrics for drawing in figures.draw(error_charts.stability_matrix, r, metric)] if "stability_matrix" in chart_names(r) else []
    if drawn:
        sections.append(SimpleNamespace(id="stability-by-case", name="Stability by case", drawings=drawn, tables=[], empty=""))
    drawn = [drawing for count in r.counts for drawing in figures.draw(needs_charts.cost_vs_model, r, count)] if "cost_vs_model" in chart_names(r) else []
    if drawn:
        sections.append(SimpleNamespace(id="cost-with-the-model", name="Cost with the model", drawings=drawn, tables=[], empty=""))
    files = [scene["file"] for scene in r.summary["scenes"]]
    drawn = []
    for file in dict.fromkeys(files):
        if files.count(file) > 1:
            for time in (True, False):
                drawn += figures.draw(error_charts.cost_vs_pixels, r, file, time)
    if drawn:
        sections.append(SimpleNamespace(id="cost-with-resolution", name="Cost with resolution", drawings=drawn, tables=[], empty=""))
    return sections


def report(r, figures, limit):
    found, left_out = images.embedded(r, limit)
    note = "The last measured frame of the first seed" if r.kind == "error" else "Means over all runs"
    note += ", linear radiance in half floats; exposure 0 EV brings the reference's median luminance to 0.18; magenta is no number."
    if left_out:
        note += f" Left out to keep the page small (--embed): {words.listed(left_out)}."
    sections = [section(r, s, figures) for s in range(len(r.scenes))]
    reading = words.reading_error(r) if r.kind == "error" else words.reading_ensemble(r)
    return render("report.html", title=r.name, about=r.summary["about"], facts=words.facts(r), missing=words.missing(r), reading=reading,
                  images=found, images_note=note, sections=over_scenes(r, figures) + sections)
