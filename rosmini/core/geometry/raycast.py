"""What a flat laser sees: rays against line segments and discs.

`raycast` uses numpy first, and machine code once that pays and numba is installed. Both return the same ranges, to the
last bit: they get the same directions and do the same arithmetic in the same order. `backend` returns the name of one.
"""

from __future__ import annotations

import logging
import math
import os
from collections.abc import Callable
from functools import cache
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from rosmini.core.errors import RosminiError, nearest

from . import raycast_numpy
from .angles import cos_sin, normalize_angle
from .errors import GeometryError
from .machine_code import Deferral

Floats = NDArray[np.float64]
Ints = NDArray[np.int64]

VARIABLE = "ROSMINI_RAYCAST"
"""The environment variable that chooses a backend where the caller does not."""

BACKENDS = ("numba", "numpy")

MANY_RAYS = 50_000
"""From this number of rays a second numba casts them in wall time; numpy takes about 1 us for one."""

EVERY: Ints = np.empty((0, 2), dtype=np.int64)
"""No rows: each thing concerns every ray."""


class BackendMissing(RosminiError):
    """A backend was asked for by name that is not installed."""


def raycast(
    segments: ArrayLike,
    discs: ArrayLike,
    x: float,
    y: float,
    angle_min: float,
    angle_increment: float,
    count: int,
    max_range: float,
    *,
    backend: str | None = None,
) -> Floats:
    """How far it is from (x, y) to the nearest thing in each of `count` directions (count,).

    Inf if nothing is within `max_range`. `segments` (n, 4) are walls without thickness, each x1, y1, x2, y2; `discs`
    (m, 3) are solid, each x, y, radius. Both may be empty. Ray i looks to `angle_min + i * angle_increment`; the
    increment may be negative, and the rays may cover less or more than one turn. All of it is in one frame, in metres
    and radians.

    Ends belong to their segment, and 1 nm beyond them still counts, so no ray slips between two walls whose common
    corner was rounded. Of a wall that a ray runs along it meets the near end. A sensor in or on a disc, or on a wall,
    sees 0 all around. A segment of no length is a point.

    `backend` is "numba" or "numpy"; without it the environment variable `ROSMINI_RAYCAST` decides, and without that
    the number of rays cast so far, if numba is installed.

    Raises `GeometryError` for a number that is nan or infinite (`max_range` may be infinite),
    a negative radius, range or count or an array of another shape, and `BackendMissing` for "numba" without numba.
    """
    walls, pillars = _tables(segments, discs)
    if not math.isfinite(x + y + angle_min + angle_increment):
        given = f"x={x}, y={y}, angle_min={angle_min}, angle_increment={angle_increment}"
        msg = f"a ray starts at a place and looks somewhere, not {given}"
        raise GeometryError(msg)
    if not (max_range >= 0 and count >= 0):
        msg = f"max_range ({max_range}) and count ({count}) are 0 or more"
        raise GeometryError(msg)
    cast = _kernel(_chosen(backend, count))
    ranges = np.full(count, np.inf)
    if not count:
        return ranges
    step = normalize_angle(float(angle_increment))
    angles = normalize_angle(float(angle_min)) + step * np.arange(count)
    if step < 0:
        angles = angles[::-1].copy()
    here = np.zeros(count)
    cast(
        walls,
        pillars,
        float(x),
        float(y),
        np.cos(angles),
        np.sin(angles),
        float(angles[0]),
        abs(step),
        float(max_range),
        ranges,
        here,
        here,
        0.0,
        0.0,
        EVERY,
        EVERY,
    )
    return ranges[::-1].copy() if step < 0 else ranges


def raycast_each(
    segments: ArrayLike,
    discs: ArrayLike,
    origins: ArrayLike,
    angles: ArrayLike,
    max_range: float,
    *,
    segment_rays: ArrayLike | None = None,
    disc_rays: ArrayLike | None = None,
    backend: str | None = None,
) -> Floats:
    """As `raycast`, with an origin for each ray, `origins` (n, 2), and a direction, `angles` (n,).

    It is as fast if the places are near to one another, and the angles nearly evenly spaced and not wrapped: those of a
    laser that turns while it is carried. `segment_rays` (k, 2) says for each segment from which ray on, and before
    which, it is there; `disc_rays` for each disc; without them they are there for all. Raises what `raycast` raises.
    """
    walls, pillars = _tables(segments, discs)
    places, looks = _table(origins, 2, "origins"), np.array(angles, dtype=np.float64)
    count = len(looks)
    if looks.shape != (len(places),) or not np.isfinite(looks).all():
        msg = f"rays need finite angles (n,) and origins (n, 2), not {looks.shape} and {places.shape}"
        raise GeometryError(msg)
    if not max_range >= 0:
        raise GeometryError(f"max_range ({max_range}) is 0 or more")
    spans = [_spans(segment_rays, len(walls), count), _spans(disc_rays, len(pillars), count)]
    cast = _kernel(_chosen(backend, count))
    ranges = np.full(count, np.inf)
    if not count:
        return ranges
    back = bool(looks[-1] < looks[0])
    if back:
        places, looks = places[::-1], looks[::-1]
        spans = [count - span[:, ::-1] for span in spans]
    x, y = places[count // 2].tolist()
    dx, dy = places[:, 0] - x, places[:, 1] - y
    step = float(looks[-1] - looks[0]) / max(count - 1, 1)
    even = looks[0] + step * np.arange(count)
    cast(
        walls,
        pillars,
        x,
        y,
        *cos_sin(looks),
        float(normalize_angle(looks[0])),
        step,
        float(max_range),
        ranges,
        dx,
        dy,
        float(np.sqrt(dx * dx + dy * dy).max()),
        float(np.abs(looks - even).max()),
        *(np.ascontiguousarray(span) for span in spans),
    )
    return ranges[::-1].copy() if back else ranges


def backend(rays: int) -> str:
    """The backend that `raycast` uses by default, "numba" or "numpy"; counts these rays as work to do."""
    return _chosen(None, rays)


class _Lasers(Deferral):
    """Decides when the rays of lasers are cast in machine code."""

    rays_per_second = 0.0
    """Of the lasers in wall time."""


_LASERS = _Lasers()


def expect(rays_per_second: float) -> None:
    """Prepare for one more laser in wall time, where nothing is compiled while robots drive."""
    _LASERS.rays_per_second += rays_per_second
    _LASERS.held = _LASERS.rays_per_second < MANY_RAYS
    if not _LASERS.held:
        _LASERS.force()


def _tables(segments: ArrayLike, discs: ArrayLike) -> tuple[Floats, Floats]:
    walls, pillars = _table(segments, 4, "segments"), _table(discs, 3, "discs")
    if len(pillars) and pillars[:, 2].min() < 0:
        row = int(pillars[:, 2].argmin())
        msg = f"disc {row} has the radius {pillars[row, 2]}; a radius is 0 or more"
        raise GeometryError(msg)
    return walls, pillars


def _spans(rays: ArrayLike | None, size: int, count: int) -> Ints:
    """For each of `size` things from which of `count` rays on, and before which, it is there."""
    if rays is None:
        return EVERY
    spans = np.array(rays, dtype=np.int64).reshape(-1, 2)
    if len(spans) != size or (size and (spans.min() < 0 or spans.max() > count)):
        wanted = f"an array ({size}, 2) of numbers from 0 to {count}"
        msg = f"which rays see each of {size} things is {wanted}, not {spans.shape}"
        raise GeometryError(msg)
    return spans


def _table(rows: ArrayLike, width: int, what: str) -> Floats:
    """The rows as a finite, contiguous array (n, width)."""
    table = np.ascontiguousarray(rows, dtype=np.float64)
    if not table.size:
        return table.reshape(0, width)
    if table.ndim != 2 or table.shape[1] != width:
        msg = f"{what} are an array (n, {width}), not {table.shape}"
        raise GeometryError(msg)
    # One number tells it nearly always, and faster than n.
    if not math.isfinite(table.sum()) and not np.isfinite(table).all():
        row = int(np.flatnonzero(~np.isfinite(table).all(axis=1))[0])
        msg = f"row {row} of {what} is not finite: {table[row].tolist()}"
        raise GeometryError(msg)
    return table


def _chosen(name: str | None, rays: int) -> str:
    wanted = name or os.environ.get(VARIABLE)
    if not wanted:
        return "numba" if _LASERS.due(rays) and _numba() is not None else "numpy"
    if wanted not in BACKENDS:
        source = "" if name else f" (from the environment variable {VARIABLE})"
        there = " and ".join(BACKENDS)
        msg = (
            f"there is no raycast backend {wanted!r}{source}; there are {there}. {nearest(wanted, BACKENDS)}"
        )
        raise GeometryError(msg.rstrip())
    return wanted


@cache
def _numba() -> Any:
    """The module with the compiled kernel, or None without numba."""
    try:
        import numba  # noqa: F401
    except ModuleNotFoundError:
        return None
    except ImportError as error:  # numba refuses to work with a numpy that is newer than it knows
        logging.getLogger(__name__).warning("numba cannot be used, numpy casts the rays instead: %s", error)
        return None
    from . import raycast_numba

    return raycast_numba


@cache
def _kernel(name: str) -> Callable[..., None]:
    if name == "numpy":
        return raycast_numpy.cast
    module = _numba()
    if module is None:
        msg = (
            "the numba backend was asked for, but numba cannot be imported here. Install it (pip install numba), or "
            f"leave the choice to rosmini: no backend argument, no environment variable {VARIABLE}; numpy gives the "
            "same ranges, slower"
        )
        raise BackendMissing(msg)
    kernel: Callable[..., None] = module.compiled()
    return kernel
