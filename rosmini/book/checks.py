"""Exercises that check themselves.

A notebook passes an answer to `check`, which prints one of three things: that the exercise has not been attempted yet,
what is wrong with the answer and a hint, or that it is right. Each chapter has a module in `rosmini/book/exercises`,
with one `Exercise` for each exercise, which decides this. `book/about/writing_chapters.md` explains how to write one.
"""

from __future__ import annotations

import ast
import functools
import importlib
import json
import math
import os
import re
import reprlib
import sys
import sysconfig
import traceback
import types
from contextlib import suppress
from contextvars import ContextVar
from dataclasses import dataclass
from datetime import UTC, datetime
from enum import Enum
from numbers import Real
from pathlib import Path
from typing import TYPE_CHECKING, Any, cast

from rosmini.core.errors import RosminiError, nearest
from rosmini.core.graph.notebook import mark_as_shown
from rosmini.core.packages import PackageIndex

if TYPE_CHECKING:
    from collections.abc import Callable
    from types import UnionType

    from rosmini.msgs.message import Message


EXERCISES = Path(__file__).with_name("exercises")
"""The folder of the chapters' modules."""
NOTEBOOK = "notebook"
"""Name of the package that contains a notebook's scripts."""
SEED: ContextVar[int] = ContextVar("rosmini_check_seed", default=0)
"""The seed of the check that is running: that of all random numbers in its simulations. 0 is the seed of the book."""
PROGRESS = "ROSMINI_PROGRESS"
"""Environment variable with the path of the reader's file of solved exercises. `rosmini lab` sets it."""


class UnknownExercise(RosminiError):
    """There is no exercise with that name."""


class NoAnswer(RosminiError):
    """There is no script to check."""


class Unavailable(RosminiError):
    """A check needs a package that is missing here."""


class SeveralAnswers(RosminiError):
    """A check got more than one answer."""


class Wrong(RosminiError):
    """The answer is wrong: the message says why, `hint` says where to look, `view` is a picture of the run."""

    def __init__(self, message: str, hint: str = "", view: Any = None) -> None:
        super().__init__(message)
        self.hint = hint
        self.view = view


@dataclass(frozen=True)
class Script:
    """An answer that is a script: the name of its file, and its text."""

    name: str
    source: str

    @property
    def gaps(self) -> list[int]:
        """Lines with a bare `...`, where the reader is to write; empty if the script is not valid Python."""
        try:
            tree = ast.parse(self.source)
        except SyntaxError:
            return []
        return sorted(
            node.lineno
            for node in ast.walk(tree)
            if isinstance(node, ast.Expr) and isinstance(node.value, ast.Constant) and node.value.value is ...
        )


class Status(Enum):
    """The result of a check."""

    NOT_ATTEMPTED = "not attempted yet"
    WRONG = "not right yet"
    RIGHT = "right"


@dataclass(frozen=True, repr=False)
class Verdict:
    """The result of a check, true if the answer is right: the text for the reader, and a picture of the run or None."""

    status: Status
    text: str
    view: Any = None

    def __bool__(self) -> bool:
        return self.status is Status.RIGHT

    def __repr__(self) -> str:
        return self.text


@dataclass(frozen=True)
class Exercise:
    """One exercise: its name ("board"), the praise for a right answer, and the function that examines an answer.

    `examine(answer)` raises `Wrong`, usually through `expect`, or returns a picture of the run, or None. `gaps` is the
    number of bare `...` in the stub of a script. `truths` are the keys of an answer whose values may be True or False;
    everywhere else these are refused, although Python counts them as numbers.
    """

    name: str
    praise: str
    examine: Callable[[Any], Any]
    gaps: int = 1
    truths: tuple[str, ...] = ()

    def grade(self, answer: Any, seed: int = 0) -> Verdict:
        """Examine `answer` in simulations with this seed. An exception from the reader's code makes it wrong.

        Raises `Unavailable` without numpy, which a page that runs in the browser does not have.
        """
        if is_stub(answer, self.gaps):
            at = gap_left(answer) if isinstance(answer, Script) else ""
            return self._verdict(Status.NOT_ATTEMPTED, f"Replace the `...` {at}." if at else "")
        if left := gap_left(answer):
            return self._verdict(Status.WRONG, f"There is still a `...` {left}.")
        if self._is_script() and not isinstance(answer, Script):
            said = f"The answer is of type {type(answer).__name__}, not a script."
            return self._verdict(Status.WRONG, f"{said}\nHint: check({self.name!r}) finds your %%node cell")
        before = SEED.set(seed)
        try:
            view = self.examine(self._watched(answer))
        except Wrong as wrong:
            hint = f"\nHint: {wrong.hint}" if wrong.hint else ""
            return self._verdict(Status.WRONG, f"{wrong}{hint}", wrong.view)
        except Exception as error:
            if isinstance(error, ModuleNotFoundError) and error.name == "numpy":
                raise Unavailable(
                    "This check needs numpy, which a page in the browser does not have. "
                    "Check the exercise in JupyterLab: uv run rosmini lab"
                ) from None
            return self._verdict(Status.WRONG, _unexpected(answer, error))
        finally:
            SEED.reset(before)
        return self._verdict(Status.RIGHT, self.praise, view)

    def _watched(self, answer: Any) -> Any:
        """Return the answer; refuse truth values where numbers are expected, also in the result of a function."""
        if not isinstance(answer, types.FunctionType):
            return _numbers_only(answer, "The answer has", self.truths)

        @functools.wraps(answer)
        def watched(*args: Any, **named: Any) -> Any:
            return _numbers_only(answer(*args, **named), "It returned", self.truths)

        return watched

    def _is_script(self) -> bool:
        return getattr(self.examine, "__annotations__", {}).get("answer") == Script.__name__

    def _verdict(self, status: Status, more: str = "", view: Any = None) -> Verdict:
        text = f"Exercise {self.name}: {status.value}."
        return Verdict(status, f"{text} {more}" if more else text, view)


def _numbers_only(value: Any, said: str, truths: tuple[str, ...]) -> Any:
    """Expect truth values in `value` only under the keys `truths`; return it, with numpy's numbers as Python's."""
    if getattr(value, "shape", None) == () and hasattr(value, "item"):
        value = value.item()
    expect(
        not isinstance(value, bool),
        f"{said} {value} where a number or a string is expected.",
        "1 and 0 are numbers, True and False are truth values",
    )
    if isinstance(value, dict):
        for key, each in value.items():
            _numbers_only(key, said, ())
            if not (isinstance(key, str) and key in truths):
                _numbers_only(each, said, truths)
    elif isinstance(value, list | tuple | set | frozenset):
        for each in value:
            _numbers_only(each, said, truths)
    return value


def _unexpected(answer: Any, error: Exception) -> str:
    """Describe an exception: from the reader's code, or from the check because the answer has the wrong form."""
    said = f"{type(error).__name__}: {error}"
    if (
        isinstance(error, RosminiError)
        or callable(answer)
        or any(_is_readers(frame) for frame, _ in traceback.walk_tb(error.__traceback__))
    ):
        return f"Your code raised {said}"
    shown = reprlib.repr(answer)
    if str(error).endswith("object is not callable"):
        return f"{shown} is not a function."
    return f"{shown} does not have the expected form: {said}\nHint: compare it with the stub"


def _is_readers(frame: types.FrameType) -> bool:
    libraries = (str(Path(__file__).parents[1]), *sysconfig.get_paths().values(), "<frozen ")
    return not frame.f_code.co_filename.startswith(libraries)


def exercise(
    name: str, *, praise: str, gaps: int = 1, truths: tuple[str, ...] = ()
) -> Callable[[Callable[[Any], Any]], Exercise]:
    """Make an `Exercise` of the decorated function, which examines an answer."""
    return lambda examine: Exercise(name, praise, examine, gaps, truths)


def expect(condition: object, message: str, hint: str = "") -> None:
    """Raise `Wrong` with `message` and `hint` unless `condition` is true."""
    if not condition:
        raise Wrong(message, hint)


def call_bounded(answer: Callable[..., Any], *arguments: Any, lines: int = 200_000) -> Any:
    """Call an answer and return its result; expect it to return within this number of executed lines.

    On Emscripten there is no limit, since tracing crashes Pyodide; the reader stops the cell.
    """
    if sys.platform == "emscripten":
        return answer(*arguments)
    left = lines

    def watch(_frame: object, event: str, _argument: object) -> Any:
        nonlocal left
        left -= event == "line"
        expect(left > 0, "It never returns.", "which loop runs for ever, and what should end it?")
        return watch

    before = sys.gettrace()
    sys.settrace(watch)
    try:
        return answer(*arguments)
    finally:
        sys.settrace(before)


def expect_type(
    found: object, kinds: type | UnionType | tuple[type, ...], said: str, wanted: str, hint: str = ""
) -> None:
    """Expect an object of one of `kinds`; the message is "`said` a TYPE, not `wanted`."."""
    name = type(found).__name__
    article = "an" if name[0].lower() in "aeiou" else "a"
    expect(isinstance(found, kinds), f"{said} {article} {name}, not {wanted}.", hint)


def expect_number(found: object, what: str) -> float:
    """Expect a number, finite or infinite, that is not a bool, and return it as a float.

    Arrays without a dimension, which functions such as `np.where` return, count as numbers.
    """
    if getattr(found, "shape", None) == ():
        found = cast("Any", found).item()
    expect(
        isinstance(found, Real) and not isinstance(found, bool) and not math.isnan(found),
        f"It returned {found!r}, which is not a {what}.",
        "return one number",
    )
    return float(cast("Real", found))


def expect_fields(found: type[Message], wanted: type[Message], what: str) -> None:
    """Expect two message classes to have the same fields; the error names the first difference of `what`."""
    given, right = ([(field.type, field.ros_name) for field in cls._spec.fields] for cls in (found, wanted))
    for kind, name in right:
        kinds = [other for other, field in given if field == name]
        expect(kinds, f"There is no field {name} in the {what}.", "a field is 'type name'")
        expect(kinds == [kind], f"The field {name} of the {what} has the type {kinds[0]}, not {kind}.")
    extra = [name for _, name in given if name not in [field for _, field in right]]
    expect(not extra, f"The {what} has a field that the task does not mention: {', '.join(extra)}.")
    expect(given == right, f"The fields of the {what} are in the wrong order.")


def check(name: str, *answer: Any, seed: int = 0) -> Verdict:
    """Check `answer` to the exercise `name`, print the verdict, show the robot's run, and return the verdict.

    The verdict is true if the answer is right, so that `assert check("gentle")` works. The default answer is the script
    written by the `%%node` cell with `# Exercise: gentle` in its second line. With another `seed`, sensors and wheels
    have other errors. Raises `UnknownExercise` if there is no such exercise, `NoAnswer` if no such cell was run, and
    `SeveralAnswers` for more than one answer.
    """
    exercise = find(name)
    verdict = exercise.grade(given(name, answer), seed)
    if verdict:
        note_solved(name)
    print(verdict)
    if verdict.view is not None:
        from IPython.core.display_functions import display

        display(verdict.view)  # type: ignore[no-untyped-call]
    if shell := getattr(sys.modules.get("IPython"), "get_ipython", lambda: None)():
        mark_as_shown(verdict, shell)
    return verdict


def given(name: str, answers: tuple[Any, ...]) -> Any:
    """Return the answer among the arguments of a check, by default its script. Raises `NoAnswer`, `SeveralAnswers`."""
    if len(answers) > 1:
        raise SeveralAnswers(
            f'check("{name}", ...) takes one answer, not {len(answers)}: pass one variable, as the stub does'
        )
    return answers[0] if answers else written(name)


def note_solved(name: str) -> None:
    """Add an exercise, with the date, to the reader's file of solved exercises, if there is one.

    The page "Your progress" imports this file; its form is described in `book/static/progress.js`.
    """
    if not (path := os.environ.get(PROGRESS)):
        return
    notes: dict[str, dict[str, str]] = {"pages": {}, "exercises": {}}
    with suppress(OSError, ValueError):  # no such file yet, or a damaged one
        notes["exercises"] |= json.loads(Path(path).read_text(encoding="utf-8"))["exercises"]
    notes["exercises"].setdefault(name, datetime.now(UTC).date().isoformat())
    with suppress(OSError):  # a verdict does not depend on it
        Path(path).write_text(json.dumps(notes, indent=2), encoding="utf-8", newline="\n")


def written(name: str) -> Script:
    """Return the latest script in the notebook's package whose second line names the exercise.

    Raises `NoAnswer` if there is none.
    """
    index = PackageIndex()
    found = index.path(NOTEBOOK).glob("scripts/*.py") if NOTEBOOK in index else ()
    line = re.compile(rf"[^\n]*\n#\s*Exercise:\s+{re.escape(name)}\b")
    for path in sorted(found, key=lambda path: path.stat().st_mtime_ns, reverse=True):
        if line.match(source := path.read_text(encoding="utf-8")):
            return Script(path.name, source)
    raise NoAnswer(
        f"the exercise {name} has no script yet: run the %%node cell that has `# Exercise: {name}` in its second line. "
        "If it shows an error, fix that first"
    )


def names() -> list[str]:
    """Return the names of all exercises."""
    return list(_modules())


def find(name: str) -> Exercise:
    """Return the exercise with this name. Raises `UnknownExercise` if there is none."""
    modules = _modules()
    if name not in modules:
        raise UnknownExercise(f"there is no exercise {name!r}. {nearest(name, modules) or ''}".rstrip())
    members = vars(importlib.import_module(f"rosmini.book.exercises.{modules[name]}")).values()
    return next(found for found in members if isinstance(found, Exercise) and found.name == name)


@functools.cache
def _modules() -> dict[str, str]:
    """Return the module of each exercise, by the exercise's name.

    The modules are read rather than imported: each of them imports much that the others do not need.
    """
    declared = re.compile(r'^@exercise\(\s*"(\w+)"', re.MULTILINE)
    return {
        name: path.stem
        for path in sorted(EXERCISES.glob("*.py"))
        for name in declared.findall(path.read_text(encoding="utf-8"))
    }


def is_stub(answer: Any, gaps: int = 1) -> bool:
    """True if the reader has not begun: `...`, a container of nothing else, or a function or class that does nothing.

    A script is a stub while it has all of its bare `...`, whose number is `gaps`.
    """
    if answer is ...:
        return True
    if isinstance(answer, Script):
        return len(answer.gaps) >= gaps
    if isinstance(answer, dict):
        return bool(answer) and all(is_stub(value) for value in answer.values())
    if isinstance(answer, list | tuple):
        return bool(answer) and all(is_stub(value) for value in answer)
    if isinstance(answer, types.FunctionType):
        return _does_nothing(answer)
    if isinstance(answer, type):
        methods = [value for value in vars(answer).values() if isinstance(value, types.FunctionType)]
        return bool(methods) and all(_does_nothing(method) for method in methods)
    return False


def gap_left(answer: Any) -> str:
    """Return where an incomplete answer still contains a `...`, such as "in line 9"; empty if nowhere."""
    if isinstance(answer, Script) and answer.gaps:
        return f"in line {answer.gaps[0]}"
    if isinstance(answer, dict):
        return next((f"for {key!r}" for key, value in answer.items() if is_stub(value)), "")
    if isinstance(answer, list | tuple):
        places = (number for number, value in enumerate(answer, start=1) if is_stub(value))
        return next((f"in place {number} of {len(answer)}" for number in places), "")
    return ""


def _bare() -> None: ...


def _documented() -> None:
    """Do nothing, and say so."""


def _does_nothing(function: types.FunctionType) -> bool:
    code = function.__code__
    bodies = {_bare.__code__.co_code, _documented.__code__.co_code}
    return code.co_code in bodies and set(code.co_consts) <= {None, function.__doc__}
