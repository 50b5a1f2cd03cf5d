"""Limits of xacro: it may compute (see `rosmini.core.expressions`), read files of packages, and expand within bounds.

xacro passes ``${...}`` and ``$(eval ...)`` to Python's ``eval``, which a description can escape. These functions
replace xacro's own, under the names that its modules use.
"""

from __future__ import annotations

import glob
import re
from collections.abc import Callable, Iterable
from pathlib import Path
from types import SimpleNamespace
from typing import Any

from rosmini.core.errors import RosminiError, nearest
from rosmini.core.expressions import (
    FUNCTIONS,
    MATH,
    STEPS_OF_A_FILE,
    Budget,
    Expression,
    Function,
    Namespace,
    NotAllowed,
    no_fields,
)
from rosmini.core.files import read
from rosmini.core.yaml_text import Loader, documents

from .errors import UrdfError

STEPS = 1_000_000
"""Step budget of a file's expressions and expansion, increased by its length; see `Budget`."""

OF_A_TEXT = 5
"""Cost in steps of a text that may contain substitutions, such as the default of a parameter."""

MAX_PARAMETERS, MAX_PARAMETERS_LENGTH = 1000, 100_000
"""Maximum number of a macro's parameters, and of their characters."""

OF_AN_ELEMENT = 100
"""Cost in steps of expanding an element: a small file may have 10,000."""

OF_A_FILE = 5_000
"""Cost in steps of an included file, which may be empty: there may be 1,000."""

MAX_DEPTH = 40
"""Maximum nesting of includes."""

MAX_BYTES = 4_000_000
"""Maximum size of a YAML file [bytes]."""

GLOBALS = ("list", "dict", "map", "len", "str", "float", "int", "bool", "min", "max", "round", "sorted", "range")
"""Python's functions that do not need the prefix ``python.``."""

MACRO_ARGUMENT = re.compile(
    r"""^\s*([^\s:=]+?)\s*:?=\s*(\^\|?)?(\$\{.*?\}|\$\(.*?\)|(?:'[^']*'|"[^"]*"|[^\s'"])+|)(?:\s+|$)(.*)"""
)
"""A macro parameter with its default, as in xacro, without the quotes that cause exponential backtracking."""

UNITS: dict[str, float] = {
    "!radians": 1.0,
    "!degrees": MATH["pi"] / 180,
    "!meters": 1.0,
    "!millimeters": 0.001,
    "!foot": 0.3048,
    "!inches": 0.0254,
}
"""Values of units in YAML tags (https://github.com/ros/xacro/wiki)."""


class Confined:
    """The functions that replace xacro's for one file."""

    def __init__(self, xacro: Any, substitution: Any, file: Path, find: Callable[[str], str]) -> None:
        self._xacro, self._substitution, self._find = xacro, substitution, find
        self._folder = file.resolve().parent
        self._budget = Budget(STEPS)
        self._eval_all, self._eval_text = xacro.eval_all, xacro.eval_text
        self._eval_extension, self._grab_macro = xacro.eval_extension, xacro.grab_macro

    def for_xacro(self) -> dict[str, Any]:
        """Return the replacements for names in the module `xacro`."""
        return {
            "_global_symbols": self._symbols(),
            "eval_all": self._count_element,
            "eval_extension": lambda text: self._budget.made(self._eval_extension(text)),
            "eval_text": self._count_text,
            "grab_macro": self._check_macro,
            "glob": SimpleNamespace(glob=_glob),
            "re_macro_arg": MACRO_ARGUMENT,
            "safe_eval": self._evaluate,
        }

    def for_substitution(self) -> dict[str, Any]:
        """Return the replacements for names in the module `xacro.substitution_args`."""
        return {"_eval": self._evaluate_substitution}

    def opened(self, filename: str) -> None:
        """Count an included file. Raises `NotAllowed` for too many, or for files that include each other endlessly."""
        self._budget.spend(OF_A_FILE)
        self._budget.earn(Path(filename).stat().st_size)
        above = [Path(name).name for name in self._xacro.filestack]
        if len(above) > MAX_DEPTH:
            way = above[above.index(above[-1]) :]
            circle = way[: way.index(way[0], 1) + 1] if way[0] in way[1:] else way
            raise UrdfError(f"macros call or include one another without end: {' -> '.join(circle)}", filename)

    # ---- expressions ----

    def _evaluate(self, text: str, names: Any, _locals: Any = None) -> Any:
        return Expression(text, functions={}, fields=self._field).evaluate(names, self._budget)

    def _evaluate_substitution(self, text: str, context: dict[str, Any]) -> str:
        """Evaluate ``$(eval ...)``."""
        substitution, given = self._substitution, context.get("arg", {})
        names = {name: substitution.convert_value(value, "auto") for name, value in given.items()}
        functions: dict[str, Callable[..., Any]] = {
            "arg": lambda name: substitution.convert_value(given[name], "auto"),
            "dirname": lambda: substitution._eval_dirname(context.get("filename")),  # noqa: SLF001 (as xacro does)
            "env": substitution._eval_env,  # noqa: SLF001
            "find": self._find,
            "optenv": substitution._eval_optenv,  # noqa: SLF001
        }
        known = {name: FUNCTIONS[name] for name in ("dict", "float", "int", "list", "map", "str")}
        known |= {name: Function(name, function) for name, function in functions.items()}
        every = {**names, "true": True, "false": False, **MATH, **known}
        return str(Expression(text, functions={}, fields=self._field).evaluate(every, self._budget))

    def _field(self, value: Any, name: str) -> Any:
        """Return an entry of a dictionary from YAML, or a property of an included file with a namespace."""
        if not isinstance(value, self._xacro.YamlDictWrapper | self._xacro.NameSpace):
            return no_fields(value, name)
        if name not in value:
            hint = nearest(name, [key for key in value if isinstance(key, str)])
            raise AttributeError(f"there is no {name!r} in it{f'; {hint}' if hint else ''}")
        return value[name]

    def _symbols(self) -> dict[str, Any]:
        """Return the names available in every expression."""
        own: dict[str, Callable[..., Any]] = {
            "abs_filename": self._xacro.abs_filename_spec,
            "arg": lambda name: self._xacro.substitution_args_context["arg"][name],
            "dotify": self._xacro.YamlDictWrapper,
            "error": lambda *said: self._say("error", said),
            "fatal": self._fatal,
            "load_yaml": self._load_yaml,
            "message": lambda *said: self._say("message", said),
            "print_location": lambda: self._xacro.print_location() or "",
            "tokenize": _tokenize,
            "warning": lambda *said: self._say("warning", said),
        }
        functions = {name: Function(f"xacro.{name}", function) for name, function in own.items()}
        return {
            **MATH,
            **{name: FUNCTIONS[name] for name in GLOBALS},
            **{name: functions[name] for name in ("abs_filename", "dotify", "load_yaml")},
            "math": Namespace("math", MATH),
            "python": Namespace("python", FUNCTIONS),
            "xacro": Namespace("xacro", functions),
        }

    # ---- functions of xacro ----

    def _say(self, how: str, said: Iterable[Any]) -> str:
        getattr(self._xacro, how)(*(self._budget.made(each) for each in said))
        if how != "message":
            self._xacro.print_location()
        return ""

    def _fatal(self, *said: Any) -> None:
        raise RosminiError(" ".join(str(self._budget.made(each)) for each in said))

    def _load_yaml(self, name: str) -> Any:
        """Return the values of a YAML file in a package, or beside the description."""
        path = Path(self._xacro.abs_filename_spec(name)).resolve()
        if self._folder not in path.parents and not any((each / "package.xml").is_file() for each in path.parents):
            raise NotAllowed(f"{path} is neither in a package nor beside the description")
        self._budget.spend(OF_A_FILE)
        try:
            text = read(path, MAX_BYTES).decode("utf-8")
        except OSError as error:
            raise UrdfError(f"cannot be read: {error.strerror}", path) from error
        except UnicodeDecodeError as error:
            raise UrdfError(f"cannot be read: {error}", path) from error
        self._xacro.all_includes.append(str(path))
        value = next((found for found, _ in documents(text, str(path), UrdfError, _Yaml)), None)
        return self._xacro.YamlListWrapper.wrap(value)

    # ---- counting ----

    def _count_element(self, node: Any, macros: Any, symbols: Any) -> None:
        self._budget.spend(OF_AN_ELEMENT)
        self._eval_all(node, macros, symbols)

    def _check_macro(self, element: Any, macros: Any) -> None:
        parameters = element.getAttribute("params")
        if len(parameters) > MAX_PARAMETERS_LENGTH or len(parameters.split()) > MAX_PARAMETERS:
            raise NotAllowed(f"a macro with more than {MAX_PARAMETERS} parameters")
        self._grab_macro(element, macros)

    def _count_text(self, text: str, symbols: Any) -> Any:
        # xacro searches and copies the rest of a text at each part
        self._budget.spend(OF_A_TEXT + len(text) * text.count("$") // 500)
        found = self._eval_text(text, symbols)
        return self._budget.made(found) if isinstance(found, str) else found


class _Yaml(Loader):
    """YAML with units."""

    def __init__(self, text: str) -> None:
        super().__init__(text)
        self.budget = Budget(STEPS_OF_A_FILE)

    def measure(self, node: Any) -> float:
        """Return the value of a number, or an expression, in the unit of its tag."""
        symbols = {**MATH, "math": Namespace("math", MATH)}
        text = str(self.construct_scalar(node))
        self.budget.earn(len(text))
        return float(Expression(text, functions=symbols).evaluate({}, self.budget)) * UNITS[node.tag]


for _tag in UNITS:
    _Yaml.add_constructor(_tag, _Yaml.measure)  # type: ignore[type-var]  # PyYAML's types know its own only


def _tokenize(text: str, sep: str = ",; ", skip_empty: bool = True) -> list[str]:
    parts = re.split(f"[{re.escape(sep)}]", text)
    return [part for part in parts if part] if skip_empty else parts


def _glob(pattern: str) -> list[str]:
    folder = str(Path(pattern).parent)
    if glob.has_magic(folder):
        raise NotAllowed(f"in {pattern} only the name of the file may have * and ?")
    return glob.glob(pattern)  # noqa: PTH207 (as xacro has it)
