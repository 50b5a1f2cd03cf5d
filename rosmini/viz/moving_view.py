"""The base of pictures that move: a still picture, and in a page a script in its place (see `rosmini.viz.embed`)."""

from __future__ import annotations

from abc import abstractmethod
from collections.abc import Mapping, Sequence
from typing import Any, ClassVar

from rosmini.viz.embed import embed
from rosmini.viz.view import SVG_MIME, View


class MovingView(View):
    """A view that has a still picture, data, and scripts of `rosmini/viz/static/` that show the data."""

    scripts: Sequence[str] = ()
    """Run in this order before the call."""
    assets: ClassVar[tuple[str, ...]] = ()
    """Further files that the scripts may ask for."""
    call: ClassVar[str]
    """The function that shows the data, seen from the global object."""
    usual_name: ClassVar[str] = ""
    """What it is called without a title."""
    title: str | None = None
    """A caption, and the first words of the text form."""

    @property
    def name(self) -> str:
        """What it is called, in a few words."""
        return self.title or self.usual_name

    @property
    @abstractmethod
    def svg(self) -> str:
        """The still picture."""

    @property
    @abstractmethod
    def data(self) -> Mapping[str, Any]:
        """What the scripts get, as JSON; bytes become base64."""

    @property
    @abstractmethod
    def height(self) -> int:
        """The least height of what moves, with its controls [CSS px]."""

    @property
    def fallback(self) -> str:
        """What a page shows without scripts and in print."""
        return self.svg

    def _images(self) -> dict[str, bytes]:
        return {SVG_MIME: self.svg.encode()}

    @property
    def html(self) -> str:
        """What moves: of the book, or self-contained, as `rosmini.viz.book_form.book_form` says."""
        return self._html(None)

    @property
    def page(self) -> str:
        """What moves with all that it needs, for a file of its own."""
        return self._html(book=False)

    def _html(self, book: bool | None) -> str:
        return embed(
            self.scripts, self.call, self.data, title=self.name, alt=self.alt, height=self.height,
            fallback_html=self.fallback, caption=self.title, assets=self.assets, book=book,
        )  # fmt: skip
