"""Shared parts of the launch file reader: attributes, warnings, missing things, and the plan being built."""

from __future__ import annotations

import os
from collections.abc import Callable, Collection, Iterable, Mapping
from typing import TYPE_CHECKING, Any

from rosmini.core.errors import ParameterError, nearest
from rosmini.core.names import canonicalize, namespace

from .errors import Missing, Place, not_there
from .plan import LaunchFile, Plan, Setting
from .substitution import Substitution
from .values import TRUTHS, checked, flag

if TYPE_CHECKING:
    from rosmini.core.markup import Element
    from rosmini.core.packages import PackageIndex

    from .scope import Scope

CONDITIONS = ("if", "unless")

MAX_SETTINGS = 100_000
"""Maximum number of parameters set."""

MAX_WARNINGS = 100
"""Maximum number of warnings listed; the others are counted."""

MAX_MISSING = 200
"""Number of missing things at which reading stops."""

MAX_COPIES = 200_000
"""Maximum number of remappings and environment variables of all nodes together."""

MAX_NAME_LENGTH = 4096
"""Maximum number of characters in a parameter name."""


class Loading:
    """A plan that is being read; ``at`` is the current file."""

    def __init__(self, packages: PackageIndex, environ: Mapping[str, str], anonymous: Callable[[str], str]) -> None:
        self.packages = packages
        self.plan = Plan()
        self.at = LaunchFile("")
        self.default_machine = ""
        self.wanted_machines: list[tuple[str, Element]] = []
        self._settings = 0
        self._more_warnings = 0
        self._copies = 0
        self._warned: set[tuple[str, str]] = set()
        self._substitution = Substitution(packages, environ, anonymous, self.lacks)
        self.is_incomplete = self._substitution.is_incomplete

    # -- attributes ----------------------------------------------------------------------------------------------

    def resolve(self, text: str, scope: Scope, element: Element) -> str:
        """Return a text with its substitution args replaced. Raises ``LaunchError``."""
        return self._substitution.resolve(text, scope, element)

    def optional(self, element: Element, scope: Scope, name: str) -> str | None:
        """Return an attribute, or None if it is missing. Raises ``LaunchError``."""
        text = element.attributes.get(name)
        return None if text is None else self.resolve(text, scope, element)

    def required(self, element: Element, scope: Scope, name: str) -> str:
        """Return a mandatory attribute. Raises ``LaunchError``."""
        text = self.optional(element, scope, name)
        if text is None:
            hint = nearest(name, element.attributes)
            raise element.error(
                f"<{element.tag}> tag is missing required attribute: '{name}'{f'; {hint}' if hint else '.'} "
                f"The tag is {source(element)}"
            )
        return text

    def check_attributes(self, element: Element, known: Collection[str]) -> None:
        """Warn of unknown attributes; they are ignored, as in ROS."""
        for name in element.attributes:
            if name not in known and name not in CONDITIONS:
                self.warn(element, f"unknown <{element.tag}> attribute '{name}'", name, known)

    def applies(self, element: Element, scope: Scope) -> bool:
        """Return True if ``if`` and ``unless`` enable an element. Raises ``LaunchError``."""
        given = [name for name in CONDITIONS if name in element.attributes]
        if not given:
            return True
        if len(given) == 2:
            raise element.error("cannot set both 'if' and 'unless' on the same tag")
        text = self.required(element, scope, given[0])
        if self.is_incomplete(text):
            return False  # what is missing was told
        truth = TRUTHS.get(text.strip().lower())
        if truth is None:
            raise element.error(f'<{element.tag}>: {given[0]}="{text}" is neither true nor false, 1 nor 0')
        return truth == (given[0] == "if")

    def scope_inside(self, element: Element, scope: Scope, node: str | None = None) -> Scope:
        """Return the scope inside an element with ``ns`` and ``clear_params``. Raises ``LaunchError``."""
        space = self.space(element, scope)
        inside = scope.child(space)
        self.clear(
            element, scope, inside.namespace if node is None else inside.full(node) + "/", named=bool(space or node)
        )
        return inside

    def space(self, element: Element, scope: Scope) -> str | None:
        """Return the namespace that an element names. Raises ``LaunchError``."""
        space = self.optional(element, scope, "ns")
        if space == "":
            raise element.error(f"<{element.tag}> tag has an empty 'ns' attribute")
        return space

    def clear(self, element: Element, scope: Scope, space: str, *, named: bool) -> None:
        """Record a namespace whose parameters are to be cleared. Raises ``LaunchError``."""
        if not flag(element, "clear_params", self.optional(element, scope, "clear_params") or None):
            return
        if not named:
            raise element.error("'ns' attribute must be set in order to use 'clear_params'")
        if space not in self.plan.cleared:
            self.plan.cleared.append(space)

    # -- what is found -------------------------------------------------------------------------------------------

    def warn(self, element: Element, message: str, name: str = "", known: Iterable[str] = ()) -> None:
        """Add a warning; ``name`` may be a misspelling of one of the ``known`` names."""
        if self._may_warn():
            hint = nearest(name, known)
            self.plan.warnings.append(f"{element.path}:{element.line}: {message}{f'; {hint}' if hint else ''}")

    def _may_warn(self) -> bool:
        """Return True if another warning may be listed; otherwise count it."""
        listed = len(self.plan.warnings) < MAX_WARNINGS
        self._more_warnings += not listed
        return listed

    def count_warnings(self) -> None:
        """Add the number of warnings that were not listed."""
        if self._more_warnings:
            self.plan.warnings.append(f"... and {self._more_warnings} more warnings")

    def lacks(self, missing: Missing) -> None:
        """Record a missing thing, once."""
        if (missing.kind, missing.name) not in self._warned:
            self._warned.add((missing.kind, missing.name))
            self.plan.missing.append(missing)
            if len(self.plan.missing) > MAX_MISSING:
                raise not_there(self.plan.missing)

    def lacks_file(self, element: Element, kind: str, path: str, reason: str) -> None:
        """Record an unreadable file, unless something in its name is missing already."""
        if not self.is_incomplete(path) and ("file", path) not in self._warned:
            folder, name = os.path.split(path)
            hint = nearest(name, _names_in(folder))
            message = f"the {kind} [{path}] cannot be read: {reason}{f'; {hint}' if hint else ''}"
            self.lacks(Missing("file", path, Place(element.path, element.line), message))

    def set(self, name: str, value: Any, place: Place, origin: str = "") -> None:
        """Set a parameter; the last setting wins. Raises ``ParameterError`` for a value that cannot be stored."""
        self._settings += 1
        if self._settings > MAX_SETTINGS:
            raise ParameterError(f"more than {MAX_SETTINGS} parameters are set")
        settings = self.plan.settings
        if len(name) > MAX_NAME_LENGTH:
            raise ParameterError(f"a parameter's name of {len(name)} characters; {MAX_NAME_LENGTH} are allowed")
        setting = Setting(name, checked(name, value), place, origin)
        above = namespace(name).rstrip("/")
        while above:
            if above in settings and self._may_warn():
                self.plan.warnings.append(f"{place}: parameter [{name}] conflicts with parent parameter [{above}]")
            above = namespace(above).rstrip("/")
        settings[name] = setting
        self.at.settings.append(setting)

    def count_copies(self, element: Element, count: int) -> None:
        """Count the copies that a node gets from its scope. Raises ``LaunchError`` if all nodes have too many."""
        self._copies += count
        if self._copies > MAX_COPIES:
            raise element.error(
                f"more than {MAX_COPIES} remappings and environment variables, those of all nodes together"
            )

    def machine_needed(self, element: Element, name: str) -> None:
        """Record that a machine of this name must be declared somewhere."""
        self.wanted_machines.append((name, element))


def source(element: Element) -> str:
    """Return the opening tag of an element, on one line."""
    own = type(element)(element.tag, element.attributes)
    text = own.source()
    return text if len(text) <= 300 else text[:297] + "..."


def global_name(name: str) -> str:
    """Return a name with a leading slash."""
    return canonicalize("/" + name)


def _names_in(folder: str) -> list[str]:
    from rosmini.core.files import names_in

    return names_in(folder or ".")
