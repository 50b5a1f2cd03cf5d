"""Configuration files of the real RViz, `.rviz`: validated when read, and written so that RViz can load them.

A file is YAML with three parts, `Panels`, `Visualization Manager` and `Window Geometry`. Unknown content (displays of
other packages, panels, properties) is listed in one warning and preserved when the file is written again.
"""

from __future__ import annotations

from collections.abc import Iterable
from copy import deepcopy
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

from rosmini.core import files
from rosmini.core.errors import RosminiError
from rosmini.core.packages import SCHEME, PackageIndex
from rosmini.core.yaml_text import documents
from rosmini.viz.view import ViewError

from .properties import Colour, Properties, Property

MAX_BYTES = 4_000_000
MAX_DEPTH = 40
"""Maximum nesting depth of mappings and lists."""

MANAGER = "Visualization Manager"

OPTIONS = (
    Property("Background Color", Colour(48, 48, 48), "the colour behind everything"),
    Property("Default Light", True, "a light beside the camera"),
    Property("Fixed Frame", "map", "the frame in which everything is drawn"),
    Property("Frame Rate", 30, "rate at which a live view is drawn", unit="Hz", minimum=1, maximum=1000),
)
"""The Global Options."""

PANELS = ("Displays", "Help", "Selection", "Time", "Tool Properties", "Views")
TOOLS = (
    "FocusCamera", "Interact", "Measure", "MoveCamera", "PublishPoint", "Select", "SetGoal", "SetInitialPose",
)  # fmt: skip

_NEW: dict[str, Any] = {
    "Panels": [
        {"Class": "rviz/Displays", "Name": "Displays"},
        {"Class": "rviz/Selection", "Name": "Selection"},
        {"Class": "rviz/Tool Properties", "Name": "Tool Properties"},
        {"Class": "rviz/Views", "Name": "Views"},
        {"Class": "rviz/Time", "Name": "Time", "SyncMode": 0, "SyncSource": ""},
    ],
    MANAGER: {
        "Class": "",
        "Displays": [],
        "Enabled": True,
        "Global Options": {},
        "Name": "root",
        "Tools": [
            {"Class": "rviz/Interact", "Hide Inactive Objects": True},
            {"Class": "rviz/MoveCamera"},
            {"Class": "rviz/Select"},
            {"Class": "rviz/FocusCamera"},
            {"Class": "rviz/Measure"},
            {"Class": "rviz/SetInitialPose", "Topic": "/initialpose"},
            {"Class": "rviz/SetGoal", "Topic": "/move_base_simple/goal"},
            {"Class": "rviz/PublishPoint", "Single click": True, "Topic": "/clicked_point"},
        ],
        "Transformation": {"Current": {"Class": "rviz/TF"}},
        "Value": True,
        "Views": {"Current": {}, "Saved": None},
    },
    "Window Geometry": {"Height": 800, "Width": 1200, "X": 0, "Y": 0},
}


class ConfigError(ViewError):
    """A file is not a configuration of RViz."""


@dataclass
class Config:
    """The contents of a file as plain data: `tree` is all of it."""

    tree: dict[str, Any] = field(default_factory=lambda: deepcopy(_NEW))
    source: str = "a new configuration"

    @classmethod
    def read(cls, path: str | Path) -> Config:
        """Read a file, given by its path or a URL ``package://NAME/PATH``.

        Raises:
            ConfigError: it cannot be read, is not YAML, is too large, or is not a configuration of RViz.

        """
        try:
            if str(path).startswith(SCHEME):
                path = PackageIndex().resolve(str(path))
        except RosminiError as error:
            raise ConfigError(f"the configuration {path} cannot be read: {error}") from error
        try:
            data = files.read(path, MAX_BYTES)
        except OSError as error:
            raise ConfigError(f"the configuration {path} cannot be read: {error.strerror}") from error
        return cls.parse(data.decode(errors="replace"), Path(path).name)

    @classmethod
    def parse(cls, text: str, source: str = "the text") -> Config:
        """Read the text of a file. Raises as `read` does."""
        found = [value for value, _ in documents(text, source, _failure)]
        tree = found[0] if len(found) == 1 else None
        if not isinstance(tree, dict) or not isinstance(tree.get(MANAGER), dict):
            raise ConfigError(f"{source} is not a configuration of RViz: it has no mapping {MANAGER!r}")
        if _depth(tree) > MAX_DEPTH:
            raise ConfigError(f"{source}: values are nested deeper than {MAX_DEPTH}")
        return cls(tree, source)

    @property
    def manager(self) -> dict[str, Any]:
        """The part with displays, options, tools and views."""
        found: dict[str, Any] = self.tree[MANAGER]
        return found

    def mappings(self, part: str) -> list[dict[str, Any]]:
        """Return the mappings in a list of the manager, its `Displays` or `Tools`; other items are left out."""
        return _mappings(self.manager.get(part))

    @property
    def panels(self) -> list[dict[str, Any]]:
        """The panels of the window."""
        return _mappings(self.tree.get("Panels"))

    def mapping(self, *path: str) -> dict[str, Any]:
        """Return a mapping inside the manager; empty if it does not exist."""
        node: Any = self.manager
        for part in path:
            node = node.get(part) if isinstance(node, dict) else None
        return node if isinstance(node, dict) else {}

    def options(self) -> Properties:
        """The Global Options."""
        return Properties(OPTIONS, self.mapping("Global Options"))

    def unknown_classes(self) -> list[str]:
        """Return the classes of panels and tools that are unknown here."""
        kinds: list[tuple[str, tuple[str, ...], str]] = [(kind_of(each), PANELS, "panel") for each in self.panels]
        kinds += [(kind_of(each), TOOLS, "tool") for each in self.mappings("Tools")]
        return [
            f"{what} {kind}"
            for kind, known, what in kinds
            if kind.partition("/")[0] != "rviz" or kind.partition("/")[2] not in known
        ]

    def with_parts(
        self, displays: Iterable[dict[str, Any]], options: Properties, view: dict[str, Any] | None
    ) -> Config:
        """Return a copy with other displays, options and, if given, another view."""
        tree = deepcopy(self.tree)
        manager = tree[MANAGER]
        manager["Displays"] = list(displays)
        manager["Global Options"] = options.tree()
        if view is not None:
            views = manager.get("Views")
            manager["Views"] = {**(views if isinstance(views, dict) else {"Saved": None}), "Current": view}
        return Config(tree, self.source)

    def text(self) -> str:
        """Return the text of the file: keys in alphabetical order, as the real RViz writes them."""
        import yaml

        return str(yaml.safe_dump(_plain(self.tree), sort_keys=True, width=10_000, allow_unicode=True))

    def write(self, path: str | Path) -> Path:
        """Write the file, and return its path. Raises `ConfigError` if it cannot be written."""
        try:
            Path(path).write_text(self.text(), encoding="utf-8")
        except OSError as error:
            raise ConfigError(f"the configuration {path} cannot be written: {error.strerror}") from error
        return Path(path)


def kind_of(tree: dict[str, Any]) -> str:
    """Return the class that a part of a file names."""
    return str(tree.get("Class", ""))


def _mappings(value: Any) -> list[dict[str, Any]]:
    return [each for each in value if isinstance(each, dict)] if isinstance(value, list) else []


def _failure(text: str, source: str, line: int | None) -> Exception:
    return ConfigError(f"{source}{'' if line is None else f', line {line}'}: {text}")


def _depth(value: Any) -> int:
    deepest, todo = 0, [(value, 1)]
    while todo:
        node, depth = todo.pop()
        deepest = max(deepest, depth)
        if depth > MAX_DEPTH:
            break
        inside = node.values() if isinstance(node, dict) else node if isinstance(node, list) else ()
        todo += [(each, depth + 1) for each in inside]
    return deepest


def _plain(value: Any) -> Any:
    """Return data that YAML writes without tags; keys are text, so that they can be sorted."""
    if isinstance(value, dict):
        return {str(key): _plain(each) for key, each in value.items()}
    if isinstance(value, list | tuple):
        return [_plain(each) for each in value]
    return value if isinstance(value, bool | int | float | str | None) else str(value)
