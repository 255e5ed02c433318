"""What the page's WebAssembly computes, against what the program computes.
usage: python3 check_playground.py WORK PROGRAM PLAYGROUND    (PLAYGROUND holds contct.js and contct.html)"""
import copy
import glob
import json
import os
import platform
import re
import statistics
import struct
import subprocess
import sys

from wasm_page import WasmPage

work, program, playground = sys.argv[1:]
KERNELS = (["fortran", "cpp"], ["fortran-r4", "cpp-r4"], ["corrected"])
LEAST = {"runs": 160, "numbers": 350_000, "displacements": 70_000, "increments": 1_500, "events": 1_700, "pair states": 8_000,
         "messages": 70, "calls of kernels": 1_500, "lines of unit 26": 2_500, "traces": 50, "replayed calls": 750, "replayed values": 11_000}
MOST_BYTES = 6_000_000
counted = dict.fromkeys(LEAST, 0)
failures = []


def check(true, what):
    if not true:
        failures.append(what)
        if len(failures) <= 40:
            print(f"   FAILED: {what}")


# ---- two results ----

def bits(x):
    return struct.pack(">d", x)


def differences(page, native, place=""):
    """The places where two JSON values differ; numbers with a point are compared to the bit. Counts numbers."""
    if isinstance(page, dict) and isinstance(native, dict):
        found = [f"{place}.{key} is there once" for key in page.keys() ^ native.keys()]
        for key in page.keys() & native.keys():
            found += differences(page[key], native[key], f"{place}.{key}")
        return found
    if isinstance(page, list) and isinstance(native, list):
        found = [] if len(page) == len(native) else [f"{place}: {len(page)} and {len(native)} entries"]
        for i, (a, b) in enumerate(zip(page, native)):
            found += differences(a, b, f"{place}[{i}]")
        return found
    if isinstance(page, float) and isinstance(native, float):
        counted["numbers"] += 1
        return [] if bits(page) == bits(native) else [f"{place}: {page!r} in the page, {native!r} in the program"]
    return [] if type(page) is type(native) and page == native else [f"{place}: {page!r} in the page, {native!r} in the program"]


def without_numbers(result):
    """What must be equal also where another LAPACK rounds otherwise: how the path goes."""
    events = [[i["events"] for i in s["increments"]] for s in result["steps"]]
    states = [[p["state"] for p in s["pairs"]] for s in result["steps"]]
    return {"events": events, "states": states, "status": result["status"], "certified": result["certified"]}


def count(result):
    for step in result["steps"]:
        counted["displacements"] += len(step["displacement"])
        counted["increments"] += len(step["increments"])
        counted["events"] += sum(len(i["events"]) for i in step["increments"])
        counted["pair states"] += len(step["pairs"])


def calls_of(trace):
    """A trace without its header, which names compilers."""
    at = trace.find("\ncall 1\n")
    return trace[at:] if at >= 0 else ""


# ---- the program ----

def run_natively(file, kernels):
    """Exit status, what is said on standard error, and by name what the program writes."""
    names = {"result": "native.json", "log": "native.log", "trace": "native.trace"}
    paths = {key: os.path.join(work, name) for key, name in names.items()}
    for path in paths.values():
        if os.path.exists(path):
            os.remove(path)
    done = subprocess.run([program, "run", file, "--kernels", ",".join(kernels), "--quiet", "--json", paths["result"], "--log",
                           paths["log"], "--trace", paths["trace"]], capture_output=True, encoding="utf-8", check=False)
    written = {}
    for key, path in paths.items():
        with open(path, encoding="utf-8") as text:
            written[key] = text.read()
    return done.returncode, done.stderr, written


def lapack_of(trace):
    return re.search(r"^lapack (.*)$", trace, re.M).group(1)


def same_arithmetic(page_lapack):
    """Why bits cannot be compared here; nothing where they can."""
    if platform.machine() != "x86_64":
        return f"long double of {platform.machine()} is not that of x86_64"
    native = lapack_of(run_natively("reference/problems/pb07-three-gap-supports.toml", ["fortran"])[2]["trace"])
    print(f"   LAPACK of the program: {native}; of the page: {page_lapack}")
    version = page_lapack.split(",")[0]
    is_reference = re.fullmatch(re.escape(version) + r", liblapack\.so[.\d]*", native)
    return "" if is_reference else f"the program's LAPACK is {native}; the page's is {page_lapack}"


# ---- the checks ----

def compare_runs(page, because):
    files = sorted(glob.glob("reference/problems/*.toml") + glob.glob("reference/problems/divergences/*.toml"))
    for file in files:
        with open(file, encoding="utf-8") as text:
            problem = text.read()
        for kernels in KERNELS:
            compare_run(page, because, f"{file}, {','.join(kernels)}", file, problem, kernels)


def compare_run(page, because, name, file, problem, kernels):
    answer = page.call("run", problem, {"kernels": kernels, "log": True, "trace": True, "file": file})
    status, said, native = run_natively(file, kernels)
    check(answer["error"] is None and answer["exit"] == status, f"{name}: exit {answer['exit']} in the page, {status} in the program: {answer['error']}")
    if answer["result"] is None:
        return
    result, expected = answer["result"], json.loads(native["result"])
    counted["runs"] += 1
    count(expected)
    if because:
        result, expected = without_numbers(result), without_numbers(expected)
    found = differences(result, expected)
    check(not found, f"{name}: {len(found)} differences: {'; '.join(found[:4])}")
    for message in answer["messages"]:
        counted["messages"] += 1
        check(because or f"contct: {message}\n" in said, f"{name}: the program does not say: {message}")
    if len(kernels) > 1:
        lockstep = answer["result"]["lockstep"]
        check(lockstep["calls"] > 0 and lockstep["values_compared"] > 0 and lockstep["mismatches"] == 0, f"{name}: lockstep {lockstep}")
    counted["lines of unit 26"] += native["log"].count("\n")
    counted["calls of kernels"] += native["trace"].count("\ncall ")
    if not because:
        check(answer["log"] == native["log"], f"{name}: unit 26 differs")
        check(calls_of(answer["trace"]) == calls_of(native["trace"]) and calls_of(native["trace"]), f"{name}: a kernel's call differs")


def doctored_results_are_noticed():
    before = counted["numbers"]
    file = "reference/problems/pb07-three-gap-supports.toml"
    expected = json.loads(run_natively(file, KERNELS[0])[2]["result"])
    for where in ("displacement", "w"):
        wrong = copy.deepcopy(expected)
        (number,) = struct.unpack(">q", bits(wrong["steps"][1][where][6]))
        (wrong["steps"][1][where][6],) = struct.unpack(">d", struct.pack(">q", number ^ 1))
        found = differences(wrong, expected)
        check(len(found) == 1 and found[0].startswith(f".steps[1].{where}[6]: "), f"a doctored bit of {where} is not noticed: {found}")
    wrong = copy.deepcopy(expected)
    wrong["steps"][0]["pairs"][1]["state"] = "doctored"
    check(len(differences(wrong, expected)) == 1, "a doctored status is not noticed")
    counted["numbers"] = before


def replay_golden_set(page):
    for file in sorted(glob.glob("reference/traces/*.trace")):
        with open(file, encoding="utf-8") as text:
            trace = text.read()
        four = "\nreal 4\n" in trace
        for kernel in ("fortran-r4", "cpp-r4") if four else ("fortran", "cpp"):
            answer = page.call("replay", trace, {"kernel": kernel, "file": file})
            result = answer["result"]
            if result is None:
                check(False, f"{file}, {kernel}: {answer['error']}")
                continue
            check(answer["exit"] == 0 and result["mismatches"] == 0 and result["calls"] == trace.count("\ncall "),
                  f"{file}, {kernel}: exit {answer['exit']}, {result}")
            counted["traces"] += 1
            counted["replayed calls"] += result["calls"]
            counted["replayed values"] += result["values_compared"]


def doctored_traces_are_noticed(page):
    with open("reference/traces/path-pb07-three-gap-supports.trace", encoding="utf-8") as text:
        trace = text.read()
    for what, pattern in (("smin", r"(\nsmin 0x1\.[0-9a-f]*)([0-9a-f])(p)"), ("ss", r"( ss 0x1\.[0-9a-f]*)([0-9a-f])(p)"),
                          ("unit 26", r"(SCALE FACTOR = +0\.[0-9]*)([0-9])(E)")):
        flip = lambda m: m.group(1) + ("0123456789abcdef"[int(m.group(2), 16) ^ 1]) + m.group(3)
        wrong, count_of = re.subn(pattern, flip, trace, count=1)
        for kernel in ("fortran", "cpp"):
            answer = page.call("replay", wrong, {"kernel": kernel})
            check(count_of == 1 and answer["exit"] == 1 and answer["result"]["mismatches"] == 1,
                  f"a doctored bit of {what} is not noticed by {kernel}: {answer}")


def errors_have_their_places(page):
    with open("reference/problems/pb07-three-gap-supports.toml", encoding="utf-8") as text:
        problem = text.read()
    for number, (old, new) in enumerate((("surface   = \"below\"", "surfce    = \"below\""), ("surface   = \"below\"", "surface   = \"beyond\""),
                                         ("elements = 16", "elements = = 16"), ("node      = 13", "node      = 130"))):
        wrong = problem.replace(old, new, 1)
        file = os.path.join(work, f"wrong-{number}.toml")
        with open(file, "w", encoding="utf-8") as out:
            out.write(wrong)
        done = subprocess.run([program, "run", file], capture_output=True, encoding="utf-8", check=False)
        answer = page.call("run", wrong, {"file": file})
        error = answer["error"] or {"message": "", "line": None, "column": None}
        check(wrong != problem and answer["exit"] == done.returncode == 2 and done.stderr == f"contct: {error['message']}\n",
              f"\"{new}\": {answer['error']} in the page, {done.stderr!r} in the program")
        line = wrong[:wrong.index(new)].count("\n") + 1
        check(error["line"] == line and (error["column"] or 0) >= 1, f"\"{new}\", line {line}: {error}")


def long_beam():
    """1000 elements over 100 stops, most of which it reaches."""
    stops = "".join(f"[[contact]]\nnode = {10 * i + 5}\nsurface = \"below\"\nface = {-0.002 - 1e-5 * abs(i - 50)}\nstiffness = 1e5\n" for i in range(100))
    return ("[beam]\nlength = 20.0\nelements = 1000\nEI = 1e5\n[[support]]\nnodes = [1, 1001]\nfix = [\"w\"]\n" + stops +
            "[[step]]\nuniform = -1000.0\n")


def print_times(page):
    with open("reference/problems/pb07-three-gap-supports.toml", encoding="utf-8") as text:
        pb07 = text.read()
    for kernels in KERNELS:
        took = page.times(60, "run", pb07, {"kernels": kernels})
        print(f"   PB7, {','.join(kernels)}: {statistics.median(took):.1f} ms, the longest of 60 {max(took):.1f} ms")
    for kernels in KERNELS:
        answer = page.call("run", long_beam(), {"kernels": kernels})
        if answer["result"] is None:
            check(False, f"1000 elements: {answer['error']}")
            continue
        events = sum(len(i["events"]) for s in answer["result"]["steps"] for i in s["increments"])
        check(events >= 10, f"1000 elements: {events} events")
        for engine in ("", "refactor"):
            took = page.times(3, "run", long_beam(), {"kernels": kernels, "engine": engine})
            print(f"   1000 elements, 100 pairs, {events} events, {','.join(kernels)}, engine {engine or 'as it comes'}: {statistics.median(took):.0f} ms")


def page_is_small():
    size = os.path.getsize(os.path.join(playground, "contct.html"))
    print(f"   contct.html: {size / 1e6:.2f} MB")
    check(100_000 < size < MOST_BYTES, f"contct.html has {size} bytes; allowed: less than {MOST_BYTES}")


page = WasmPage(os.path.join(playground, "contct.js"), work)
try:
    about = page.call("about")["result"]
    check(about["floating_point"] == "strict", f"floating point in the page: {about['floating_point']}")
    because = same_arithmetic(about["lapack"])
    if because:
        print(f"   bits are NOT compared: {because}")
    compare_runs(page, because)
    doctored_results_are_noticed()
    replay_golden_set(page)
    doctored_traces_are_noticed(page)
    errors_have_their_places(page)
    print_times(page)
    page_is_small()
    check(page.browser.errors == [], f"the console is not silent: {page.browser.errors[:3]}")
finally:
    page.close()
if because:
    LEAST["numbers"] = 0
for name, least in LEAST.items():
    check(counted[name] >= least, f"{counted[name]} {name} were compared; allowed: at least {least}")
print("   compared: " + ", ".join(f"{n} {name}" for name, n in counted.items()))
print(f"   {len(failures)} failed" if failures else "   equal: " + ("events and statuses" if because else "every result to the bit"))
sys.exit(1 if failures else 0)
