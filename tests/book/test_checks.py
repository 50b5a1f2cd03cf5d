"""Exercise checks: what the reader sees for no answer, a wrong one, one that raises, and a right one."""

from __future__ import annotations

import importlib
import json
import operator
import os
import pkgutil
import types

import pytest

import rosmini.book.exercises
from rosmini.book import checks
from rosmini.book.checks import (
    Exercise,
    NoAnswer,
    Script,
    SeveralAnswers,
    Status,
    UnknownExercise,
    check,
    exercise,
    expect,
    is_stub,
)
from rosmini.msgs.importer import forget

from ..conftest import nightly


@exercise("wheels", praise="Six wheels it is.")
def wheels(answer):
    expect(answer == 6, f"A rover has 6 wheels, not {answer}.", hint="count the middle ones too")


@exercise("doubling", praise="Doubled.")
def doubling(answer):
    expect(answer(2) == 4, "It does not double 2.")


def method_stub(self, msg): ...


class StubNode:
    """A node."""

    def callback(self, msg):
        """Called for each message."""


class Node(StubNode):
    def callback(self, msg):
        self.last = msg


def documented_stub():
    """Return the answer."""
    ...


def passing_stub():
    pass


@pytest.mark.parametrize(
    "stub", [..., [..., ...], (...,), {"a": ...}, method_stub, documented_stub, passing_stub, StubNode]
)
def test_a_stub_is_not_attempted(stub):
    assert is_stub(stub)
    verdict = wheels.grade(stub)
    assert (verdict.status, verdict.text) == (Status.NOT_ATTEMPTED, "Exercise wheels: not attempted yet.")


@pytest.mark.parametrize("name", ["lane_order", "fast_commands", "polygon"])
def test_an_answer_of_another_type_is_named_with_the_right_article(name):
    assert "is an int, not a string." in checks.find(name).grade(3).text


gaps = Exercise("gaps", "Good.", lambda _: None, gaps=2)


@pytest.mark.parametrize(
    ("task", "answer", "said"),
    [
        (gaps, [1, ...], " `...` in place 2 of 2."),
        (gaps, (..., 2), " `...` in place 1 of 2."),
        (gaps, {"a": 1, "b": ...}, " `...` for 'b'."),
        (gaps, Script("stop.py", "def on_scan(scan):\n    return\n...\n"), " `...` in line 3."),
        (wheels, 5, "A rover has 6 wheels, not 5.\nHint: count the middle ones too"),
        (doubling, lambda x: x / 0, "ZeroDivisionError: division by zero"),
    ],
)
def test_a_wrong_answer_is_told_why(task, answer, said):
    verdict = task.grade(answer)
    assert verdict.status is Status.WRONG and said in verdict.text


@pytest.mark.parametrize("answer", [None, 0, "", [], (), {}, int, Node, StubNode(), lambda: 7, print, lambda x: x])
def test_an_answer_is_not_a_stub(answer):
    assert not is_stub(answer)


def test_an_answer_of_another_form_is_not_code_that_raised():
    """Of `{1: 2}` the reader was told that their code raised an AttributeError."""
    lower = Exercise("lower", "Good.", operator.methodcaller("lower"))  # no frame of a reader
    assert lower.grade("A").status is Status.RIGHT
    told = lower.grade({1: 2}).text
    assert "{1: 2}" in told and "AttributeError: 'dict' object has no attribute 'lower'\nHint: " in told
    assert "Your code raised" not in told
    assert "Your code raised AttributeError" in Exercise("lower", "", lambda answer: answer.lower()).grade(1).text


def test_a_check_that_wants_a_script_says_so():
    def examine(answer: Script):
        return expect("six" in answer.source, "No six.")

    told = Exercise("six", "Good.", examine).grade(42).text
    assert "of type int" in told and "check('six')" in told and "%%node" in told


@pytest.fixture
def chapter(tmp_path, monkeypatch):
    """A chapter with the exercise `wheels`."""
    (tmp_path / "rover.py").write_text('@exercise("wheels", praise="Six wheels it is.")\n', encoding="utf-8")
    module = types.ModuleType("rover")
    module.wheels = wheels
    monkeypatch.setattr(checks, "EXERCISES", tmp_path)
    monkeypatch.setattr(checks.importlib, "import_module", lambda name: module)
    checks._modules.cache_clear()
    yield
    checks._modules.cache_clear()


def test_check_prints_and_returns_the_verdict(chapter, capsys):
    right, wrong, stub = check("wheels", 6), check("wheels", 5), check("wheels", ...)
    assert [bool(verdict) for verdict in (right, wrong, stub)] == [True, False, False]
    assert right.status is Status.RIGHT and repr(right) == right.text
    assert capsys.readouterr().out == f"{right}\n{wrong}\n{stub}\n"


def test_a_notebook_shows_a_verdict_once_in_the_cell_of_its_check(chapter, capsys):
    from IPython.core.interactiveshell import InteractiveShell

    InteractiveShell.clear_instance()
    shell = InteractiveShell.instance()
    try:
        shell.run_cell("from rosmini.book import check\ncheck('wheels', 6)", store_history=True)
        assert capsys.readouterr().out.count("right. Six wheels it is.") == 1
        shell.run_cell("verdict = check('wheels', 5)\nassert not verdict", store_history=True)
        shell.run_cell("verdict", store_history=True)
        assert capsys.readouterr().out.count("A rover has 6 wheels, not 5.") == 2
    finally:
        InteractiveShell.clear_instance()


def test_a_mistyped_exercise(chapter):
    with pytest.raises(UnknownExercise, match=r"no exercise 'wheel'.*did you mean wheels\?"):
        check("wheel", 6)


def test_two_answers(chapter):
    with pytest.raises(SeveralAnswers, match=r'check\("wheels", \.\.\.\) takes one answer, not 2: '):
        check("wheels", 5, 6)


def test_right_answers_are_noted_for_the_page_of_progress(chapter, tmp_path, monkeypatch):
    path = tmp_path / "progress.json"
    check("wheels", 6)
    assert not path.exists()
    monkeypatch.setenv(checks.PROGRESS, str(path))
    check("wheels", 5)
    assert not path.exists()
    path.write_text('{"exercises": {"stop": "2026-11-27"}, "damaged', encoding="utf-8")
    check("wheels", 6)
    notes = json.loads(path.read_text(encoding="utf-8"))
    assert notes["pages"] == {}
    assert list(notes["exercises"]) == ["wheels"]
    notes["exercises"] = {"wheels": "2026-11-27", "stop": "2026-11-28"}
    path.write_text(json.dumps(notes), encoding="utf-8")
    check("wheels", 6)
    assert json.loads(path.read_text(encoding="utf-8")) == notes
    monkeypatch.setenv(checks.PROGRESS, str(tmp_path))  # a folder: it cannot be written
    assert check("wheels", 6)


@pytest.fixture
def scripts(tmp_path, monkeypatch):
    """The folder of a notebook's scripts, and exercise wheels, which takes one."""
    folder = tmp_path / "notebook" / "scripts"
    folder.mkdir(parents=True)
    (tmp_path / "notebook" / "package.xml").write_text(
        "<package><name>notebook</name><version>0.0.0</version></package>", encoding="utf-8"
    )
    monkeypatch.setenv("ROS_PACKAGE_PATH", str(tmp_path))
    taken = exercise("wheels", praise="Read.")(lambda script: expect("six" in script.source, script.name))
    monkeypatch.setattr(checks, "find", lambda name: taken)
    return folder


def put(folder, name, *lines, second=0):
    path = folder / name
    path.write_text("\n".join(["#!/usr/bin/env python3", *lines]), encoding="utf-8")
    os.utime(path, ns=(second, second))


def test_a_stub_is_told_the_line_of_its_first_gap(scripts, capsys):
    put(scripts, "wheels.py", "# Exercise: wheels", "six = 6", "...")
    check("wheels")
    assert "line 4" in capsys.readouterr().out


def test_without_an_answer_the_script_of_the_cell_is_checked(scripts, capsys):
    put(scripts, "other.py", "# Exercise: wheels_of_a_cart", "five = 5")
    put(scripts, "wheels.py", "# Exercise: wheels", "...")
    check("wheels")
    put(scripts, "wheels.py", "# Exercise: wheels", "five = 5", second=1)
    check("wheels")
    put(scripts, "renamed.py", "# Exercise: wheels", "six = 6", second=2)
    check("wheels")
    first, second, third = capsys.readouterr().out.splitlines()
    assert "line 3" in first and second.endswith("wheels.py") and third.endswith("Read.")


def test_a_cell_that_was_not_run_is_said(scripts, monkeypatch):
    put(scripts, "other.py", "x = 1", "# Exercise: wheels")
    with pytest.raises(NoAnswer, match=r"run the %%node cell that has `# Exercise: wheels` in its second line"):
        check("wheels")
    monkeypatch.setenv("ROS_PACKAGE_PATH", "")
    with pytest.raises(NoAnswer):
        check("wheels")


@pytest.mark.parametrize("name", ["11.1", "", "../.."])
def test_a_name_that_no_exercise_has(name):
    with pytest.raises(UnknownExercise, match="there is no exercise"):
        check(name, 1)


def test_no_two_exercises_have_the_same_name():
    names = [found.name for found in all_exercises()]
    assert len(names) == len(set(names))


def all_exercises():
    for module in pkgutil.iter_modules(rosmini.book.exercises.__path__):
        found = importlib.import_module(f"rosmini.book.exercises.{module.name}")
        yield from (value for value in vars(found).values() if isinstance(value, checks.Exercise))


def mistakes_module(found):
    chapter = found.examine.__module__.rpartition(".")[2]
    return importlib.import_module(f".exercises.mistakes.{chapter}", __package__)


def mistakes_of(found):
    """Functions that each return a wrong answer, so that no check can pass always."""
    return mistakes_module(found).MISTAKES[found.name]


@pytest.fixture
def package(found, tmp_path, monkeypatch):
    """The notebook's package, with the files that cells of the chapter write, if wrong answers need any."""
    files = getattr(mistakes_module(found), "PACKAGE", {})
    if not files:
        return
    folder = tmp_path / checks.NOTEBOOK
    manifest = f"<package><name>{checks.NOTEBOOK}</name><version>0.0.0</version></package>"
    for name, text in (files | {"package.xml": manifest}).items():
        (folder / name).parent.mkdir(parents=True, exist_ok=True)
        (folder / name).write_text(text, encoding="utf-8")
    monkeypatch.setenv("ROS_PACKAGE_PATH", str(tmp_path))
    forget(checks.NOTEBOOK)


each_exercise = pytest.mark.parametrize("found", list(all_exercises()), ids=lambda found: found.name)


def wrong_answers(found, *, at_night):
    """The answers that are compared; at night the scripts and files, which are run. Solutions run in the chapters."""
    return [answer for mistake in mistakes_of(found) if isinstance(answer := mistake(), Script | str) == at_night]


@pytest.mark.usefixtures("package")
@pytest.mark.parametrize("at_night", [False, *nightly(True)])
@each_exercise
def test_every_check_refuses_mistakes(found, at_night):
    assert mistakes_of(found)
    for answer in wrong_answers(found, at_night=at_night):
        verdict = found.grade(answer)
        assert verdict.status is Status.WRONG, verdict.text


@pytest.mark.nightly
@pytest.mark.usefixtures("package")
@each_exercise
def test_a_verdict_is_the_same_in_each_run(found):
    for mistake in mistakes_of(found):
        first, second = (found.grade(mistake()).text for _ in range(2))
        assert first == second


def test_a_check_that_lacks_numpy_gives_no_verdict():
    @exercise("drive", praise="")
    def drive(_):
        raise ModuleNotFoundError("No module named 'numpy'", name="numpy")

    with pytest.raises(checks.Unavailable, match="rosmini lab"):
        drive.grade(1)
