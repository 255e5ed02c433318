"""Makes the pages in which the compiled program runs: the playground, contct.html, and one page for each Markdown file
of the course and of reference/. In the course, pictures become scenes that can be dragged, and page 12 gets the judge
of kernels.

usage: python3 pages.py ROOT MODULE OUT
MODULE is Emscripten's contct.js; OUT is the folder of contct.html. The course is written to a folder next to OUT."""
import html
import json
import pathlib
import re
import sys
import textwrap
import tomllib

root, module, out = (pathlib.Path(a).resolve() for a in sys.argv[1:])
sys.path.insert(0, str(root / "reference/course/port"))
import hint  # noqa: E402
import stages  # noqa: E402

here, report, course = root / "cpp/playground", root / "cpp/contct/write/report", root / "reference/course"


def read(path):
    return path.read_text(encoding="utf-8")


def together(*names):
    """The text of files of this folder or of the report's folder."""
    return "".join(read(here / n if (here / n).exists() else report / n) for n in names)


def between(text, begin, end):
    start = text.index(begin) + len(begin)
    return text[start:text.rindex(end)]


def write_whole(path, text):
    """Write a page, which is never visible in part."""
    part = path.with_name(path.name + ".part")
    part.write_text(text, encoding="utf-8")
    part.replace(path)


def filled(template, parts):
    return re.sub(r"\{\{(\w+)\}\}", lambda m: parts.get(m[1], m[0]), template)


def scenes():
    """The scenes of scenes.json, with the texts of their problems."""
    all_scenes = json.loads(read(course / "scenes/scenes.json"))
    return {name: {**s, "text": read(root / s["problem"])} for name, s in all_scenes.items()}


def beside():
    """The C++ code for each line of the listing, from the parallel edition."""
    parts = tomllib.loads(read(root / "reference/parallel-edition.toml"))["part"]
    return {line: "\n".join(textwrap.dedent(b["text"]).strip() for b in part["cpp"] if b["file"].endswith("contct.hpp")) for part in parts for line in part["listing"]}


def calls_of_stages(calls):
    """Returns for each stage of the port the golden calls that its kernel and those of all later stages answer right."""
    begins = [len(hint.STAGES) + 1] * len(calls)
    for stage in range(len(hint.STAGES), 0, -1):
        names = {"__name__": "kernel"}
        exec(stages.kernel_after(stage), names)
        for i, c in enumerate(calls):
            try:
                answer = names["contct"](c["indof"], c["ndofpn"], {n: (d, d_star) for n, d, d_star in c["dofs"]}, c["pairs"])
            except (KeyError, ZeroDivisionError):
                answer = None
            if begins[i] == stage + 1 and hint.first_difference(answer, c["answer"]) is None:
                begins[i] = stage
    return [[i for i, begin in enumerate(begins) if begin == stage] for stage in range(1, len(hint.STAGES) + 1)]


def judged():
    """The data of the judge on page 12: the golden calls with their answers, the stages and the hints. NaN and infinity
    are texts, because JSON has no such numbers."""
    real = lambda x: x if abs(x) < float("inf") else str(x)
    golden = hint.golden_calls(root)
    calls = [{"name": c["name"], "note": c["note"], "indof": c["indof"], "ndofpn": c["ndofpn"], "ndof": c["ndof"],
              "dofs": [[n, real(d), real(d_star)] for n, d, d_star in c["dofs"]], "pairs": [[*p[:3], real(p[3])] for p in c["pairs"]],
              "smin": real(c["answer"][0]), "ss": [real(s) for s in c["answer"][1]], "isep": c["answer"][2]} for c in golden]
    return {"golden": calls, "hints": hint.read_table(), "where": hint.WHERE,
            "stages": [{"adds": s["adds"], "digests": s["digests"], "calls": of} for s, of in zip(hint.STAGES, calls_of_stages(golden))]}


def given(**more):
    text = json.dumps({"scenes": scenes(), "listing": read(root / "fortran/contct.f"), **more}, ensure_ascii=False)
    return text.replace("</", "<\\/")


def module_text():
    return read(module).replace("</script", "<\\/script")


def write_playground():
    folder = root / "reference/problems"
    # Problems that name other files are omitted, because a page has no files.
    problems = {str(p.relative_to(folder))[:-5]: read(p) for p in sorted(folder.rglob("*.toml")) if not p.with_suffix(".mtx").exists()}
    sections = filled(between(read(report / "report.html"), "<main>", "</main>"),
                      {"edition": between(read(root / "reference/parallel-edition.html"), "</h1>", "</body>")})
    write_whole(out / "contct.html", filled(read(here / "playground.html"), {
        "style": together("report.css", "playground.css"), "report": sections, "data": given(problems=problems), "module": module_text(),
        "script": together("result.js", "picture.js", "report.js", "program.js", "scene.js", "two_rules.js", "playground.js")}))


def name_of(file):
    """The name of the page of a Markdown file or notebook of reference/."""
    inside = file.relative_to(course) if file.is_relative_to(course) else file.relative_to(root / "reference") if file.parent != root else pathlib.Path("..", file.name)
    name = "-".join(inside.with_suffix("").parts)
    return {"README": "index" if file.is_relative_to(course) else "reference", "..-README": "project"}.get(name, name) + ".html"


def markdown_of(file):
    if file.suffix == ".md":
        return read(file)
    kinds = {"markdown": "{}", "code": "```python\n{}\n```"}
    return "\n\n".join(kinds[cell["cell_type"]].format("".join(cell["source"])) for cell in json.loads(read(file))["cells"])


def linked(m, file, names):
    """The address of a link or picture of `file`: another page, a copy of the picture, or a file of the tree."""
    target, mark, place = m[2].partition("#")
    to = (file.parent / target).resolve()
    if m[1] == "src":
        names[to] = "pictures/" + "-".join(to.relative_to(root / "reference").parts)
        (out.parent / "course" / names[to]).write_bytes(to.read_bytes())
    return f'{m[1]}="{names.get(to) or pathlib.Path("../..", to.relative_to(root)).as_posix()}{mark}{place}"'


def numbered(m):
    """A block of the page; with the numbers of its lines if they are lines of the listing."""
    lines, all_lines = html.unescape(m[1]).splitlines(), read(root / "fortran/contct.f").splitlines()
    first = next((i for i in range(len(all_lines)) if len(lines) > 1 and all_lines[i:i + len(lines)] == lines), None)
    return m[0] if first is None else f'<pre class="numbered" style="counter-reset: line {first}"><code>{"".join(f"<span>{line}</span>{chr(10)}" for line in m[1].splitlines())}</code></pre>'


def around(file, order, names, titles):
    """The head and the foot of a page: its place in the course, and the pages before and after it."""
    if file not in order:
        return '<nav><a href="index.html">The course</a></nav>', ""
    at = order.index(file)
    link = lambda i, words: f'<a rel="{words}" href="{names[order[i]]}">{words}: {titles[order[i]]}</a>' if 0 <= i < len(order) else ""
    return (f'<nav><a href="index.html">Contents</a> <progress max="{len(order)}" value="{at + 1}"></progress> {at + 1} of {len(order)}</nav>',
            f'<nav class="ends">{link(at - 1, "previous")}{link(at + 1, "next")}</nav>')


def page_of(file, converter, order, names, titles):
    """A page of the course. The scene NAME replaces a picture with the title "scene: NAME". Commands are behind a switch."""
    converter.reset()
    text = re.sub(r"^\[Contents\].*\n", "", markdown_of(file), count=1, flags=re.M) if file in order else markdown_of(file)
    body = converter.convert(text)
    known, still = scenes(), "<noscript><p>JavaScript is off: the picture does not move, and answers are not judged.</p></noscript>"

    def place(m):
        if m[2] not in known:
            raise SystemExit(f"{file}: found a scene \"{m[2]}\"; allowed: {', '.join(known)}")
        return f'<figure data-scene="{m[2]}">{m[1]}{still}</figure>'

    body = re.sub(r'<p>(<img [^>]*title="scene: ([\w-]+)"[^>]*>)</p>', place, body)
    body = re.sub(r'<p>(<img [^>]*title="judge: port"[^>]*>)</p>', rf'<div data-port>\1{still}</div>', body)
    body = re.sub(r'(<pre><code class="language-sh">.*?</pre>)', r'<details class="commands"><summary>Run it yourself</summary>\1</details>', body, flags=re.S)
    body = re.sub(r'<pre><code class="language-text">(.*?)</code></pre>', numbered, body, flags=re.S)
    body = re.sub(r'(href|src)="(?!https?:|#)([^"]+)"', lambda m: linked(m, file, names), body)
    head, foot = around(file, order, names, titles)
    return filled(read(here / "course.html"), {"style": together("report.css", "playground.css", "course.css"), "title": titles[file], "body": f"{head}\n{body}\n{foot}"})


def write_course():
    import markdown
    folder = out.parent / "course"
    (folder / "pictures").mkdir(parents=True, exist_ok=True)
    converter = markdown.Markdown(extensions=["tables", "fenced_code", "toc", "md_in_html"])
    files = [root / "README.md", *sorted((root / "reference").rglob("*.md")), *course.glob("*.ipynb")]
    names = {file: name_of(file) for file in files}
    titles = {file: re.search(r"^# (.*)", markdown_of(file), re.M)[1] for file in files}
    order = [course / target for target in re.findall(r"^\|[^|]*\[[^\]]*\]\(([^)]+)\)", read(course / "README.md"), re.M)]
    for file in files:
        write_whole(folder / names[file], page_of(file, converter, order, names, titles))
    scripts = together("result.js", "picture.js", "program.js", "scene.js", "two_rules.js", "port.js", "course.js")
    write_whole(folder / "course.js", f"const given = {given(beside=beside(), **judged())};\n{read(module)}\n{scripts}")


write_playground()
write_course()
