"""When loops are compiled, and what a terminal shows meanwhile."""

import io
import sys

import pytest

from rosmini.core.geometry.machine_code import Deferral, progress


class Screen(io.StringIO):
    """A terminal, or a file."""

    def __init__(self, terminal):
        super().__init__()
        self.isatty = lambda: terminal


@pytest.fixture
def start(monkeypatch):
    """A process that has done nothing yet."""
    monkeypatch.setattr(Deferral, "total", 0)
    monkeypatch.setitem(sys.modules, "numba", None)
    monkeypatch.delitem(sys.modules, "numba")


@pytest.mark.parametrize("terminal", [True, False])
def test_only_a_terminal_shows_progress(terminal, monkeypatch):
    screen = Screen(terminal)
    monkeypatch.setattr(sys, "__stderr__", screen)
    with progress("compiling wave"):
        assert ("compiling wave" in screen.getvalue()) == terminal
    assert screen.getvalue().rpartition("\r")[2] == ""
