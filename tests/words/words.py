"""Fails when a sentence has a phrase of phrases.txt: the program's messages, help and page, README.md and reference/,
the comments of cpp/ and tests/, and the names of tests; and when a name has a semicolon, at which CMake cuts it, so
that ctest would run no test.
Usage: words.py ROOT PHRASES LEAST"""
import re
import sys
from pathlib import Path

LITERAL = re.compile(r'"""(.*?)"""|"((?:\\.|[^"\\\n])*)"|`((?:\\.|[^`\\])*)`', re.DOTALL)


def texts_of(file):
    """Returns the texts of a file for users: the paragraphs of a page, or the string literals of a source that
    contain a blank; others are keys and values."""
    source = file.read_text(encoding="utf-8")
    if file.suffix in (".md", ".html", ".ipynb"):
        plain = re.sub(r"^\s*(```+|~~~+).*?^\s*\1|^    .*?$|<(style|script|svg)\b.*?</\2>|<[^<>]*>", "\n\n", source, flags=re.DOTALL | re.MULTILINE)
        return re.split(r"\n\s*\n|\n(?=\s*(?:[|#>*-]|\d+\.) ?)", re.sub(r"`[^`]*`", "`", plain))
    plain = re.sub(r"^\s*#include[^\n]*|(?<!:)//[^\n]*", "", source, flags=re.MULTILINE)
    found = (m[m.lastindex] for m in LITERAL.finditer(re.sub(r'"[ \t]*\n\s*"', "", plain)))
    return [re.sub(r"`[^`]*`", "`", text) for text in found if " " in text.strip()]


def comments_of(file):
    """Returns the comments of a source, with consecutive lines joined, and the names of its tests."""
    source = re.sub(r'R"(\w*)\(.*?\)\1"', '""', file.read_text(encoding="utf-8"), flags=re.DOTALL)
    names = re.findall(r'\b(?:TEST_CASE|SECTION)\(\s*"((?:\\.|[^"\\\n])*)"', source)
    if file.suffix == ".py":
        names += [name.replace("_", " ") for name in re.findall(r"^def (test_\w+)", source, re.MULTILINE)]
    mark = "#" if file.suffix == ".py" else "//[/!<]*"
    plain = re.sub(r'"(?:\\.|[^"\\\n])*"', '""', source)
    runs = re.findall(rf"(?:^[ \t]*{mark}[^\n]*\n)+|(?<=[\s;]){mark} [^\n]*", plain, re.MULTILINE)
    return [re.sub(r"`[^`]*`", "`", text) for text in names + [re.sub(rf"\s*{mark}\s*", " ", run) for run in runs]]


def pattern_of(phrase):
    words = [re.escape(w[:-1]) + r"(?:s|'s|s')?" if w.endswith("*") else re.escape(w) for w in phrase.split()]
    end = r"(?![\w-])" if phrase[-1].isalnum() or phrase[-1] == "*" else ""
    return re.compile(r"(?<![\w-])" + r"\s+".join(words) + end, re.IGNORECASE)


root, phrases, least = Path(sys.argv[1]), Path(sys.argv[2]), int(sys.argv[3])
rows = [line.split(" -> ") for line in phrases.read_text().splitlines() if line[0] != "#"]
patterns = [(pattern_of(phrase), instead) for phrases, instead in rows for phrase in phrases.split("; ")]
files_in = lambda folders, suffixes: sorted(file for folder in folders for file in folder.rglob("*") if file.suffix in suffixes)
sources = files_in([root / "cpp", root / "tests"], (".cpp", ".hpp", ".h", ".c", ".js", ".py"))
pages = [root / "README.md", root / "reference/verification.toml", *files_in([root / "reference"], (".md", ".ipynb")),
         *files_in([root / "cpp" / room for room in ("app", "contct", "package")], (".cpp", ".hpp", ".js", ".html", ".py"))]
looked_at, found = 0, 0
for file, texts in [(file, texts_of) for file in pages] + [(file, comments_of) for file in sources]:
    for text in texts(file):
        looked_at += bool(re.search(r"[A-Za-z]{2}", text))
        for hit, instead in ((hit, instead) for pattern, instead in patterns for hit in pattern.finditer(text)):
            found += 1
            print(f"{file}: found \"{hit[0]}\" in \"{' '.join(text.split())[:70]}\"; allowed: {instead}")
for file in (file for file in sources if file.suffix == ".cpp"):
    for name in re.findall(r'\bTEST_CASE\(\s*"([^"\n]*;[^"\n]*)"', re.sub(r'"[ \t]*\n\s*"', "", file.read_text(encoding="utf-8"))):
        found += 1
        print(f"found the test name \"{name}\"; allowed: no semicolon")
print(f"{looked_at} texts, {len(patterns)} phrases, {found} of them found; allowed: {least} texts or more, and no phrase")
sys.exit(1 if found or looked_at < least else 0)
