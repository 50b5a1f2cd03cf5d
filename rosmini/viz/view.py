"""The display funnel: every picture in rosmini is a view, and a view has three forms.

| form | contents | shown by |
|---|---|---|
| text | the meaning of the picture, in a few lines | a terminal (`print(view)`), and nbval, which compares it |
| image | SVG or PNG | files, GitHub, LaTeX, Jupyter's image viewers |
| HTML | a `<figure>` with picture and alt text, offline, without external scripts | Jupyter and the built book |

Jupyter and myst-nb both prefer `text/html` to an image. This is the only way for alt text to reach the page: an
`image/svg+xml` output becomes an `<img>` without it. An inline SVG also follows the light or dark theme of its page.
A PNG has no HTML form, because nbval compares `text/html` byte by byte and PNG bytes differ between machines; its
alt text is in the output's metadata, and `rosmini.viz.alt_text` adds it to the page when the book is built.
"""

from __future__ import annotations

import base64
from abc import ABC, abstractmethod
from collections.abc import Collection, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any, Literal

from rosmini.core.errors import RosminiError
from rosmini.viz.svg import element, escape

if TYPE_CHECKING:
    from matplotlib.figure import Figure

SVG_MIME = "image/svg+xml"
PNG_MIME = "image/png"

MimeBundle = tuple[dict[str, str], dict[str, dict[str, Any]]]


class ViewError(RosminiError, ValueError):
    """A picture cannot be made or saved as requested."""


class View(ABC):
    """Something to show. `repr` and `print` give its text form; at the end of a notebook cell it displays itself."""

    @property
    @abstractmethod
    def text(self) -> str:
        """The meaning of the picture: complete, sorted, rounded, the same at each run."""

    @property
    @abstractmethod
    def alt(self) -> str:
        """A description in one or two sentences, for people who cannot see the picture. Never empty."""

    @abstractmethod
    def _images(self) -> dict[str, bytes]:
        """Return the picture's bytes by mime type, the preferred one first."""

    @property
    def html(self) -> str | None:
        """The form for pages; None if the image alone is better."""
        return None

    @property
    def page(self) -> str | None:
        """The form for a separate file, always self-contained."""
        return self.html

    def __repr__(self) -> str:
        return self.text

    def _repr_mimebundle_(
        self, include: Collection[str] | None = None, exclude: Collection[str] | None = None
    ) -> MimeBundle:
        """Return all forms for Jupyter; the metadata contain the alt text, and captions of images without HTML form."""
        data: dict[str, str] = {"text/plain": self.text}
        metadata: dict[str, dict[str, Any]] = {}
        for mime, content in self._images().items():
            data[mime] = content.decode() if mime == SVG_MIME else base64.b64encode(content).decode()
            metadata[mime] = self._about_image()
        if self.html is not None:
            data["text/html"] = self.html
        wanted = [mime for mime in data if (not include or mime in include) and (not exclude or mime not in exclude)]
        return {m: data[m] for m in wanted}, {m: metadata[m] for m in wanted if m in metadata}

    def _about_image(self) -> dict[str, str]:
        """Return the metadata of an image."""
        return {"alt": self.alt}

    def save(self, path: str | Path) -> Path:
        """Write the picture to a file, in the format of the file's suffix, and return its path.

        Raises:
            ViewError: the picture has no such form (the message lists those that it has), or the file cannot be
                written.

        """
        path = Path(path)
        forms = {_SUFFIX[mime]: content for mime, content in self._images().items()}
        forms[".txt"] = (self.text + "\n").encode()
        if self.page is not None:
            forms[".html"] = _page(self.page, self.text.partition("\n")[0]).encode()
        if path.suffix.lower() not in forms:
            raise ViewError(
                f"cannot save {path.name!r}: a {type(self).__name__} has no form for the suffix "
                f"{path.suffix!r}. Use one of {', '.join(sorted(forms))}."
            )
        try:
            path.write_bytes(forms[path.suffix.lower()])
        except OSError as error:
            raise ViewError(f"cannot write {path}: {error.strerror}") from error
        return path


_SUFFIX = {SVG_MIME: ".svg", PNG_MIME: ".png"}


def _page(figure: str, title: str) -> str:
    return (
        f'<!DOCTYPE html>\n<html lang="en">\n<head><meta charset="utf-8"><title>{escape(title)}</title></head>\n'
        f"<body>\n{figure}\n</body>\n</html>\n"
    )


class Picture(View):
    """A finished still picture: SVG text or the bytes of a PNG, with its text form and its alt text.

    Raises:
        ViewError: the text or the alt text is empty, or the image is neither SVG nor PNG.

    """

    def __init__(self, image: str | bytes, *, text: str, alt: str, caption: str | None = None) -> None:
        if not text.strip():
            raise ViewError("a picture needs a text form: it is what a notebook's test compares, so say what it shows")
        if not alt.strip():
            raise ViewError("a picture needs alt text: one sentence that says what it shows to those who cannot see it")
        if isinstance(image, str) and not image.startswith("<svg"):
            raise ViewError("an SVG picture must begin with its <svg> element")
        if isinstance(image, bytes) and not image.startswith(b"\x89PNG\r\n\x1a\n"):
            raise ViewError("a picture given as bytes must be a PNG")
        self._image = image
        self._text = text
        self._alt = alt
        self.caption = caption

    @property
    def text(self) -> str:
        """The meaning of the picture, as given."""
        return self._text

    @property
    def alt(self) -> str:
        """The description, as given."""
        return self._alt

    @property
    def svg(self) -> str | None:
        """The SVG text; None for a PNG."""
        return self._image if isinstance(self._image, str) else None

    def _images(self) -> dict[str, bytes]:
        if isinstance(self._image, str):
            return {SVG_MIME: self._image.encode()}
        return {PNG_MIME: self._image}

    def _about_image(self) -> dict[str, str]:
        # the caption of an SVG is in its HTML form; a PNG has none, because its bytes differ between machines
        own = {"caption": self.caption} if self.caption and self.svg is None else {}
        return {"alt": self.alt, **own}

    @property
    def html(self) -> str | None:
        """A `<figure>` around the inline SVG, with the caption; None for a PNG."""
        if self.svg is None:
            return None
        caption = element("figcaption", escape(self.caption)) if self.caption else ""
        return element("figure", self.svg + caption, class_="rosmini-figure", style="margin:0.5em 0;overflow-x:auto")


class Views(View):
    """Several views, one below the other."""

    def __init__(self, views: Sequence[View]) -> None:
        self._views = tuple(views)

    @property
    def text(self) -> str:
        """Their texts."""
        return "\n".join(view.text for view in self._views)

    @property
    def alt(self) -> str:
        """Their descriptions, with numbers."""
        return " ".join(f"{i}. {view.alt}" for i, view in enumerate(self._views, 1))

    def _images(self) -> dict[str, bytes]:
        return {}

    @property
    def html(self) -> str:
        """Their forms for pages."""
        return "".join(view.html or "" for view in self._views)


def matplotlib_picture(
    figure: Figure,
    *,
    text: str,
    alt: str,
    form: Literal["png", "svg"] = "png",
    dpi: float = 110.0,
    caption: str | None = None,
    adapt: bool = False,
    under: str = "",
    steady: Collection[str] = (),
) -> Picture:
    """Return a picture of a matplotlib figure in the house style (`rosmini.viz.themed`), without date and random ids.

    An SVG follows the theme of its page where it uses black, white or colours of `rosmini.viz.style.LIGHT` (see
    `rosmini.viz.themed`), and with `adapt` also where it uses other colours; text is for DejaVu Sans. `under` are
    SVG elements below all others, such as the image of a map, and `steady` the colours of the palette that stay as on
    a light page, to match it. A PNG has `dpi` dots per inch. Make the figure with `matplotlib.figure.Figure`, or
    Jupyter's inline backend shows it as well.

    Raises:
        ViewError: the alt text or the text form is empty.

    """
    from io import BytesIO

    import matplotlib as mpl

    from rosmini.viz.themed import apply_house_style, themed_svg

    apply_house_style(figure)
    file = BytesIO()
    with mpl.rc_context({"svg.hashsalt": "rosmini", "svg.fonttype": "none"}):
        metadata = {"Date": None} if form == "svg" else {"Software": None}
        figure.savefig(file, format=form, dpi=dpi, metadata=metadata)
    if form == "png":
        return Picture(file.getvalue(), text=text, alt=alt, caption=caption)
    title = text.partition("\n")[0]
    svg = themed_svg(file.getvalue().decode(), title=title, alt=alt, adapt=adapt, under=under, steady=steady)
    return Picture(svg, text=text, alt=alt, caption=caption)
