"""What a test leaves behind in the process is noticed when it ends."""

from __future__ import annotations

import importlib.util
import logging
import sys

import pytest

import rosmini

from ..conftest import nothing_left


def leave_a_variable(patch, folder):
    patch.setenv("ROSMINI_LEFT", "1")


def go_elsewhere(patch, folder):
    patch.chdir(folder)


def lengthen_the_path(patch, folder):
    patch.syspath_prepend(folder)


def leave_arguments(patch, folder):
    patch.setattr(sys, "argv", ["left"])


def leave_a_handler(patch, folder):
    patch.setattr(logging.root, "handlers", [*logging.root.handlers, logging.NullHandler()])


def leave_a_module(patch, folder):
    (folder / "left.py").write_text("", encoding="utf-8")
    module = importlib.util.module_from_spec(importlib.util.spec_from_file_location("left", folder / "left.py"))
    patch.setitem(sys.modules, "left", module)


@pytest.mark.parametrize(
    ("leave", "said"),
    [
        (leave_a_variable, "the environment: .*ROSMINI_LEFT"),
        (go_elsewhere, "the working directory"),
        (lengthen_the_path, "sys.path"),
        (leave_arguments, "sys.argv"),
        (leave_a_handler, "the root logger's handlers"),
        (leave_a_module, "sys.modules: left of .*left.py"),
    ],
)
def test_what_is_left_is_said(leave, said, tmp_path):
    with pytest.MonkeyPatch.context() as patch, pytest.raises(AssertionError, match=said), nothing_left(tmp_path):
        leave(patch, tmp_path)


def test_a_limit_that_is_left_is_said(tmp_path):
    limit = sys.getrecursionlimit()
    try:
        with pytest.raises(AssertionError, match="recursion limit: "), nothing_left(tmp_path):
            sys.setrecursionlimit(limit + 1)
    finally:
        sys.setrecursionlimit(limit)


def test_a_node_in_the_default_graph_is_said(tmp_path):
    with rosmini.Graph() as graph:
        before = rosmini.set_default_graph(graph)
        try:
            with pytest.raises(AssertionError, match=r"default graph: \[\] is now .*/left"), nothing_left(tmp_path):
                graph.node("left")
        finally:
            rosmini.set_default_graph(before)


def test_nothing_left_is_nothing_said(tmp_path):
    with nothing_left(tmp_path), pytest.MonkeyPatch.context() as patch:
        for leave in (leave_a_variable, go_elsewhere, leave_arguments, leave_a_handler, leave_a_module):
            leave(patch, tmp_path)
