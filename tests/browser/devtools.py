"""A browser without a window, driven through its DevTools protocol over a pair of pipes."""
import base64
import json
import os
import select
import subprocess
import tempfile
import time
from pathlib import Path

FITS = "document.documentElement.scrollWidth <= document.documentElement.clientWidth"  # the page does not scroll sideways


class Browser:
    """One page at a time. Every error that the page reports is kept in `errors`, every request in `requests`."""

    def __init__(self, program="chromium"):
        self.errors, self.requests, self.number, self.rest = [], [], 0, b""
        self.profile = tempfile.TemporaryDirectory(ignore_cleanup_errors=True)
        to_browser, self.to_browser = os.pipe()
        self.from_browser, from_browser = os.pipe()

        def hand_over():  # the browser reads commands from descriptor 3 and writes answers to 4
            os.dup2(to_browser, 63), os.dup2(from_browser, 64)
            os.dup2(63, 3), os.dup2(64, 4)

        self.process = subprocess.Popen(
            [program, "--headless=new", "--no-sandbox", "--disable-gpu", "--disable-dev-shm-usage", "--no-first-run",
             "--disable-background-networking", "--hide-scrollbars", "--remote-debugging-pipe",
             "--user-data-dir=" + self.profile.name, "about:blank"],
            preexec_fn=hand_over, close_fds=False, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        os.close(to_browser), os.close(from_browser)
        self.session = None
        target = next(t for t in self.send("Target.getTargets")["targetInfos"] if t["type"] == "page")
        self.session = self.send("Target.attachToTarget", targetId=target["targetId"], flatten=True)["sessionId"]
        for domain in ("Page", "Runtime", "Log", "Network"):
            self.send(domain + ".enable")

    def close(self):
        session, self.session = self.session, None
        try:
            self.send("Browser.close")
        except (OSError, EOFError):
            pass
        try:
            self.process.wait(20)
        except subprocess.TimeoutExpired:
            self.process.kill()
            self.process.wait()
        self.profile.cleanup()

    def receive(self, seconds):
        end = time.monotonic() + seconds
        while b"\0" not in self.rest:
            ready, _, _ = select.select([self.from_browser], [], [], max(0, end - time.monotonic()))
            if not ready:
                raise TimeoutError("the browser does not answer")
            block = os.read(self.from_browser, 1 << 20)
            if not block:
                raise EOFError("the browser is gone")
            self.rest += block
        text, self.rest = self.rest.split(b"\0", 1)
        message = json.loads(text)
        self.note(message)
        return message

    def note(self, message):
        method, what = message.get("method"), message.get("params", {})
        if method == "Runtime.exceptionThrown":
            self.errors.append(json.dumps(what["exceptionDetails"])[:600])
        if method == "Runtime.consoleAPICalled" and what["type"] in ("error", "warning", "assert"):
            self.errors.append(json.dumps(what["args"])[:600])
        if method == "Log.entryAdded" and what["entry"]["level"] in ("error", "warning"):
            self.errors.append(what["entry"]["text"])
        if method == "Network.requestWillBeSent":
            self.requests.append(what["request"]["url"][:200])

    def send(self, method, seconds=120, **parameters):
        self.number += 1
        message = {"id": self.number, "method": method, "params": parameters}
        if self.session:
            message["sessionId"] = self.session
        os.write(self.to_browser, json.dumps(message).encode() + b"\0")
        while True:
            answer = self.receive(seconds)
            if answer.get("id") == self.number:
                if "error" in answer:
                    raise RuntimeError(f"{method}: {answer['error']}")
                return answer["result"]

    def open(self, path, width=1180, height=900, dark=False):
        self.send("Emulation.setDeviceMetricsOverride", width=width, height=height, deviceScaleFactor=1, mobile=False)
        self.send("Emulation.setEmulatedMedia", features=[{"name": "prefers-color-scheme", "value": "dark" if dark else "light"}])
        self.send("Page.navigate", url="file://" + os.path.abspath(path))
        while self.receive(120).get("method") != "Page.loadEventFired":
            pass

    def value(self, script):
        """The result of a script in the page."""
        result = self.send("Runtime.evaluate", expression=script, returnByValue=True, awaitPromise=True)
        if "exceptionDetails" in result:
            raise RuntimeError(f"{script}: {json.dumps(result['exceptionDetails'])[:400]}")
        return result["result"].get("value")

    def every(self, selector, of="e.textContent"):
        """A value of every element of a selector."""
        return self.value(f"[...document.querySelectorAll({json.dumps(selector)})].map(e => {of})")

    def enter(self, field, value, event="input"):
        """Give a field of the page a value, as a person does who types, moves or chooses it."""
        self.value(f"(() => {{ const e = document.getElementById('{field}'); e.value = {json.dumps(value)};"
                   f" e.dispatchEvent(new Event('{event}')); }})()")

    def wait_for(self, script, seconds=60):
        """Wait until the result of a script is true."""
        end = time.monotonic() + seconds
        while not self.value(script):
            if time.monotonic() > end:
                raise TimeoutError(f"{script} does not become true: {self.errors[:2]}")
            time.sleep(0.05)

    def press(self, key, text=None, control=False, shift=False):
        """Press a key in the element that has the focus."""
        code = {"ArrowLeft": 37, "ArrowRight": 39, "Home": 36, "End": 35, "Tab": 9, "Enter": 13}.get(key) or (ord(key.upper()) if len(key) == 1 else 0)
        for kind, more in (("keyDown", {"text": text} if text else {}), ("keyUp", {})):
            self.send("Input.dispatchKeyEvent", type=kind, key=key, code=key, windowsVirtualKeyCode=code, modifiers=2 * control + 8 * shift, **more)

    def picture(self, path, whole=True):
        Path(path).write_bytes(base64.b64decode(self.send("Page.captureScreenshot", format="png", captureBeyondViewport=whole)["data"]))

    def save_to(self, folder):
        """Save the page's downloads to this folder."""
        self.send("Page.setDownloadBehavior", behavior="allow", downloadPath=os.path.abspath(folder))

    def pdf(self):
        return base64.b64decode(self.send("Page.printToPDF", printBackground=True)["data"])
