"""The examples in docstrings do what they show."""

from __future__ import annotations

import doctest
import importlib
from pathlib import Path

import pytest

FINDER = doctest.DocTestFinder(exclude_empty=True)
ROOT = Path(__file__).resolve().parents[1]


def examples() -> list[doctest.DocTest]:
    """All docstrings of the library that hold an example."""
    paths = [path for path in sorted((ROOT / "rosmini").rglob("*.py")) if ">>> " in path.read_text(encoding="utf-8")]
    names = [".".join(path.relative_to(ROOT).with_suffix("").parts).removesuffix(".__init__") for path in paths]
    return [test for name in names for test in FINDER.find(importlib.import_module(name)) if test.examples]


@pytest.mark.parametrize("example", examples(), ids=lambda example: example.name)
def test_an_example_does_what_it_shows(example: doctest.DocTest) -> None:
    problems: list[str] = []
    runner = doctest.DocTestRunner()
    runner.run(example, out=problems.append)
    assert not problems, "".join(problems)


def test_there_are_examples() -> None:
    assert any(example.name == "rosmini.core.graph.node" for example in examples())
