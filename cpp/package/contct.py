"""CONTCT from Python: the 1989 contact subroutine, its reimplementation, and the program around them.

The problem of `run`, `exact`, `explain`, `check` and `certify` is a file (a path, or a str that ends in ".toml"), the
text of a problem file (a str with a line break), or a dict with the same keys. These functions return the
program's JSON, with each key as an attribute and as an item. Bad input raises `InputError`. Several threads may call
the functions.
reference/python.md has examples; the help of each function has its options.
"""
from __future__ import annotations

import array
import contextlib
import copy
import ctypes
import ctypes.util
import html
import importlib
import json
import math
import operator
import os
import re
import tempfile
import tomllib
from decimal import Decimal
from fractions import Fraction
from pathlib import Path
from typing import Any, Callable, Iterable, Iterator, Mapping, NamedTuple, Optional, Sequence, Union

__all__ = ["Answer", "Call", "Error", "Exact", "InputError", "Inputs", "Judgement", "NotSolved", "Record", "Result", "about",
           "call", "certify", "check", "exact", "explain", "judge", "load", "prove", "read", "replay", "run", "to_toml"]

Problem = Union[str, "os.PathLike[str]", Mapping[str, Any]]
Folder = Union[None, str, "os.PathLike[str]"]
Kernels = Union[str, Iterable[str]]
Numbers = Any  # a list, a tuple, an array.array or a NumPy array, of one dimension

_INTERFACE = 1  # CONTCT_SERVE_VERSION
_doubles = ctypes.POINTER(ctypes.c_double)
_ints = ctypes.POINTER(ctypes.c_int)
_kernel_function = ctypes.CFUNCTYPE(None, _doubles, _doubles, _doubles, _doubles, _doubles, _ints, _ints, _ints,
                                    ctypes.c_int, ctypes.c_int, ctypes.c_int, ctypes.c_int)


# Errors


class Error(Exception):
    """The base of the errors that only this module has. The module also raises TypeError, OSError, MemoryError and
    ImportError."""


class InputError(Error, ValueError):
    """A problem, a trace or an argument is refused: exit status 2 of the program. `file`, `line` and `column`, from 1,
    are None if the message names no place. For a problem in a dict, they refer to the text that `to_toml`
    makes, and `file` is "problem"."""

    def __init__(self, message: str, file: Optional[str] = None, line: Optional[int] = None,
                 column: Optional[int] = None) -> None:
        super().__init__(message, file, line, column)
        self.message, self.file, self.line, self.column = message, file, line, column

    def __str__(self) -> str:
        place = ":".join(str(part) for part in (self.file, self.line, self.column) if part is not None)
        return f"{place}: {self.message}" if place else self.message


class NotSolved(Error):
    """A run with strict=True is not solved, or not certified, or its kernels differ. `exit` is the exit status of the
    program. `result` is the Result with everything that was computed, or None."""

    def __init__(self, message: str, exit: int, result: Optional[Result] = None) -> None:
        super().__init__(message, exit, result)
        self.message, self.exit, self.result = message, exit, result

    def __str__(self) -> str:
        return self.message


# Results: views of JSON


def _optional_module(name: str) -> Any:
    try:
        return importlib.import_module(name)
    except ImportError:
        return None


_numpy = _optional_module("numpy")


_RATIONAL = {"fraction", "w", "displacement", "gap", "force", "value", "motion", "work"}  # keys of fractions


class Record(Mapping[str, Any]):
    """An object of the program's JSON. Its keys are attributes and items. Two records are equal if their JSON is equal.

    A key that is a keyword of Python, such as "if" in an explanation, is only an item.
    """

    def __init__(self, data: dict[str, Any], rational: bool = False) -> None:
        """`rational`: numbers are texts such as "p/q"."""
        self._data, self._rational = data, rational
        self._views: dict[str, Any] = {}

    def _view(self, key: str, value: Any) -> Any:
        if isinstance(value, dict):
            return Record(value, self._rational)
        if isinstance(value, list):
            if _numpy and value and all(isinstance(x, float) for x in value):
                return _numpy.array(value, dtype=_numpy.float64)
            return [self._view(key, item) for item in value]
        if self._rational and key in _RATIONAL and isinstance(value, str):
            p, _, q = value.partition("/")  # int accepts at most 4300 digits of a text, but all of a Decimal
            return Fraction(int(Decimal(p)), int(Decimal(q or 1)))
        return value

    def __getitem__(self, key: str) -> Any:
        if key not in self._views:
            self._views[key] = self._view(key, self._data[key])
        return self._views[key]

    def __getattr__(self, name: str) -> Any:
        if not name.startswith("_") and name in self._data:
            return self[name]
        known = "" if name.startswith("_") else f"; allowed: {', '.join(self._data)}"
        raise AttributeError(f"{type(self).__name__}: found no \"{name}\"{known}")

    def __iter__(self) -> Iterator[str]:
        return iter(self._data)

    def __len__(self) -> int:
        return len(self._data)

    def __dir__(self) -> list[str]:
        return sorted({*super().__dir__(), *(key for key in self._data if key.isidentifier())})

    def __eq__(self, other: object) -> bool:
        return isinstance(other, Record) and self._data == other._data

    def __repr__(self) -> str:
        shown = json.dumps(self._data, ensure_ascii=False)
        return f"<contct.{type(self).__name__} {shown if len(shown) <= 200 else shown[:196] + ' ...'}>"

    def to_dict(self) -> dict[str, Any]:
        """A copy of the JSON as dicts, lists, texts and numbers."""
        return copy.deepcopy(self._data)


class Answer(Record):
    """The result of a command. `exit` is the exit status of the program (reference/running.md); `messages` are the
    warnings, and the lines that the program prints on standard error."""
    exit: int
    messages: list[str]

    def __init__(self, answer: dict[str, Any], rational: bool = False) -> None:
        super().__init__(answer["result"], rational)
        self.exit, self.messages = answer["exit"], answer["messages"]

    def _summary(self, verdict: str) -> str:
        events = sum(len(i.events) for step in self.steps for i in step.get("increments", []))
        return (f"<contct.{type(self).__name__} {self.title!r}: {verdict}; {_count(len(self.steps), 'step')}, "
                f"{_count(events, 'event')}>")


def _text_of(key: str, what: str) -> Any:
    """A property of `Result`: a text that is made when it is first read."""
    def text(self: Result) -> str:
        if key not in self._texts:
            if self._again is None:
                raise InputError(f"found a result without a path; allowed: `{key}` of a result of contct.run without final_only")
            source, options = self._again
            self._texts[key] = str(_ask(_library.contct_run, source, {**options, key: True})[key])
        return self._texts[key]

    return property(text, doc=f"{what}. The first use runs the problem again.")


def _coordinates(result: Result, key: str) -> Any:
    along = [float(getattr(node, key)) for node in result.nodes]
    return _numpy.array(along) if _numpy else along


class Result(Answer):
    """The result of `run`, `load` or `certify`. reference/result-file.md has every key."""
    title: str
    kernels: list[str]
    engine: str
    status: str
    certified: bool
    steps: list[Record]

    def __init__(self, answer: dict[str, Any], again: Optional[tuple[_Source, dict[str, Any]]] = None,
                 right: Union[None, _Source, Result] = None) -> None:
        """`again`: the arguments of `run`, from which pages and texts are made. `right`: only for `certify`, see
        `answer`."""
        super().__init__(answer)
        self._again, self._right = again, right
        self._texts: dict[str, str] = {}
        self._drawable: Optional[Record] = None  # the same result with its structure, if `self` has no structure
        self._files: Any = None

    @property
    def answer(self) -> Result:
        """After `certify`: the certified equilibrium under each step's load, as a `Result`."""
        if self._right is None:
            raise InputError("found a result of contct.run; allowed: `answer` of a result of contct.certify")
        if not isinstance(self._right, Result):
            self._right = Result(_ask(_library.contct_run, self._right, {"final_only": True}))
        return self._right

    def __getstate__(self) -> dict[str, Any]:
        state = dict(self.__dict__)
        if state["_files"] is not None:  # files of a matrix stay with this process
            state["_files"] = state["_again"] = None
        return state

    page = _text_of("page", "The report as one HTML page, as `contct run --html` writes it")
    log = _text_of("log", "Unit 26 of the leading kernel (`--log`)")
    trace = _text_of("trace", "Every call of the leading kernel (`--trace`), for `replay`")
    proof = _text_of("proof", "The proof of the error bounds as JSON (`--proof`)")

    x = property(lambda self: _coordinates(self, "x"), doc="x of each node, in the order of `nodes`: an array.")
    y = property(lambda self: _coordinates(self, "y"), doc="y of each node of a plate: an array like `x`.")

    @property
    def _verdict(self) -> str:
        certified = "certified" if self.certified else "NOT certified"
        disagree: str = ", kernels disagree" if self.exit == 1 and self.status == "solved" else ""
        return f"{self.status}{disagree}, {certified}"

    def __repr__(self) -> str:
        return self._summary(self._verdict)

    def _repr_html_(self) -> Optional[str]:
        """The page in a frame, for a notebook."""
        try:
            page = self.page
        except Error:  # without a path or a picture, the notebook shows __repr__
            return None
        return (f'<iframe srcdoc="{html.escape(page)}" title="{html.escape(self.title)}" sandbox="allow-scripts"'
                ' style="width: 100%; height: 45em; border: 0"></iframe>')

    def plot(self, quantity: str = "w", step: int = -1, ax: Any = None) -> Any:
        """Draw the end of `steps[step]` with matplotlib, and return the axes. The first use runs the problem again.

        `quantity` is a key of `quantities` at nodes or in elements. Dots mark extremes of w, moment and shear of a
        beam; for "w", squares mark pairs in contact, and bars mark the faces of separated pairs. A plate is drawn in
        colours, with the mean of the elements at each node."""
        shown = self._with_structure()
        kind, end = shown.structure.kind, shown.steps[step]
        allowed = [row.key for row in shown.quantities if row.on in ("nodes", "element_ends") and kind != "matrix"]
        if quantity not in allowed:
            raise InputError(f"plot: found quantity {quantity!r} of a {kind}; allowed: {', '.join(allowed) or 'beams and plates'}")
        if ax is None:
            try:
                ax = importlib.import_module("matplotlib.pyplot").subplots()[1]
            except ImportError as error:
                raise ImportError(f"contct.Result.plot: {error}. It needs matplotlib (Debian: python3-matplotlib)") from error
        length = f" [{shown.units.length}]" if shown.units else ""
        words = quantity + next(f" [{row.unit}]" if row.unit else "" for row in shown.quantities if row.key == quantity)
        title = f"Step {end.step}" + (f", {end.name}" if end.name else "")
        if kind == "beam":
            _plot_beam(shown, end, quantity, ax)
            ax.set(xlabel="x" + length, ylabel=words, title=title)
        else:
            _plot_plate(shown, _nodal(shown, end, quantity), ax)
            ax.set(xlabel="x" + length, ylabel="y" + length, title=f"{title}: {words}", aspect="equal")
        return ax

    def array(self, quantity: str, step: int = -1) -> Any:
        """Every value of a quantity, a key of `quantities`, at the end of `steps[step]`: in the order of `nodes`, `pairs`,
        `reactions`, `beds` or `hinges`, or one for the structure; of a quantity in elements, a row for each element. NaN
        for the other kind of reaction of a beam or plate, force or moment. A NumPy array if NumPy is installed."""
        rows = {row.key: row for row in self.quantities}
        if quantity not in rows:
            raise InputError(f"array: found quantity {quantity!r}; allowed: {', '.join(rows)}")
        return _array(_values_of(self.steps[step], quantity, rows[quantity].on))

    def to_dataframe(self, on: str = "nodes", step: int = -1) -> Any:
        """A pandas DataFrame of all quantities on a list: "nodes", "pairs", "supports", "beds", "hinges" or "structure".
        Its index counts from 1; its columns are the places and names of the entries, and keys of `quantities`."""
        keys = [row.key for row in self.quantities if row.on == on]
        allowed = sorted({row.on for row in self.quantities} - {"element_ends"})
        if on not in allowed:
            raise InputError(f"to_dataframe: found on={on!r}; allowed: {', '.join(allowed)}")
        try:
            pandas = importlib.import_module("pandas")
        except ImportError as error:
            raise ImportError(f"contct.Result.to_dataframe: {error}. It needs pandas (Debian: python3-pandas)") from error
        entries = {"pairs": "pairs", "supports": "reactions", "beds": "beds", "hinges": "hinges"}
        if on == "nodes" and ("structure" in self or self._again is not None):
            structure = self._with_structure().structure
            of = structure.dofs if structure.kind == "matrix" else structure.nodes
        else:
            of = self.steps[step][entries[on]] if on in entries else []
        places = [{key: value for key, value in entry.items() if key not in keys and isinstance(value, (str, int, float))} for entry in of]
        frame = pandas.DataFrame(places).drop(columns="value", errors="ignore").assign(**{key: self.array(key, step) for key in keys})
        frame.index += 1
        return frame

    def _with_structure(self) -> Record:
        if "structure" not in self and self._drawable is None:
            if self._again is None:
                raise InputError("plot: found a result without its structure; allowed: a result of contct.run without final_only")
            source, options = self._again
            self._drawable = Record(_ask(_library.contct_run, source, {**options, "states": True})["result"])
        return self if self._drawable is None else self._drawable


def _array(values: list[Any]) -> Any:
    return _numpy.array(values) if _numpy else values


def _values_of(end: Record, quantity: str, on: str) -> list[Any]:
    """The values of a quantity at the end of a step, in the order of its list."""
    if on == "nodes":
        return list(end[quantity])
    if on == "supports":  # "w" is a deflection; a matrix has labels instead
        return [r.value if "node" not in r or (r.dof == "w") == (quantity == "reaction") else math.nan for r in end.reactions]
    prefix = {"beds": "bed_", "hinges": "hinge_", "structure": "sum_of_"}.get(on, "")
    key = quantity.removeprefix(prefix)
    entries = {"pairs": "pairs", "beds": "beds", "hinges": "hinges", "structure": "balance", "element_ends": "elements"}[on]
    found = [entry[key] for entry in ([end[entries]] if on == "structure" else end[entries])]
    return [value.max.value if isinstance(value, Record) else value for value in found]


def _nodal(shown: Record, end: Record, quantity: str) -> list[float]:
    """A quantity at the nodes of a plate; of a quantity in elements, the mean of the elements at each node."""
    if next(row.on for row in shown.quantities if row.key == quantity) == "nodes":
        return list(end[quantity])
    columns, sums, counts = shown.structure.columns, [0.0] * len(shown.structure.nodes), [0] * len(shown.structure.nodes)
    for number, element in enumerate(end.elements):
        first = number // (columns - 1) * columns + number % (columns - 1)
        for node, value in zip((first, first + 1, first + columns + 1, first + columns), element[quantity]):
            sums[node] += value
            counts[node] += 1
    return [total / count for total, count in zip(sums, counts)]


def _along(shown: Record, end: Record, quantity: str) -> tuple[list[float], list[float]]:
    """x and a quantity along a beam, also between nodes, from the polynomials of its elements."""
    parts = max(2, 480 // len(end.elements))
    xs, ys = [], []
    nodes = [node.x for node in shown.structure.nodes]
    if quantity not in end.elements[0].pieces[0]:  # known at nodes, or at the ends of elements
        if next(row.on for row in shown.quantities if row.key == quantity) == "nodes":
            return nodes, list(end[quantity])
        return [x for pair in zip(nodes, nodes[1:]) for x in pair], [v for own in end.elements for v in own[quantity]]
    for piece in (piece for own in end.elements for piece in own.pieces):
        (left, right), polynomial = piece.x, list(piece[quantity])
        for t in (k / parts for k in range(parts + 1)):
            xs.append(left + t * (right - left))
            ys.append(sum(a * t**power for power, a in enumerate(polynomial)))
    return xs, ys


def _plot_beam(shown: Record, end: Record, quantity: str, ax: Any) -> None:
    ax.axhline(0, color="0.8", linewidth=1)
    xs, ys = _along(shown, end, quantity)
    ax.plot(xs, ys, color="black" if quantity == "w" else "tab:blue", label=quantity)
    extremes = [end.extremes[quantity][bound] for bound in ("min", "max")] if quantity in end.extremes else []
    if not extremes:
        return
    ax.plot([v.x for v in extremes], [v.value for v in extremes], "o", color="0.3", markersize=4, label="extremes")
    near = 2.5 * max(abs(v.value) for v in extremes)  # a face much farther away would flatten the line
    for state, mark, label in (("contact", "s", "in contact"), ("separated", "_", "face")):
        pairs = [pair for pair, now in zip(shown.structure.pairs, end.pairs) if quantity == "w" and now.state == state]
        marked = [(shown.structure.nodes[p.node - 1].x, end.w[p.node - 1] if mark == "s" else p.face) for p in pairs
                  if mark == "s" or near == 0 or abs(p.face) <= near]
        ax.plot([x for x, _ in marked], [y for _, y in marked], mark, color="tab:brown", label=label)


def _plot_plate(shown: Record, values: list[float], ax: Any) -> None:
    nodes, columns = shown.structure.nodes, shown.structure.columns
    rows = [values[at:at + columns] for at in range(0, len(nodes), columns)]
    drawn = ax.contourf([node.x for node in nodes[:columns]], [node.y for node in nodes[::columns]], rows, 12, cmap="YlOrBr_r")
    ax.figure.colorbar(drawn, ax=ax)


def _count(number: int, thing: str) -> str:
    return f"{number} {thing}" if number == 1 else f"{number} {thing}s"


class Exact(Answer):
    """The result of `exact`: the path without rounding. Numbers are `fractions.Fraction`. reference/exact.md has every
    key."""
    title: str
    status: str
    steps: list[Record]
    kernels: list[Record]

    def __init__(self, answer: dict[str, Any]) -> None:
        super().__init__(answer, rational=True)

    def __repr__(self) -> str:
        return self._summary(self.status)


class Judgement(Answer):
    """The result of `judge`. reference/check-results.md has every key."""
    calls: int
    values_compared: int
    mismatches: int

    @property
    def equal(self) -> bool:
        """True if every value of every call equals the leading kernel's to the bit, and enough was compared."""
        return self.exit == 0 and self.mismatches == 0 and self.values_compared > 0

    @property
    def level(self) -> str:
        """The highest level of equality reached: "bits", "ulps", "events", "certificate" or "none"."""
        return str(self.followers[0].rung)

    @property
    def findings(self) -> list[str]:
        """Lines about the first mismatch; empty if no value differs."""
        return list(self.followers[0].findings)

    def __repr__(self) -> str:
        verdict = "equal to the bit" if self.equal else f"NOT equal (level \"{self.level}\")"
        return (f"<contct.Judgement {self.kernels[-1]!r}: {verdict}; {self.calls} calls, {self.values_compared} values "
                f"compared, {self.mismatches} mismatches>")


class Call(NamedTuple):
    """The answer of a kernel to one call: s of each pair, SMIN, the new status of each pair, and the text of unit
    26."""
    ss: Any
    smin: float
    isep: Any
    text: str


class Inputs(NamedTuple):
    """The arguments of one call of CONTCT, for a kernel written in Python (see `judge`). The arrays are lists of
    floats, the listing's 8-byte REAL, and of ints, which the kernel may change. `call` describes each argument."""
    dd: list[float]
    dtest: list[float]
    cc: list[float]
    id: list[int]
    isep: list[int]
    isurf: list[int]
    indof: int
    ndofpn: int

    @property
    def dofs(self) -> list[int]:
        """The dof of each pair, as an index of dd and dtest, from 0: NDOF - 1 of line 29 [pairs]."""
        return [(node - 1) * self.ndofpn + self.indof - 1 for node in self.id]


# The library


def _load() -> ctypes.CDLL:
    """Load the first library found: next to the module, by the name in $CONTCT_LIBRARY, or by the system's search.
    Raises ImportError if it cannot be loaded or has another version."""
    beside = [str(file) for file in sorted(Path(__file__).resolve().parent.glob("libcontct.so*"))]
    name = (beside + [os.environ.get("CONTCT_LIBRARY") or ctypes.util.find_library("contct") or "libcontct.so.0"])[0]
    try:
        library = ctypes.CDLL(name)
        found = library.contct_serve_version()
    except (OSError, AttributeError) as error:
        raise ImportError(
            f"contct.py: {error}. The library was looked for next to {Path(__file__).resolve()}, under the name in "
            "$CONTCT_LIBRARY, and in the system's folders. Build it (sh cpp/run.sh) and set "
            "CONTCT_LIBRARY=.../build/release/libcontct.so") from error
    if found != _INTERFACE:
        raise ImportError(f"contct.py: {name} has interface {found}; allowed: {_INTERFACE}. Module and library must come "
                          "from the same version of CONTCT")
    counts = (ctypes.c_int,) * 4
    arguments: dict[str, Sequence[Any]] = {"about": (), "judge": (_kernel_function, ctypes.c_char_p),
                                           "call": (ctypes.c_char_p, *(_doubles,) * 5, *(_ints,) * 3, *counts)}
    for function in ("about", "call", "certify", "check", "exact", "explain", "judge", "replay", "run"):
        library_function = getattr(library, f"contct_{function}")
        library_function.argtypes = arguments.get(function, (ctypes.c_char_p, ctypes.c_char_p))
        library_function.restype = ctypes.c_void_p  # not c_char_p, because the text must be freed
    library.contct_free.argtypes, library.contct_free.restype = (ctypes.c_void_p,), None
    return library


_library = _load()


def _answer_of(function: Any, *arguments: Any) -> dict[str, Any]:
    """The answer of a function of the library. An error in the answer is raised."""
    text = function(*arguments)
    if not text:
        raise MemoryError("libcontct: not enough memory for an answer")
    try:
        answer: dict[str, Any] = json.loads(ctypes.string_at(text).decode(errors="replace"))
    finally:
        _library.contct_free(text)
    if error := answer["error"]:
        place = [error[key] for key in ("file", "line", "column")]
        before = ":".join(str(part) for part in place if part is not None) + ": "
        raise InputError(error["message"].removeprefix(before), *place)
    return answer


def _options(given: Mapping[str, Any]) -> bytes:
    """Options as JSON. They may contain NumPy's numbers."""
    def plain(value: Any) -> Any:
        if hasattr(value, "tolist"):
            return value.tolist()
        raise TypeError(f"found a {type(value).__name__} as an option; allowed: numbers, texts, lists")

    return json.dumps(given, default=plain).encode()


def _ask(function: Any, source: _Source, options: Mapping[str, Any]) -> dict[str, Any]:
    """The answer of a library function to a text and options. For options that are None the library has defaults."""
    given = {key: value for key, value in options.items() if value is not None}
    given |= {"file": source.file, "folder": source.folder}
    given |= {"allow_outside": True} if source.allow_outside else {}
    try:
        return _answer_of(function, source.text, _options(given))
    except InputError as error:
        if error.line is not None and not source.on_disk and error.file == source.place:
            lines = source.text.decode(errors="replace").split("\n")
            if error.line <= len(lines):
                error.add_note(f"line {error.line} of {source.file}: {lines[error.line - 1]}")
        raise


# Problems


class _Source(NamedTuple):
    """A text for the library. Its messages refer to `file` in `folder`."""
    text: bytes
    file: str
    folder: str
    on_disk: bool
    allow_outside: bool

    @property
    def place(self) -> str:
        return f"{self.folder}/{self.file}" if self.folder else self.file


def _source(given: Any, ending: str, what: str, folder: Folder = None, allow_outside: bool = False) -> _Source:
    """The text of a problem or trace that is given as a path, a text or a dict."""
    if isinstance(given, os.PathLike) or (isinstance(given, str) and "\n" not in given and given.endswith(ending)):
        beside, name = os.path.split(os.fspath(given))
        source = _Source(Path(given).read_bytes(), name, beside, True, allow_outside)
    elif (isinstance(given, str) and "\n" in given) or (isinstance(given, Mapping) and what == "problem"):
        text = given if isinstance(given, str) else to_toml(given)
        source = _Source(text.encode(errors="surrogatepass"), what, os.fspath(folder or ""), False, allow_outside)
    else:
        shown = repr(given) if isinstance(given, str) else f"a {type(given).__name__}"
        or_dict = ", or a dict" if what == "problem" else ""
        if hasattr(given, "tocoo"):
            raise TypeError(f"{what}: {_MATRIX}")
        kind: type[Exception] = InputError if isinstance(given, str) else TypeError
        raise kind(f"{what}: found {shown}; allowed: a path or a name that ends in \"{ending}\", a text with a line break"
                   f"{or_dict}")
    if b"\0" in source.text:  # the library would end the text there
        before = source.text[:source.text.index(b"\0")]
        raise InputError("found a character with code 0; allowed: text without it", source.place, before.count(b"\n") + 1,
                         len(before) - before.rfind(b"\n"))
    return source


def read(path: Union[str, os.PathLike[str]]) -> dict[str, Any]:
    """Read a problem file into a dict, which can be changed and run. Its floats are rounded to doubles. Names of files
    in the dict are relative to the argument `folder` of `run`."""
    with open(path, "rb") as file:
        try:
            return tomllib.load(file)
        except (tomllib.TOMLDecodeError, UnicodeDecodeError) as error:
            place = re.search(r"line (\d+), column (\d+)", str(error))
            raise InputError(str(error), os.fspath(path), *(map(int, place.groups()) if place else ())) from error


_MATRIX = ("found a matrix; allowed: the name of a file in [matrix], which "
           "scipy.io.mmwrite(FILE, matrix, symmetry=\"symmetric\") writes; `run` and `certify` take a matrix in memory")
_ESCAPES: dict[str, str] = {'"': '\\"', "\\": "\\\\", "\b": "\\b", "\t": "\\t", "\n": "\\n", "\f": "\\f", "\r": "\\r"}


def _toml_text(text: str) -> str:
    return '"' + re.sub(r'["\\\x00-\x1f\x7f]', lambda m: _ESCAPES.get(str(m[0]), f"\\u{ord(m[0]):04X}"), text) + '"'


def _toml_key(key: object, where: str) -> str:
    if not isinstance(key, str):
        raise InputError(f"{where or 'problem'}: found the key {key!r}; allowed: a text as key")
    return key if re.fullmatch(r"[A-Za-z0-9_-]+", key) else _toml_text(key)


def _toml_value(value: Any, where: str) -> str:
    """A value on one line. `where` is the value's name in messages."""
    if hasattr(value, "tolist"):  # NumPy's arrays and numbers, array.array
        value = value.tolist()
    if isinstance(value, bool):
        return "true" if value else "false"
    if isinstance(value, int) and -2**63 <= value < 2**63:
        return int.__repr__(value)
    if isinstance(value, float):
        return float.__repr__(value)
    if isinstance(value, Decimal) and value.is_finite():
        return str(value)
    if isinstance(value, (str, os.PathLike)):
        return _toml_text(os.fspath(value))
    if isinstance(value, Mapping):
        inside = [f"{_toml_key(key, where)} = {_toml_value(item, f'{where}.{key}')}" for key, item in value.items()]
        return "{ " + ", ".join(inside) + " }" if inside else "{}"
    if isinstance(value, (list, tuple, range)):
        return "[" + ", ".join(_toml_value(item, f"{where}[{i}]") for i, item in enumerate(value, 1)) + "]"
    if hasattr(value, "tocoo"):
        raise InputError(f"{where}: {_MATRIX}")
    shown = repr(value) if isinstance(value, (int, Decimal)) or value is None else f"a {type(value).__name__}"
    raise InputError(f"{where}: found {shown}; allowed: true, false, an int of 64 bits, a float, a Decimal, a text, a list, "
                     "a dict, an array")


def to_toml(problem: Mapping[str, Any]) -> str:
    """The text of a problem file for a dict. `run` reads this text, and the lines in an `InputError` refer to it. A
    value that TOML cannot express is refused with its place, such as `contact[1].face`."""
    lines, tables = [], []
    for key, value in problem.items():
        name = _toml_key(key, "")
        if isinstance(value, Mapping):
            tables.append((f"[{name}]", key, value))
        elif isinstance(value, (list, tuple)) and value and all(isinstance(item, Mapping) for item in value):
            tables += [(f"[[{name}]]", f"{key}[{i}]", item) for i, item in enumerate(value, 1)]
        else:
            lines.append(f"{name} = {_toml_value(value, key)}")
    for heading, where, table in tables:
        lines += ["", heading]
        lines += [f"{_toml_key(key, where)} = {_toml_value(value, f'{where}.{key}')}" for key, value in table.items()]
    return "\n".join(lines).lstrip("\n") + "\n"


def _kernel_list(kernels: Kernels) -> list[str]:
    return kernels.split(",") if isinstance(kernels, str) else list(kernels)


# Functions of a problem


def run(problem: Any, *, kernels: Optional[Kernels] = None, engine: Optional[str] = None, final_only: bool = False,
        envelope: bool = False, states: bool = False, refine: bool = False, max_increments: int = 0, strict: bool = False,
        pairs: Iterable[Any] = (), loads: Any = None, supports: Any = (), labels: Optional[Sequence[str]] = None,
        free_motions: Optional[int] = None, folder: Folder = None, allow_outside: bool = False) -> Result:
    """Follow the path of a problem: `contct run`. `problem` is the name of a problem file (ending in `.toml`, or a Path),
    its text, a dict with the same keys, or a stiffness matrix: a list of rows, a square array, or an object with `tocoo()`
    such as a SciPy sparse matrix.

    With a matrix, rows and dofs are numbered from 0, or named by `labels`. `loads` has a number for each dof, or is a
    dict of them. `pairs` has tuples (dof, surface, face, stiffness) or dicts with the keys of [[contact]]: surface "below"
    or "above", `face` the position of the face (at most 0 below, at least 0 above), `stiffness` force per length.
    `supports` has fixed dofs, or is a dict of spring stiffnesses. `free_motions` is the number of motions that the
    supports leave free, if rounded entries hide it.

    `kernels` are names, or one text with commas; None selects both rules. `engine` is one of `about().engines`.
    `final_only` computes only the ends of the steps; `envelope` and `states` add the extremes over all increments and
    the state after each; `refine` adds `refined`, the changes by half the element size; `max_increments` is the limit of
    increments (0: the default). With `strict`, NotSolved is raised unless all steps are solved and certified and the
    kernels are equal. `folder` is the folder of files that a text or a dict names. Raises InputError for a bad problem or
    option."""
    matrix = _is_matrix(problem)
    if not matrix:
        _refuse_of_matrix("run", pairs, loads, supports, labels, free_motions)
    files = tempfile.TemporaryDirectory() if matrix else None
    if files is not None:
        problem, folder = _matrix_problem(problem, pairs, loads, supports, labels, Path(files.name), free_motions), files.name
    source = _source(problem, ".toml", "problem", folder, allow_outside)
    options = {"kernels": None if final_only or kernels is None else _kernel_list(kernels), "engine": engine, "final_only": final_only or None,
               "envelope": envelope or None, "states": states or None, "refine": refine or None, "max_increments": max_increments or None}
    with _without_folder(matrix):
        answer = _ask(_library.contct_run, source, options)
    result = Result(answer, None if final_only else (source, options))
    result._files = files  # kept for pages and texts, which run the problem again
    if strict and not (result.exit == 0 and result.certified):
        why = "; ".join([f"{result._verdict}; allowed with strict=True: solved, kernels equal, certified", *result.messages])
        raise NotSolved(why, result.exit or 3, result)
    return result


def load(path: Union[str, "os.PathLike[str]"]) -> Result:
    """Read a file of `contct run --json`. The older format contct-result-1 has no `quantities`, so no units of numbers;
    its `certificate.exact` is read as `certified`, and its `ended_by: "oracle"` as "reference". Raises InputError for
    any other file."""
    try:
        data = json.loads(Path(path).read_bytes())
        form = data["format"]
    except (ValueError, KeyError, TypeError):
        form = None
    if form not in ("contct-result-2", "contct-result-1"):
        raise InputError(f"found {f'the format {form!r}' if form else 'no format'}; allowed: a result file of contct run --json", str(path))
    for step in data["steps"]:
        if "exact" in (step["certificate"] or {}):
            step["certificate"]["certified"] = step["certificate"].pop("exact")
        if step.get("ended_by") == "oracle":
            step["ended_by"] = "reference"
    status = {"solved": 0, "kernels-disagree": 1, "mechanism": 4}.get(data["status"], 5)
    return Result({"result": data, "exit": status, "messages": data["warnings"]})


def check(problem: Problem, *, folder: Folder = None, allow_outside: bool = False) -> Answer:
    """Read a problem without solving it: `contct check`. The answer has `title`, `kind` ("beam", "plate" or "matrix"),
    counts, the names of the steps, and `units`; for a beam `x` of every node, for a plate also `y`."""
    source = _source(problem, ".toml", "problem", folder, allow_outside)
    return Answer(_ask(_library.contct_check, source, {}))


def exact(problem: Problem, *, rule: str = "corrected", kernels: Kernels = (),
          folder: Folder = None, allow_outside: bool = False) -> Exact:
    """Follow the path in rational arithmetic by the rule "corrected" or "1989": `contct exact`. The numbers of the file
    are exact decimals. The result has the number of correct digits of each of `kernels`."""
    source = _source(problem, ".toml", "problem", folder, allow_outside)
    return Exact(_ask(_library.contct_exact, source, {"rule": rule, "kernels": _kernel_list(kernels) if kernels else None}))


def explain(problem: Problem, *, kernels: Kernels = ("fortran", "cpp"), engine: Optional[str] = None,
            step: Optional[int] = None, increment: Optional[int] = None,
            folder: Folder = None, allow_outside: bool = False) -> Answer:
    """Explain what each line of the listing does, and why: `contct explain`. reference/explain-format.md has the keys.
    `kernels` are one or two kernels of the 1989 rule. None for `step` or `increment` selects all."""
    source = _source(problem, ".toml", "problem", folder, allow_outside)
    return Answer(_ask(_library.contct_explain, source, {"kernels": _kernel_list(kernels), "engine": engine, "step": step,
                                                         "increment": increment}))


def certify(problem: Any, displacement: Any, *, closed: Optional[Iterable[Any]] = None, pairs: Iterable[Any] = (),
            loads: Any = None, supports: Any = (), labels: Optional[Sequence[str]] = None, free_motions: Optional[int] = None,
            folder: Folder = None, allow_outside: bool = False) -> Result:
    """Compute bounds on the errors of states from another program or a formula.

    `displacement` has, for each of the first steps, the displacement of every dof under the whole load: w and theta of
    each node of a beam; w, wx and wy of each node of a plate; the rows of a matrix in their order. Values are
    lengths, positive up, and slopes. `problem` may also be a stiffness matrix, with `pairs`, `loads`, `supports`, `labels`
    and `free_motions` as of `run`. `closed` has the pairs in contact for each
    state, from 1; None selects the pairs whose faces the state touches or penetrates. The result has `w`, `pairs`,
    `error` and `certificate` of each state, and no increments; its `answer` is the equilibrium.
    """
    if _is_matrix(problem):
        with tempfile.TemporaryDirectory() as files, _without_folder():
            written = _matrix_problem(problem, pairs, loads, supports, labels, Path(files), free_motions)
            lists = None if closed is None else [list(closed)]
            found = certify(written, [displacement], closed=lists, folder=files)
            _ = found.answer  # made while the files exist
            return found
    _refuse_of_matrix("certify", pairs, loads, supports, labels, free_motions)
    source = _source(problem, ".toml", "problem", folder, allow_outside)
    states = displacement.tolist() if hasattr(displacement, "tolist") else list(displacement)
    states = [state.tolist() if hasattr(state, "tolist") else state for state in states]
    if not any(hasattr(state, "__iter__") for state in states):
        states = [states]
    options = {"displacement": [[_finite(x, i, j) for j, x in enumerate(state, 1)] for i, state in enumerate(states, 1)],
               "closed": None if closed is None else [[operator.index(pair) for pair in of_state] for of_state in closed]}
    return Result(_ask(_library.contct_certify, source, options), right=source)


@contextlib.contextmanager
def _without_folder(active: bool = True) -> Iterator[None]:
    """Errors in the files of a matrix do not name their temporary folder."""
    try:
        yield
    except InputError as error:
        if not active:
            raise
        raise InputError(error.message, error.file and Path(error.file).name, error.line, error.column) from None


def _refuse_of_matrix(function: str, pairs: Any, loads: Any, supports: Any, labels: Any, free_motions: Any) -> None:
    if pairs or loads is not None or supports or labels is not None or free_motions is not None:
        raise InputError(f"{function}: found pairs, loads, supports, labels or free_motions with a problem, which has its own; "
                         "allowed: these only with a matrix")


def _is_matrix(given: Any) -> bool:
    return hasattr(given, "tocoo") or getattr(given, "ndim", 0) == 2 or (
        isinstance(given, list) and given != [] and all(isinstance(row, list) for row in given))


def _symmetric_entries(matrix: Any) -> list[tuple[int, int, float]]:
    """The entries (row, column, value) of the lower triangle, from 0. Entries at the same place are added."""
    entries: dict[tuple[int, int], float] = {}
    rows = [] if hasattr(matrix, "tocoo") else matrix if isinstance(matrix, list) else matrix.tolist()
    count, widths = len(rows) or matrix.shape[0], {len(row) for row in rows} or {matrix.shape[1]}
    if widths != {count}:
        raise InputError(f"matrix: found {count} rows and {min(widths - {count})} columns; allowed: a square matrix")
    if not rows:
        coo = matrix.tocoo()
        for row, column, value in zip(coo.row.tolist(), coo.col.tolist(), coo.data.tolist()):
            entries[row, column] = entries.get((row, column), 0.0) + value
    else:
        entries = {(i, j): value for i, row in enumerate(rows) for j, value in enumerate(row) if value != 0}
    largest = max((abs(value) for value in entries.values()), default=0.0)
    for (row, column), value in entries.items():
        across = entries.get((column, row), 0.0)
        if not abs(value - across) <= 1e-12 * largest:
            raise InputError(f"matrix: found {value!r} in row {row}, column {column}, but {across!r} in row {column}, column {row}; "
                             "allowed: a symmetric matrix of finite numbers")
    return [(row, column, value) for (row, column), value in entries.items() if row >= column]


_PAIR = ("dof", "surface", "face", "stiffness")


def _matrix_problem(matrix: Any, pairs: Iterable[Any], loads: Any, supports: Any, labels: Optional[Sequence[str]],
                    folder: Path, free_motions: Optional[int]) -> dict[str, Any]:
    """Write a matrix and its labels to `folder`, and return a problem that names these files."""
    entries, size = _symmetric_entries(matrix), len(matrix) if isinstance(matrix, list) else matrix.shape[0]
    names = [str(name) for name in labels] if labels is not None else [str(row) for row in range(size)]
    if len(names) != size:
        raise InputError(f"labels: found {_count(len(names), 'label')}; allowed: {size}, one for each dof")

    def name_of(dof: Union[int, str], where: str) -> str:
        if isinstance(dof, str):
            return dof
        if not hasattr(dof, "__index__") or not 0 <= operator.index(dof) < size:
            raise InputError(f"{where}: found dof {dof!r}; allowed: a row of the matrix, from 0 to {size - 1}, or a label")
        return names[dof]

    if not isinstance(loads, Mapping):
        try:
            vector = [float(load) for load in (() if loads is None else loads)]
        except (TypeError, ValueError) as error:
            raise InputError(f"loads: found {getattr(loads, 'shape', loads)}: {error}; allowed: {size} numbers, one for each "
                             "dof, or a dict of numbers") from error
        if len(vector) != size:
            raise InputError(f"loads: found {_count(len(vector), 'number')}; allowed: {size}, one for each dof, or a dict")
        loads = dict(enumerate(vector))
    springs = supports if isinstance(supports, Mapping) else dict.fromkeys(supports)
    lines = [f"{row + 1} {column + 1} {float(value)!r}" for row, column, value in entries]
    heading = f"%%MatrixMarket matrix coordinate real symmetric\n{size} {size} {len(lines)}\n"
    (folder / "matrix").write_text(heading + "\n".join(lines) + "\n")
    (folder / "labels").write_text("\n".join(names) + "\n")
    contacts = []
    for number, pair in enumerate(pairs, 1):
        if not isinstance(pair, Mapping) and (isinstance(pair, str) or not hasattr(pair, "__len__") or len(pair) != len(_PAIR)):
            raise InputError(f"pairs: found {pair!r} as pair {number}; allowed: (dof, surface, face, stiffness), or a dict")
        contact = dict(pair if isinstance(pair, Mapping) else zip(_PAIR, pair))
        if "dof" not in contact:
            raise InputError(f"pairs: found pair {number} without dof; allowed: dof, surface, face and stiffness")
        contacts.append(contact | {key: name_of(contact[key], f"pair {number}") for key in ("dof", "other") if key in contact})
    held = [{"dof": name_of(dof, "supports"), ("fix" if spring is None else "spring"): True if spring is None else spring}
            for dof, spring in springs.items()]
    points = [{"dof": name_of(dof, "loads"), "value": value} for dof, value in loads.items()]
    table: dict[str, Any] = {"stiffness": "matrix", "dofs": "labels"}
    if free_motions is not None:
        table["free_motions"] = operator.index(free_motions)
    problem: dict[str, Any] = {"matrix": table, "support": held, "contact": contacts, "step": [{"point": points}]}
    return {key: value for key, value in problem.items() if value}


def _finite(number: Any, state: int, dof: int) -> float:
    value = float(number)
    if value - value != 0:
        raise InputError(f"displacement: found {value} in state {state}, dof {dof}; allowed: finite numbers")
    return value


# Kernels


def _argument(name: str, values: Numbers, real: bool, length: Optional[int] = None) -> Any:
    """Convert an array argument to a ctypes array. `real`: of doubles, otherwise of ints. Raises InputError if `length`
    differs."""
    try:
        owner = array.array("d" if real else "i", values)
    except OverflowError as error:
        raise InputError(f"{name}: {error}; allowed: whole numbers of 32 bits") from error
    except TypeError as error:
        raise TypeError(f"{name}: {error}; allowed: a list or an array of {'numbers' if real else 'whole numbers'}") from error
    if length is not None and len(owner) != length:
        raise InputError(f"{name}: found {_count(len(owner), 'value')}; allowed: {length}")
    kind: Any = ctypes.c_double if real else ctypes.c_int
    return (kind * len(owner)).from_buffer(owner)


def _numbers(values: Any) -> Any:
    """A copy of a ctypes array: a NumPy array, or a list if NumPy is not installed."""
    return _numpy.array(values) if _numpy else list(values)


def call(kernel: str, dd: Numbers, dtest: Numbers, cc: Numbers, id: Numbers, isep: Numbers, isurf: Numbers, indof: int = 1,
         ndofpn: int = 1) -> Call:
    """Call a kernel, which is given by its name: CALL CONTCT(DD, DTEST, CC, SS, SMIN, ID, ISEP, ISURF, NC), line 19 of
    the listing.

    contct/kernel/plugin.h describes each argument. `isep` is not changed; the answer has the new statuses. Raises
    InputError if lengths differ, if an id addresses a dof outside dd, or if a product isep * isurf does not fit in 32
    bits.
    """
    d, cc = _argument("dd", dd, True), _argument("cc", cc, True)
    ndof, nc = len(d), len(cc)
    d_star, nodes = _argument("dtest", dtest, True, ndof), _argument("id", id, False, nc)
    status, sides = _argument("isep", isep, False, nc), _argument("isurf", isurf, False, nc)
    ss, smin = (ctypes.c_double * nc)(), ctypes.c_double()
    answer = _answer_of(_library.contct_call, kernel.encode(), d, d_star, cc, ss, ctypes.byref(smin), nodes, status, sides, nc, indof,
                        ndofpn, ndof)
    return Call(_numbers(ss), smin.value, _numbers(status), answer["result"]["text"])


def _write(answer: Any, ss: Any, smin: Any, isep: Any, nc: int) -> None:
    """Write the answer of a Python function to the library's arrays."""
    try:
        s, least, status = answer
        s, least, status = array.array("d", s), float(least), array.array("i", (int(x) for x in status))
    except (TypeError, ValueError, OverflowError) as error:
        raise TypeError(f"a kernel: found {answer!r}; allowed: (ss, smin, isep), isep of 32 bits") from error
    if len(s) != nc or len(status) != nc:
        raise InputError(f"a kernel: found {len(s)} values of ss and {len(status)} of isep; allowed: {nc} of each")
    smin[0] = least
    for i in range(nc):
        ss[i], isep[i] = s[i], status[i]


def judge(function: Callable[[Inputs], tuple[Any, float, Any]], *, calls: int = 20000, problems: int = 40, seed: int = 1989,
          leader: str = "fortran", name: Optional[str] = None) -> Judgement:
    """Compare a Python function with the kernel `leader` to the bit, on random and adversarial calls and on the paths
    of whole problems: `contct fuzz`.

    The argument of the function is `Inputs`. It returns (ss, smin, isep) as lists or arrays, and must not depend on
    anything else. With 1000 calls or more, every branch of the listing must be taken often enough; otherwise `exit` is
    2, `equal` is False, and `messages` name the branches. An exception in the function, also KeyboardInterrupt, ends
    the comparison and is raised, with the call as a note.
    """
    raised: list[BaseException] = []

    def asked(dd: Any, dtest: Any, cc: Any, ss: Any, smin: Any, id: Any, isep: Any, isurf: Any, nc: int, indof: int,
              ndofpn: int, ndof: int) -> None:
        smin[0] = float("nan")
        if raised:  # the library continues to call, but its result is not used
            return
        def inputs() -> Inputs:
            return Inputs(dd[:ndof], dtest[:ndof], cc[:nc], id[:nc], isep[:nc], isurf[:nc], indof, ndofpn)

        try:
            _write(function(inputs()), ss, smin, isep, nc)
        except BaseException as error:  # the library cannot pass exceptions on
            words = repr(inputs())
            error.add_note(f"in a call of {_count(nc, 'pair')}: {words if len(words) <= 500 else words[:496] + ' ...'}")
            raised.append(error)

    options = {"calls": calls, "problems": problems, "seed": seed, "leader": leader,
               "name": name or getattr(function, "__name__", "function")}
    try:
        return Judgement(_answer_of(_library.contct_judge, _kernel_function(asked), _options(options)))
    finally:
        if raised:
            raise raised[0]


def replay(trace: Union[str, os.PathLike[str]], *, kernel: Optional[str] = None) -> Record:
    """Repeat the calls of a recorded trace with a kernel, and compare every answer: `contct replay`. The record has
    `calls`, `values_compared`, `mismatches`, and `first`: words for the first mismatch, or None. The default `kernel`
    for a trace of the 1989 rule is the 1989 code in the precision of the trace."""
    return Record(_ask(_library.contct_replay, _source(trace, ".trace", "trace"), {"kernel": kernel})["result"])


def prove(library: Union[str, os.PathLike[str]], symbol: str = "") -> dict[str, str]:
    """Prove that the machine code of each kernel in an ELF file is CONTCT: `contct prove`. Needs capstone and z3.
    Returns the verdict on each symbol: "proved: ..", "differs: .." or "undecided: ..". `symbol` names a function with
    the plug-in interface; the default is contct_kernel.
    """
    prover = importlib.import_module("contct_prove.__main__")
    path = os.fspath(library)
    return {k.symbol: prover.judge(path, k)[1] for k in prover.kernels_of(prover.Image(path), symbol)}


def about() -> Record:
    """Return `version`, `listing_sha256`, `floating_point`, `lapack`, `engines`, and `kernels` with precision, rule and
    compiler."""
    return Record(_answer_of(_library.contct_about)["result"])
