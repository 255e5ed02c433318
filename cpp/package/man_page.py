"""man_page.py NAMES SECTION SUMMARY VERSION DATE PAGE: converts a page of reference/ to a manual page with man macros.

It converts headings, paragraphs, lists, tables, code, bold text, code spans, and the text of links. A row of a table
becomes an entry: the first cell is the term, and the middle cells get the names of their columns. A row that begins
with bold text becomes a heading."""
import re
import sys
import textwrap
from pathlib import Path

ESCAPES = {"\\": "\\e", "-": "\\-", "^": "\\(ha", "~": "\\(ti", "'": "\\(aq", "`": "\\(ga"}
BLOCK = re.compile(r"^```\w*\n(?P<code>[\s\S]*?)^```$|(?P<shown>(?:^    .*\n)+)|^(?P<level>##+) (?P<heading>.*)$|"
                   r"(?P<table>(?:^\|.*\n)+)|(?P<text>(?:^(?!```|#|\||    ).+\n)+)", re.M)
SEE_ALSO = ("contct (1)", "contct-problem (5)", "contct-result (5)")


def roff(text):
    """Escape a text, so that hyphens do not become dashes and no line begins a request."""
    return re.sub(r"^\.", r"\\&.", "".join(ESCAPES.get(character, character) for character in text), flags=re.M)


def lines(text):
    """Convert a paragraph to lines of at most 60 characters. Links become their text; bold text and code become
    bold."""
    text = re.sub(r"\[((?:`[^`]*`|[^]`])*)\]\([^)]*\)", r"\1", " ".join(text.split()))
    text = "\n".join(textwrap.wrap(text, 60, break_long_words=False, break_on_hyphens=False))
    parts = re.split(r"`([^`]*)`|\*\*(.*?)\*\*", text, flags=re.S)
    return "".join(roff(part) if i % 3 == 0 else f"\\fB{roff(part)}\\fR" for i, part in enumerate(parts) if part)


def entries(table):
    head, _, *rows = [[cell.strip().replace("\\|", "|") for cell in re.split(r"(?<!\\)\|", line)[1:-1]]
                      for line in table.splitlines()]
    for first, *others in rows:
        named = [f"{name.split(',')[0]}: {cell}" for name, cell in zip(head[1:-1], others) if cell]
        yield f".SS {lines(first.strip('*'))}" if first.startswith("**") else ".TP\n" + lines(first).replace("\n", " ")
        yield from (lines(part) for part in ("; ".join(named) + "." * bool(named), others[-1]) if part)


def blocks(markdown):
    for found in BLOCK.finditer(markdown):
        part = found.groupdict()
        if code := part["code"] or textwrap.dedent(part["shown"] or ""):
            yield ".PP\n.RS 4\n.nf\n" + roff(code).rstrip("\n") + "\n.fi\n.RE"
        elif part["heading"]:
            yield (".SH " if part["level"] == "##" else ".SS ") + lines(part["heading"]).replace("\n", " ")
        elif part["table"]:
            yield from entries(part["table"])
        else:
            for item in filter(None, re.split(r"^(?=- )", part["text"], flags=re.M)):
                yield ".IP \\(bu 2\n" + lines(item[2:]) if item.startswith("- ") else ".PP\n" + lines(item)


def main(names, section, summary, version, date, page):
    title = names.split(",")[0]
    text = re.sub(r"^(\.S[HS] .*)\n\.PP", r"\1", "\n".join(blocks(Path(page).read_text())), flags=re.M)
    print(f'.TH {roff(title.upper())} {section} {date} "contct {version}"\n.nh\n.SH NAME\n{roff(names)} \\- {summary}\n.SH DESCRIPTION\n'
          f"{text.removeprefix('.PP').strip()}\n.SH SEE ALSO")
    print(",\n".join(f".BR {roff(other)}" for other in SEE_ALSO if other.split()[0] != title))


main(*sys.argv[1:])
