"""The generator that the statements of a ``.cfg`` file call: it only records the calls.

Names, arguments and checks are those of dynamic_reconfigure's ``ParameterGenerator``
(http://wiki.ros.org/dynamic_reconfigure/Tutorials/HowToWriteYourFirstCfgFile).
"""

from __future__ import annotations

import math
import re
from collections.abc import Callable
from dataclasses import replace
from typing import Any

from rosmini.core.dynamic_reconfigure.description import KINDS, cast_value, filled_parameter
from rosmini.core.expressions import Budget, Function, Namespace

MAX_ITEMS = 2000
"""Maximum number of parameters, groups and constants in a file."""

MAX_DEPTH = 20
"""Maximum nesting depth of groups."""

_NAME = re.compile(r"[a-zA-Z][a-zA-Z0-9_]*\Z")
_CPP = {"str": "std::string", "int": "int", "double": "double", "bool": "bool"}
_CPP_CONSTANTS = {**{kind: f"const {name}" for kind, name in _CPP.items()}, "str": "const char * const"}


class Generator:
    """The recorded contents of a file. Calls raise ``ValueError``, ``TypeError`` or ``RosminiError``."""

    def __init__(self, file: str, budget: Budget) -> None:
        self.file = file
        self.line = 0
        """The line of the current statement."""
        self.constants: list[dict[str, Any]] = []
        self.notes: list[tuple[str, int]] = []
        """Warnings, each with its line."""
        self.generated: tuple[str, int] | None = None
        """The name passed to ``generate``, and its line."""
        self._budget = budget
        self._seen: dict[tuple[str, str], int] = {}
        self.tree = self._group("Default", "", state=True, parent=0)

    def namespace(self) -> Namespace:
        """Return the result of ``ParameterGenerator()``."""
        members = self._members(self.tree, 0)
        calls: dict[str, Callable[..., Any]] = {"const": self._const, "enum": self._enum, "generate": self._generate}
        members |= {name: Function(f"gen.{name}", call) for name, call in calls.items()}
        return Namespace("gen", members)

    def _members(self, tree: dict[str, Any], depth: int) -> dict[str, Any]:
        """Return the methods of a group."""

        def add(
            name: str,
            paramtype: str,
            level: int,
            description: str,
            default: Any = None,
            min: Any = None,
            max: Any = None,
            edit_method: str = "",
        ) -> None:
            tree["parameters"].append(
                self._parameter(name, paramtype, level, description, (default, min, max), edit_method)
            )

        def add_group(name: str, type: str = "", state: bool = True) -> Namespace:
            if depth == MAX_DEPTH:
                raise ValueError(f"groups are nested deeper than {MAX_DEPTH}")
            _texts("a group", name=name, type=type)
            inner = self._group(name.replace(" ", "_"), type, state=bool(state), parent=tree["id"])
            tree["groups"].append(inner)
            return Namespace(inner["name"], self._members(inner, depth + 1))

        return {"add": Function("add", add), "add_group": Function("add_group", add_group)}

    def _group(self, name: str, type: str, *, state: bool, parent: int) -> dict[str, Any]:
        self._budget.spend(len(name) + len(type))
        self._note("group", name)
        made = {"name": name, "type": type, "state": state, "cstate": "true" if state else "false"}
        number = sum(what == "group" for what, _ in self._seen) - 1
        return {**made, "id": number, "parent": parent, "parameters": [], "groups": [], **self._place()}

    def _parameter(
        self, name: Any, kind: Any, level: Any, description: Any, limits: tuple[Any, Any, Any], edit_method: Any
    ) -> dict[str, Any]:
        _check_name("parameter", name)
        _texts(f"the parameter {name}", type=kind, description=description, edit_method=edit_method)
        self._budget.spend(sum(len(each) for each in (*limits, description, edit_method) if isinstance(each, str)))
        if name == "groups":
            raise ValueError("a parameter cannot be named groups: configurations have their groups there")
        if type(level) is not int or not 0 <= level < 2**32:
            raise ValueError(f"the level of {name} is a number of 32 bits, not {level!r}")
        if kind in ("str", "bool") and limits[1:] != (None, None):
            raise ValueError(f"{name} is a {kind}_t, which has no minimum and no maximum")
        if any(isinstance(value, float) and math.isnan(value) for value in limits):
            raise ValueError(f"a value of {name} is not a number (nan)")
        made = filled_parameter(name, kind, level, description, *limits, edit_method=edit_method)
        self._note("parameter", name)
        if kind in ("int", "double") and made.min > made.max:
            raise ValueError(f"the minimum of {name}, {made.min!r}, is above its maximum, {made.max!r}")
        limited = made.clamp(made.default)
        if limited != made.default:
            note = f"the default of {name}, {made.default!r}, is not in its range, {made.min!r} ... {made.max!r}"
            self.notes.append((f"{note}: servers begin with {limited!r}", self.line))
            made = replace(made, default=limited)
        return {**made.as_dict(), **self._place(), **_cpp(kind)}

    def _const(self, name: str, type: str, value: Any, descr: str) -> dict[str, Any]:
        _check_name("constant", name)
        _texts(f"the constant {name}", type=type, description=descr)
        _check_quotes(descr)
        if type not in KINDS:
            raise ValueError(f"the constant {name} has the type {type!r}; types are {', '.join(KINDS)}")
        value = cast_value(name, type, value)
        self._budget.spend(len(descr) + len(str(value)))
        if value != value:  # noqa: PLR0124 (nan)
            raise ValueError(f"the constant {name} is not a number (nan)")
        self._note("constant", name)
        made = {"name": name, "type": type, "value": value, **self._place(), "description": descr}
        self.constants.append({**made, **_cpp(type)})
        return self.constants[-1]

    def _enum(self, constants: Any, description: str) -> str:
        if not isinstance(constants, list | tuple) or not constants:
            raise ValueError("gen.enum() takes a list of what gen.const() gives")
        known = {id(each) for each in self.constants}
        if not all(id(each) in known for each in constants):
            raise ValueError("gen.enum() takes a list of what gen.const() gives, and nothing else")
        if len({each["type"] for each in constants}) != 1:
            raise ValueError("the constants of an enumeration are of one type")
        _texts("an enumeration", description=description)
        _check_quotes(description)
        self._budget.room(sum(200 + len(each["name"]) + len(each["description"]) for each in constants))
        return repr({"enum": list(constants), "enum_description": description})

    def _generate(self, pkgname: str, nodename: str, name: str) -> int:
        _texts("generate()", package=pkgname, node=nodename, name=name)
        if self.generated is not None:
            raise ValueError(f"generate() was called before, in line {self.generated[1]}: a file makes one module")
        if not _NAME.match(name):
            raise ValueError(f"a module cannot be named {name!r}")
        self.generated = (name, self.line)
        return 0

    def _note(self, what: str, name: str) -> None:
        """Record a name. Raises ``ValueError`` if it is a duplicate, or if there are too many."""
        if (what, name) in self._seen:
            first = self._seen[what, name]
            raise ValueError(f"the {what} {name} already exists, in line {first}: give each a different name")
        self._seen[what, name] = self.line
        if len(self._seen) > MAX_ITEMS:
            raise ValueError(f"more than {MAX_ITEMS} parameters, groups and constants")

    def _place(self) -> dict[str, Any]:
        return {"srcline": self.line, "srcfile": self.file}


def _cpp(kind: str) -> dict[str, str]:
    """Return the C++ type names, which generated modules contain."""
    return {"ctype": _CPP[kind], "cconsttype": _CPP_CONSTANTS[kind]}


def _texts(of: str, **values: Any) -> None:
    for what, value in values.items():
        if not isinstance(value, str):
            raise TypeError(f"the {what} of {of} is a text, not {value!r}"[:200])


def _check_name(what: str, name: Any) -> None:
    if not isinstance(name, str) or not _NAME.match(name):
        rule = "begins with a letter, and has letters, digits and underscores"
        raise ValueError(f"the name of a {what} {rule}; this is {name!r}"[:200])


def _check_quotes(description: str) -> None:
    """Refuse quotes as the real generator does: a file that contains them works on no robot."""
    if '"' in description or "'" in description:
        raise ValueError(f"the description of a constant or enumeration cannot have quotes: {description}"[:200])
