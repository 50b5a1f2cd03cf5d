"""Reading ``.cfg`` files: http://wiki.ros.org/dynamic_reconfigure/Tutorials/HowToWriteYourFirstCfgFile.

In ROS such a file is a Python program. Here it is parsed and never run: only certain statements are accepted, and their
expressions and calls are evaluated by :mod:`rosmini.core.expressions`, which allows only listed operations.
"""

from __future__ import annotations

import ast
import warnings
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from rosmini.core import files
from rosmini.core.dynamic_reconfigure.description import KINDS, Description
from rosmini.core.errors import DefinitionError, RosminiError
from rosmini.core.expressions import (
    FUNCTIONS,
    MATH,
    STEPS_OF_A_FILE,
    Budget,
    Expression,
    ExpressionError,
    Function,
    Namespace,
    NotAllowed,
)

from .cfg_generator import Generator

MAX_BYTES = 1_000_000
"""Maximum size of a ``.cfg`` file [bytes]."""

MAX_STATEMENTS = 10_000

UNDERSTOOD = (
    "a .cfg file is read and not run: what is understood is imports of dynamic_reconfigure and math, assignments, "
    "arithmetic, lists, gen.add(), gen.const(), gen.enum(), gen.add_group() and exit(gen.generate(...))"
)

_TYPES = {f"{kind}_t": kind for kind in KINDS}
_SENSOR_LEVELS = Namespace("SensorLevels", {"RECONFIGURE_CLOSE": 3, "RECONFIGURE_STOP": 1, "RECONFIGURE_RUNNING": 0})


@dataclass(frozen=True)
class CfgFile:
    """The contents of a ``.cfg`` file.

    Attributes:
        name: the name of the module, without ``Config``.
        line: the line that sets the name.
        tree: the groups and parameters, in the form of ``config_description`` in generated modules.
        constants: the values of the constants, by name.
        notes: warnings, each with its line.

    """

    name: str
    line: int
    tree: dict[str, Any]
    constants: dict[str, Any]
    notes: list[tuple[str, int]]


def read_cfg(path: Path) -> CfgFile:
    """Read a ``.cfg`` file. Raises `DefinitionError`, with the line, for anything wrong or unsupported."""
    try:
        data = files.read(path, MAX_BYTES)
        with warnings.catch_warnings():  # invalid escapes such as "\d"
            warnings.simplefilter("ignore")
            statements = ast.parse(data, str(path)).body
    except OSError as error:
        raise DefinitionError(f"cannot be read: {error.strerror}", path) from error
    except (SyntaxError, ValueError, RecursionError, MemoryError) as error:
        line = error.lineno if isinstance(error, SyntaxError) else None
        why = error.msg if isinstance(error, SyntaxError) else str(error) or "it is nested too deep"
        raise DefinitionError(f"this is not Python 3: {why}", path, line) from error
    if len(statements) > MAX_STATEMENTS:
        raise DefinitionError(f"more than {MAX_STATEMENTS} statements", path)
    reader = _Reader(path)
    for statement in statements:
        try:
            reader.read(statement)
        except NotAllowed as error:
            raise DefinitionError(f"{error}; {UNDERSTOOD}", path, statement.lineno) from error
        except RosminiError as error:
            raise DefinitionError(str(error), path, statement.lineno) from error
        except RecursionError as error:
            raise DefinitionError("this is nested too deep", path, statement.lineno) from error
        if reader.ended:
            break
    return reader.result()


class _Reader:
    """Interprets one statement after another."""

    def __init__(self, path: Path) -> None:
        self._path = path
        self._budget = Budget(STEPS_OF_A_FILE)
        self._generator = Generator(path.name, self._budget)
        self._made = False
        self.ended = False
        """True once the file has called ``exit``."""
        self._names: dict[str, Any] = {}
        self._functions: dict[str, Any] = {**FUNCTIONS, "exit": Function("exit", self._exit)}
        self._functions["quit"] = self._functions["exit"]
        generators = {"ParameterGenerator": Function("ParameterGenerator", self._make_generator), **_TYPES}
        levels = {"SensorLevels": _SENSOR_LEVELS}
        self._modules: dict[str, dict[str, Any]] = {
            "math": dict(MATH),
            "sys": {"exit": self._functions["exit"]},
            "roslib": {"load_manifest": Function("load_manifest", lambda _: None)},
            "__future__": dict.fromkeys(("print_function", "division", "absolute_import", "unicode_literals")),
            "dynamic_reconfigure.parameter_generator": generators,
            "dynamic_reconfigure.parameter_generator_catkin": generators,
            "dynamic_reconfigure.msg": levels,
            "driver_base.msg": levels,
        }

    def read(self, statement: ast.stmt) -> None:
        """Execute one statement. Raises `NotAllowed` if it is not supported, and the errors of the calls in it."""
        self._generator.line = statement.lineno
        match statement:
            case ast.Import(names=names):
                for each in names:
                    if "." in each.name or each.name not in self._modules:
                        raise NotAllowed(f"import {each.name} is not understood")
                    self._bind(each.asname or each.name, Namespace(each.name, self._modules[each.name]))
            case ast.ImportFrom(module=str(module), names=names, level=0) if module in self._modules:
                self._import_from(module, names)
            case ast.ImportFrom(module=module):
                raise NotAllowed(f"from {module or '.'} import ... is not understood")
            case ast.Assign(targets=[ast.Name(id=name)], value=value):
                self._bind(name, self._value(value))
            case ast.Expr(value=value):
                self._value(value)
            case _:
                words = (ast.unparse(statement).splitlines() or [""])[0][:60]
                raise NotAllowed(f"the statement `{words}` is not understood")

    def result(self) -> CfgFile:
        """Return the result. Raises `DefinitionError` if the file never calls ``generate``."""
        made = self._generator
        if made.generated is None:
            raise DefinitionError(
                'the file makes nothing: exit(gen.generate(PACKAGE, "node_name", "Name")) is missing at its end',
                self._path,
            )
        name, line = made.generated
        try:
            Description.of(made.tree)
        except RosminiError as error:
            raise DefinitionError(str(error), self._path, line) from error
        constants = {each["name"]: each["value"] for each in made.constants}
        return CfgFile(name, line, made.tree, constants, made.notes)

    def _import_from(self, module: str, names: list[ast.alias]) -> None:
        there = self._modules[module]
        for each in names:
            if each.name == "*":
                for name, value in there.items():
                    self._bind(name, value)
            elif each.name not in there:
                raise NotAllowed(f"from {module} import {each.name} is not understood")
            elif module != "__future__":
                self._bind(each.asname or each.name, there[each.name])

    def _bind(self, name: str, value: Any) -> None:
        (self._functions if isinstance(value, Function) else self._names)[name] = value
        (self._names if isinstance(value, Function) else self._functions).pop(name, None)

    def _value(self, node: ast.expr) -> Any:
        text = ast.unparse(node)
        self._budget.earn(len(text))
        expression = Expression(text, names=self._names, functions=self._functions)
        return expression.evaluate(self._names, self._budget)

    def _make_generator(self) -> Namespace:
        if self._made:
            raise ExpressionError("a second ParameterGenerator(): a file has one")
        self._made = True
        return self._generator.namespace()

    def _exit(self, _status: object = None) -> None:
        self.ended = True
