"""Fails when a relative link of README.md or reference/**/*.md leads to no file, or to no heading of a page.
Usage: links.py ROOT LEAST"""
import glob
import os
import re
import sys


FENCED = re.compile(r"^( *)(```+|~~~+).*?^ *\2[`~]*[ \t]*$", re.DOTALL | re.MULTILINE)


def without_code(text):
    """Returns the text without code, and with its line breaks."""
    text = FENCED.sub(lambda m: re.sub(r"[^\n]", "", m[0]), text)
    return re.sub(r"(`+)(?!`)[^\n]*?(?<!`)\1(?!`)", "", text)


def anchors_of(text):
    """Returns the anchors that GitHub makes from headings: letters, digits, _ and -, with - for blanks; a repeated
    anchor gets -1."""
    names = []
    for heading in re.findall(r"^#{1,6} +(.*?)[ \t]*$", FENCED.sub("", text), re.MULTILINE):
        words = re.sub(r"\[([^\]]*)\]\([^)]*\)", r"\1", heading).lower()
        names.append(re.sub(r"[^\w\- ]", "", words).replace(" ", "-"))
    return {f"{name}-{names[:i].count(name)}" if name in names[:i] else name for i, name in enumerate(names)}


def read(path):
    with open(path, encoding="utf-8") as file:
        return file.read()


def links_of(text):
    """Yields (line, target) of [words](target "title") and [name]: target."""
    plain = without_code(text)
    for m in re.finditer(r"\]\(\s*<?([^\s)>]+)>?(?:\s+\"[^\"]*\")?\s*\)|^\[[^\]]+\]:\s+(\S+)", plain, re.MULTILINE):
        yield plain.count("\n", 0, m.start()) + 1, m[1] or m[2]


def wrong_in(root, page, target):
    path, _, anchor = target.partition("#")
    to = os.path.normpath(os.path.join(root, os.path.dirname(page), path)) if path else os.path.join(root, page)
    if not os.path.exists(to):
        return "allowed: a file or a folder of the project"
    if anchor and to.endswith(".md") and anchor not in anchors_of(read(to)):
        return f"allowed: a heading of {os.path.relpath(to, root)}"
    if anchor and to.endswith(".html") and not re.search(rf"\bid=\"{re.escape(anchor)}\"", read(to)):
        return f"allowed: an id in {os.path.relpath(to, root)}"
    return ""


def main(root, least):
    count, wrong = 0, []
    for page in ["README.md"] + sorted(glob.glob("reference/**/*.md", root_dir=root, recursive=True)):
        for line, target in links_of(read(os.path.join(root, page))):
            if re.match(r"[a-z]+:", target):
                continue  # a link to another site
            count += 1
            if problem := wrong_in(root, page, target):
                wrong.append(f"{page}:{line}: found a link to {target}; {problem}")
    print("\n".join(wrong))
    print(f"{count} relative links, {len(wrong)} of them lead nowhere")
    if count < int(least):
        print(f"found {count} relative links; allowed: {least} or more")
        return 1
    return 1 if wrong else 0


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]))
