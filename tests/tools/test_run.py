"""The command line of `rosmini run`."""

import argparse

import pytest

from rosmini.core.errors import RosminiError
from rosmini.tools import run as command
from rosmini.tools.main import main


def test_scripts_and_arguments():
    specs = command.nodes_in(["a.py", "x:=y", "++", "+", "b.py", "-v", "--", "z"])
    assert [(spec.path, spec.args) for spec in specs] == [("a.py", ("x:=y", "+")), ("b.py", ("-v", "--", "z"))]


@pytest.mark.parametrize("words", [[], ["+"], ["a.py", "+"], ["+", "a.py"], ["a.py", "+", "+", "b.py"]])
def test_a_missing_script_is_an_error(words):
    with pytest.raises(RosminiError, match="script"):
        command.nodes_in(words)


@pytest.mark.parametrize(
    ("words", "left", "ours"),
    [
        (["a.py", "--duration", "5"], ["a.py"], ["--duration", "5"]),
        (["a.py", "+", "b.py", "--sim-time", "--duration=5"], ["a.py", "+", "b.py"], ["--sim-time", "--duration=5"]),
        (["a.py", "--duration", "5", "--"], ["a.py", "--duration", "5"], []),
        (["a.py", "--sim-time", "+", "b.py"], ["a.py", "--sim-time", "+", "b.py"], []),
        (["a.py", "--rate", "5"], ["a.py", "--rate", "5"], []),
        (["a.py", "--duration"], ["a.py"], ["--duration"]),
        ([], [], []),
    ],
)
def test_options_at_the_end(words, left, ours):
    assert command.split_options(words) == (left, ours)


@pytest.fixture
def scripts(tmp_path):
    (tmp_path / "clock.py").write_text(
        "import sys, time\nt = time.time()\nfor _ in range(3):\n    time.sleep(100)\nprint(time.time() - t, "
        "sys.argv[1:])\n",
        encoding="utf-8",
    )
    (tmp_path / "bad.py").write_text("import sys\nprint('to stderr', file=sys.stderr)\n1 / 0\n", encoding="utf-8")
    (tmp_path / "wait.py").write_text("import threading\nthreading.Event().wait()\n", encoding="utf-8")
    return tmp_path


@pytest.mark.parametrize("before", [True, False])
def test_simulated_time_from_either_end(scripts, capsys, monkeypatch, before):
    monkeypatch.setattr("sys.stdin", None)
    words = [str(scripts / "clock.py"), "a", "+", str(scripts / "clock.py"), "b"]
    assert main(["run", "--sim-time", *words] if before else ["run", *words, "--sim-time"]) == 0
    assert capsys.readouterr().out.splitlines() == ["[clock] 300.0 ['a']", "[clock] 300.0 ['b']"]


def test_duration_selects_simulated_time(scripts, capsys, monkeypatch):
    monkeypatch.setattr("sys.stdin", None)
    assert main(["run", str(scripts / "clock.py"), "--duration", "250"]) == 0
    assert capsys.readouterr().out == ""
    assert main(["run", "--duration", "350", str(scripts / "clock.py")]) == 0
    assert capsys.readouterr().out == "[clock] 300.0 []\n"
    assert main(["run", str(scripts / "clock.py"), "--wall-time", "--duration", "0.01"]) == 0
    assert capsys.readouterr().out == ""


def test_a_failure_gives_its_status_and_traceback(scripts, capsys, monkeypatch):
    monkeypatch.setattr("sys.stdin", None)
    assert main(["run", str(scripts / "bad.py"), "+", str(scripts / "clock.py"), "--sim-time"]) == 1
    out, err = capsys.readouterr()
    assert out == "[clock] 300.0 []\n"
    assert err.splitlines()[0] == "[bad] to stderr"
    assert err.splitlines()[-1] == "[bad] ZeroDivisionError: division by zero"
    assert 'bad.py", line 3, in <module>' in err


def test_what_was_waited_for_is_said(scripts, capsys, monkeypatch):
    monkeypatch.setattr("sys.stdin", None)
    assert main(["run", "--sim-time", str(scripts / "wait.py")]) == 0
    assert "wait was waiting for an event to be set" in capsys.readouterr().err


def test_errors_on_the_command_line(scripts, capsys):
    assert main(["run", str(scripts / "clok.py")]) == 1
    assert "did you mean clock.py?" in capsys.readouterr().err
    assert main(["run"]) == 1
    assert "no script and no node was given" in capsys.readouterr().err
    for words in (["--duration", "0", "a.py"], ["a.py", "--duration", "soon"], ["--sim-time", "a.py", "--wall-time"]):
        with pytest.raises(SystemExit) as caught:
            main(["run", *words])
        assert caught.value.code == 2


def test_help_tells_where_options_stand(capsys):
    with pytest.raises(SystemExit):
        main(["run", "--help"])
    shown = capsys.readouterr().out
    assert "before the first node or at the very end" in shown
    assert "lone `--`" in shown


def test_positive():
    assert command.positive("2.5") == 2.5
    for text in ("-1", "nan", "inf", "x"):
        with pytest.raises(argparse.ArgumentTypeError):
            command.positive(text)
