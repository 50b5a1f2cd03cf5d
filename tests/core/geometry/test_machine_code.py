"""When loops are compiled, and what a terminal shows meanwhile."""

import io
import sys

import pytest

from rosmini.core.geometry import machine_code
from rosmini.core.geometry.machine_code import Deferral, progress


class Screen(io.StringIO):
    """A terminal, or a file."""

    def __init__(self, terminal):
        super().__init__()
        self.isatty = lambda: terminal


@pytest.mark.parametrize("terminal", [True, False])
def test_only_a_terminal_shows_progress(terminal, monkeypatch):
    screen = Screen(terminal)
    monkeypatch.setattr(sys, "__stderr__", screen)
    with progress("compiling wave"):
        assert ("compiling wave" in screen.getvalue()) == terminal
    assert screen.getvalue().rpartition("\r")[2] == ""


def test_where_nothing_is_compiled_machine_code_is_used_at_once(monkeypatch):
    assert not Deferral().due(1)
    monkeypatch.setattr(machine_code, "COMPILES", False)
    assert Deferral().due(1)
