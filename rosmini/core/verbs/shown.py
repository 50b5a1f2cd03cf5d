"""Results with a picture: a page in a terminal, a view in a notebook."""

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
    """A view, and in a terminal the page that it was saved to."""

    view: Any
    path: Path | None = None

    def __str__(self) -> str:
        return self.view.text if self.path is None else f"{self.view.text}\n\n{self.path}"

    def _repr_mimebundle_(self, include: Any = None, exclude: Any = None) -> Any:
        return self.view._repr_mimebundle_(include, exclude)


def shown(view: Any, name: str, given: Values, call: Call) -> Shown:
    """Save the view to the requested page; in a terminal, open a temporary page in the browser by default."""
    if given.output:
        return Shown(view=view, path=view.save(given.output))
    if not call.in_terminal:
        return Shown(view=view)
    import webbrowser

    path = view.save(Path(tempfile.mkdtemp(prefix="rosmini_")) / f"{name}.html")
    webbrowser.open(path.as_uri())
    return Shown(view=view, path=path)
