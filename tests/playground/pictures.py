"""Writes the pictures of the course that are missing or differ; the scenes of its pages draw them. --check only
reports.
usage: python3 pictures.py COURSE [--check]      (COURSE: the folder build/course; exit status 1 if one differs)"""
import json
import sys
from pathlib import Path

sys.path[:0] = [str(Path(__file__).parents[1] / folder) for folder in ("support", "browser")]
from testing import ROOT, TESTS  # noqa: E402
from devtools import Browser  # noqa: E402

course, check = Path(sys.argv[1]).resolve(), "--check" in sys.argv
without_quotient = (TESTS / "playground/kernel.js").read_text(encoding="utf-8").replace(" - smin) / smin", " - smin)")
# Each picture has a page with its scene, and the actions before the picture is taken.
PICTURES = {
    "tip-stop": ("01-picture", "scenes[0].push(2, -60, false)"),
    "tip-stop-unloaded": ("01-picture", "scenes[0].push(2, 0, false)"),
    "tip-stop-step": ("01-picture", "(scenes[0].push(2, -50, false), scenes[0].start())"),
    "three-stops": ("04-algorithm", "(scenes[0].push(12, -1.5, false), scenes[0].start())"),
    "three-stops-cpp": ("07-again", "scenes[0].push(12, -1.6, false)"),
    "tie": ("08-equality", "(scenes[0].push(8, -3, false), scenes[0].start())"),
    "bent-beam": ("09-wrong", "scenes[0].show(2)"),
    "single-precision": ("11-rounding", "scenes[0].show(2)"),
    "port": ("12-port-it", f"scenes[0].judge({json.dumps(without_quotient)})"),
}
folder = ROOT / "reference/course/pictures"
browser, different = Browser(), []
try:
    for name, (page, script) in PICTURES.items():
        browser.open(course / f"{page}.html", width=760, height=900)
        browser.value("document.querySelector('[data-scene], [data-port]').scrollIntoView()")
        browser.wait_for("document.querySelector('[data-lives]') !== null")
        browser.value(f"Promise.resolve({script}).then(() => 0)")
        text = browser.value("fileOf(scenes[0].picture.firstChild)") + "\n"
        file = folder / f"{name}.svg"
        if not file.exists() or file.read_text(encoding="utf-8") != text:
            different.append(name)
            if not check:
                folder.mkdir(exist_ok=True)
                file.write_text(text, encoding="utf-8")
finally:
    browser.close()
print(f"pictures: {len(PICTURES)}, {'different' if check else 'written'}: {', '.join(different) or 'none'}")
sys.exit(1 if check and different else 0)
