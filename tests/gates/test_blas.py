"""What steers a robot or draws a picture calls no BLAS or LAPACK, and no power of numpy's but the square and the root.

Their last bit depends on the processor. Use the products, inverses and eigenvectors of
`rosmini.core.geometry.products`. A line may give a reason why it may: `# BLAS: the numbers are integers`.
"""

from __future__ import annotations

import ast
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[2]
FOLDERS = (
    "assets/generate/meshes",
    *(f"rosmini/{name}" for name in ("core/geometry", "core/maps", "core/tf", "navigation", "sim", "viz")),
)
NAMES = {"convolve", "correlate", "dot", "einsum", "inner", "linalg", "matmul", "tensordot", "vdot", "vecdot"}
"""Functions of numpy that call BLAS, and the module that calls LAPACK."""
REASON = "# BLAS: "


def sources() -> list[Path]:
    """The files that the rule is for."""
    assert all((ROOT / folder).is_dir() for folder in FOLDERS)
    return [path for folder in FOLDERS for path in sorted((ROOT / folder).rglob("*.py"))]


def depends_on_processor(node: ast.AST) -> bool:
    """Whether an expression or import uses something whose last bit depends on the processor."""
    match node:
        case ast.BinOp(op=ast.MatMult()) | ast.AugAssign(op=ast.MatMult()):
            return True
        case ast.BinOp(ast.Constant(), ast.Pow(), _):
            return False
        case ast.BinOp(_, ast.Pow(), ast.Constant(exponent)):
            return exponent not in (2, 0.5)
        case ast.Attribute(_, "linalg"):
            return True
        case ast.Call(ast.Attribute(_, name)) | ast.Attribute(ast.Name("np" | "numpy"), name):
            return name in NAMES
        case ast.ImportFrom(module, names):
            return module == "numpy.linalg" or (module == "numpy" and any(each.name in NAMES for each in names))
    return False


def findings(text: str) -> list[int]:
    """The lines that depend on the processor and give no reason."""
    tree, lines = ast.parse(text), text.splitlines()
    errors = {
        id(node.value) for node in ast.walk(tree) if isinstance(node, ast.Attribute) and node.attr == "LinAlgError"
    }
    found = {
        node.lineno
        for node in ast.walk(tree)
        if isinstance(node, (ast.expr, ast.stmt)) and id(node) not in errors and depends_on_processor(node)
    }
    return sorted(line for line in found if not lines[line - 1].partition(REASON)[2].strip())


@pytest.mark.parametrize(
    "line",
    [
        "c = a @ b",
        "a @= b",
        "c = a.dot(b)",
        "c = np.einsum('ij,ij->i', a, b)",
        "c = np.linalg.inv(a)",
        "from numpy import dot",
        "from numpy.linalg import inv",
        "c = a**3",
        "c = a @ b  # BLAS: ",
    ],
)
def test_the_rule_finds(line: str) -> None:
    assert findings(line) == [1]


@pytest.mark.parametrize(
    "line",
    [
        "c = (a * b).sum(axis=1)",
        "c = a**2 + b**0.5 + 2**20",
        "raise np.linalg.LinAlgError('singular')",
        "from numpy.typing import NDArray",
        "c = a @ b  # BLAS: the numbers are integers",
    ],
)
def test_the_rule_allows(line: str) -> None:
    assert findings(line) == []


def test_no_value_depends_on_the_processor() -> None:
    paths = sources()
    assert len(paths) > 100
    found = {str(path.relative_to(ROOT)): findings(path.read_text(encoding="utf-8")) for path in paths}
    assert {name: lines for name, lines in found.items() if lines} == {}
