# SPDX-License-Identifier: MIT
"""The tables of a page. Each cell keeps its value with all digits (`data-value`) beside the text."""
from types import SimpleNamespace

import numpy

from .drawing import number
from .ensemble_charts import ensemble_cells, ensemble_label
from .error_charts import baseline_of, span_text
from .plots import count_with_unit, slug
from .results import STEPS, configuration_of, real


def cell(text="", value=None, interval="", kind=""):
    return SimpleNamespace(text=text, value=None if value is None or not numpy.isfinite(value) else repr(float(value)), interval=interval, kind=kind)


def words(text):
    return cell(text, kind="text")


def plain(value, digits=4):
    return cell(number(value, digits), value)


def measured(mean, half_width, kind=""):
    return cell(number(mean) if numpy.isfinite(mean) else "", mean, number(half_width, 2) if numpy.isfinite(half_width) else "", kind)


def table(name, head, rows, note="", title=""):
    return SimpleNamespace(slug=name, head=head, rows=rows, note=note, title=title)


# Studies of errors.
def of_errors(r, s):
    """All that a scene has rows for."""
    return [found for found in (errors(r, s), budgets(r, s), comparisons(r, s, False), comparisons(r, s, True), exponents(r, s)) if found.rows]


def errors(r, s):
    rows, noise = [], {}
    for place, c, f, found in r.measured():
        if place != s:
            continue
        at = s, c, f
        span = f"{number(r.ms_range[at][0])} – {number(r.ms_range[at][1])}"
        row = [cell(r.labels[c]), cell(str(r.frames[f])), cell(str(len(found["seeds"]))), plain(r.ms[at]), cell(span), plain(r.rays[at])]
        row += [plain(values[at]) for values in r.counts.values()]
        rows.append(row + [measured(r.error[m["name"]][at], r.half_width[m["name"]][at]) for m in r.metrics])
        noise = noise or found["referenceNoise"]
    head = ["technique", "frame", "seeds", "ms", "fastest – slowest", "rays a pixel"] + [count_with_unit(count) for count in r.counts] + [m["name"] for m in r.metrics]
    taken = ", ".join(f"{name} {number(real(value), 3)}" for name, value in noise.items())
    return table(f"table.{slug(r.scenes[s])}", head, rows, f"Noise of the reference itself, taken out above: {taken}." if taken else "")


def budgets(r, s):
    rows, unit = [], ""
    for place, c, f, found in r.measured():
        if place == s and "budget" in found:
            met, unit = found["budget"], r.summary["equal"]
            took = {"ms": r.ms, "rays a pixel": r.rays, count_with_unit(STEPS): r.counts.get(STEPS)}[unit][s, c, f]
            range_ = words("" if met["inRange"] else "out of its knob's range")
            rows.append([cell(r.labels[c]), cell(str(r.frames[f])), plain(met["given"]), plain(met["reached"]), plain(took), range_])
    return table(f"budget.{slug(r.scenes[s])}", ["technique", "frame", f"given ({unit})", "when chosen", "measured", ""], rows, title="Equal budgets")


def comparisons(r, s, ablation):
    """Against the baseline, or of each technique without its parts."""
    rows, baselines, paired = [], {}, True
    for at, found in r.compared.items():
        if at[0] != s or (found["without"] is not None) != ablation:
            continue
        baselines[baseline_of(found)] = None
        paired = paired and found["rays"]["paired"]
        label = " and ".join(found["without"]) if ablation else r.labels[at[1]]
        row = [cell(label), cell(str(found["frame"])), words(baseline_of(found))]
        for difference in [found["metrics"].get(m["name"]) for m in r.metrics] + [found["ms"], found["rays"]]:
            span = [real(difference[key]) for key in ("middle", "low", "high")] if difference else None
            row.append(cell(("× " if difference["ratio"] else "") + span_text(span), span[0]) if span else cell())
        rows.append(row)
    head = ["without" if ablation else "technique", "frame", "held against"] + [m["name"] for m in r.metrics] + ["ms", "rays"]
    note = "×: geometric means of ratios with their 95 % intervals" + (", seed by seed" if paired else "") + "; else, where some values aren't positive, differences."
    against = next(iter(baselines)) if len(baselines) == 1 else r.summary["baseline"]
    title = "What each part is worth" if ablation else f"Against {against}"
    return table(f"{'ablation' if ablation else 'comparison'}.{slug(r.scenes[s])}", head, rows, note, title)


def exponents(r, s):
    rows = []
    for found in r.summary["exponents"]:
        configuration = configuration_of(found)
        if found["scene"] == r.scenes[s] and configuration in r.configurations:
            over = found["over"].split(".", 1)[-1]
            exponent = measured(real(found["exponent"]["mean"]), real(found["exponent"]["halfWidth"]))
            rows.append([cell(configuration.curve if over else configuration.label), words(over or "frames"), words(found["metric"]), exponent])
    note = "p of error ~ n^p: −1 of squared errors of independent samples, nearer to 0 where frames share history or a bias stays."
    return table(f"exponents.{slug(r.scenes[s])}", ["technique", "over", "metric", "exponent"], rows, note, "How errors fall")


# Ensembles.
def of_ensemble(r, s):
    return [found for found in (verdicts(r, s), convergences(r, s)) if found.rows]


def signed(value, digits, unit):
    return f"{value:+.{digits}f} {unit}".replace("-", "−") if numpy.isfinite(value) else "unknown"


def verdicts(r, s):
    roles = {t["name"]: "control" if t["control"] else "planted fault" if t["planted"] else "" for t in r.summary["techniques"]}
    rows, halves = [], {}
    for c, f, found in ensemble_cells(r, s):
        at = s, c, f
        halves[f] = real(found["halvesSigmas"])
        energy = cell(signed(100 * r.difference[at], 3, "%"), r.difference[at], f"{100 * r.half_width[at]:.3f} %")
        rows.append([cell(ensemble_label(r, c, f)), words(roles[r.configurations[c].technique]), cell(str(found["runs"])),
                     cell(found["verdict"], kind=found["verdict"]), energy, plain(r.energy_p[at], 2), plain(r.block_p[at], 2), plain(r.ms[at]), plain(r.rays[at]),
                     cell(found["reason"], kind="reason")])
    head = ["technique", "role", "runs", "verdict", "energy against the reference", "p of energy", "p of blocks", "ms", "rays a pixel", "because"]
    apart = ", ".join(signed(sigmas, 2, "sigmas") + (f" (frame {r.frames[f]})" if len(halves) > 1 else "") for f, sigmas in halves.items())
    return table(f"table.{slug(r.scenes[s])}", head, rows, f"The reference's halves differ by {apart}.")


def convergences(r, s):
    rows = []
    for c, f, found in ensemble_cells(r, s):
        if "convergence" not in found:
            continue
        known = lambda name: real(found["convergence"][name])  # noqa: B023,E731
        deviation = 2 * known("biasDeviation")
        bias = cell(number(known("bias"), 2), known("bias"), number(deviation, 2) if numpy.isfinite(deviation) else "")
        shares = [cell(f"{100 * known(name):.2f} %", known(name)) for name in ("difference", "differenceOfNoise")]
        rows.append([cell(ensemble_label(r, c, f)), plain(known("noise")), bias, *shares])
    note = ("Of luminance, by pixel; the reference's noise is taken out, so that what has no bias may fall below 0. Noise of a run and bias are RelMSE: by the "
            "spread of the runs, and of the mean over endlessly many (± two standard deviations, by leaving out chunks of runs). One run's error is their sum, "
            "that of the mean over n runs noise / n + bias. Mean difference: |mean over all runs − reference| / reference; beside it what noise alone makes of it.")
    return table(f"convergence.{slug(r.scenes[s])}", ["technique", "noise of a run", "bias", "mean difference", "that of noise"], rows, note, "Convergence")
