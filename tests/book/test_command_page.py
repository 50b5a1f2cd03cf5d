"""The page on commands names every command that there is, its verbs, and which are line magics."""

from __future__ import annotations

import re
from pathlib import Path

from rosmini.cli.main import COMMANDS

ROWS = [
    line.split("|")[1:-1]
    for line in (Path(__file__).parents[2] / "book" / "commands.md").read_text(encoding="utf-8").splitlines()
    if line.startswith("|") and "`rosmini " in line
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
            tool = getattr(COMMANDS[name].load(), "TOOL", None) if name else None
            if tool is not None and not tool.only_verb and verb and verb.islower():
                assert verb in tool.verbs, f"{name} {verb}"
                checked += 1
    assert checked > 40
