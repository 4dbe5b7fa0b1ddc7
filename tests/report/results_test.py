# SPDX-License-Identifier: MIT
"""docs/results.md and what it is made of: archives of studies, and the figures that the template asks of them."""
import json
import math
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile
import unittest

import numpy
import synthetic

from report import archive, load
from report.command import run
from report.document import Study, render
from report.results import Missing
from report.statistics import compare_values, estimate, student_quantile

TREE = pathlib.Path(synthetic.__file__).resolve().parents[2]
KEPT = sorted((TREE / "studies/results").rglob("*.json"))


def name_of(path):
    return str(path.relative_to(TREE / "studies/results").with_suffix(""))


class Statistics(unittest.TestCase):
    def test_quantiles(self):
        """Against the tables of Student's distribution."""
        for freedom, value in ((1, 12.7062047362), (2, 4.3026527297), (3, 3.1824463053), (7, 2.3646242516), (30, 2.0422724563)):
            self.assertAlmostEqual(student_quantile(0.975, freedom), value, places=9)
            self.assertAlmostEqual(student_quantile(0.025, freedom), -value, places=9)

    def test_ratio_seed_by_seed(self):
        found = compare_values([2, 8], [1, 2], [2, 1], [2, 1])  # ratios 2 / 1 and 8 / 2
        half = 12.7062047362 * math.log(2) / 2  # of the logarithms: a standard deviation of ln 2 / sqrt 2, over sqrt 2
        self.assertTrue(found.ratio and found.paired)
        for value, logarithm in ((found.middle, 1.5 * math.log(2)), (found.low, 1.5 * math.log(2) - half), (found.high, 1.5 * math.log(2) + half)):
            self.assertAlmostEqual(math.log(value), logarithm, places=9)

    def test_what_is_independent(self):
        """Welch: variances of the means 1 and 3, with 1 and 2 degrees of freedom, make (1 + 3)^2 / (1 / 1 + 9 / 2) = 2.9, of which 2 whole ones."""
        found = compare_values([10 - 1, 10 + 1], [1, 2], [-3, 0, 3], [3, 4, 5])
        self.assertFalse(found.ratio or found.paired)
        self.assertEqual(found.middle, 10)
        self.assertAlmostEqual(found.high - found.middle, 4.3026527297 * 2, places=8)
        self.assertAlmostEqual(found.middle - found.low, 4.3026527297 * 2, places=8)

    def test_one_seed_has_no_interval(self):
        self.assertEqual(compare_values([4], [1], [2], [1]).middle, 2)
        self.assertTrue(math.isnan(compare_values([4], [1], [2], [1]).low))
        self.assertTrue(math.isnan(estimate([4])[1]))

    def test_agrees_with_the_study_s_own_comparisons(self):
        """If this fails, a ratio of docs/results.md is another than that of a study's report."""
        count = 0
        for path in KEPT:
            cells = load(path).summary["cells"]
            for found in load(path).summary.get("comparisons", []):
                mine, other = (next(cell for cell in cells if all(cell[key] == side[key] for key in ("technique", "knobs")) and (cell["scene"], cell["frame"]) == (found["scene"], found["frame"]))
                               for side in (found, found["baseline"]))
                values = lambda cell, name: (cell["metrics"].get(name) or cell[name])["values"]  # noqa: E731
                for name, said in {**found["metrics"], "ms": found["ms"], "rays": found["rays"]}.items():
                    ours = compare_values(values(mine, name), mine["seeds"], values(other, name), other["seeds"])
                    self.assertEqual((ours.ratio, ours.paired), (said["ratio"], said["paired"]))
                    for key in ("middle", "low", "high"):
                        self.assertAlmostEqual(getattr(ours, key) / said[key], 1, delta=1e-4)
                    count += 1
        self.assertGreater(count, 50)


class Archive(unittest.TestCase):
    def setUp(self):
        """A tree with two studies of one name, and results of the one that lies deeper."""
        self.root = pathlib.Path(tempfile.mkdtemp())
        self.addCleanup(shutil.rmtree, self.root)
        (self.root / "studies/deep").mkdir(parents=True)
        (self.root / "studies/deep/synthetic.json").write_text('{"about": "a < b"}')
        (self.root / "studies/synthetic.json").write_text('{"about": "of another one of that name"}')
        self.folder = self.root / "error"
        synthetic.error_study(self.folder, ["error_vs_time", "stability"])
        self.summary = json.loads((self.folder / "summary.json").read_text())
        self.path = archive.keep(self.folder, self.root)
        self.kept = Study("deep/synthetic", self.path)

    def test_lies_where_its_study_does(self):
        self.assertEqual(self.path, self.root / "studies/results/deep/synthetic.json")
        self.assertEqual(archive.keep(self.folder, self.root), self.path, "again: what is kept is no study")

    def test_says_what_was_measured(self):
        """If this fails, the document is made of other numbers than the report."""
        whole, short = load(self.folder), self.kept.results
        self.assertEqual((short.scenes, short.labels, list(short.frames)), (whole.scenes, whole.labels, list(whole.frames)))
        for one, other in [(whole.ms, short.ms), (whole.rays, short.rays), (whole.pass_ms, short.pass_ms)] + [(whole.values[n], short.values[n]) for n in whole.values]:
            numpy.testing.assert_allclose(other, one, rtol=1e-5)
        cell = next(cell for cell in short.summary["cells"] if (cell["scene"], cell["technique"], cell["frame"]) == ("box", "reuse", 0))
        self.assertEqual(cell["ms"]["values"], [30, 31, 32, 33])
        self.assertEqual(cell["rays"]["values"], [1152] * 4)
        self.assertEqual(len(short.summary["comparisons"]), 6, "of the ablation alone: others follow from the values")
        self.assertLess(self.path.stat().st_size, (self.folder / "summary.json").stat().st_size / 2)

    def test_ensembles(self):
        synthetic.ensemble_study(self.root / "ensemble")
        kept = archive.keep(self.root / "ensemble", self.root)
        r, k = load(kept), Study("deep/synthetic", kept)
        self.assertEqual(list(r.verdict[0, :, 0]), ["unbiased", "biased"])
        self.assertEqual(r.difference[0, 1, 0], 0.04)
        self.assertEqual(r.summary["cells"][1]["runs"], 64)
        self.assertEqual(k.energy("same"), "+0.10 +- 0.40 %")
        self.assertEqual(k.energy("wrong"), "+4.00 +- 0.40 %, biased")
        self.assertEqual([k.convergence("same", what) for what in ("noise", "bias", "difference", "differenceOfNoise")], ["0.200", "0", "3.00 %", "2.80 %"])

    def test_compares_with_results(self):
        page = self.root / "compare.html"
        self.assertEqual(run(["--compare", str(self.path), str(self.folder), "--to", str(page), "--quiet"]), 0)
        self.assertIn("reuse", page.read_text())
        self.assertNotIn("same image", page.read_text(), "hashes are not kept")

    def test_digits(self):
        self.assertEqual(archive.rounded({"a": [0.123456789, 1234567.89, 2.0, 3, None, "1.23456789"]}), {"a": [0.123457, 1234570, 2, 3, None, "1.23456789"]})

    def test_refuses_what_is_no_result(self):
        for change, message in (({"missing": 3}, "3 runs are still missing"), ({"about": "of no study"}, '0 files synthetic.json below .* have the "about"')):
            (self.folder / "summary.json").write_text(json.dumps({**self.summary, **change}))
            with self.assertRaisesRegex(Missing, message):
                archive.keep(self.folder, self.root)

    def spanned(self, technique, scene):
        """What synthetic.py says of its relmse against path tracing, spp 1, in frame 0."""
        index = ["path tracing", "", "reuse", "slow & poor"].index(technique)
        ratio = numpy.divide(*(numpy.mean([synthetic.error_value("relmse", scene, i, 0, seed) for seed in synthetic.SEEDS]) for i in (index, 0)))
        return f"{ratio:.2f} ({ratio - 0.05:.2f} to {ratio + 0.05:.2f})"

    def test_figures(self):
        of = lambda index, frame, scene="box": numpy.array([synthetic.error_value("relmse", scene, index, frame, seed) for seed in synthetic.SEEDS])  # noqa: E731
        k = self.kept
        quotients = numpy.log(of(2, 0, "hall") / of(1, 0, "hall"))
        middle, half = quotients.mean(), synthetic.T_3 * quotients.std(ddof=1) / 2
        said = re.fullmatch(r"([\d.]+) \(([\d.]+) to ([\d.]+)\)", k.ratio("reuse", "path tracing, spp 4", "relmse", "hall"))
        for text, value in zip(said.groups(), numpy.exp([middle, middle - half, middle + half])):
            self.assertAlmostEqual(float(text), value, delta=0.005)
        self.assertEqual(k.ratio("reuse", "reuse", "relmse", "box"), "the same")
        self.assertEqual(k.ratio("reuse", "path tracing, spp 4", "rays", "box"), "the same")
        self.assertAlmostEqual(k.difference("reuse", "slow & poor", "ms", "box").middle, (30 * 31 * 32 * 33 / (40 * 41 * 42 * 43)) ** 0.25)
        mean, half = of(3, 1).mean(), synthetic.T_3 * of(3, 1).std(ddof=1) / 2
        self.assertEqual(k.error("slow & poor", "relmse", "box", 1), f"{mean:.3f} +- {half:.3f}")
        self.assertEqual(k.cost("reuse", "ms"), "31.5")
        self.assertEqual(k.cost("reuse", "rays", ["trace"]), "9.00")
        self.assertEqual(k.cost("reuse", "ms", rest=["trace"]), "1.50")
        self.assertEqual(k.cost_ratio("reuse", "path tracing, spp 1", "ms", ["trace"]), "3.00")
        with self.assertRaisesRegex(Missing, "doesn't count steps; it counts nothing"):
            k.count("reuse", "steps", "box")
        self.assertEqual(k.parts, ["spatial and temporal.cap"])
        self.assertEqual([k.ablation("spatial and temporal.cap", what, "hall") for what in ("ms", "relmse")], ["4.00 (3.95 to 4.05)", self.spanned("slow & poor", "hall")])
        self.assertIn("24 x 16 pixels, 4 seeds, 3 frames before the first that counts, references of 64 samples a pixel", k.conditions)

    def test_at_equal_cost(self):
        """The curve's error is 3 / cost, exactly, and differs from seed to seed by a factor that stays."""
        rows = []
        for cell in self.summary["cells"]:
            cost = {"path tracing": lambda knobs: 4.0 * knobs["trace.spp"], "reuse": lambda _: 6.0, "slow & poor": lambda _: 9.0}[cell["technique"]](cell["knobs"])
            for seed, run, factor in zip(cell["seeds"], cell["runs"], (1, 2, 1, 2)):
                rows.append({"run": run, "frame": cell["frame"], "seed": seed, "ms": cost, "passes": {}})
                cell["metrics"]["relmse"]["values"][seed - 11] = factor * (3 / cost if cell["technique"] == "path tracing" else 0.1)
        synthetic.write(self.folder, self.summary, rows)
        kept = Study("equal", archive.keep(self.folder, self.root))
        self.assertEqual(kept.at_equal("ms", "reuse", "path tracing", "relmse", "box"), "0.200")
        self.assertEqual(kept.at_equal("ms", "slow & poor", "path tracing", "relmse", "box"), "0.300")

    def test_names_that_nothing_has(self):
        for ask, message in ((lambda k: k.error("re-use", "relmse", "box"), "has no technique re-use; it has path tracing, spp 1, "), (lambda k: k.error("reuse", "relmse"), "several scenes, and none is named"),
                             (lambda k: k.ratio("reuse", "reuse", "flip", "box"), "has no metric flip; it has relmse, bias and tflip"), (lambda k: k.error("reuse", "relmse", "box", 7), "has no frame 7"),
                             (lambda k: k.cost("reuse", "ms", ["spatial"]), "has no pass spatial; it has trace and display")):
            with self.assertRaisesRegex(Missing, message):
                ask(self.kept)


class Document(unittest.TestCase):
    def test_is_what_the_template_gives(self):
        """If this fails: scripts/results writes docs/results.md anew."""
        self.assertEqual((TREE / "docs/results.md").read_text(), render(TREE))

    def test_is_of_the_tree_s_studies(self):
        for path in KEPT:
            kept, study = load(path).summary, json.loads((TREE / f"studies/{name_of(path)}.json").read_text())
            self.assertEqual(kept["about"], study["about"], path)
            self.assertEqual([scene["file"] for scene in kept["scenes"]], [pathlib.Path(scene).stem for scene in study["scenes"]], path)
            self.assertLessEqual(set(study["techniques"]), {technique["name"] for technique in kept["techniques"]}, path)

    def test_every_section_is_ready(self):
        """If this fails, the day that a study is kept is the day that the document breaks."""
        root = pathlib.Path(tempfile.mkdtemp())
        self.addCleanup(shutil.rmtree, root)
        (root / "docs").mkdir()
        shutil.copy(TREE / "docs/results.md.in", root / "docs")
        shutil.copytree(TREE / "studies", root / "studies", ignore=shutil.ignore_patterns("results"))
        empty = render(root)
        asked = sorted(set(re.findall(r'study\("([^"]+)"\)', (TREE / "docs/results.md.in").read_text())))
        self.assertGreater(len(asked), 5)
        paths = {name: root / f"studies/results/{name}.json" for name in asked}
        kept = {name: json.dumps(synthetic.kept_study(TREE, name)) for name in asked}
        for name, path in paths.items():
            self.assertNotIn(f"Study `studies/{name}.json`", empty)
            path.parent.mkdir(parents=True, exist_ok=True)
            path.write_text(kept[name])
            self.assertIn(f"Study `studies/{name}.json`", render(root))
            path.unlink()
        for name, path in paths.items():
            path.write_text(kept[name])
        for heading, after in re.findall(r"^(#+ .+)\n+(#+ )", empty, re.M):
            self.assertTrue(heading.startswith("# "), f"{heading}: a section without its archive leaves nothing")
        self.assertIsNone(re.search(r"\bnan\b|\n\n\n", render(root)), "a hole")

    def test_command(self):
        """If this fails, who forgets to end a study is not told."""
        folder = pathlib.Path(tempfile.mkdtemp())
        self.addCleanup(shutil.rmtree, folder)
        before = (TREE / "docs/results.md").read_text()
        output = subprocess.run([sys.executable, str(TREE / "scripts/results"), "--keep", str(folder)], capture_output=True, text=True)
        self.assertEqual(output.returncode, 1)
        self.assertRegex(output.stderr, r"^results: .*summary.json is not there; lodestir study STUDY")
        self.assertEqual((TREE / "docs/results.md").read_text(), before)


if __name__ == "__main__":
    unittest.main()
