"""For the built book: give images in notebook outputs the alt text and the caption from their metadata.

myst-nb writes an `image/png` output as an image without alt text. It loads this class through the entry point group
`myst_nb.mime_renderers`; a view's image brings `{"alt": ..., "caption": ...}` in the metadata of its output.
"""

from __future__ import annotations

from html import escape
from typing import TYPE_CHECKING, Any, ClassVar

if TYPE_CHECKING:
    from docutils import nodes


class AltText:
    """A mime renderer for myst-nb that lets myst-nb render an image, then adds its alt text and caption."""

    mime_priority_overrides: ClassVar[list[tuple[str, str, int | None]]] = []

    @staticmethod
    def handle_mime(renderer: Any, data: Any, inline: bool) -> list[nodes.Element] | None:
        """Render an image with alt text in its metadata, as a figure if it has a caption; None for anything else."""
        if data.mime_type not in {"image/png", "image/svg+xml"}:
            return None
        own = data.output_metadata.get(data.mime_type, {})
        alt, caption = own.get("alt"), own.get("caption")
        if not alt:
            return None
        rendered: list[nodes.Element] = renderer.render_image_inline(data) if inline else renderer.render_image(data)
        for image in rendered:
            image.setdefault("alt", alt)
        return _figure(rendered, caption) if caption and not inline else rendered


def _figure(images: list[nodes.Element], caption: str) -> list[nodes.Element]:
    """Wrap images in the same figure element as SVG pictures: Sphinx would number a figure of its own kind."""
    from docutils import nodes

    begin = nodes.raw("", '<figure class="rosmini-figure">', format="html")
    end = nodes.raw("", f"<figcaption>{escape(caption)}</figcaption></figure>", format="html")
    return [begin, *images, end]
