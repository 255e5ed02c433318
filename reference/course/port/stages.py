"""python3 reference/course/port/stages.py K [py|c|f90]: prints kernel.py, kernel.c or kernel.f90 (default:
kernel.py) with the first K stages of stages.toml."""
import sys
import tomllib
from pathlib import Path

HERE = Path(__file__).resolve().parent
STAGES = tomllib.loads((HERE / "stages.toml").read_text())["stage"]


def kernel_after(count, language="py"):
    source = (HERE / f"kernel.{language}").read_text()
    for stage in STAGES[:count]:
        for old, new in stage[language]:
            if source.count(old) != 1:
                raise ValueError(f"found {source.count(old)} times; allowed: once: {old}")
            source = source.replace(old, new)
    return source


if __name__ == "__main__":
    sys.stdout.write(kernel_after(int(sys.argv[1]), *sys.argv[2:]))
