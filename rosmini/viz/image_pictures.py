"""Pictures of a `sensor_msgs/Image`: in colour, in grey, or in false colours if it contains depths."""

from __future__ import annotations

import io
from typing import TYPE_CHECKING, Any, NamedTuple

from rosmini.core.errors import nearest
from rosmini.core.lazy import np
from rosmini.viz.rounding import fixed
from rosmini.viz.style import LABEL_SIZE, LIGHT
from rosmini.viz.view import Picture, ViewError, matplotlib_picture

if TYPE_CHECKING:
    from numpy.typing import NDArray

    Pixels = NDArray[np.uint8]
    Floats = NDArray[np.float64]

WIDTH = 480
"""Default maximum width of a picture [px]."""

MILLIMETRES = 1e-3


class Encoding(NamedTuple):
    """The form of a pixel: number type, channels, indices of red, green and blue; or metres per unit of depth."""

    kind: str
    channels: int
    order: tuple[int, ...] = ()
    metres: float = 0.0


ENCODINGS = {
    "rgb8": Encoding("u1", 3, (0, 1, 2)),
    "bgr8": Encoding("u1", 3, (2, 1, 0)),
    "8UC3": Encoding("u1", 3, (2, 1, 0)),
    "rgba8": Encoding("u1", 4, (0, 1, 2)),
    "bgra8": Encoding("u1", 4, (2, 1, 0)),
    "8UC4": Encoding("u1", 4, (2, 1, 0)),
    "mono8": Encoding("u1", 1, (0, 0, 0)),
    "8UC1": Encoding("u1", 1, (0, 0, 0)),
    "mono16": Encoding("u2", 1, (0, 0, 0)),
    "32FC1": Encoding("f4", 1, (), 1.0),
    "16UC1": Encoding("u2", 1, (), MILLIMETRES),
    "16SC1": Encoding("i2", 1, (), MILLIMETRES),
    **{f"bayer_{order}8": Encoding("u1", 1, (0, 0, 0)) for order in ("rggb", "bggr", "gbrg", "grbg")},
}
"""Encodings of `sensor_msgs/image_encodings.h` that cameras write (depths: REP 118); Bayer images are shown in grey."""


def image_picture(image: Any, *, title: str | None = None, width: float = WIDTH, far: float | None = None) -> Picture:
    """Show an image; depths go from yellow (near) to blue (far), with a scale, and are grey where nothing was measured.

    Args:
        image: a `sensor_msgs/Image`; or an array: (h, w, 3) of bytes, red, green, blue, or (h, w) of depths [m].
        title: a caption under the picture, and the first words of its text form.
        width: the maximum width of the image [px].
        far: the depth at the end of the scale [m]; by default the largest depth in the image.

    Raises:
        ViewError: it is not an image, or its data do not match its size and encoding.

    """
    if hasattr(image, "encoding"):
        pixels, frame = pixels_of(image), str(image.header.frame_id)
        encoding = str(image.encoding)
    else:
        pixels, frame, encoding = np.asarray(image), "", ""
    if pixels.ndim == 3 and pixels.shape[2] == 3 and pixels.dtype == np.uint8 and pixels.size:
        return _coloured(pixels, _name(title, "image", pixels, encoding, frame), title, width)
    if pixels.ndim == 2 and pixels.dtype.kind == "f" and pixels.size:
        return _deep(pixels.astype(float), _name(title, "depth image", pixels, encoding, frame), title, width, far)
    raise ViewError(
        "an image is a sensor_msgs/Image, or an array of bytes (h, w, 3), or of depths in metres (h, w), "
        f"not {type(image).__name__} {pixels.shape} of {pixels.dtype}"
    )


def pixels_of(message: Any) -> NDArray[Any]:
    """Return the pixels of a `sensor_msgs/Image`: RGB bytes (h, w, 3), or depths [m] (h, w), nan where there is none.

    Raises:
        ViewError: the encoding is unknown, or the amount of data does not match the image's size.

    """
    encoding = ENCODINGS.get(message.encoding)
    if encoding is None:
        hint = nearest(str(message.encoding), ENCODINGS)
        raise ViewError(
            f"the encoding {message.encoding!r} of an image is not supported, only {', '.join(ENCODINGS)}. "
            f"{hint}".rstrip()
        )
    values = values_of(message, encoding)
    if not encoding.order:
        depths = values[..., 0].astype(float) * encoding.metres
        return np.where(values[..., 0] == 0, np.nan, depths) if values.dtype.kind == "u" else depths
    if values.dtype.itemsize == 2:
        values = values >> 8
    return values[..., list(encoding.order)].astype(np.uint8)


def values_of(message: Any, encoding: Encoding) -> NDArray[Any]:
    """Return the raw values (h, w, channels) of a `sensor_msgs/Image` with this encoding.

    Raises:
        ViewError: the amount of data does not match the image's size.

    """
    kind = np.dtype((">" if message.is_bigendian else "<") + encoding.kind)
    height, width, step = int(message.height), int(message.width), int(message.step)
    row = width * encoding.channels * kind.itemsize
    data = np.frombuffer(bytes(message.data), dtype=np.uint8)
    if step < row or len(data) < step * height:
        raise ViewError(
            f"an image of {width} x {height} pixels, {message.encoding}, needs {row} bytes a row, and {row * height} "
            f"in all; its step is {step}, and it has {len(data)} bytes"
        )
    rows = np.ascontiguousarray(data[: step * height].reshape(height, step)[:, :row])
    return rows.view(kind).reshape(height, width, encoding.channels)


def _name(title: str | None, what: str, pixels: NDArray[Any], encoding: str, frame: str) -> str:
    height, width = pixels.shape[:2]
    kind = f", {encoding}" if encoding else ""
    return f"{title or what}: {width} x {height} pixels{kind}{f', in {frame}' if frame else ''}"


def _coloured(pixels: Pixels, name: str, title: str | None, width: float) -> Picture:
    from PIL import Image

    drawn = Image.fromarray(np.ascontiguousarray(pixels))
    if drawn.width > width:
        drawn = drawn.resize((round(width), max(1, round(drawn.height * width / drawn.width))), Image.Resampling.BOX)
    file = io.BytesIO()
    drawn.save(file, format="PNG", optimize=True)
    half = len(pixels) // 2
    above, below = (_colour_of(part) for part in (pixels[:half], pixels[half:]))
    text = f"{name}\nupper half {above}, lower half {below}"
    alt = (
        f"An image of a camera, {pixels.shape[1]} by {pixels.shape[0]} pixels: on average {above} in its upper half, "
        f"{below} in its lower."
    )
    return Picture(file.getvalue(), text=text, alt=alt, caption=title)


def _colour_of(pixels: Pixels) -> str:
    """Name the mean colour of pixels in words that do not change with one grey level more or less."""
    if not pixels.size:
        return "black"
    red, green, blue = pixels.reshape(-1, 3).mean(axis=0)
    bright = (red + green + blue) / 3
    tone = "dark " if bright < 85 else "light " if bright > 170 else ""
    most, least = max(red, green, blue), min(red, green, blue)
    if most - least < 0.12 * max(most, 1.0):
        return f"{tone}grey"
    if red == most:
        hue = "yellow" if green > (most + least) / 2 and most - green < 0.35 * (most - least) else "red"
        hue = "brown" if hue == "yellow" and bright < 150 else hue
    else:
        hue = "green" if green == most else "blue"
    return f"{tone}{hue}"


def _deep(depths: Floats, name: str, title: str | None, width: float, far: float | None) -> Picture:
    measured = np.isfinite(depths)
    share = 100.0 * measured.mean()
    if measured.any():
        low, high = float(depths[measured].min()), float(depths[measured].max())
        said = f"from {fixed(low, 2)} to {fixed(high, 2)} m, measured in {fixed(share, 0)}% of the pixels"
    else:
        low, high, said = 0.0, 1.0, "nothing within reach"
    figure = _depth_figure(depths, measured, max(far or high, 1e-3), width)
    alt = f"An image of depths, {depths.shape[1]} by {depths.shape[0]} pixels: {said}."
    return matplotlib_picture(figure, text=f"{name}\n{said}", alt=alt, form="png", dpi=100.0, caption=title)


def _depth_figure(depths: Floats, measured: NDArray[np.bool_], far: float, width: float) -> Any:
    import matplotlib as mpl
    from matplotlib.figure import Figure

    high, wide = depths.shape
    across = min(float(width), float(wide)) if wide > 160 else 240.0
    up, bar = across * high / wide, 78.0
    with mpl.rc_context({"font.family": "sans-serif", "font.size": LABEL_SIZE * 0.72}):
        figure = Figure(figsize=((across + bar) / 100, up / 100), dpi=100, facecolor=LIGHT["page"])
        axes = figure.add_axes((0.0, 0.0, across / (across + bar), 1.0))
        axes.axis("off")
        colours = mpl.colormaps["viridis_r"].with_extremes(bad=LIGHT["group-line"])
        shown = axes.imshow(
            np.ma.array(depths, mask=~measured),
            cmap=colours,
            vmin=0.0,
            vmax=far,
            interpolation="nearest",
            aspect="auto",
        )
        scale = figure.add_axes((1.0 - (bar - 10) / (across + bar), 0.06, 14 / (across + bar), 0.88))
        strip = figure.colorbar(shown, cax=scale)
        strip.ax.invert_yaxis()
        strip.set_label("depth [m]", color=LIGHT["ink"])
        strip.outline.set_edgecolor(LIGHT["group-line"])
        strip.ax.tick_params(color=LIGHT["group-line"], labelcolor=LIGHT["ink"])
    return figure
