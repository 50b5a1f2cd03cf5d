"""The page on commands names every command that there is, its verbs, and which are line magics."""

from __future__ import annotations

import re
from pathlib import Path

import pytest

from rosmini.notebook import extension
from rosmini.tools.main import COMMANDS, main

PAGE = (Path(__file__).parents[2] / "book" / "commands.md").read_text(encoding="utf-8")
ROWS = [line.split("|")[1:-1] for line in PAGE.splitlines() if line.startswith("|") and "`rosmini " in line]
SHOWN = [
    command.split("\n", 1)
    for block in re.findall(r"```console\n(.*?)```", PAGE.replace("\\\n", ""), re.DOTALL)
    for command in block.split("$ rosmini ")[1:]
]


def test_every_command_is_on_the_page_with_a_star_if_it_is_a_magic() -> None:
    starred: dict[str, bool] = {}
    for _, commands, star in ROWS:
        for name in re.findall(r"`rosmini (\w+)", commands):
            starred[name] = star.strip() == "*"
    assert starred == {name: entry.is_magic for name, entry in COMMANDS.items()}


def test_the_verbs_on_the_page_are_there() -> None:
    checked = 0
    for _, commands, _ in ROWS:
        name = ""
        for first, verb in re.findall(r"`(?:rosmini (\w+)(?: |`))?(\w+)?[^`]*`?", commands):
            name = first or name
            tool = COMMANDS[name].tool() if name and COMMANDS[name].folder is None else None
            if tool is not None and not tool.only_verb and verb and verb.islower():
                assert verb in tool.verbs, f"{name} {verb}"
                checked += 1
    assert checked > 40


def test_commands_are_shown() -> None:
    assert len(SHOWN) >= 4


@pytest.mark.parametrize(("command", "output"), SHOWN)
def test_a_command_that_is_shown_prints_what_is_shown(
    command: str, output: str, capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.delenv("ROS_MASTER_URI", raising=False)
    assert main(command.split()) == 0
    assert capsys.readouterr().out.strip() == output.strip()


def test_what_a_notebook_has_alone_is_there(capsys: pytest.CaptureFixture[str]) -> None:
    from IPython.core.interactiveshell import InteractiveShell

    InteractiveShell.clear_instance()
    shell = InteractiveShell.instance()
    try:
        extension.load(shell)
        magics = shell.magics_manager.magics
        told = re.findall(r"`(%%?)(\w+)", PAGE.split("## In a notebook")[1])
        assert len(told) >= 9
        for mark, name in told:
            assert name in magics["cell" if mark == "%%" else "line"], name
    finally:
        extension.unload(shell)
        InteractiveShell.clear_instance()
    capsys.readouterr()
