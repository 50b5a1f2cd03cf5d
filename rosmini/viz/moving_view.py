"""The base of moving pictures: a still picture that a script replaces in a page (see `rosmini.viz.embed`)."""

from __future__ import annotations

from abc import abstractmethod
from collections.abc import Mapping, Sequence
from typing import Any, ClassVar

from rosmini.viz.embed import embed
from rosmini.viz.view import SVG_MIME, View


class MovingView(View):
    """A view with a still picture, data, and scripts of `rosmini/viz/static/` that show the data."""

    scripts: Sequence[str] = ()
    """Scripts that run in this order before the call."""
    assets: ClassVar[tuple[str, ...]] = ()
    """Further files that the scripts may ask for."""
    call: ClassVar[str]
    """The JavaScript function that shows the data, as seen from the global object."""
    usual_name: ClassVar[str] = ""
    """The name used without a title."""
    title: str | None = None
    """A caption, and the first words of the text form."""

    @property
    def name(self) -> str:
        """The name, in a few words."""
        return self.title or self.usual_name

    @property
    @abstractmethod
    def svg(self) -> str:
        """The still picture."""

    @property
    @abstractmethod
    def data(self) -> Mapping[str, Any]:
        """The data for the scripts, as JSON; bytes become base64."""

    @property
    @abstractmethod
    def height(self) -> int:
        """The minimum height of the moving picture, with its controls [CSS px]."""

    @property
    def fallback(self) -> str:
        """The HTML that a page shows without scripts and in print."""
        return self.svg

    def _images(self) -> dict[str, bytes]:
        return {SVG_MIME: self.svg.encode()}

    @property
    def html(self) -> str:
        """The moving picture: for the book or self-contained, according to `rosmini.viz.book_form.book_form`."""
        return self._html(None)

    @property
    def page(self) -> str:
        """The moving picture with everything that it needs, for a separate file."""
        return self._html(book=False)

    def _html(self, book: bool | None) -> str:
        return embed(
            self.scripts, self.call, self.data, title=self.name, alt=self.alt, height=self.height,
            fallback_html=self.fallback, caption=self.title, assets=self.assets, book=book,
        )  # fmt: skip
