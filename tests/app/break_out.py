"""python3 tests/app/break_out.py CONTCT: no text of a problem becomes markup, a row, a keyword or a formula in any output.

A problem is run twice: with harmless texts, and with texts of the same length that try to end every construct of the
output formats. Each output is parsed again, and must have the same structure both times."""
import csv
import io
import json
import re
import sys
import tempfile
import xml.etree.ElementTree as xml
from html.parser import HTMLParser
from pathlib import Path

sys.path.insert(0, str(Path(__file__).parents[1] / "support"))
from testing import Checks, run  # noqa: E402

PROGRAM = Path(sys.argv[1]).resolve()
TITLE = "=1+1</script><!--]]>--><![CDATA[\"'>`|**_[x](y)&amp;<b>\n*NODE\n| a | b |\n# head\n```\n\\| \\` \r\n*STEP,x\nkernel none\n"
NAME = "@x</title></text></svg>]]>\"'`|**\n*NODE\n```\n"
UNIT = "+m</td>]]>\"'|`"
LABEL = "=H(\"x\"),'|`**</script></text>]]>-->&<b>*NODE"
FILE = "=p<b>&\"'`|**]]>-->.toml"
check = Checks()
harmless = lambda text: "x" * len(text)
contct = lambda folder, *arguments: run(PROGRAM, *arguments, cwd=folder, env={"SOURCE_DATE_EPOCH": "0"}, status=0)


def beam(text) -> str:
    toml = {key: json.dumps(text(value)) for key, value in (("title", TITLE), ("name", NAME), ("unit", UNIT))}
    return (f"title = {toml['title']}\n[units]\nlength = {toml['unit']}\nforce = {toml['unit']}\n"
            "[beam]\nx = [0.0, 1.0, 2.0]\nEI = 1.0e4\n[[support]]\nnode = 1\nfix = [\"w\", \"theta\"]\n"
            "[[contact]]\nnode = 3\nsurface = \"below\"\nface = -0.004\nstiffness = 5.0e4\n"
            f"[[step]]\nname = {toml['name']}\npoint = [ {{ node = 3, w = -60.0 }} ]\n")


def matrix(folder: Path, text) -> str:
    label, title = text(LABEL), json.dumps(text(TITLE))
    (folder / "K.mtx").write_text("%%MatrixMarket matrix coordinate real symmetric\n3 3 5\n1 1 2\n2 1 -1\n2 2 2\n3 2 -1\n3 3 2\n")
    (folder / "K.dof").write_text("".join(f"{label}{i}.x\n" for i in (1, 2, 3)))
    (folder / "K.xyz").write_text("".join(f"{label}{i} {i} 0\n" for i in (1, 2, 3)))
    at = [json.dumps(f"{label}{i}.x") for i in (1, 2, 3)]
    return (f"title = {title}\n[matrix]\nstiffness = \"K.mtx\"\ndofs = \"K.dof\"\ncoordinates = \"K.xyz\"\n"
            f"[[support]]\ndof = {at[0]}\nspring = 1.0\n[[contact]]\ndof = {at[2]}\nsurface = \"above\"\nface = 0.5\n"
            f"stiffness = 10.0\n[[step]]\nname = {json.dumps(text(NAME))}\npoint = [ {{ dof = {at[1]}, value = 2.0 }} ]\n")


class Tags(HTMLParser):
    """Tags with the names of their attributes, comments and declarations, and the text of scripts."""

    def __init__(self, text: str) -> None:
        super().__init__()
        self.tags: list[tuple] = []
        self.scripts: list[str] = []
        self.in_script = False
        self.feed(text)
        self.close()

    def handle_starttag(self, tag, attrs):
        self.tags.append((tag, *(name for name, _ in attrs)))
        self.in_script = tag == "script"
        self.scripts += [""] * self.in_script

    def handle_endtag(self, tag):
        self.tags.append(("/" + tag,))
        self.in_script = False

    def handle_data(self, data):
        if self.in_script:
            self.scripts[-1] += data


for other in ("handle_comment", "handle_decl", "unknown_decl", "handle_pi"):
    setattr(Tags, other, lambda self, data, other=other: self.tags.append((other, data)))


def shape_of_html(data: bytes) -> list:
    page = Tags(data.decode())
    return [page.tags, [shape_of_json(script.encode()) if script.startswith("{") else script for script in page.scripts]]


def shape_of_json(value):
    if isinstance(value, bytes):
        value = json.loads(value.decode())
    if isinstance(value, dict):
        return {key: shape_of_json(v) for key, v in value.items()}
    if isinstance(value, list):
        return [shape_of_json(v) for v in value]
    return "text" if isinstance(value, str) else value


def shape_of_csv(data: bytes) -> list:
    rows = list(csv.reader(io.StringIO(data.decode(), newline=""), strict=True))
    for row in rows:
        for cell in row:
            number = re.fullmatch(r"[+-]?[0-9.]+(e[+-]?[0-9]+)?|", cell)
            check(bool(number) or cell[0] not in "=+-@\t\r", f"a cell begins as a formula: {cell!r}")
    return [len(row) for row in rows]


def shape_of_markdown(data: bytes) -> list:
    """The characters of each line with a meaning in Markdown, without those after a backslash."""
    lines = data.decode().split("\n")
    return [re.sub(r"[^`*_{}\[\]<>#|!~&]", "", re.sub(r"\\.", "", line)) for line in lines]


def outputs_of(folder: Path, file: str) -> dict[str, bytes]:
    """Every output of every command for a problem, by the name of its file."""
    contct(folder, "run", file, "--quiet", "--html", "o.html", "--csv", "o.csv", "--vtu", "o.vtu", "--json",
           "o.json", "--log", "o.log", "--trace", "o.trace", "--proof", "o.proof", "--junit", "o.xml", "--markdown", "o.md")
    contct(folder, "explain", file, "--quiet", "--json", "e.json")
    contct(folder, "exact", file, "--quiet", "--json", "x.json", "--kernels", "fortran")
    contct(folder, "replay", "o.trace", "--quiet", "--junit", "r.xml", "--markdown", "r.md")
    return {path.name: path.read_bytes() for path in sorted(folder.iterdir()) if re.match(r"[oexr]\.", path.name)}


SHAPES = {".html": shape_of_html, ".json": shape_of_json, ".proof": shape_of_json, ".csv": shape_of_csv, ".md": shape_of_markdown,
          ".trace": lambda data: [line for line in data.decode().split("\n") if not line.startswith("about ")],
          ".log": lambda data: data}
for xml_file in (".vtu", ".pvd", ".xml"):
    SHAPES[xml_file] = lambda data: [(e.tag, *e.attrib) for e in xml.fromstring(data.decode()).iter()]


def compare(kind: str) -> None:
    found = []
    for text in (harmless, str):
        with tempfile.TemporaryDirectory() as scratch:
            folder = Path(scratch)
            (folder / text(FILE)).write_text(beam(text) if kind == "beam" else matrix(folder, text))
            found.append(outputs_of(folder, text(FILE)))
    plain, hostile = found
    check(list(plain) == list(hostile) and len(plain) >= 14, f"{kind}: files {list(plain)} and {list(hostile)}")
    for name in plain:
        shape = SHAPES[Path(name).suffix]
        a, b = shape(plain[name]), shape(hostile[name])
        if a != b:
            pairs = zip(a, b) if isinstance(a, list) else [(a, b)]
            check(False, f"{kind}: {name} has another structure: {next((p for p in pairs if p[0] != p[1]), (len(a), len(b)))}")
        check(True, name)
    for name in ("o.json", "e.json", "x.json"):
        check(json.loads(hostile[name])["title"] == TITLE, f"{kind}: {name} has another title")
    check(b"head" in hostile["o.html"] and b"head" in hostile["o.trace"],
          f"{kind}: the title does not stand in the page and the trace")


compare("beam")
compare("matrix")
check.end(50)
