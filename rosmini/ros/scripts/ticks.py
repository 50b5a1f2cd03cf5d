"""Ticks in polling loops: a call at the top of each turn, so that other nodes run and time advances.

Public scripts wait in loops that never block (``while not got: pass``, ``while distance < goal: pub.publish(v)``). On
a real robot other threads run meanwhile; here everything shares one thread, so the loader inserts a call of
``__tick__()`` as the first statement of each ``while`` and ``for`` body. Line numbers, tracebacks, docstrings and
``from __future__`` imports are unchanged, and so are ``async`` functions, whose loops yield with
``await``. A ``while`` loop whose body does nothing only waits for other lanes, and is marked by ``is_idle=True``.
"""

from __future__ import annotations

import ast

TICK = "__tick__"
"""Name of the called function in the scripts' builtins."""


def _does_nothing(statement: ast.stmt) -> bool:
    """Return True if a statement of a loop's body changes nothing, apart from calls in its conditions."""
    if isinstance(statement, ast.If):
        return not _assigns(statement.test) and all(map(_does_nothing, (*statement.body, *statement.orelse)))
    if isinstance(statement, ast.Expr):
        return isinstance(statement.value, ast.Constant)
    return isinstance(statement, (ast.Pass, ast.Continue, ast.Break))


def _assigns(test: ast.expr) -> bool:
    return any(isinstance(part, ast.NamedExpr) for part in ast.walk(test))


class _TickInserter(ast.NodeTransformer):
    """Adds the call to the bodies of loops."""

    def visit_While(self, node: ast.While) -> ast.AST:
        return self._loop(node)

    def visit_For(self, node: ast.For) -> ast.AST:
        return self._loop(node)

    def visit_AsyncFunctionDef(self, node: ast.AsyncFunctionDef) -> ast.AST:
        return node

    def _loop(self, node: ast.While | ast.For) -> ast.AST:
        is_idle = isinstance(node, ast.While) and not _assigns(node.test) and all(map(_does_nothing, node.body))
        self.generic_visit(node)
        keywords = [ast.keyword("is_idle", ast.Constant(True))] if is_idle else []
        call = ast.Expr(ast.Call(ast.Name(TICK, ast.Load()), [], keywords))
        # The loop's own line: a script that is ended while polling shows `while ...`, not its first statement.
        place = node.test if isinstance(node, ast.While) else node.target
        for part in ast.walk(call):
            ast.copy_location(part, place)
        node.body.insert(0, call)
        return node


def with_ticks(tree: ast.Module) -> ast.Module:
    """Insert the ticks into ``tree`` in place and return it, ready for :func:`compile`."""
    _TickInserter().visit(tree)
    return tree
