"""The `rosmini` command: what it lists, what it imports, how it ends."""

from __future__ import annotations

import os
import re
import subprocess
import sys

import pytest

import rosmini.__main__ as entry
import rosmini.tools.main as cli
from rosmini.core.errors import RosminiError

from ..processes import free_port, run
from .transcripts import read


def python(code: str, **env: str) -> subprocess.CompletedProcess[str]:
    return run([sys.executable, "-c", code], env=os.environ | env)


def test_help_lists_the_commands_without_importing_them():
    done = python(
        "import sys, rosmini.tools.main as m\n"
        "try: m.main(['--help'])\n"
        "except SystemExit as end: assert end.code == 0\n"
        "loaded = [e.module for e in m.COMMANDS.values() if isinstance(e, m.Entry) and e.module in sys.modules]\n"
        "assert not loaded, loaded\n"
    )
    assert done.returncode == 0, done.stderr
    listed = re.split(r"[\s,]+", done.stdout)
    assert [name for name in cli.COMMANDS if name not in listed] == []
    assert max(map(len, done.stdout.splitlines())) <= 100


def test_every_command_and_every_verb_has_its_own_help(capsys):
    for name in cli.COMMANDS:
        with pytest.raises(SystemExit) as end:
            cli.main([name, "--help"])
        assert end.value.code == 0
        assert f"usage: rosmini {name}" in capsys.readouterr().out.replace("Usage:", "usage:")
    for name in ("rosnode", "rostopic", "rosservice", "rosmsg", "rossrv"):
        for verb in cli.COMMANDS[name].tool().verbs:
            assert cli.main([name, verb, "-h"]) == 0
            said = capsys.readouterr().out
            assert said.startswith(f"Usage: {name} {verb}")
            assert f"Example:\n  rosmini {name} {verb}" in said


@pytest.mark.parametrize("line", ["rosnode list", "rostopic list", "rosservice list"])
def test_without_a_master_a_tool_says_what_to_do(line, monkeypatch, capsys):
    monkeypatch.setenv("ROS_MASTER_URI", f"http://127.0.0.1:{free_port()}")
    text, status = read("errors_no_master")[line]
    assert cli.main(line.split()) == status
    said = capsys.readouterr().err
    assert said.startswith(text)
    assert "rosmini roscore" in said
    assert "ROS_MASTER_URI" in said


def test_no_command_names_what_most_people_want_and_fails(capsys):
    assert cli.main([]) == 2
    said = capsys.readouterr().out
    for command in ("rosmini lab", "rosmini run ", "rosmini roslaunch ", "rosmini --help"):
        assert command in said


def test_version(capsys):
    assert cli.main(["--version"]) == 0
    name, number = capsys.readouterr().out.split()
    assert name == "rosmini"
    assert number[0].isdigit()


def test_an_unknown_command_suggests_the_nearest(capsys):
    assert cli.main(["bok"]) == 2
    said = capsys.readouterr().err
    assert said.startswith("rosmini: ") and "'bok'" in said and said.endswith("did you mean book?\n")


def test_a_command_unlike_any_leads_to_the_list(capsys):
    assert cli.main(["zzz"]) == 2
    assert "rosmini --help" in capsys.readouterr().err


class Failing:
    """A subcommand that ends with `error`."""

    def __init__(self, error: BaseException) -> None:
        self.error = error

    def add_parser(self, subparsers):
        subparsers.add_parser("book")

    def main(self, args):
        raise self.error


@pytest.mark.parametrize(
    ("error", "status", "says"),
    [
        (RosminiError("the battery is flat; charge it"), 1, "rosmini book: the battery is flat; charge it\n"),
        (KeyboardInterrupt(), 130, "\n"),
    ],
)
def test_how_a_command_fails(error, status, says, monkeypatch, capsys):
    monkeypatch.setattr(cli.importlib, "import_module", lambda name: Failing(error))
    assert cli.main(["book"]) == status
    assert capsys.readouterr().err == says


def test_importing_rosmini_is_light():
    heavy = ["matplotlib", "IPython", "numba", "ipywidgets", "meshcat", "sphinx", "pymunk"]
    done = python(f"import rosmini, sys; print([m for m in {heavy} if m in sys.modules])")
    assert done.stdout.strip() == "[]", done.stdout + done.stderr


def test_letters_that_the_locale_lacks_end_no_command(tmp_path):
    script = tmp_path / "talker.py"
    script.write_text("print('é → ü')\n", encoding="utf-8")
    words = [sys.executable, "-m", "rosmini", "run", script]
    done = run(words, env=os.environ | {"PYTHONIOENCODING": "cp1252", "PYTHONUTF8": "0"}, encoding="cp1252")
    assert (done.returncode, done.stdout, done.stderr) == (0, "[talker] é \\u2192 ü\n", "")


def test_ctrl_c_ends_the_command_quietly_while_its_modules_are_imported(monkeypatch, capsys):
    class Interrupted:
        """Finds no module: the user presses Ctrl-C first."""

        @staticmethod
        def find_spec(*_):
            raise KeyboardInterrupt

    monkeypatch.delitem(sys.modules, "rosmini.tools.main")
    monkeypatch.setattr(sys, "meta_path", [Interrupted])
    status = entry.main()
    assert status == 130
    assert capsys.readouterr().err == "\n"
