"""scaling.py PROGRAM PLATES RANKS [MPIEXEC]: the rows of reference/scaling.md, as PROGRAM (contct_scaling) measures them.

PLATES: elements a side, as 100,200; RANKS: as 1,2. `dissected` comes first where one process can have the whole band. Messages
are Open MPI's own count of a run of 40 increments less those of one of two; counting costs time, so that these are runs of
their own.
"""
import json
import os
import subprocess
import sys
import tempfile
from pathlib import Path

FOR_ROOT = {"OMPI_ALLOW_RUN_AS_ROOT": "1", "OMPI_ALLOW_RUN_AS_ROOT_CONFIRM": "1", "OMPI_MCA_mpi_yield_when_idle": "1"}
COUNTS = {"OMPI_MCA_pml_monitoring_enable": "1", "OMPI_MCA_pml_monitoring_enable_output": "3"}


def measured(line, environment=None):
    finished = subprocess.run(line, capture_output=True, text=True, env=os.environ | FOR_ROOT | (environment or {}))
    if finished.returncode != 0:
        return None
    return json.loads(finished.stdout)


def sent(line, folder):
    """Messages and bytes of a run, and its events."""
    row = measured(line, COUNTS | {"OMPI_MCA_pml_monitoring_filename": str(Path(folder) / "sent")})
    files = list(Path(folder).glob("sent.*.prof"))
    if row is None or not files:
        sys.exit(f"{line}: found no count of messages; allowed: Open MPI with pml_monitoring")
    messages = size = 0
    for file in files:
        for words in map(str.split, file.read_text().splitlines()):
            if words and words[0] == "E":  # from, to, bytes "bytes", messages "msgs sent"
                size += int(words[3])
                messages += int(words[5])
        file.unlink()
    return messages, size, row.get("events", 0)


def main():
    program, plates, ranks = Path(sys.argv[1]).resolve(), sys.argv[2].split(","), [int(r) for r in sys.argv[3].split(",")]
    mpiexec = sys.argv[4] if len(sys.argv) > 4 else "mpirun"
    print("| plate | dofs | factor, MiB | engine | ranks | s to the first event | ms/event | MiB of each rank | messages/event | MB/event |")
    print("| --- | --- | --- | --- | --- | --- | --- | --- | --- | --- |")
    for n in plates:
        for engine, count in [("dissected", 1), *(("petsc", r) for r in ranks)]:
            line = [program, f"stops-{n}", engine]
            if engine == "petsc":
                line = [mpiexec, "--oversubscribe", "--bind-to", "none", "-n", str(count), *line]
            row = measured(line)
            if row is None:
                print(f"| stops-{n} | | | {engine} | {count} | refused | | | | |")
                continue
            messages = size = ""
            if engine == "petsc" and count > 1:
                with tempfile.TemporaryDirectory() as folder:
                    few, few_bytes, few_events = sent([*line, "2"], folder)
                    many, many_bytes, many_events = sent([*line, "40"], folder)
                    messages = f"{(many - few) / (many_events - few_events):.0f}"
                    size = f"{1e-6 * (many_bytes - few_bytes) / (many_events - few_events):.2f}"
            factor = f"{row['factor_mib']:.0f}" if "factor_mib" in row else ""
            print(f"| stops-{n} | {row['dofs']:,} | {factor} | {engine} | {count} | {row['seconds_to_first_event']:.1f} | "
                  f"{row['ms_per_event']:.1f} | {', '.join(map(str, row['peak_mib']))} | {messages} | {size} |", flush=True)


if __name__ == "__main__":
    main()
