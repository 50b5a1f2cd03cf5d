"""The primitives that displays draw: a small closed set, in the fixed frame, in metres (REP 103), finite and bounded.

A display turns messages into primitives, and `flat` and `solid` turn those into pictures. So a display need not know
SVG or meshcat, and a picture need not know messages. Shapes made of primitives (arrows, axes, boxes) are in `shapes`.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal

import numpy as np
from numpy.typing import ArrayLike, NDArray

from rosmini.core.errors import RosminiError
from rosmini.core.geometry.products import matrix_product

Floats = NDArray[np.float64]
Ints = NDArray[np.int64]
Pixels = NDArray[np.uint8]
Style = Literal["Points", "Squares", "Flat Squares", "Spheres", "Boxes", "Tiles"]

MAX_POINTS = 2_000_000
"""Maximum number of points, vertices or pixels of a primitive; displays thin larger ones."""

MAX_TEXT = 1000
MAX_DISTANCE = 1e7
"""Maximum distance of drawn things [m]: beyond it, single precision no longer resolves centimetres."""

INVALID = "Message contained invalid floating point values (nans or infs)"
"""RViz's text for such a message."""


class DisplayError(RosminiError, ValueError):
    """A display cannot show its input; the error's text becomes the display's status."""


def finite(values: ArrayLike, width: int) -> Floats:
    """Return `values` as an array (n, width) of finite numbers.

    Raises:
        DisplayError: values are not finite, too far away or too many, or the shape is wrong.

    """
    array = np.asarray(values, dtype=np.float64)
    if array.size == 0:
        return np.empty((0, width))
    if array.ndim != 2 or array.shape[1] != width:
        raise DisplayError(f"an array of shape (n, {width}) is needed, not {array.shape}")
    if len(array) > MAX_POINTS:
        raise DisplayError(f"{len(array)} points are too many to draw: at most {MAX_POINTS}")
    if not np.isfinite(array).all():
        raise DisplayError(INVALID)
    if np.abs(array).max() > MAX_DISTANCE:
        raise DisplayError(f"a coordinate is larger than {MAX_DISTANCE:g} m")
    return array


def rgba(colours: ArrayLike, count: int) -> Floats:
    """Return colours as (4,) for all, or (count, 4): red, green, blue, opacity, clipped to the range 0 to 1.

    Raises:
        DisplayError: values are not finite, or their number is wrong.

    """
    array = np.asarray(colours, dtype=np.float64)
    if array.shape not in {(4,), (count, 4)}:
        raise DisplayError(f"colours must have the shape (4,) or ({count}, 4), not {array.shape}")
    if not np.isfinite(array).all():
        raise DisplayError(INVALID)
    return np.clip(array, 0.0, 1.0)


@dataclass(frozen=True, eq=False)
class Points:
    """Points (n, 3) [m], each drawn in a `style`; `size` is in pixels for "Points", in metres for other styles."""

    points: Floats
    colours: Floats
    """(4,) or (n, 4)"""
    size: float = 0.01
    style: Style = "Flat Squares"

    def __post_init__(self) -> None:
        object.__setattr__(self, "points", finite(self.points, 3))
        object.__setattr__(self, "colours", rgba(self.colours, len(self.points)))
        object.__setattr__(self, "size", _length(self.size, "the size of points"))


@dataclass(frozen=True, eq=False)
class Lines:
    """Lines: a strip through points (n, 3) [m], or, without `strip`, a segment for each pair of points."""

    points: Floats
    colours: Floats
    """(4,), or (n, 4) for each point; a segment has the colour of its first."""
    width: float = 0.0
    """Width [m]; 0 for one pixel."""
    strip: bool = True

    def __post_init__(self) -> None:
        points = finite(self.points, 3)
        if not self.strip and len(points) % 2:
            raise DisplayError(f"segments need an even number of points, not {len(points)}")
        object.__setattr__(self, "points", points)
        object.__setattr__(self, "colours", rgba(self.colours, len(points)))
        object.__setattr__(self, "width", _length(self.width, "the width of lines"))

    def segments(self) -> Floats:
        """The segments (m, 2, 3)."""
        if not self.strip:
            return self.points.reshape(-1, 2, 3)
        return np.stack([self.points[:-1], self.points[1:]], axis=1)

    def segment_colours(self) -> Floats:
        """The colours of the segments: (4,) or (m, 4)."""
        if self.colours.ndim == 1:
            return self.colours
        return self.colours[:-1] if self.strip else self.colours[::2]


@dataclass(frozen=True, eq=False)
class Mesh:
    """Triangles: vertices (n, 3) [m] in the frame `pose` (4, 4), and faces (m, 3), counter-clockwise from outside.

    The viewer in three dimensions stores meshes with equal vertices and faces only once, whatever their poses.
    """

    vertices: Floats
    faces: Ints
    colours: Floats
    """(4,), or (m, 4) for each face."""
    pose: Floats | None = None
    """None if the vertices are in the fixed frame."""
    lit: bool = True
    """True if faces towards the light are brighter."""

    def __post_init__(self) -> None:
        vertices = finite(self.vertices, 3)
        faces = np.asarray(self.faces, dtype=np.int64).reshape(-1, 3)
        if len(faces) and not (faces.min() >= 0 and faces.max() < len(vertices)):
            raise DisplayError(f"a face refers to a vertex that does not exist; there are {len(vertices)}")
        object.__setattr__(self, "vertices", vertices)
        object.__setattr__(self, "faces", faces)
        object.__setattr__(self, "colours", rgba(self.colours, len(faces)))
        if self.pose is not None:
            object.__setattr__(self, "pose", finite(self.pose, 4))

    @property
    def placed(self) -> Floats:
        """The vertices (n, 3) in the fixed frame."""
        if self.pose is None:
            return self.vertices
        return matrix_product(self.vertices, self.pose[:3, :3].T) + self.pose[:3, 3]


@dataclass(frozen=True, eq=False)
class Texture:
    """A flat picture: `pixels` (h, w, 4) of bytes over a rectangle `size` [m] from the origin of `pose` (4, 4).

    Columns go along x and rows along y of the pose, so the first row is that at y = 0, as in an OccupancyGrid.
    """

    pixels: Pixels
    size: tuple[float, float]
    pose: Floats
    behind: bool = False
    """True to draw it before everything else."""

    def __post_init__(self) -> None:
        pixels = np.asarray(self.pixels, dtype=np.uint8)
        if pixels.ndim != 3 or pixels.shape[2] != 4 or not pixels.size:
            raise DisplayError(f"pixels must have the shape (h, w, 4), not {pixels.shape}")
        if pixels.shape[0] * pixels.shape[1] > MAX_POINTS:
            raise DisplayError(f"{pixels.shape[1]} x {pixels.shape[0]} pixels are too many to draw: thin them")
        object.__setattr__(self, "pixels", pixels)
        object.__setattr__(self, "pose", finite(self.pose, 4))
        width, height = (_length(side, "the side of a picture") for side in self.size)
        object.__setattr__(self, "size", (width, height))

    @property
    def corners(self) -> Floats:
        """The corners (4, 3) in the fixed frame: at the origin, along x, opposite, along y."""
        width, height = self.size
        flat = np.array([(0, 0, 0), (width, 0, 0), (width, height, 0), (0, height, 0)], dtype=float)
        return matrix_product(flat, self.pose[:3, :3].T) + self.pose[:3, 3]


@dataclass(frozen=True, eq=False)
class Text:
    """A text that always faces the viewer, around a point (3,) [m]; `height` is the height of a capital letter [m]."""

    text: str
    position: Floats
    height: float
    colour: Floats
    """(4,)"""

    def __post_init__(self) -> None:
        object.__setattr__(self, "text", self.text[:MAX_TEXT])
        object.__setattr__(self, "position", finite(np.reshape(self.position, (1, -1)), 3)[0])
        object.__setattr__(self, "colour", rgba(self.colour, 0))
        object.__setattr__(self, "height", _length(self.height, "the height of text"))


Primitive = Points | Lines | Mesh | Texture | Text


@dataclass(frozen=True, eq=False)
class Pane:
    """A picture beside the scene, like the window of an Image display: pixels (h, w, 3) of bytes, and a caption."""

    title: str
    pixels: Pixels
    text: str = ""
    overlay: str = ""
    """SVG that is drawn over the pixels."""


def _length(value: float, what: str) -> float:
    value = float(value)
    if not 0.0 <= value <= MAX_DISTANCE:
        raise DisplayError(f"{what} must be 0 to {MAX_DISTANCE:g}, not {value:g}")
    return value
