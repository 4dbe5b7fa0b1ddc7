# SPDX-License-Identifier: MIT
"""The report of scripts/report: arrays, tables and charts against the rows that they are made of."""
import contextlib
import html.parser
import io
import json
import os
import pathlib
import re
import shutil
import socket
import subprocess
import sys
import tempfile
import unittest
import warnings
from unittest import mock

import numpy
import synthetic

from report import charts, compare, drawing, error_charts, exr, frontier, load, needs_charts, plots
from report.command import run, write
from report.drawing import Drawing, number, use_style

PROGRAM = pathlib.Path(synthetic.__file__).resolve().parents[2] / "scripts/report"


class Tables(html.parser.HTMLParser):
    """Cells by table: (text, data-value)."""

    def __init__(self, text):
        super().__init__()
        self.tables, self._cell = {}, None
        self.feed(text)

    def handle_starttag(self, tag, attributes):
        attributes = dict(attributes)
        if tag == "table":
            self._rows = self.tables[attributes.get("id")] = []
        elif tag == "tr":
            self._rows.append([])
        elif tag in ("td", "th"):
            self._cell = ["", attributes.get("data-value")]

    def handle_data(self, data):
        if self._cell:
            self._cell[0] += data

    def handle_endtag(self, tag):
        if tag in ("td", "th"):
            self._rows[-1].append(tuple(self._cell))
            self._cell = None


class ReportTest(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.root = pathlib.Path(tempfile.mkdtemp())
        cls.addClassCleanup(shutil.rmtree, cls.root)
        cls.folder = cls.root / "error"
        cls.needs = cls.root / "needs"
        synthetic.needs_study(cls.needs, ["needs", "advantage", "error_vs_count"])
        cls.grown = cls.root / "grown"
        synthetic.grown_study(cls.grown, ["cost_vs_model"])
        cls.rows = synthetic.error_study(cls.folder, ["error_vs_time", "time_by_pass", "stability_matrix", "stability", "ablation"])
        assert run([str(cls.folder), "--quiet"]) == 0
        cls.page = (cls.folder / "report.html").read_text()

    def test_table_equals_rows(self):
        """If this fails, the page tells other numbers than were measured."""
        for scene in ("box", "hall"):
            head, *rows = Tables(self.page).tables[f"table.{scene}"]
            columns = [text for text, _ in head]
            self.assertEqual(len(rows), len(synthetic.CONFIGURATIONS) * len(synthetic.FRAMES))
            for row in rows:
                cells = dict(zip(columns, row))
                technique, _, knob = cells["technique"][0].partition(", spp ")
                knobs = {"trace.spp": int(knob)} if knob else {}
                mine = [r for r in self.rows if (r["scene"], r["technique"], r["knobs"], r["frame"]) == (scene, technique, knobs, int(cells["frame"][0])) and r["run"] != "of another version"]
                self.assertEqual(len(mine), len(synthetic.SEEDS))
                self.assertEqual(float(cells["ms"][1]), numpy.median([r["ms"] for r in mine]))
                for name in ("relmse", "bias", "tflip"):
                    values = [r["metrics"][name] for r in mine if name in r["metrics"]]
                    if not values:
                        self.assertEqual(cells[name], ("", None))
                        continue
                    self.assertAlmostEqual(float(cells[name][1]), numpy.mean(values), delta=1e-12)
                    half = synthetic.T_3 * numpy.std(values, ddof=1) / 2
                    self.assertIn("± " + number(half, 2), cells[name][0])

    def test_arrays(self):
        r = load(self.folder)
        self.assertEqual(r.error["relmse"].shape, (2, 4, 3))
        self.assertEqual(r.values["tflip"].shape, (2, 4, 3, 4))
        at = r.scene("hall"), r.configuration("path tracing, spp 4"), r.frame(0)
        self.assertEqual(list(r.values["relmse"][at]), [synthetic.error_value("relmse", "hall", 1, 0, s) for s in synthetic.SEEDS])
        self.assertTrue(numpy.isnan(r.error["tflip"][at[0], at[1], r.frame(-1)]))
        self.assertEqual(r.rays[at], 6)
        self.assertEqual(list(r.seeds[at]), synthetic.SEEDS)
        self.assertEqual(r.pass_rays[at][r.passes.index("trace"), r.purposes.index("nee")], 4)
        self.assertEqual(len(r.rows()), len(self.rows) - 1, "neither a cut line nor another version")
        numpy.testing.assert_array_equal(r.image(1, 2), synthetic.image_of("hall", 2).astype(numpy.float16))

    def test_comparisons(self):
        tables = Tables(self.page).tables
        head, *rows = tables["comparison.box"]
        self.assertEqual({row[0][0] for row in rows}, {"path tracing, spp 4", "reuse"})
        at = [text for text, _ in head].index("relmse")
        for row in rows:
            index, frame = {"path tracing, spp 4": 1, "reuse": 2}[row[0][0]], int(row[1][0])
            of = lambda i: numpy.mean([synthetic.error_value("relmse", "box", i, frame, s) for s in synthetic.SEEDS])  # noqa: B023,E731
            self.assertAlmostEqual(float(row[at][1]), of(index) / of(0), delta=1e-12)
        self.assertEqual({row[0][0] for row in tables["ablation.box"][1:]}, {"spatial and temporal.cap"})
        self.assertEqual(tables["exponents.box"][1][-1], ("−0.98 ± 0.03", "-0.98"))
        self.assertNotIn("exponents.hall", tables)
        self.assertEqual([text for text, _ in tables["budget.hall"][1]], ["reuse", "-1", "30", "31", "31.5", "out of its knob's range"])
        self.assertEqual(tables["budget.box"][1][-1][0], "")

    def test_page_stands_alone(self):
        for part in ("<svg", "a &lt; b", "slow &amp; poor", "Stability by case: tflip", "Stability: relmse against that of frame -1", "Time by pass, frame 0", 'id="images"'):
            self.assertIn(part, self.page)
        bare = re.sub(r'xmlns(:\w+)?="http[^"]*"', "", self.page)
        for part in ("http", "<img", "<link", " src=", "@import", ">nan", " nan", '"nan', ">inf"):
            self.assertNotIn(part, bare)
        self.assertEqual({path.name for path in (self.folder / "figures").iterdir()}, {f"{d}.pdf" for d in re.findall(r'<figure id="([^"]+)"', self.page)})

    def test_marks_say_their_values(self):
        r = load(self.folder)
        mean = numpy.mean([synthetic.error_value("relmse", "box", 2, 0, s) for s in synthetic.SEEDS])
        drawing = error_charts.error_vs_time(r, 0, r.metrics[0])
        svg = drawing.svg()
        self.assertEqual(svg.count("<title>"), len(synthetic.CONFIGURATIONS))
        self.assertIn(f"<title>reuse: 31.5 ms, 9 rays a pixel, relmse {number(mean)}", svg)
        drawing.close()

    def test_logarithmic_axes_and_hidden_points(self):
        """If this fails, points stand elsewhere than their values, or vanish without a word."""
        d = Drawing("test", "a title")
        points = [plots.Point(v, 1 / v, "p") for v in (1.0, 10.0, 100.0)] + [plots.Point(10.0, -1.0, "below")]
        plots.draw_points(d, {"curve": ((0,), points)}, "x (ms)", "y", True, True)
        places = [d.axes.transData.transform((p.x, p.y)) for p in points[:3]]
        d.finish()
        self.assertAlmostEqual(places[1][0] - places[0][0], places[2][0] - places[1][0], places=6)
        self.assertAlmostEqual(places[1][1] - places[0][1], places[2][1] - places[1][1], places=6)
        svg = d.svg()
        self.assertNotIn("below", svg)
        self.assertIn("1 point has no place on these axes", d.note)
        d.close()

    def test_curves_differ_in_more_than_their_colour(self):
        """Also where nothing is dashed: marker and colour tell them apart."""
        styles = [drawing.curve_style(i) for i in range(21)]
        for i, a in enumerate(styles):
            for b in styles[:i]:
                self.assertGreaterEqual(sum(str(a[key]) != str(b[key]) for key in ("color", "marker", "linestyle")), 2)

    def test_names_of_points_cover_nothing(self):
        d = Drawing("names", "a title")
        d.axes.plot([1, 1.02, 1.04, 3], [1, 1.01, 1.0, 3], marker="o", linestyle="none")
        d.label_points([(x, y, "candidates 4", "black") for x, y in ((1, 1), (1.02, 1.01), (1.04, 1.0), (3, 3))])
        d.finish()
        boxes = [text.get_window_extent() for text in d.axes.texts]
        self.assertGreaterEqual(len(boxes), 2)
        for i, box in enumerate(boxes):
            self.assertEqual(box.count_overlaps(boxes[:i]), 0)
        d.close()

    def test_frontier_keeps_the_undominated(self):
        point = lambda x, y: plots.Point(x, y, "")  # noqa: E731
        points = [point(1, 5), point(2, 5), point(2, 3), point(3, 4), point(4, 1), point(4, 2)]
        self.assertEqual([(p.x, p.y) for p in frontier.undominated(points)], [(1, 5), (2, 3), (4, 1)])

    def test_outcomes_are_the_study_s(self):
        """If this fails, a technique that fails is coloured as one that holds."""
        d = error_charts.outcomes(load(self.folder))
        svg = d.svg()
        for text in ("reuse, steps aside (box): spike of relmse 1.3 +- 0.1; is strained", "slow &amp; poor, steps aside (box): spike of relmse unsettled; fails; its 95 % interval reaches another outcome"):
            self.assertIn(f"<title>{text}</title>", svg)
        self.assertEqual(svg.count("<title>"), 2)
        d.close()
        self.assertEqual([error_charts.short(text) for text in ("1.32 +- 0.2", "-0.342 +- 0.57 %", "4 (4 to unsettled)", "unsettled", "0.0002", "nan")],
                         ["1.3", "-0.34", "4", "∞", "0", "nan"])
        case = {"name": "light", "quantity": "energy", "measure": "bias", "limits": [0.02, 0.05]}
        self.assertEqual(error_charts.row_label(case), "light: energy (%)\nbias, 2 / 5")

    def test_outcomes(self):
        self.assertEqual([error_charts.outcome(m, 0.1, 1.0, 0.1) for m in (1.0, 1.2, 1.3, 2.5, 6.0)], [0, 0, 1, 2, 3])

    def test_nothing_is_clipped(self):
        """Every text of every chart lies within the figure, whose width is a paper's column."""
        r, needs, grown = load(self.folder), load(self.needs), load(self.grown)
        arguments_of = {"metric": (r, 0, r.metrics[0]), "scene": (r, 0), "study": (r, r.metrics[2]), "whole": (r,), "count": (needs, 0, needs.metrics[0], "triangles"), "counts": (grown, "triangles")}
        draw = [(chart.draw, arguments_of[chart.of]) for chart in charts.ERROR.values()]
        for chart, arguments in draw:
            d = chart(*arguments)
            d.finish()
            width, height = d.figure.get_size_inches()
            self.assertAlmostEqual(width, 3.33, places=2)
            box = d.figure.get_tightbbox(d.figure.canvas.get_renderer())  # of all that is drawn, in inches
            for inside in (box.x0, box.y0, width - box.x1, height - box.y1):
                self.assertGreater(inside, -0.01, d.slug)
            d.close()

    def test_what_a_scene_needs(self):
        """If this fails, the wrong model is called enough, or a choice of levels is compared at another cost."""
        r = load(self.needs)
        metric = r.metrics[0]
        d = needs_charts.needs(r, 0, metric, "triangles")
        enough = re.findall(r"<title>enough: fixed, level (\d), spp (\d+):", d.svg())
        # 1.0, 1.01, 1.2 with a sample; 0.25, 0.26, 0.45 with 4; 0.0625, 0.0725, 0.2625 with 16: a tenth more than the least is enough.
        self.assertEqual(enough, [("1", "1"), ("1", "4"), ("0", "16")])
        self.assertIn("squared bias 0.2 ± 0.001", d.svg(), "of the samples that tell it best")
        d.close()
        rows = needs_charts.advantages(r, 0, metric)
        self.assertEqual([cost for _, cost, *_ in rows], [90, 180, 720])
        self.assertEqual([best for _, _, best, *_ in rows], ["fixed, level 2", "fixed, level 1", "fixed, level 1"])
        numpy.testing.assert_allclose([middle for _, _, _, middle, _ in rows], 0.9, rtol=1e-12)
        # Two groups of four with a relative deviation of 0.01 sqrt(4/3): each mean has 0.0057735, their ratio's logarithm 0.008165, and t of 6 degrees is 2.447.
        numpy.testing.assert_allclose([half for *_, half in rows], 0.01998, rtol=2e-3)
        curve = [(1.0, numpy.array([2.0])), (4.0, numpy.array([1.25]))]  # 1 + 1 / cost
        self.assertIsNone(needs_charts.error_at(0.5, curve))
        numpy.testing.assert_allclose([needs_charts.error_at(cost, curve)[0] for cost in (1, 2, 4, 8)], [2, 1.5, 1.25, 1.125])
        steep = [(1.0, numpy.array([2.0])), (2.0, numpy.array([0.5]))]  # its line is below 0 at 3 and more; what falls as 1 / cost is 1 / cost there
        numpy.testing.assert_allclose([needs_charts.error_at(cost, steep)[0] for cost in (1.5, 2, 4)], [1, 0.5, 0.25])
        self.assertIsNone(needs_charts.error_at(2, curve[:1]), "one cost tells nothing of another")
        self.assertEqual(needs_charts.error_at(1, curve[:1])[0], 2)

    def test_errors_below_nothing(self):
        """Errors less the reference's noise may fall below 0, runs may be single or have no such error. If this fails, one such study has no report."""
        def drawn(change):
            folder = self.root / "below"
            shutil.rmtree(folder, ignore_errors=True)
            synthetic.needs_study(folder, [])
            summary = json.loads((folder / "summary.json").read_text())
            change(summary)
            (folder / "summary.json").write_text(json.dumps(summary))
            r = load(folder)
            with warnings.catch_warnings():
                warnings.simplefilter("error")
                drawings = [needs_charts.advantage(r, 0, r.metrics[0])]
                for count in r.counts:
                    drawings += [needs_charts.needs(r, 0, r.metrics[0], count), needs_charts.error_vs_count(r, 0, r.metrics[0], count)]
            texts = [d and d.svg() for d in drawings]
            for d in drawings:
                if d:
                    d.close()
            return texts

        def errors(value):
            def change(summary):
                for cell in summary["cells"]:
                    cell["metrics"]["relmse"].update(mean=value, values=[value] * len(cell["seeds"]))
            return change

        for value in (0, -0.01, None):
            advantage, needs, *_ = drawn(errors(value))
            self.assertIsNone(advantage, "a ratio to nothing")
            self.assertNotIn("enough:", needs)

        def without_metric(summary):
            for cell in summary["cells"]:
                cell["metrics"] = {}
        self.assertNotIn("enough:", drawn(without_metric)[1])

        def single(summary):
            for cell in summary["cells"]:
                error = cell["metrics"]["relmse"]
                error.update(halfWidth=None, values=error["values"][:1])
                cell["seeds"] = cell["seeds"][:1]
            summary["decompositions"] = []
        advantage, needs, *_ = drawn(single)
        self.assertIn("times fixed, level 2 at 90<", advantage)
        self.assertEqual(needs.count("enough:"), 3)
        self.assertNotIn("geometry alone", needs)

    def test_steps_are_no_model(self):
        """If this fails, curves go to and fro between efforts, of which steps tell as well."""
        self.assertIsNone(needs_charts.needs(load(self.needs), 0, load(self.needs).metrics[0], "steps"))

    def test_cost_of_a_model_that_grows(self):
        d = needs_charts.cost_vs_model(load(self.grown), "triangles")
        found = re.findall(r"<title>(\w+), (\w+): (\d+) steps a pixel where fixed shows (\d+) triangles</title>", d.svg())
        self.assertEqual(found, [("fixed", "small", "10", "100"), ("fixed", "large", "20", "1000"), ("chosen", "small", "9", "100"), ("chosen", "large", "9", "1000")])
        d.close()
        self.assertIsNone(needs_charts.cost_vs_model(load(self.needs), "triangles"), "its baseline has a knob, and there is one scene")
        sizes = load(self.grown)
        sizes.pixels[0] *= 4
        self.assertIsNone(needs_charts.cost_vs_model(sizes, "triangles"), "what grows is the image")
        self.assertEqual(run([str(self.grown), "--quiet"]), 0)
        self.assertIn("Cost with the model", (self.grown / "report.html").read_text())

    def test_counts_stand_in_tables(self):
        """If this fails, a budget of steps is held against rays, and points that a chart left out stand nowhere."""
        folder = self.root / "budget"
        synthetic.needs_study(folder, [])
        summary = json.loads((folder / "summary.json").read_text())
        summary["equal"] = "steps a pixel"
        summary["cells"][-1]["budget"] = {"given": 800.0, "reached": 721.0, "inRange": True}
        (folder / "summary.json").write_text(json.dumps(summary))
        self.assertEqual(run([str(folder), "--quiet"]), 0)
        tables = Tables((folder / "report.html").read_text()).tables
        head, *rows = tables["table.box"]
        self.assertEqual([text for text, _ in head][6:8], ["triangles", "steps a pixel"])
        self.assertEqual([float(value) for _, value in rows[-1][6:8]], [300, 720])
        _, budget = tables["budget.box"]
        self.assertEqual([float(value) for _, value in budget[2:5]], [800, 721, 720])

    def test_selection_and_style(self):
        folder = self.root / "selected"
        shutil.copytree(self.folder, folder)
        style = folder / "mine.mplstyle"
        style.write_text("figure.figsize: 7, 3\naxes.prop_cycle: cycler(color=['123456', 'abcdef'])\n")
        self.assertEqual(run([str(folder), "--only", "reuse", "--style", str(style), "--charts", "error_vs_time", "--quiet"]), 0)
        text = (folder / "report.html").read_text()
        self.assertNotIn("path tracing, spp", "".join(row[0][0] for row in Tables(text).tables["table.box"]))
        self.assertIn("#abcdef", text, "the colour of the second curve, though the first is left out")
        self.assertNotIn("Time by pass", text)
        self.assertEqual(run([str(folder), "--only", "no such"]), 1)
        use_style()

    def test_compared(self):
        other = self.root / "other"
        shutil.copytree(self.folder, other)
        summary = json.loads((other / "summary.json").read_text())
        for cell in summary["cells"]:
            cell["ms"] = {key: 2 * value for key, value in cell["ms"].items()}
            cell["runs"] = [run + "'" for run in cell["runs"]] if cell["technique"] == "reuse" else cell["runs"]
        (other / "summary.json").write_text(json.dumps(summary))
        target = self.root / "compare.html"
        self.assertEqual(run(["--compare", str(self.folder), str(other), "--to", str(target), "--quiet"]), 0)
        head, *rows = Tables(target.read_text()).tables["compare.box"]
        self.assertEqual(len(rows), 12)
        for row in rows:
            self.assertEqual(float(row[4][1]), 2)  # ms, B to A
            self.assertEqual(float(row[10][1]), 1)  # relmse
            self.assertEqual(row[-1][0], "no" if row[0][0] == "reuse" else "yes")
        self.assertEqual(compare.ratio_of((3, 0.3), (2, 0))[0], 1.5)
        self.assertAlmostEqual(compare.ratio_of((3, 0.3), (2, 0))[1], 0.15)

    def test_index(self):
        synthetic.ensemble_study(self.root / "all/judged")
        shutil.copytree(self.folder, self.root / "all/measured")
        self.assertEqual(run([str(self.root / "all"), "--quiet"]), 0)
        text = (self.root / "all/index.html").read_text()
        for part in ('href="judged/report.html"', 'href="measured/report.html"', "1 unbiased and 1 biased"):
            self.assertIn(part, text)
        self.assertTrue((self.root / "all/judged/report.html").exists(), "drawn where it was missing")

    def test_ensemble(self):
        folder = self.root / "ensemble"
        synthetic.ensemble_study(folder)
        self.assertEqual(run([str(folder), "--quiet"]), 0)
        text = (folder / "report.html").read_text()
        for part in ("control", "planted fault", "Power", "in one block", "alarms", "Error of the mean over runs", "because of wrong", "block (1, 0): −1.25 sigmas"):
            self.assertIn(part, text)
        rows = Tables(text).tables["table.box"]
        self.assertEqual(rows[1][3][0], "unbiased")
        self.assertEqual(rows[2][3][0], "biased")
        self.assertEqual(float(rows[2][4][1]), 0.04)
        r = load(folder)
        self.assertEqual(r.verdict[0, 1, 0], "biased")
        numpy.testing.assert_array_equal(r.image(0, 1), synthetic.image_of("box", 1).astype(numpy.float32))

    def test_missing_and_several_sizes(self):
        folder = self.root / "sizes"
        synthetic.error_study(folder, ["rays_by_pass"])
        summary = json.loads((folder / "summary.json").read_text())
        summary["missing"] = 3
        for scene, size in zip(summary["scenes"], ([10, 5], [20, 5])):
            scene.update(file="box", size=size)
        for cell in summary["cells"]:
            if "rays" in cell:
                cell["rays"]["mean"] = 150
        (folder / "summary.json").write_text(json.dumps(summary))
        self.assertEqual(run([str(folder), "--quiet"]), 0)
        text = (folder / "report.html").read_text()
        for part in ("3 runs are still missing", "10 × 5, 20 × 5", "box: time of a frame against pixels", "box: rays of a frame against pixels", "reuse: 50 pixels, 3 rays a pixel",
                     "reuse: 100 pixels, 1.5 rays a pixel"):
            self.assertIn(part, text)
        self.assertNotIn("against pixels", self.page)

    def test_nothing_measured_yet(self):
        """If this fails, a study that was stopped at once, or a shard's, has no page."""
        for name, scenes in (("one", ["hall"]), ("none", ["box", "hall"])):
            folder = self.root / f"missing_{name}"
            synthetic.error_study(folder, list(charts.ERROR))
            summary = json.loads((folder / "summary.json").read_text())
            for cell in summary["cells"]:
                if cell["scene"] in scenes:
                    for key in set(cell) - {"scene", "technique", "knobs", "frame"}:
                        del cell[key]
                    cell.update(seeds=[], runs=[])
            for sequence in summary["sequences"]:
                sequence["metrics"] = {} if sequence["scene"] in scenes else sequence["metrics"]
            for key in ("comparisons", "exponents", "decompositions"):
                summary[key] = [found for found in summary[key] if found["scene"] not in scenes]
            (folder / "summary.json").write_text(json.dumps(summary))
            self.assertEqual(run([str(folder), "--quiet"]), 0)
            text = (folder / "report.html").read_text()
            self.assertEqual(text.count("Nothing measured yet."), len(scenes))
            self.assertEqual("relmse against time" in text, name == "one")

    def test_images_of_both_compressions(self):
        image = numpy.random.default_rng(1).normal(size=(37, 19, 3)) * 100
        for compression, kind in ((0, numpy.float32), (3, numpy.float16), (3, numpy.float32)):
            path = self.root / "image.exr"
            synthetic.write_exr(path, image, compression, kind)
            numpy.testing.assert_array_equal(exr.read(path), image.astype(kind).astype(numpy.float32))

    def test_leaves_nothing_behind(self):
        """If this fails, a report that was killed leaves half a page for good."""
        dead = subprocess.Popen([sys.executable, "-c", ""])
        dead.wait()
        path = self.root / "page.html"
        names = [self.root / f".page.html.{socket.gethostname()}.{pid}" for pid in (dead.pid, os.getppid())]
        for name in names:
            name.write_text("half a page")
        write(path, "a page")
        self.assertEqual(path.read_text(), "a page")
        self.assertEqual([name.exists() for name in names], [False, True], "who still writes is left alone")

    def test_damaged_files_are_named(self):
        folder = self.root / "damaged"
        synthetic.error_study(folder, ["error_vs_time"])
        image = folder / "images/hall.2.exr"
        image.write_bytes(image.read_bytes()[:400])
        for path, text in ((image, "is damaged or cut"), (folder / "summary.json", "is no JSON"), (folder / "summary.json", "has a format that")):
            errors = io.StringIO()
            with contextlib.redirect_stderr(errors):
                self.assertEqual(run([str(folder)]), 1)
            self.assertIn(str(path), errors.getvalue())
            self.assertIn(text, errors.getvalue())
            (folder / "summary.json").write_text("{ cut" if text == "is damaged or cut" else '{"format": 7}')

    def test_earlier_summaries_are_drawn(self):
        """If this fails, results that were archived can't be looked at any more."""
        folder = self.root / "earlier"
        synthetic.error_study(folder, list(charts.ERROR))
        summary = json.loads((folder / "summary.json").read_text())
        for name in ("comparisons", "exponents", "decompositions", "sequences", "outcomes", "baseline"):
            del summary[name]
        (folder / "summary.json").write_text(json.dumps(summary))
        self.assertEqual(run([str(folder), "--quiet"]), 0)
        text = (folder / "report.html").read_text()
        self.assertEqual(Tables(text).tables["table.box"], Tables(self.page).tables["table.box"])
        self.assertNotIn("comparison.box", Tables(text).tables)

    def test_a_lack_is_named(self):
        """Each member taken away by itself is done without, or named in one sentence. If this fails, a reader of another version's results sees a Traceback."""
        def members(value, place=()):
            if isinstance(value, list):
                value = dict(enumerate(value[:1]))
            for name in value if isinstance(value, dict) else ():
                if isinstance(name, str):
                    yield *place, name
                yield from members(value[name], (*place, name))

        for name, make in (("error", lambda folder: synthetic.error_study(folder, [])), ("ensemble", synthetic.ensemble_study)):
            folder = self.root / f"lacks_{name}"
            make(folder)
            whole = (folder / "summary.json").read_text()
            places, named = list(members(json.loads(whole))), 0
            for place in places:
                summary = json.loads(whole)
                owner = summary
                for step in place[:-1]:
                    owner = owner[step]
                del owner[place[-1]]
                (folder / "summary.json").write_text(json.dumps(summary))
                errors = io.StringIO()
                # All is read to make the charts; the ink, most of the time, would tell nothing more.
                with contextlib.redirect_stderr(errors), mock.patch.object(Drawing, "svg", lambda _: ""), mock.patch.object(Drawing, "save_pdf"):
                    code = run([str(folder), "--quiet"])
                if code:
                    self.assertIn("format" if place == ("format",) else f'lacks "{place[-1]}"', errors.getvalue(), place)
                    named += 1
            self.assertGreater(named, len(places) // 4, "most can't be done without")

    def test_says_what_is_missing(self):
        """If this fails, who lacks a package is not told which."""
        empty = self.root / "empty"
        empty.mkdir()
        self.assertEqual(run([str(empty)]), 1)
        shutil.copy(PROGRAM / "__main__.py", empty)
        text = (PROGRAM / "packages.py").read_text().replace('"numpy": "python3-numpy"', '"no_such_module": "python3-no-such"')
        (empty / "packages.py").write_text(text)
        output = subprocess.run([sys.executable, str(empty)], capture_output=True, text=True)
        self.assertEqual(output.returncode, 1)
        self.assertRegex(output.stderr, r"has no no_such_module; install python3-no-such \(scripts/setup does\)")
        self.assertNotIn("Traceback", output.stderr)


if __name__ == "__main__":
    unittest.main()
