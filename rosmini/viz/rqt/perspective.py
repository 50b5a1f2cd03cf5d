"""Perspectives: the running plugins of rqt and their settings, in the files that rqt exports and imports.

Such a file is JSON: nested groups, whose keys contain Python literals as texts
(http://wiki.ros.org/rqt/UserGuide/Perspectives; qt_gui's perspective manager). No literal is executed.
"""

from __future__ import annotations

import ast
import json
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

from rosmini.core import files
from rosmini.viz.view import ViewError

MAX_FILE_LENGTH = 4_000_000
"""Maximum number of characters in a file."""
MAX_LITERAL_LENGTH = 100_000
"""Maximum number of characters in a literal."""
MAX_PLUGINS = 100
"""Maximum number of running plugins."""


def _no_group() -> dict[str, Any]:
    return {"keys": {}, "groups": {}}


@dataclass(frozen=True)
class Running:
    """A running plugin, such as ``rqt_graph/RosGraph``, and its ``settings``."""

    plugin: str
    number: int = 1
    settings: dict[str, Any] = field(default_factory=dict)

    @property
    def group(self) -> str:
        """Group of its settings."""
        return f"plugin__{self.plugin.replace('/', '__')}__{self.number}"


@dataclass(frozen=True)
class Perspective:
    """An arrangement of plugins."""

    running: tuple[Running, ...] = ()
    docks: dict[str, Any] = field(default_factory=_no_group)
    """Positions of the docks in Qt's format: stored for the real rqt, and not used here."""

    @classmethod
    def read(cls, path: str | Path) -> Perspective:
        """Read a file. Raises ``ViewError`` with its name."""
        try:
            text = files.read(path, 4 * MAX_FILE_LENGTH).decode("utf-8")
        except (OSError, UnicodeDecodeError) as error:
            raise ViewError(f"{path} cannot be read: {error}") from error
        try:
            return cls.parse(text)
        except ViewError as error:
            raise ViewError(f"{path}: {error}") from error

    @classmethod
    def parse(cls, text: str) -> Perspective:
        """Read the text of a file. Raises ``ViewError`` if it is not a perspective."""
        if len(text) > MAX_FILE_LENGTH:
            raise ViewError(f"a perspective has at most {MAX_FILE_LENGTH} characters")
        try:
            found = json.loads(text)
        except (ValueError, RecursionError) as error:
            raise ViewError(f"a perspective is JSON, as `Perspectives > Export` writes it: {error}") from error
        manager = _group(found, "pluginmanager")
        plugins = _literal(_part(manager, "keys").get("running-plugins"))
        if not isinstance(plugins, dict):
            raise ViewError("it does not say which plugins run (pluginmanager: running-plugins)")
        running = [
            Running(str(plugin), int(number), _settings(manager, Running(str(plugin), int(number)).group))
            for plugin, numbers in plugins.items()
            for number in (numbers if isinstance(numbers, list | tuple) else ())
            if isinstance(number, int)
        ]
        if len(running) > MAX_PLUGINS:
            raise ViewError(f"it runs {len(running)} plugins; {MAX_PLUGINS} are allowed")
        return cls(tuple(running), _group(found, "mainwindow") or _no_group())

    def dumps(self) -> str:
        """Return the text of a file."""
        plugins: dict[str, list[int]] = {}
        for each in self.running:
            plugins.setdefault(each.plugin, []).append(each.number)
        groups = {
            each.group: {"keys": {}, "groups": {"plugin": {"keys": _keys(each.settings), "groups": {}}}}
            for each in self.running
        }
        manager = {"keys": _keys({"running-plugins": plugins}), "groups": groups}
        whole = {"keys": {}, "groups": {"mainwindow": self.docks, "pluginmanager": manager}}
        return json.dumps(whole, indent=2, sort_keys=True) + "\n"

    def write(self, path: str | Path) -> None:
        """Write a file. Raises ``ViewError``."""
        try:
            Path(path).write_text(self.dumps(), encoding="utf-8")
        except OSError as error:
            raise ViewError(f"{path} cannot be written: {error}") from error


def _keys(values: dict[str, Any]) -> dict[str, dict[str, str]]:
    return {name: {"type": "repr", "repr": repr(value)} for name, value in values.items()}


def _part(found: Any, name: str) -> dict[str, Any]:
    part = found.get(name) if isinstance(found, dict) else None
    return part if isinstance(part, dict) else {}


def _group(found: Any, name: str) -> dict[str, Any]:
    return _part(_part(found, "groups"), name)


def _settings(manager: dict[str, Any], group: str) -> dict[str, Any]:
    keys = _part(_group(_group(manager, group), "plugin"), "keys")
    values = {name: _literal(value) for name, value in keys.items()}
    return {name: value for name, value in values.items() if value is not None}


def _literal(value: Any) -> Any:
    """Return the value of a key; None unless it is a plain literal (the state of a Qt window is not)."""
    return literal(value.get("repr")) if isinstance(value, dict) and value.get("type") == "repr" else None


def literal(text: object) -> Any:
    """Return the value of a literal; None for any other text."""
    if not isinstance(text, str) or len(text) > MAX_LITERAL_LENGTH:
        return None
    try:
        return ast.literal_eval(text)
    except (ValueError, SyntaxError, TypeError, RecursionError, MemoryError):  # {[]: 1} is a TypeError
        return None
