"""The playground as people use it, in a browser without a window: typing, dragging, keys, links, playing, the listing.

usage: python3 tests/playground/page_test.py PAGE PICTURES      (a folder for pictures of what was looked at)
"""
import json
import pathlib
import sys
import time

root = pathlib.Path(__file__).resolve().parents[2]
sys.path.insert(0, str(root / "tests" / "browser"))
from devtools import Browser  # noqa: E402

page, pictures = sys.argv[1], pathlib.Path(sys.argv[2])
pictures.mkdir(parents=True, exist_ok=True)
checked = failed = 0
LEAST_CHECKS = 330


def check(holds, words):
    global checked, failed
    checked += 1
    if not holds:
        failed += 1
        print(f"  FAILED {words}")


browser = Browser()
value = browser.value


def ready():
    end = time.monotonic() + 60
    while value("document.body.dataset.ready") != "yes":
        if time.monotonic() > end:
            raise TimeoutError("the page is not ready")
        time.sleep(0.05)


def text():
    return value("document.getElementById('text').value")


def type_text(words):
    value(f"(() => {{ const t = document.getElementById('text'); t.value = {json.dumps(words)};"
          " t.dispatchEvent(new Event('input')); })()")


def choose(menu, name):
    value(f"(() => {{ const m = document.getElementById('{menu}'); m.value = {json.dumps(name)};"
          " m.dispatchEvent(new Event('change')); })()")


def center(script):
    return value(f"(() => {{ const b = ({script}).getBoundingClientRect(); return [b.x + b.width / 2, b.y + b.height / 2]; }})()")


def drag(script, dx, dy, steps=6):
    value(f"({script}).scrollIntoView({{block: 'center'}})")
    x, y = center(script)
    mouse = lambda kind, x, y: browser.send("Input.dispatchMouseEvent", type=kind, x=x, y=y, button="left", buttons=1, clickCount=1)
    mouse("mousePressed", x, y)
    for i in range(1, steps + 1):
        mouse("mouseMoved", x + dx * i / steps, y + dy * i / steps)
        value("new Promise(done => requestAnimationFrame(() => requestAnimationFrame(done)))")
    mouse("mouseReleased", x + dx, y + dy)


def number(key):
    return value(f"contct.model.numbers.find(n => n.key === {json.dumps(key)}).value")


def events():
    return value("contct.states.frames.map(f => f.events.map(e => `${e.pair}${e.change}`).join()).join(';')")


def handle(words):
    return f"[...document.querySelectorAll('#stage .handle')].find(h => h.getAttribute('aria-label').startsWith({json.dumps(words)}))"


def menu():
    names = sorted(str(p.relative_to(root / "reference/problems"))[:-5] for p in (root / "reference/problems").rglob("*.toml"))
    shown = value("[...document.getElementById('menu').options].map(o => o.value)")
    beams = 0
    check(sorted(shown) == names, f"the menu has every problem: {len(shown)} of {len(names)}")
    for name in names:
        choose("menu", name)
        check(text() == (root / "reference/problems" / f"{name}.toml").read_text(), f"{name}: its text is the file's")
        check(value("document.querySelector('#message .bad') === null"), f"{name}: is accepted")
        check(value("document.getElementById('verdict').children.length") >= 1, f"{name}: has a verdict")
        check("NOT equal" not in value("document.getElementById('verdict').textContent"), f"{name}: FORTRAN and C++ are equal")
        check(value("document.querySelectorAll('#events tr').length") >= 2, f"{name}: has increments")
        is_beam = value("contct.states.structure.kind") == "beam"
        beams += is_beam
        check(value("document.querySelector('#stage svg') !== null") == is_beam, f"{name}: a beam has a picture of its own")
        check(is_beam or value("document.getElementById('report-details').open && document.querySelector('#stage').textContent.includes('report')"),
              f"{name}: points at the report")
    check(0 < beams < len(names), f"{beams} beams of {len(names)} problems")


def dragging():
    choose("menu", "pb07-three-gap-supports")
    before, face = events(), number("contact[2].face")
    drag(handle("face of pair 2"), 0, 70)
    check(number("contact[2].face") < face, "a face that is pulled down is lower in the text")
    check(events() != before, "events come and go with it")
    check(text().count("\n") == (root / "reference/problems/pb07-three-gap-supports.toml").read_text().count("\n"),
          "nothing else of the text changes")
    check("NOT equal" not in value("document.getElementById('verdict').textContent"), "both kernels are compared while dragged")
    uniform = number("step[4].uniform")
    drag(handle("uniform load"), 0, 40)
    check(number("step[4].uniform") < uniform, "a load that is pulled down is larger")

    choose("menu", "pb01-cantilever-tip-stop")
    value("document.getElementById('slider').value = document.getElementById('slider').max;"
          "document.getElementById('slider').dispatchEvent(new Event('input'))")
    node = number("step[4].point[1].node")  # the load of the last step, since the last state is shown
    drag(handle("load of step 4"), -330, 0, steps=12)
    check(number("step[4].point[1].node") < node, "a point load can be dragged to another node")

    choose("menu", "pb07-three-gap-supports")
    face = number("contact[1].face")
    value(handle("face of pair 1") + ".focus()")
    browser.press("ArrowDown")
    check(number("contact[1].face") < face, "an arrow key moves a face")
    check(value("document.activeElement.getAttribute('aria-label')").startswith("face of pair 1"), "and it keeps the focus")

    stiffness = number("contact[1].stiffness")
    value("(() => { const s = document.querySelector('[aria-label=\"contact[1].stiffness\"]'); s.value = 50;"
          " s.dispatchEvent(new Event('input')); })()")
    check(abs(number("contact[1].stiffness") / stiffness - 10 ** 0.5) < 1e-3, "a slider changes a stiffness")
    value("(() => { const f = document.querySelector('[aria-label=\"beam.EI, typed\"]'); f.value = '2.5e5';"
          " f.dispatchEvent(new Event('change')); })()")
    check(number("beam.EI") == 2.5e5 and "2.5e5" in text(), "a number can be typed, and stands in the text as typed")


def messages():
    choose("menu", "pb07-three-gap-supports")
    right = text()
    type_text(right.replace("surface", "surfase", 1))
    said = value("document.getElementById('message').textContent")
    check(said.startswith("problem.toml:24:1: contact[1].surfase: found an unknown key (did you mean \"surface\"?)"),
          f"the program's own message: {said}")
    check(value("document.getElementById('stage').classList.contains('stale')"), "the old picture is marked as old")
    value("document.querySelector('#message button').click()")
    check(value("(() => { const t = document.getElementById('text'); return t.value.slice(t.selectionStart).startsWith('surfase'); })()"),
          "a click on the message goes to the place")
    type_text(right)
    check(value("document.querySelector('#message .bad') === null && !document.getElementById('stage').classList.contains('stale')"),
          "a text that is right again is taken again")
    type_text("[beam]\nlength = 1\nelements = 60000\nEI = 1\n[[support]]\nnode = 1\nfix = [\"w\", \"theta\"]\n[[step]]\nuniform = -1\n")
    check("Run" in value("document.getElementById('message').textContent"), "a large problem waits for a button")


def story():
    choose("menu", "pb07-three-gap-supports")
    time.sleep(0.6)  # the story and the report come after a pause
    value("document.querySelector('#events tr[data-frame=\"2\"]').click()")
    value(handle("face of pair 3") + ".dispatchEvent(new MouseEvent('click'))")
    check(value("document.getElementById('pair').value") == "2", "a click on a face chooses its pair")
    words = value("document.getElementById('story').textContent")
    check("Pair 3 wins" in words and "SS(I)" not in words, "the story is told of the pair")
    marked = value("[...document.querySelectorAll('#listing li')].flatMap((l, i) => l.classList.contains('ran') ? [i + 1] : [])")
    told = value("[...document.querySelectorAll('#story p')].flatMap(p => (/^Line (\\d+)/.exec(p.textContent) || []).slice(1).map(Number))")
    check(sorted(set(told)) == marked and len(marked) >= 6, f"the lines that ran are marked: {marked}")
    listing = (root / "fortran/contct.f").read_text().splitlines()
    check(value("[...document.querySelectorAll('#listing li')].map(l => l.textContent)") == listing, "the listing is contct.f")
    value("document.querySelector('#events tr[data-frame=\"1\"]').click(); document.getElementById('play').click()")
    end = time.monotonic() + 30
    while value("document.getElementById('play').getAttribute('aria-pressed')") == "true" and time.monotonic() < end:
        time.sleep(0.2)
    check(value("document.getElementById('slider').value === document.getElementById('slider').max"), "played to the end")


def links():
    choose("menu", "pb07-three-gap-supports")
    own = text().replace("-0.010", "-0.0125  # ä")
    type_text(own)
    choose("kernels", "corrected")
    value("document.getElementById('link').click()")
    link = value("location.hash")
    browser.open(page)
    ready()
    value(f"location.hash = {json.dumps(link)}")
    time.sleep(0.3)
    check(text() == own, "a link holds the problem")
    check(value("document.getElementById('kernels').value") == "corrected", "and the kernels")
    value("location.hash = '#text=%%%'")
    time.sleep(0.3)
    check("cannot be read" in value("document.getElementById('link-said').textContent"), "a link that is cut off says so")


def report():
    choose("kernels", "fortran,cpp")
    choose("menu", "pb07-three-gap-supports")
    value("document.getElementById('report-details').open = true")
    time.sleep(1.5)
    made = value("document.getElementById('report').srcdoc")
    check(made.startswith("<!DOCTYPE html>") and "CONTCT: report of a run" in made, "the report is the program's page")
    check("statement by statement" in made, "with FORTRAN beside C++")
    value("document.getElementById('report-details').open = false")


def shape(width, dark):
    browser.open(page, width=width, height=900, dark=dark)
    ready()
    check(value("document.documentElement.scrollWidth <= document.documentElement.clientWidth"), f"nothing sticks out at {width} px")
    browser.picture(str(pictures / f"playground-{width}-{'dark' if dark else 'light'}.png"))
    nodes = browser.send("Accessibility.getFullAXTree")["nodes"]
    roles = {"button", "slider", "combobox", "textbox", "Iframe"}
    nameless = [n["nodeId"] for n in nodes if n.get("role", {}).get("value") in roles and not n.get("ignored")
                and not n.get("name", {}).get("value")]
    named = [n for n in nodes if n.get("role", {}).get("value") in roles and n.get("name", {}).get("value")]
    check(not nameless and len(named) >= 20, f"every control has a name: {len(named)} of {len(named) + len(nameless)}")


browser.open(page)
ready()
for part in (menu, dragging, messages, story, links, report):
    part()
for width, dark in ((1300, False), (1300, True), (400, False), (400, True)):
    shape(width, dark)
check(not browser.errors, f"the page reports no error: {browser.errors[:3]}")
outside = [r for r in browser.requests if not r.startswith(("file://", "data:", "about:", "blob:"))]
check(not outside, f"no network: {outside[:3]}")
choose("menu", "pb07-three-gap-supports")
times = value("(() => { const all = []; for (let i = 0; i < 30; ++i) { document.getElementById('text').dispatchEvent(new Event('input'));"
              " all.push(contct.milliseconds); } return all.sort((a, b) => a - b); })()")
print(f"  PB7, text to picture: median {times[15]:.1f} ms, longest of 30 {times[-1]:.1f} ms")
# 1000 elements and 100 pairs, of which every one closes.
long_beam = ("[beam]\nlength = 100.0\nelements = 1000\nEI = 1.0e4\n[[support]]\nnodes = [1, 1001]\nfix = \"w\"\n[[contact]]\nnodes = ["
             + ", ".join(str(10 * i) for i in range(1, 101) if i < 101) + "]\nsurface = \"below\"\nface = -0.01\nstiffness = 1.0e4\n"
             "[[step]]\nuniform = -1.0\n")
type_text(long_beam)
check(value("contct.model.pairs") == 100, "a beam of 1000 elements and 100 pairs is followed")
for name in ("fortran,cpp", "corrected"):
    choose("kernels", name)
    times = value("[1, 2, 3, 4, 5].map(() => { document.getElementById('text').dispatchEvent(new Event('input')); return contct.milliseconds; })")
    print(f"  1000 elements, 100 pairs, {value('contct.answer.result.steps.reduce((n, s) => n + s.increments.length, 0)')} increments, {name}: median {sorted(times)[2]:.0f} ms")
browser.close()
if checked < LEAST_CHECKS:
    failed += 1
    print(f"  FAILED only {checked} checks; at least {LEAST_CHECKS}")
print(f"the playground's page: {checked} checks, {failed} failed")
sys.exit(1 if failed else 0)
