"""Context menus of interactive markers: a tree of entries, and what each of them calls."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field
from typing import Any

from rosmini.msgs import message_class

from .errors import InteractiveMarkerException
from .server import InteractiveMarkerServer

MenuEntry = message_class("visualization_msgs/MenuEntry")
InteractiveMarkerFeedback = message_class("visualization_msgs/InteractiveMarkerFeedback")

_NO_CHECKBOX, _CHECKED, _UNCHECKED = 0, 1, 2
_BOXES = {_NO_CHECKBOX: "", _CHECKED: "[x] ", _UNCHECKED: "[ ] "}
"""How an entry's title begins by its check state; RViz draws a box there."""


@dataclass
class _Entry:
    title: str
    command_type: int
    command: str
    callback: Callable[[Any], object] | None
    parent: int
    visible: bool = True
    check_state: int = _NO_CHECKBOX
    children: list[int] = field(default_factory=list)


class MenuHandler:
    """A menu that is given to any number of interactive markers; its entries are numbered from 1, their handles."""

    NO_CHECKBOX = _NO_CHECKBOX
    CHECKED = _CHECKED
    UNCHECKED = _UNCHECKED

    def __init__(self) -> None:
        self._entries: dict[int, _Entry] = {}
        self._markers: dict[str, None] = {}

    def insert(
        self,
        title: str,
        parent: int | None = None,
        command_type: int = MenuEntry.FEEDBACK,
        command: str = "",
        callback: Callable[[Any], object] | None = None,
    ) -> int | None:
        """Add an entry, below the entry ``parent`` if one is given, and return its handle.

        ``callback(feedback)`` is called when it is chosen. Raises ``InteractiveMarkerException`` if there is no such
        parent.
        """
        if parent is not None and parent not in self._entries:
            raise InteractiveMarkerException(
                f"the menu has no entry {parent}, below which '{title}' was to be: give the handle that insert returned"
            )
        handle = len(self._entries) + 1
        self._entries[handle] = _Entry(title, command_type, command, callback, parent or 0)
        if parent is not None:
            self._entries[parent].children.append(handle)
        return handle

    def setVisible(self, handle: int, visible: bool) -> bool:
        """Show an entry and those below it, or hide them; return whether there is such an entry."""
        return self._set(handle, visible=visible)

    def setCheckState(self, handle: int, check_state: int) -> bool:
        """Give an entry a box: ``CHECKED``, ``UNCHECKED`` or ``NO_CHECKBOX``; return whether there is such an entry."""
        return self._set(handle, check_state=check_state)

    def _set(self, handle: int, **values: Any) -> bool:
        entry = self._entries.get(handle)
        for name, value in values.items() if entry is not None else ():
            setattr(entry, name, value)
        return entry is not None

    def getCheckState(self, handle: int) -> int | None:
        """Return the check state of an entry, or None if there is no such entry."""
        entry = self._entries.get(handle)
        return None if entry is None else entry.check_state

    def getTitle(self, handle: int) -> str | None:
        """Return the title of an entry without its box, or None if there is no such entry."""
        entry = self._entries.get(handle)
        return None if entry is None else entry.title

    def apply(self, server: InteractiveMarkerServer, marker_name: str) -> bool:
        """Give a marker of ``server`` the menu as it is now, and take what is chosen in it.

        Clients see it after the server's `applyChanges`. Return whether there is such a marker.
        """
        marker = server.get(marker_name)
        if marker is None:
            self._markers.pop(marker_name, None)
            return False
        top = [handle for handle, entry in self._entries.items() if not entry.parent]
        marker.menu_entries = self._messages(top)
        server.insert(marker, self.processFeedback, InteractiveMarkerFeedback.MENU_SELECT)
        self._markers[marker_name] = None
        return True

    def reApply(self, server: InteractiveMarkerServer) -> bool:
        """Apply the menu again to all markers that have it; return whether all of them are still there."""
        found = [self.apply(server, name) for name in list(self._markers)]
        return all(found)

    def processFeedback(self, feedback: Any) -> None:
        """Call what was set for the entry that was chosen."""
        entry = self._entries.get(feedback.menu_entry_id)
        if entry is not None and entry.callback is not None:
            entry.callback(feedback)

    def _messages(self, handles: list[int]) -> list[Any]:
        """Return the entries that are visible, each before those below it."""
        found = []
        for handle in handles:
            entry = self._entries[handle]
            if entry.visible:
                title = _BOXES.get(entry.check_state, "") + entry.title
                found.append(MenuEntry(handle, entry.parent, title, entry.command, entry.command_type))
                found += self._messages(entry.children)
        return found
