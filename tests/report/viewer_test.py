# SPDX-License-Identifier: MIT
"""The page in a browser: keys, wheel, pointer and slider do to images what they promise."""
import math
import pathlib
import shutil
import sys
import tempfile
import time
import unittest

import numpy
import synthetic
from browser import Browser, available

from report.command import run

WIDTH, HEIGHT = 24, 16
EXPOSURE = 2.0


def encoded(value):
    value = min(max(value, 0), 1)
    return 255 * (12.92 * value if value <= 0.0031308 else 1.055 * value ** (1 / 2.4) - 0.055)


class ViewerTest(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.root = pathlib.Path(tempfile.mkdtemp())
        cls.addClassCleanup(shutil.rmtree, cls.root)
        synthetic.error_study(cls.root, ["error_vs_time"])
        assert run([str(cls.root), "--quiet"]) == 0
        cls.browser = Browser()
        cls.addClassCleanup(cls.browser.close)

    def setUp(self):
        self.browser.open(self.root / "report.html")
        self.until(lambda: self.name(0) == "path tracing, spp 1")
        self.browser.ask("document.querySelector('.viewer').scrollIntoView()")

    def until(self, holds, seconds=20):
        end = time.monotonic() + seconds
        while not holds():
            self.assertLess(time.monotonic(), end, "waited in vain")
            time.sleep(0.05)

    def name(self, pane):
        return self.browser.ask("return document.querySelectorAll('.pane')[arguments[0]].querySelector('.left').textContent", pane)

    def text(self, selector):
        return self.browser.ask("return document.querySelector(arguments[0]).textContent", selector)

    def box(self, pane):
        return self.browser.ask("const b = document.querySelectorAll('.pane')[arguments[0]].getBoundingClientRect(); return [b.left, b.top, b.width, b.height]", pane)

    def at(self, pane, x, y):
        """Place in the window of a place in a pane (0 to 1)."""
        left, top, width, height = self.box(pane)
        return left + x * width, top + y * height

    def middle(self, pane, x, y):
        """Place in the window of a pixel's middle, not zoomed."""
        return self.at(pane, (x + 0.5) / WIDTH, (y + 0.5) / HEIGHT)

    def colour(self, pane, x, y):
        """What the canvas shows at a place of its pane (0 to 1)."""
        return self.browser.ask("const c = document.querySelectorAll('.pane canvas')[arguments[0]];"
                                "return [...c.getContext('2d').getImageData(arguments[1] * c.width, arguments[2] * c.height, 1, 1).data].slice(0, 3)", pane, x, y)

    def radiance(self, index, x, y):
        return synthetic.image_of("box", index).astype(numpy.float16)[y, x].astype(float)

    def assertShows(self, pane, x, y, values, gain=EXPOSURE):
        for shown, value in zip(self.colour(pane, (x + 0.5) / WIDTH, (y + 0.5) / HEIGHT), values):
            self.assertAlmostEqual(shown, encoded(value * gain), delta=1.01)

    def test_keys_flip_images(self):
        for key, index, name in (("3", 2, "reuse"), ("2", 1, "path tracing, spp 4"), ("0", None, "reference"), ("1", 0, "path tracing, spp 1")):
            self.browser.press(key)
            self.assertEqual(self.name(0), name)
            self.assertShows(0, 3, 9, self.radiance(index, 3, 9))
        self.browser.press("]")
        self.assertEqual(self.name(0), "path tracing, spp 4")
        self.browser.press("[")
        self.browser.press("9")
        self.assertEqual(self.name(0), "path tracing, spp 1", "there is no ninth")

    def test_exposure_changes_pixels(self):
        self.browser.press("-")
        self.browser.press("-")
        self.assertEqual(self.text(".stops"), "−1.0 EV")
        self.assertShows(0, 20, 12, self.radiance(0, 20, 12), EXPOSURE / 2)
        self.browser.press("+")
        self.assertShows(0, 20, 12, self.radiance(0, 20, 12), EXPOSURE / math.sqrt(2))
        slider = self.browser.ask("const b = document.querySelector('input.exposure').getBoundingClientRect(); return [b.left, b.top + b.height / 2, b.width]")
        self.browser.drag((slider[0] + slider[2] * 0.475, slider[1]), (slider[0] + slider[2] * 0.3, slider[1]))
        stops = float(self.text(".stops").replace("−", "-").split()[0])
        self.assertLess(stops, -2)
        self.assertShows(0, 20, 12, self.radiance(0, 20, 12), EXPOSURE * 2**stops)

    def test_pointer_shows_values(self):
        """If this fails, values are rounded to what the screen shows, or those of another pixel."""
        self.browser.press("3")
        self.browser.move(*self.middle(0, 5, 3))
        text = self.text("output.values")
        self.assertIn("(5, 3)  reuse: 100.0 100.0 100.0", text)
        self.assertIn("reference: 40.00 40.00 40.00", text)
        error = (60 * EXPOSURE) ** 2 / ((40 * EXPOSURE) ** 2 + 0.01)
        self.assertIn(f"relative squared error: {error:.3f}", text)
        self.browser.move(*self.middle(1, 23, 15))
        self.assertIn("(23, 15)  reuse: 2.396 2.344 0.6250", self.text("output.values"))

    def test_wheel_zooms_both(self):
        point = self.middle(0, 5, 3)
        self.browser.move(*point)
        before = self.text("output.values")
        for _ in range(3):
            self.browser.wheel(*point, -240)
        self.assertEqual(self.text(".zoom"), "8.0×")
        self.browser.move(point[0] + 1, point[1])
        self.assertEqual(self.text("output.values"), before, "what is under the pointer stays there")
        x, y = (5.5 / WIDTH, 3.5 / HEIGHT)
        self.assertEqual(self.colour(0, x, y), [255, 255, 255], "the light")
        self.assertEqual(self.colour(0, x + 3.5 / WIDTH, y), [255, 255, 255], "is eight times as wide")
        light = self.colour(1, x, y)
        self.assertEqual(self.colour(1, x + 3.5 / WIDTH, y), light, "on both sides")
        self.assertNotEqual(self.colour(1, x + 5 / WIDTH, y), light)
        # Dragging moves both.
        left, top, width, height = self.box(1)
        start = (left + width * 0.5, top + height * 0.5)
        self.browser.drag(start, (start[0] + 8 / WIDTH * width, start[1]))
        for pane in (0, 1):
            moved = self.colour(pane, x + 8 / WIDTH, y)
            self.assertEqual(moved, [255, 255, 255] if pane == 0 else light)
        self.browser.press("r")
        self.assertEqual(self.text(".zoom"), "1.0×")

    def test_slider_splits(self):
        self.browser.press("3")
        self.browser.press("s")
        self.assertShows(0, 3, 9, self.radiance(2, 3, 9))
        self.assertShows(0, 20, 9, self.radiance(None, 20, 9))
        self.browser.drag(self.at(0, 0.5, 0.3), self.at(0, 0.7, 0.3), self.at(0, 0.9, 0.3))
        self.assertShows(0, 20, 9, self.radiance(2, 20, 9))
        self.assertShows(0, 23, 9, self.radiance(None, 23, 9))
        self.browser.press("2", shift=True)
        self.assertEqual(self.name(0), "reuse")
        self.assertShows(0, 3, 9, self.radiance(2, 3, 9))
        self.assertShows(0, 23, 9, self.radiance(1, 23, 9))
        self.browser.press("s")
        self.assertShows(0, 23, 9, self.radiance(2, 23, 9))

    def test_error_map(self):
        light = 5.5 / WIDTH, 3.5 / HEIGHT
        small = self.colour(1, *light)  # half of the reference too bright: 0.25
        self.browser.press("3")
        self.assertEqual(self.name(1), "error of reuse")
        large = self.colour(1, *light)  # 2.25
        self.assertLess(sum(small), sum(large))
        self.browser.press("0")
        self.assertLess(sum(self.colour(1, 0.5, 0.5)), 30, "the reference has none")
        self.browser.press("e")
        self.assertEqual(self.name(1), "reference")
        self.assertShows(1, 20, 9, self.radiance(None, 20, 9))

    def test_scenes_and_buttons(self):
        self.browser.click(".viewer select.scene")
        self.browser.press("\ue015")  # arrow down
        self.browser.press("\ue007")  # enter
        self.until(lambda: self.colour(0, 20.5 / WIDTH, 9.5 / HEIGHT)[2] == round(encoded(float(numpy.float16(0.125 * 1.5)) * EXPOSURE)))
        self.browser.press("2")
        self.assertEqual(self.name(0), "path tracing, spp 4")
        self.browser.click(".techniques button[value='4']")
        self.assertEqual(self.name(0), "slow & poor")

    def test_charts_tell_values(self):
        mark = self.browser.ask("const m = document.querySelector('svg .hint'); m.scrollIntoView({block: 'center'}); const b = m.getBoundingClientRect(); return [b.left + b.width / 2, b.top + b.height / 2]")
        self.browser.move(*mark)
        self.assertIn("path tracing, spp 1: 11.5 ms", self.text(".tooltip"))

    def test_narrow_windows(self):
        self.browser.resize(500, 900)
        try:
            self.assertEqual(self.box(0)[0], self.box(1)[0], "one below the other")
            self.assertLessEqual(self.browser.ask("return document.documentElement.scrollWidth - document.documentElement.clientWidth"), 0, "nothing sticks out")
        finally:
            self.browser.resize(1280, 1000)


if __name__ == "__main__":
    if not available():
        print("skipped: there is no chromium with its chromedriver; scripts/setup installs them")
        sys.exit(77)
    unittest.main()
