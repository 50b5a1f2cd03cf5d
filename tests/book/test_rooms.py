"""The rooms of the library in README and design page: drawn from the contracts and the code, and never stale."""

from __future__ import annotations

from pathlib import Path

import pytest

from book.tools import rooms

ROOT = Path(__file__).resolve().parents[2]
CONTRACTS = """
[[tool.importlinter.contracts]]
name = "core imports no other room"
type = "forbidden"
source_modules = ["rosmini.core", "rosmini.msgs"]
forbidden_modules = ["rosmini.sim", "rosmini.viz", "rosmini.book"]

[[tool.importlinter.contracts]]
name = "sim imports core"
type = "forbidden"
source_modules = ["rosmini.sim"]
forbidden_modules = ["rosmini.viz", "rosmini.book"]

[[tool.importlinter.contracts]]
name = "independent"
type = "independence"
modules = ["rosmini.viz", "rosmini.book"]
"""


@pytest.mark.parametrize("page", rooms.PAGES)
def test_a_page_is_up_to_date(page):
    text = (ROOT / page).read_text(encoding="utf-8")
    assert "by book.tools.rooms -->" in text
    assert rooms.updated(text) == text, "run `uv run python -m book.tools.rooms`"


def test_a_room_imports_what_its_contract_leaves():
    arrows = rooms.imports(CONTRACTS)
    assert arrows == {"core": [], "sim": ["core"], "viz": ["core", "sim"], "book": ["core", "sim"]}
    assert rooms.rows(arrows) == [["viz", "book"], ["sim"], ["core"]]


def test_the_kernel_is_small():
    modules = rooms.kernel(ROOT)
    assert all(module.is_file() for module in modules)
    assert len(modules) <= 16
    assert sum(map(rooms.code_lines, modules)) <= 5000


def test_blank_lines_comments_and_docstrings_do_not_count(tmp_path):
    source = '"""A module."""\n\n# a comment\nx = 1\n"""A number."""\n\ndef f():\n    """Return 1."""\n    return x\n'
    (tmp_path / "module.py").write_text(source, encoding="utf-8")
    assert rooms.code_lines(tmp_path) == 3


@pytest.mark.parametrize(
    ("size", "before", "shown"),
    [(1240, None, 1000), (1260, None, 1500), (1499, 1000, 1000), (1500, 1000, 1500), (501, 1000, 1000)],
)
def test_a_size_changes_only_when_it_is_500_lines_off(size, before, shown):
    assert rooms.rounded(size, before) == shown
