"""No two files import each other at run time, however indirectly, be it in functions."""

from __future__ import annotations

from typing import Any

from ..conftest import tool

grimp = tool("grimp")


def circles(graph: Any) -> set[frozenset[str]]:
    """The largest sets of modules in which each imports each, directly or through the others."""
    found = set()
    for module in graph.modules:
        circle = graph.find_upstream_modules(module) & graph.find_downstream_modules(module)
        if circle:
            found.add(frozenset({module, *circle}))
    return found


def test_circles_are_found():
    graph = grimp.ImportGraph()
    for importer, imported in ("ab", "bc", "ca", "cd", "ef", "fe"):
        graph.add_import(importer=importer, imported=imported)
    assert circles(graph) == {frozenset("abc"), frozenset("ef")}


def test_no_file_is_in_a_circle():
    found = circles(grimp.build_graph("rosmini", cache_dir=None, exclude_type_checking_imports=True))
    assert sorted(map(sorted, found)) == [], "let both import what they share from a third file"
