"""Reads a manual page in Markdown: its sections and its tables of keys.

In a table of keys the first column has the title "key". Its cells have keys in backticks, or a link such as
[place](#places) to the section whose keys are allowed. A key followed by `?` may be absent. If there is a column
"structure", it names the structures that have the key.
"""
import re

from testing import FENCE


def sections(text):
    """Returns the sections of a page in order: (heading, text up to the next heading of any level)."""
    hidden = FENCE.sub(lambda m: re.sub(r"[^\n]", " ", m.group(0)), text)  # a comment in a code block is not a heading
    starts = list(re.finditer(r"^#+ (.*)$", hidden, re.M))
    ends = [m.start() for m in starts[1:]] + [len(text)]
    return [(m.group(1), text[m.end():end]) for m, end in zip(starts, ends)]


# The part of a link after #.
anchor = lambda heading: re.sub(r"[^\w -]", "", heading.lower()).replace(" ", "-")


def rows(heading, body):
    """Returns {title: rows of the table of keys}; a row is a dictionary by the names of columns. The first title is the
    heading of the section, and each row that begins with bold text is the next title."""
    header, title, found = None, heading, {}
    for line in FENCE.sub("", body).splitlines():
        cells = [cell.strip().replace("\\|", "|") for cell in re.split(r"(?<!\\)\|", line)[1:-1]] if line.startswith("|") else None
        if cells is None or header is None:
            header = cells
        elif header[0] == "key" and cells[0].startswith("**"):
            title = cells[0].strip("*")
        elif header[0] == "key" and set(cells[0]) != {"-"}:
            if len(cells) != len(header):
                raise ValueError(f"found {len(cells)} cells, allowed: {len(header)}: {line}")
            keys = re.findall(r"`[^`]+`\??", cells[0]) or cells[:1]
            found.setdefault(title, []).extend(dict(zip(header, [key, *cells[1:]])) for key in keys)
    return found


class key_tables:
    """The keys that a page documents, by sections."""

    def __init__(self, text):
        self.rows = {}
        for heading, body in sections(text):
            self.rows |= rows(heading, body)
        self.by_anchor = {anchor(heading): heading for heading in self.rows}

    def linked(self, row):
        """Returns the heading of the section to which a row links; None if the row has a key."""
        link = re.fullmatch(r"\[\w+\]\(#([\w-]+)\)", row["key"])
        if not link and row["key"][0] != "`":
            raise ValueError(f"found {row['key']}, allowed: keys in backticks, or a link to a section")
        return link and self.by_anchor[link.group(1)]

    def shared(self):
        """Returns the headings of the sections to which other sections link."""
        return {self.linked(row) for found in self.rows.values() for row in found} - {None}

    def keys(self, heading, structure=None):
        """Returns {key: row} under a heading; if `structure` is given, only its keys."""
        found = {}
        for row in self.rows[heading]:
            if structure and row.get("structure") and structure not in row["structure"].split(", "):
                continue
            other = self.linked(row)
            found |= self.keys(other, structure) if other else {row["key"].strip("`?"): row}
        return found
