"""Context menus of interactive markers: a tree of entries with callbacks."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field
from typing import Any

from rosmini.core.errors import RosminiError
from rosmini.msgs import message_class

from .server import InteractiveMarkerServer

MenuEntry = message_class("visualization_msgs/MenuEntry")
InteractiveMarkerFeedback = message_class("visualization_msgs/InteractiveMarkerFeedback")

_NO_CHECKBOX, _CHECKED, _UNCHECKED = 0, 1, 2
_BOXES = {_NO_CHECKBOX: "", _CHECKED: "[x] ", _UNCHECKED: "[ ] "}
"""Prefix of an entry's title for each check state; RViz draws a box there."""


class InteractiveMarkerException(RosminiError):
    """A request about a marker or a menu cannot be fulfilled."""


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
    """A menu for any number of interactive markers; entries are numbered from 1 (their handles)."""

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
        """Add an entry, below ``parent`` if given, and return its handle.

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
        """Show or hide an entry and those below it; return True if the entry exists."""
        return self._set(handle, visible=visible)

    def setCheckState(self, handle: int, check_state: int) -> bool:
        """Set an entry's box to ``CHECKED``, ``UNCHECKED`` or ``NO_CHECKBOX``; return True if the entry exists."""
        return self._set(handle, check_state=check_state)

    def _set(self, handle: int, **values: Any) -> bool:
        entry = self._entries.get(handle)
        for name, value in values.items() if entry is not None else ():
            setattr(entry, name, value)
        return entry is not None

    def getCheckState(self, handle: int) -> int | None:
        """Return the check state of an entry, or None if it does not exist."""
        entry = self._entries.get(handle)
        return None if entry is None else entry.check_state

    def getTitle(self, handle: int) -> str | None:
        """Return the title of an entry without its box, or None if it does not exist."""
        entry = self._entries.get(handle)
        return None if entry is None else entry.title

    def apply(self, server: InteractiveMarkerServer, marker_name: str) -> bool:
        """Attach the current menu to a marker of ``server`` and handle the user's choices.

        Clients see it after the server's `applyChanges`. Return True if the marker exists.
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
        """Apply the menu again to all markers that have it; return True if all of them still exist."""
        found = [self.apply(server, name) for name in list(self._markers)]
        return all(found)

    def processFeedback(self, feedback: Any) -> None:
        """Call the callback of the chosen entry."""
        entry = self._entries.get(feedback.menu_entry_id)
        if entry is not None and entry.callback is not None:
            entry.callback(feedback)

    def _messages(self, handles: list[int]) -> list[Any]:
        """Return the visible entries, each before those below it."""
        found = []
        for handle in handles:
            entry = self._entries[handle]
            if entry.visible:
                title = _BOXES.get(entry.check_state, "") + entry.title
                found.append(MenuEntry(handle, entry.parent, title, entry.command, entry.command_type))
                found += self._messages(entry.children)
        return found
