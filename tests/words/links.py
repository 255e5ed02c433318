"""Fails when a relative link of README.md or reference/**/*.md leads to no file, or to no heading of a page.
Usage: links.py ROOT LEAST"""
import re
import sys
from pathlib import Path

FENCED = re.compile(r"^( *)(```+|~~~+).*?^ *\2[`~]*[ \t]*$", re.DOTALL | re.MULTILINE)


# The text without code, and with its line breaks.
without_code = lambda text: re.sub(r"(`+)(?!`)[^\n]*?(?<!`)\1(?!`)", "", FENCED.sub(lambda m: re.sub(r"[^\n]", "", m[0]), text))


def anchors_of(text):
    """Returns the anchors that GitHub makes from headings: letters, digits, _ and -, with - for blanks; a repeated
    anchor gets -1."""
    names = []
    for heading in re.findall(r"^#{1,6} +(.*?)[ \t]*$", FENCED.sub("", text), re.MULTILINE):
        words = re.sub(r"\[([^\]]*)\]\([^)]*\)", r"\1", heading).lower()
        names.append(re.sub(r"[^\w\- ]", "", words).replace(" ", "-"))
    return {f"{name}-{names[:i].count(name)}" if name in names[:i] else name for i, name in enumerate(names)}


def links_of(text):
    """Yields (line, target) of [words](target "title") and [name]: target."""
    plain = without_code(text)
    for m in re.finditer(r"\]\(\s*<?([^\s)>]+)>?(?:\s+\"[^\"]*\")?\s*\)|^\[[^\]]+\]:\s+(\S+)", plain, re.MULTILINE):
        yield plain.count("\n", 0, m.start()) + 1, m[1] or m[2]


def wrong_in(page, target):
    path, _, anchor = target.partition("#")
    to = page.parent / path if path else page
    if not to.exists():
        return "allowed: a file or a folder of the project"
    if anchor and to.suffix == ".md" and anchor not in anchors_of(to.read_text(encoding="utf-8")):
        return f"allowed: a heading of {to}"
    if anchor and to.suffix == ".html" and not re.search(rf"\bid=\"{re.escape(anchor)}\"", to.read_text(encoding="utf-8")):
        return f"allowed: an id in {to}"
    return ""


root, least = Path(sys.argv[1]), int(sys.argv[2])
count, wrong = 0, 0
for page in [root / "README.md", *sorted((root / "reference").rglob("*.md"))]:
    for line, target in links_of(page.read_text(encoding="utf-8")):
        if re.match(r"[a-z]+:", target):
            continue  # a link to another site
        count += 1
        if problem := wrong_in(page, target):
            wrong += 1
            print(f"{page}:{line}: found a link to {target}; {problem}")
print(f"{count} relative links, {wrong} of them lead nowhere; allowed: {least} links or more")
sys.exit(1 if wrong or count < least else 0)
