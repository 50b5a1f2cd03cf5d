"""The drawing of a pose: an arrow or axes, and its uncertainty."""

from __future__ import annotations

import math
from collections.abc import Iterator
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from rosmini.core.geometry.products import determinant, eigen, matrix_product

from .primitives import INVALID, DisplayError, Floats, Mesh, Primitive
from .properties import Colour, Property
from .shapes import arrow, axes, ball
from .topic_display import Received

RED = Colour(255, 25, 0)
UNKNOWN = 100.0
"""Standard deviation above which it counts as unknown, because drivers write huge variances then [m]."""


def length_property(name: str, default: float) -> Property:
    """Return the property of a length of a shape."""
    return Property(name, default, "a length of the shape", unit="m", minimum=0.0, maximum=1e4)


def pose_properties(prefix: str = "") -> tuple[Property, ...]:
    """Return the properties of an arrow and of axes; with a prefix, in the group of that name."""

    def length(name: str, default: float) -> Property:
        return length_property(f"{prefix}{name}", default)

    return (
        Property("Shape", "Arrow", "how a pose is drawn", choices=("Arrow", "Axes")),
        Property(f"{prefix}Color", RED, "colour of the arrow"),
        Property(f"{prefix}Alpha", 1.0, "opacity", minimum=0.0, maximum=1.0),
        length("Shaft Length", 1.0), length("Shaft Radius", 0.05), length("Head Length", 0.3),
        length("Head Radius", 0.1), length("Axes Length", 1.0), length("Axes Radius", 0.1),
    )  # fmt: skip


COVARIANCE_PROPERTIES = (
    Property("Covariance", True, "show the uncertainty of a pose"),
    Property("Covariance/Position", True, "an ellipsoid with half axes of one standard deviation"),
    Property("Covariance/Position/Color", Colour(204, 51, 204), "colour of the ellipsoid"),
    Property("Covariance/Position/Alpha", 0.3, "opacity", minimum=0.0, maximum=1.0),
    Property("Covariance/Position/Scale", 1.0, "standard deviations", minimum=0.0, maximum=1e4),
    Property("Covariance/Orientation", True, "a sector of the headings, one standard deviation to each side"),
    Property("Covariance/Orientation/Frame", "Local", "frame of the covariance", choices=("Local", "Fixed")),
    Property("Covariance/Orientation/Color Style", "Unique", "one colour, or one per axis", choices=("Unique", "RGB")),
    Property("Covariance/Orientation/Color", Colour(255, 255, 127), "colour of the sector"),
    Property("Covariance/Orientation/Alpha", 0.5, "opacity", minimum=0.0, maximum=1.0),
    Property("Covariance/Orientation/Offset", 1.0, "radius of the sector", unit="m", minimum=0.0, maximum=1e4),
    Property("Covariance/Orientation/Scale", 1.0, "standard deviations", minimum=0.0, maximum=1e4),
)  # fmt: skip


def pose_shape(pose: Floats, display: Any, prefix: str = "") -> Iterator[Primitive]:
    """Draw a pose (4, 4) according to a display's properties."""
    if display["Shape"] == "Axes":
        yield from axes(pose, display[f"{prefix}Axes Length"], display[f"{prefix}Axes Radius"])
        return
    sizes = (display[f"{prefix}{name}"] for name in ("Shaft Length", "Shaft Radius", "Head Length", "Head Radius"))
    yield arrow(pose, display[f"{prefix}Color"].rgba(display[f"{prefix}Alpha"]), *sizes)


def covariance_shape(pose: Floats, covariance: ArrayLike, display: Any, received: Received) -> Iterator[Primitive]:
    """Draw the covariance (36) of x, y, z and rotations about x, y, z at a pose: an ellipsoid and a sector of yaws.

    Raises:
        DisplayError: a value is not finite, or a variance is negative.

    """
    if not display["Covariance"]:
        return
    whole = np.asarray(covariance, dtype=float).reshape(6, 6)
    if not np.isfinite(whole).all():
        raise DisplayError(INVALID)
    group = "Covariance/Position"
    if display[group]:
        values, vectors = eigen((whole[:3, :3] + whole[:3, :3].T) / 2)
        if values.min() < -1e-6 * max(abs(values).max(), 1.0):
            raise DisplayError("Covariance matrix is not positive: it has negative variances")
        if determinant(vectors) < 0:
            vectors[:, 0] *= -1
        sigma = np.sqrt(np.maximum(values, 0.0)) * display[f"{group}/Scale"]
        if (sigma > UNKNOWN).any():
            received.note(f"a standard deviation above {UNKNOWN:g} m, which means unknown, is not drawn")
            sigma[sigma > UNKNOWN] = 0.0
        at = np.eye(4)
        at[:3, :3], at[:3, 3] = matrix_product(pose[:3, :3], vectors), pose[:3, 3]
        colour = display[f"{group}/Color"].rgba(display[f"{group}/Alpha"])
        if sigma.max() > 1e-9:
            yield ball(at, colour, np.maximum(2.0 * sigma, 1e-3))
    group = "Covariance/Orientation"
    spread = math.sqrt(max(float(whole[5, 5]), 0.0)) * display[f"{group}/Scale"]
    if display[group] and spread > 1e-9:
        colour = display[f"{group}/Color"].rgba(display[f"{group}/Alpha"])
        yield sector(pose, colour, min(spread, math.pi), display[f"{group}/Offset"])


def sector(pose: Floats, colour: Floats, half: float, radius: float) -> Mesh:
    """Return a sector of a disc around the x axis of a pose, `half` [rad] to each side, visible from both sides."""
    angles = np.linspace(-half, half, 17)
    rim = np.column_stack([np.cos(angles), np.sin(angles), np.zeros(len(angles))]) * radius
    first = np.arange(1, len(angles))
    faces = np.column_stack([np.zeros_like(first), first, first + 1])
    return Mesh(np.vstack([np.zeros((1, 3)), rim]), faces, colour, pose, lit=False)
