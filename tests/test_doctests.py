"""The examples in docstrings do what they show."""

from __future__ import annotations

import doctest
import importlib
import pkgutil

import pytest

import rosmini

FINDER = doctest.DocTestFinder(exclude_empty=True)
WITHOUT = ("rosmini.__main__", "rosmini._assets", "rosmini.core.graph.promise_stacks", "rosmini.notebook.page")


def examples() -> list[doctest.DocTest]:
    """All docstrings of the library that hold an example."""
    names = ["rosmini", *(found.name for found in pkgutil.walk_packages(rosmini.__path__, "rosmini."))]
    modules = [importlib.import_module(name) for name in names if not name.startswith(WITHOUT)]
    return [test for module in modules for test in FINDER.find(module) if test.examples]


@pytest.mark.parametrize("example", examples(), ids=lambda example: example.name)
def test_an_example_does_what_it_shows(example: doctest.DocTest) -> None:
    problems: list[str] = []
    runner = doctest.DocTestRunner()
    runner.run(example, out=problems.append)
    assert not problems, "".join(problems)


def test_there_are_examples() -> None:
    assert any(example.name == "rosmini.core.graph.node" for example in examples())
