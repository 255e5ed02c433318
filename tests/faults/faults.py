"""python3 tests/faults/faults.py CONTCT LIBRARY PLUGIN [--more]: one call of the program fails, one after another.

LIBRARY is tests/faults/fail.c, preloaded; PLUGIN is a kernel that differs from CONTCT, for `fuzz --out` to find. Of every
kind of call a sample fails; --more: six times as many. Whatever fails, the program ends by itself: as without the fault, with all its
files; or with exit status 2 and one message. A file is whole, or what it was before. Nothing else is left behind."""
import os
import subprocess
import sys

sys.dont_write_bytecode = True
from commands import TIMES, commands

KINDS = {"malloc": 0, "memory": 0, "write": 28, "read": 5, "openat": 13, "close": 5, "rename": 28, "fsync": 5, "pread": 5,
         "fcntl": 9, "lseek": 29, "fchmod": 1, "mkdir": 13}
SAMPLE = {"malloc": 24, "memory": 6, "write": 24, "openat": 16}
LEAST_RUNS, LEAST_FAILED, LEAST_CHILDREN = 300, 100, 1000
NO_MEMORY = "contct: memory does not suffice; the command is stopped\n"


def chosen(count: int, kind: str) -> list[int]:
    most = TIMES * SAMPLE.get(kind, 8)
    if count <= most:
        return list(range(1, count + 1))
    return sorted({1 + i * (count - 1) // (most - 1) for i in range(most)})


def children(command) -> tuple[int, str]:
    """Every allocation by operator new and by GMP, or a sample, fails in a process of its own: how many, and what is wrong."""
    count = command.calls("new")
    every = count // (400 * TIMES) + 1
    status, files, said = command.run({"FAULT_CALL": "new", "FAULT_EVERY": str(every)})
    ended = said.count(NO_MEMORY)
    if status != command.status or files != command.made:
        return ended, f"exit {status} behind {ended} processes: {said.replace(NO_MEMORY, '')}"
    if said.replace(NO_MEMORY, "") != command.said or ended < count // every // 2:  # how many there are may change a little
        return ended, f"of {count}, every {every}th fails: {ended} processes: {said.replace(NO_MEMORY, '')}"
    return ended, ""


def main() -> None:
    runs = failed = forked = 0
    complaints = []
    if "openblas" in subprocess.run(["ldd", sys.argv[1]], capture_output=True, text=True, check=True).stdout:
        del KINDS["malloc"]  # where one of its own fails OpenBLAS crashes
        print("SKIPPED: malloc of libraries; this LAPACK is OpenBLAS", flush=True)
    for command in commands():
        ended, wrong = children(command)
        forked += ended
        if wrong:
            complaints.append(f"{command.name}: operator new: {wrong}")
            print(complaints[-1], flush=True)
        for kind, error in KINDS.items():
            count = command.calls(kind)
            if kind == "fsync" and count < command.replaced:
                complaints.append(f"{command.name}: {count} calls of fsync; allowed: one for each of {command.replaced} files that are replaced")
                print(complaints[-1], flush=True)
            here = 0
            for number in chosen(count, kind):
                for more in ((), ("FAULT_MORE",)):
                    if kind == "memory" and not more or kind == "malloc" and more or more and number % 3 != 0 and kind not in ("write", "memory"):
                        continue
                    fault = {"FAULT_CALL": kind, "FAULT_AT": str(number), "FAULT_ERRNO": str(error)} | dict.fromkeys(more, "1")
                    wrong, ended = command.wrong(fault)
                    runs, failed, here = runs + 1, failed + ended, here + 1
                    # All later writes fail too: then nobody can be told.
                    if wrong and not (more and kind == "write" and wrong.startswith("0 messages")):
                        complaints.append(f"{command.name}: {kind} {number} of {count}{' and all behind it' if more else ''}: {wrong}")
                        print(complaints[-1], flush=True)
            if os.environ.get("FAULTS_VERBOSE"):
                print(f"{command.name}: {kind}: {count} calls, {here} runs", flush=True)
    print(f"{runs} runs, {failed} with exit status 2; {forked} allocations failed in processes of their own; {len(complaints)} wrong")
    if complaints or runs < LEAST_RUNS or failed < LEAST_FAILED or forked < LEAST_CHILDREN:
        raise SystemExit(f"faults.py: allowed: none wrong, at least {LEAST_RUNS} runs, {LEAST_FAILED} with exit status 2, "
                         f"{LEAST_CHILDREN} allocations")


main()
