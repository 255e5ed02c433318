"""Fails when a sentence for users has a phrase of phrases.txt: the program's messages, help and page, README.md and reference/.
Usage: words.py ROOT PHRASES LEAST"""
import glob
import json
import os
import re
import sys

ROOMS = ("app", "contct/certify", "contct/compare", "contct/exact", "contct/lab", "contct/outside", "contct/path", "contct/read",
         "contct/solve", "contct/structure", "contct/text", "contct/trace", "contct/write")
LITERAL = re.compile(r'"""(.*?)"""|"((?:\\.|[^"\\\n])*)"|`((?:\\.|[^`\\])*)`', re.DOTALL)


def literals(source):
    """The string literals of C++, JavaScript, Python or TOML that are sentences: neighbours are one, comments are left out, and so
    are words without a blank, which are keys and values."""
    plain = re.sub(r"^\s*#include[^\n]*|(?<!:)//[^\n]*", "", source, flags=re.MULTILINE)
    for m in LITERAL.finditer(re.sub(r'"[ \t]*\n\s*"', "", plain)):
        if " " in m[m.lastindex].strip():
            yield m[m.lastindex]


def paragraphs(source):
    """The paragraphs and cells of Markdown, without code."""
    plain = re.sub(r"^\s*(```+|~~~+).*?^\s*\1", "\n\n", source, flags=re.DOTALL | re.MULTILINE)
    return re.split(r"\n\s*\n|\n(?=\s*(?:[|#>*-]|\d+\.) ?)", re.sub(r"^    .*", "", plain, flags=re.MULTILINE))


def texts_of(name, source):
    """What a file has for users: of HTML what stands between tags and what is read out, of a notebook its prose."""
    if name.endswith(".md"):
        return paragraphs(source)
    if name.endswith(".html"):
        shown = re.sub(r"<(style|script|svg)\b.*?</\1>", "", source, flags=re.DOTALL)
        return [a or b for a, b in re.findall(r'(?:aria-label|title|alt)="([^"]*)"|>([^<>]+)<', shown)]
    if name.endswith(".ipynb"):
        return [t for c in json.loads(source)["cells"] if c["cell_type"] == "markdown" for t in paragraphs("".join(c["source"]))]
    return literals(source)


def files_of(root):
    found = ["README.md", "reference/verification.toml", "cpp/package/contct.py"]
    for room in ROOMS:
        found += glob.glob(f"cpp/{room}/*.[ch]pp", root_dir=root)
    found += glob.glob("cpp/contct/write/report/*.js", root_dir=root) + glob.glob("cpp/contct/write/report/*.html", root_dir=root)
    found += glob.glob("reference/**/*.md", root_dir=root, recursive=True)
    found += glob.glob("reference/**/*.ipynb", root_dir=root, recursive=True)
    return sorted(found)


def pattern_of(phrase):
    words = [re.escape(w[:-1]) + r"(?:s|'s|s')?" if w.endswith("*") else re.escape(w) for w in phrase.split()]
    end = r"(?![\w-])" if phrase[-1].isalnum() or phrase[-1] == "*" else ""
    return re.compile(r"(?<![\w-])" + r"\s+".join(words) + end, re.IGNORECASE)


def phrases_in(path):
    list_ = []
    with open(path, encoding="utf-8") as file:
        for line in file:
            if line.strip() and not line.startswith("#"):
                phrase, instead = line.rstrip("\n").split(" -> ")
                list_.append((phrase, pattern_of(phrase), instead))
    return list_


def main(root, phrases, least):
    looked_at, found = 0, []
    list_ = phrases_in(phrases)
    for name in files_of(root):
        with open(os.path.join(root, name), encoding="utf-8") as file:
            texts = [text for text in texts_of(name, file.read()) if re.search(r"[A-Za-z]{2}", text)]
        looked_at += len(texts)
        for text in texts:
            plain = re.sub(r"`[^`]*`", "`", text)  # code is not a sentence
            for phrase, pattern, instead in list_:
                for hit in pattern.finditer(plain):
                    found.append(f"{name}: found \"{hit[0]}\" in \"{' '.join(plain.split())[:70]}\"; allowed: {instead}")
    print("\n".join(found))
    print(f"{looked_at} texts, {len(list_)} phrases, {len(found)} of them found")
    if looked_at < int(least):
        print(f"found {looked_at} texts; allowed: {least} or more")
        return 1
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]))
