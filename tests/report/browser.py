# SPDX-License-Identifier: MIT
"""Headless Chromium by ChromeDriver (W3C WebDriver): pages opened from files, and input as a user gives it."""
import json
import pathlib
import shutil
import subprocess
import tempfile
import urllib.request

FLAGS = ["--headless", "--no-sandbox", "--disable-gpu", "--disable-quic", "--no-first-run", "--disable-background-networking", "--disable-component-update", "--disable-sync",
         "--hide-scrollbars", "--window-size=1280,1000"]
ELEMENT = "element-6066-11e4-a52e-4f735466cecf"  # by which the protocol tells elements from other objects


def available():
    return shutil.which("chromium") and shutil.which("chromedriver")


class Browser:
    def __init__(self):
        self._folder = pathlib.Path(tempfile.mkdtemp())
        self._driver = subprocess.Popen(["chromedriver", "--port=0"], stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, text=True)
        for line in self._driver.stdout:
            if "on port" in line and "success" in line:
                self._port = int(line.rstrip(".\n").rsplit(" ", 1)[1])
                break
        options = {"binary": shutil.which("chromium"), "args": [*FLAGS, f"--user-data-dir={self._folder}"]}
        self._session = ""
        self._session = "/session/" + self._ask("POST", "/session", {"capabilities": {"alwaysMatch": {"browserName": "chrome", "goog:chromeOptions": options}}})["sessionId"]

    def close(self):
        try:
            self._ask("DELETE", "")
        finally:
            self._driver.terminate()
            self._driver.wait()
            shutil.rmtree(self._folder, ignore_errors=True)

    def _ask(self, method, path, body=None):
        request = urllib.request.Request(f"http://127.0.0.1:{self._port}{self._session}{path}", json.dumps(body or {}).encode() if method == "POST" else None,
                                         {"Content-Type": "application/json"}, method=method)
        try:
            with urllib.request.urlopen(request, timeout=120) as answer:
                return json.load(answer)["value"]
        except urllib.error.HTTPError as error:
            raise RuntimeError(json.load(error)["value"]["message"]) from None

    def open(self, path):
        self._ask("POST", "/url", {"url": path.resolve().as_uri()})

    def resize(self, width, height):
        self._ask("POST", "/window/rect", {"width": width, "height": height})

    def ask(self, script, *arguments):
        """What `return ...` gives: for looking, never for acting."""
        return self._ask("POST", "/execute/sync", {"script": script, "args": list(arguments)})

    def find(self, selector):
        return self._ask("POST", "/element", {"using": "css selector", "value": selector})[ELEMENT]

    def click(self, selector):
        self._ask("POST", f"/element/{self.find(selector)}/click")

    def _act(self, *sources):
        self._ask("POST", "/actions", {"actions": list(sources)})

    def press(self, key, shift=False):
        keys = ["\ue008", key] if shift else [key]
        self._act({"type": "key", "id": "keyboard", "actions": [{"type": kind, "value": k} for kind, order in (("keyDown", keys), ("keyUp", keys[::-1])) for k in order]})

    def _moves(self, places):
        return [{"type": "pointerMove", "x": round(x), "y": round(y), "duration": 0, "origin": "viewport"} for x, y in places]

    def move(self, x, y):
        self._act({"type": "pointer", "id": "mouse", "actions": self._moves([(x, y)])})

    def drag(self, start, *places):
        moves = self._moves([start, *places])
        self._act({"type": "pointer", "id": "mouse", "actions": [moves[0], {"type": "pointerDown", "button": 0}, *moves[1:], {"type": "pointerUp", "button": 0}]})

    def wheel(self, x, y, delta):
        self._act({"type": "wheel", "id": "wheel", "actions": [{"type": "scroll", "x": round(x), "y": round(y), "deltaX": 0, "deltaY": delta, "duration": 0, "origin": "viewport"}]})
