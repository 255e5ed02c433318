"""Opens pages of `contct run --html` in a browser without a window and uses them as a person would.
usage: python3 check_pages.py WORK      (WORK holds NAME.html and NAME.json of each run; pictures go there)"""
import hashlib
import json
import math
import os
import re
import subprocess
import sys
import time
import xml.etree.ElementTree as ElementTree

from devtools import Browser, Checks

work = sys.argv[1]
browser, check = Browser(), Checks()


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
    for word in ("undefined", "[object") if name == "the parallel edition" else ("undefined", "[object", "NaN"):
        check(word not in browser.value("document.body.innerText"), f"{name}: nothing on the page is {word}")
    check(browser.errors == [], f"{name}: the console is silent: {browser.errors}")


def go_to(state):
    browser.enter("slider", str(state))


def frames():
    return browser.value("frames.map(f => ({step: f.step, number: f.number, end: f.end}))")


# ---- units and the envelope ----

def has_envelope(name):
    open_page(name)
    check("m, kN" in browser.value("document.getElementById('title-block').innerText"), f"{name}: the units are named")
    check("it sinks" in browser.value("document.getElementById('ends').innerText"), f"{name}: a step has its name")
    shown = [float(v) for v in browser.value("[...document.querySelectorAll('#envelope [data-value]')].map(e => e.dataset.value)")]
    envelope = result_of(name)["envelope"]
    known = {v[bound]["value"] for v in envelope.values() if isinstance(v, dict) and "min" in v for bound in ("min", "max")}
    known |= {p["force_max"] for p in envelope["pairs"]}
    known |= {r[bound]["value"] for r in envelope["reactions"] for bound in ("min", "max")}
    check(known <= set(shown), f"{name}: the page has every number of the envelope: {known - set(shown)}")
    check(len(known) >= 10, f"{name}: {len(known)} numbers were compared")
    quiet(name)


# ---- the slider, by mouse and by keyboard ----

def slider_moves(name):
    open_page(name)
    last = len(frames()) - 1
    state = lambda: browser.value("document.getElementById('state').textContent")
    value = lambda: int(browser.value("document.getElementById('slider').value"))
    largest = browser.value("Math.max(...frames.map(f => Math.abs(mostOf(f).value)))")
    check(browser.value("Math.abs(mostOf(frames[current]).value)") == largest, f"{name}: the page opens at the largest deflection")
    go_to(last)
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
    for button, expected in (("back", last - 1), ("next", last), ("back", last - 1)):
        browser.value(f"document.getElementById('{button}').focus()")
        browser.press("Enter", text="\r")
        check(value() == expected, f"{name}: Enter on {button} goes to {expected}, is at {value()}")
    quiet(name)



def numbers_match(name):
    open_page(name)
    result = result_of(name)
    numbers = "[...document.querySelectorAll('#pairs tbody tr')].map(r => [...r.children].map(c => c.dataset.value || c.textContent))"
    ends = 0
    for i, frame in enumerate(frames()):
        if not frame["end"]:
            continue
        step = result["steps"][frame["step"] - 1]
        go_to(i)
        ends += 1
        rows = browser.value(numbers)
        check(len(rows) == len(step["pairs"]), f"{name}, step {frame['step']}: every pair has its row")
        for row, pair in zip(rows, step["pairs"]):
            same = row[1] == str(pair.get("node", pair.get("dof"))) and float(row[5]) == pair["gap"] and float(row[6]) == pair["force"]
            check(same, f"{name}, step {frame['step']}, pair {pair['pair']}: page has {row}, result {pair}")
        if name in structures:
            check_structure(name, step)
        check(browser.value("JSON.stringify(frames[current].u)") == json_of(step["displacement"]), f"{name}, step {frame['step']}: every displacement")
    check(ends == len(result["steps"]), f"{name}: the end of every step can be seen")
    tables_match(name, result)
    increments = [i for s in result["steps"] for i in s["increments"]]
    rows = browser.value("[...document.querySelectorAll('#events tr[data-increment]')].map(r => [...r.children].map(c => c.dataset.value || c.textContent))")
    check(len(rows) == len(increments), f"{name}: every increment has its row")
    for row, increment in zip(rows, increments):
        same = float(row[1]) == increment["fraction"] and (increment.get("snap") or float(row[2]) == increment["s"])
        events = "; ".join(f"pair {e['pair']} {'makes' if e['change'] == 'make' else 'breaks'} contact ({'dof ' + e['dof'] if 'dof' in e else 'node ' + str(e['node'])}, {e['surface']})"
                           for e in increment["events"][:8])
        check(same and row[4].startswith(events or "–"), f"{name}: increment {row} is {increment}")
    pairs = len(result["steps"][0]["pairs"])
    calls = browser.value("[...document.querySelectorAll('#comparison tbody tr')].map(r => [...r.children].map(c => c.dataset.value || c.textContent))")
    check(len(calls) == result["lockstep"]["calls"], f"{name}: every call has its row")
    check(pairs == 0 or all(row[3] == "0" and row[4] == "0" and row[6] == "0" for row in calls), f"{name}: every call is equal to the bit")
    check(sum(int(row[5]) for row in calls) == result["lockstep"]["values_compared"], f"{name}: all values compared are told")
    quiet(name)


def is_moment(dof):
    """Whether the dof of a support turns: "theta", "wx", "6.r" or "185.4"."""
    return re.search(r"theta|^w[xy]|[.]r|[.][456]$", dof) is not None


def tables_match(name, result):
    """The tables of the steps' ends have the numbers of the result, digit for digit."""
    tables = browser.value("""[...document.querySelectorAll('#ends table')].map(t => [t.getAttribute('aria-label'),
        [...t.tBodies[0].rows].map(r => [...r.cells].map(c => [...c.querySelectorAll('[data-value]')].map(v => v.dataset.value)
          .concat(c.dataset.value || [], c.textContent)))])""")
    sums = [rows for caption, rows in tables if caption.startswith("Sums of forces")]
    ends = next(rows for caption, rows in tables if caption.startswith("Largest values"))
    heads = browser.value("[...[...document.querySelectorAll('#ends table')].find(t => t.ariaLabel.startsWith('Largest values')).tHead.rows[0].cells].map(c => c.textContent)")
    kinds = {is_moment(r["dof"]) for s in result["steps"] for r in s["reactions"]}
    check(sum("eaction" in head for head in heads) == (1 if name == "bare" else len(kinds)), f"{name}: forces and moments of supports have columns of their own: {heads}")
    for row, step in zip(*sums, result["steps"]) if sums else ():
        check([float(cell[0]) for cell in row[1:]] == [step["balance"][key] for key in ("loads", "reactions", "contact")], f"{name}: sums of step {step['step']}: {row}")
    check(len(ends) == len(result["steps"]), f"{name}: every step's end has its row")
    for row, step in zip(ends, result["steps"]):
        check(float(row[1][0]) == step["fraction"], f"{name}: share of step {step['step']}: {row[1]}")
        for head, kind in zip(heads, row):
            if "eaction" in head:
                reaction = max((r["value"] for r in step["reactions"] if is_moment(r["dof"]) == ("moment" in head) or name == "bare"), key=abs)
                check(float(kind[0]) == reaction, f"{name}: largest value of {head} of step {step['step']}: {kind}, {reaction}")
        for i, quantity in enumerate(("w", "moment", "shear") if name.startswith("pb") else ("w",)):
            allowed = [step["extremes"][quantity][end]["value"] for end in ("min", "max")]
            check(all(float(v) in allowed for v in row[2 + i][:-1]), f"{name}: {quantity} of step {step['step']}: {row[2 + i]}, {allowed}")
    own = set(browser.value("structure.pairs.filter(p => !p.bed).map(p => p.pair)"))
    for title, most, known_of in (("Contact forces of beds", 40, lambda s: [p["force"] for p in s["pairs"] if p["pair"] not in own]),
                                  (r"Contact forces( \[|;)", math.inf, lambda s: [p["gap" if p["state"] == "separated" else "force"] for p in s["pairs"] if p["pair"] in own]),
                                  ("Reactions", math.inf, lambda s: [r["value"] for r in s["reactions"]])):
        columns = [[] for _ in result["steps"]]
        begun = 0
        for caption, rows in tables[1:]:
            if not re.match(title, caption):
                continue
            width = min(6, len(columns) - begun)
            for i in range(width):
                columns[begun + i] = [float(r[len(r) - width + i][0]) for r in rows]
            begun += width
        for column, step in zip(columns, result["steps"]):
            known = known_of(step)
            check(len(column) == min(most, len(known)) and (len(known) > most and set(column) <= set(known) or column == known),
                  f"{name}: {title.lower()} of step {step['step']}: {column}, {known}")


# The structures that are given by matrices: True if the page draws the structure.
structures = {"frame": True, "console": True, "bare": False}


def check_structure(name, step):
    """Every pair is drawn at its displaced node; a structure without coordinates is not drawn."""
    where = f"{name}, step {step['step']}"
    if not structures[name]:
        check(browser.value("document.getElementById('picture').children.length") == 0, f"{where}: nothing is drawn")
        return
    # The mark of a pair must be at the displaced position of its node, with the displacement magnified.
    off = browser.value("""(() => {
      const f = frames[current], marks = [...document.querySelectorAll('#picture .pair-open, #picture .pair-closed, #picture .pair-face')];
      return Math.max(...leastLoadedFirst(pairsOf(f)).map((p, i) => {
        const box = marks[i].getBBox(), [x, y] = page.spot(projected(movedTo(f, p.at, scene.times)));
        return Math.hypot(box.x + box.width / 2 - x, box.y + box.height / 2 - y);
      }));
    })()""")
    check(off < 0.1, f"{where}: pairs' marks are {off} pixels from their nodes")


def json_of(numbers):
    return browser.value(f"JSON.stringify({json.dumps(numbers)})")


# ---- appearance ----

def luminance(colour):
    parts = [int(x) / 255 for x in re.findall(r"\d+", colour)[:3]]
    linear = [p / 12.92 if p <= 0.03928 else ((p + 0.055) / 1.055) ** 2.4 for p in parts]
    return 0.2126 * linear[0] + 0.7152 * linear[1] + 0.0722 * linear[2]


def contrast(a, b):
    high, low = sorted((luminance(a), luminance(b)), reverse=True)
    return (high + 0.05) / (low + 0.05)


def colours(name, lines=(".member", ".pair-open", ".track")):
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
        for what in lines:
            ratio = contrast(colour("svg " + what, "stroke"), panel)
            check(ratio >= 3, f"{name}, {'dark' if dark else 'light'}: contrast of {what} is {ratio:.1f}, allowed from 3")
        browser.picture(os.path.join(work, f"{name}-{'dark' if dark else 'light'}.png"))
    check(papers[0] > 0.8 and papers[1] < 0.1, f"{name}: light is light and dark is dark")
    quiet(name)


# Texts of a picture must not overlap. The boxes are a little smaller than the texts.
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


def most_loaded_pair_is_on_top(name):
    open_page(name)
    wrong = browser.value("""frames.flatMap((f, i) => { show(i);
        const marks = [...document.querySelectorAll('#picture .pair-open, #picture .pair-face, #picture .pair-closed')].map(m => m.classList[0]);
        const order = marks.map(m => ['pair-open', 'pair-face', 'pair-closed'].indexOf(m));
        return order.some((o, k) => k > 0 && o < order[k - 1]) ? [i] : []; })""")
    check(wrong == [], f"{name}: a separated pair is drawn over one in contact in states {wrong}")


def axes_have_ticks(name):
    open_page(name)
    found = browser.value("[[0, 1], [-0.47, 0.47], [-1e-9, 3e-9], [0, 7e12], [-102, 102], [0.99, 1.01]].map(([a, b]) => ticks(a, b, 4).length)")
    check(min(found) >= 3 and max(found) <= 7, f"{name}: every axis has three ticks or more: {found}")


def looks_differ_in_shape(name):
    open_page(name)
    shapes = {}
    for state in range(len(frames())):
        go_to(state)
        for kind, tag in browser.value("[...document.querySelectorAll('#picture .pair-open, #picture .pair-closed, #picture .pair-face')].map(m => [m.classList[0], m.tagName])"):
            shapes.setdefault(kind, set()).add(tag)
    check({k: sorted(v) for k, v in shapes.items()} == {"pair-open": ["circle"], "pair-closed": ["rect"], "pair-face": ["path"]},
          f"{name}: separated, in contact and at its face have shapes of their own: {shapes}")


def prints(name):
    open_page(name, dark=True)
    go_to(0)
    pdf = browser.pdf()
    with open(os.path.join(work, name + ".pdf"), "wb") as out:
        out.write(pdf)
    pages = len(re.findall(rb"/Type\s*/Page\b", pdf))
    check(pdf.startswith(b"%PDF") and 2 <= pages <= 40, f"{name}: it prints on paper, {pages} pages")
    check(browser.value("current === frames.length - 1"), f"{name}: what is printed is the final state")
    feet = [[line for line in sheet.splitlines() if line.strip()][-2].strip() for sheet in sheets_of(name)]
    headings = browser.value("[...document.querySelectorAll('h2, .caption')].map(h => h.textContent)")
    check(set(feet).isdisjoint(headings), f"{name}: a heading is the last line of a sheet: {set(feet) & set(headings)}")
    quiet(name)


# ---- the report ----

def sheets_of(name):
    """The text of each sheet of paper."""
    path = os.path.join(work, name + ".pdf")
    with open(path, "wb") as out:
        out.write(browser.pdf())
    return subprocess.run(["pdftotext", "-layout", path, "-"], capture_output=True, text=True, check=True).stdout.split("\f")[:-1]


def has_title_and_number_on_each_sheet(name, title):
    open_page(name)
    sheets = sheets_of(name)
    check(len(sheets) >= 4, f"{name}: {len(sheets)} sheets")
    for number, text in enumerate(sheets, 1):
        check(text.lstrip().startswith(title), f"{name}: sheet {number} begins with the title: {text[:90]}")
        check(text.rstrip().endswith(f"page {number} of {len(sheets)}"), f"{name}: sheet {number} ends with its number: {text.rstrip()[-60:]}")
    whole = "".join(sheets)
    order = [whole.find(words) for words in ("The system; distances of faces", "Loads, settlements", "The structure, increment", "Results at the ends")]
    check(-1 not in order and order == sorted(order), f"{name}: sketch, input and results follow one another on paper: {order}")
    check(browser.value("byId('input').previousElementSibling.id") == "envelope", f"{name}: on the screen the input is behind the results again")
    quiet(name)
    return whole


def prints_every_load(name, loads):
    printed = set(re.findall(r"\u2212([\d.]+)", has_title_and_number_on_each_sheet(name, "Slab strip (22 axle places): \"A & B\"")))
    missing = [load for load in loads if str(load).removesuffix(".0") not in printed]
    check(len(loads) == 67 and missing == [], f"{name}: loads that are not printed: {missing}")


def prints_every_quantity(name, title, words):
    text = has_title_and_number_on_each_sheet(name, title)
    for piece in words:
        check(piece in text, f"{name}: the picture of \"{piece}\" is printed")


def has_the_largest_rows(name):
    """If there are more pairs than rows, the table has the largest forces."""
    open_page(name)
    forces = sorted((p["force_max"] for p in result_of(name)["envelope"]["pairs"]), reverse=True)
    shown = browser.value("[...document.querySelectorAll('#envelope table')].find(t => t.ariaLabel.startsWith('Largest contact force')).innerText")
    rows = browser.value("[...[...document.querySelectorAll('#envelope table')].find(t => t.ariaLabel.startsWith('Largest contact force')).querySelectorAll('td:last-child [data-value]')].map(e => Number(e.dataset.value))")
    check(len(forces) > 40 and sorted(rows, reverse=True) == forces[:40], f"{name}: the table of the envelope has the 40 largest of {len(forces)} forces: {shown[:200]}")


def leaves_nothing_out(name):
    """With many combinations and pairs, the page has every step, every [[contact]] and all text of the terminal."""
    open_page(name)
    steps = result_of(name)["steps"]
    table = lambda section, title: browser.value(f"[...document.querySelectorAll('#{section} table')].filter(t => t.ariaLabel.startsWith('{title}')).map(t => [...t.rows].map(r => r.innerText))")
    for title in ("Sums of forces", "Largest values"):
        rows = table("ends", title)[0]
        check(len(rows) == 1 + len(steps) == 28, f"{name}: {title}: every step has its row: {len(rows)}")
    forces = table("ends", "Contact forces [kN]; for a separated pair the gap [m]")
    check([len(rows) for rows in forces] == [3] * 5, f"{name}: both bolts are in every table of forces: {forces}")
    check(all("gap" in rows[2] for rows in forces), f"{name}: the gap of a separated bolt is told: {forces}")
    check(len(table("ends", "Contact forces of beds [kN], 6 of 27 steps")) == 1, f"{name}: the selection of the bed is told where it stands")
    terms = table("input", "Combinations")[0]
    check(terms[1:] == ["1, G alone\t1 G", "2 to 27, fork\t1.35 G + 1.5 fork at 0 to 10 by 0.4, 26 places"], f"{name}: terms of combinations: {terms}")
    loads = [row.split("\t") for row in table("input", "Loads")[0]][1:]
    check([row[2:] for row in loads] == [["all elements", "\u22125"], ["all elements", "\u22126.75"], ["x = 0 to 10 by 0.4, 26 places", "\u2212120"]], f"{name}: each load of the train has a row: {loads}")
    beds = [row.split("\t") for row in table("ends", "Beds")[0]][1:]
    bolts = [sum(p["force"] for p in s["pairs"] if p["surface"] == "above") for s in steps]
    off = [abs(float(row[2].replace("\u2212", "-")) + s["balance"]["loads"] - bolt) for row, s, bolt in zip(beds, steps, bolts)]
    check(len(off) == 27 and max(off) < 1e-4, f"{name}: the bed bears the loads and the bolts: {max(off)}")
    paper = "".join(sheets_of(name))
    check("gap" in paper, f"{name}: gaps are on paper")
    check(not re.search(r"[Cc]lick|[Pp]oint at", paper), f"{name}: nothing on paper is to be clicked")
    quiet(name)


def tells_every_force(name, pairs):
    """Also where there is no room beside the arrow: then with the number of the pair."""
    open_page(name)
    for i, frame in enumerate(frames()):
        go_to(i)
        told = browser.value("[...document.querySelectorAll('#picture text.value')].map(t => t.textContent.split(': ').pop())")
        forces = browser.value("numberedOf(pairsOf(frames[current])).filter(p => Math.abs(p.force) > 1e-3).map(p => rough(p.force))")
        check(all(told.count(force) >= forces.count(force) for force in forces), f"{name}, state {i}: forces {forces}, in the picture {told}")
        pairs -= frame["end"] and len(forces)
    check(pairs <= 0, f"{name}: {pairs} forces less than expected were looked for")
    found = browser.value(overlaps)
    check(found == [], f"{name}: labels lie on each other: {found[:4]}")


def tells_loads_of_beams(name):
    open_page(name)
    text = browser.value("document.getElementById('input').innerText")
    for piece in ("self-weight per length [kN/m]", "Section from x = 0 to 8", "E 210000000 [kN/m²], I 0.0003 [m⁴], A 0.01 [m²], weight 78.5 [kN/m³]",
                  "Cases: loads as in the problem file, without factors"):
        check(piece in text, f"{name}: the input has \"{piece}\": {text[:600]}")
    steps = browser.value("[...document.querySelectorAll('#chart text')].map(t => t.textContent).filter(t => t.startsWith('step'))")
    check(steps == ["step 1, G", "step 2, 2 G"], f"{name}: the paths have the names of their steps: {steps}")
    check(browser.value("document.getElementById('cuts').innerText").startswith("Nothing"), f"{name}: the page leaves nothing out")
    paper = "".join(sheets_of(name))
    check("Nothing:" not in paper and "Not on paper" in paper, f"{name}: paper has one statement about what is left out")
    order = [paper.find(f"Step {step}, increment") for step in ("1, G", "2, 2 G")]
    check(-1 < order[0] < order[1] and paper.count("Deflection [m], drawn") == 2, f"{name}: pictures of steps on paper in ascending order, each once: {order}")


def outlines_loads_of_plates(name):
    """Distributed loads are outlined where they act, and bolts differ from the bed."""
    open_page(name)
    go_to(len(frames()) - 1)
    text = browser.value("document.getElementById('input').innerText")
    check("(0.05, 0.15) to (0.15, 0.3)" in text, f"{name}: places have no digits of rounding: {text[-400:]}")
    off = browser.value("""(() => {
      const [numbers, stands] = [(e) => e.getAttribute('d').match(/[\\d.]+/g).map(Number), frames[current].u];
      const loads = [...document.querySelectorAll('#picture path.load-line')].map(numbers);
      const at = (x, y) => structure.nodes.findIndex(n => Math.abs(n.x - x) < 1e-9 && Math.abs(n.y - y) < 1e-9);
      return [[[0, 0], [0.4, 0], [0.4, 0.4], [0, 0.4]], [[0.05, 0.15], [0.15, 0.15], [0.15, 0.3], [0.05, 0.3]]].map((corners, k) =>
        Math.max(...corners.map(([x, y], c) => { const [X, Y] = page.spot(projected(movedTo(frames[current], at(x, y), scene.times)));
          return Math.hypot(loads[k][48 * c] - X, loads[k][48 * c + 1] - Y); }))); })()""")
    check(max(off) < 0.1, f"{name}: corners of loads are {off} pixels from their nodes")
    values = browser.value("[...document.querySelectorAll('#picture text.value')].map(t => t.textContent)")
    check("\u221250 [kN/m²]" in values and "2000 [kN/m²]" in values, f"{name}: each load has its value: {values}")
    sizes = browser.value("[...document.querySelectorAll('#picture .pair-open, #picture .pair-closed, #picture .pair-face')].map(m => m.getBBox().width)")
    sizes.sort()
    check(len(sizes) == 83 and sizes[-2] > 1.1 * sizes[-3], f"{name}: the marks of the bolts are larger than those of the bed: {sizes[-4:]}")
    heads = browser.value("document.getElementById('ends').innerText")
    for piece in ("S1, lower side (upper: \u2212S2)", "S2, lower side (upper: \u2212S1)", "Von Mises, both sides"):
        check(piece in heads, f"{name}: stresses tell their side: {piece}")
    quiet(name)


def adds_up_by_direction(name, directions):
    """The sums of a structure with all its supports in the file are in equilibrium."""
    open_page(name)
    rows = browser.value("[...[...document.querySelectorAll('#ends table')].find(t => t.ariaLabel.startsWith('Sums by direction')).tBodies[0].rows].map(r => [...r.cells].map(c => c.dataset.value ?? c.textContent))")
    check([row[1] for row in rows] == directions, f"{name}: sums of each direction: {rows}")
    for row in rows:
        loads, reactions, contact = map(float, row[2:])
        check(abs(loads + reactions + contact) <= 1e-9 * (abs(loads) + abs(reactions) + 1), f"{name}: the sums add up to 0: {row}")
    check(sum(float(row[2]) != 0 for row in rows) >= 3, f"{name}: loads are among the sums: {rows}")
    files = browser.value("document.getElementById('input').innerText")
    with open(f"reference/structures/{name}.mtx", "rb") as file:
        digest = hashlib.sha256(file.read()).hexdigest()
    for piece in (f"{name}.mtx", digest, "Entries in this file\t96", f"{name}.dof", f"{name}.xyz", "force\tdof 6.y"):
        check(piece in files, f"{name}: the input has \"{piece}\"")
    moved = browser.value("[...[...document.querySelectorAll('#ends table')].find(t => t.ariaLabel.startsWith('Displacements u')).tBodies[0].rows].map(r => [r.cells[0].textContent, ...[...r.cells].slice(1).map(c => Number(c.dataset.value))])")
    labels = browser.value("structure.dofs.map(d => d.dof)")
    known = [[s["displacement"][labels.index(row[0])] for s in result_of(name)["steps"]] for row in moved]
    turned = browser.value("[...[...document.querySelectorAll('#ends table')].find(t => t.ariaLabel.startsWith('Rotations')).tBodies[0].rows].length")
    check(turned == 11, f"{name}: the rotations of {turned} dofs; allowed: all 11")
    check(len(moved) == 22 and [row[1:] for row in moved] == known, f"{name}: the displacements of all dofs along an axis: {moved[:2]}")
    quiet(name)


def tells_warnings(name):
    """Warnings are shown before the results, on screen and on paper."""
    open_page(name)
    paper = "".join(sheets_of(name))
    for piece in ("the mesh is coarse for this bed", "Half the element size changes w by"):
        check(piece in browser.value("document.getElementById('verdict').innerText"), f"{name}: the page says \"{piece}\"")
        check(-1 < " ".join(paper.split()).find(piece) < " ".join(paper.split()).find("Results at the ends"), f"{name}: before the results on paper it says \"{piece}\"")


def has_envelope_curves(name):
    """Every curve reaches the envelope's extremes, and the tooltip names the step of each extreme."""
    open_page(name)
    envelope = result_of(name)["envelope"]
    for quantity in ("w", "moment", "shear"):
        pieces = browser.value(f"""[...document.querySelectorAll('#curves g')].filter(g => g.querySelector('path.{quantity}')).map(g =>
            [g.querySelector('title').textContent, g.querySelector('path.{quantity}').getAttribute('d').match(/[\\d.]+/g).map(Number)])""")
        dots = browser.value(f"[...document.querySelectorAll('#curves .dot-{quantity}')].map(d => [Number(d.getAttribute('cx')), Number(d.getAttribute('cy'))])")
        extremes = [envelope[quantity]["max"], envelope[quantity]["min"]]
        for dot, extreme in zip(dots, sorted(extremes, key=lambda v: -abs(v["value"]))):
            near = [words for words, numbers in pieces
                    if min(abs(x - dot[0]) + abs(y - dot[1]) for x, y in zip(numbers[::2], numbers[1::2])) < 0.05]
            check(any(f": step {extreme['step']}, " in words for words in near), f"{name}: {quantity}: the pointer is told step {extreme['step']}: {near}")
        check(len(dots) == 2, f"{name}: {quantity} has its extremes marked")
    browser.value("document.querySelector('#curves g path.moment').dispatchEvent(new MouseEvent('click', { bubbles: true }))")
    told = browser.value("document.querySelector('#curves g:has(path.moment) title').textContent")
    check(f"step {browser.value('frames[current].step')}, " in told and browser.value("frames[current].end"), f"{name}: a click shows the step: {told}")
    quiet(name)


def saves_its_picture(name):
    open_page(name)
    file = os.path.join(work, "picture.svg")
    browser.save_to(work)
    browser.value("byId('save').click()")
    end = time.monotonic() + 20
    while not os.path.exists(file) and time.monotonic() < end:
        time.sleep(0.05)
    check(os.path.exists(file), f"{name}: the picture is saved")
    root = ElementTree.parse(file).getroot()
    with open(file, encoding="utf-8") as text:
        check("var(" not in text.read(), f"{name}: the saved picture needs no variables")
    os.rename(file, os.path.join(work, f"{name}-saved.svg"))
    space = "{http://www.w3.org/2000/svg}"
    saved = [p.get("d") for p in root.iter(space + "path")]
    check(root.tag == space + "svg" and saved == browser.value("[...document.querySelectorAll('#picture path')].map(p => p.getAttribute('d'))"),
          f"{name}: the saved picture has the paths of the one shown")
    browser.send("Page.navigate", url="file://" + os.path.abspath(os.path.join(work, f"{name}-saved.svg")))
    browser.wait_for("document.documentElement.tagName === 'svg' && document.readyState === 'complete'")
    stroke = browser.value("getComputedStyle(document.querySelector('.member')).stroke")
    check(stroke == "rgb(29, 29, 27)", f"{name}: opened by itself it has the page's colours: {stroke}")


def pressed_faces_are_where_the_beam_is(name, state):
    """A face in contact is drawn at its node, and the spring begins at the face's original position."""
    open_page(name)
    go_to(state)
    off = browser.value("""frames[current].pairs.filter(p => p.closed && p.force > 0).map(p => {
      const [x, y] = page.on.spot(p), stood = page.Y(p.face), is = (e, at) => Math.abs((Number(e.getAttribute('x1')) + Number(e.getAttribute('x2'))) / 2 - x) < 0.1 &&
        Math.abs(Number(e.getAttribute('y1')) - at) < 0.1 && Math.abs(Number(e.getAttribute('y2')) - at) < 0.1;
      const has = (kind, at) => [...document.querySelectorAll('#picture ' + kind)].some(e => is(e, at));
      return has('.face-line', y) && has('.spring', stood) && Math.abs(stood - y) > 3 ? '' : `pair ${p.pair}`; })""")
    check(len(off) == 3 and off == [""] * 3, f"{name}, state {state}: faces in contact: {off}")


def tells_sums_of_forces(name):
    """The page has the sums of loads, reactions and contact forces if the result has them."""
    open_page(name)
    browser.value("(() => { result.steps[0].balance = { loads: -601.25, reactions: 600, contact: 1.25 }; showRest(); })()")
    rows = browser.value("[...document.querySelectorAll('#ends table')].filter(t => t.ariaLabel.startsWith('Sums of forces')).map(t => [...t.querySelectorAll('td')].map(c => Number(c.dataset.value)))")
    check([row[:3] for row in rows] == [[-601.25, 600, 1.25]], f"{name}: sums of loads, reactions and contact forces: {rows}")


def tables_fit(name):
    """Short tables are not cut, and long names do not widen a table."""
    open_page(name, width=1300)
    cut = browser.value("[...document.querySelectorAll('.scroll.whole')].filter(e => e.scrollHeight > e.clientHeight + 1 && e.offsetParent).map(e => e.ariaLabel)")
    check(cut == [], f"{name}: short tables that are cut: {cut}")
    wide = browser.value("[...document.querySelectorAll('#ends .scroll, #envelope .scroll, #input .scroll')].filter(e => e.scrollWidth > e.clientWidth + 1).map(e => e.ariaLabel)")
    check(wide == [], f"{name}: tables wider than the page: {wide}")
    close = browser.value("""[...document.querySelectorAll('#ends, #envelope, #input')].flatMap(s => [...s.querySelectorAll('.scroll')].slice(1)
        .filter(e => e.getBoundingClientRect().top - e.previousElementSibling.getBoundingClientRect().bottom < 8).map(e => e.ariaLabel))""")
    check(close == [], f"{name}: tables that touch: {close}")


def shows_true_maxima(name, state, moment, place):
    """The moment's line reaches its largest value, which is between two nodes."""
    open_page(name)
    go_to(state)
    reached = browser.value("""(() => {
      const numbers = document.querySelector('#picture path.moment').getAttribute('d').match(/[\\d.]+/g).map(Number);
      const ys = numbers.filter((_, i) => i % 2 === 1), dot = document.querySelector('#picture .dot-moment'), top = Math.min(...ys);
      const off = ys.map((y, i) => (y < top + 0.02 ? Math.abs(numbers[2 * i] - Number(dot.getAttribute('cx'))) : Infinity));
      return [Math.abs(top - Number(dot.getAttribute('cy'))), Math.min(...off)];
    })()""")
    check(max(reached) < 0.02, f"{name}: the highest point of the moment's line is {reached} pixels from its largest value")
    words = [w for w in browser.value("[...document.querySelectorAll('#picture text.value')].map(t => t.textContent)") if f"{moment} at x = {place}" in w]
    check(len(words) == 1, f"{name}: the largest moment is told with its place: {words}")
    quiet(name)


def fields_can_be_chosen(name, fields):
    open_page(name)
    check(browser.value("[...document.getElementById('field').options].map(o => o.value)") == fields, f"{name}: {fields} can be shown")
    seen = set()
    for field in fields:
        browser.enter("field", field, "change")
        seen.add(browser.value("[...document.querySelectorAll('#picture path[fill^=rgb]')].map(p => p.getAttribute('d').length).join()"))
        found = browser.value(overlaps)
        check(found == [], f"{name}, {field}: labels lie on each other: {found[:4]}")
        browser.picture(os.path.join(work, f"{name}-{field}.png"), whole=False)
    check(len(seen) == len(fields), f"{name}: {len(fields)} quantities, {len(seen)} pictures")
    quiet(name)


def picture_of_readme_is_up_to_date(name):
    """reference/run.svg has the beam and its path as the page draws them, with the page's colours."""
    open_page(name, width=1000)
    go_to(len(frames()) - 1)
    picture = browser.value("""(() => {
      const rules = document.querySelector('style').textContent.match(/^(:root[^{]*|svg [^{]*) {[^}]*}/gm).join('\\n');
      const inside = id => [...document.querySelector(id + ' svg').children].map(e => new XMLSerializer().serializeToString(e)).join('\\n');
      const [width, beam, path] = [widthOf(byId('picture')), page.bottom + 30, document.querySelector('#chart svg').viewBox.baseVal.height];
      return `<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 ${width} ${beam + path}" role="img">\\n<style>${rules}\\n` +
        `svg { background: var(--panel); font-family: "DejaVu Sans", Arial, sans-serif; }</style>\\n<svg height="${beam}">${inside('#picture')}</svg>\\n` +
        `<svg y="${beam}">${inside('#chart')}</svg>\\n</svg>\\n`;
    })()""").replace(' xmlns="http://www.w3.org/2000/svg"', "").replace("<svg", '<svg xmlns="http://www.w3.org/2000/svg"', 1)
    with open(os.path.join(work, "run.svg"), "w", encoding="utf-8") as out:
        out.write(picture)
    with open("reference/run.svg", encoding="utf-8") as file:
        check(file.read() == picture, f"reference/run.svg is not what the page draws, which is in {out.name}")


def edition_is_a_page():
    for width in (1180, 400):
        browser.errors.clear()
        browser.open("reference/parallel-edition.html", width=width)
        inside = browser.value("document.documentElement.scrollWidth <= document.documentElement.clientWidth")
        check(inside and browser.value("document.title") == "CONTCT: the parallel edition", f"the parallel edition, {width} wide, is a page")
    quiet("the parallel edition")


# ---- accessibility ----

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


# ---- hostile and large problems ----

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


# ---- structures given by matrices ----

def stands_where_it_was(name, view):
    """Before any load both lines of the structure are equal; later they differ. Pairs, faces and supports are marked."""
    open_page(name)
    check(browser.value("view") == view, f"{name}: it is looked at from where it shows most")
    lines = "['.was', '.member'].map(k => document.querySelector('#picture ' + k).getAttribute('d'))"
    go_to(0)
    was, now = browser.value(lines)
    check(was == now, f"{name}: unloaded it stands where it was")
    go_to(2)
    check(browser.value(lines)[0] == was and browser.value(lines)[1] != was, f"{name}: loaded it has moved from there")
    pairs, supports, still = browser.value("[places.pairs.length, places.supports.length, scene.still.length]")
    count = lambda kind: browser.value(f"document.querySelectorAll('#picture {kind}').length")
    check(count(".face-line") == pairs, f"{name}: a face for each pair")
    marked = browser.value("[...document.querySelectorAll('#picture title')].filter(t => t.textContent.startsWith('Support ')).length")
    check(marked == supports, f"{name}: a mark for each support")
    check(browser.value("(document.querySelector('#picture .still')?.getAttribute('d').match(/M/g) || []).length") == still,
          f"{name}: a cross for each node without a dof")
    check(count(".pair-closed") + count(".pair-open") + count(".pair-face") == pairs, f"{name}: a mark for each pair")
    quiet(name)


def stays_small(name, most_bytes, words, most_points=40_000):
    size = os.path.getsize(os.path.join(work, name + ".html"))
    check(size <= most_bytes, f"{name}: {size} bytes; allowed: {most_bytes}")
    open_page(name)
    states = len(frames())
    check(4 <= states <= 120, f"{name}: {states} states")
    elements = browser.value("document.querySelectorAll('*').length")
    check(elements <= 60_000, f"{name}: {elements} elements in the page")
    for state in (0, states // 2, states - 1):
        go_to(state)
        drawn = browser.value("document.querySelectorAll('#picture *').length")
        points = browser.value("[...document.querySelectorAll('#picture path')].reduce((n, p) => n + p.getAttribute('d').split(/[ML]/).length, 0)")
        check(0 < drawn <= 7000, f"{name}, state {state}: {drawn} elements are drawn")
        check(0 < points <= most_points, f"{name}, state {state}: {points} points are drawn")
    left_out = browser.value("document.getElementById('cuts').innerText")
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
    shows_true_maxima("pb07", 6, "167.98", "3.7004")
    fields_can_be_chosen("pp05a", ["w", "mx", "my", "mxy", "pressure"])
    picture_of_readme_is_up_to_date("pb07")
    edition_is_a_page()
    has_envelope("settling")
    with open(os.path.join(work, "strip.toml"), encoding="utf-8") as file:
        prints_every_load("strip", [float(w) for w in re.findall(r"w = -([\d.]+)", file.read())])
    prints_every_quantity("pp05a", "PP5a Free square plate on a tensionless bed, 8 x 8 to a quarter",
                          ["Deflection w", "Moment mx", "Moment my", "Twisting moment mxy", "Foundation pressure"])
    prints_every_quantity("strip", "Slab strip", ["Moment, positive", "Shear, of the left", "Bed's pressure [kN/m]", "EI from x = 0 to 24", "20000"])
    has_the_largest_rows("strip")
    has_envelope_curves("strip")
    leaves_nothing_out("yard")
    tells_warnings("yard")
    tells_every_force("pb07", 3)
    tells_every_force("close", 14)
    tells_every_force("bolts", 2)
    tells_every_force("row", 3)
    tells_loads_of_beams("close")
    outlines_loads_of_plates("bolts")
    adds_up_by_direction("frame", ["x", "y"] * 3)
    for problem in ("pb07", "pp05a"):
        saves_its_picture(problem)
    pressed_faces_are_where_the_beam_is("pb07", 6)
    tells_sums_of_forces("pb07")
    for problem in ("pb07", "strip", "settling"):
        tables_fit(problem)
    for problem in ("pb05", "pp05a", "two-faces"):
        most_loaded_pair_is_on_top(problem)
    axes_have_ticks("pb07")
    nothing_overlaps("free")
    markup_is_text("free", "A free beam & <b>markup</b> \"quoted\" </script><script>alert(1)</script> {{data}}")
    opens("alone", "One kernel ran")
    opens("no-pairs", "There are no contact pairs.", "no-pairs.toml")
    opens("mechanism", "Not solved", "no equilibrium")
    opens("never", "never called")
    opens("own-ways", "single calls were not compared")
    opens("corrected", "All load is applied.")
    stays_small("long", 12_000_000, ["of 5001 nodes", "300 of 1000 pairs", "increments; the slider stops at", "the first 1200"])
    stays_small("wide", 12_000_000, ["40 of 71 grid lines"])
    for problem in ("frame", "console", "bare"):
        slider_moves(problem)
        numbers_match(problem)
        nothing_overlaps(problem)
        prints(problem)
        colours(problem, (".member", ".pair-open", ".track") if structures[problem] else (".track",))
    for problem, view in (("frame", 0), ("console", 3)):
        can_be_read_aloud(problem)
        looks_differ_in_shape(problem)
        stands_where_it_was(problem, view)
    opens("frame", "dof 6.y", "Rotations (11 of 33 dofs) are not drawn")
    opens("console", "54 nodes, 111 edges, 288 dofs", "144 of 288 dofs are not drawn")
    opens("bare", "No coordinates of this structure are known", "33 dofs")
    stays_small("grid", 12_000_000, ["20000 of 23980 edges", "more than 32 parts"], 100_000)
finally:
    browser.close()
print(f"   {check.made} checks, {check.failed} failed")
sys.exit(1 if check.failed else 0)
