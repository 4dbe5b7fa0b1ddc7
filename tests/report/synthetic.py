# SPDX-License-Identifier: MIT
"""Folders of results as `lodestir study` writes them, with numbers that tests know."""
import itertools
import json
import math
import pathlib
import struct
import sys
import zlib

import numpy

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[2] / "scripts"))
sys.dont_write_bytecode = True

T_3 = 3.182446305284263  # of Student's distribution, 97.5 %, 3 degrees of freedom: four seeds
SEEDS = [11, 12, 13, 14]


def estimate(values):
    values = numpy.asarray(values, float)
    return {"mean": values.mean(), "halfWidth": T_3 * values.std(ddof=1) / math.sqrt(len(values))}


def write_exr(path, image, compression=3, kind=numpy.float16):
    """Channels B, G, R; by the layout of scan-line files. Compression 0: none, 3: ZIP."""
    height, width, _ = image.shape
    text = lambda name: name.encode() + b"\0"  # noqa: E731
    attribute = lambda name, type_, data: text(name) + text(type_) + struct.pack("<i", len(data)) + data  # noqa: E731
    channels = b"".join(text(c) + struct.pack("<iBBBBii", 1 if kind == numpy.float16 else 2, 0, 0, 0, 0, 1, 1) for c in "BGR") + b"\0"
    box = struct.pack("<4i", 0, 0, width - 1, height - 1)
    header = struct.pack("<ii", 20000630, 2) + attribute("channels", "chlist", channels) + attribute("compression", "compression", bytes([compression]))
    header += attribute("dataWindow", "box2i", box) + attribute("displayWindow", "box2i", box) + b"\0"
    lines, blocks = 16 if compression == 3 else 1, []
    for first in range(0, height, lines):
        raw = b"".join(image[y, :, c].astype(kind).tobytes() for y in range(first, min(first + lines, height)) for c in (2, 1, 0))
        if compression == 3:
            data = numpy.frombuffer(raw, numpy.uint8)
            data = numpy.concatenate([data[0::2], data[1::2]]).astype(int)
            packed = zlib.compress(numpy.concatenate([data[:1], (data[1:] - data[:-1] + 128) % 256]).astype(numpy.uint8).tobytes())
            raw = packed if len(packed) < len(raw) else raw
        blocks.append(struct.pack("<ii", first, len(raw)) + raw)
    at = len(header) + 8 * len(blocks)
    offsets = b""
    for block in blocks:
        offsets += struct.pack("<Q", at)
        at += len(block)
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_bytes(header + offsets + b"".join(blocks))


def metric(name, **more):
    return {"name": name, "metric": name.split(".")[0], "unit": "", "fromZero": True, "about": f"what {name} is", "noiseFree": name == "relmse", "temporal": False,
            "mask": "", "finest": False, **more}


def head(kind, scenes, techniques, frames, metrics=(), charts=(), size=(24, 16)):
    return {"format": 1, "kind": kind, "study": "synthetic", "about": "a < b", "lodestir": "0.1.0", "revision": "abc", "date": "2026-01-02T03:04:05Z", "machine": "a machine",
            "devices": ["llvmpipe (LLVM 15), packet"], "scenes": [{"name": name, "file": name, "size": list(size), "reference": f"images/{name}.reference.exr"} for name in scenes],
            "seeds": 4, "paired": True, "warmup": 3, "event": 3, "frames": list(frames), "referenceSamples": 64,
            "techniques": [{"name": name, "graph": "g.json", "variant": None, "set": {}, "knobs": knobs, "control": False, "planted": False} for name, knobs in techniques],
            "metrics": list(metrics), "charts": list(charts), "missing": 0, "foreign": 0}


CONFIGURATIONS = [("path tracing", {"trace.spp": 1}), ("path tracing", {"trace.spp": 4}), ("reuse", {}), ("slow & poor", {})]
FRAMES = [-1, 0, 1]


def error_value(name, scene, index, frame, seed):
    """Of one row: distinct, positive."""
    level = [0.4, 0.1, 0.05, 0.6][index] * (1.5 if scene == "hall" else 1) * (2 if frame == 0 and index == 2 else 1)
    return level * (1 + 0.05 * ((7 * seed + 3 * frame + index) % 5)) * (0.1 if name == "tflip" else 1)


def image_of(scene, index):
    """Radiance with a ramp, a light above 1, and for a technique an error that is known."""
    y, x = numpy.mgrid[0:16, 0:24]
    image = numpy.stack([x / 24, y / 16, numpy.full(x.shape, 0.25)], axis=-1) * (1 if scene == "box" else 0.5)
    image[3, 5] = 40
    return image if index is None else image * (1 + 0.5 * (index + 1))


def error_study(folder, charts):
    scenes = ["box", "hall"]
    metrics = [metric("relmse"), metric("bias", fromZero=False), metric("tflip", temporal=True)]
    summary = head("error", scenes, [("path tracing", ["trace.spp"]), ("reuse", []), ("slow & poor", [])], FRAMES, metrics, charts)
    rows, cells, sequences, comparisons = [], [], [], []
    for scene in scenes:
        write_exr(folder / f"images/{scene}.reference.exr", image_of(scene, None))
        values = {(i, m["name"], f): [error_value(m["name"], scene, i, f, s) - (0.3 if m["name"] == "bias" else 0) for s in SEEDS]
                  for i in range(len(CONFIGURATIONS)) for m in metrics for f in FRAMES if not (m["temporal"] and f == -1)}
        for i, (technique, knobs) in enumerate(CONFIGURATIONS):
            for f in FRAMES:
                names = [m["name"] for m in metrics if (i, m["name"], f) in values]
                times = [10.0 * (i + 1) + s for s in range(len(SEEDS))]
                ratio = lambda n, base: {"mean": numpy.mean(values[i, n, f]) / numpy.mean(base), "halfWidth": 0.125}  # noqa: B023,E731
                found = {n: {**estimate(values[i, n, f]), "values": values[i, n, f], "againstStart": ratio(n, values[i, n, 0 if n == "tflip" else -1])} for n in names}
                if i > 0:
                    span = lambda value: {"ratio": bool(value > 0), "paired": True, "middle": value, "low": value - 0.05, "high": value + 0.05}  # noqa: E731
                    comparisons.append({"scene": scene, "technique": technique, "knobs": knobs, "frame": f, "baseline": {"technique": "path tracing", "knobs": {"trace.spp": 1}},
                                        "without": ["spatial", "temporal.cap"] if i == 3 else None, "ms": span(i + 1.0), "rays": span(i + 1.0),
                                        "metrics": {n: span(ratio(n, values[0, n, f])["mean"]) for n in names}})
                cell = {"scene": scene, "technique": technique, "knobs": knobs, "frame": f, "seeds": SEEDS, "runs": [f"{scene} {i} {s}" for s in SEEDS],
                        "ms": {"median": float(numpy.median(times)), "fastest": times[0], "slowest": times[-1]}, "rays": {"mean": 24 * 16 * 3.0 * (i + 1), "halfWidth": 0.0},
                        "passes": {"trace": {"ms": 8.0 * (i + 1), "rays": {"primary": 384.0 * (i + 1), "nee": 768.0 * (i + 1)}}, "display": {"ms": 1.5, "rays": {"primary": 0.0}}},
                        "metrics": found, "referenceNoise": {"relmse": 0.001}, "exposure": 2.0}
                if technique == "reuse":
                    cell["budget"] = {"given": 30.0, "reached": 31.0, "inRange": scene == "box"}
                if f == FRAMES[-1]:
                    cell["image"] = f"images/{scene}.{i}.exr"
                    write_exr(folder / cell["image"], image_of(scene, i))
                cells.append(cell)
                for k, s in enumerate(SEEDS):
                    rows.append({"scene": scene, "technique": technique, "knobs": knobs, "seed": s, "frame": f, "ms": times[k],
                                 "passes": {"trace": {"ms": 8.0, "rays": {"primary": 384, "nee": 768}}}, "metrics": {n: values[i, n, f][k] for n in names}, "run": f"{scene} {i} {s}"})
            steps = {m["name"]: [f for f in FRAMES if (i, m["name"], f) in values] for m in metrics}
            sequences.append({"scene": scene, "technique": technique, "knobs": knobs,
                              "metrics": {n: estimate(numpy.mean([values[i, n, f] for f in frames], axis=0)) for n, frames in steps.items()}})
    rows.append({**rows[0], "run": "of another version", "metrics": {"relmse": 1e6}})
    here = {"scene": "box", "technique": "path tracing", "knobs": {"trace.spp": 1}, "frame": 0, "metric": "relmse"}
    summary.update(cells=cells, sequences=sequences, comparisons=comparisons, baseline="path tracing", equal="ms",
                   outcomes={"columns": ["path tracing", "reuse", "slow & poor"],
                             "cases": [{"name": "steps aside", "scene": "box", "quantity": "spike", "measure": "relmse", "limits": [1.2, 2], "cells": [
                                 None, {"outcome": "strained", "certain": True, "text": "1.3 +- 0.1"}, {"outcome": "fails", "certain": False, "text": "unsettled"}]}]},
                   exponents=[{**here, "over": "trace.spp", "exponent": {"mean": -0.98, "halfWidth": 0.03}}],
                   decompositions=[{**here, "squaredBias": {"mean": -0.001, "halfWidth": 0.004}, "variance": {"mean": 0.4, "halfWidth": 0.05}},
                                   {**here, "technique": "reuse", "knobs": {}, "squaredBias": {"mean": 0.03, "halfWidth": 0.004}, "variance": {"mean": 0.07, "halfWidth": 0.01}}])
    write(folder, summary, rows)
    return rows


NEEDS = {0: (1000, 100.0, 0.0), 1: (100, 80.0, 0.01), 2: (10, 60.0, 0.2)}  # of a level: triangles, steps of a sample, what it adds to an error of 1 / samples


def counted_cell(scene, technique, knobs, triangles, steps, error):
    values = [error * (1 + 0.01 * s) for s in (-1, 1, -1, 1)]
    return {"scene": scene, "technique": technique, "knobs": knobs, "frame": 0, "seeds": SEEDS, "runs": [f"{technique} {knobs} {s}" for s in SEEDS],
            "ms": {"median": 1.0, "fastest": 1.0, "slowest": 1.0}, "rays": {"mean": 1.0, "halfWidth": 0.0}, "passes": {},
            "counts": {"triangles": {"mean": triangles, "halfWidth": 0.0}, "steps": {"mean": steps, "halfWidth": 0.0}},
            "metrics": {"relmse": {**estimate(values), "values": values, "againstStart": {"mean": 1.0, "halfWidth": 0.0}}},
            "referenceNoise": {"relmse": 0.001}, "exposure": 1.0}


def counted_study(folder, scenes, techniques, cells, decompositions, charts):
    summary = head("error", scenes, techniques, [0], [metric("relmse")], charts)
    summary.update(cells=cells, decompositions=decompositions, sequences=[], comparisons=[], exponents=[], baseline="fixed", equal=None, outcomes=None, counts=["triangles", "steps"])
    write(folder, summary, [])


def grown_study(folder, charts):
    """A model that grows tenfold: what is fixed costs twice as much, what is chosen the same."""
    cells = [counted_cell(*of) for of in (("large", "fixed", {}, 1000, 20.0, 0.5), ("large", "chosen", {}, 90, 9.0, 0.5),
                                          ("small", "fixed", {}, 100, 10.0, 0.5), ("small", "chosen", {}, 90, 9.0, 0.5))]
    counted_study(folder, ["large", "small"], [("fixed", []), ("chosen", [])], cells, [], charts)


def needs_study(folder, charts):
    """Three fixed levels, and one that has a tenth less error than the best of them has at the same cost."""
    cells, decompositions = [], []

    def add(*of):
        cells.append(counted_cell("box", *of))
        return {name: cells[-1][name] for name in ("scene", "technique", "knobs", "frame")}

    for level, (triangles, steps, bias) in NEEDS.items():
        for samples in (1, 4, 16):
            place = add("fixed", {"lod.level": level, "trace.spp": samples}, triangles, steps * samples, bias + 1 / samples)
            decompositions.append({**place, "metric": "relmse", "squaredBias": {"mean": bias, "halfWidth": 0.016 / samples}, "variance": {"mean": 1 / samples, "halfWidth": 0.01}})
    for samples in (1, 2, 8):
        steps = 90.0 * samples
        best = min(bias + cost / steps for _, cost, bias in NEEDS.values() if cost <= steps)
        add("chosen", {"trace.spp": samples}, 300, steps, 0.9 * best)
    counted_study(folder, ["box"], [("fixed", ["lod.level", "trace.spp"]), ("chosen", ["trace.spp"])], cells, decompositions, charts)


def ensemble_study(folder):
    summary = head("ensemble", ["box"], [("same", []), ("wrong", [])], [0])
    summary.update(halfWidth=0.01, blockSize=16, batches=64, seeds=64)
    summary["techniques"][0]["control"] = summary["techniques"][1]["planted"] = True
    cells = []
    for i, (technique, difference, verdict) in enumerate([("same", 0.001, "unbiased"), ("wrong", 0.04, "biased")]):
        channel = {"mean": 0.5 * (1 + difference), "reference": 0.5, "difference": difference, "halfWidth": 0.004, "sigmas": 250 * difference}
        cells.append({"scene": "box", "technique": technique, "knobs": {}, "frame": 0, "complete": True, "chunks": [f"chunk {i}"], "ms": 2.5, "rays": 384.0, "halvesSigmas": 0.4,
                      "verdict": verdict, "reason": f"because of {technique}", "runs": 64, "batches": 64, "energy": {name: channel for name in ("luminance", "red", "green", "blue")},
                      "energyP": 0.5 if i == 0 else 1e-9, "blockP": 0.25 if i == 0 else 1e-7, "blockColumns": 2, "blockSigmas": [0.5 + 6 * i, -1.25],
                      "faults": [{"size": size, "block": block, "caught": 1 if size > 0.02 else 0.41, "needed": size > 0.02} for block in (False, True) for size in (0.01, 0.03)],
                      "falseAlarms": 0.002, "image": f"images/box.{technique}.0.exr",
                      "convergence": {"noise": 0.2, "bias": 0.002 * i, "biasDeviation": None, "difference": 0.03, "differenceOfNoise": 0.028,
                                      "points": [{"runs": n, "relmse": 0.2 / n + 0.002 * i} for n in (1, 32, 64)]}})
        write_exr(folder / cells[-1]["image"], image_of("box", i), compression=0, kind=numpy.float32)
    write_exr(folder / "images/box.reference.exr", image_of("box", None))
    summary["cells"] = cells
    write(folder, summary, [])


def write(folder, summary, rows):
    folder.mkdir(parents=True, exist_ok=True)
    (folder / "summary.json").write_text(json.dumps(summary))
    (folder / "results.jsonl").write_text("".join(json.dumps(row) + "\n" for row in rows) + '{"cut')


def pass_names(value):
    """All that a graph file and its variants call their passes."""
    if isinstance(value, dict):
        for key, member in value.items():
            if key == "passes" and isinstance(member, dict):
                yield from member
            yield from pass_names(member)


def kept_study(root, name):
    """What scripts/results might have kept of a study of the tree: its scenes, techniques, knobs, frames and metrics, with numbers that mean nothing."""
    path = root / f"studies/{name}.json"
    study = json.loads(path.read_text())
    random = numpy.random.default_rng(1)
    kind = study.get("kind", "error")
    scenes = [pathlib.Path(scene).stem for scene in study["scenes"]]
    configurations = []
    for technique, given in study["techniques"].items():
        knobs = {**given.get("vary", {}), **{knob: limits[:1] for knob, limits in given.get("solve", {}).items()}}
        configurations += [(technique, dict(zip(knobs, values))) for values in itertools.product(*knobs.values())]
    masks = ["", *(f".{mask}" for mask in study.get("masks", [study["mask"]] if "mask" in study else []))]
    levels = ["", ".finest"] if study["reference"].get("finest") else [""]
    metrics = [metric(name + mask + level, finest=level != "") for name in study.get("metrics", []) for mask in masks for level in levels]
    frames = study["frames"]["measure"]
    graphs = [json.loads((path.parent / technique["graph"]).read_text()) for technique in study["techniques"].values()]
    passes = {name: {"ms": 1.5, "rays": {"nee": 100}} for graph in graphs for name in pass_names(graph)}
    counts = [*study.get("counts", {}), *(["steps"] if study.get("countSteps") else [])]
    some = lambda: [float(value) for value in random.uniform(1, 2, 4)]  # noqa: E731
    summary = head(kind, scenes, [(technique, list(given.get("vary", given.get("solve", {})))) for technique, given in study["techniques"].items()], frames, metrics)
    summary.update(study=path.stem, about=study["about"], cells=[], comparisons=[], sequences=[], exponents=[], decompositions=[], counts=counts)
    for scene, (technique, knobs), frame in itertools.product(scenes, configurations, frames):
        place = {"scene": scene, "technique": technique, "knobs": knobs, "frame": frame}
        if kind == "error":
            values = {m["name"]: some() for m in metrics}
            cell = {"seeds": SEEDS, "ms": {"median": 1.5, "fastest": 1.0, "slowest": 2.0, "values": some()}, "rays": {"mean": 1.5, "halfWidth": 0.5, "values": some()}, "passes": passes,
                    "counts": {name: {"mean": 1.5, "halfWidth": 0.5} for name in counts},
                    "metrics": {name: {**estimate(drawn), "values": drawn} for name, drawn in values.items()}}
            if study.get("decompose"):
                part = {"mean": 1.5, "halfWidth": 0.5}
                summary["decompositions"] += [{**place, "metric": name, "squaredBias": part, "variance": part} for name in values]
            span = {"ratio": True, "paired": True, "middle": 2.0, "low": 1.5, "high": 2.5}
            if "ablate" in study["techniques"][technique]:
                summary["comparisons"] += [{**place, "baseline": place, "without": [part], "ms": span, "rays": span, "metrics": {name: span for name in values}}
                                           for part in ("dual", "initial.roulette")]
        else:
            channel = {"mean": 1.0, "reference": 1.0, "difference": 0.001, "halfWidth": 0.002, "sigmas": 1.0}
            cell = {"complete": True, "runs": 64, "batches": 64, "ms": 1.5, "rays": 1.5, "verdict": "inconclusive", "reason": "", "energy": {name: channel for name in ("luminance", "red", "green", "blue")},
                    "energyP": 0.5, "blockP": 0.5, "convergence": {"noise": 0.2, "bias": 0.001, "biasDeviation": 0.001, "difference": 0.03, "differenceOfNoise": 0.02, "points": []}}
        summary["cells"].append({**place, **cell})
    return summary
