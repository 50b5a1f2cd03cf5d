"""Bare names in shells: real bash and zsh run the lines."""

from __future__ import annotations

import os
import select
import shutil
import sys
from contextlib import ExitStack
from pathlib import Path
from typing import Any

import pytest

import rosmini.tools.main as cli
from rosmini.tools import aliases

from ..processes import free_port, run, start, wait_until

bash = pytest.mark.skipif(shutil.which("bash") is None or sys.platform == "win32", reason="there is no bash")


@pytest.fixture
def shell(tmp_path: Path) -> Any:
    """Runs lines in a bash that knows the bare names, and nothing of a real ROS."""
    lines = tmp_path / "aliases.sh"
    lines.write_text(aliases.lines("bash", [sys.executable, "-m", "rosmini"]), encoding="utf-8")
    env = {
        "PATH": str(tmp_path / "bin"), "HOME": str(tmp_path), "ROS_MASTER_URI": f"http://127.0.0.1:{free_port()}",
        "ROS_PACKAGE_PATH": str(tmp_path),
    }  # fmt: skip
    (tmp_path / "bin").mkdir()
    found = shutil.which("bash")
    return lambda text: run([found, "--norc", "-c", f'. "{lines}"\n{text}'], env=env, cwd=os.getcwd())


@bash
def test_the_bare_names_work_in_bash(shell: Any) -> None:
    done = shell("rosmsg show std_msgs/String; rosnode list; echo status $?")
    assert done.stdout == "string data\n\nstatus 1\n"
    assert "rosmini roscore" in done.stderr
    assert shell("rosmsg md5 'std_msgs/Nothing like it'").stderr.startswith("Cannot locate [std_msgs/Nothing like it]")


@bash
def test_what_the_shell_knows_already_is_left_alone(shell: Any, tmp_path: Path) -> None:
    real = tmp_path / "bin" / "rostopic"
    real.write_text("#!/bin/sh\necho the real one\n", encoding="utf-8")
    real.chmod(0o755)
    assert shell("rostopic; type -t rostopic rosmsg").stdout == "the real one\nfile\nfunction\n"


@bash
def test_words_are_completed_in_bash(shell: Any) -> None:
    done = shell(
        'COMP_WORDS=(rosmsg show geometry_msgs/PoseStam); COMP_CWORD=2; _rosmini_complete; echo "${COMPREPLY[@]}"\n'
        'COMP_WORDS=(rosmini rosnode ""); COMP_CWORD=2; _rosmini_complete; echo "${COMPREPLY[@]}"\n'
        'COMP_WORDS=(rosnode info ""); COMP_CWORD=2; _rosmini_complete; echo "${#COMPREPLY[@]}"\ncomplete -p rosmsg'
    )
    first, second, third, fourth = done.stdout.splitlines()
    assert (first, third) == ("geometry_msgs/PoseStamped", "0")
    assert second == "cleanup info kill list machine ping"
    assert "_rosmini_complete rosmsg" in fourth
    assert done.stderr == ""


class Typist:
    """Somebody who types in an interactive zsh, as in a terminal, and reads what it shows."""

    def __init__(self, words: list[str], env: dict[str, str], stack: ExitStack) -> None:
        import pty  # POSIX has it

        self._terminal, inner = pty.openpty()
        stack.callback(os.close, self._terminal)
        self._zsh = stack.enter_context(start(words, env=env, stdin=inner, stdout=inner, stderr=inner))
        os.close(inner)
        self._shown = ""

    def type(self, keys: str, *, until: str) -> str:
        """Type keys, wait until the terminal shows a text, and return all that it showed meanwhile."""
        os.write(self._terminal, keys.encode())
        wait_until(lambda: until in self._read(), until, self._zsh)
        shown, self._shown = self._shown, ""
        return shown

    def _read(self) -> str:
        while select.select([self._terminal], [], [], 0)[0]:
            self._shown += os.read(self._terminal, 4096).decode("utf-8", "replace")
        return self._shown


def test_names_and_completion_in_zsh(zsh: str, tmp_path: Path) -> None:
    """Tab is pressed in a real zsh with its line editor, since its completion works nowhere else."""
    lines = aliases.lines("zsh", [sys.executable, "-m", "rosmini"])
    (tmp_path / ".zshrc").write_text(f"PS1='ready> '\n{lines}", encoding="utf-8")
    env = {
        "PATH": str(tmp_path), "HOME": str(tmp_path), "ZDOTDIR": str(tmp_path), "TERM": "dumb",
        "ROS_MASTER_URI": f"http://127.0.0.1:{free_port()}", "ROS_PACKAGE_PATH": str(tmp_path),
    }  # fmt: skip
    with ExitStack() as stack:
        typist = Typist([zsh, "--no-global-rcs", "-i"], env, stack)
        typist.type("", until="ready> ")
        typist.type("rosmsg md5 std_msgs/Stri\t", until="std_msgs/String")
        assert "992ce8a1687cec8c8bd883ec73ca41d1" in typist.type("\n", until="ready> ")
        typist.type("rosmini rosno\t", until="rosnode")
        typist.type("\x15rosnode li\t", until="list")
        assert "Unable to communicate with master" in typist.type("\n", until="ready> ")


@bash
def test_roscd_changes_the_folder(shell: Any, tmp_path: Path) -> None:
    package = tmp_path / "my_pkg"
    package.mkdir()
    (package / "package.xml").write_text(
        '<package format="2"><name>my_pkg</name><version>1.0.0</version><description>d</description>'
        '<maintainer email="a@b.cc">m</maintainer><license>l</license></package>', encoding="utf-8",
    )  # fmt: skip
    done = shell("roscd my_pkg && pwd; roscd no_such_package; echo $?; pwd")
    assert done.stdout.splitlines() == [str(package), "1", str(package)]


def test_each_shell_has_its_lines(capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch) -> None:
    for name in aliases.SHELLS:
        assert cli.main(["aliases", name]) == 0
        said = capsys.readouterr().out
        assert all(f"{command}" in said for command in ("rostopic", "rosservice", "rosparam", "roscore"))
        assert "rosmini_bench" not in said
        assert "{" in said and "{{" not in said.replace("${{", "")
    monkeypatch.setenv("SHELL", "/usr/bin/zsh")
    assert cli.main(["aliases"]) == 0
    assert "compdef _rosmini_complete rostopic" in capsys.readouterr().out
    with pytest.raises(SystemExit):
        cli.main(["aliases", "tcsh"])


def test_the_commands_of_an_installed_ros_are_named(
    capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(aliases.shutil, "which", {"roslaunch": "/usr/bin/roslaunch"}.get)
    assert cli.main(["aliases", "bash"]) == 0
    said = capsys.readouterr()
    assert "roslaunch" in said.err and "rostopic" not in said.err
    assert "`rosmini roslaunch`" in said.err
    assert "installed" not in said.out
    monkeypatch.setattr(aliases.shutil, "which", lambda name: None)
    assert cli.main(["aliases", "bash"]) == 0
    assert capsys.readouterr().err == ""


def test_only_names_of_ros_are_given() -> None:
    assert {"rostopic", "roscd", "roslaunch", "rosbag"} <= set(aliases.names())
    assert not {"test", "run", "world", "lab", "bench", "aliases", "gz", "mcap"} & set(aliases.names())


def test_program_paths_are_quoted() -> None:
    assert "'/a b/rosmini' rostopic \"$@\"" in aliases.lines("bash", ["/a b/rosmini"])
    assert "& '/it''s/rosmini' rostopic @args" in aliases.lines("powershell", ["/it's/rosmini"])


def test_powershell_says_that_a_word_is_empty(
    monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    """Before 7.3 it gives programs no empty words: `rostopic <Tab>` would complete `rostopic` itself."""
    monkeypatch.setenv("ROS_MASTER_URI", "http://127.0.0.1:1")
    assert """$words += '""'""" in aliases.lines("powershell", ["rosmini"])
    assert cli.main(["aliases", "--complete", "rostopic", '""']) == 0
    assert "echo" in capsys.readouterr().out.split()
