# SPDX-License-Identifier: MIT
"""docs/results.md, made of docs/results.md.in and the archives of studies: what the template asks of them."""
import math
import pathlib
from typing import NamedTuple

import jinja2
import numpy

from .error_charts import decompositions_of
from .frontier import undominated
from .results import Missing, load
from .statistics import Difference, compare_values, estimate
from .words import listed


def decimals_of(value, digits):
    """So many that `value` has `digits` significant ones."""
    return max(0, digits - 1 - math.floor(math.log10(abs(value)))) if value and math.isfinite(value) else 0


def plain(value, digits=3):
    return f"{value:.{decimals_of(value, digits)}f}"


def with_interval(mean, half_width, unit="", sign=""):
    """The half-width to two digits, the mean to as many decimals."""
    if not math.isfinite(half_width):
        return plain(mean) + unit
    decimals = decimals_of(half_width, 2) if half_width else decimals_of(mean, 3)
    return f"{mean:{sign}.{decimals}f} +- {half_width:.{decimals}f}{unit}"


def of_difference(difference):
    if not difference.ratio:
        return f"by {with_interval(difference.middle, difference.middle - difference.low, sign='+')}"
    if difference.high - difference.low < 1e-5 and abs(difference.middle - 1) < 1e-5:
        return "the same"
    decimals = decimals_of(difference.middle, 3)
    middle, low, high = (f"{value:.{decimals}f}" for value in (difference.middle, difference.low, difference.high))
    return middle if low in (high, "nan") else f"{middle} ({low} to {high})"


class Measured(NamedTuple):
    """A technique in one scene: what it costs and its error."""
    label: str
    x: float
    y: float


class Study:
    """Gives figures as text. Techniques are named with their knobs, as in reports ("ReSTIR PT, neighbours 3"); a scene has to be named where there are
    several; frames are counted from the event."""

    def __init__(self, name, path):
        self.name, self.results = name, load(path)
        self.scenes, self.labels = self.results.scenes, self.results.labels

    def labels_of(self, scene):
        """Those that were measured there, as the study orders techniques: what it solves for has values of its own in each scene."""
        r = self.results
        order = [technique["name"] for technique in r.summary["techniques"]]
        there = [c for c in range(len(r.labels)) if any(r.cell(r.scene(scene), c, f) for f in range(len(r.frames)))]
        return [r.labels[c] for c in sorted(there, key=lambda c: order.index(r.configurations[c].technique))]

    def _at(self, technique, scene=None, frame=0):
        r = self.results
        if scene is None and len(r.scenes) > 1:
            raise Missing(f"{self.name} has several scenes, and none is named: {listed(r.scenes)}")
        for what, name, names in (("scene", scene or r.scenes[0], r.scenes), ("technique", technique, r.labels), ("frame", frame, list(r.frames))):
            if name not in names:
                raise Missing(f"{self.name} has no {what} {name}; it has {listed(map(str, names))}")
        return r.scene(scene or r.scenes[0]), r.configuration(technique), r.frame(frame)

    def _cell(self, *at):
        cell = self.results.cell(*self._at(*at))
        if cell is None:
            raise Missing(f"{self.name} has not measured {listed(map(str, at))}")
        return cell

    def _values(self, metric, *at):
        """Seed by seed: of a metric, of "ms", or of "rays"."""
        cell = self._cell(*at)
        if metric in ("ms", "rays"):
            return cell[metric]["values"]
        if metric not in cell["metrics"]:
            raise Missing(f"{self.name} has no metric {metric}; it has {listed(cell['metrics'])}")
        return cell["metrics"][metric]["values"]

    # Errors and costs.
    def error(self, technique, metric, scene=None, frame=0):
        found = self._cell(technique, scene, frame)["metrics"][metric]
        return with_interval(found["mean"], math.nan if found["halfWidth"] is None else found["halfWidth"])

    def part(self, part, technique, metric, scene=None, frame=0):
        """"squaredBias" or "variance" of a run, of a study that decomposes."""
        self._cell(technique, scene, frame)
        r = self.results
        found = decompositions_of(r, r.scene(scene or r.scenes[0]), r.frame(frame), {"name": metric}).get(r.configurations[r.configuration(technique)])
        if found is None:
            raise Missing(f"{self.name} has no squared bias and variance of {metric} of {technique}")
        return with_interval(*found[part])

    def mean(self, technique, metric, scene=None, passes=None, frames=None):
        """Over the measured frames that have it, or some of them: of an error, or the "ms" of some passes."""
        frames = list(self.results.frames if frames is None else frames)
        if metric == "ms":
            return plain(numpy.mean([self._cost_in(scene or self.scenes[0], technique, "ms", passes, (), frame) for frame in frames]))
        found = [self._cell(technique, scene, frame)["metrics"] for frame in frames]
        return plain(numpy.mean([metrics[metric]["mean"] for metrics in found if metric in metrics]), 2)

    def difference(self, technique, against, metric, scene=None, frame=0):
        places = (technique, scene, frame), (against, scene, frame)
        sides = [part for place in places for part in (self._values(metric, *place), self._cell(*place)["seeds"])]
        return compare_values(*sides)

    def ratio(self, technique, against, metric, scene=None, frame=0):
        """Of two techniques' errors, "ms" or "rays" in one frame: the geometric mean over seeds, and its 95 % interval."""
        return of_difference(self.difference(technique, against, metric, scene, frame))

    def at_equal(self, cost, technique, curve, metric, scene=None, frame=0):
        """Ratio of a technique's error to that of `curve` at the same "ms" or "rays": by the straight line in logarithms through the curve's points, seed
        by seed."""
        points = [label for label, found in zip(self.labels, self.results.configurations) if found.curve == curve]
        costs = numpy.log([numpy.median(self._values(cost, label, scene, frame)) for label in points])
        errors = numpy.log([self._values(metric, label, scene, frame) for label in points])
        slopes, offsets = numpy.polyfit(costs, errors, 1)
        here = math.log(numpy.median(self._values(cost, technique, scene, frame)))
        middle, half = estimate(numpy.log(self._values(metric, technique, scene, frame)) - (offsets + slopes * here))
        return of_difference(Difference(True, True, *(math.exp(end) for end in (middle, middle - half, middle + half))))

    def cost(self, technique, unit, passes=None, rest=(), scenes=None, frame=0):
        """"ms" or "rays" a pixel of a frame, the mean over scenes: of all passes, of some, or of all but `rest`."""
        return plain(self._cost(technique, unit, passes, rest, scenes, frame))

    def cost_ratio(self, technique, against, unit, passes=None, scenes=None, frame=0):
        return plain(self._cost(technique, unit, passes, (), scenes, frame) / self._cost(against, unit, passes, (), scenes, frame))

    def count(self, technique, name, scene=None, frame=0, per=1):
        """What the study counts beside times and rays, "steps" a pixel for one, in units of `per`: mean over seeds."""
        return plain(self._count(technique, name, scene, frame) / per)

    def count_ratio(self, technique, against, name, scene=None, frame=0, digits=3):
        return plain(self._count(technique, name, scene, frame) / self._count(against, name, scene, frame), digits)

    def _count(self, technique, name, scene, frame):
        if name not in self.results.counts:
            raise Missing(f"{self.name} doesn't count {name}; it counts {listed(self.results.counts) or 'nothing'}")
        return float(self.results.counts[name][self._at(technique, scene, frame)])

    def _cost(self, technique, unit, passes, rest, scenes, frame):
        return float(numpy.mean([self._cost_in(scene, technique, unit, passes, rest, frame) for scene in scenes or self.scenes]))

    def _cost_in(self, scene, technique, unit, passes, rest, frame):
        r, at = self.results, self._at(technique, scene, frame)
        unknown = {*(passes or ()), *rest} - set(r.passes)
        if unknown:
            raise Missing(f"{self.name} has no pass {listed(sorted(unknown))}; it has {listed(r.passes)}")
        if passes is None and not rest:
            return (r.ms if unit == "ms" else r.rays)[at]
        by_pass = r.pass_ms[at] if unit == "ms" else r.pass_rays[at].sum(axis=-1)
        return float(sum(value for name, value in zip(r.passes, by_pass) if math.isfinite(value) and (name in passes if passes else name not in rest)))

    def undominated(self, metric, unit, scene, frame=0):
        """Techniques than which no other is better both in "ms" or "rays" and in error, by rising cost."""
        cost, error = self.results.ms if unit == "ms" else self.results.rays, self.results.error[metric]
        at = ((label, self._at(label, scene, frame)) for label in self.labels_of(scene))
        return [p.label for p in undominated(Measured(label, float(cost[place]), float(error[place])) for label, place in at)]

    # Ablations: the whole without a part, as the study compared it with the whole.
    @property
    def parts(self):
        return list(dict.fromkeys(listed(found["without"]) for found in self.results.summary["comparisons"]))

    def ablation(self, part, metric, scene=None, frame=0):
        for found in self.results.summary["comparisons"]:
            if (listed(found["without"]), found["scene"], found["frame"]) == (part, scene or self.scenes[0], frame):
                return of_difference(Difference(**(found["metrics"].get(metric) or found[metric])))
        raise Missing(f"{self.name} has no ablation of {part} in {scene}; it has those of {listed(self.parts)}")

    # Ensembles.
    def energy(self, technique, scene=None, frame=0):
        """Against the reference's, with its half-width in percent; the verdict, where it isn't "unbiased"."""
        cell = self._cell(technique, scene, frame)
        luminance = cell["energy"]["luminance"]
        text = with_interval(100 * luminance["difference"], 100 * luminance["halfWidth"], " %", "+")
        return text if cell["verdict"] == "unbiased" else f"{text}, {cell['verdict']}"

    def convergence(self, technique, what, scene=None, frame=0):
        """Of an ensemble: "noise" of a run, "bias" with two standard deviations, "difference" of the mean over runs and "differenceOfNoise", in percent."""
        found = self._cell(technique, scene, frame)["convergence"]
        if what == "bias":
            return with_interval(found["bias"], 2 * found["biasDeviation"] if found["biasDeviation"] is not None else math.nan)
        return plain(found[what]) if what == "noise" else plain(100 * found[what]) + " %"

    # What all of it was measured under.
    @property
    def conditions(self):
        s = self.results.summary
        sizes = listed(dict.fromkeys("{} x {}".format(*scene["size"]) for scene in s["scenes"]))
        count = f"{s['seeds']} {'seed' if self.results.kind == 'error' else 'run'}{'' if s['seeds'] == 1 else 's'}"
        references = f"of {s['referenceSamples']} samples a pixel" if s["referenceSamples"] else "without noise"
        return (f"{sizes} pixels, {count}, {s['warmup']} frames before the first that counts, references {references}; "
                f"{listed(s['devices'])} on {s['machine']}, {s['date'][:10]}, revision {s['revision']}")


class Archives:
    """Those below `root`/studies/results."""

    def __init__(self, root):
        self.root = pathlib.Path(root)

    def study(self, name):
        """None where none has been kept."""
        if not (self.root / "studies" / f"{name}.json").exists():
            raise Missing(f"there is no study studies/{name}.json")
        path = self.root / "studies/results" / f"{name}.json"
        return Study(name, path) if path.exists() else None


def render(root):
    """The text of docs/results.md."""
    environment = jinja2.Environment(loader=jinja2.FileSystemLoader(pathlib.Path(root) / "docs"), trim_blocks=True, lstrip_blocks=True,
                                     keep_trailing_newline=True, undefined=jinja2.StrictUndefined)
    return environment.get_template("results.md.in").render(study=Archives(root).study)
