# SPDX-License-Identifier: MIT
"""What a study has found, as numpy arrays. docs/studies.md lists their shapes and units."""
import json
import pathlib
from dataclasses import dataclass

import numpy

from . import exr


class Missing(Exception):
    """There is nothing to report on, or nothing that can be read."""


class Members(dict):
    """An object of a JSON file, of which a missing member is told in one sentence, wherever it is asked for."""

    def __init__(self, path, members):
        super().__init__(members)
        self.path = path

    def __missing__(self, name):
        raise Missing(f"{self.path} lacks \"{name}\" and was written by another version; draw it with the scripts/report of that one, or have "
                      "lodestir study STUDY --out OUT --resume write it again")


def parse(path, text):
    """JSON that a study wrote into a file."""
    try:
        return json.loads(text, object_hook=lambda members: Members(path, members))
    except ValueError as error:
        raise Missing(f"{path} is no JSON: {error}") from None


# What summaries of errors didn't always have, and what stands for it.
STEPS = "steps"  # the count of nodes that rays visit, a pixel (framework/study/study_file.h, stepsName)
LATER = {"counts": [], "comparisons": [], "exponents": [], "decompositions": [], "sequences": [], "outcomes": None}


def read_summary(path):
    summary = parse(path, path.read_text())
    if not isinstance(summary, dict) or summary.get("format") != 1:
        raise Missing(f"{path} has a format that this report does not know; draw it with the scripts/report of the Lodestir that wrote it")
    if summary["kind"] == "error":
        for name, default in {**LATER, "baseline": summary["techniques"][0]["name"]}.items():
            summary.setdefault(name, default)
    return summary


@dataclass(frozen=True)
class Configuration:
    """A technique with a value of each of its knobs."""
    technique: str
    knobs: tuple  # of (name, value)

    def text(self, count):
        knobs = (f"{name.split('.', 1)[-1]} {value if isinstance(value, str) else json.dumps(value)}" for name, value in self.knobs[:count])
        return ", ".join([self.technique, *knobs])

    @property
    def label(self):
        return self.text(len(self.knobs))

    @property
    def curve(self):
        """What the points along its last knob share."""
        return self.text(max(len(self.knobs) - 1, 0))

    @property
    def point(self):
        """Its place on the curve."""
        return self.label[len(self.curve) + 2:]


def configuration_of(cell):
    return Configuration(cell["technique"], tuple((name, value if not isinstance(value, list) else tuple(value)) for name, value in cell["knobs"].items()))


def real(value):
    """JSON has no NaN: it is written as null."""
    return numpy.nan if value is None else value


class Results:
    """Axes of arrays are scene, configuration, frame, then what a name adds; NaN where nothing was measured."""

    def __init__(self, folder, only=()):
        self.folder = pathlib.Path(folder)
        path = self.folder if self.folder.suffix == ".json" else self.folder / "summary.json"
        if not path.exists():
            raise Missing(f"{path} is not there; lodestir study STUDY --out {folder} --resume writes it")
        self.summary = read_summary(path)
        self.kind = self.summary["kind"]
        self.name = self.summary["study"]
        self.scenes = [scene["name"] for scene in self.summary["scenes"]]
        self.pixels = numpy.array([scene["size"][0] * scene["size"][1] for scene in self.summary["scenes"]], float)
        self.frames = numpy.array(self.summary["frames"], int)
        self.metrics = self.summary["metrics"]
        every = list(dict.fromkeys(configuration_of(cell) for cell in self.summary["cells"]))
        # Places in the study of each curve and, on it, of each configuration: colours stay the same in every chart, whatever is left out.
        curves = list(dict.fromkeys(configuration.curve for configuration in every))
        self.place = {}
        for configuration in every:
            on_curve = [other for other in every if other.curve == configuration.curve]
            self.place[configuration.label] = curves.index(configuration.curve), on_curve.index(configuration)
        unknown = set(only) - {technique["name"] for technique in self.summary["techniques"]}
        if unknown:
            names = ", ".join(technique["name"] for technique in self.summary["techniques"])
            raise Missing(f"{path} has no technique {', '.join(sorted(unknown))}; it has {names}")
        self.configurations = [configuration for configuration in every if not only or configuration.technique in only]
        self._cells = {}
        for cell in self.summary["cells"]:
            self._cells[cell["scene"], configuration_of(cell), cell["frame"]] = cell
        if self.kind == "error":
            self._fill()
        else:
            self._fill_ensemble()

    # Indices by name.
    def scene(self, name):
        return self.scenes.index(name)

    def configuration(self, label):
        return self.labels.index(label)

    def frame(self, offset):
        return int(numpy.flatnonzero(self.frames == offset)[0])

    def cell(self, scene, configuration, frame):
        """The member of summary.json's "cells" at these indices; None where nothing was measured."""
        cell = self._cells.get((self.scenes[scene], self.configurations[configuration], int(self.frames[frame])))
        return cell if cell and ("ms" in cell) else None

    def measured(self):
        """(scene, configuration, frame, cell) of all that was."""
        for scene, configuration, frame in numpy.ndindex(self.shape):
            cell = self.cell(scene, configuration, frame)
            if cell:
                yield scene, configuration, frame, cell

    @property
    def labels(self):
        return [configuration.label for configuration in self.configurations]

    @property
    def shape(self):
        return len(self.scenes), len(self.configurations), len(self.frames)

    def rows(self):
        """Lines of results*.jsonl as they are, those of other versions of the study left out."""
        runs = {run for cell in self.summary["cells"] for run in cell.get("runs", cell.get("chunks", []))}
        found = []
        for path in sorted(self.folder.glob("results*.jsonl")):
            for line in path.read_text().splitlines(keepends=True):
                if line.endswith("\n"):  # else it was cut
                    row = parse(path, line)
                    if row["run"] in runs:
                        found.append(row)
        return found

    # Images.
    def image(self, scene, configuration):
        """(height, width, 3) linear radiance of the first seed's last measured frame, of an ensemble the mean over runs; None where none was kept."""
        cell = self.cell(scene, configuration, len(self.frames) - 1)
        return self._image(cell and cell.get("image"))

    def reference(self, scene):
        return self._image(self.summary["scenes"][scene].get("reference"))

    def _image(self, name):
        path = self.folder / name if name else None
        return exr.read(path) if path and path.exists() else None

    def exposure(self, scene):
        """Factor that errors of a scene were measured at: it brings the reference's median luminance to 0.18."""
        for place, _, _, cell in self.measured():
            if place == scene and "exposure" in cell:
                return cell["exposure"]
        image = self.reference(scene)
        luminance = numpy.zeros(0) if image is None else image @ numpy.array([0.2126, 0.7152, 0.0722])
        luminance = luminance[luminance > 0]
        return 0.18 / float(numpy.median(luminance)) if luminance.size else 1.0

    # Arrays.
    def _empty(self, *more):
        return numpy.full((*self.shape, *more), numpy.nan)

    def _fill(self):
        cells = list(self.measured())
        names = [metric["name"] for metric in self.metrics]
        seeds = max((len(cell["seeds"]) for *_, cell in cells), default=0)
        self.passes = list(dict.fromkeys(name for *_, cell in cells for name in cell["passes"]))
        self.purposes = list(dict.fromkeys(purpose for *_, cell in cells for cost in cell["passes"].values() for purpose in cost["rays"]))
        self.ms, self.ms_range = self._empty(), self._empty(2)
        self.rays, self.rays_half_width = self._empty(), self._empty()
        self.pass_ms, self.pass_rays = self._empty(len(self.passes)), self._empty(len(self.passes), len(self.purposes))
        self.seeds = self._empty(seeds)
        self.counts = {name: self._empty() for name in self.summary["counts"]}
        self.error, self.half_width = {name: self._empty() for name in names}, {name: self._empty() for name in names}
        self.values = {name: self._empty(seeds) for name in names}
        self.comparison = {name: self._empty(3) for name in [*names, "ms", "rays"]}
        self.compared = {}  # by place: the whole member of "comparisons"
        for found in self.summary["comparisons"]:
            if configuration_of(found) not in self.configurations:
                continue
            at = self.scene(found["scene"]), self.configurations.index(configuration_of(found)), self.frame(found["frame"])
            self.compared[at] = found
            for name, difference in [*found["metrics"].items(), ("ms", found["ms"]), ("rays", found["rays"])]:
                if difference["ratio"]:
                    self.comparison[name][at] = [real(difference[key]) for key in ("middle", "low", "high")]
        self.sequence = {name: numpy.full((*self.shape[:2], 2), numpy.nan) for name in names}
        for cell in self.summary["sequences"]:
            if configuration_of(cell) in self.configurations:
                for name, found in cell["metrics"].items():
                    at = self.scene(cell["scene"]), self.configurations.index(configuration_of(cell))
                    self.sequence[name][at] = real(found["mean"]), real(found["halfWidth"])
        for *at, cell in cells:
            at, pixels = tuple(at), self.pixels[at[0]]
            self.ms[at] = real(cell["ms"]["median"])
            self.ms_range[at] = real(cell["ms"]["fastest"]), real(cell["ms"]["slowest"])
            self.rays[at] = real(cell["rays"]["mean"]) / pixels
            self.rays_half_width[at] = real(cell["rays"]["halfWidth"]) / pixels
            self.seeds[at][:len(cell["seeds"])] = cell["seeds"]
            for name, found in cell.get("counts", {}).items():
                self.counts[name][at] = real(found["mean"])
            for name, cost in cell["passes"].items():
                place = self.passes.index(name)
                self.pass_ms[at][place] = real(cost["ms"])
                self.pass_rays[at][place] = 0
                for purpose, rays in cost["rays"].items():
                    self.pass_rays[at][place, self.purposes.index(purpose)] = rays / pixels
            for name, found in cell["metrics"].items():
                self.error[name][at] = real(found["mean"])
                self.half_width[name][at] = real(found["halfWidth"])
                self.values[name][at][:len(found["values"])] = [real(value) for value in found["values"]]

    def _fill_ensemble(self):
        self.ms, self.rays = self._empty(), self._empty()
        self.difference, self.half_width = self._empty(), self._empty()
        self.energy_p, self.block_p = self._empty(), self._empty()
        self.verdict = numpy.full(self.shape, "", object)
        for *at, cell in self.measured():
            at = tuple(at)
            luminance = cell["energy"]["luminance"]
            self.ms[at], self.rays[at] = real(cell["ms"]), real(cell["rays"]) / self.pixels[at[0]]
            self.difference[at], self.half_width[at] = real(luminance["difference"]), real(luminance["halfWidth"])
            self.energy_p[at], self.block_p[at] = real(cell["energyP"]), real(cell["blockP"])
            self.verdict[at] = cell["verdict"]


def load(folder, only=()):
    """Results of a folder that `lodestir study` wrote, or of the file that scripts/results made of one; `only`: of these techniques."""
    return Results(folder, only)
