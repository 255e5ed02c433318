"""Tests the playground in a headless browser: its WebAssembly gives the results of the program, and its page responds
to typing, dragging, keys and links.
usage: python3 check_playground.py WORK PROGRAM PAGE    (WORK: the folder for pictures of the page)"""
import json
import re
import struct
import sys
import time
import tomllib
from pathlib import Path

sys.path[:0] = [str(Path(__file__).parents[1] / folder) for folder in ("support", "browser")]
from testing import PB07, ROOT, Checks, run  # noqa: E402
from devtools import FITS, Browser  # noqa: E402

work, program, page = (Path(a).absolute() for a in sys.argv[1:])
PROBLEMS, COURSE = ROOT / "reference/problems", page.parents[1] / "course"
KERNELS = (["fortran", "cpp"], ["fortran-r4", "cpp-r4"], ["corrected"])
LEAST = {"runs": 160, "numbers": 350_000, "displacements": 70_000, "increments": 1_500, "events": 1_700, "pair states": 8_000,
         "messages": 70, "calls of kernels": 1_500, "lines of unit 26": 2_500, "traces": 50, "replayed calls": 750, "replayed values": 11_000, "scenes": 14, "numbers of scenes": 3_000}
browser, check = Browser(), Checks()
value, all_of, counted = browser.value, browser.every, check.counted


def answer_of(name, *texts):
    """Returns the answer of the page's function contct_NAME to texts and options."""
    given = ", ".join(json.dumps(json.dumps(t) if isinstance(t, dict) else t) for t in (name, *texts))
    return json.loads(value(f"answerOf({given})"))


def open_page(**how):
    browser.open(page, **how)
    browser.wait_for("document.body.dataset.ready === 'yes'")


toml = lambda name: tomllib.loads((ROOT / "reference" / name).read_text(encoding="utf-8"))
bits = lambda x: struct.pack(">d", x)
calls_of = lambda trace: trace[trace.index("\ncall 1\n"):]  # without the header, which names compilers


# ---- comparison with the program contct ----

def differences(page, native, place=""):
    """Returns the places where two JSON values differ. Compares real numbers to the bit, and counts them."""
    if isinstance(page, dict) and isinstance(native, dict):
        return [f"{place}.{key} is there once" for key in page.keys() ^ native.keys()] + [
            found for key in page.keys() & native.keys() for found in differences(page[key], native[key], f"{place}.{key}")]
    if isinstance(page, list) and isinstance(native, list) and len(page) == len(native):
        return [found for i, both in enumerate(zip(page, native)) for found in differences(*both, f"{place}[{i}]")]
    if isinstance(page, float) and isinstance(native, float):
        counted["numbers"] += 1
        same = bits(page) == bits(native)
    else:
        same = type(page) is type(native) and page == native
    return [] if same else [f"{place}: {page!r} in the page, {native!r} in the program"]


def run_natively(file, kernels):
    """Returns the exit status, the text of standard error, and {name: text} of the files that the program writes."""
    paths = {key: work / f"native.{key}" for key in ("json", "log", "trace")}
    for path in paths.values():
        path.unlink(missing_ok=True)
    done = run(program, "run", file, "--kernels", ",".join(kernels), "--quiet", *(word for key, path in paths.items() for word in (f"--{key}", path)))
    return done.returncode, done.stderr, {key: path.read_text(encoding="utf-8") for key, path in paths.items()}


def lapacks_are_the_same(lapack):
    """Checks that the program has reference LAPACK of the page's version, so that results can be equal to the bit."""
    native = re.search(r"^lapack (.*)$", run_natively(PB07, ["fortran"])[2]["trace"], re.M).group(1)
    check(re.fullmatch(re.escape(lapack.split(",")[0]) + r", liblapack\.so[.\d]*", native), f"the program's LAPACK is {native}, the page's {lapack}")


def compare_run(file, kernels):
    name, problem = f"{file}, {','.join(kernels)}", Path(file).read_text(encoding="utf-8")
    answer = answer_of("run", problem, {"kernels": kernels, "log": True, "trace": True, "file": file})
    status, said, native = run_natively(file, kernels)
    check(answer["error"] is None and answer["exit"] == status, f"{name}: exit {answer['exit']} in the page, {status} in the program: {answer['error']}")
    if answer["result"] is None:
        return
    result, expected = answer["result"], json.loads(native["json"])
    steps = expected["steps"]
    counted.update({"runs": 1, "displacements": sum(len(s["displacement"]) for s in steps), "increments": sum(len(s["increments"]) for s in steps),
                    "events": sum(len(i["events"]) for s in steps for i in s["increments"]), "pair states": sum(len(s["pairs"]) for s in steps),
                    "messages": len(answer["messages"]), "lines of unit 26": native["log"].count("\n"), "calls of kernels": native["trace"].count("\ncall ")})
    found = differences(result, expected)
    check(not found, f"{name}: {len(found)} differences: {'; '.join(found[:4])}")
    for message in answer["messages"]:
        check(f"contct: {message}\n" in said, f"{name}: the program does not say: {message}")
    if len(kernels) > 1:
        lockstep = result["lockstep"]
        check(lockstep["calls"] > 0 and lockstep["values_compared"] > 0 and lockstep["mismatches"] == 0, f"{name}: lockstep {lockstep}")
    check(answer["log"] == native["log"], f"{name}: unit 26 differs")
    check("\ncall 1\n" in answer["trace"] and calls_of(answer["trace"]) == calls_of(native["trace"]), f"{name}: a kernel's call differs")


def replay_golden_set():
    for file in sorted((ROOT / "reference/traces").glob("*.trace")):
        trace = file.read_text(encoding="utf-8")
        for kernel in ("fortran-r4", "cpp-r4") if "\nreal 4\n" in trace else ("fortran", "cpp"):
            answer = answer_of("replay", trace, {"kernel": kernel, "file": str(file)})
            result = answer["result"] or {"mismatches": None, "calls": 0, "values_compared": 0}
            check(answer["exit"] == 0 and result["mismatches"] == 0 and result["calls"] == trace.count("\ncall "), f"{file}, {kernel}: {answer}")
            counted.update({"traces": 1, "replayed calls": result["calls"], "replayed values": result["values_compared"]})


def errors_have_their_places():
    problem, file = Path(PB07).read_text(encoding="utf-8"), work / "wrong.toml"
    for old, new in (("surface   = \"below\"", "surfce    = \"below\""), ("surface   = \"below\"", "surface   = \"beyond\""),
                     ("elements = 16", "elements = = 16"), ("node      = 13", "node      = 130")):
        wrong = problem.replace(old, new, 1)
        file.write_text(wrong, encoding="utf-8")
        done, answer = run(program, "run", file), answer_of("run", wrong, {"file": str(file)})
        error = answer["error"] or {"message": "", "line": None, "column": None}
        check(wrong != problem and answer["exit"] == done.returncode == 2 and done.stderr == f"contct: {error['message']}\n",
              f"\"{new}\": {answer['error']} in the page, {done.stderr!r} in the program")
        check(error["line"] == wrong[:wrong.index(new)].count("\n") + 1 and (error["column"] or 0) >= 1, f"\"{new}\": {error}")


# ---- the page's controls ----

of = lambda element, what="textContent": value(f"document.getElementById('{element}').{what}")
click = lambda selector, number=0: value(f"document.querySelectorAll({json.dumps(selector)})[{number}].click()")
text, verdict = lambda: of("text", "value"), lambda: of("verdict")
type_text = lambda words: browser.enter("text", words)
choose = lambda menu, name: browser.enter(menu, name, "change")
number = lambda key: value(f"model.numbers.find(n => n.key === {json.dumps(key)}).value")
events = lambda: value("frames.map(f => f.events.map(e => `${e.pair}${e.change}`).join()).join(';')")
handle = lambda words: f"[...document.querySelectorAll('#picture .handle')].find(h => h.getAttribute('aria-label').startsWith({json.dumps(words)}))"
# The lesson of three stops.
scene = lambda words: value(f"scenes[0].{words}")
press_button = lambda name: click(f"#three-stops [data-act={name}]")
told = lambda: value("document.querySelector('#three-stops .told').textContent")
rests = lambda: browser.wait_for("scenes[0].moving === null", 10)
center = lambda script: value(f"(() => {{ const b = ({script}).getBoundingClientRect(); return [b.x + b.width / 2, b.y + b.height / 2]; }})()")


def drag(script, dx, dy, steps=6, before_release=None):
    """Drags an element of the page. Returns the value of the script `before_release` before the button is released."""
    value(f"({script}).scrollIntoView({{block: 'center'}})")
    x, y = center(script)
    mouse = lambda kind, x, y: browser.send("Input.dispatchMouseEvent", type=kind, x=x, y=y, button="left", buttons=1, clickCount=1)
    mouse("mousePressed", x, y)
    for i in range(1, steps + 1):
        mouse("mouseMoved", x + dx * i / steps, y + dy * i / steps)
        value("new Promise(done => requestAnimationFrame(() => requestAnimationFrame(done)))")
    seen = value(before_release) if before_release else None
    mouse("mouseReleased", x + dx, y + dy)
    return seen


def menu():
    names = sorted(str(p.relative_to(PROBLEMS))[:-5] for p in PROBLEMS.rglob("*.toml") if not p.with_suffix(".mtx").exists())
    check(sorted(all_of("#menu option", "e.value")) == names, f"the menu has every problem, {len(names)}")
    beams = 0
    for name in names:
        choose("menu", name)
        check(text() == (PROBLEMS / f"{name}.toml").read_text(), f"{name}: its text is the file's")
        check(value("document.querySelector('#message .bad') === null && document.querySelector('#picture svg') !== null"), f"{name}: is accepted and drawn")
        check(verdict() and "NOT equal" not in verdict(), f"{name}: has a verdict, and FORTRAN and C++ are equal")
        check(all_of("#events tbody tr"), f"{name}: has increments")
        beams += value("structure.kind") == "beam"
    check(0 < beams < len(names), f"{beams} beams of {len(names)} problems")


def dragging():
    choose("menu", "pb07-three-gap-supports")
    before, face = events(), number("contact[2].face")
    drag(handle("face of pair 2"), 0, 70)
    check(number("contact[2].face") < face, "a face that is pulled down is lower in the text")
    check(events() != before, "events come and go with it")
    check(text().count("\n") == Path(PB07).read_text().count("\n"), "nothing else of the text changes")
    check("NOT equal" not in verdict(), "both kernels are compared while dragged")
    shown = ("(() => { const box = document.querySelector('#picture svg').getBoundingClientRect();"
             " return [...document.querySelectorAll('#picture .face-line')].every(l => l.getBoundingClientRect().bottom < box.bottom && l.getBoundingClientRect().top > box.top); })()")
    check(drag(handle("face of pair 2"), 0, 200, before_release=shown), "a face that is dragged far stays in the picture")
    uniform = number("step[4].uniform")
    drag(handle("uniform load"), 0, 40)
    check(number("step[4].uniform") < uniform, "a load that is pulled down is larger")

    choose("menu", "pb01-cantilever-tip-stop")
    browser.enter("slider", of("slider", "max"))
    node = number("step[4].point[1].node")  # the load of the last step, whose state is shown
    drag(handle("load of step 4"), -330, 0, steps=12)
    check(number("step[4].point[1].node") < node, "a point load can be dragged to another node")

    choose("menu", "pb07-three-gap-supports")
    face = number("contact[1].face")
    value(handle("face of pair 1") + ".focus()")
    browser.press("ArrowDown")
    check(number("contact[1].face") < face, "an arrow key moves a face")
    check(value("document.activeElement.getAttribute('aria-label')").startswith("face of pair 1"), "and it keeps the focus")


def messages():
    choose("menu", "pb07-three-gap-supports")
    right = text()
    type_text(right.replace("surface", "surfase", 1))
    said = of("message")
    check(said.startswith("problem.toml:24:1: contact[1].surfase: found an unknown key (did you mean \"surface\"?)"), f"the program's own message: {said}")
    check(of("right", "classList.contains('stale')"), "the old picture is marked as old")
    click("#message button")
    check(value("(() => { const t = document.getElementById('text'); return t.value.slice(t.selectionStart).startsWith('surfase'); })()"),
          "a click on the message goes to the place")
    type_text(right)
    check(value("document.querySelector('#message .bad') === null") and not of("right", "classList.contains('stale')"), "a text that is right again is taken again")
    type_text("[beam]\nlength = 1\nelements = 60000\nEI = 1\n[[support]]\nnode = 1\nfix = [\"w\", \"theta\"]\n[[step]]\nuniform = -1\n")
    check(of("message").startswith("Running: 120002 dofs, 0 s"), f"a large problem shows that it runs: {of('message')}")
    check(verdict().startswith("No verdict") and "certified" not in verdict(), "and the verdict of the problem before is withdrawn")
    browser.wait_for("/ [1-9] s/.test(document.getElementById('message').textContent)", 20)
    click("[data-act=cancel]")
    check(of("message") == "Run again" and value("String(endRun)") == "() => {}", "and can be cancelled")
    type_text(right.replace("elements = 16", "elements = 3200").replace("node      = 5", "x = 2.0").replace("node      = 13", "x = 6.0").replace("node      = 9", "x = 4.0").replace("nodes = [1, 17]", "nodes = [1, 3201]"))
    check("Running: 6402 dofs" in of("message"), f"another one runs: {of('message')}")
    browser.wait_for("frames.length > 5 && structure.nodes.length === 3201 && document.querySelector('#story button') !== null", 60)
    click("#story button")
    browser.wait_for("document.querySelectorAll('#story p').length > 1 || document.querySelector('#story .quiet') !== null", 60)
    check(not of("right", "classList.contains('stale')") and of("message") == "", "and is shown at its end, with its explanation")
    choose("menu", "divergences/near-tie")
    check("the menu Kernels" in of("message") and "--kernels" not in of("message"), f"a hint names what the page has: {of('message')}")


def plates():
    """Checks that every state of a plate has a picture with the contact forces of the state as arrows."""
    name = "pp01i-unilateral-edges-n24-k1e7"
    choose("menu", name)
    browser.wait_for("(result.calls || []).length > 0", 30)  # the page waits before it computes
    result = natively("run", (PROBLEMS / f"{name}.toml").read_text(encoding="utf-8"))
    states = 1 + sum(len(s["increments"]) for s in result["steps"])
    check(states >= 14 and value("frames.length") == states == int(of("slider", "max")) + 1, f"all {states} states of a plate can be shown")
    pictures = set()
    for k in range(states):
        browser.enter("slider", str(k))
        pictures.add(value("document.getElementById('picture').innerHTML"))
    check(len(pictures) == states, f"they are {len(pictures)} different pictures")
    pressing = sum(p["force"] > 0 for p in result["steps"][-1]["pairs"])
    check(value("document.querySelectorAll('#picture .force').length") == pressing > 20, f"each of the {pressing} contact forces at the end is an arrow")


def pressed_stops():
    choose("menu", "pb01-cantilever-tip-stop")
    browser.enter("slider", value("String(frames.findIndex((f) => f.step === 2 && f.fraction === 1))"))
    pressed = 60 * 8 / 3e4 - 0.004  # the free tip's distance beyond the stop
    tip = -0.004 - pressed * 1 / (1 + 5e4 * 8 / 3e4)
    at = value("Number(document.querySelector('#picture .face-line').getAttribute('y1'))")
    check(abs(at - value(f"page.Y({tip})")) < 0.02 and value(f"Math.abs(page.Y({tip}) - page.Y(-0.004))") > 4, f"a pressed stop is drawn where it has yielded to: {at}")
    check(value("document.querySelectorAll('#picture .force').length") == 1, "its force is an arrow")


def events_by_keyboard():
    choose("menu", "pb07-three-gap-supports")
    time.sleep(0.6)
    of("slider", "focus()")
    pressed = 0
    while pressed < 25 and value("document.activeElement.textContent") != "2.1":
        browser.press("Tab")
        pressed += 1
    check(pressed < 25, f"an event's row is reached by {pressed} tabs behind the slider; allowed: fewer than 25")
    browser.press("Enter", text="\r")
    check(of("state").startswith("Step 2, increment 1") and value("document.activeElement.textContent") == "2.1",
          "Enter shows the event, and the row keeps the focus")


def story():
    choose("menu", "pb07-three-gap-supports")
    time.sleep(0.6)  # the explanation and the report come after a pause
    click("#events button", 1)
    value(handle("face of pair 3") + ".dispatchEvent(new MouseEvent('click'))")
    check(of("pair", "value") == "2", "a click on a face chooses its pair")
    words = of("story")
    check("Pair 3 wins" in words and "SS(I)" not in words, "the story is told of the pair")
    marked = value("[...document.querySelectorAll('#listing li')].flatMap((l, i) => l.classList.contains('ran') ? [i + 1] : [])")
    told = value("[...document.querySelectorAll('#story p')].flatMap(p => (/^Line (\\d+)/.exec(p.textContent) || []).slice(1).map(Number))")
    check(sorted(set(told)) == marked and len(marked) >= 6, f"the lines that ran are marked: {marked}")
    listing = (ROOT / "fortran/contct.f").read_text().splitlines()
    check(all_of("#listing li") == listing, "the listing is contct.f")


def links():
    choose("menu", "pb07-three-gap-supports")
    own = text().replace("-0.010", "-0.0125  # ä")
    type_text(own)
    choose("kernels", "corrected")
    click("#link")
    link = value("location.hash")
    open_page()
    value("openOwn()")
    value(f"location.hash = {json.dumps(link)}")
    time.sleep(0.3)
    check(text() == own, "a link holds the problem")
    check(of("kernels", "value") == "corrected", "and the kernels")
    browser.open(COURSE / "index.html")  # so that the link is not a place of the same page
    browser.open(f"{page}{link}")
    browser.wait_for("document.body.dataset.ready === 'yes'")
    check(text() == own and not of("own", "hidden") and value("Math.abs(document.getElementById('own').getBoundingClientRect().top) < 60"), "a link opens at its problem")
    value("location.hash = '#text=%%%'")
    time.sleep(0.3)
    check("cannot be read" in of("link-said"), "a link that is cut off says so")


def report():
    """Checks that the playground shows the tables of the page of --html after a pause."""
    choose("kernels", "fortran,cpp")
    choose("menu", "pb07-three-gap-supports")
    browser.wait_for("(result.calls || []).length > 0", 30)
    rows = lambda table: value(f"document.querySelectorAll('#{table} tbody tr').length")
    check(rows("comparison") == value("result.lockstep.calls"), "every call of the kernels has its row")
    check(rows("ends") >= 4 and rows("certificate") == 4, "the ends of steps have their tables, and certificates")
    check("SCALE FACTOR" in of("log-text"), "unit 26 is shown")
    check(value("document.querySelectorAll('#edition pre').length") > 20, "with FORTRAN beside C++")


def shape(width, dark):
    open_page(width=width, dark=dark)
    value("openOwn()")
    check(value(FITS), f"nothing sticks out at {width} px")
    if width < 896:
        above = value("document.querySelector('#picture svg').getBoundingClientRect().top - document.getElementById('own').getBoundingClientRect().top")
        check(above < 700, f"on a phone the picture of one's own problem is first: {above:.0f} px below its menu; allowed: 700")
        tops = value("['structure', 'left', 'verdict'].map((i) => document.getElementById(i).getBoundingClientRect().top)")
        check(tops == sorted(tops), f"then comes the text, then the report: {tops}")
    check(value("Math.abs(document.getElementById('own').getBoundingClientRect().top) < 60"), "the problem that is opened is in view")
    browser.send("Emulation.setEmulatedMedia", media="print")
    check(value("document.getElementById('marks').scrollHeight <= document.getElementById('marks').clientHeight + 1 && document.getElementById('marks').textContent.trim() === editor.value.trim()"), "on paper the problem's text is whole")
    browser.send("Emulation.setEmulatedMedia", media="")
    browser.picture(work / f"playground-{width}-{'dark' if dark else 'light'}.png")
    roles = {"button", "slider", "combobox", "textbox", "image"}
    controls = [n for n in browser.send("Accessibility.getFullAXTree")["nodes"] if n.get("role", {}).get("value") in roles and not n.get("ignored")]
    named = sum(bool(n.get("name", {}).get("value")) for n in controls)
    check(named == len(controls) >= 10, f"every control has a name: {named} of {len(controls)}")


def long_beam():
    """Checks a beam of 1000 elements with 100 pairs, all of which make contact."""
    nodes = ", ".join(str(10 * i) for i in range(1, 101))
    type_text("[beam]\nlength = 100.0\nelements = 1000\nEI = 1.0e4\n[[support]]\nnodes = [1, 1001]\nfix = \"w\"\n"
              f"[[contact]]\nnodes = [{nodes}]\nsurface = \"below\"\nface = -0.01\nstiffness = 1.0e4\n[[step]]\nuniform = -1.0\n")
    check(value("model.pairs") == 100 and value("increments.length") > 50, "a beam of 1000 elements and 100 pairs is followed")


# ---- the lessons ----

def natively(command, text, kernels=("fortran", "cpp")):
    """Returns the JSON that the program writes for a problem text."""
    (work / "scene.toml").write_text(text, encoding="utf-8")
    run(program, command, work / "scene.toml", "--kernels", ",".join(kernels), "--json", work / "scene.json")
    return json.loads((work / "scene.json").read_text(encoding="utf-8"))


def lesson_opens_on_the_question():
    check(scene("force") == 0 and "which stop" in told(), f"the lesson opens unloaded, with a question: {told()}")
    check(of("own", "hidden"), "text and numbers are behind a button")
    drag("document.querySelector('#three-stops .handle')", 0, 110)
    check(scene("force") < -0.5 and "presses on stop" in told(), f"the beam follows the load that is dragged: {told()}")
    result, shown = natively("run", scene("history.text")), scene("frames[scenes[0].last].u")
    check(len(shown) == 34 and [bits(w) for w in shown] == [bits(w) for w in result["steps"][-1]["displacement"]], "its shape is the program's, to the bit")
    drag("document.querySelector('#three-stops .handle')", -240, 0)
    check(scene("node") < 12, "the load can be dragged along the beam")
    browser.press("z", control=True)
    check(scene("node") == 12 and scene("force") < -0.5, "Ctrl+Z takes one drag back, where a drag has left the focus nowhere")
    press_button("undo")
    check(scene("force") == 0, "and the button the one before")
    browser.press("y", control=True)
    check(scene("force") < -0.5 and scene("node") == 12, "Ctrl+Y brings it back")
    press_button("redo")
    check(scene("node") < 12, "and the button the other")
    browser.press("z", control=True)


def lesson_steps():
    explained = natively("explain", scene("history.text"))["increments"]
    check(len(explained) >= 3, f"the path has {len(explained)} increments")
    press_button("start")
    for k, increment in enumerate(explained):
        meeting = sorted(p["s"] for p in increment["pairs"] if 0 < p["s"] < 1)
        check(scene("k") == k and value("document.querySelector('#three-stops .ghost') !== null"), f"increment {k + 1}: d* is drawn as a ghost")
        dots = value("[...document.querySelectorAll('#three-stops [data-s]')].map(d => Number(d.dataset.s))")
        check([bits(s) for s in dots] == [bits(s) for s in meeting], f"increment {k + 1}: all s are on the line, to the bit: {dots}")
        gold = value("[...document.querySelectorAll('#three-stops [data-s].gold')].map(d => Number(d.dataset.s))")
        check(gold == meeting[:1], f"increment {k + 1}: the smallest is gold: {gold}")
        press_button("step")
        check(value("scenes[0].moving !== null"), f"increment {k + 1}: the beam glides")
        rests()
    check(scene("k") == len(explained) and not scene("overlay"), "the path ends at the whole load")


def values_beside():
    return value("Object.fromEntries([...document.querySelectorAll('#three-stops dd[data-value]')].map(d => [d.previousSibling.textContent, Number(d.dataset.value)]))")


def lesson_steps_into():
    explained = natively("explain", scene("history.text"))["increments"][0]
    press_button("start")
    expected = [l["line"] for p in explained["pairs"] for l in p["story"] if l.get("line", 99) < 42]
    expected += [l["line"] for l in explained["story"] if "line" in l]
    expected += [l["line"] for p in explained["pairs"] for l in p["story"] if l.get("line", 0) > 48]
    lit = []
    for _ in expected:
        press_button("into")
        lit += value("[...document.querySelectorAll('#three-stops .listing li')].flatMap((l, i) => l.classList.contains('ran') ? [i + 1] : [])")
        if lit[-1] == 38:
            pair = explained["pairs"][lit.count(38) - 1]
            shown = values_beside()
            check({k: bits(v) for k, v in shown.items()} == {"GAP": bits(pair["gap"]), "DTEST": bits(pair["d_star"]), "SS": bits(pair["s"])},
                  f"GAP, DTEST and SS of pair {pair['pair']} stand beside its line: {shown}")
    check(lit == expected and lit.count(38) == 3, f"one line at a time, as they run: {lit}")
    press_button("into")
    rests()
    check(scene("k") == 1, "behind the last line the beam goes there")
    pair = next(p for p in natively("explain", scene("history.text"))["increments"][1]["pairs"] if "s_chk" in p)
    names = {"GAP": "gap", "DTEST": "d_star", "SSCHK": "s_chk", "SS": "s"}
    for line, known in ((35, list(names)[:3]), (36, list(names))):
        while value("scenes[0].linesOf(1)[scenes[0].at]?.line") != line and scene("k") == 1:
            press_button("into")
        shown = values_beside()
        check({k: bits(v) for k, v in shown.items()} == {name: bits(pair[names[name]]) for name in known}, f"at line {line} of a pair at its face {known} are known: {shown}")


def lesson_ignores():
    press_button("start")
    press_button("ignore")
    rests()
    check("100 %" in value("document.querySelector('#three-stops svg').textContent"), "and the arrow carries all of the load")
    check("goes through stop" in told() and value("document.querySelectorAll('#three-stops .through').length") >= 2, f"without s_min the beam goes through stops: {told()}")
    press_button("ignore")
    rests()
    check("s_min = " in told() and value("document.querySelector('#three-stops .through') === null"), "and comes back")


def lesson_labels():
    """Checks that the lesson draws what its words and labels say."""
    value("scenes[0].push(12, -1.6, false)")
    for k in (0, 1):
        value(f"scenes[0].show('path', {k})")
        bracket = [float(y) for y in re.findall(r"M[\d.]+ ([\d.]+)H[\d.]+V([\d.]+)", value("document.querySelector('#three-stops .bracket').getAttribute('d')"))[0]]
        far = value(f"[scenes[0].frames[{k}].u, scenes[0].ghostOf({k})].map((u) => scenes[0].page.Y(u[2 * scenes[0].pairs[scenes[0].toggledOf({k})[0] - 1].at]))")
        check(max(abs(a - b) for a, b in zip(bracket, far)) < 0.01 and "dashed beam is at D + d*" in told(), f"the bracket is d*, from D to the dashed beam: {bracket}, {far}")
    for node, first in ((12, 3), (8, 1)):
        value(f"scenes[0].push({node}, -1.5, false), scenes[0].start()")
        explained = natively("explain", scene("history.text"))["increments"][0]
        check(min(explained["pairs"], key=lambda p: p["s"])["pair"] == first and f"Stop {first} is met next" in told(), f"under a load at node {node + 1} stop {first} is met first: {told()}")
    for script in ("scenes[0].push(12, -1.6, false), scenes[0].show('path', scenes[0].last - 1)", "scenes[0].push(12, -0.1, false), scenes[0].start()"):
        value(script)
        check("s_min = 1" in told() and value("document.querySelector('#three-stops .gold') === null"), f"without an event nothing is gold: {told()}")
    check([43, 45] == value("scenes[0].linesOf(0).map((l) => l.line).slice(-2)"), "without an event the listing writes and returns")
    value("scenes[0].push(12, -1.6, false)")


CUT = """[...scenes[0].picture.querySelectorAll('text')].filter((t) => { const [b, s] = [t, t.ownerSVGElement].map((e) => e.getBoundingClientRect());
  return b.left < s.left || b.right > s.right || b.top < s.top || b.bottom > s.bottom; }).map((t) => t.textContent)"""


def open_scene(page, width):
    browser.open(COURSE / f"{page}.html", width=width, height=844)
    value("document.querySelector('[data-scene]').scrollIntoView()")
    browser.wait_for("document.querySelector('[data-lives]') !== null")


def pictures_are_whole():
    """Checks at both widths that no label of a scene is cut off, that forces are at the beam, and that a stepper sees all."""
    for width in (1200, 390):
        for page in ("01-picture", "04-algorithm", "11-a-tie"):
            open_scene(page, width)
            cut = []
            for node in range(value("scenes[0].nodes.length")):
                value(f"scenes[0].push({node}, -scenes[0].most, false)")
                for k in range(value("scenes[0].frames.length")):
                    cut += value(CUT) + value(f"(scenes[0].show('path', {k}), {CUT})")
            check(not cut, f"{page}, {width} px: cut labels: {cut[:4]}")
        open_scene("01-picture", width)
        value("scenes[0].push(2, -60, false)")
        tip, beam = value("[scenes[0].picture.querySelector('.force path:last-child').getBBox().y, scenes[0].page.Y(scenes[0].frames[2].u[4])]")
        check(abs(tip - beam) < 5 and "41.86 kN" in value("scenes[0].picture.textContent"), f"{width} px: the arrow of a contact force ends at the beam: {tip}, {beam}")
        scale = value("scenes[0].page.times / scenes[0].page.scale")
        check(f"vertical × {float(f'{scale:.3g}'):g}" in value("scenes[0].picture.textContent"), f"{width} px: the vertical scale is told: {scale}")
        open_scene("04-algorithm", width)
        value("scenes[0].push(12, -1.5, false), scenes[0].start()")
        presses = 0
        while value("scenes[0].k === 0 && scenes[0].moving === null") and presses < 30:
            click("[data-act=pair]")
            presses += 1
        check(presses <= 8, f"one call of three pairs takes {presses} presses of Next pair; allowed: 8")
        browser.wait_for("scenes[0].moving === null", 10)
        value("scenes[0].start()")
        for _ in range(4):
            click("[data-act=into]")
        click("[data-act=back]")
        check(value("scenes[0].at") == 2, "a step back goes to the line before")
        value("scenes[0].holder.scrollIntoView()")
        tall = value("(() => { const of = (q) => document.querySelector(q).getBoundingClientRect(); return Math.max(of('.listing').bottom, of('.scene .controls').bottom) - of('.told').top; })()")
        check(tall <= (600 if width > 390 else 760), f"{width} px: words, picture, values, listing and buttons take {tall:.0f} px")
        check(value("scenes[0].picture.clientHeight") <= (480 if width > 390 else 265), f"{width} px: the picture's height is {value('scenes[0].picture.clientHeight')} px")


def loads_are_exact():
    """Checks that the field, the keys and the mouse reach a load that a page names, and that the keys take changes back."""
    open_scene("03-by-hand", 1200)
    value("(() => { const f = document.querySelector('.scene input'); f.value = '50'; f.dispatchEvent(new Event('change')); })()")
    check(value("scenes[0].force") == -50, f"the field sets the load: {value('scenes[0].force')}")
    drag("document.querySelector('.scene .handle')", 0, -31)
    dragged = value("scenes[0].force")
    value("document.querySelector('.scene .handle').focus()")
    for _ in range(int(50 + dragged)):
        browser.press("ArrowDown")
    check(dragged == round(dragged) != -50 and value("scenes[0].force") == -50, f"mouse and keys give whole loads: {dragged}, {value('scenes[0].force')}")
    for k in (1, 2):
        browser.press("z", control=True)
        check(value("scenes[0].force") == -50 + k and value("document.activeElement.classList.contains('handle')"), f"Ctrl+Z number {k} takes one key back: {value('scenes[0].force')}")
    value("scenes[0].start(), scenes[0].picture.querySelector('[data-s]').focus()")
    browser.press("z", control=True)
    check(value("scenes[0].force") == -47, f"where the focus is on a share that goes, Ctrl+Z takes one step back: {value('scenes[0].force')}")
    click("[data-act=undo]")
    check(value("scenes[0].force") == -46, "and so does the button")
    click("[data-act=ignore]")
    browser.wait_for("scenes[0].moving === null", 10)
    colours = value("(() => { const bad = document.body.appendChild(element('p', { class: 'bad' })); return [bad, document.querySelector('[aria-pressed=true]')].map((e) => getComputedStyle(e).color); })()")
    check(colours[0] != colours[1], f"a pressed button has not the red of errors: {colours}")


def scene_by_hand():
    """Checks that slow drags, quick presses, keys and loads that are not allowed do what they say, and that buttons stay."""
    open_scene("04-algorithm", 1200)
    top, words = "document.querySelector('[data-act=step]').getBoundingClientRect().top + scrollY", "document.querySelector('.told').textContent"
    before, _ = value(top), drag(arm := "document.querySelector('.scene .handle')", 0, 60, steps=60)
    check(value("(scenes[0].buttons.undo.click(), scenes[0].history.at === 0 && scenes[0].history.texts.length === 2)"), "a slow drag is one step of undo")
    ends = value(f"['Home', 'End'].map((key) => {{ {arm}.dispatchEvent(new KeyboardEvent('keydown', {{ key }})); return scenes[0].force; }})")
    rows = value("(scenes[0].push(8, -1.5, false), scenes[0].start(), [...document.querySelectorAll('.scene [data-s]')].map((d) => d.cy.baseVal.value))")
    check(value("document.querySelector('.load-arrow') === null") and value(top) == before and len(set(rows)) == 3, f"no load acts yet, each s has its row, and the buttons stay: {rows}")
    check(value(f"(scenes[0].buttons.ignore.click(), scenes[0].finish(), {words})").count("through stops 1, 2 and 3") == 1, "all stops that the beam goes through are named")
    steps = value("(scenes[0].start(), [1, 2, 3].forEach(() => scenes[0].buttons.step.click()), scenes[0].finish(), scenes[0].k)")
    check(ends == [0, -2] and steps == 3, f"Home and End give no load and all of it, and three quick presses are three steps: {ends}, {steps}")
    open_scene("01-picture", 1200)
    typed = "const f = document.querySelector('.scene input'); f.value = load; f.dispatchEvent(new Event('change')); await new Promise((done) => setTimeout(done, 100))"
    said = [value(f"(async (load) => {{ {typed}; return {words}; }})('{load}')") for load in ("1000", "15")]
    check("Allowed: a load from 0 to 60 kN" in said[0] and "it is at stop 1, without force" in said[1], f"a load that is not allowed is told, and a stop that is reached: {said}")
    moved = value("['beforeprint', 'afterprint'].map((name) => { dispatchEvent(new Event(name)); return document.querySelectorAll('.answers .answer').length; })")
    check(moved == [2, 0], f"on paper the answers are at the end: {moved}")


def dots_of_a_tie():
    """Checks that the dots of pairs that are toggled together are gold, and that each can be seen."""
    browser.open(COURSE / "11-a-tie.html")
    browser.wait_for("document.querySelector('[data-lives]') !== null")
    value("scenes[0].push(8, -3, false), scenes[0].start()")
    dots = value("[...document.querySelectorAll('[data-s]')].map((d) => [d.cx.baseVal.value, d.cy.baseVal.value, d.classList.contains('gold')])")
    apart = min(abs(a[0] - b[0]) + abs(a[1] - b[1]) for i, a in enumerate(dots) for b in dots[:i])
    toggled = value("scenes[0].frames[1].events.map((e) => e.pair)")
    check(toggled == [1, 3] and sum(gold for _, _, gold in dots) == 2 and apart >= 16, f"the dots of a tie are both gold, and seen beside each other: {dots}")
    check("Stops 1 and 3 are met next" in value("document.querySelector('.told').textContent"), "and the words name both")


def lesson_by_keyboard():
    force = scene("force")
    value("document.querySelector('#three-stops .handle').focus()")
    browser.press("ArrowUp")
    check(scene("force") > force, "an arrow key takes load off")
    check(value("document.activeElement.classList.contains('handle')"), "and the load keeps the focus")
    press_button("start")
    value("document.querySelectorAll('#three-stops [data-s]')[1].focus()")
    browser.press("Enter")
    check(value("document.querySelector('#three-stops .inside').hidden") is False, "Enter on a share opens its pair's lines")
    check(value("document.activeElement === document.querySelectorAll('#three-stops [data-s]')[1]"), "and the share keeps the focus")
    browser.send("Emulation.setEmulatedMedia", features=[{"name": "prefers-reduced-motion", "value": "reduce"}])
    press_button("start")
    press_button("step")
    check(scene("k") == 1 and scene("moving") is None, "nothing glides where the system asks for less motion")
    browser.send("Emulation.setEmulatedMedia", features=[])


def lesson_of_two_rules():
    click("#two-rules button", 2)
    shown = value("[...document.querySelectorAll('#two-rules b')].map(b => Number(b.dataset.value))")
    text = (ROOT / "reference/problems/divergences/near-tie.toml").read_text(encoding="utf-8")
    tip = natively("run", text)["steps"][1]["displacement"][-2]
    check(bits(shown[0]) == bits(tip) and abs(tip - 0.5 * 8 / 3e4) < 1e-9, f"1989 leaves 0.5 L^3 / 3 EI at the tip: {shown[0]}")
    check(abs(shown[1]) < 1e-12, f"the corrected rule leaves nothing: {shown[1]}")


def lesson_on_a_phone():
    open_page(width=400, height=800)
    box = value("(() => { const b = document.querySelector('#three-stops svg').getBoundingClientRect(); return [b.top, b.bottom]; })()")
    check(box[0] < 350 and box[1] < 850, f"the picture is first on a phone: {box}")
    browser.send("Emulation.setTouchEmulationEnabled", enabled=True)
    x, y = center("document.querySelector('#three-stops .handle')")
    for kind, points in (("touchStart", [{"x": x, "y": y}]), *(("touchMove", [{"x": x, "y": y + 20 * k}]) for k in range(1, 6)), ("touchEnd", [])):
        browser.send("Input.dispatchTouchEvent", type=kind, touchPoints=points)
        value("new Promise(done => requestAnimationFrame(() => requestAnimationFrame(done)))")
    check(scene("force") < -0.5 and abs(scene("force") * 20 - round(scene("force") * 20)) < 1e-9 and value("scrollY") == 0, f"a finger drags the load, and the page stays: {scene('force')}")
    browser.send("Emulation.setTouchEmulationEnabled", enabled=False)
    open_page()


def opens_on_a_problem():
    click("#open-own")
    check(value("!document.getElementById('own').hidden && result !== undefined"), "a button opens a problem of one's own")


def takes_back():
    choose("menu", "pb07-three-gap-supports")
    before = text()
    drag(handle("face of pair 2"), 0, 50)
    check(text() != before, "a drag changes the text")
    dragged = text()
    browser.press("z", control=True)
    check(text() == before, "Ctrl+Z takes a whole drag back")
    browser.press("Z", control=True, shift=True)
    check(text() == dragged, "Ctrl+Shift+Z brings it back")
    of("text", "focus()")
    browser.press("z", control=True)
    check(text() == before, "Ctrl+Z works in the text, too")
    type_text(before.replace("1.0e5", "1,0e5", 1) if "1.0e5" in before else before.replace("elements = 16", "elements = 1,6", 1))
    check("No verdict" in of("verdict"), "a verdict is withdrawn while the text is no problem file")
    type_text(before)


def like(shown, native):
    """Returns the page's values for the keys of the program's JSON, with types as in the program's JSON. JavaScript has
    no integers, and the page has additional states."""
    if isinstance(native, dict) and isinstance(shown, dict):
        return {key: like(shown[key], of) for key, of in native.items() if key in shown}
    if isinstance(native, list) and isinstance(shown, list) and len(native) == len(shown):
        return [like(*both) for both in zip(shown, native)]
    if isinstance(native, float) and (type(shown) is int or shown == "-0"):
        return float(shown)
    return native if isinstance(native, int) and abs(native) > 2**53 and float(shown) == float(native) else shown


# A value of the page with "-0" for negative zeros, which the browser's protocol does not transfer.
in_page = lambda script: json.loads(value(f"JSON.stringify({script}, (key, x) => (Object.is(x, -0) ? '-0' : x))"))


def scene_is_the_programs(at, name):
    """Checks the numbers of a scene against the program."""
    before = counted["numbers"]
    this, spec = f"scenes.find((s) => s.holder === document.querySelectorAll('[data-scene]')[{at}])", SCENES[name]
    kernels = spec.get("rules") or spec.get("kernels") or ["fortran", "cpp"]
    found = []
    if "rules" in spec:
        problem = (ROOT / spec["problem"]).read_text(encoding="utf-8")
        for key, of in (("old", kernels), ("right", ["corrected"])):
            native = natively("run", problem, of)
            found += differences(like(in_page(f"{this}.{key}"), native), native, key)
            for k, step in enumerate(native["steps"], start=1):
                value(f"{this}.show({k})")
                told = value(f"[...{this}.words.querySelectorAll('b')].map((b) => Number(b.dataset.value))")
                found += differences([float(told[key == "right"])], [step["displacement"][-2]], f"the tip by {key} after step {k}")
    else:
        value(f"{this}.push({this}.node, -0.8 * {this}.most, false)")
        problem = value(f"{this}.history.text")
        run, explained = natively("run", problem, kernels), natively("explain", problem, kernels)["increments"]
        found += differences(like(in_page(f"{this}.result"), run), run, "run") + differences(like(in_page(f"{this}.told"), explained), explained, "explain")
        for k, increment in enumerate(explained):
            value(f"{this}.show('path', {k})")
            shares = sorted(float(p["s"]) for p in increment["pairs"] if 0 < p["s"] < 1)
            found += differences(value(f"[...{this}.picture.querySelectorAll('[data-s]')].map((d) => d.dataset.s)"), [value(f"String({s!r})") for s in shares], f"shares {k}")
    check(not found and counted["numbers"] > before + 8, f"the scene {name} has {len(found)} other numbers than the program: {'; '.join(found[:3])}")
    counted["numbers of scenes"] += counted["numbers"] - before


def course_pages():
    """Checks that every page of the course can be read at once, that its scenes have the program's numbers, and its
    pictures; that no command is cut off, that links lead to pages, and that all of it is on paper."""
    for markdown in sorted((ROOT / "reference/course").glob("*.md")):
        name = "index" if markdown.stem == "README" else markdown.stem
        file, source = COURSE / f"{name}.html", markdown.read_text(encoding="utf-8")
        browser.open(file)
        waits = all_of("script:not([defer]), link[rel=stylesheet]", "0")
        check(1_000 < file.stat().st_size < 40_000 and not waits and all_of("h1"), f"{name}: can be read before its scripts are there: {file.stat().st_size} bytes")
        scenes = re.findall(r'"scene: ([\w-]+)"', source)
        check(len(all_of("[data-scene]", "0")) == len(scenes), f"{name}: has its {len(scenes)} scenes")
        for i in range(len(scenes)):
            value(f"document.querySelectorAll('[data-scene]')[{i}].scrollIntoView()")
            browser.wait_for(f"document.querySelectorAll('[data-scene]')[{i}].dataset.lives === 'yes'", 20)
            check(value(f"document.querySelectorAll('[data-scene] svg')[{i}] !== undefined"), f"{name}: scene {i + 1} is drawn")
            scene_is_the_programs(i, scenes[i])
        counted["scenes"] += len(scenes)
        check("](pictures/" in source or not re.match(r"\d\d-", name), f"{name}: has a picture")
        check(value(FITS), f"{name}: nothing sticks out")
        check(all(all_of("img", "e.src.includes('/course/pictures/') && e.naturalWidth > 0")), f"{name}: its pictures are in its folder")
        paragraphs = source.split("\n\n")
        check(name != "04-algorithm" or "algorithm.svg" in source and "| step |" not in source, "page 4 has a picture of the subroutine")
        asks = any("?" in words and picture.startswith("![") for words, picture in zip(paragraphs, paragraphs[1:]))
        check(not asks or all_of(".answer", "0"), f"{name}: what the page asks has an answer")
        check(not all_of("a[href$='.md'], a[href$='.ipynb']", "e.href"), f"{name}: every link to a page leads to HTML")
        browser.send("Emulation.setEmulatedMedia", media="print")
        value("new Promise(done => requestAnimationFrame(() => requestAnimationFrame(done)))")
        cut = value("[...document.querySelectorAll('pre')].filter((p) => p.scrollWidth > p.clientWidth || p.clientHeight === 0).length + [...document.querySelectorAll('details > :not(summary)')].filter((e) => !e.checkVisibility({ contentVisibilityAuto: true })).length")
        browser.send("Emulation.setEmulatedMedia", media="")
        check(cut == 0, f"{name}: on paper {cut} blocks are cut or hidden")
        browser.send("Emulation.setEmulatedMedia", features=[{"name": "prefers-color-scheme", "value": "dark"}])
        check("none" not in all_of("p > img[src$='.svg']", "getComputedStyle(e).filter"), f"{name}: no picture is white in the dark")
        browser.send("Emulation.setEmulatedMedia", features=[])
        for width in (1200, 390):
            browser.send("Emulation.setDeviceMetricsOverride", width=width, height=844, deviceScaleFactor=1, mobile=False)
            value("document.querySelectorAll('details').forEach((d) => { d.open = true; })")
            cut = value(f"[...document.querySelectorAll('pre')].filter((p) => p.scrollWidth > p.clientWidth && ({width} > 400 || p.querySelector('.language-sh'))).map((p) => p.textContent.slice(0, 40))")
            check(not cut, f"{name}, {width} px: blocks that are cut off: {cut}")


def shell_of_the_course():
    """Checks that a reader can go through the course from page to page, and that numbers are judged."""
    browser.open(COURSE / "01-picture.html")
    seen = ["01-picture.html"]
    while (after := value("document.querySelector('nav.ends [rel=next]')?.getAttribute('href')")) and len(seen) < 30:
        browser.open(COURSE / after)
        seen.append(after)
        check(value("document.querySelector('progress').value") == len(seen), f"{after}: shows the progress")
    rows = re.findall(r"^\|[^|]*\]\(([^)]+)\)", (ROOT / "reference/course/README.md").read_text(encoding="utf-8"), re.M)
    check(len(seen) == len(rows) >= 18, f"next leads through {len(seen)} pages; the course has {len(rows)}")
    open_scene("05-listing", 1200)
    numbers = all_of("pre.numbered", "[Number(e.style.counterReset.split(' ')[1]) + 1, e.querySelector('span').textContent.trim()]")
    listing = [line.strip() for line in (ROOT / "fortran/contct.f").read_text().splitlines()]
    check(len(numbers) >= 3 and all(listing[n - 1] == text for n, text in numbers), f"the listings of page 5 have the numbers of contct.f: {numbers}")
    for page, right, wrong, script in (("01-picture", "15", "10", "[15, 16].map((f) => (scenes[0].push(2, -f, false), scenes[0].frames[scenes[0].last].force[0] > 0)).join() === 'false,true'"),
                                       ("02-problem", "0.0024", "-0.0024", "(scenes[0].push(2, -6, false), Math.abs(scenes[0].frames[1].u[4] + 0.0016) < 1e-12)"),
                                       ("02-problem", "2,4 mm", "2.4 kN", "true"), ("01-picture", "-15 kN", "10 or 20", "true"), ("04-algorithm", "stop 3", "none", "true"), ("09-wrong", "1/64", "0.014", "true"), ("09-wrong", "0.016", "0.017", "true"),
                                       ("11-a-tie", "2", "1", "(scenes[0].push(8, -3, false), scenes[0].frames[1].events.length === 2)")):
        open_scene(page, 1200)
        guess = lambda number: value(f"(() => {{ const f = document.querySelector('.guess input'); f.value = '{number}'; f.dispatchEvent(new Event('change')); return f.parentNode.textContent + document.querySelector('details[data-is]').open; }})()")
        check(("Write one number" if wrong in ("none", "10 or 20") else "Not yet") in guess(wrong) and guess(wrong).endswith("false"), f"{page}: {wrong} is refused, and the answer stays closed")
        check("Right." in guess(right) and guess(right).endswith("true") and value(script), f"{page}: {right} is accepted, and is what the scene shows")
    open_scene("08-equality", 1200)
    value("scenes[0].push(8, -3, false), scenes[0].start()")
    said = float(value("document.querySelector('.told').textContent").split("differ by ")[1].rstrip(".").replace("−", "-"))
    printed = float(re.search(r"differ by ([\d.e-]+\d)", (ROOT / "reference/course/08-equality.md").read_text(encoding="utf-8"))[1])
    check(abs(said / printed - 1) < 0.02, f"page 8 prints the difference that the scene computes: {said}, {printed}")


def readme_has_the_bent_beam():
    """Checks README's picture, its scene, and its shares of wrong answers against the table in DIVERGENCES.md."""
    readme = (ROOT / "README.md").read_text(encoding="utf-8")
    target = re.search(r"^\[!\[[^\]]*\]\(reference/course/pictures/bent-beam\.svg\)\]\(reference/course/([\w-]+)\.md\)", readme, re.M)
    check(target and "scene: bent-beam" in (ROOT / f"reference/course/{target[1]}.md").read_text(encoding="utf-8"), "README's picture is the bent beam, with its scene behind it")
    rows = [[float(x) for x in row] for row in re.findall(r"^\| (1e[-\d]+) \| ([\d.]+) \| ([\d.]+) \|", (ROOT / "reference/DIVERGENCES.md").read_text(encoding="utf-8"), re.M)]
    large, small = [r for r in rows if r[0] >= 1], [r for r in rows if r[0] < 1]
    eight, four = (float(re.search(rf"some (\d+) %[^%]*?{name}", readme, re.S)[1]) for name in ("8-byte", "4-byte"))
    check(len(large) >= 5 and all(abs(r[1] - eight) < 1 and abs(r[2] - four) < 2 for r in large) and all(r[1] > 4 * eight for r in small), f"README's shares of wrong answers are those of the table: {eight}, {four}")


def an_hour():
    """Checks the answers of the sheet for an hour against the program, and that the plan fills the hour."""
    sheet = (ROOT / "reference/course/teaching.md").read_text(encoding="utf-8")
    spans = [(int(a), int(b)) for a, b in re.findall(r"^\| (\d+) to (\d+) \|", sheet, re.M)]
    check([a for a, _ in spans] == [0] + [b for _, b in spans[:-1]] and spans[-1][1] == 60, f"the plan has each of the sixty minutes: {spans}")
    answers = [[abs(float(x)) for x in (low, high or low)] for low, high in re.findall(r'data-is="(-?[\d.]+?)(?:\.\.([\d.]+))?[a-zN]*"', sheet)]
    pb1 = (PROBLEMS / "pb01-cantilever-tip-stop.toml").read_text(encoding="utf-8")
    near = (PROBLEMS / "divergences/near-tie.toml").read_text(encoding="utf-8")
    met = natively("explain", pb1)["increments"][1]["pairs"][0]["s"]
    together = lambda first, mm: len(natively("run", near.replace("-0.00401", str(round(first - mm / 1000, 9))).replace("-0.004\n", f"{first}\n"))["steps"][0]["increments"][0]["events"]) == 2
    left = 1000 * natively("run", near)["steps"][1]["displacement"][-2]
    computed = [10 + met * 50, natively("run", pb1.replace("-60.0", "-40.0"))["steps"][1]["pairs"][0]["force"], 0.001, met, 4 / 256, left, 10 / 256]
    check(len(answers) == 7 and all(low * 0.998 < b < high * 1.002 for (low, high), b in zip(answers, computed)), f"the sheet's answers are the program's: {answers}, {computed}")
    check(all((together(first, mm - 1e-4), together(first, mm + 1e-4)) == (True, False) for first, mm in ((-0.004, 4 / 256), (-0.01, 10 / 256))), "both differences of the heights are the cliff")


def beside_the_listing():
    """Checks that page 7 shows the C++ of the parallel edition next to each executed line of the listing."""
    browser.open(COURSE / "07-again.html")
    browser.wait_for("document.querySelector('[data-lives]') !== null")
    value("scenes[0].push(12, -1.6, false), scenes[0].start()")
    parts = toml("parallel-edition.toml")["part"]
    squeezed = lambda words: "".join(words.split())
    expected = {line: squeezed("".join(b["text"] for b in p["cpp"] if b["file"].endswith("/contct.hpp"))) for p in parts for line in p["listing"]}
    lines = value("scenes[0].linesOf(0).map((l) => l.line)")
    seen = []
    for line in lines:
        click("[data-act=into]")
        seen.append(squeezed(value("document.querySelector('.values code')?.textContent ?? ''")))
    check(len(lines) >= 15 and seen == [expected[line] for line in lines], f"the C++ of each line is beside it: {len(lines)} lines")


# Faults that are put into kernel.js: (name in hints.toml, a text of the kernel, its replacement). SLIPS: (text, replacement, what the page says).
FAULTS = [("smin-quotient-dropped", " - smin) / smin", " - smin)"), ("epsmul-le", "diff < 1", "diff <= 1"), ("gap-reversed", "cc[i] - dd[dof]", "dd[dof] - cc[i]"),
          ("toggled-by-sign", "isep[i] === 1 ? -1 : 1", "-isep[i]"), ("sschk-negated", "(isep[i] * isurf[i])", "(-isep[i] * isurf[i])"),
          ("do-30-from-2", "let i = 0; i < nc; ++i) {\n    const diff", "let i = 1; i < nc; ++i) {\n    const diff"), ("nodes-from-0", "(id[i] - 1)", "id[i]"),
          ("delta-dropped", "sschk * 1e-20", "sschk"), ("cpp-smin-not-set-without-event", "if (smin === 1) return smin;", "if (smin === 1) return -7;"), ("diff-as-product", "- smin) / smin;\n    if (diff < 1", "- smin);\n    if (diff < smin"),
          ("port-index-from-1", "indof - 1;", "indof;"), ("port-smin-assigned", "if (smin === 1)", "if (smin = 1)"), ("port-epsmul-far", "1 / 256", "0.39"), ("port-epsmul-large", "1 / 256", "0.0390625"),
          ("port-epsgap-large", "1e-10", "1e-6"), ("port-epsgap-small", "1e-10", "1e-12"), ("port-gap-with-n-twice", "gap / dtest", "isurf[i] * isurf[i] * gap / dtest"), ("port-sschk-lt", "sschk > 0", "sschk < 0"),
          ("port-delta-0", "1e-20", "0"), ("port-sschk-without-dtest", "(isep[i] * isurf[i]) / dtest[dof]", "isep[i] * isurf[i]"), ("port-gap-with-n", "cc[i] - dd[dof]", "isurf[i] * (cc[i] - dd[dof])"),
          ("port-without-epsmul", "diff < 1 / 256", "ss[i] === smin"), ("port-gap-with-n-and-sign", "cc[i] - dd[dof];\n    if (dtest[dof] === 0) ss[i] = 1;\n    else if (Math.abs(gap)", "isurf[i] * (cc[i] - dd[dof]);\n    if (dtest[dof] === 0) ss[i] = 1;\n    else if (gap")]
SLIPS = [("i < nc; ++i) {\n    const dof", "i <= nc; ++i) {\n    const dof", "id[1]: the pairs are 0 to nc - 1"), ("Math.abs(gap)", "abs(gap)", "it is Math.abs"), ("\n  return smin;\n", "\n", "returns nothing"),
         ("\n  return smin;\n", "\n  return ss;\n", "returns no number"), ("+ indof - 1", "+ indof + 3", "look at your index"), ("function contct", "function f", "has no function contct"), ("diff < 1 / 256", "diff < 0.3", "but others are not"),
         ("let smin = 1;", "no();", "no is not defined (line 2)"), ("let smin = 1;", "let smin = 1; while (nc === 2);", "does not answer call full-load 4 in 3 seconds")]


def judged(source):
    """Returns the text of page 12 about a kernel that is typed into its box."""
    value(f"document.querySelector('[data-port] textarea').value = {json.dumps(source)}")
    value("document.querySelector('[data-port] textarea').dispatchEvent(new Event('input')), document.querySelector('[data-port] button').click()")
    browser.wait_for("!document.querySelector('[data-port] button').disabled", 20)
    return value("document.querySelector('[data-port] .told').innerText")


def judge_of_kernels():
    """Checks that page 12 runs a kernel in JavaScript in the golden calls, and shows the right hints."""
    table = toml("course/hints.toml")
    right = (ROOT / "tests/playground/kernel.js").read_text(encoding="utf-8")
    browser.open(COURSE / "12-port-it.html")
    browser.wait_for("document.querySelector('[data-port] textarea') !== null")
    said = judged(value("document.querySelector('[data-port] textarea').value"))
    check(said.startswith("0 of 223 ") and "SS(1) is not set" in said and "look at DO 10" in said, f"the empty kernel fails every call: {said}")
    said = judged(right)
    check(said.startswith("223 of 223 ") and "This is CONTCT" in said and not all_of("[data-port] svg", "0"), f"a right kernel passes every call, and nothing is drawn: {said}")
    for name, old, new in FAULTS:
        said = judged(right.replace(old, new))
        check(right.count(old) == 1 and said.startswith(f"{table[name]['right']} of 223 ") and said.rstrip().endswith(table[name]["says"]) and "All answers" in said,
              f"the fault {name} is told by its hint: {said}")
    for old, new, says in SLIPS:
        check(right.count(old) == 1 and says in judged(right.replace(old, new)), f"of {new!r} the page says {says!r}")
    judged(right.replace(*FAULTS[0][1:]))
    dots = value("[...document.querySelectorAll('[data-port] [data-s]')].map(d => [Number(d.dataset.s), d.classList.contains('gold')])")
    check(sorted(dots) == sorted([[256 / 257 - 2**-53, True], [1, False], [256 / 257 - 2**-53, True], [1, True]]), f"the first failing call is drawn, right and theirs: {dots}")
    stages = toml("course/port/stages.toml")["stage"]
    said = judged(right.replace("isep[i] === 1 ? -1 : 1", "-isep[i]").replace(FAULTS[1][1], "ss[i] === smin || diff < 0"))
    check(f"{stages[7]['right']['calls']} of 223 " in said and said.rstrip().endswith(stages[8]["adds"]), f"an unfinished kernel is told what comes next: {said}")
    check("SyntaxError" in judged("function contct( {"), "what JavaScript refuses is told")
    check("line 2" in judged("function contct() {\n  let = = 1;\n}") and "at the end" in judged("function contct() {\n"), "with its line")
    check(judged(right).startswith("223 of 223 "), "the judge goes on after all of that")


def workshop():
    """Checks the lights, the inputs, the likely faults, the beam and the memory of page 12."""
    stages = toml("course/port/stages.toml")["stage"]
    right = (ROOT / "tests/playground/kernel.js").read_text(encoding="utf-8")
    browser.open(COURSE / "12-port-it.html", width=1200)
    browser.wait_for("document.querySelector('[data-port] textarea') !== null")
    top = value("document.querySelector('[data-port]').getBoundingClientRect().top")
    check(top < 700, f"the workshop is at the head of its page: {top:.0f} px")
    calls = value("given.stages.map((s) => s.calls.length)")
    total = [sum(calls[:k]) for k in range(1, 11)]
    check(len(calls) == 10 and total[-1] == 223 and all(a <= s["right"]["calls"] for a, s in zip(total, stages)), f"each golden call has its light: {total}")
    lit = lambda source: (judged(source), all_of(".lights li", "e.classList.contains('lit')"))[1]
    check(lit(right) == [True] * 10, "a right kernel lights all ten")
    check(lit(right.replace("isep[i] === 1 ? -1 : 1", "-isep[i]")) == [True] * 9 + [False], "a kernel of stage 9 lights nine")
    check(not all(lit(right.replace("diff < 1 / 256", "diff <= 1 / 256"))), "two wrong calls put a light out")
    check(not any(lit("function contct() { return 0; }")), "a kernel of stage 0 lights none")
    judged(right.replace("cc[i] - dd[dof]", "isurf[i] * (cc[i] - dd[dof])"))
    shown = all_of("[data-port] tbody tr:first-child td")
    call = value("given.golden.find((c) => c.name === 'inconsistent-start 1')")
    check([float(x.replace("−", "-")) for x in shown[1:6]] == [call["dofs"][0][1], call["dofs"][0][2], call["pairs"][0][3], call["pairs"][0][2], call["pairs"][0][1]],
          f"D, d*, c, n and the status of the failing call are shown: {shown}")
    check(value("(() => { const l = document.querySelector('.listing'); return l.scrollWidth <= l.clientWidth; })()"), "no line of the listing is cut")
    browser.open(COURSE / "12-port-it.html")
    browser.wait_for("document.querySelector('[data-port] textarea') !== null")
    check("Math.abs(gap)" in value("document.querySelector('[data-port] textarea').value"), "a kernel outlives a reload")
    tip = natively("run", (ROOT / "reference/problems/divergences/near-tie.toml").read_text(encoding="utf-8"))["steps"]
    for source, ends in ((right, [s["displacement"][-2] for s in tip]), (right.replace("cc[i] - dd[dof]", "isurf[i] * (cc[i] - dd[dof])"), [-60 * 8 / 3e4, 0])):
        judged(source)
        value("scenes[0].bend()")
        bent, theirs = value("scenes[0].bent.old.steps.map((s) => s.displacement.at(-2))"), value("scenes[0].beam.innerText")
        check(("listing's own fault" in theirs) == (source == right) and "CONTCT gives" in theirs, f"the beam is compared with CONTCT's: {theirs}")
        check(max(abs(a - b) for a, b in zip(bent, ends)) < 1e-12 and value("document.querySelector('[data-port] .member') !== null"), f"the kernel bends the beam: {bent}, {ends}")
    value("scenes[0].source.dispatchEvent(new Event('input'))")
    check("text has changed" in value("document.querySelector('[data-port]').innerText") and not all_of(".lit, [data-port] svg, [data-port] td"), "a change of the text takes back all that was said of it")
    check("Math.abs(gap)" in value("(window.confirm = () => false, document.querySelectorAll('[data-port] .controls button')[2].click(), scenes[0].source.value)"), "a kernel is not deleted without a question")
    judged(right.replace("let smin = 1;", "return 2;"))
    value("scenes[0].bend()")
    check("SMIN is 2; allowed" in value("scenes[0].beam.textContent"), "a kernel that cannot carry the beam is told why")


def cliff_of_the_tolerance():
    """Checks that the slider of page 9 finds the height at which the listing's tolerance ends, 4 mm / 256."""
    open_scene("09-wrong", 1200)
    stays = {}
    for mm in (0.005, 0.015, 0.016, 0.1):
        value(f"scenes[0].range.value = '{mm}', scenes[0].range.dispatchEvent(new Event('input'))")
        stays[mm] = value("Number(scenes[0].plot.querySelector('.gold').dataset.stays)")
        told_tip = value("Number(scenes[0].words.querySelector('b').dataset.value)")
        bent = value("scenes[0].picture.querySelector('.member').getBBox().height")
        check(abs(stays[mm] - 1000 * abs(told_tip)) < 1e-9 and (bent > 10) == (mm < 4 / 256), f"plot and beam show what the words say: {stays[mm]}, {told_tip}, {bent} px")
    for mm in (0.005, 0.015):
        check(abs(stays[mm] - mm * 5e4 * 8 / 3e4) < 1e-9, f"lower by {mm} mm, {stays[mm]} mm stay: k times the height, times L^3 / (3 EI)")
    check(max(stays[0.016], stays[0.1]) < 1e-9 and 0.015 < 4 / 256 < 0.016, f"beyond 4 mm / 256 nothing stays: {stays}")


SCENES = json.loads((ROOT / "reference/course/scenes/scenes.json").read_text(encoding="utf-8"))
open_page()
try:
    about = answer_of("about")["result"]
    check(about["floating_point"] == "strict", f"floating point in the page: {about['floating_point']}")
    lapacks_are_the_same(about["lapack"])
    for problem in sorted(path for folder in ("", "divergences/") for path in PROBLEMS.glob(f"{folder}*.toml")):
        for kernels in KERNELS if not problem.with_suffix(".mtx").exists() else ():  # the page cannot read a second file
            compare_run(str(problem.relative_to(ROOT)), kernels)
    for part in (replay_golden_set, errors_have_their_places, lesson_on_a_phone, lesson_opens_on_the_question, lesson_steps, lesson_steps_into, lesson_ignores,
                 lesson_labels, lesson_by_keyboard, lesson_of_two_rules, opens_on_a_problem, takes_back, menu, dragging, messages, plates, pressed_stops, events_by_keyboard,
                 story, links, report):
        part()
    for width in (1300, 400):
        for dark in (False, True):
            shape(width, dark)
    for part in (long_beam, course_pages, pictures_are_whole, loads_are_exact, shell_of_the_course, readme_has_the_bent_beam, an_hour, scene_by_hand, dots_of_a_tie, beside_the_listing, cliff_of_the_tolerance, judge_of_kernels, workshop):
        part()
    check(not browser.errors, f"the page reports no error: {browser.errors[:3]}")
    outside = [r for r in browser.requests if not r.startswith(("file://", "data:", "about:", "blob:"))]
    check(not outside and len(browser.requests) >= 50, f"of {len(browser.requests)} requests none leaves the files: {outside[:3]}; allowed: at least 50")
    check(100_000 < page.stat().st_size < 6_000_000, f"the page has {page.stat().st_size} bytes; allowed: less than 6,000,000")
finally:
    browser.close()
check.end(1_300, **LEAST)
