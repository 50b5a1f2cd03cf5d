"""Base class of the live notebook views: the pad, the simulation view and the rqt panels."""

from __future__ import annotations

from abc import abstractmethod
from collections.abc import Collection
from typing import Any

from rosmini.core.graph.notebook import has_reader
from rosmini.viz.embed import book_form, page_form
from rosmini.viz.view import MimeBundle, View


class LiveView(View):
    """A view that is a widget in a notebook with a reader, and a page or picture elsewhere."""

    _link: Any = None

    @abstractmethod
    def _new_link(self) -> Any:
        """Create the link between the kernel and the page."""

    @property
    def link(self) -> Any:
        """The link between this view and its page in a live notebook. Raises `RosminiError` without anywidget."""
        if self._link is None:
            self._link = self._new_link()
        return self._link

    def _repr_mimebundle_(
        self, include: Collection[str] | None = None, exclude: Collection[str] | None = None
    ) -> MimeBundle:
        if not page_form() and (book_form() or not has_reader()):
            return super()._repr_mimebundle_(include, exclude)
        data, metadata = self.link.widget._repr_mimebundle_() or ({}, {})
        return {**data, "text/plain": self.text}, metadata
