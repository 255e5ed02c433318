"""edition.py [--write]: checks that reference/parallel-edition.md and .html are made from parallel-edition.toml and the
sources, and that the map in the .toml file is complete: every statement of the listing is in the map once, and every
block of C++ is in its file once. With --write, writes the two pages.
"""
import html
import sys
import tomllib
from collections import Counter
from pathlib import Path

ROOT = Path(__file__).absolute().parents[2]  # not resolve(): in a copy, this folder may be a link
LISTING = "fortran/contct.f"
KERNEL = "cpp/contct/kernel/contct.hpp"
COMMAND = "python3 tests/edition/edition.py --write"
STEPS = ["1", "2", "3", "4", "5, 6", "7", "8", "9 to 11", "12, 13", "14", "14", "14"]
KEYS = {"step", "title", "paper", "equation", "note", "listing", "cpp"}
STATEMENTS = 45
# A run's page embeds the section between HEAD and the end of the body.
HEAD = """<!DOCTYPE html>
<html lang="en">
<head>
<meta charset="utf-8">
<meta name="viewport" content="width=device-width, initial-scale=1">
<meta name="color-scheme" content="light dark">
<title>CONTCT: the parallel edition</title>
<style>
body { margin: 0 auto; max-width: 84rem; padding: 1rem clamp(0.8rem, 3vw, 2rem) 3rem; line-height: 1.5;
  font-family: system-ui, "Helvetica Neue", "Noto Sans", "DejaVu Sans", sans-serif; overflow-wrap: anywhere; }
p, blockquote { max-width: 46rem; }
blockquote { margin: 0.3rem 0; padding-left: 0.8rem; border-left: 3px solid gray; }
h3 { margin: 2rem 0 0.3rem; }
table { width: 100%; table-layout: fixed; border-collapse: collapse; }
th, td { vertical-align: top; text-align: left; padding: 0 0.6rem 0 0; }
pre { overflow-x: auto; margin: 0.2rem 0 0.6rem; padding: 0.5rem; border: 1px solid gray; border-radius: 0.3rem;
  font-size: 0.8rem; overflow-wrap: normal; }
@media (max-width: 56rem) { table, tbody, tr, th, td { display: block; padding: 0; } th + th { display: none; } }
@media print { pre { white-space: pre-wrap; } h3 { break-after: avoid; } }
</style>
</head>
<body>
<h1>CONTCT: the listing of 1989 and the C++ beside it</h1>
"""
TABLE = f"<table>\n<tr><th>FORTRAN, <code>{LISTING}</code></th><th>C++</th></tr>\n"


lines_of = lambda file: (ROOT / file).read_text().splitlines()
quoted = lambda block: [line.strip() for line in block["text"].splitlines() if line.strip()]  # without indentation
heading = lambda part: f"Step {part['step']}: {part['title']}" if part["step"] else part["title"]
plain = lambda text: "".join("\\" + ch if ch in "*_<" else ch for ch in text)  # escapes what has a meaning in Markdown


def places_of(block):
    """The first line, from 0, of each place where a block is in its file."""
    there, wanted = [line.strip() for line in lines_of(block["file"])], quoted(block)
    return [at for at in range(len(there)) if there[at:at + len(wanted)] == wanted]


def check(parts):
    statements = Counter(number for number, line in enumerate(lines_of(LISTING), 1) if line.strip() and line[0] not in "Cc*!")
    mapped = Counter(number for part in parts for number in part["listing"])
    assert mapped == statements, f"{LISTING}: lines left out, twice or comments: {mapped - statements}, {statements - mapped}"
    assert len(statements) == STATEMENTS, f"found {len(statements)} statements, allowed: {STATEMENTS}"
    assert [part["step"] for part in parts if part["step"]] == STEPS, "the steps of the paper's algorithm are not in their order"
    for part in parts:
        assert part.keys() == KEYS and part["cpp"], f"{part['title']}: found {sorted(part)}; allowed: {sorted(KEYS)}"
        for block in part["cpp"]:
            count = len(places_of(block))
            assert count == 1, f"{block['file']}: {quoted(block)[0]} and what follows stands there {count} times; allowed: once"


def listing_code(part):
    """The listing's lines of a part. Fixed form keeps its columns, because labels are before column 6."""
    there = lines_of(LISTING)
    return "".join(f"{number} {there[number - 1]}\n" for number in part["listing"])


def cpp_code(block, numbered=True):
    """The lines of a block without their common indentation."""
    first, count = places_of(block)[0], len(quoted(block))
    there = lines_of(block["file"])[first:first + count]
    indent = min(len(line) - len(line.lstrip(" ")) for line in there)
    return "".join((f"{first + i + 1:3}  " if numbered else "") + f"{line[indent:]}\n" for i, line in enumerate(there))


def markdown_page(edition):
    """The page with the C++ of the kernel, and only the names of other files. The HTML page also quotes the paper."""
    page = f"# The parallel edition\n\n{edition['introduction'].strip(chr(10))}\n\nThe C++ code is from [contct.hpp](../{KERNEL}). The [HTML page]" \
           f"(parallel-edition.html) also quotes the paper and other files. This command writes both pages:\n\n```sh\n{COMMAND}\n```\n\n" \
           f"<table>\n"
    for part in edition["part"]:
        equation = f" Eq. {part['equation']}." if part["equation"] else ""
        page += f"<tr><td>\n\n**{plain(heading(part))}.**{equation}\n\n```fortran\n{listing_code(part)}```\n\n</td><td>\n\n{plain(part['note'])}\n"
        code = "".join(cpp_code(block, numbered=False) for block in part["cpp"] if block["file"] == KERNEL)
        page += f"\n```cpp\n{code}```\n" if code else ""
        others = dict.fromkeys(block["file"] for block in part["cpp"] if block["file"] != KERNEL)
        page += "".join(f"\n[{Path(file).name}](../{file})\n" for file in others) + "\n</td></tr>\n"
    return page + "</table>\n"


def html_page(edition):
    escaped = lambda text: html.escape(text, quote=False)
    page = HEAD + "<section class=\"parallel-edition\">\n<h2>The parallel edition</h2>\n" \
                  f"<p>{escaped(edition['introduction'].strip(chr(10)))}</p>\n"
    for part in edition["part"]:
        equation = f" <b>Eq. {escaped(part['equation'])}</b>" if part["equation"] else ""
        code = "".join(f"<p><code>{escaped(block['file'])}</code></p>\n<pre>{escaped(cpp_code(block))}</pre>\n" for block in part["cpp"])
        page += f"<h3>{escaped(heading(part))}</h3>\n<blockquote>{escaped(part['paper'])}{equation}</blockquote>\n{TABLE}" \
                f"<tr><td><pre>{escaped(listing_code(part))}</pre></td>\n<td>{code}</td></tr>\n</table>\n<p>{escaped(part['note'])}</p>\n"
    return page + "</section>\n</body>\n</html>\n"


edition = tomllib.loads((ROOT / "reference/parallel-edition.toml").read_text())
check(edition["part"])
for ending, page in (("md", markdown_page(edition)), ("html", html_page(edition))):
    file = ROOT / f"reference/parallel-edition.{ending}"
    if "--write" in sys.argv:
        file.write_text(page)
    assert file.read_text() == page, f"{file.name} is not what the map and the sources make; {COMMAND} makes it"
