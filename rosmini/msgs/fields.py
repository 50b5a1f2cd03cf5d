"""Valid values of fields: the conversions called by the generated code, and error messages if one fails.

A value is accepted if :mod:`struct` packs it, as in genpy: a bool or a numpy integer in an int field, an int
in a float field, but no float in an int field. There are two differences from genpy: numpy arrays are accepted as
lists, and a ``str`` is refused as a list of strings (genpy sends its letters).
"""

from __future__ import annotations

import struct
import sys
from functools import cache, lru_cache
from numbers import Real
from typing import TYPE_CHECKING, Any

from rosmini.core.errors import DeserializationError, SerializationError, shown
from rosmini.core.lazy import np

from .definition import BYTES, FORMATS, INTEGER_RANGES

if TYPE_CHECKING:
    from collections.abc import Callable

    from numpy.typing import NDArray

    from .contract import MessageContract
    from .definition import Field

# Errors that a wrong value can cause in generated code; AttributeError: None or a number instead of a message.
ERRORS = (struct.error, TypeError, ValueError, OverflowError, AttributeError, SerializationError)


@cache
def dtype_of(kind: str) -> np.dtype[Any]:
    """Return numpy's type for the elements of a numeric array field, little-endian as on the wire."""
    code = FORMATS[kind]
    size = struct.calcsize("<" + code)
    return np.dtype("?" if kind == "bool" else f"<{'f' if code in 'fd' else 'iu'[code.isupper()]}{size}")


def checked_text(value: Any) -> str:
    """Return a string field's value as a plain, encodable ``str``. Raises ``TypeError`` or ``ValueError``."""
    if not isinstance(value, str):
        raise TypeError("not a str")
    value.encode()
    return str(value)


def as_bool(value: Any) -> Any:
    """Convert a numpy bool, which struct does not accept, to a Python bool; return other values unchanged."""
    return value if isinstance(value, int) or not _is_numpys("bool_", value) else bool(value)


def _is_numpys(name: str, value: Any) -> bool:
    """Return whether ``value`` is of this class of numpy; without numpy, which is not imported for this, nothing is."""
    return isinstance(value, getattr(sys.modules.get("numpy"), name, ()))


def freeze_bytes(size: int) -> Callable[[Any], bytes]:
    """Return the conversion of a ``uint8[]`` or ``char[]`` field of ``size`` elements (-1: any number) to ``bytes``."""

    def convert(values: Any) -> bytes:
        if type(values) is bytes:
            data: bytes = values
        elif isinstance(values, (bytes, bytearray, list, tuple)):
            data = bytes(values)
        elif isinstance(values, memoryview):
            data = values.tobytes()
        elif isinstance(values, str):
            raise TypeError("a str, not bytes")
        elif _is_numpys("ndarray", values):
            data = _array_bytes(values, dtype_of("uint8"))
        else:
            data = bytes(tuple(values))
        if size >= 0 and len(data) != size:
            raise ValueError("wrong length")
        return data

    return convert


@lru_cache(maxsize=256)
def _packer(code: str, count: int) -> Callable[..., bytes]:
    """Return a function that packs this many numbers."""
    return struct.Struct(f"<{count}{code}").pack


def array_freezer(kind: str, size: int) -> Callable[[Any], NDArray[Any]]:
    """Return the conversion of a numeric array field to a read-only numpy array over ``bytes``."""
    code, dtype = FORMATS[kind], dtype_of(kind)
    frombuffer, ndarray = np.frombuffer, np.ndarray

    def convert(values: Any) -> NDArray[Any]:
        if isinstance(values, ndarray):
            if (
                values.dtype == dtype
                and isinstance(values.base, bytes)
                and values.ndim == 1
                and values.flags.c_contiguous
            ):
                array: NDArray[Any] = values
            else:
                array = frombuffer(_array_bytes(values, dtype), dtype)
        elif isinstance(values, (str, bytes, dict)):
            raise TypeError("not a list")
        else:
            array = frombuffer(_packer(code, len(values))(*values), dtype)
        if size >= 0 and len(array) != size:
            raise ValueError("wrong length")
        return array

    def convert_bools(values: Any) -> NDArray[Any]:
        if isinstance(values, (str, bytes, dict)):
            raise TypeError("not a list")
        numbers = bytes([as_bool(value) for value in values])
        if size >= 0 and len(numbers) != size:
            raise ValueError("wrong length")
        return bools_from(numbers)

    return convert_bools if kind == "bool" else convert


def bools_from(data: bytes) -> NDArray[Any]:
    """Return a bool array over bytes from the wire, where any byte but 0 means true."""
    return np.frombuffer((np.frombuffer(data, np.uint8) != 0).tobytes(), np.bool_)


def _array_bytes(values: NDArray[Any], dtype: np.dtype[Any]) -> bytes:
    """Return the little-endian bytes of a numpy array as ``dtype``; refuse elements that struct would refuse."""
    if values.ndim != 1:
        raise ValueError(f"an array of {values.ndim} dimensions")
    if values.dtype == dtype:
        return values.tobytes()
    source = values.dtype.kind
    if source not in ("iub" if dtype.kind in "iu" else "fiub"):
        raise TypeError(f"an array of {values.dtype}")
    with np.errstate(over="ignore"):
        converted = values.astype(dtype)
    if dtype.kind == "f" and source == "f":
        lost = np.count_nonzero(np.isinf(converted)) != np.count_nonzero(np.isinf(values))
    else:
        lost = dtype.kind in "iu" and source in "iu" and bool((converted != values).any())
    if lost:
        raise OverflowError("an element that does not fit")
    return converted.tobytes()


# ---- diagnosis ----


def explain(cls: type[MessageContract], message: Any, cause: Exception) -> SerializationError:
    """Return the error for a message that could not be converted: with the field, its value and its ROS type."""
    try:
        check(cls, message)
    except SerializationError as error:
        return error
    return SerializationError(f"{cls._type}: {cause}")


def check(cls: type[MessageContract], message: Any) -> None:
    """Raise ``SerializationError`` for the first field with an invalid value, such as 2 in a bool."""
    try:
        _check(cls, message, "")
    except SerializationError as error:
        raise SerializationError(f"{cls._type}: {error}") from None


def _check(cls: type[MessageContract], message: Any, prefix: str) -> None:
    for field in cls._spec.fields:
        path = prefix + field.name
        try:
            value = getattr(message, field.name)
        except AttributeError:
            missing = f"not {_shown(message)}, which has no '{field.name}'"
            where = f"field {prefix[:-1]}" if prefix else "the message"
            problem = f"{where} must be of type {cls._type}, {missing}"
            raise SerializationError(problem) from None
        check_field(field, path, value, cls._nested.get(field.base))


def check_field(field: Field, path: str, value: Any, nested: type[MessageContract] | None) -> None:
    """Raise ``SerializationError`` unless ``value`` is valid for a field, which errors call ``path``.

    ``nested`` is the message class of the field, or None.
    """
    if field.size is None:
        _check_value(nested, field, path, value)
        return
    if isinstance(value, (str, dict)) or (isinstance(value, bytes) and field.base not in BYTES):
        raise SerializationError(f"field {path} must be a list or tuple type, not {_shown(value)} [{field.type}]")
    try:
        elements = list(value)
    except TypeError:
        problem = f"field {path} must be a list or tuple type, not {_shown(value)} [{field.type}]"
        raise SerializationError(problem) from None
    if _is_numpys("ndarray", value) and value.ndim != 1:
        problem = f"field {path} must have one dimension, not {value.ndim} (ravel() flattens an array) [{field.type}]"
        raise SerializationError(problem)
    if field.size >= 0 and len(elements) != field.size:
        problem = f"field {path} must have exactly {field.size} elements, not {len(elements)} [{field.type}]"
        raise SerializationError(problem)
    for index, element in enumerate(elements):
        _check_value(nested, field, f"{path}[{index}]", element)


def _check_value(nested: type[MessageContract] | None, field: Field, path: str, value: Any) -> None:
    kind = field.base
    if kind == "string":
        _check_text(path, value)
    elif kind in ("time", "duration"):
        name = kind.capitalize()
        if not (hasattr(value, "secs") and hasattr(value, "nsecs")):
            raise SerializationError(f"field {path} must be of type {name}, not {_shown(value)}")
        for part in ("secs", "nsecs"):
            _check_number("uint32" if kind == "time" else "int32", f"{path}.{part}", getattr(value, part))
    elif field.builtin:
        _check_number(kind, path, value)
    elif nested is not None:
        _check(nested, value, f"{path}.")


def _check_text(path: str, value: Any) -> None:
    if not isinstance(value, str):
        hint = ": decode the bytes first" if isinstance(value, bytes) else ""
        raise SerializationError(f"field {path} must be of type str, not {_shown(value)}{hint} [string]")
    try:
        value.encode()
    except UnicodeEncodeError as error:
        raise SerializationError(f"field {path} cannot be written as UTF-8: {error.reason} [string]") from None


def _check_number(kind: str, path: str, value: Any) -> None:
    try:
        struct.pack(f"<{FORMATS[kind]}", as_bool(value) if kind == "bool" else value)
    except (struct.error, TypeError, ValueError, OverflowError):
        pass
    else:
        if kind != "bool" or value in (0, 1):
            return
    if kind == "bool":
        problem = "is not a bool:"
    elif kind in ("float32", "float64"):
        problem = "must be float type, not" if not isinstance(value, Real) else f"exceeds specified width [{kind}]:"
    elif not hasattr(value, "__index__"):
        problem = f"must be {'unsigned integer' if INTEGER_RANGES[kind][0] == 0 else 'an integer'} type, not"
    elif INTEGER_RANGES[kind][0] == 0 and value < 0:
        problem = "must be unsigned integer type, not"
    else:
        problem = f"exceeds specified width [{kind}]:"
    raise SerializationError(f"field {path} {problem} {_shown(value)} [{kind}]")


def _shown(value: Any) -> str:
    """Return a value and its type, short enough for one line."""
    if value is None:
        return "None"
    return f"{shown(value)} ({type(value).__name__})"


# ---- received bytes ----


def short(cls_name: str, path: str, wanted: int, left: int) -> DeserializationError:
    """Return the error for a length on the wire that exceeds the data."""
    problem = f"field {path} claims {wanted} bytes, but only {left} are left"
    return DeserializationError(f"{cls_name}: {problem}: the data is cut off, or of another type")


def too_many(cls_name: str, path: str, count: int, left: int) -> DeserializationError:
    """Return the error for an array on the wire with more elements than fit into the data."""
    problem = f"field {path} claims {count} elements, but only {left} bytes are left"
    return DeserializationError(f"{cls_name}: {problem}: the data is cut off, or of another type")
