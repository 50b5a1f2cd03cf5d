"""The operations of the tool ``rosparam`` on a Parameter Server, as an object (http://wiki.ros.org/rosparam)."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Any

from rosmini.core.errors import ParameterNotSet, nearest
from rosmini.core.names import canonicalize, join, resolve

from .errors import RosParamException

if TYPE_CHECKING:
    from rosmini.core.peers import Peers

    from .documents import Document

# YAML is imported where it is used: `rosparam list` does not need it, and should be fast.


class ParamClient:
    """Reads and writes the parameters of a graph, as YAML and as values.

    Args:
        graph: the graph with the Parameter Server.
        namespace: the namespace of relative names, as ``ROS_NAMESPACE`` on a command line.

    """

    def __init__(self, graph: Peers, *, namespace: str = "/") -> None:
        self._namespace = canonicalize("/" + namespace)
        self._caller = join(self._namespace, "rosparam")
        self._master = graph.ask_as(self._caller)

    def get(self, name: str) -> Any:
        """Return a parameter's value, or a namespace as a dictionary. Raises ``ParameterNotSet`` if it is not set."""
        resolved = self._resolve(name)
        code, status, value = self._master.call("getParam", resolved)
        if code != 1:
            raise ParameterNotSet(self._missing(status, resolved))
        return value

    def set(self, name: str, text: str) -> None:
        """Set a parameter to the value of a YAML text: ``"0.5"``, ``"[1, 2]"``, ``"{p: 1.0}"``.

        An empty text is the empty string. Raises ``RosParamException`` if the text is not YAML, or for a value that the
        Parameter Server does not support.
        """
        from .documents import parse

        self.upload(name, parse(text) if text else "")

    def upload(self, name: str, value: Any) -> None:
        """Set a parameter to a value; a dictionary is merged into the existing namespace.

        Raises ``RosParamException`` for a value that the Parameter Server does not support.
        """
        from .documents import assignments

        self._send(list(assignments(self._resolve(name), value)))

    def delete(self, name: str) -> None:
        """Delete a parameter or a namespace; ``/`` deletes all parameters. Raises ``ParameterNotSet`` if not set."""
        resolved = self._resolve(name)
        if resolved == "/":
            self._master.ask("setParam", "/", {})
            return
        code, status, _ = self._master.call("deleteParam", resolved)
        if code != 1:
            raise ParameterNotSet(self._missing(status, resolved))

    def list_params(self, namespace: str = "/") -> list[str]:
        """Return the names of all parameters in a namespace, sorted."""
        within = self._resolve(namespace).rstrip("/") + "/"
        return sorted(name for name in self._names() if name.startswith(within))

    def load(self, path: str | Path, namespace: str = "") -> list[str]:
        """Set the parameters of a YAML file in a namespace; return their names.

        Nothing is set if the file contains an error. Raises ``RosParamException``, with file and line.
        """
        from .documents import load_file

        return self._load(load_file(path, self._resolve(namespace)))

    def loads(self, text: str, namespace: str = "", *, source: str = "") -> list[str]:
        """Set the parameters of a YAML text as :meth:`load` does; return their names. Errors call it ``source``."""
        from .documents import load_str

        return self._load(load_str(text, source, self._resolve(namespace)))

    def dumps(self, namespace: str = "/") -> str:
        """Return a parameter or a namespace as YAML. Raises ``ParameterNotSet`` if it is not set."""
        from .documents import dumps

        return dumps(self.get(namespace))

    def dump(self, path: str | Path, namespace: str = "/") -> Path:
        """Write a parameter or a namespace to a YAML file; return its path.

        Raises ``ParameterNotSet`` if it is not set, and ``RosParamException`` if the file cannot be written.
        """
        path, text = Path(path), self.dumps(namespace)
        try:
            path.write_text(text, encoding="utf-8")
        except OSError as error:
            raise RosParamException(f"cannot write this file: {error}", path) from error
        return path

    def _load(self, documents: list[Document]) -> list[str]:
        settings = [setting for document in documents for setting in document.assignments()]
        self._send(settings)
        return [name for name, _ in settings]

    def _send(self, settings: list[tuple[str, Any]]) -> None:
        for name, value in settings:
            code, status, _ = self._master.call("setParam", name, value)
            if code != 1:
                raise RosParamException(f"the Parameter Server refused {name}: {status}")

    def _resolve(self, name: str) -> str:
        return resolve(name, self._namespace, self._caller, what="parameter name", check=False)

    def _names(self) -> list[str]:
        return list(self._master.ask("getParamNames"))

    def _missing(self, status: str, resolved: str) -> str:
        hint = nearest(resolved, self._names())
        return f"{status}; {hint}" if hint else status
