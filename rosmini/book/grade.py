"""`rosmini grade`: score submitted notebooks and packages, each in a separate process with bounded time and memory."""

from __future__ import annotations

import csv
import html
import json
import os
import shutil
import signal
import subprocess
import sys
import time
from collections import defaultdict
from concurrent.futures import ThreadPoolExecutor
from contextlib import suppress
from dataclasses import dataclass, field, replace
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import TYPE_CHECKING, Any, TextIO

from rosmini.book import checks
from rosmini.book.submission import OUT_OF_MEMORY, Job, SubmissionError, cells, exercises_in, to_json
from rosmini.core.packages import MANIFEST, crawl
from rosmini.core.verbs import ArgumentParser, Call, Result, Tool

if TYPE_CHECKING:
    import argparse
    from collections.abc import Iterator, Sequence

TOOL = Tool("grade", "score submitted notebooks and packages", only_verb="run", is_magic=False, group="The book")

ATTEMPTS = 4
"""How often a notebook is started: each time without the cell that ended it before."""
WHOLE = 5
"""Longest time of one attempt, as a multiple of the longest time of a cell."""
START = 120.0
"""Longest time in which the process of a submission starts, on a busy machine [s]."""
PROCESSES = 64
"""Largest number of processes that a submission may have at the same time."""
MARK = "ROSMINI_SUBMISSION"
"""Environment variable that all processes of a submission have."""
PERIOD = 0.1
"""How often a submission is looked at [s]."""


@dataclass(frozen=True)
class Limits:
    """Bounds of one submission: the time of a cell or a check [s], and the memory [bytes]."""

    seconds: float
    memory: int


@dataclass
class Student:
    """A student's submissions, and what was found."""

    name: str
    folder: Path
    """The student's folder, or only notebook."""
    notebooks: list[Path] = field(default_factory=list)
    packages: list[Path] = field(default_factory=list)
    points: dict[str, float] = field(default_factory=lambda: defaultdict(float))
    remarks: list[str] = field(default_factory=list)
    results: list[dict[str, Any]] = field(default_factory=list)

    @property
    def total(self) -> float:
        """The sum of the points."""
        return round(sum(self.points.values()), 2)


@dataclass(frozen=True, kw_only=True)
class Grades(Result):
    """A table of points."""

    exercises: list[str]
    students: list[Student]
    folder: Path

    def rows(self) -> list[list[str]]:
        """Return the table with its heading."""
        heading = ["student", *self.exercises, "points", "of", "remarks"]
        return [heading] + [
            [
                each.name,
                *(f"{each.points[name]:g}" for name in self.exercises),
                f"{each.total:g}",
                f"{len(self.exercises)}",
                "; ".join(each.remarks),
            ]
            for each in self.students
        ]

    def __str__(self) -> str:
        rows = self.rows()
        widths = [max(map(len, column)) for column in zip(*rows, strict=True)]
        lines = ["  ".join(text.ljust(width) for text, width in zip(row, widths, strict=True)).rstrip() for row in rows]
        return "\n".join([*lines, "", f"The table and a replay for each submission are in {self.folder}"])


def _parser() -> ArgumentParser:
    parser = ArgumentParser(
        "rosmini grade",
        "Run submitted notebooks and check their answers again. FOLDER contains a notebook or a folder for each "
        "student, or is the folder `submitted` of nbgrader. A package is checked as the answer to the exercise "
        "`project`. A right answer is one point, and with several seeds a share of it.",
        epilog="for example: rosmini grade submitted --exercises stop,gentle --seeds 101,102,103",
    )
    parser.add_argument("folder", metavar="FOLDER", type=Path)
    parser.add_argument(
        "--exercises", metavar="NAMES", type=_words, default=[], help="what counts (default: all that occur)"
    )
    parser.add_argument(
        "--seeds", metavar="NUMBERS", type=_seeds, default=[], help="of the simulations (default: as in the notebook)"
    )
    parser.add_argument("--jobs", metavar="N", type=int, default=os.cpu_count() or 1, help="how many run at a time")
    parser.add_argument(
        "--limit", metavar="SECONDS", type=float, default=60.0, help="for a cell or a check (default: %(default)g)"
    )
    parser.add_argument(
        "--memory", metavar="GB", type=float, default=2.0, help="for a submission (default: %(default)g)"
    )
    parser.add_argument(
        "--output", metavar="FOLDER", type=Path, default=Path("grades"), help="for the results (default: %(default)s)"
    )
    return parser


def _words(text: str) -> list[str]:
    return [word.strip() for word in text.split(",") if word.strip()]


def _seeds(text: str) -> list[int]:
    found = [int(word) for word in _words(text)]
    if not found or min(found) < 0:
        raise ValueError
    return found


@TOOL.verb("score the submissions in a folder", parser=_parser)
def run(given: argparse.Namespace, call: Call) -> Grades:
    """Grade all submissions, and write the table and a page for each student."""
    students = found_in(given.folder)
    exercises = given.exercises or _exercises(students)
    for name in exercises:
        checks.find(name)
    limits = Limits(given.limit, round(given.memory * 1e9))
    given.output.mkdir(parents=True, exist_ok=True)

    def one(student: Student) -> None:
        try:
            _grade_student(student, exercises, given.seeds, limits)
        except Exception as error:  # of whatever a submission does: it may not end the others
            student.remarks.append(f"not graded ({type(error).__name__}: {error})")
        page = given.output / f"{student.name}.html"
        page.write_text(_page(student, len(exercises)), encoding="utf-8")
        call.warn(f"{student.name}: {student.total:g} of {len(exercises)}")

    with ThreadPoolExecutor(max(1, given.jobs)) as pool:
        list(pool.map(one, students))
    grades = Grades(exercises=exercises, students=students, folder=given.output)
    with (given.output / "grades.csv").open("w", encoding="utf-8", newline="") as file:
        csv.writer(file).writerows(grades.rows())
    return grades


def found_in(folder: Path) -> list[Student]:
    """Return the students with their submissions, by name. Raises `SubmissionError` if there are none."""
    if not folder.is_dir():
        raise SubmissionError(f"{folder} is not a folder")
    students: list[Student] = []
    for entry in sorted(folder.iterdir()):
        if entry.name.startswith("."):
            continue
        if entry.suffix == ".ipynb":
            students.append(Student(entry.stem, entry, [entry]))
        elif entry.is_dir():
            files = (path for path in sorted(entry.rglob("*.ipynb")) if not _is_hidden(path.relative_to(entry)))
            packages = [path / MANIFEST for path in crawl(entry)]
            students.append(Student(entry.name, entry, list(files), packages))
    if not students:
        raise SubmissionError(f"{folder} contains no submissions: a folder or a notebook for each student")
    return students


def _is_hidden(path: Path) -> bool:
    return any(part.startswith(".") for part in path.parts)


def _exercises(students: Sequence[Student]) -> list[str]:
    """Return the exercises that occur in the submissions. Raises `SubmissionError` if there are none."""
    found: dict[str, None] = {}
    for student in students:
        for path in student.notebooks:
            with suppress(SubmissionError):
                found.update(dict.fromkeys(exercises_in(cells(path))))
    if any(student.packages for student in students):
        found["project"] = None
    if not found:
        raise SubmissionError("no submission contains an exercise; --exercises names what counts")
    return list(found)


def _grade_student(student: Student, exercises: Sequence[str], seeds: Sequence[int], limits: Limits) -> None:
    """Run the submissions of a student, and collect results, points and remarks."""
    packages = student.packages if "project" in exercises else []
    if not student.notebooks and not packages:
        student.remarks.append("no notebook and no package")
    for path in (*student.notebooks, *packages):
        results, remarks = _graded(student, path, Job("", "", exercises, seeds, memory=limits.memory), limits)
        student.results += results
        for name in exercises:
            right = [result for result in results if result["exercise"] == name and result["right"]]
            student.points[name] = max(student.points[name], round(len(right) / (len(seeds) or 1), 2))
        is_right = bool(results) and all(result["right"] for result in results)
        student.remarks += [text for text, is_error in remarks.items() if not (is_error and is_right)]


def _graded(student: Student, path: Path, job: Job, limits: Limits) -> tuple[list[dict[str, Any]], dict[str, bool]]:
    """Run one submission, again without a cell that has ended it.

    Return the results, and the remarks: True for an error of a cell, which matters only if an answer is wrong.
    """
    results: dict[tuple[str, int], dict[str, Any]] = {}
    remarks: dict[str, bool] = {}
    for _ in range(ATTEMPTS):
        records, ended = _attempt(student, path, job, limits)
        for record in records:
            if "exercise" in record:
                results[record["exercise"], record["seed"]] = record
            elif "error" in record:
                remarks[f"{_place(path, record.get('cell'))}: {record['error']}"] = True
        if not ended:
            break
        step = next((record["step"] for record in reversed(records) if "step" in record), 0)
        remarks[f"{_place(path, step)} {ended}"] = False
        if not step:
            break
        done = [name for name, _ in results]
        left = [name for name in job.exercises if done.count(name) < (len(job.seeds) or 1)]
        job = replace(job, skipped=[*job.skipped, step], exercises=left)
    return list(results.values()), remarks


def _place(path: Path, cell: int | None) -> str:
    return f"{path.parent.name if path.name == MANIFEST else path.name}{f', cell {cell}' if cell else ''}"


def _attempt(student: Student, path: Path, job: Job, limits: Limits) -> tuple[list[dict[str, Any]], str]:
    """Run a submission in a copy of its folder; return its records, and what ended it before its end, or ""."""
    with TemporaryDirectory(prefix="rosmini-grade-", ignore_cleanup_errors=True) as scratch:
        copy, records = Path(scratch) / "submission", Path(scratch) / "records"
        if student.folder.is_dir():
            shutil.copytree(student.folder, copy, symlinks=True)
            own = copy / path.relative_to(student.folder)
        else:
            copy.mkdir()
            own = Path(shutil.copy(path, copy))
        records.touch()
        with records.open(encoding="utf-8") as file:
            process = _started(replace(job, path=str(own), records=str(records)), copy)
            found: list[dict[str, Any]] = []
            try:
                ended = _watched(process, file, found, limits)
            finally:
                _kill(process, scratch)
    return found, ended


def _started(job: Job, packages: Path) -> subprocess.Popen[str]:
    """Start the process of a submission, as the leader of its own group."""
    paths = os.pathsep.join(filter(None, (str(packages), os.environ.get("ROS_PACKAGE_PATH"))))
    own = {"ROS_PACKAGE_PATH": paths, "MPLBACKEND": "agg", "BROWSER": "true", MARK: str(packages.parent)}
    process = subprocess.Popen(
        [sys.executable, "-P", "-m", "rosmini.book.submission"],
        cwd=Path(job.path).parent,
        env=os.environ | own,
        stdin=subprocess.PIPE,
        stdout=subprocess.DEVNULL,
        stderr=subprocess.DEVNULL,
        start_new_session=True,
        encoding="utf-8",
    )
    if process.stdin:
        with suppress(BrokenPipeError):
            process.stdin.write(to_json(job))
            process.stdin.close()
    return process


def _watched(process: subprocess.Popen[str], file: TextIO, records: list[dict[str, Any]], limits: Limits) -> str:
    """Read records until the process ends or exceeds a limit; return why it did not reach its end, or ""."""
    begin = time.monotonic()
    step = begin + START
    rest = ""
    while True:
        over = process.poll() is not None  # before the last records are read
        *lines, rest = (rest + file.read()).split("\n")
        for line in lines:
            records.append(json.loads(line))
            step = time.monotonic()
        if records and "end" in records[-1]:
            return ""
        if over:
            return _exit_said(process.returncode, limits)
        now = time.monotonic()
        if now > step + limits.seconds or now > begin + START + WHOLE * limits.seconds:
            return f"did not end within {limits.seconds if now > step + limits.seconds else now - begin:.0f} s"
        sizes = list(_sizes(process.pid))
        if len(sizes) > PROCESSES:
            return f"started more than {PROCESSES} processes"
        if sum(sizes) > limits.memory:
            return _exit_said(OUT_OF_MEMORY, limits)
        time.sleep(PERIOD)


def _exit_said(status: int, limits: Limits) -> str:
    if status == OUT_OF_MEMORY:
        return f"used more than {limits.memory / 1e9:g} GB of memory"
    if status < 0:
        return f"ended the interpreter ({signal.strsignal(-status)})"
    return f"ended the interpreter (exit status {status})"


def _sizes(group: int) -> Iterator[int]:
    """Yield the resident memory of each process of a group [bytes]; nothing where there is no /proc."""
    page = os.sysconf("SC_PAGE_SIZE") if hasattr(os, "sysconf") else 0
    for stat in Path("/proc").glob("[0-9]*/stat"):
        with suppress(OSError):
            values = stat.read_text(encoding="utf-8", errors="replace").rpartition(")")[2].split()
            if int(values[2]) == group:
                yield int(values[21]) * page


def _kill(process: subprocess.Popen[str], mark: str) -> None:
    """Kill a process with its group, and on Linux also what it has started outside the group."""
    if sys.platform == "win32":
        process.kill()
    else:
        with suppress(ProcessLookupError, PermissionError):
            os.killpg(process.pid, signal.SIGKILL)
        for path in Path("/proc").glob("[0-9]*/environ"):
            with suppress(OSError):
                if f"{MARK}={mark}".encode() in path.read_bytes().split(b"\0"):
                    os.kill(int(path.parent.name), signal.SIGKILL)
    process.wait()


PAGE = """<!DOCTYPE html>
<html lang="en">
<head>
<meta charset="utf-8">
<title>{title}</title>
<style>
body {{ font-family: sans-serif; max-width: 60em; margin: 2em auto; padding: 0 1em }}
pre {{ white-space: pre-wrap }}
iframe {{ width: 100%; height: 40em; border: 1px solid #888 }}
</style>
</head>
<body>
<h1>{title}</h1>
{content}
</body>
</html>
"""
REPLAY = '<iframe sandbox="allow-scripts" title="Replay" srcdoc="{}"></iframe>'
"""A drive. The frame is separate from the page, because a submission can write into it."""


def _page(student: Student, count: int) -> str:
    """Return a student's page: each verdict with the replay of the drive."""
    parts = [f"<p>{html.escape(remark)}</p>" for remark in student.remarks]
    for result in student.results:
        seed = f", seed {result['seed']}" if result["seed"] else ""
        parts.append(f"<h2>{html.escape(result['exercise'] + seed)}</h2>\n<pre>{html.escape(result['text'])}</pre>")
        if result["page"]:
            parts.append(REPLAY.format(html.escape(result["page"])))
    title = html.escape(f"{student.name}: {student.total:g} of {count}")
    return PAGE.format(title=title, content="\n".join(parts))
