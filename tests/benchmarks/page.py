"""page.py ROOT: judge.py passes the file of results that reference/benchmarks.md shows; the page has a row and a
picture for each family of problems, and at most 900 words."""
import re
import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).parents[1] / "support"))
from testing import Checks, blocks, run  # noqa: E402

root, check = Path(sys.argv[1]), Checks()
page = (root / "reference/benchmarks.md").read_text()
example = next(block.text for block in blocks(page) if block.language == "json")
judged = run(sys.executable, root / "reference/benchmarks/judge.py", "-", "--least", 2, input=example)
check(judged.returncode == 0, judged.stdout[-300:] + judged.stderr)
families = {file.name[:4] for file in (root / "reference/problems").glob("*.toml")}
shown = set(re.findall(r"^\|!\[\w+\]\(benchmarks/(p[bp]\d\d)\.svg\)", page, re.M))
rows = set(re.findall(r"^\|.*?\(benchmarks/(p[bp]\d\d)[a-z]?-", page, re.M))
check(rows == families and len(families) >= 22 and families - shown == {"pb15"}, f"families with a row: {rows}, with a picture: {shown}; allowed: {families}")
check(len(page.split()) <= 900, f"found {len(page.split())} words; allowed: 900")
check.end()
