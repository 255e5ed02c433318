"""library.py TREE WORK [COUNT [SEED]]: asks how many random one-operator mutants of the library the quick tests kill.

Copies TREE to the new folder WORK and replaces one operator each in COUNT (200) random lines of cpp/contct, so that one
build has all mutants and CONTCT_MUTANT=N switches one on. A line whose mutant does not compile is replaced by another.
A first run records which tests reach which mutants; then each mutant is tried by the tests that reach it, the quickest
first. A test that fails without a mutant counts for none. The same COUNT, SEED and cpp/contct give the same mutants.
Prints one line for each mutant and closes with the number killed. Run alone: tests have ten times their time.
"""
import json
import os
import random
import re
import shutil
import subprocess
import sys
import time
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

OTHER = {"<": "<=", "<=": "<", ">": ">=", ">=": ">", "==": "!=", "!=": "==", "+": "-", "-": "+", "*": "/", "/": "*",
         "&&": "||", "||": "&&", "+=": "-=", "-=": "+=", "*=": "/=", "/=": "*="}
OPERATOR = re.compile(r" (" + "|".join(map(re.escape, sorted(OTHER, key=len, reverse=True))) + r") ")
# Statements of one line: what stands before the expression, the expression, and what stands behind it.
SHAPES = [re.compile(shape) for shape in (
    r"^(\s*return )([^{}]*)(;)$",
    r"^(\s*(?:\} else )?(?:if|while) \()([^;{}]*)(\) (?:\{|[a-z][^(]*;))$",
    r"^(\s*for \([^;]*; )([^;]*)(; [^;]*(?:\{|;)?)$",
    r"^(\s*(?!(?:if|for|while|return|else|\}) )[\w:<>&*. \[\]()-]*[\w\])] = )([^{}]*)(;)$")]
COMPOUND = re.compile(r"^(\s*)([\w.\[\]()> -]+) ([-+*/]=) ([^{}]*;)$")
SWITCH = """#pragma once
#include <fcntl.h>
#include <unistd.h>
#include <cstdlib>
#include <string>
namespace contct {
inline bool mutant(int n) {
  static const int chosen = std::getenv("CONTCT_MUTANT") ? std::atoi(std::getenv("CONTCT_MUTANT")) : -1;
  static const char* const log = std::getenv("CONTCT_REACHED");
  static bool seen[1000];
  if (log && !seen[n]) {
    seen[n] = true;
    const std::string line = std::to_string(n) + "\\n";
    const int file = open(log, O_WRONLY | O_APPEND | O_CREAT, 0644);
    if (write(file, line.data(), line.size()) < 0) std::abort();
    close(file);
  }
  return n == chosen;
}
}  // namespace contct
"""


def mutants_of(line, n):
    """Yields (the two operators, the line that has the mutant n) for every operator of a statement of one line."""
    code = line.split("  //")[0]
    if any(word in code for word in ('"', "'", "constexpr", "operator", "template", "#")):
        return
    if found := COMPOUND.match(code):
        indent, left, operator, right = found.groups()
        yield (f"{operator} {OTHER[operator]}",
               f"{indent}{{ if (contct::mutant({n})) {left} {OTHER[operator]} {right} else {left} {operator} {right} }}")
        return
    for shape in SHAPES:
        if found := shape.match(code):
            before, right, behind = found.groups()
            for at in OPERATOR.finditer(right):
                wrong = right[:at.start(1)] + OTHER[at[1]] + right[at.end(1):]
                yield f"{at[1]} {OTHER[at[1]]}", f"{before}contct::mutant({n}) ? ({wrong}) : ({right}){behind}"
            return


def chosen_in(tree, count, seed):
    """Returns COUNT times two (file, line from 0, index of the operator), the second half as reserves, in random order."""
    places = []
    for file in sorted((tree / "cpp/contct").rglob("*.?pp")):
        for at, line in enumerate(file.read_text().splitlines()):
            places += [(file.relative_to(tree), at, i) for i, _ in enumerate(mutants_of(line, 0))]
    random.Random(seed).shuffle(places)
    lines = set()
    return [p for p in places if p[:2] not in lines and not lines.add(p[:2])][:2 * count]


def write_mutants(tree, work, places):
    """Writes the sources with the mutants of `places`, {number: place}, and returns their operators."""
    operators = {}
    for source in sorted((tree / "cpp/contct").rglob("*.?pp")):
        file = source.relative_to(tree)
        lines = source.read_text().splitlines()
        mine = [(n, *place[1:]) for n, place in places.items() if place[0] == file]
        for n, at, i in mine:
            operators[n], lines[at] = list(mutants_of(lines[at], n))[i]
        text = '#include "contct/mutant.hpp"\n#line 1\n' * bool(mine) + "\n".join(lines) + "\n"
        if (work / file).read_text() != text:
            (work / file).write_text(text)
    return operators


def build(tree, work, count, seed):
    """Builds the tests with COUNT mutants; returns {number: place} and their operators."""
    shutil.copytree(tree, work, ignore=shutil.ignore_patterns("build", ".git"))
    subprocess.run("git init -q; git add -A", cwd=work, shell=True, check=True)
    (work / "cpp/contct/mutant.hpp").write_text(SWITCH)
    reserve = chosen_in(tree, count, seed)
    places = {n: reserve.pop(0) for n in range(count)}
    subprocess.run(["cmake", "--preset", "release", "-DCONTCT_BUILD_TESTS=ON", "-DCMAKE_CXX_FLAGS=-w"], cwd=work, check=True,
                   stdout=subprocess.DEVNULL)
    while True:
        operators = write_mutants(tree, work, places)
        done = subprocess.run(["cmake", "--build", "--preset", "release", "--", "-k", "0"], cwd=work, capture_output=True, text=True,
                              check=False)
        if done.returncode == 0:
            return places, operators
        wrong = {(Path(file).name, int(line) - 1) for file, line in re.findall(r"(\S+\.[ch]pp):(\d+):", done.stdout)}
        bad = [n for n, (file, at, _) in places.items() if (file.name, at) in wrong]
        if not bad:
            sys.exit(done.stdout)
        for n in bad:
            places[n] = reserve.pop(0)


def run(test, folder, **more):
    """Runs a test of ctest's list; returns (True if it passed, seconds)."""
    properties = {p["name"]: p["value"] for p in test["properties"]}
    given = dict(pair.split("=", 1) for pair in properties.get("ENVIRONMENT", []))
    began = time.monotonic()
    try:
        done = subprocess.run(test["command"], cwd=properties.get("WORKING_DIRECTORY", folder), env=os.environ | given | more.pop("env"),
                              stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL, check=False, **more)
        return done.returncode == properties.get("SKIP_RETURN_CODE", 0) or done.returncode == 0, time.monotonic() - began
    except subprocess.TimeoutExpired:
        return False, time.monotonic() - began


def recorded(work, workers):
    """Returns [(seconds, mutants that the test reaches, test)] of the tests that pass without a mutant, the quickest first."""
    listed = subprocess.run(["ctest", "--preset", "release", "--show-only=json-v1"], cwd=work, check=True, capture_output=True, text=True)
    tests = json.loads(listed.stdout)["tests"]

    def record(numbered):
        number, test = numbered
        log = work / f"reached-{number}"
        passed, seconds = run(test, work, env={"CONTCT_REACHED": str(log)})
        return passed, seconds, set(map(int, log.read_text().split())) if log.exists() else set(), test
    done = [record((0, tests[0])), *workers.map(record, enumerate(tests[1:], 1))]  # the first makes the empty folder
    print(f"{len(done)} tests, {sum(not row[0] for row in done)} fail without a mutant:",
          *(row[3]["name"] for row in done if not row[0]), sep="\n  ", flush=True)
    return sorted((row[1:] for row in done if row[0]), key=lambda row: row[0])


def main(tree, work, count="200", seed="1"):
    tree, work = Path(tree).resolve(), Path(work).resolve()
    places, operators = build(tree, work, int(count), int(seed))
    with ThreadPoolExecutor(os.cpu_count()) as workers:
        tests = recorded(work, workers)

        def killer(n):
            """Returns the first test that fails with the mutant, or how many tests reach it."""
            reaching = [(seconds, test) for seconds, reached, test in tests if n in reached]
            for seconds, test in reaching:
                if not run(test, work, env={"CONTCT_MUTANT": str(n)}, timeout=20 + 10 * seconds)[0]:
                    return True, test["name"]
            return False, f"LIVES, {len(reaching)} tests"
        killed = 0
        for n, (dead, said) in zip(places, workers.map(killer, places)):
            killed += dead
            file, at, _ = places[n]
            print(f"{n}: {file}:{at + 1}: {operators[n]}: {said}", flush=True)
    print(f"{killed} of {len(places)} mutants killed")
    return 1 if len(tests) < 500 else 0


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]))
