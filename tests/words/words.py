"""Fails when a sentence for users has a phrase of phrases.txt: the program's messages, help and page, README.md and reference/.
Usage: words.py ROOT PHRASES LEAST"""
import glob
import os
import re
import sys

from literals import cxx_literals, html_texts, js_literals, markdown_lines, notebook_texts, python_texts, toml_texts

ROOMS = ("app", "contct/certify", "contct/compare", "contct/exact", "contct/lab", "contct/outside", "contct/path", "contct/read",
         "contct/solve", "contct/structure", "contct/text", "contct/trace", "contct/write")
READERS = {".cpp": cxx_literals, ".hpp": cxx_literals, ".js": js_literals, ".html": html_texts, ".md": markdown_lines,
           ".toml": toml_texts, ".py": python_texts, ".ipynb": notebook_texts}


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
            texts = READERS[os.path.splitext(name)[1]](file.read())
        keys = name.endswith((".cpp", ".hpp", ".js", ".py"))
        for line, text in texts:
            if not re.search(r"[A-Za-z]{2}", text) or (keys and " " not in text.strip()):  # a key, a value, a file
                continue
            looked_at += 1
            plain = re.sub(r"`[^`]*`", "`", text)  # code is not a sentence
            for phrase, pattern, instead in list_:
                for hit in pattern.finditer(plain):
                    found.append(f"{name}:{line}: found \"{hit[0]}\"; allowed: {instead}")
    print("\n".join(found))
    print(f"{looked_at} texts, {len(list_)} phrases, {len(found)} of them found")
    if looked_at < int(least):
        print(f"found {looked_at} texts; allowed: {least} or more")
        return 1
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]))
