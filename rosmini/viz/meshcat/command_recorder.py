"""meshcat without a server: a window that records the commands of a `meshcat.Visualizer`.

No server starts and no window opens. meshcat names objects by random UUIDs; here they are numbered, and numbers
have single precision, like on the graphics card. So the same calls give the same bytes.
"""

from __future__ import annotations

import re
import warnings
from types import ModuleType
from typing import Any

_UUID = re.compile(r"[0-9a-f]{8}(?:-[0-9a-f]{4}){3}-[0-9a-f]{12}")

# Defaults of three.js that meshcat repeats for each material: half of the bytes of a small object.
_PLAIN: dict[str, Any] = {
    "transparent": False, "opacity": 1.0, "linewidth": 1.0, "wireframe": False, "wireframeLinewidth": 1.0,
    "vertexColors": 0, "reflectivity": 0.5, "normalized": False,
}  # fmt: skip


def meshcat() -> ModuleType:
    """Return the package meshcat, imported on first use (it takes a third of a second).

    Raises:
        ViewError: it is not installed.

    """
    with warnings.catch_warnings():
        # It imports zmq.eventloop.ioloop, which pyzmq has deprecated, for a server that is not started here.
        warnings.simplefilter("ignore", DeprecationWarning)
        try:
            import meshcat.animation
            import meshcat.geometry
        except ImportError as error:
            from rosmini.viz.view import ViewError

            raise ViewError("3D pictures need meshcat, which is not installed here: `pip install meshcat`") from error
    module: ModuleType = meshcat
    return module


class Recorder:
    """A window for a `meshcat.Visualizer` that records commands: `Visualizer(window=Recorder())`."""

    def __init__(self) -> None:
        self.commands: list[bytes] = []
        """The commands, each packed in the viewer's format."""
        self._names: dict[str, str] = {}

    def send(self, command: Any) -> None:
        """Record a command of meshcat."""
        self._keep(command.lower())

    def set_property(self, path: str, name: str, *, value: bool) -> None:
        """Set a property of three.js with a capital in its name, which meshcat's own `set_property` would lowercase."""
        self._keep({"type": "set_property", "path": path, "property": name, "value": value})

    def take(self) -> list[bytes]:
        """Return the commands since the last call."""
        sent, self.commands, self._names = self.commands, [], {}
        return sent

    def open(self) -> None:
        """Do nothing: the scene is shown by its view."""

    def _keep(self, command: dict[str, Any]) -> None:
        import umsgpack  # type: ignore[import-untyped]

        self.commands.append(umsgpack.packb(self._stable(command), force_float_precision="single"))

    def _stable(self, value: Any) -> Any:
        if isinstance(value, dict):
            return {
                key: self._stable(content)
                for key, content in value.items()
                if key not in _PLAIN or content != _PLAIN[key]
            }
        if isinstance(value, list | tuple):
            return [self._stable(content) for content in value]
        if isinstance(value, str):
            return self._names.setdefault(value, str(len(self._names))) if _UUID.fullmatch(value) else value
        if isinstance(value, float):
            return round(float(value), 6) + 0.0
        return value
