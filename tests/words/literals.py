"""The text that a user can read, taken from sources: string literals of C++ and JavaScript, the text of HTML,
the prose of Markdown. Each is a pair (line, text)."""
import ast
import json
import re

# One alternative a token; a comment or a literal ends where C++ says so, so neither hides in the other.
CXX = re.compile(
    r'''(?P<comment>//[^\n]*|/\*.*?\*/)
      | (?P<include>^[ \t]*\#[ \t]*include[^\n]*)
      | (?:u8|[uUL])?R"(?P<fence>[^()\\\s]{0,16})\((?P<raw>.*?)\)(?P=fence)"
      | (?:u8|[uUL])?"(?P<plain>(?:\\.|[^"\\\n])*)"
      | (?P<digits>\b\d[\w.']*)
      | (?P<char>'(?:\\.|[^'\\\n])+')
      | (?P<space>\s+)
      | (?P<other>.)''',
    re.VERBOSE | re.DOTALL | re.MULTILINE)
ESCAPES = {"n": "\n", "t": "\t", '"': '"', "'": "'", "\\": "\\", "0": "\0"}


def unescaped(text):
    return re.sub(r"\\(.)", lambda m: ESCAPES.get(m[1], m[0]), text, flags=re.DOTALL)


def cxx_literals(source):
    """Adjacent literals are one."""
    found, begun, at = [], None, 0
    for m in CXX.finditer(source):
        text = m["raw"] if m["raw"] is not None else m["plain"] and unescaped(m["plain"]) or m["plain"]
        if text is not None:
            if begun is None:
                begun, at = "", source.count("\n", 0, m.start()) + 1
            begun += text
        elif begun is not None and not m["space"] and not m["comment"]:
            found.append((at, begun))
            begun = None
    if begun is not None:
        found.append((at, begun))
    return found


JS = re.compile(
    r'''(?P<comment>//[^\n]*|/\*.*?\*/)
      | "(?P<double>(?:\\.|[^"\\\n])*)"
      | '(?P<single>(?:\\.|[^'\\\n])*)'
      | `(?P<template>(?:\\.|[^`\\])*)`
      | (?P<regex>(?<=[(=,:;!&|?\[{}\n])[ \t]*/(?![/*])(?:\\.|\[(?:\\.|[^\]\\\n])*\]|[^/\\\n\[])+/[a-z]*)
      | (?P<other>.)''',
    re.VERBOSE | re.DOTALL)


def js_literals(source):
    """What is computed inside a template literal is left out, but for the literals in it."""
    found = []
    for m in JS.finditer(source):
        at = source.count("\n", 0, m.start()) + 1
        for name in ("double", "single"):
            if m[name] is not None:
                found.append((at, unescaped(m[name])))
        if m["template"] is not None:
            found.append((at, unescaped(re.sub(r"\$\{[^{}]*\}", "{}", m["template"]))))
            for inner in re.finditer(r"\$\{([^{}]*)\}", m["template"]):
                found += [(at, text) for _, text in js_literals(inner[1])]
    return found


def html_texts(source):
    """What stands between tags, and the attributes that are read out or shown."""
    kept = re.sub(r"<!--.*?-->|<(style|script|svg)\b.*?</\1>|\{\{\w+\}\}", lambda m: "\n" * m[0].count("\n"), source, flags=re.DOTALL)
    found = []
    for m in re.finditer(r"(?:aria-label|title|alt|placeholder)=\"([^\"]*)\"|>([^<>]+)<", kept):
        found.append((kept.count("\n", 0, m.start()) + 1, (m[1] or m[2]).strip()))
    return [(line, text) for line, text in found if text]


def markdown_lines(source):
    """Paragraphs and cells: lines that belong together are one text. Code blocks are left out, code spans are replaced."""
    found, fence, text, at, blank = [], None, "", 0, True

    def end():
        nonlocal text
        if text.strip():
            found.append((at, text))
        text = ""

    for number, line in enumerate(source.split("\n"), 1):
        mark = re.match(r"\s*(```+|~~~+)", line)
        if fence:
            fence = None if mark and mark[1].startswith(fence) else fence
            continue
        if mark:
            end()
            fence = mark[1]
            continue
        code = line.startswith("    ") and not text and blank
        blank = not line.strip()
        if blank or re.match(r"\s*([|#>*-]|\d+\.) ?", line):
            end()
        if blank or code:
            blank = True  # a block of code goes on
            continue
        if not text:
            at = number
        text += line + "\n"
    end()
    return [(line, re.sub(r"(`+).*?\1", "`code`", text, flags=re.DOTALL).replace("](", "] (")) for line, text in found]


def python_texts(source):
    """Docstrings and other literals; of an f-string its parts."""
    found = []
    for node in ast.walk(ast.parse(source)):
        if isinstance(node, ast.Constant) and isinstance(node.value, str):
            found.append((node.lineno, re.sub(r"`[^`]*`", "`code`", node.value)))
    return sorted(found)


def notebook_texts(source):
    """The prose of a notebook; a line is that of its cell's first one in the file, counted on."""
    found, behind = [], 0
    for cell in json.loads(source)["cells"]:
        behind = source.index(f'"id": "{cell["id"]}"', behind)
        if cell["cell_type"] == "markdown":
            first = source.count("\n", 0, source.index('"source"', behind)) + 1
            found += [(first + line, text) for line, text in markdown_lines("".join(cell["source"]))]
    return found


def toml_texts(source):
    """What verification.toml says in words: contct verify prints it."""
    return [(source.count("\n", 0, m.start()) + 1, m[1])
            for m in re.finditer(r"^(?:source|because|reason)\s*=\s*\"((?:\\.|[^\"\\])*)\"", source, re.MULTILINE)]
