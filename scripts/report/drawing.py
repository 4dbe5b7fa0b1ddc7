# SPDX-License-Identifier: MIT
"""What all charts share: one figure, drawn once, as SVG for the page and as PDF for a paper."""
import html
import io
import logging
import pathlib
import re

import matplotlib

matplotlib.use("agg")  # no display is ever touched
import matplotlib.pyplot as plt  # noqa: E402
import numpy  # noqa: E402
from matplotlib import colors, ticker, transforms  # noqa: E402

logging.getLogger("matplotlib.font_manager").setLevel(logging.ERROR)  # a family that isn't there is no news: the next one is taken

MARKERS = ["o", "s", "D", "^", "v", "P", "X"]
DASHES = ["-", (0, (4, 1.5)), (0, (1, 1.2))]
SUPERSCRIPTS = str.maketrans("-0123456789", "⁻⁰¹²³⁴⁵⁶⁷⁸⁹")
GREY, INK = "#777777", "#222222"


def use_style(path=None):
    plt.style.use(["default", str(pathlib.Path(__file__).parent / "lodestir.mplstyle")] + ([path] if path else []))


def number(value, digits=4):
    """Short, in plain digits where that can be read: 0.0123, 2.5×10⁻⁵."""
    if not numpy.isfinite(value):
        return "unknown"
    size = abs(value)
    if size == 0 or 1e-4 <= size < 1e5:
        text = f"{value:.{digits}g}"
        return (text if "e" not in text else f"{value:.0f}").replace("-", "−")  # 41234 to 2 digits is 41234
    mantissa, exponent = f"{value:.{digits - 1}e}".split("e")
    mantissa = mantissa.rstrip("0").rstrip(".") if "." in mantissa else mantissa
    power = "10" + str(int(exponent)).translate(SUPERSCRIPTS)
    return (power if mantissa == "1" else f"{mantissa}×{power}").replace("-", "−")


def with_interval(mean, half_width):
    return number(mean) + (f" ± {number(half_width, 2)}" if numpy.isfinite(half_width) else "")


def palette():
    return plt.rcParams["axes.prop_cycle"].by_key()["color"]


def color_of(index):
    """Beyond the cycle's end lighter ones of it, from elsewhere in it so that neighbours differ."""
    cycle = palette()
    turn = index // len(cycle)
    color = numpy.array(colors.to_rgb(cycle[(index + 3 * turn) % len(cycle)]))
    return tuple(color + (1 - color) * min(0.5 * turn, 0.8))


def curve_style(index, variant=0):
    """Colour, marker and dash, so that the first 21 curves differ in more than one of them. Variants of a curve (values of a knob, where each is a curve
    of its own) keep colour and marker, and grow lighter."""
    cycle = palette()
    turn = index // len(cycle)
    color = numpy.array(colors.to_rgb(cycle[index % len(cycle)]))
    marker = MARKERS[(index + 2 * turn) % len(MARKERS)]
    return {"color": tuple(color + (1 - color) * min(0.25 * variant, 0.65)), "marker": marker,
            "markersize": plt.rcParams["lines.markersize"] * (1.35 if marker in "^vPX" else 1.0),  # of one weight to the eye
            "linestyle": DASHES[(turn + variant) % len(DASHES)]}


def scale(axis, values, log):
    """Limits that hold all values with a margin, and ticks that can be read."""
    values = numpy.asarray([value for value in values if numpy.isfinite(value) and (not log or value > 0)], float)
    if values.size == 0:
        values = numpy.array([1.0])
    if log:
        low, high = numpy.log10(values.min()), numpy.log10(values.max())
        if high - low < 0.1:  # ticks need something to stand at
            low, high = low - 0.15, high + 0.15
        margin = 0.07 * (high - low)
        getattr(axis.axes, f"set_{axis.axis_name}scale")("log")
        limits = 10 ** (low - margin), 10 ** (high + margin)
        decades = high - low
        subs = (1, 1.5, 2, 3, 4, 5, 7) if decades < 0.7 else (1, 2, 3, 5) if decades < 1 else (1, 2, 5) if decades < 2.2 else (1,)
        axis.set_major_locator(ticker.LogLocator(subs=subs, numticks=9) if decades > 0.4 else ticker.MaxNLocator(5))
        axis.set_minor_locator(ticker.NullLocator())
    else:
        margin = 0.06 * ((values.max() - values.min()) or abs(values.max()) or 1)
        limits = values.min() - margin, values.max() + margin
        axis.set_major_locator(ticker.MaxNLocator(6, integer=bool(numpy.all(values == values.round()))))
    axis.set_major_formatter(ticker.FuncFormatter(lambda value, _: number(float(f"{value:.10g}"))))
    axis.axes.set(**{f"{axis.axis_name}lim": limits})
    return limits


class Drawing:
    """A figure, what is said where the pointer rests, and what stands below it in the page."""

    def __init__(self, slug, title, height=None, axes=True):
        width, usual = plt.rcParams["figure.figsize"]
        self.slug, self.title, self.note, self.hints = slug, title, "", []
        self.figure = plt.figure(figsize=(width, height or usual), layout="constrained")
        self.figure.get_layout_engine().set(w_pad=0.02, h_pad=0.02)
        self.axes = self.figure.add_subplot() if axes else None
        self._finished = False

    def hint(self, artist, text):
        artist.set_gid(f"hint-{len(self.hints)}")
        self.hints.append(text)

    def legend(self, handles, labels):
        """Below the axes, in as many columns as fit; the figure grows by its height."""
        if not labels:
            return
        width, height = self.figure.get_size_inches()
        size = plt.rcParams["legend.fontsize"] / 72
        longest = max(len(label) for label in labels)
        columns = int(max(1, min(len(labels), width // ((0.5 * longest + 3.4) * size))))
        more = (-(-len(labels) // columns) * 1.45 + 0.5) * size
        self.figure.set_size_inches(width, height + more)
        self.figure.get_layout_engine().set(rect=(0, more / (height + more), 1, height / (height + more)))
        self.figure.legend(handles, labels, loc="lower center", ncol=columns, bbox_to_anchor=(0.5, 0), borderaxespad=0.2, labelspacing=0.35)

    def label_ends(self, ends):
        """Labels right of the axes beside the ends of curves, (y, text, colour) each, moved apart until none covers another."""
        axes = self.axes
        texts = [axes.text(1.02, 0, text, color=color, transform=axes.transAxes, va="center", fontsize=plt.rcParams["legend.fontsize"], clip_on=False)
                 for _, text, color in ends]
        self.figure.draw_without_rendering()  # widths make room
        places = axes.transAxes.inverted().transform(axes.transData.transform([(axes.get_xlim()[0], y) for y, *_ in ends]))[:, 1]
        line = 1.15 * plt.rcParams["legend.fontsize"] / 72 * self.figure.dpi / axes.bbox.height
        order = numpy.argsort(places)
        placed = places[order].clip(0, 1)
        for _ in range(200):  # neighbours that are too near push each other away
            gaps = numpy.diff(placed)
            close = numpy.flatnonzero(gaps < line - 1e-6)
            if close.size == 0:
                break
            for i in close:
                push = (line - (placed[i + 1] - placed[i])) / 2
                if push > 0:
                    placed[i] -= push
                    placed[i + 1] += push
        placed += max(0, -placed.min()) - max(0, placed.max() - 1)
        for place, i in zip(placed, order):
            texts[i].set_y(place)
            axes.plot([1.0, 1.015], [places[i].clip(0, 1), place], color=ends[i][2], linewidth=0.5, transform=axes.transAxes, clip_on=False)

    def label_points(self, labels):
        """Names points, (x, y, text, colour) each, once all else is drawn: beside the point where that covers no other point, no other name and no border; a
        name that has no such place is left out, and found under the pointer."""
        axes = self.axes
        self.figure.draw_without_rendering()  # places in pixels
        taken = [transforms.Bbox.from_extents(*(place - 2), *(place + 2)) for line in axes.lines if line.get_marker() not in ("None", None, "")
                 for place in axes.transData.transform(line.get_xydata())]
        for x, y, text, color in labels:
            for across, up in ((1, 1), (-1, 1), (1, -1), (-1, -1)):
                name = axes.annotate(text, (x, y), (3 * across, 4 * up), textcoords="offset points", fontsize=5.5, color=color,
                                     ha="left" if across > 0 else "right", va="bottom" if up > 0 else "top")
                name.set_in_layout(False)
                box = name.get_window_extent()
                inside = axes.bbox.containsx(box.x0) and axes.bbox.containsx(box.x1) and axes.bbox.containsy(box.y0) and axes.bbox.containsy(box.y1)
                if inside and not box.count_overlaps(taken):
                    taken.append(box)
                    break
                name.remove()

    def finish(self):
        if not self._finished:
            self.figure.draw_without_rendering()
            self.figure.set_layout_engine("none")  # laid out once, the same in every form
            self._finished = True
        return self

    def svg(self):
        self.finish()
        plt.rcParams["svg.hashsalt"] = self.slug  # ids that are this figure's alone, and the same every time
        text = io.StringIO()
        self.figure.savefig(text, format="svg", metadata={"Date": None, "Creator": None, "Format": None, "Type": None})
        svg = text.getvalue()
        svg = svg[svg.index("<svg"):]
        svg = re.sub(r"<metadata>.*?</metadata>", "", svg, flags=re.S)
        svg = re.sub(r' (width|height)="[0-9.]+pt"', "", svg, count=2).replace("<svg", f'<svg role="img" aria-label="{html.escape(self.title)}"', 1)
        svg = re.sub(r'id="(figure_1|axes_\d+|matplotlib\.axis_\d+|patch_\d+|text_\d+|line2d_\d+|xtick_\d+|ytick_\d+|legend_\d+|LineCollection_\d+)"', "", svg)
        return re.sub(r'id="hint-(\d+)">', lambda found: f'class="hint"><title>{html.escape(self.hints[int(found[1])])}</title>', svg)

    def save_pdf(self, folder):
        self.finish()
        folder.mkdir(parents=True, exist_ok=True)
        self.figure.savefig(folder / f"{self.slug}.pdf", metadata={"CreationDate": None})

    def close(self):
        plt.close(self.figure)
