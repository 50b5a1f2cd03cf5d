"""Substitution args: ``$(find pkg) $(arg x) $(env X) $(optenv X y) $(anon x) $(dirname) $(eval ...)``.

See http://wiki.ros.org/roslaunch/XML, section "substitution args". ``$(eval ...)`` is restricted
(`rosmini.core.expressions`).
"""

from __future__ import annotations

import os
import re
from collections.abc import Callable, Collection, Iterator, Mapping
from pathlib import Path
from typing import TYPE_CHECKING, Any

from rosmini.core.errors import ParameterError, UnknownPackage, nearest, shown
from rosmini.core.expressions import (
    FUNCTIONS,
    MATH,
    STEPS_OF_A_FILE,
    Budget,
    Expression,
    ExpressionError,
    Function,
    Namespace,
)

from .errors import Missing, Place
from .values import convert

if TYPE_CHECKING:
    from rosmini.core.markup import Element
    from rosmini.core.packages import PackageIndex

    from .scope import Scope

COMMANDS = ("find", "env", "optenv", "dirname", "anon", "arg")

STAND_IN = "missing_"
"""Prefix of placeholders for missing things; reading continues with them, to find everything that is missing."""

MAX_HINTS = 20
"""Number of missing things for which similar names are searched."""

MAX_LENGTH = 1_000_000
"""Maximum number of characters in a text after replacement."""

MAX_TOTAL_LENGTH = 25_000_000
"""Maximum number of characters in all texts of a launch in which something is replaced."""

SHOWN = 300
"""Maximum number of characters of a text quoted in an error."""

# Otherwise each `$` in a row would start the search again.
_OPEN = re.compile(r"(?<!\$)\$+\(([^)]*)\)")
_FIND = re.compile(r"(?<!\$)\$+\( *find +([^()$ ]+) *\)([^ ]*)")


class _Arguments(Mapping[str, Any]):
    """Arguments as values, except those that have the name of a function."""

    def __init__(self, args: Mapping[str, str], functions: Mapping[str, Any]) -> None:
        self._args, self._functions = args, functions

    def __getitem__(self, name: str) -> Any:
        if name in self._functions:
            raise KeyError(name)
        return convert(self._args[name])

    def __iter__(self) -> Iterator[str]:
        return (name for name in self._args if name not in self._functions)

    def __len__(self) -> int:
        return sum(1 for _ in self)


class Substitution:
    """Replaces ``$(...)`` in texts.

    Args:
        packages: packages for ``$(find ...)``.
        environ: variables for ``$(env ...)``.
        anonymous: creates a new name for the name in ``$(anon ...)``.
        missing: called for each missing thing; reading continues with a placeholder.

    """

    def __init__(
        self,
        packages: PackageIndex,
        environ: Mapping[str, str],
        anonymous: Callable[[str], str],
        missing: Callable[[Missing], None],
    ) -> None:
        self.packages, self.environ, self.anonymous, self.missing = packages, environ, anonymous, missing
        self._stand_ins: set[str] = set()
        self._unknown: set[str] = set()
        self._made = 0
        self._budget = Budget(STEPS_OF_A_FILE)

    def is_incomplete(self, text: str) -> bool:
        """Return True if a text contains a placeholder for something missing."""
        return STAND_IN in text and any(word in text for word in self._stand_ins)

    def resolve(self, text: str, scope: Scope, element: Element) -> str:
        """Return a text with everything replaced. Raises ``LaunchError`` for invalid substitutions."""
        if "$" not in text:
            return text
        if text.startswith("$(eval ") and text.endswith(")"):
            return self._counted(self._eval(text[len("$(eval ") : -1], scope, element), element)
        end = text.rfind(")") + 1  # behind it nothing is closed, and is not searched
        closed, rest = text[:end], text[end:]
        for inside in _OPEN.findall(closed):
            self._check(inside, text, element)
        replaced = self._sub(_OPEN, lambda found: self._replace(found, scope, element), closed, element) + rest
        replaced = self._sub(_FIND, lambda found: self._path(found[1], found[2], element), replaced, element)
        return self._counted(replaced, element)

    def _sub(self, what: re.Pattern[str], new: Callable[[re.Match[str]], str], text: str, element: Element) -> str:
        """Replace like ``what.sub``, and stop before the text becomes too long."""
        size = 0

        def counted(found: re.Match[str]) -> str:
            nonlocal size
            made = new(found)
            size += len(made)
            if size > MAX_LENGTH:
                raise element.error(f"a text of more than {MAX_LENGTH} characters: see what is replaced in it")
            return made

        return what.sub(counted, text)

    def _counted(self, text: str, element: Element) -> str:
        self._made += len(text)
        if len(text) > MAX_LENGTH:
            raise element.error(f"a text of {len(text)} characters; {MAX_LENGTH} are allowed")
        if self._made > MAX_TOTAL_LENGTH:
            raise element.error(f"all texts with something replaced have more than {MAX_TOTAL_LENGTH} characters")
        return text

    def _check(self, inside: str, text: str, element: Element) -> None:
        if "$" in inside or "(" in inside:
            if inside.lstrip().startswith("eval"):
                raise element.error(f"$(eval ...) must be the whole value, and this is {shown(text)}")
            sign = "Dollar signs '$' cannot be" if "$" in inside else "Parentheses '(' cannot be"
            raise element.error(
                f"{sign} inside of substitution args [{_cut(text)}]: they are not nested; write $(eval ...) instead, "
                "in which arguments are names"
            )
        words = inside.split()
        if words and words[0] not in COMMANDS:
            hint = nearest(words[0], [*COMMANDS, "eval"])
            whole = " ($(eval ...) must be the whole value)" if words[0] == "eval" else ""
            raise element.error(
                f"Unknown substitution command [{_cut(inside)}]{whole}. Valid commands are {', '.join(COMMANDS)}"
                f"{f'; {hint}' if hint else ''}"
            )

    def _replace(self, found: re.Match[str], scope: Scope, element: Element) -> str:
        command, *words = found[1].split() or [""]
        if command == "dirname":
            return self._dirname(scope, element)
        if command == "find" and len(words) == 1:
            return found[0]  # the second pass's: what follows it may be replaced yet
        if command == "optenv" and words:
            return self.environ.get(words[0], " ".join(words[1:]))
        if command in ("env", "arg", "anon", "find"):
            if len(words) != 1:
                what = "variable" if command == "env" else "package" if command == "find" else "name"
                raise element.error(f"$({command} ...) takes one {what}, not {len(words)} [{_cut(found[1])}]")
            read = {"env": self._env, "arg": self._arg, "anon": self._anon}[command]
            return read(words[0], scope, element)
        if command == "optenv":
            raise element.error(f"$(optenv ...) must name an environment variable [{_cut(found[1])}]")
        return found[0]  # "$()" is text

    def _env(self, name: str, scope: Scope, element: Element) -> str:  # noqa: ARG002 - alike
        if name not in self.environ:
            hint = self._hint(name, self.environ)
            self._lacks(
                element,
                "environment variable",
                name,
                f"environment variable {name!r} is not set: export {name}=VALUE before you launch, or write "
                f"$(optenv {name} DEFAULT){f'; {hint}' if hint else ''}",
            )
            return self._stand_in(name)
        return self.environ[name]

    def _arg(self, name: str, scope: Scope, element: Element) -> str:
        if name in scope.args:
            return scope.args[name]
        if name in scope.declared:
            way = f"give it as {name}:=VALUE"
            if scope.included_at:
                way = f'give it in the <include> at {scope.included_at}: <arg name="{name}" value="..."/>'
            said = f"requires the '{name}' arg to be set: {way}"
        else:
            hint = self._hint(name, scope.args.keys() | scope.declared)
            said = f'$(arg {name}): no <arg name="{name}"> stands before this line{f"; {hint}" if hint else ""}'
        self._lacks(element, "arg", name, said)
        return self._stand_in(name)

    def _anon(self, name: str, scope: Scope, element: Element) -> str:  # noqa: ARG002 - alike
        if name not in scope.anonymous:
            scope.anonymous[name] = self.anonymous(name)
        return scope.anonymous[name]

    def _dirname(self, scope: Scope, element: Element) -> str:
        if not scope.file or scope.file.startswith("<"):
            raise element.error("$(dirname) has no folder to name: this launch file is not read from a file")
        return str(Path(scope.file).absolute().parent)

    def _find(self, package: str, element: Element) -> str:
        try:
            if package not in self._unknown:
                return str(self.packages.path(package))
        except UnknownPackage as error:
            self._unknown.add(package)
            self._lacks(element, "package", package, str(error))
        return f"/{self._stand_in(package)}"

    def _path(self, package: str, rest: str, element: Element) -> str:
        """Return the path of a package, followed by the rest of the path, if any."""
        path = rest.replace("\\", "/").removeprefix("/").replace("/", os.sep)
        folder = self._find(package, element)
        return str(os.path.join(folder, path)) if path else folder  # noqa: PTH118 - a text that need be no path

    def _stand_in(self, name: str) -> str:
        word = _word(name)
        self._stand_ins.add(word)
        return word

    def _hint(self, name: str, known: Collection[str]) -> str:
        """Return a hint with similar names, for the first missing things only."""
        return "" if len(self._stand_ins) >= MAX_HINTS or _word(name) in self._stand_ins else nearest(name, known)

    def _lacks(self, element: Element, kind: str, name: str, message: str) -> None:
        self.missing(Missing(kind, name, Place(element.path, element.line), message))

    def _eval(self, text: str, scope: Scope, element: Element) -> str:
        def arg(name: str) -> Any:
            return convert(self._arg(name, scope, element))

        functions = {
            **FUNCTIONS,
            **MATH,
            "math": Namespace("math", MATH),
            "true": True,
            "false": False,
            "arg": Function("arg", arg),
            "env": Function("env", lambda name: self._env(name, scope, element)),
            "optenv": Function("optenv", lambda name, default="": self.environ.get(name, default)),
            "find": Function("find", lambda name: self._find(name, element)),
            "anon": Function("anon", lambda name: self._anon(name, scope, element)),
            "dirname": Function("dirname", lambda: self._dirname(scope, element)),
        }
        values = _Arguments(scope.args, functions)
        self._budget.earn(len(text))
        try:
            return str(Expression(text, functions=functions).evaluate(values, self._budget))
        except ParameterError as error:
            raise element.error(f"$(eval {text}): {error}") from error
        except ExpressionError as error:
            hint = nearest(text, values) if text.isidentifier() else ""
            raise element.error(f"$(eval {text}): {error}{f'; {hint}' if hint else ''}") from error


def _word(name: str) -> str:
    return STAND_IN + re.sub(r"\W", "_", name)


def _cut(text: str) -> str:
    return text if len(text) <= SHOWN else f"{text[:SHOWN]}..."
