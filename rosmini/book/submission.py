"""Runs one submission and grades its answers: the process that `rosmini grade` starts for each.

`python -m rosmini.book.submission` reads a `Job` as JSON from its standard input. It appends a record in JSON to the
job's file `records` before each step and for each result, so that these remain if the submission ends the process.
"""

from __future__ import annotations

import ast
import asyncio
import importlib
import json
import os
import re
import sys
from contextlib import suppress
from dataclasses import asdict, dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any

from rosmini.book import checks
from rosmini.core.errors import RosminiError
from rosmini.core.packages import MANIFEST, read_package

if TYPE_CHECKING:
    from collections.abc import Iterator, Sequence

NAMED = re.compile(r"^#\s*Exercise:\s+(\w+)|\bcheck\(\s*[\"'](\w+)[\"']", re.MULTILINE)
"""How a cell names its exercise: at the top of a stub, or in a check."""
MAX_BYTES = 100_000_000
"""Size of the largest file that is read or written."""
OUT_OF_MEMORY = 77
"""Exit status after a cell that has used up the memory."""


class SubmissionError(RosminiError):
    """A submission cannot be read."""


@dataclass(frozen=True)
class Job:
    """What to grade: a notebook or a package (the path of its `package.xml`), and how."""

    path: str
    records: str
    exercises: Sequence[str]
    """Names of the exercises that count."""
    seeds: Sequence[int] = ()
    """Seeds of the checks; none: those that the notebook gives."""
    skipped: Sequence[int] = ()
    """Numbers of the cells that are not run, because they ended an earlier attempt."""
    memory: int = 0
    """Largest size of the data of this process [bytes]; 0: no limit."""


def cells(path: Path) -> list[str]:
    """Return the sources of a notebook's cells, "" for those without code. Raises `SubmissionError`."""
    try:
        if path.stat().st_size > MAX_BYTES:
            raise SubmissionError(f"it is larger than {MAX_BYTES // 1_000_000} MB")
        found = json.loads(path.read_text(encoding="utf-8"))["cells"]
        return ["".join(cell["source"]) if cell["cell_type"] == "code" else "" for cell in found]
    except (OSError, ValueError, KeyError, TypeError, RecursionError) as error:
        raise SubmissionError(f"it is not a notebook ({type(error).__name__}: {error})") from error


def exercises_in(sources: Sequence[str]) -> list[str]:
    """Return the names of the exercises in the cells of a notebook, in their order."""
    known = checks.names()
    found = (stub or check for source in sources for stub, check in NAMED.findall(source))
    return list(dict.fromkeys(name for name in found if name in known))


class Grader:
    """Grades answers of a job, and records the results."""

    def __init__(self, job: Job) -> None:
        self.job = job
        self.step = 0
        self.graded: set[str] = set()
        """Names of the exercises that were graded."""
        self._file = Path(job.records).open("a", encoding="utf-8", buffering=1)  # noqa: SIM115
        for name in job.exercises:
            checks.find(name)
        self._before = dict(_definitions())

    def record(self, **what: Any) -> None:
        """Append a record."""
        self._file.write(json.dumps(what) + "\n")

    def begin(self, step: int) -> None:
        """Record that a cell begins; 0 is a package."""
        self.step = step
        self.record(step=step)

    def grade(self, name: str, *answer: Any, seed: int = 0) -> bool:
        """Grade an answer, by default its script, with each seed. True if all are right, or do not count."""
        if name not in self.job.exercises:
            return True
        self.graded.add(name)
        right = True
        for each in self.job.seeds or (seed,):
            self.begin(self.step)
            status, text, page = self._graded(name, answer, each)
            right = right and status is checks.Status.RIGHT
            self.record(exercise=name, seed=each, right=status is checks.Status.RIGHT, text=text, page=page)
        return right

    def _graded(self, name: str, answer: tuple[Any, ...], seed: int) -> tuple[checks.Status, str, str]:
        changed = [where for where, what in _definitions() if self._before.get(where, what) is not what]
        if changed:
            return checks.Status.WRONG, f"Not graded: the submission has replaced {changed[0]}.", ""
        try:
            verdict = checks.find(name).grade(checks.given(name, answer), seed)
        except checks.NoAnswer:
            text = f"Exercise {name}: no cell calls its check or has written its script."
            return checks.Status.NOT_ATTEMPTED, text, ""
        except checks.SeveralAnswers as error:
            return checks.Status.WRONG, f"Exercise {name}: {error}", ""
        page = getattr(verdict.view, "page", None) or ""
        return verdict.status, verdict.text, str(page)


def _definitions() -> Iterator[tuple[str, object]]:
    """Yield the functions and classes of the checks, and the code of the functions, by their full names."""
    for module in [name for name in sys.modules if name.startswith("rosmini.book.")]:
        for name, value in vars(sys.modules[module]).items():
            yield f"{module}.{name}", value
            members = vars(value) if isinstance(value, type) and value.__module__ == module else {}
            for each, member in [("", value), *members.items()]:
                if code := getattr(member, "__code__", None):
                    yield f"the code of {module}.{name}.{each}".rstrip("."), code


def grade_notebook(grader: Grader, sources: Sequence[str]) -> None:
    """Run all cells in their order, also after an error, and grade the arguments of each call of `check`."""
    from IPython.core.interactiveshell import InteractiveShell
    from traitlets.config import Config

    shell: Any = InteractiveShell.instance(config=Config({"HistoryManager": {"enabled": False}}))

    async def run() -> None:
        for number, source in enumerate(sources, 1):
            if not source.strip() or number in grader.job.skipped:
                continue
            grader.begin(number)
            shell.user_ns[hook := f"_check_of_cell_{number}"] = grader.grade
            code = _hooked(shell.transform_cell(source), hook)
            result = await shell.run_cell_async(source, transformed_cell=code)
            if error := result.error_before_exec or result.error_in_exec:
                if isinstance(error, MemoryError):
                    os._exit(OUT_OF_MEMORY)  # what fills it may still be there
                grader.record(cell=number, error=f"{type(error).__name__}: {error}".rstrip(": ")[:300])

        for name in exercises_in(sources):
            if name not in grader.graded:
                grader.grade(name)

    asyncio.run(run())


def _hooked(code: str, hook: str) -> str:
    """Return the code of a cell with each `check("name", ...)` replaced by a call of `hook`, whatever `check` is."""
    try:
        tree = ast.parse(code)
    except SyntaxError:
        return code
    calls = [node for node in ast.walk(tree) if isinstance(node, ast.Call) and _called(node) == "check"]
    for call in calls:
        call.func = ast.copy_location(ast.Name(hook, ast.Load()), call)
    return ast.unparse(tree) if calls else code


def _called(call: ast.Call) -> str:
    return getattr(call.func, "id", "") or getattr(call.func, "attr", "")


def _limit(memory: int) -> None:
    """Limit the data and the files of this process, if the system can."""
    with suppress(ImportError):
        resource = importlib.import_module("resource")
        resource.setrlimit(resource.RLIMIT_FSIZE, (MAX_BYTES, MAX_BYTES))
        if memory:
            with suppress(ValueError, OSError):
                resource.setrlimit(resource.RLIMIT_DATA, (memory, memory))


def main() -> None:
    """Grade the job, and record that the end was reached."""
    job = Job(**json.loads(sys.stdin.readline()))
    sys.stdin = Path(os.devnull).open(encoding="utf-8")  # noqa: SIM115
    path = Path(job.path)
    grader = Grader(job)
    _limit(job.memory)
    try:
        if path.name == MANIFEST:
            grader.begin(0)
            grader.grade("project", read_package(path.parent).name)
        else:
            sys.path.append("")  # modules beside the notebook
            grade_notebook(grader, cells(path))
    except RosminiError as error:
        grader.record(error=str(error))
    grader.record(end=True)
    os._exit(0)  # without waiting for threads of the submission


def to_json(job: Job) -> str:
    """Return a job as the line that this program reads."""
    return json.dumps(asdict(job)) + "\n"


if __name__ == "__main__":
    main()
