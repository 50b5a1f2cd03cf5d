"""Machine code in a page of the book: the loops that `book/tools/wasm.py` compiled to WebAssembly, without numba.

The library is an Emscripten side module, which ctypes loads. A loop `name` receives one address, of slots of 8 bytes:
its numbers and, for each array, the address and the shape; the slots after them receive its result. The constant
`name_types` describes both, as JSON.
"""

from __future__ import annotations

import ctypes
import json
from collections.abc import Iterator
from functools import cache
from pathlib import Path
from struct import Struct
from typing import Any

from rosmini.core.errors import RosminiError

LIBRARY = Path(__file__).with_name("kernels.wasm")
"""The library, which only the pages of the book have."""


@cache
def library() -> ctypes.CDLL:
    """Load the library. Raises `ModuleNotFoundError` if this book was built without it."""
    if not LIBRARY.is_file():  # Emscripten fails only at the first attempt
        msg = f"there is no {LIBRARY}: this book was built without numba or wasm-ld"
        raise ModuleNotFoundError(msg)
    return ctypes.CDLL(str(LIBRARY))


class WasmLoop:
    """A compiled loop. Calls raise `TypeError` for arrays that are not contiguous or of another type."""

    def __init__(self, name: str) -> None:
        types = json.loads(ctypes.string_at(ctypes.addressof(ctypes.c_char.in_dll(library(), f"{name}_types"))))
        self._name = name
        self._function = getattr(library(), name)
        self._function.argtypes = [ctypes.c_void_p]
        self._arguments = [kind if isinstance(kind, str) else tuple(kind) for kind in types["arguments"]]
        slots = "".join("q" * (1 + kind[1]) if isinstance(kind, tuple) else kind for kind in self._arguments)
        self._inputs, self._form = Struct(f"<{slots}"), types["result"]
        self._outputs = Struct(f"<{''.join(flat_kinds(self._form))}")
        self._slots = ctypes.create_string_buffer(self._inputs.size + max(self._outputs.size, 8))
        self._address = ctypes.addressof(self._slots)

    def __call__(self, *values: Any) -> Any:
        """Run the loop; tuples in its arguments and result are nested as in Python."""
        slots: list[Any] = []
        for kind, value in zip(self._arguments, flat(values), strict=True):
            if isinstance(kind, str):
                slots.append(value)
                continue
            if value.dtype.str != kind[0] or value.ndim != kind[1] or not value.flags.c_contiguous:
                msg = f"{self._name} needs a contiguous array of {kind[1]} dimensions and type {kind[0]}"
                raise TypeError(msg)
            slots += (value.ctypes.data, *value.shape)
        self._inputs.pack_into(self._slots, 0, *slots)
        if status := self._function(self._address):
            msg = f"{self._name} failed: numba's status {status}"
            raise RosminiError(msg)
        results = iter(self._outputs.unpack_from(self._slots, self._inputs.size))
        return nested(self._form, results)


def flat(values: tuple[Any, ...]) -> Iterator[Any]:
    """Yield the values in nested tuples."""
    for value in values:
        if isinstance(value, tuple):
            yield from flat(value)
        else:
            yield value


def flat_kinds(form: Any) -> Iterator[str]:
    """Yield the kinds of numbers in the form of a result."""
    if isinstance(form, list):
        for part in form:
            yield from flat_kinds(part)
    elif form is not None:
        yield form


def nested(form: Any, numbers: Iterator[Any]) -> Any:
    """Return the numbers in the form of a result: a number, nested tuples or None."""
    if isinstance(form, list):
        return tuple(nested(part, numbers) for part in form)
    return None if form is None else next(numbers)
