"""page.py ROOT: judge.py passes the file of results that reference/benchmarks.md shows; the page has a row and a
picture for each family of problems, and at most 900 words."""
import re
import subprocess
import sys
from pathlib import Path

root = Path(sys.argv[1])
page = (root / "reference/benchmarks.md").read_text()
example = re.search(r"```json\n(.*?)```", page, re.S)[1]
line = [sys.executable, root / "reference/benchmarks/judge.py", "-", "--least", "2"]
judged = subprocess.run(line, input=example, capture_output=True, text=True, check=False)
print(judged.stdout[-300:], judged.stderr)
families = {file.name[:4] for file in (root / "reference/problems").glob("*.toml")}
shown = set(re.findall(r"^\|!\[\w+\]\(benchmarks/(p[bp]\d\d)\.svg\)", page, re.M))
rows = set(re.findall(r"^\|.*?\(benchmarks/(p[bp]\d\d)[a-z]?-", page, re.M))
print(f"{len(rows)} of {len(families)} families have a row, {len(shown)} a picture; {len(page.split())} words")
sys.exit(judged.returncode or int(rows != families or len(families) < 22 or families - shown != {"pb15"} or len(page.split()) > 900))
