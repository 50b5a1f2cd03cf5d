"""A notebook without a kernel: a shell of IPython in this process, and what its cells print."""

import re

import pytest
from IPython.core.interactiveshell import InteractiveShell

from rosmini.notebook import extension
from rosmini.notebook.session import session_of

NOISE = re.compile(r"\x1b\[[0-9;]*m|Out\[\d+\]: ")
"""Colours, and the label that a plain shell writes before a result that shows nothing."""


class Notebook:
    """Cells of a shell, and what they print."""

    def __init__(self, shell, capsys):
        self.shell = shell
        self._capsys = capsys

    @property
    def session(self):
        return session_of(self.shell)

    def run(self, cell):
        """Run a cell; return what it raised, and what it wrote to both streams."""
        self._capsys.readouterr()
        result = self.shell.run_cell(cell, store_history=True)
        out, err = self._capsys.readouterr()
        return result.error_before_exec or result.error_in_exec, NOISE.sub("", out + err)

    def ok(self, cell):
        """Run a cell that must not raise; return what it wrote."""
        error, written = self.run(cell)
        assert error is None, written
        return written

    def fails(self, cell):
        """Run a cell that must raise; return what it wrote, the error included."""
        error, written = self.run(cell)
        assert error is not None, written
        return written


@pytest.fixture
def shell():
    InteractiveShell.clear_instance()
    made = InteractiveShell.instance()
    yield made
    extension.unload(made)
    InteractiveShell.clear_instance()


@pytest.fixture
def notebook(shell, capsys):
    """A notebook after its first line."""
    made = Notebook(shell, capsys)
    made.ok("%load_ext rosmini")
    return made
