"""Opens pages of `contct run --html` in a browser without a window and uses them as a person would.
usage: python3 check_pages.py WORK      (WORK holds NAME.html and NAME.json of each run; pictures go there)"""
import json
import os
import re
import sys
import time

from devtools import Browser

work = sys.argv[1]
browser = Browser()
failures, checked = [], 0


def check(true, what):
    global checked
    checked += 1
    if not true:
        failures.append(what)
        print(f"   FAILED: {what}")


def result_of(name):
    with open(os.path.join(work, name + ".json"), encoding="utf-8") as file:
        return json.load(file)


def open_page(name, **how):
    browser.errors.clear()
    browser.requests.clear()
    path = os.path.join(work, name + ".html")
    browser.open(path, **how)
    check(browser.requests == ["file://" + os.path.abspath(path)], f"{name}: nothing but the page is asked for: {browser.requests}")


def quiet(name):
    check(browser.errors == [], f"{name}: the console is silent: {browser.errors}")


def go_to(state):
    browser.value(f"""(() => {{ const s = document.getElementById('slider'); s.value = '{state}';
                      s.dispatchEvent(new Event('input')); }})()""")


def frames():
    return browser.value("frames.map(f => ({step: f.step, number: f.number, end: f.end}))")


# ---- the slider, by mouse and by keyboard ----

def slider_moves(name):
    open_page(name)
    last = len(frames()) - 1
    state = lambda: browser.value("document.getElementById('state').textContent")
    value = lambda: int(browser.value("document.getElementById('slider').value"))
    check(value() == last, f"{name}: the page opens at the end")
    browser.value("document.getElementById('slider').focus()")
    said = [state()]
    for key, expected in (("Home", 0), ("ArrowRight", 1), ("ArrowRight", min(2, last)), ("ArrowLeft", min(2, last) - 1), ("End", last)):
        browser.press(key)
        check(value() == expected, f"{name}: {key} goes to {expected}, is at {value()}")
        said.append(state())
    check(said[1].startswith("Before any load."), f"{name}: the start is told: {said[1]}")
    check(said[0] == said[-1] and len(set(said)) > 1, f"{name}: the words follow the slider")
    text = browser.value("document.getElementById('slider').getAttribute('aria-valuetext')")
    check(f"state {last + 1} of {last + 1}" in text, f"{name}: the slider says where it is: {text}")
    for button, expected in (("first", 0), ("next", 1), ("back", 0), ("last", last)):
        browser.value(f"document.getElementById('{button}').focus()")
        browser.press("Enter", text="\r")
        check(value() == expected, f"{name}: Enter on {button} goes to {expected}, is at {value()}")
    quiet(name)


def playing(name, calm):
    open_page(name, calm=calm)
    go_to(0)
    browser.value("document.getElementById('play').focus()")
    browser.press(" ", code="Space", text=" ")
    check(browser.value("document.getElementById('play').getAttribute('aria-pressed')") == "true", f"{name}: it plays")
    end = time.monotonic() + 30
    while browser.value("current") < 2 and time.monotonic() < end:
        time.sleep(0.1)
    check(browser.value("current") >= 2, f"{name}: playing goes on{', calmly' if calm else ''}")
    browser.press(" ", code="Space", text=" ")
    check(browser.value("timer") == 0, f"{name}: it can be stopped")
    quiet(name)


# ---- the numbers ----

def numbers_match(name):
    open_page(name)
    result = result_of(name)
    numbers = "[...document.querySelectorAll('#pair-table tbody tr')].map(r => [...r.children].map(c => c.dataset.value))"
    ends = 0
    for i, frame in enumerate(frames()):
        if not frame["end"]:
            continue
        step = result["steps"][frame["step"] - 1]
        go_to(i)
        ends += 1
        largest = max(step["w"], key=abs)
        shown = browser.value("[...document.querySelectorAll('[data-reading]')].map(d => [d.dataset.reading, d.dataset.value])")
        by_name = {k.split(",")[0]: float(v) for k, v in shown}
        check(by_name["Share of the step"] == step["fraction"], f"{name}, step {frame['step']}: share")
        check(by_name["Largest w"] == largest, f"{name}, step {frame['step']}: largest deflection {by_name} {largest}")
        rows = browser.value(numbers)
        check(len(rows) == len(step["pairs"]), f"{name}, step {frame['step']}: every pair has its row")
        for row, pair in zip(rows, step["pairs"]):
            same = int(row[1]) == pair["node"] and float(row[5]) == pair["gap"] and float(row[6]) == pair["force"]
            check(same, f"{name}, step {frame['step']}, pair {pair['pair']}: page has {row}, result {pair}")
        check(browser.value("JSON.stringify(frames[current].w)") == json_of(step["w"]) or len(step["displacement"]) % 3 == 0,
              f"{name}, step {frame['step']}: every deflection")
    check(ends == len(result["steps"]), f"{name}: the end of every step can be seen")
    increments = [i for s in result["steps"] for i in s["increments"]]
    rows = browser.value("[...document.querySelectorAll('#event-table tbody tr')].map(r => [...r.children].map(c => c.dataset.value || c.textContent))")
    check(len(rows) == len(increments), f"{name}: every increment has its row")
    for row, increment in zip(rows, increments):
        same = float(row[1]) == increment["fraction"] and (increment.get("snap") or float(row[2]) == increment["s"])
        events = "; ".join(f"pair {e['pair']} {'makes' if e['change'] == 'make' else 'breaks'} contact (node {e['node']}, {e['surface']})"
                           for e in increment["events"][:8])
        check(same and row[4].startswith(events or "–"), f"{name}: increment {row} is {increment}")
    calls = browser.value("[...document.querySelectorAll('#call-table tbody tr')].map(r => [...r.children].map(c => c.dataset.value || c.textContent))")
    check(len(calls) == result["lockstep"]["calls"], f"{name}: every call has its row")
    check(all(row[3] == "0" and row[4] == "0" and row[6] == "0" for row in calls), f"{name}: every call is equal to the bit")
    check(sum(int(row[5]) for row in calls) == result["lockstep"]["values_compared"], f"{name}: all values compared are told")
    quiet(name)


def json_of(numbers):
    return browser.value(f"JSON.stringify({json.dumps(numbers)})")


# ---- how it looks ----

def luminance(colour):
    parts = [int(x) / 255 for x in re.findall(r"\d+", colour)[:3]]
    linear = [p / 12.92 if p <= 0.03928 else ((p + 0.055) / 1.055) ** 2.4 for p in parts]
    return 0.2126 * linear[0] + 0.7152 * linear[1] + 0.0722 * linear[2]


def contrast(a, b):
    high, low = sorted((luminance(a), luminance(b)), reverse=True)
    return (high + 0.05) / (low + 0.05)


def colours(name):
    papers = []
    for dark in (False, True):
        open_page(name, dark=dark)
        colour = lambda what, property: browser.value(f"getComputedStyle(document.querySelector('{what}')).{property}")
        paper, panel = colour("body", "backgroundColor"), colour(".picture", "backgroundColor")
        papers.append(luminance(paper))
        for what, behind, least in (("body", paper, 7), ("#size", paper, 4.5), (".verdict li", paper, 4.5), ("td", panel, 7), ("svg .axis-word", panel, 4.5)):
            property = "fill" if what.startswith("svg") else "color"
            ratio = contrast(colour(what, property), behind)
            check(ratio >= least, f"{name}, {'dark' if dark else 'light'}: contrast of {what} is {ratio:.1f}, allowed from {least}")
        for what in (".beam", ".pair-open", ".track"):
            ratio = contrast(colour("svg " + what, "stroke"), panel)
            check(ratio >= 3, f"{name}, {'dark' if dark else 'light'}: contrast of {what} is {ratio:.1f}, allowed from 3")
        browser.picture(os.path.join(work, f"{name}-{'dark' if dark else 'light'}.png"))
    check(papers[0] > 0.8 and papers[1] < 0.1, f"{name}: light is light and dark is dark")
    quiet(name)


# Texts of one picture must not lie on each other: boxes, a little smaller than drawn.
overlaps = """[...document.querySelectorAll('.picture svg')].flatMap(s => {
  const boxes = [...s.querySelectorAll('text')].map(t => [t.textContent, t.getBoundingClientRect()]);
  const found = [];
  boxes.forEach(([a, p], i) => boxes.slice(i + 1).forEach(([b, q]) => {
    const x = Math.min(p.right, q.right) - Math.max(p.left, q.left), y = Math.min(p.bottom, q.bottom) - Math.max(p.top, q.top);
    if (x > 1 && y > 4) found.push(a + ' / ' + b);
  }));
  const edge = s.getBoundingClientRect();
  boxes.forEach(([a, p]) => { if (p.left < edge.left - 1 || p.right > edge.right + 1 || p.top < edge.top - 2 || p.bottom > edge.bottom + 2) found.push(a + ' is cut'); });
  return found;
})"""


def nothing_overlaps(name):
    for width in (1400, 1000, 360):
        open_page(name, width=width)
        count = len(frames())
        for state in sorted({0, 1, count // 2, count - 1}):
            go_to(state)
            found = browser.value(overlaps)
            check(found == [], f"{name}, {width} wide, state {state}: labels lie on each other: {found[:4]}")
        inside = browser.value("document.documentElement.scrollWidth <= document.documentElement.clientWidth")
        check(inside, f"{name}, {width} wide: the page does not scroll sideways")
        if width == 360:
            browser.picture(os.path.join(work, f"{name}-narrow.png"))
    quiet(name)


def looks_differ_in_shape(name):
    open_page(name)
    shapes = {}
    for state in range(len(frames())):
        go_to(state)
        for kind, tag in browser.value("[...document.querySelectorAll('#picture .pair-open, #picture .pair-closed, #picture .pair-face')].map(m => [m.classList[0], m.tagName])"):
            shapes.setdefault(kind, set()).add(tag)
    check({k: sorted(v) for k, v in shapes.items()} == {"pair-open": ["circle"], "pair-closed": ["rect"], "pair-face": ["path"]},
          f"{name}: open, closed and at the face have shapes of their own: {shapes}")


def prints(name):
    open_page(name, dark=True)
    go_to(0)
    pdf = browser.pdf()
    with open(os.path.join(work, name + ".pdf"), "wb") as out:
        out.write(pdf)
    pages = len(re.findall(rb"/Type\s*/Page\b", pdf))
    check(pdf.startswith(b"%PDF") and 2 <= pages <= 40, f"{name}: it prints on paper, {pages} pages")
    check(browser.value("current === frames.length - 1"), f"{name}: what is printed is the final state")
    quiet(name)


# ---- for who cannot see it ----

def can_be_read_aloud(name):
    open_page(name)
    browser.send("Accessibility.enable")
    nodes = browser.send("Accessibility.getFullAXTree")["nodes"]
    browser.send("Accessibility.disable")
    of = lambda role: [n for n in nodes if n.get("role", {}).get("value") == role and not n.get("ignored")]
    named = lambda n: bool(n.get("name", {}).get("value", "").strip())
    for role in ("button", "slider", "image", "combobox", "region", "table"):
        nameless = [n for n in of(role) if not named(n)] if role != "table" else []
        check(not nameless, f"{name}: every {role} has a name")
    check(len(of("slider")) == 1 and len(of("status")) == 1 and len(of("image")) >= 2, f"{name}: slider, status and pictures are there")
    live = [p for n in of("status") for p in n.get("properties", []) if p["name"] == "live"]
    check(any(p["value"]["value"] == "polite" for p in live), f"{name}: changes are read out")
    check(len(of("columnheader")) >= 5 and len(of("rowheader")) >= 1, f"{name}: tables have their heads")
    levels = browser.value("[...document.querySelectorAll('h1,h2,h3')].map(h => h.tagName).join(' ')")
    check(levels.startswith("H1 H2") and levels.count("H1") == 1, f"{name}: headings: {levels}")
    check(browser.value("document.documentElement.lang") == "en", f"{name}: its language is told")


# ---- the hard ones ----

def markup_is_text(name, title):
    open_page(name)
    check(browser.value("document.querySelector('h1').textContent") == title, f"{name}: the title is shown as it is")
    check(browser.value("document.title") == title, f"{name}: and is the window's")
    check(browser.value("document.scripts.length") == 2 and browser.value("document.querySelectorAll('b').length - document.querySelectorAll('#edition b').length") == 0,
          f"{name}: nothing came of its markup")
    quiet(name)


def opens(name, *words):
    open_page(name)
    for state in range(min(len(frames()), 6)):
        go_to(state)
    text = browser.value("document.body.innerText")
    for piece in words:
        check(piece in text, f"{name}: says \"{piece}\"")
    check("NaN" not in browser.value("document.body.innerHTML.replace(/<script[^]*?<\\/script>|<details id=.edition.[^]*?<\\/details>/g, '')"), f"{name}: no number is none")
    quiet(name)


def stays_small(name, most_bytes, words):
    size = os.path.getsize(os.path.join(work, name + ".html"))
    check(size <= most_bytes, f"{name}: {size} bytes; allowed: {most_bytes}")
    open_page(name)
    states = len(frames())
    check(20 <= states <= 120, f"{name}: {states} states")
    elements = browser.value("document.querySelectorAll('*').length")
    check(elements <= 50_000, f"{name}: {elements} elements in the page")
    for state in (0, states // 2, states - 1):
        go_to(state)
        drawn = browser.value("document.querySelectorAll('#picture *').length")
        points = browser.value("[...document.querySelectorAll('#picture path')].reduce((n, p) => n + p.getAttribute('d').split(/[ML]/).length, 0)")
        check(0 < drawn <= 7000, f"{name}, state {state}: {drawn} elements are drawn")
        check(0 < points <= 40_000, f"{name}, state {state}: {points} points are drawn")
    left_out = browser.value("document.getElementById('thinned').innerText")
    for piece in words:
        check(piece in left_out, f"{name}: says what it leaves out: \"{piece}\" in {left_out}")
    quiet(name)


try:
    for problem in ("pb01", "pb05", "pb07", "pp05a", "pp03e"):
        slider_moves(problem)
        numbers_match(problem)
        nothing_overlaps(problem)
    for problem in ("pb05", "pp05a"):
        prints(problem)
        can_be_read_aloud(problem)
    colours("pb05")
    looks_differ_in_shape("pb07")
    looks_differ_in_shape("pp05a")
    playing("pb07", False)
    playing("pb07", True)
    nothing_overlaps("free")
    markup_is_text("free", "A free beam & <b>markup</b> \"quoted\" </script><script>alert(1)</script> {{data}}")
    opens("alone", "One kernel ran")
    opens("no-pairs", "The problem has no contact pairs.", "no-pairs.toml")
    opens("mechanism", "Not solved", "no equilibrium")
    opens("never", "never called")
    opens("own-ways", "single calls were not compared")
    opens("corrected", "All load is applied.")
    stays_small("long", 6_000_000, ["of 5001 nodes", "300 of 1000 pairs", "increments; the slider stops at", "the first 1200 are listed"])
    stays_small("wide", 6_000_000, ["of 5041 nodes"])
finally:
    browser.close()
print(f"   {checked} checks, {len(failures)} failed")
sys.exit(1 if failures else 0)
