"""Results that are pictures: a page in a terminal, a view in a notebook."""

from __future__ import annotations

import tempfile
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any

from .tool import Call, Result

if TYPE_CHECKING:
    from optparse import Values


@dataclass(frozen=True, kw_only=True)
class Shown(Result):
    """A view, and in a terminal the page that it was written to."""

    view: Any
    path: Path | None = None

    def __str__(self) -> str:
        return self.view.text if self.path is None else f"{self.view.text}\n\n{self.path}"

    def _repr_mimebundle_(self, include: Any = None, exclude: Any = None) -> Any:
        return self.view._repr_mimebundle_(include, exclude)


def shown(view: Any, name: str, given: Values, call: Call) -> Shown:
    """Write the page that was asked for; in a terminal open one in the browser if none was."""
    if given.output:
        return Shown(view=view, path=view.save(given.output))
    if not call.in_terminal:
        return Shown(view=view)
    import webbrowser

    path = view.save(Path(tempfile.mkdtemp(prefix="rosmini_")) / f"{name}.html")
    webbrowser.open(path.as_uri())
    return Shown(view=view, path=path)
