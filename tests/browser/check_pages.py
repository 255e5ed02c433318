"""Opens pages of `contct run --html` in a browser without a window and uses them as a person would.
usage: python3 check_pages.py WORK      (WORK holds NAME.html and NAME.json of each run; pictures go there)"""
import hashlib
import json
import math
import re
import sys
import time
import xml.etree.ElementTree as ElementTree
from pathlib import Path

sys.path.insert(0, str(Path(__file__).parents[1] / "support"))
from testing import Checks, run  # noqa: E402
from devtools import FITS, Browser  # noqa: E402

work = Path(sys.argv[1]).absolute()
browser, checks = Browser(), Checks()
value, every = browser.value, browser.every
page = ""  # the name of the open page, with which every message begins
MARKS = ".pair-open, #picture .pair-face, #picture .pair-closed"  # in #picture
MINUS = "\u2212"
check = lambda holds, what: checks(holds, f"{page}: {what}")
result = lambda: json.loads((work / f"{page}.json").read_text(encoding="utf-8"))
go_to = lambda state: browser.enter("slider", str(state))
frames = lambda: value("frames.map(f => ({step: f.step, number: f.number, end: f.end}))")
rows = lambda selector: every(selector, "[...e.children].map(c => c.dataset.value || c.textContent)")  # exact numbers, or words
words_of = lambda part: value(f"document.getElementById('{part}').innerText")


def contains(text, pieces, what):
    for piece in pieces:
        check(piece in text, f"{what} says \"{piece}\": {text[:600]}")


def open_page(**how):
    browser.errors.clear()
    browser.requests.clear()
    browser.open(work / f"{page}.html", **how)
    check(browser.requests == [f"file://{work}/{page}.html"], f"nothing but the page is asked for: {browser.requests}")


def is_quiet(*words):
    text = value("document.body.innerText")
    check(not any(word in text for word in ("undefined", "[object", *words)), "nothing on the page is undefined or no number")
    check(browser.errors == [], f"the console is silent: {browser.errors}")


def tables(section, title="", of="[...e.rows].map(r => r.innerText)"):
    """Returns a value of every table of a section whose caption begins with the title."""
    within = f"#{section} table" + (", #all-ends table" if section == "ends" else "")
    return value(f"[...document.querySelectorAll('{within}')].filter(e => e.ariaLabel.startsWith({json.dumps(title)})).map(e => {of})")


# ---- the slider, by mouse and by keyboard, and the numbers ----

def slider_moves():
    last = len(frames()) - 1
    state, at = lambda: value("document.getElementById('state').textContent"), lambda: int(value("document.getElementById('slider').value"))
    check(value("Math.abs(mostOf(frames[current]).value) === Math.max(...frames.map(f => Math.abs(mostOf(f).value)))"), "the page opens at the largest deflection")
    go_to(last)
    value("document.getElementById('slider').focus()")
    said = [state()]
    for key, expected in (("Home", 0), ("ArrowRight", 1), ("ArrowRight", min(2, last)), ("ArrowLeft", min(2, last) - 1), ("End", last)):
        browser.press(key)
        check(at() == expected, f"{key} goes to {expected}, is at {at()}")
        said.append(state())
    check(said[1].startswith("Before any load."), f"the start is told: {said[1]}")
    check(said[0] == said[-1] and len(set(said)) > 1, "the words follow the slider")
    check(f"state {last + 1} of {last + 1}" in every("#slider", "e.getAttribute('aria-valuetext')")[0], "the slider says where it is")
    for button, expected in (("back", last - 1), ("next", last), ("back", last - 1)):
        value(f"document.getElementById('{button}').focus()")
        browser.press("Enter", text="\r")
        check(at() == expected, f"Enter on {button} goes to {expected}, is at {at()}")


def numbers_match():
    known, ends = result(), 0
    for i, frame in enumerate(frames()):
        if not frame["end"]:
            continue
        step, where = known["steps"][frame["step"] - 1], f"step {frame['step']}"
        go_to(i)
        ends += 1
        found = [(row[1], float(row[5]), float(row[6])) for row in rows("#pairs tbody tr")]
        expected = [(str(pair.get("node", pair.get("dof"))), pair["gap"], pair["force"]) for pair in step["pairs"]]
        check(found == expected, f"{where}: pairs {found}; allowed: {expected}")
        if page in STRUCTURES:
            check_structure(where)
        check(value("JSON.stringify(frames[current].u)") == value(f"JSON.stringify({json.dumps(step['displacement'])})"), f"{where}: every displacement")
    check(ends == len(known["steps"]), "the end of every step can be seen")
    tables_match(known)
    increments = [i for s in known["steps"] for i in s["increments"]]
    shown = rows("#events tr[data-increment]")
    check(len(shown) == len(increments), "every increment has its row")
    for row, increment in zip(shown, increments):
        same = float(row[1]) == increment["fraction"] and (increment.get("snap") or float(row[2]) == increment["s"])
        events = "; ".join(f"pair {e['pair']} {'makes' if e['change'] == 'make' else 'breaks'} contact ({'dof ' + e['dof'] if 'dof' in e else 'node ' + str(e['node'])}, {e['surface']})"
                           for e in increment["events"][:8])
        check(same and row[4].startswith(events or "–"), f"increment {row} is {increment}")
    calls, lockstep = rows("#comparison tbody tr"), known["lockstep"]
    check(len(calls) == lockstep["calls"], "every call has its row")
    check(not known["steps"][0]["pairs"] or all({row[3], row[4], row[6]} == {"0"} for row in calls), "every call is equal to the bit")
    check(sum(int(row[5]) for row in calls) == lockstep["values_compared"], "all values compared are told")


is_moment = lambda dof: re.search(r"theta|^w[xy]|[.]r|[.][456]$", dof) is not None  # "theta", "wx", "6.r" or "185.4"


def tables_match(known):
    """The tables of the steps' ends have the numbers of the result, digit for digit."""
    steps = known["steps"]
    shown = tables("ends", of="[e.ariaLabel, [...e.tBodies[0].rows].map(r => [...r.cells].map(c => [...c.querySelectorAll('[data-value]')].map(v => v.dataset.value)"
                              ".concat(c.dataset.value || [], c.textContent)))]")
    heads, = tables("ends", "Largest values", "[...e.tHead.rows[0].cells].map(c => c.textContent)")
    kinds = {is_moment(r["dof"]) for s in steps for r in s["reactions"]}
    check(sum("eaction" in head for head in heads) == (1 if page == "bare" else len(kinds)), f"forces and moments of supports have columns of their own: {heads}")
    for sums in (lines for caption, lines in shown if caption.startswith("Sums of forces")):
        for row, step in zip(sums, steps):
            check([float(cell[0]) for cell in row[1:]] == [step["balance"][key] for key in ("loads", "reactions", "contact")], f"sums of step {step['step']}: {row}")
    ends = next(lines for caption, lines in shown if caption.startswith("Largest values"))
    check(len(ends) == len(steps), "every step's end has its row")
    for row, step in zip(ends, steps):
        check(float(row[1][0]) == step["fraction"], f"share of step {step['step']}: {row[1]}")
        for head, cell in zip(heads, row):
            if "eaction" in head:
                reaction = max((r["value"] for r in step["reactions"] if is_moment(r["dof"]) == ("moment" in head) or page == "bare"), key=abs)
                check(float(cell[0]) == reaction, f"largest value of {head} of step {step['step']}: {cell}, {reaction}")
        for i, quantity in enumerate(("w", "moment", "shear") if page.startswith("pb") else ("w",)):
            allowed = [step["extremes"][quantity][end]["value"] for end in ("min", "max")]
            check(all(float(v) in allowed for v in row[2 + i][:-1]), f"{quantity} of step {step['step']}: {row[2 + i]}, {allowed}")
    own = set(value("structure.pairs.filter(p => !p.bed).map(p => p.pair)"))
    for title, most, known_of in (("Contact forces of beds", 40, lambda s: [p["force"] for p in s["pairs"] if p["pair"] not in own]),
                                  (r"Contact forces( \[|;)", math.inf, lambda s: [p["gap" if p["state"] == "separated" else "force"] for p in s["pairs"] if p["pair"] in own]),
                                  ("Reactions: ", math.inf, lambda s: [r["value"] for r in s["reactions"]])):
        columns = []
        for lines in (lines for caption, lines in shown[1:] if re.match(title, caption)):
            width = min(6, len(steps) - len(columns))
            columns += [[float(r[len(r) - width + i][0]) for r in lines] for i in range(width)]
        for column, step in zip(columns + [[]] * (len(steps) - len(columns)), steps):
            all_of = known_of(step)
            check(len(column) == min(most, len(all_of)) and (len(all_of) > most and set(column) <= set(all_of) or column == all_of),
                  f"{title.lower()} of step {step['step']}: {column}, {all_of}")


# The structures that are given by matrices: True if the page draws the structure.
STRUCTURES = {"frame": True, "console": True, "bare": False}


def check_structure(where):
    """Every pair is drawn at its displaced node; a structure without coordinates is not drawn."""
    if not STRUCTURES[page]:
        check(value("document.getElementById('picture').children.length") == 0, f"{where}: nothing is drawn")
        return
    off = value(f"""(() => {{
      const f = frames[current], marks = [...document.querySelectorAll('#picture {MARKS}')];
      return Math.max(...leastLoadedFirst(pairsOf(f)).map((p, i) => {{
        const box = marks[i].getBBox(), [x, y] = page.spot(projected(movedTo(f, p.at, scene.times)));
        return Math.hypot(box.x + box.width / 2 - x, box.y + box.height / 2 - y);
      }}));
    }})()""")
    check(off < 0.1, f"{where}: pairs' marks are {off} pixels from their nodes")


# ---- appearance ----

def contrast(*colours):
    def luminance(colour):
        parts = [int(x) / 255 for x in re.findall(r"\d+", colour)[:3]]
        return sum(k * (p / 12.92 if p <= 0.03928 else ((p + 0.055) / 1.055) ** 2.4) for k, p in zip((0.2126, 0.7152, 0.0722), parts))
    low, high = sorted(map(luminance, colours))
    return (high + 0.05) / (low + 0.05)


def colours(*lines):
    papers = []
    for theme in ("light", "dark"):
        open_page(dark=theme == "dark")
        colour = lambda what, property: value(f"getComputedStyle(document.querySelector('{what}')).{property}")
        paper, panel = colour("body", "backgroundColor"), colour(".picture", "backgroundColor")
        papers.append(contrast(paper, "rgb(0, 0, 0)"))
        for what, property, behind, least in (("body", "color", paper, 7), ("#size", "color", paper, 4.5), (".verdict li", "color", paper, 4.5), ("td", "color", panel, 7),
                                              ("svg .axis-word", "fill", panel, 4.5), *((f"svg {line}", "stroke", panel, 3) for line in lines)):
            ratio = contrast(colour(what, property), behind)
            check(ratio >= least, f"{theme}: contrast of {what} is {ratio:.1f}, allowed from {least}")
        browser.picture(work / f"{page}-{theme}.png")
    check(papers[0] > 17 and papers[1] < 3, f"light is light and dark is dark: {papers}")


# Texts of a picture must not overlap. The boxes are a little smaller than the texts.
OVERLAPS = """[...document.querySelectorAll('.picture svg')].flatMap(s => {
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


def no_overlap(where):
    found = value(OVERLAPS)
    check(found == [], f"{where}: labels lie on each other: {found[:4]}")


def nothing_overlaps():
    for width in (1400, 1000, 360):
        open_page(width=width)
        count = len(frames())
        for state in sorted({0, 1, count // 2, count - 1}):
            go_to(state)
            no_overlap(f"{width} wide, state {state}")
        check(value(FITS), f"{width} wide: the page does not scroll sideways")
    browser.picture(work / f"{page}-narrow.png")


def most_loaded_pair_is_on_top():
    wrong = value(f"""frames.flatMap((f, i) => {{ show(i);
        const order = [...document.querySelectorAll('#picture {MARKS}')].map(m => ['pair-open', 'pair-face', 'pair-closed'].indexOf(m.classList[0]));
        return order.some((o, k) => k > 0 && o < order[k - 1]) ? [i] : []; }})""")
    check(wrong == [], f"a separated pair is drawn over one in contact in states {wrong}")


def axes_have_ticks():
    found = value("[[0, 1], [-0.47, 0.47], [-1e-9, 3e-9], [0, 7e12], [-102, 102], [0.99, 1.01]].map(([a, b]) => ticks(a, b, 4).length)")
    check(min(found) >= 3 and max(found) <= 7, f"every axis has three ticks or more: {found}")


def looks_differ_in_shape():
    shapes = set()
    for state in range(len(frames())):
        go_to(state)
        shapes |= set(map(tuple, every(f"#picture {MARKS}", "[e.classList[0], e.tagName]")))
    check(sorted(shapes) == [("pair-closed", "rect"), ("pair-face", "path"), ("pair-open", "circle")], f"separated, in contact and at its face have shapes of their own: {shapes}")


# ---- on paper ----

def sheets():
    """The text of each sheet of paper."""
    (work / f"{page}.pdf").write_bytes(browser.pdf())
    return run("pdftotext", "-layout", work / f"{page}.pdf", "-", status=0).stdout.split("\f")[:-1]


def prints():
    open_page(dark=True)
    go_to(0)
    paper = sheets()
    check(2 <= len(paper) <= 40, f"it prints on paper, {len(paper)} pages")
    check(value("current === frames.length - 1"), "what is printed is the final state")
    feet = {[line for line in sheet.splitlines() if line.strip()][-2].strip() for sheet in paper}
    check(feet.isdisjoint(every("h2, .caption")), f"no heading is the last line of a sheet: {feet}")


def paper_has(title, words):
    """Each sheet has the title and its number; the words are printed."""
    paper = sheets()
    check(len(paper) >= 3, f"{len(paper)} sheets")
    for number, text in enumerate(paper, 1):
        check(text.lstrip().startswith(title) and text.rstrip().endswith(f"page {number} of {len(paper)}"), f"sheet {number} has the title and its number: {text[:90]}")
    whole = "".join(paper)
    order = [whole.find(part) for part in ("The system; distances of faces", "Loads, settlements", "The structure, increment", "Governing results")]
    check(-1 not in order and order == sorted(order), f"sketch, input and results follow one another on paper: {order}")
    check(value("byId('input').previousElementSibling.id") == "ends", "on the screen the input is behind the results again")
    contains(whole, words, "paper")


def fits_five_pages(*words):
    """The report has at most five pages; the appendix follows only if it is asked for."""
    paper = sheets()
    check(len(paper) <= 5, f"{len(paper)} pages; allowed: 5")
    contains(" ".join("".join(paper).split()), words, "paper")
    check("Increments and events" not in "".join(paper), "the appendix is not printed")
    value("byId('with-appendix').click()")
    whole = sheets()
    check(len(whole) > len(paper) and "Increments and events" in "".join(whole), f"with the appendix there are {len(whole)} pages")


def every_load_is_on_paper():
    loads = re.findall(r"w = -([\d.]+)", (work / "strip.toml").read_text(encoding="utf-8"))
    missing = {load.removesuffix(".0") for load in loads} - set(re.findall(MINUS + r"([\d.]+)", "".join(sheets())))
    check(len(loads) == 67 and not missing, f"loads that are not printed: {missing}")


# ---- the report ----

def has_envelope():
    check("m, kN" in words_of("title-block") and "it sinks" in words_of("ends"), "units and the step have their names")
    shown = set(map(float, every("#envelope [data-value], #ends [data-value]", "e.dataset.value")))
    envelope = result()["envelope"]
    known = {v[bound]["value"] for v in envelope.values() if isinstance(v, dict) and "min" in v for bound in ("min", "max")}
    known |= {p["force_max"] for p in envelope["pairs"]} | {r[bound]["value"] for r in envelope["reactions"] for bound in ("min", "max")}
    check(all(p["gap"]["min"]["value"] <= p["gap"]["max"]["value"] for p in envelope["pairs"]), "each pair has the range of its gap")
    told = tables("envelope", "Reactions and contact forces")
    check(told and any("increment" in row for row in told[0]), f"extremes on the path have their increments: {told}")
    check(known <= shown and len(known) >= 10, f"the page has every number of the envelope, {len(known)}: {known - shown}")


def has_the_largest_rows():
    """If there are more pairs than rows, the table has the largest forces."""
    forces = sorted((p["force_max"] for p in result()["envelope"]["pairs"]), reverse=True)
    shown, = tables("envelope", "Largest contact force", "[...e.querySelectorAll('td:last-child [data-value]')].map(v => Number(v.dataset.value))")
    check(len(forces) > 40 and sorted(shown, reverse=True) == forces[:40], f"the table of the envelope has the 40 largest of {len(forces)} forces: {shown}")


def leaves_nothing_out():
    """With many combinations and pairs, the page has every step, every [[contact]] and all text of the terminal."""
    steps = result()["steps"]
    check([len(tables("ends", title)[0]) for title in ("Sums of forces", "Largest values")] == [1 + len(steps)] * 2 == [28] * 2, "every step has its row")
    forces = tables("ends", "Contact forces [kN]; for a separated pair the gap [m]")
    check([len(lines) for lines in forces] == [3] * 5 and all("gap" in lines[2] for lines in forces), f"both bolts are in every table of forces, one with its gap: {forces}")
    check(len(tables("ends", "Contact forces of beds [kN], 6 of 27 steps")) == 1, "the selection of the bed is told where it stands")
    terms = tables("input", "Combinations")[0]
    check(terms[1:] == ["1, G alone\t1 G", "2 to 27, fork\t1.35 G + 1.5 fork at 0 to 10 by 0.4, 26 places"], f"terms of combinations: {terms}")
    loads = [row.split("\t")[2:] for row in tables("input", "Loads")[0][1:]]
    check(loads == [["all elements", MINUS + "6.75"], ["x = 0 to 10 by 0.4, 26 places", MINUS + "120"]], f"each load of the train has a row: {loads}")
    beds = [float(row.split("\t")[2].replace(MINUS, "-")) for row in tables("ends", "Beds: resultant")[0][1:]]
    bolts = [sum(p["force"] for p in s["pairs"] if p["surface"] == "above") for s in steps]
    off = [abs(bed + s["balance"]["loads"] - bolt) for bed, s, bolt in zip(beds, steps, bolts, strict=True)]
    check(len(off) == 27 and max(off) < 1e-4, f"the bed bears the loads and the bolts: {max(off)}")
    paper = "".join(sheets())
    check("gap" in paper and not re.search(r"[Cc]lick|[Pp]oint at", paper), "gaps are on paper, and nothing is to be clicked")


def tells_of_the_mesh():
    """What is known about the mesh is shown before the results, on screen and on paper."""
    paper = " ".join("".join(sheets()).split())
    for piece in ("mesh error, proved: ", "Half the element size changes the deflection by"):
        check(piece in words_of("verdict") and -1 < paper.find(piece) < paper.find("Governing results"), f"before the results, on paper too, it says \"{piece}\"")


def tells_every_force(least):
    """Also where there is no room beside the arrow: then with the number of the pair."""
    for i, frame in enumerate(frames()):
        go_to(i)
        told = every("#picture text.value", "e.textContent.split(': ').pop()")
        forces = value("numberedOf(pairsOf(frames[current])).filter(p => Math.abs(p.force) > 1e-3).map(p => rough(p.force))")
        check(all(told.count(force) >= forces.count(force) for force in forces), f"state {i}: forces {forces}, in the picture {told}")
        least -= frame["end"] and len(forces)
    check(least <= 0, f"{least} forces less than expected were looked for")
    no_overlap("the last state")


def tells_loads_of_beams():
    contains(words_of("input"), ("self-weight per length [kN/m]", "Section from x = 0 to 8", "E 210000000 [kN/m²], I 0.0003 [m⁴], A 0.01 [m²], weight 78.5 [kN/m³]",
                                 "Cases: loads as in the problem file, without factors"), "the input")
    steps = [words for words in every("#chart text") if words.startswith("step")]
    check(steps == ["step 1, G", "step 2, 2 G"], f"the paths have the names of their steps: {steps}")
    check(words_of("cuts").startswith("Nothing"), "the page leaves nothing out")
    paper = "".join(sheets())
    check("Nothing:" not in paper and "Not on paper" in paper, "paper has one statement about what is left out")
    order = [paper.find(f"Step {step}, increment") for step in ("1, G", "2, 2 G")]
    check(-1 < order[0] < order[1] and paper.count("Deflection [m], drawn") == 2, f"pictures of steps on paper in ascending order, each once: {order}")


def outlines_loads_of_plates():
    """Distributed loads are outlined where they act, and bolts differ from the bed."""
    go_to(len(frames()) - 1)
    contains(words_of("input"), ["(0.05, 0.15) to (0.15, 0.3)"], "the input, without digits of rounding,")
    off = value("""(() => {
      const loads = [...document.querySelectorAll('#picture path.load-line')].map(e => e.getAttribute('d').match(/[\\d.]+/g).map(Number));
      const at = (x, y) => structure.nodes.findIndex(n => Math.abs(n.x - x) < 1e-9 && Math.abs(n.y - y) < 1e-9);
      return [[[0, 0], [0.4, 0], [0.4, 0.4], [0, 0.4]], [[0.05, 0.15], [0.15, 0.15], [0.15, 0.3], [0.05, 0.3]]].map((corners, k) =>
        Math.max(...corners.map(([x, y], c) => { const [X, Y] = page.spot(projected(movedTo(frames[current], at(x, y), scene.times)));
          return Math.hypot(loads[k][48 * c] - X, loads[k][48 * c + 1] - Y); }))); })()""")
    check(max(off) < 0.1, f"corners of loads are {off} pixels from their nodes")
    contains(every("#picture text.value"), (MINUS + "50 [kN/m²]", "2000 [kN/m²]"), "the picture")
    sizes = sorted(every(f"#picture {MARKS}", "e.getBBox().width"))
    check(4 < len(sizes) < 40 and sizes[-2] > 1.1 * sizes[-3], f"of the bed only the border of its contact is marked, smaller than the bolts: {sizes[-4:]}")
    contains(words_of("ends"), ("Principal stress s1, lower face (upper: -s2)", "Principal stress s2, lower face (upper: -s1)", "Von Mises stress, both faces"), "the table of stresses")


def adds_up_by_direction(directions):
    """The sums of a structure with all its supports in the file are in equilibrium."""
    sums, = tables("ends", "Sums by direction", "[...e.tBodies[0].rows].map(r => [...r.cells].map(c => c.dataset.value ?? c.textContent))")
    check([row[1] for row in sums] == directions and sum(float(row[2]) != 0 for row in sums) >= 3, f"sums of each direction, with loads: {sums}")
    for loads, reactions, contact in (map(float, row[2:]) for row in sums):
        check(abs(loads + reactions + contact) <= 1e-9 * (abs(loads) + abs(reactions) + 1), f"the sums add up to 0: {loads, reactions, contact}")
    digest = hashlib.sha256(Path(f"reference/structures/{page}.mtx").read_bytes()).hexdigest()
    contains(words_of("input"), (f"{page}.mtx", digest, "Entries in this file\t96", f"{page}.dof", f"{page}.xyz", "force\tdof 6.y"), "the input")
    moved, = tables("ends", "Displacements u", "[...e.tBodies[0].rows].map(r => [r.cells[0].textContent, ...[...r.cells].slice(1).map(c => Number(c.dataset.value))])")
    labels = value("structure.dofs.map(d => d.dof)")
    known = [[s["displacement"][labels.index(row[0])] for s in result()["steps"]] for row in moved]
    turned = tables("ends", "Rotations", "e.tBodies[0].rows.length")
    check(turned == [11], f"the rotations of {turned} dofs; allowed: all 11")
    check(len(moved) == 22 and [row[1:] for row in moved] == known, f"the displacements of all dofs along an axis: {moved[:2]}")


def has_envelope_curves():
    """Every curve reaches the envelope's extremes, and the tooltip names the step of each extreme."""
    envelope = result()["envelope"]
    for quantity in ("w", "moment", "shear"):
        pieces = value(f"""[...document.querySelectorAll('#curves g')].filter(g => g.querySelector('path.{quantity}')).map(g =>
            [g.querySelector('title').textContent, g.querySelector('path.{quantity}').getAttribute('d').match(/[\\d.]+/g).map(Number)])""")
        dots = every(f"#curves .dot-{quantity}", "[Number(e.getAttribute('cx')), Number(e.getAttribute('cy'))]")
        check(len(dots) == 2, f"{quantity} has its extremes marked")
        for dot, extreme in zip(dots, sorted((envelope[quantity]["max"], envelope[quantity]["min"]), key=lambda v: -abs(v["value"]))):
            near = [words for words, at in pieces if min(math.dist(dot, point) for point in zip(at[::2], at[1::2])) < 0.05]
            check(any(f": step {extreme['step']}, " in words for words in near), f"{quantity}: the pointer is told step {extreme['step']}: {near}")
    most = max(envelope["curves"]["pressure"]["max"])
    check(f"{most:.5g} at x = " in words_of("curves"), f"the curve of the pressure tells its largest value, {most}")
    check("mesh error" not in words_of("envelope"), "inside a path no error of the mesh is proved")
    value("document.querySelector('#curves g path.moment').dispatchEvent(new MouseEvent('click', { bubbles: true }))")
    told = every("#curves g:has(path.moment) title")[0]
    check(f"step {value('frames[current].step')}, " in told and value("frames[current].end"), f"a click shows the step: {told}")


def tells_sums_of_forces():
    """The page has the sums of loads, reactions and contact forces if the result has them."""
    value("(() => { result.steps[0].balance = { loads: -601.25, reactions: 600, contact: 1.25 }; showRest(); })()")
    sums = tables("ends", "Sums of forces", "[...e.querySelectorAll('td')].map(c => Number(c.dataset.value))")
    check([row[:3] for row in sums] == [[-601.25, 600, 1.25]], f"sums of loads, reactions and contact forces: {sums}")


def tables_fit():
    """Short tables are not cut, and long names do not widen a table."""
    open_page(width=1300)
    of = lambda selector, filter: value(f"[...document.querySelectorAll('{selector}')].filter(e => {filter}).map(e => e.ariaLabel)")
    check(not (cut := of(".scroll.whole", "e.scrollHeight > e.clientHeight + 1 && e.offsetParent")), f"short tables that are cut: {cut}")
    check(not (wide := of("#ends .scroll, #envelope .scroll, #input .scroll", "e.scrollWidth > e.clientWidth + 1")), f"tables wider than the page: {wide}")
    close = value("""[...document.querySelectorAll('#ends, #envelope, #input')].flatMap(s => [...s.querySelectorAll('.scroll')].slice(1)
        .filter(e => e.getBoundingClientRect().top - e.previousElementSibling.getBoundingClientRect().bottom < 8).map(e => e.ariaLabel))""")
    check(close == [], f"tables that touch: {close}")


# ---- pictures ----

def saves_its_picture():
    file, shown = work / "picture.svg", every("#picture path", "e.getAttribute('d')")
    browser.save_to(work)
    value("byId('save').click()")
    end = time.monotonic() + 20
    while not file.exists() and time.monotonic() < end:
        time.sleep(0.05)
    saved = file.rename(work / f"{page}-saved.svg")
    check("var(" not in saved.read_text(encoding="utf-8"), "the saved picture needs no variables")
    root, space = ElementTree.parse(saved).getroot(), "{http://www.w3.org/2000/svg}"
    check(root.tag == space + "svg" and [p.get("d") for p in root.iter(space + "path")] == shown, "the saved picture has the paths of the one shown")
    browser.send("Page.navigate", url=f"file://{saved}")
    browser.wait_for("document.documentElement.tagName === 'svg' && document.readyState === 'complete'")
    stroke = value("getComputedStyle(document.querySelector('.member')).stroke")
    check(stroke == "rgb(29, 29, 27)", f"opened by itself it has the page's colours: {stroke}")
    open_page()


def pressed_faces_are_where_the_beam_is(state):
    """A face in contact is drawn at its node, and the spring begins at the face's original position."""
    go_to(state)
    off = value("""frames[current].pairs.filter(p => p.closed && p.force > 0).map(p => {
      const [x, y] = page.on.spot(p), stood = page.Y(p.face), is = (e, at) => Math.abs((Number(e.getAttribute('x1')) + Number(e.getAttribute('x2'))) / 2 - x) < 0.1 &&
        Math.abs(Number(e.getAttribute('y1')) - at) < 0.1 && Math.abs(Number(e.getAttribute('y2')) - at) < 0.1;
      const has = (kind, at) => [...document.querySelectorAll('#picture ' + kind)].some(e => is(e, at));
      return has('.face-line', y) && has('.spring', stood) && Math.abs(stood - y) > 3 ? '' : `pair ${p.pair}`; })""")
    check(off == [""] * 3, f"state {state}: faces in contact: {off}")


def shows_true_maxima(state, moment, place):
    """The moment's line reaches its largest value, which is between two nodes."""
    go_to(state)
    reached = value("""(() => {
      const numbers = document.querySelector('#picture path.moment').getAttribute('d').match(/[\\d.]+/g).map(Number);
      const ys = numbers.filter((_, i) => i % 2 === 1), dot = document.querySelector('#picture .dot-moment'), top = Math.min(...ys);
      const off = ys.map((y, i) => (y < top + 0.02 ? Math.abs(numbers[2 * i] - Number(dot.getAttribute('cx'))) : Infinity));
      return [Math.abs(top - Number(dot.getAttribute('cy'))), Math.min(...off)];
    })()""")
    check(max(reached) < 0.02, f"the highest point of the moment's line is {reached} pixels from its largest value")
    words = [w for w in every("#picture text.value") if f"{moment} at x = {place}" in w]
    check(len(words) == 1, f"the largest moment is told with its place: {words}")


def fields_can_be_chosen(fields):
    check(every("#field option", "e.value") == fields, f"{fields} can be shown")
    seen = set()
    for field in fields:
        browser.enter("field", field, "change")
        seen.add(",".join(map(str, every("#picture path[fill^=rgb]", "e.getAttribute('d').length"))))
        no_overlap(field)
        browser.picture(work / f"{page}-{field}.png", whole=False)
    check(len(seen) == len(fields), f"{len(fields)} quantities, {len(seen)} pictures")


def picture_of_readme_is_up_to_date():
    """reference/run.svg has the beam and its path as the page draws them, with the page's colours."""
    open_page(width=1000)
    go_to(len(frames()) - 1)
    picture = value("""(() => {
      const rules = document.querySelector('style').textContent.match(/^(:root[^{]*|svg [^{]*) {[^}]*}/gm).join('\\n');
      const inside = id => [...document.querySelector(id + ' svg').children].map(e => new XMLSerializer().serializeToString(e)).join('\\n');
      const [width, beam, path] = [widthOf(byId('picture')), page.bottom + 30, document.querySelector('#chart svg').viewBox.baseVal.height];
      return `<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 ${width} ${beam + path}" role="img">\\n<style>${rules}\\n` +
        `svg { background: var(--panel); font-family: "DejaVu Sans", Arial, sans-serif; }</style>\\n<svg height="${beam}">${inside('#picture')}</svg>\\n` +
        `<svg y="${beam}">${inside('#chart')}</svg>\\n</svg>\\n`;
    })()""").replace(' xmlns="http://www.w3.org/2000/svg"', "").replace("<svg", '<svg xmlns="http://www.w3.org/2000/svg"', 1)
    (work / "run.svg").write_text(picture, encoding="utf-8")
    check(Path("reference/run.svg").read_text(encoding="utf-8") == picture, f"reference/run.svg is not what the page draws, which is in {work}/run.svg")


def edition_is_a_page():
    for width in (1180, 400):
        browser.errors.clear()
        browser.open("reference/parallel-edition.html", width=width)
        check(value(FITS) and value("document.title") == "CONTCT: the parallel edition", f"the parallel edition, {width} wide, is a page")
        is_quiet()
    open_page()


def can_be_read_aloud():
    browser.send("Accessibility.enable")
    nodes = browser.send("Accessibility.getFullAXTree")["nodes"]
    browser.send("Accessibility.disable")
    of = lambda role: [n for n in nodes if n.get("role", {}).get("value") == role and not n.get("ignored")]
    for role in ("button", "slider", "image", "combobox", "region"):
        check(all(n.get("name", {}).get("value", "").strip() for n in of(role)), f"every {role} has a name")
    count = {role: len(of(role)) for role in ("slider", "status", "image", "columnheader", "rowheader")}
    check(count["slider"] == count["status"] == 1 and count["image"] >= 2 and count["columnheader"] >= 5 and count["rowheader"] >= 1, f"controls, pictures and heads: {count}")
    check("polite" in [p["value"]["value"] for n in of("status") for p in n.get("properties", []) if p["name"] == "live"], "changes are read out")
    levels = every("h1, h2, h3", "e.tagName")
    check(levels[:2] == ["H1", "H2"] and levels.count("H1") == 1, f"headings: {levels}")
    check(value("document.documentElement.lang") == "en", "its language is told")


# ---- hostile and large problems ----

def markup_is_text(title):
    check(value("[document.querySelector('h1').textContent, document.title]") == [title] * 2, "the title is shown as it is, and is the window's")
    check(value("[document.scripts.length, document.querySelectorAll('b').length - document.querySelectorAll('#edition b').length]") == [2, 0], "nothing came of its markup")


def opens(*words):
    for state in range(min(len(frames()), 6)):
        go_to(state)
    contains(value("document.body.innerText"), words, "the page")
    check("NaN" not in value("document.body.innerHTML.replace(/<script[^]*?<\\/script>|<details id=.edition.[^]*?<\\/details>/g, '')"), "no number is none")


def stands_where_it_was(view):
    """Before any load both lines of the structure are equal; later they differ. Pairs, faces and supports are marked."""
    check(value("view") == view, "it is looked at from where it shows most")
    lines = "['.was', '.member'].map(k => document.querySelector('#picture ' + k).getAttribute('d'))"
    go_to(0)
    was, now = value(lines)
    check(was == now, "unloaded it stands where it was")
    go_to(2)
    check(value(lines)[0] == was and value(lines)[1] != was, "loaded it has moved from there")
    pairs, supports, still = value("[places.pairs.length, places.supports.length, scene.still.length]")
    check([len(every(f"#picture {kind}", 0)) for kind in (".face-line", MARKS)] == [pairs] * 2, "a face and a mark for each pair")
    check(sum(words.startswith("Support ") for words in every("#picture title")) == supports, "a mark for each support")
    check(sum(every("#picture .still", "(e.getAttribute('d').match(/M/g) || []).length")[:1]) == still, "a cross for each node without a dof")


def stays_small(words, most_points=40_000):
    size = (work / f"{page}.html").stat().st_size
    check(size <= 12_000_000, f"{size} bytes; allowed: 12,000,000")
    states = len(frames())
    check(4 <= states <= 120, f"{states} states")
    check(value("document.querySelectorAll('*').length") <= 60_000, "at most 60,000 elements are in the page")
    for state in (0, states // 2, states - 1):
        go_to(state)
        drawn, points = len(every("#picture *", 0)), sum(every("#picture path", "e.getAttribute('d').split(/[ML]/).length"))
        check(0 < drawn <= 7000 and 0 < points <= most_points, f"state {state}: {drawn} elements with {points} points are drawn")
    contains(words_of("cuts"), words, "the list of what is left out")


LINES = (".member", ".pair-open", ".track")
RUNS = [  # (check, pages, arguments)
    *((part, "pb01 pb05 pb07 pp05a pp03e frame console bare") for part in (slider_moves, numbers_match, nothing_overlaps)),
    (nothing_overlaps, "free"), (prints, "pb05 pp05a frame console bare"), (can_be_read_aloud, "pb05 pp05a frame console"),
    (colours, "pb05 frame console", *LINES), (colours, "bare", ".track"), (looks_differ_in_shape, "pb07 frame console"),
    (shows_true_maxima, "pb07", 6, "167.98", "3.7004"), (fields_can_be_chosen, "pp05a", ["w", "pressure", "mx", "my", "mxy"]),
    (picture_of_readme_is_up_to_date, "pb07"), (edition_is_a_page, "pb07"), (has_envelope, "settling"), (every_load_is_on_paper, "strip"),
    (paper_has, "pp05a", "PP5a Free square plate on a tensionless bed, 8 x 8 to a quarter",
     ("Deflection", "Pressure of the beds", "Moment mx", "Moment my", "Twisting moment mxy")),
    (paper_has, "strip", "Slab strip (22 axle places): \"A & B\"", ("Moment, positive", "Shear, of the left", "Bed's pressure [kN/m]", "EI from x = 0 to 24", "20000")),
    (fits_five_pages, "crane", "Project Hall 3", "north, node 1", "Largest gap", "Watched parts", "span 2"), (fits_five_pages, "slab base-plate racks rail raft places"),
    (has_the_largest_rows, "strip"), (has_envelope_curves, "strip"), (leaves_nothing_out, "yard"), (tells_of_the_mesh, "yard"),
    (tells_every_force, "pb07 row", 3), (tells_every_force, "close", 14), (tells_every_force, "bolts", 2), (tells_loads_of_beams, "close"),
    (outlines_loads_of_plates, "bolts"), (adds_up_by_direction, "frame", ["x", "y"] * 3), (saves_its_picture, "pb07 pp05a"),
    (pressed_faces_are_where_the_beam_is, "pb07", 6), (tells_sums_of_forces, "pb07"), (tables_fit, "pb07 strip settling"),
    (most_loaded_pair_is_on_top, "pb05 pp05a two-faces"), (axes_have_ticks, "pb07"),
    (markup_is_text, "free", "A free beam & <b>markup</b> \"quoted\" </script><script>alert(1)</script> {{data}}"),
    (opens, "alone", "One kernel ran"), (opens, "no-pairs", "There are no contact pairs.", "no-pairs.toml"), (opens, "mechanism", "Not solved", "no equilibrium"),
    (opens, "never", "never called"), (opens, "own-ways", "single calls were not compared"), (opens, "corrected", "All load is applied."),
    (opens, "frame", "dof 6.y", "Rotations (11 of 33 dofs) are not drawn"), (opens, "console", "54 nodes, 111 edges, 288 dofs", "144 of 288 dofs are not drawn"),
    (opens, "bare", "No coordinates of this structure are known", "33 dofs"), (stands_where_it_was, "frame", 0), (stands_where_it_was, "console", 3),
    (stays_small, "long", ["of 5001 nodes", "300 of 1000 pairs", "increments; the slider stops at", "the first 1200"]), (stays_small, "wide", ["40 of 71 grid lines"]),
    (stays_small, "grid", ["20000 of 23980 edges", "more than 32 parts"], 100_000)]
try:
    for part, pages, *arguments in RUNS:
        for page in pages.split():
            open_page()
            part(*arguments)
            is_quiet("NaN")
finally:
    browser.close()
checks.end(1_200)
