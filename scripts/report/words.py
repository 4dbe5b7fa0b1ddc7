# SPDX-License-Identifier: MIT
"""What a page says of the conditions that its numbers were measured under, and how they are to be read."""


def listed(parts):
    parts = list(parts)
    return ", ".join(parts[:-1]) + " and " + parts[-1] if len(parts) > 1 else "".join(parts)


def facts(r):
    s = r.summary
    sizes = dict.fromkeys(f"{scene['size'][0]} × {scene['size'][1]}" for scene in s["scenes"])
    frames = (f"{s['warmup']} of warm-up, then " if s["warmup"] else "") + listed(str(offset) for offset in s["frames"])
    return [("device", listed(s["devices"]) or "no device yet"), ("machine", s["machine"]), ("date", s["date"].replace("T", " ").replace("Z", " UTC")),
            ("Lodestir", f"{s['lodestir']} ({s['revision']})"), ("pixels", ", ".join(sizes)), ("seeds" if r.kind == "error" else "runs", str(s["seeds"])),
            ("frames", frames), ("reference", f"{s['referenceSamples']} samples a pixel" if s["referenceSamples"] else "without noise")]


def pairing(r):
    if r.summary["paired"]:
        return ("Every technique draws the same seeds, so that differences between techniques can be taken run by run; what all of them show alike is one "
                "observation.")
    return "Every technique and value of a knob draws seeds of its own."


def missing(r):
    count = r.summary["missing"]
    what = "runs" if r.kind == "error" else "chunks of runs"
    return f"{count} {what} are still missing." if count else ""


def reading_error(r):
    clean, noisy = (list(dict.fromkeys(m["metric"] for m in r.metrics if m["noiseFree"] == free)) for free in (True, False))
    be = lambda names: "is" if len(names) == 1 else "are"  # noqa: E731
    sentences = ["Times are the device's own and medians over seeds (bars: fastest to slowest); errors are means over seeds with 95 % intervals of "
                 "Student's t."]
    sentences.append("References are rendered in two independent halves A and B" + (
        f"; {listed(clean)} {be(clean)} the mean of (x − A)(x − B), which the noise of the reference does not raise (and which may fall below 0 where the "
        "error is far smaller than that noise)." if clean else "."))
    if "relmse_trimmed" in clean:
        sentences.append("Which pixels relmse_trimmed leaves out follows |x − (A + B) / 2|; that takes out a little too much, of Gaussian noise 0.5 % of it.")
    sentences.append("All seeds are judged by one reference: intervals tell the spread of the technique" +
                     (", those of bias the reference's noise as well." if "bias" in noisy else " and not of the reference."))
    sentences.append(pairing(r))
    if noisy:
        sentences.append(f"{listed(noisy)} {be(noisy)} measured against (A + B) / 2 and include{'s' if len(noisy) == 1 else ''} that image's noise.")
    if any("llvmpipe" in device for device in r.summary["devices"]):
        sentences.append("Times on a CPU driver say nothing of a GPU; rays and ratios do.")
    sentences += [f"{m['metric']}: {m['about']}." for m in {m["metric"]: m for m in r.metrics}.values()]
    for mask in dict.fromkeys(m["mask"] for m in r.metrics if m["mask"]):
        where = "objects are seen that take another level at frame 0 or later" if mask == "switched" else "the study's mask of that name isn't 0"
        sentences.append(f".{mask}: only where {where}.")
    if any(m["finest"] for m in r.metrics):
        sentences.append(".finest: against the scene at its finest levels, so that what a coarser level loses counts too.")
    return sentences


def reading_ensemble(r):
    s = r.summary
    return [f"{s['seeds']} independent runs of each technique, whose measured frames are averaged and held against a path-traced reference in {s['batches']} "
            "batches.",
            "Two tests, each blaming correct code once in a thousand: of the energy (luminance and the three colours), and of the means of blocks of "
            f"{s['blockSize']} × {s['blockSize']} pixels and three colours. Both are Welch's t over runs, corrected for skewness (Johnson 1978, Hall 1992), "
            "with Bonferroni's correction; the reference's noise counts.",
            f"Unbiased: neither test rejects, the energy is known to ±{100 * s['halfWidth']:g} % (95 %), and planted faults that such an interval promises to "
            "show are caught at least 95 times in 100. Inconclusive is a failure, too.",
            pairing(r),
            "All are held against one draw of a scene's reference, whose error they share: signs that agree within its noise say nothing."]
