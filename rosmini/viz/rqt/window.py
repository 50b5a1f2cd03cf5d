"""`rqt` itself: several plugins in one window, with its menus File, Plugins, Running and Perspectives.

The menus are those of rqt (http://wiki.ros.org/rqt/UserGuide). A perspective is a saved arrangement; files of
the real rqt can be imported and exported (:mod:`~rosmini.viz.rqt.perspective`).
"""

from __future__ import annotations

from collections.abc import Sequence
from optparse import Values
from pathlib import Path
from typing import Any

from rosmini.core.errors import RosminiError, nearest
from rosmini.core.graph import Graph
from rosmini.core.verbs import Parser
from rosmini.viz.view import ViewError

from .panel import Panel, bar
from .parts import Box, Cell, Control, Part, Words, within
from .perspective import Perspective, Running
from .plugin import plugins
from .plugins import menu


class Rqt(Panel):
    """A window with several running plugins.

    >>> from rosmini import Graph
    >>> window = Rqt(Graph(), "rqt_console", "Plot")
    >>> [panel.heading for panel in window.running.values()]
    ['Console', 'Plot']

    Args:
        graph: the graph.
        plugins: plugins opened at first, as in `open`.
        perspective: a file exported by rqt or by this window; opened before the plugins.
        name: name of the window's node.

    Raises:
        ViewError: there is no such plugin, or the file is not a perspective.

    """

    tool, heading, plugin = "rqt_gui", "rqt", "rqt_gui/rqt_gui"
    summary = "several plugins in one window, with rqt's menus"
    usage, example, instead = "[PLUGIN...]", "rqt_graph rqt_console", "COMMAND, which it names"

    def __init__(
        self, graph: Graph, *plugins: str, perspective: str | Path | None = None, name: str | None = None
    ) -> None:
        super().__init__(graph, name=name)
        self.running: dict[int, Panel] = {}
        """The running plugins by number, in the order in which they were opened."""
        self.perspectives: dict[str, Perspective] = {}
        """Arrangements saved in this window, by name."""
        self.missing: list[str] = []
        """Plugins of the last opened perspective that this window lacks, each with its replacement."""
        self._numbered = 0
        self._docks = Perspective().docks
        self._written = {"perspective": "my perspective", "file": "my.perspective"}
        if perspective is not None:
            self.import_file(perspective)
        for plugin in plugins:
            self.open(plugin)

    @classmethod
    def add_options(cls, parser: Parser) -> None:
        """Add the file."""
        parser.add_option("--perspective-file", metavar="FILE", help="a perspective that rqt exported")

    @classmethod
    def arguments(cls, given: Values) -> tuple[list[str], dict[str, Any]]:
        """Return the plugins and the file."""
        return given.words, {"perspective": given.perspective_file}

    @classmethod
    def in_terminal(cls, words: Sequence[str]) -> int:
        """Name the command of each plugin, and return the exit status."""
        given, here = cls.parser().parse(words), {entry.package: entry.here for entry in menu()}
        wanted = list(given.words)
        if given.perspective_file:
            wanted = [each.plugin for each in Perspective.read(given.perspective_file).running] + wanted
        print("A window of several plugins is for notebooks (%rqt_gui). In a terminal each is a command of its own:")
        for plugin in wanted or [each.tool for each in plugins() if each is not cls]:
            found = here.get(plugin.partition("/")[0], "no plugin of rqt")
            is_command = found.startswith(("ros", "rqt", "rviz"))
            print(f"  {plugin}: {'rosmini ' * is_command}{found}")
        return 2

    # -- Plugins and Running ---------------------------------------------------------------------------------------

    def open(self, plugin: str) -> Panel:
        """Open a plugin: ``rqt_graph``, ``Node Graph`` or ``rqt_graph/RosGraph``. Raises ``ViewError``."""
        self._require()
        package = _package(plugin)
        panel = next((each for each in plugins() if each.tool == package and each.group), None)
        if panel is None or not issubclass(panel, Panel):
            raise ViewError(_absent(plugin))
        self._numbered += 1
        taken = any(isinstance(each, panel) for each in self.running.values())
        self.running[self._numbered] = made = panel(
            self.graph, name=f"{panel.tool}_{self._numbered}" if taken else panel.tool
        )
        return made

    def end(self, number: int) -> None:
        """Close the plugin with a number. Raises ``ViewError``."""
        if number not in self.running:
            raise ViewError(f"nothing runs under the number {number}; there are {[*self.running]}")
        self.running.pop(number).close()

    def close(self) -> None:
        """Close the window and its plugins."""
        for number in list(self.running):
            self.end(number)
        super().close()

    # -- Perspectives ----------------------------------------------------------------------------------------------

    def perspective(self) -> Perspective:
        """Return the running plugins and their settings."""
        counted: dict[str, int] = {}
        found = []
        for panel in self.running.values():
            counted[panel.plugin] = number = counted.get(panel.plugin, 0) + 1
            found.append(Running(panel.plugin, number, panel.settings()))
        return Perspective(tuple(found), self._docks)

    def arrange(self, perspective: Perspective) -> None:
        """Replace the running plugins by those of a perspective; `missing` names plugins that failed."""
        self._require()
        for number in list(self.running):
            self.end(number)
        self.missing = []
        self._docks = perspective.docks
        for each in perspective.running:
            try:
                self.open(each.plugin).restore(each.settings)
            except (RosminiError, TypeError, ValueError, LookupError, AttributeError) as error:
                self.missing.append(f"{each.plugin}: {error}")

    def save_perspective(self, name: str) -> None:
        """Save the current arrangement under a name."""
        self.perspectives[name] = self.perspective()
        self._say(f"the perspective {name!r:.80} has {len(self.running)} plugins")

    def open_perspective(self, name: str) -> None:
        """Open a saved arrangement. Raises ``ViewError`` for an unknown name."""
        if name not in self.perspectives:
            hint = nearest(name, self.perspectives) or f"there are {', '.join(self.perspectives) or 'none'}"
            raise ViewError(f"no perspective {name!r:.80}; {hint}")
        self.arrange(self.perspectives[name])

    def import_file(self, path: str | Path) -> None:
        """Open the perspective in a file. Raises ``ViewError``."""
        self.arrange(Perspective.read(path))

    def export_file(self, path: str | Path) -> None:
        """Write the current arrangement to a file that the real rqt can import. Raises ``ViewError``."""
        self.perspective().write(path)
        self._say(f"written to {path}")

    # -- showing ---------------------------------------------------------------------------------------------------

    def parts(self) -> Sequence[Part]:
        """The menus, followed by a box for each plugin."""
        groups: dict[str, list[str]] = {}
        for entry in menu():
            groups.setdefault(entry.group, [""]).append(entry.name)
        menus = [Control(f"plugins/{group}", group, "choice", "", tuple(names)) for group, names in groups.items()]
        running: list[Cell] = [
            Control(f"run/{number}", panel.heading, "check", True) for number, panel in self.running.items()
        ] or ["nothing"]
        boxes = [
            Box(panel.heading, within(str(number), panel.shown()), Control(f"end/{number}", "Close", "button"))
            for number, panel in self.running.items()
        ]
        return [
            bar("File:", Control("quit", "Quit", "button")),
            bar("Plugins:", *menus),
            bar("Running:", *running),
            bar(
                "Perspectives:",
                Control("open", "Open", "choice", "", ("", *self.perspectives)),
                Control("perspective", "Name", "text", self._written["perspective"]),
                Control("save", "Save", "button"),
                Control("file", "File", "text", self._written["file"]),
                Control("import", "Import", "button"),
                Control("export", "Export", "button"),
            ),
            *(Words(f"not here: {text}", is_bad=True) for text in self.missing),
            *boxes,
        ]

    def set(self, key: str, value: object = True) -> None:
        """Operate a control of the window, or, as ``1/KEY``, a control of the plugin with that number."""
        number, slash, rest = key.partition("/")
        if slash and number.isdecimal() and int(number) in self.running:
            self._require()
            self.running[int(number)].set(rest, value)
        else:
            super().set(key, value)

    def _operate(self, key: Sequence[str], value: Any) -> None:
        match key[0]:
            case "quit":
                self.close()
            case "plugins" if value:
                self.open(value)
            case "end" | "run":
                self.end(int(key[1]))
            case "open" if value:
                self.open_perspective(value)
            case "perspective" | "file":
                self._written[key[0]] = value
            case "save":
                self.save_perspective(self._written["perspective"])
            case "import":
                self.import_file(self._written["file"])
            case "export":
                self.export_file(self._written["file"])


def _package(plugin: str) -> str:
    """Return the package of a plugin from its name in the menu, its package, or its name in a perspective."""
    package = plugin.partition("/")[0]
    return next((entry.package for entry in menu() if entry.name.casefold() == plugin.casefold()), package)


def _absent(plugin: str) -> str:
    package = _package(plugin)
    for entry in menu():
        if entry.package == package:
            return f"{entry.name} ({package}) is not a panel of this window; instead: {entry.here}"
    known = [name for entry in menu() for name in (entry.name, entry.package)]
    return f"rqt has no plugin {plugin!r:.80}; {nearest(plugin, known) or '`rosmini rqt plugins` lists them'}"
