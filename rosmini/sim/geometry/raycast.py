"""Ranges of a 2D laser: rays against line segments and discs.

`raycast` uses numpy first, and numba, if installed, once the work justifies compiling. Both return the same ranges to
the last bit: they use the same directions and the same arithmetic in the same order. `backend` returns the choice.
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
from rosmini.core.geometry.angles import cos_sin, normalize_angle
from rosmini.core.geometry.errors import GeometryError
from rosmini.core.geometry.machine_code import Deferral, require

from . import raycast_numpy

Floats = NDArray[np.float64]
Ints = NDArray[np.int64]

VARIABLE = "ROSMINI_RAYCAST"
"""Environment variable that chooses a backend if the caller does not."""

BACKENDS = ("numba", "numpy")

MANY_RAYS = 50_000
"""Rays per second of wall-clock time from which numba casts them; numpy takes about 1 us for one."""

EVERY: Ints = np.empty((0, 2), dtype=np.int64)
"""No rows: every ray sees all segments and discs."""


class BackendMissing(RosminiError):
    """The requested backend is not installed."""


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
    """Return the distance from (x, y) to the nearest object in each of `count` directions (count,).

    Inf if there is none within `max_range`. `segments` (n, 4) are walls without thickness, each x1, y1, x2, y2; `discs`
    (m, 3) are solid, each x, y, radius. Both may be empty. Ray i points to `angle_min + i * angle_increment`; the
    increment may be negative, and the rays may cover more or less than one turn. All values are in one frame, in metres
    and radians.

    Segments include their ends and 1 nm beyond them, so no ray slips between two walls whose common
    corner was rounded. A ray along a wall meets the wall's near end. A sensor in or on a disc, or on a wall,
    measures 0 in all directions. A segment of length 0 is a point.

    `backend` is "numba" or "numpy". By default the environment variable `ROSMINI_RAYCAST` decides; if it is not set,
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
    """Cast rays as `raycast` does, but with an origin for each ray, `origins` (n, 2), and a direction, `angles` (n,).

    As fast as `raycast` if the origins are close together and the angles nearly evenly spaced and not wrapped, as for a
    laser that moves while it turns. `segment_rays` (k, 2) contains for each segment the first ray that sees it and the
    first that no longer does; `disc_rays` for each disc; by default all rays see all. Raises the errors of `raycast`.
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
    """Return the default backend of `raycast`, "numba" or "numpy"; counts these rays as work to do."""
    return _chosen(None, rays)


class _Lasers(Deferral):
    """Decides when to cast rays with numba."""

    rays_per_second = 0.0
    """Total of the lasers that run on wall-clock time."""


_LASERS = _Lasers()


def expect(rays_per_second: float) -> None:
    """Register one more laser on wall-clock time, for which nothing is compiled while robots drive."""
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
    """Return for each of `size` objects the first of `count` rays that sees it, and the first that no longer does."""
    if rays is None:
        return EVERY
    spans = np.array(rays, dtype=np.int64).reshape(-1, 2)
    if len(spans) != size or (size and (spans.min() < 0 or spans.max() > count)):
        wanted = f"an array ({size}, 2) of numbers from 0 to {count}"
        msg = f"which rays see each of {size} things is {wanted}, not {spans.shape}"
        raise GeometryError(msg)
    return spans


def _table(rows: ArrayLike, width: int, what: str) -> Floats:
    """Return the rows as a finite, contiguous array (n, width)."""
    table = np.ascontiguousarray(rows, dtype=np.float64)
    if not table.size:
        return table.reshape(0, width)
    if table.ndim != 2 or table.shape[1] != width:
        msg = f"{what} are an array (n, {width}), not {table.shape}"
        raise GeometryError(msg)
    # Checking the sum first is faster, and nearly always sufficient.
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
        msg = f"there is no raycast backend {wanted!r}{source}; there are {there}. {nearest(wanted, BACKENDS)}"
        raise GeometryError(msg.rstrip())
    return wanted


@cache
def _numba() -> Any:
    """Return the module with the compiled kernel, or None without numba."""
    try:
        require()
    except ModuleNotFoundError:
        return None
    except ImportError as error:  # numba refuses a numpy version newer than it supports
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
