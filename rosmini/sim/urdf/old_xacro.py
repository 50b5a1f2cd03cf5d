"""xacro files in the old style: `<macro>` and `<property>` without the prefix `xacro:`.

ROS accepted them until Melodic, with a warning. Since Noetic such tags are ordinary XML.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    import xml.dom.minidom

TAGS = {
    "arg": ("name", "default"),
    "if": ("value",),
    "include": ("filename",),
    "insert_block": ("name",),
    "macro": ("name",),
    "property": ("name", "value"),
    "unless": ("value",),
}
"""The tags that may lack the prefix, and the attributes by which they are recognised."""


class OldStyle:
    """Adds missing prefixes, and warns once."""

    def __init__(self, xacro: Any) -> None:
        self._xacro, self._handle_macro_call = xacro, xacro.handle_macro_call
        self._names: set[str] = set()
        self._has_warned = False

    def add_prefixes(self, document: xml.dom.minidom.Document, file: str) -> None:
        """Add the prefix to the tags of a document. Inside `<plugin>` every tag belongs to the plugin."""
        found = []
        waiting: list[Any] = [document.documentElement]
        while waiting:
            element = waiting.pop()
            if element.tagName in ("macro", "xacro:macro"):
                self._names.add(element.getAttribute("name").removeprefix("xacro:"))
            attributes = TAGS.get(element.tagName)
            if attributes and all(element.hasAttribute(name) for name in attributes):
                found.append(element.tagName)
                _add_prefix(element)
            if element.tagName != "plugin":
                waiting += [child for child in element.childNodes if child.nodeType == child.ELEMENT_NODE]
        if found and not self._has_warned:
            self._has_warned = True
            tags = ", ".join(f"<{tag}>" for tag in sorted(set(found)))
            self._xacro.warning(
                f"{file}: {tags} without the prefix xacro: are read as xacro tags, as ROS did until Melodic; "
                "Noetic ignores them, so write <xacro:...>"
            )

    def handle_macro_call(self, node: Any, macros: Any, symbols: Any) -> Any:
        """Expand a macro call, which may lack the prefix if a macro of this name was read."""
        if self._has_warned and node.tagName in self._names:
            _add_prefix(node)
        return self._handle_macro_call(node, macros, symbols)


def _add_prefix(element: Any) -> None:
    element.tagName = element.nodeName = f"xacro:{element.tagName}"
