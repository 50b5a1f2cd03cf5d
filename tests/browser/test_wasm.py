"""The loops that are compiled to WebAssembly for the pages of the book do what numba's machine code does."""

import json
import os
import sys

import pytest

from book.tools import wasm

from ..processes import run
from .test_emscripten import page  # noqa: F401

ROUNDING = 1e-12
"""Sine, cosine and their like differ in the last bit between C libraries."""

RUN_ALL = """
import json
from base64 import b64decode
from collections import namedtuple
from ctypes import addressof, c_char
from js import fetch
from rosmini.core.geometry import wasm

Address = namedtuple("Address", "data")

class Array:
    # As much of numpy's array as a loop needs: Pyodide's numpy is in no registry.
    def __init__(self, record):
        data = b64decode(record["data"])
        self.size, self.shape, self.ndim = len(data), record["shape"], len(record["shape"])
        self.bytes, self.dtype, self.flags, self.c_contiguous = bytearray(data + b" "), self, self, True
        self.str = record["type"]

    @property
    def ctypes(self):
        return Address(addressof(c_char.from_buffer(self.bytes)))

    def numbers(self):
        return memoryview(self.bytes)[: self.size].cast(CODES[self.str]).tolist()

CODES = {"|u1": "B", "<i4": "i", "<i8": "q", "<f4": "f", "<f8": "d"}
def read(value):
    if isinstance(value, list):
        return tuple(map(read, value))
    return Array(value) if isinstance(value, dict) else value

def numbers(value):
    if isinstance(value, tuple):
        return [number for part in value for number in numbers(part)]
    return value.numbers() if isinstance(value, Array) else [value]

def differences(expected, found):
    for a, b in zip(numbers(expected), numbers(found), strict=True):
        if a != b and a == a:
            yield abs(a - b) / max(1.0, abs(a))

worst = {}
for name, calls in json.loads(await (await fetch("calls.json")).text()).items():
    loop = wasm.WasmLoop(name)
    for before, after, result in calls:
        arguments = read(before)
        found = loop(*arguments), arguments
        worst[name] = max(worst.get(name, 0.0), 0.0, *differences((read(result), read(after)), found))
json.dumps(worst)
"""


@pytest.mark.nightly
def test_all_loops_do_what_numba_does(page, root, tmp_path):  # noqa: F811
    if wasm.library() is None:
        assert os.environ.get("ROSMINI_REQUIRE_BROWSER") != "1", "wasm-ld is missing (ROSMINI_REQUIRE_BROWSER=1)"
        pytest.skip("needs numba and wasm-ld")
    calls = tmp_path / "calls.json"
    run([sys.executable, "tests/browser/loop_calls.py", calls], cwd=root, check=True)
    page.route("**/calls.json", lambda route: route.fulfill(path=calls))
    worst = json.loads(page.evaluate("run", RUN_ALL))
    assert len(worst) == 18
    assert {name: error for name, error in worst.items() if error > ROUNDING} == {}
