"""library.py TREE WORK [COUNT [SEED]]: counts how many random one-operator mutants of the library of TREE the quick
tests of TREE kill.

Copies TREE to WORK, and makes COUNT (200) operators of cpp/contct, drawn with SEED, switchable: a file in WORK selects
the mutant, so that everything is compiled once. A first run of all tests records which tests reach which operator; a
mutant is then tested by these alone. Prints a line for each mutant, and the sum. Outside the count: the kernels, whose
mutants are in mutants.toml, and operators for whose operands the other operator does not exist.
"""
import json
import random
import re
import shutil
import subprocess
import sys
from pathlib import Path

LONGEST = 120  # seconds for a test that runs a mutant, which may not end
OPERATORS = {"<": "<=", "<=": "<", ">": ">=", ">=": ">", "==": "!=", "!=": "==", "+": "-", "-": "+", "*": "/", "/": "*"}
IGNORED = re.compile(r'"(?:\\.|[^"\\\n])*"|//[^\n]*|^\s*#[^\n]*|\btemplate <[^\n]*|\brequires\b[^\n]*|\boperator\s*\S+', re.M)
SWITCHED = """#pragma once
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <string>
#include <utility>
#include <unistd.h>
namespace contct_mutant {
constexpr int count = @COUNT@;
inline bool reached[count + 1] = {};
inline bool possible[count + 1] = {};
inline void record() {
  std::ofstream file("@WORK@/reached/" + std::to_string(getpid()), std::ios::app);
  for (int i = 1; i <= count; ++i)
    if (reached[i] && possible[i]) file << i << '\\n';
}
inline int selected() {  // 0: none; -1: records which operators are reached
  int number = 0;
  std::ifstream("@WORK@/selected") >> number;
  if (number == -1) std::atexit(record);
  return number;
}
inline const int active = selected();
template <int Site>
inline bool is_on() {
  if (active == -1) reached[Site] = possible[Site] = true;
  return active == Site;
}
template <class L> struct left { L&& value; };
@OVERLOADS@
}
"""
OVERLOAD = """template <int Site> struct @NAME@ {};
template <int Site, class L> struct left_@NAME@ { L&& value; };
template <int Site, class L>
constexpr left_@NAME@<Site, L> operator@FIRST@(L&& l, @NAME@<Site>) { return {std::forward<L>(l)}; }
template <int Site, class L, class R>
constexpr auto operator@SECOND@(left_@NAME@<Site, L>&& l, R&& r)
    -> std::decay_t<decltype(std::forward<L>(l.value) @OP@ std::forward<R>(r))> {
  if constexpr (requires { std::forward<L>(l.value) @OTHER@ std::forward<R>(r); }) {
    if (!std::is_constant_evaluated() && is_on<Site>()) return std::forward<L>(l.value) @OTHER@ std::forward<R>(r);
  }
  return std::forward<L>(l.value) @OP@ std::forward<R>(r);
}
"""
# The operators that stand on the two sides of a site, with the precedence and the order of evaluation of the original.
SIDES = {"<": "<>", "<=": "<>", ">": "<>", ">=": "<>", "==": ("==", "=="), "!=": ("!=", "!="), "+": "++", "-": "--",
         "*": "**", "/": "**"}
NAMES = dict(zip(OPERATORS, ("less", "at_most", "more", "at_least", "equal", "unequal", "sum", "difference", "product", "quotient")))


def header_of(work, count):
    overloads = ""
    for op, other in OPERATORS.items():
        first, second = SIDES[op]
        for mark, value in (("NAME", NAMES[op]), ("FIRST", first), ("SECOND", second), ("OP", op), ("OTHER", other)):
            overloads += "" if mark != "NAME" else OVERLOAD
            overloads = overloads.replace(f"@{mark}@", value)
    return SWITCHED.replace("@COUNT@", str(count)).replace("@WORK@", str(work)).replace("@OVERLOADS@", overloads)


def sites_of(tree):
    """Yields (file, begin, end, operator) of each binary operator in the library's sources but the kernels'."""
    for file in sorted((tree / "cpp/contct").rglob("*.[ch]pp")):
        if file.parent.name == "kernel":
            continue
        text = IGNORED.sub(lambda m: re.sub(r"[^\n]", "x", m[0]), file.read_text())
        for m in re.finditer(r"(?<=[\w)\]]) (<=|>=|==|!=|[<>+*/-]) (?=[\w(*!-])", text):
            yield file, m.start(1), m.end(1), m[1]


def make_switchable(tree, work, count, seed):
    """Copies the tree, draws the operators and replaces them; returns their places in words, from number 1."""
    shutil.copytree(tree, work / "tree", ignore=shutil.ignore_patterns("build", ".git"))
    sites = random.Random(seed).sample(list(sites_of(work / "tree")), count)
    places = []
    for number, (file, begin, end, op) in enumerate(sites, 1):
        text = file.read_text()
        places.append(f"{file.relative_to(work / 'tree')}:{text.count(chr(10), 0, begin) + 1}: {op} to {OPERATORS[op]}")
    for number, (file, begin, end, op) in sorted(enumerate(sites, 1), key=lambda s: -s[1][1]):
        first, second = SIDES[op]
        text = file.read_text()
        file.write_text(f"{text[:begin]}{first} contct_mutant::{NAMES[op]}<{number}>() {second}{text[end:]}")
    (work / "reached").mkdir()
    (work / "mutant.hpp").write_text(header_of(work, count))
    return places


def build(work):
    flags = f"-O1 -DNDEBUG -w -include {work / 'mutant.hpp'}"
    subprocess.run(["cmake", "--preset", "release", "-DCMAKE_BUILD_TYPE=Release", f"-DCMAKE_CXX_FLAGS_RELEASE={flags}",
                    "-DCMAKE_DISABLE_PRECOMPILE_HEADERS=ON", "-DCONTCT_BUILD_TESTS=ON"], cwd=work / "tree", check=True)
    subprocess.run(["cmake", "--build", "--preset", "release"], cwd=work / "tree", check=True)


def tests_of(work):
    """Returns {name: (command, folder)} of the programs of Catch2, each run as a whole, and of the other quick tests."""
    shown = json.loads(subprocess.run(["ctest", "--preset", "quick", "--show-only=json-v1"], cwd=work / "tree", check=True,
                                      capture_output=True, text=True).stdout)["tests"]
    found = {}
    for test in shown:
        if "command" not in test:
            continue
        name, command = test["name"], test["command"]
        folder = next(p["value"] for p in test["properties"] if p["name"] == "WORKING_DIRECTORY")
        if re.search(r"contct_\w+_tests$", command[0]):
            name, command = Path(command[0]).name, [command[0], "--abort"]
        found.setdefault(name, (command, folder))
    return found


def run_test(command, folder):
    """Returns True if the test passes."""
    try:
        return subprocess.run(command, cwd=folder, capture_output=True, timeout=LONGEST, check=False).returncode == 0
    except subprocess.TimeoutExpired:
        return False


def reached_by(work, tests):
    """Returns {number of an operator: names of the tests that reach it}."""
    found = {}
    for name, test in tests.items():
        (work / "selected").write_text("-1")
        if not run_test(*test):
            print(f"fails without a mutant, and is not used: {name}", flush=True)
        for file in (work / "reached").iterdir():
            for number in file.read_text().split():
                found.setdefault(int(number), []).append(name) if name not in found.get(int(number), []) else None
            file.unlink()
    return found


def main(tree, work, count="200", seed="1"):
    work = Path(work).resolve()
    places = make_switchable(Path(tree), work, int(count), int(seed))
    build(work)
    tests = tests_of(work)
    reached = reached_by(work, tests)
    killed = 0
    for number, place in enumerate(places, 1):
        (work / "selected").write_text(str(number))
        room = place.split("/")[2]
        names = sorted(reached.get(number, []), key=lambda name: f"_{room}_" not in name)
        by = next((name for name in names if not run_test(*tests[name])), None)
        killed += by is not None
        words = f"killed by {by}" if by else f"lives; {len(names)} tests reach it"
        print(f"{number} {place}: {words}", flush=True)
    print(f"{killed} of {len(places)} mutants killed")
    return 0


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]))
