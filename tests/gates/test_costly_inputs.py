"""Small inputs cost little: files made to be costly cost at most in proportion to their length, or are refused.

Each family makes a file of n parts. Calls are counted, of Python's own functions too: twice as many parts cost about
twice as many calls. Where the cost would be inside one call, n is so large that its square could not be waited for.
"""

from __future__ import annotations

import bz2
import math
import struct
import sys
import warnings
from collections.abc import Callable
from itertools import pairwise
from pathlib import Path
from typing import NamedTuple

import numpy as np
import pytest
from PIL import Image

from rosmini.core import rosparam
from rosmini.core.errors import RosminiError
from rosmini.core.expressions import Expression
from rosmini.core.packages import PackageIndex, read_package
from rosmini.msgs.full_text import class_from
from rosmini.ros import launch
from rosmini.ros.bag.mcap import from_mcap
from rosmini.ros.bag.reader import Reader, read_index
from rosmini.ros.bag.records import MAGIC, OP_CHUNK, OP_CHUNK_INFO, bag_header, pack_record, u32, u64
from rosmini.ros.catkin.project import CMAKE, read_project
from rosmini.sim import urdf, worlds
from rosmini.sim.urdf import meshes

AT_LEAST = 20_000
"""Fewer calls are not compared."""

PRIME = 2**61 - 1
"""Multiples of it have the same hash."""

PACKAGES = PackageIndex()


class Family(NamedTuple):
    name: str
    make: Callable[[int], str | bytes]
    n: int
    refused: bool = False
    beside: Callable[[Path], object] = lambda _folder: None
    """Writes the files that the made file refers to."""


def _launch(*parts: str) -> str:
    return f"<launch>{''.join(parts)}</launch>"


def _value(text: str) -> str:
    return _launch(f'<param name="a" value="{text}"/>')


def _each(pattern: str, n: int, step: int = 1, end: str = "") -> str:
    return "".join(pattern.replace("#", str(i * step)) + end for i in range(n))


def _xacro(text: str) -> str:
    return f'<robot name="r" xmlns:xacro="http://ros.org/wiki/xacro">{text}<link name="a"/></robot>'


_SIZE = 987_654
"""What the chunk of `_one_chunk` says of its length."""


def _one_chunk(infos: int) -> bytes:
    """A bag whose index names its one chunk, of zeros, so many times."""
    chunk = pack_record(
        {"compression": b"bz2", "op": bytes([OP_CHUNK]), "size": u32.pack(_SIZE)}, bz2.compress(bytes(_SIZE))
    )
    start = len(MAGIC) + len(bag_header(0, 0, 0))
    fields = {"chunk_pos": u64.pack(start), "count": u32.pack(0), "op": bytes([OP_CHUNK_INFO]), "ver": u32.pack(1)}
    info = pack_record({**fields, "start_time": bytes(8), "end_time": bytes(8)})
    return MAGIC + bag_header(start + len(chunk), 0, infos) + chunk + info * infos


def _chunks(n: int) -> bytes:
    """A bag of n chunks of 16 MiB of zeros."""
    size = 2**24
    chunk = pack_record({"compression": b"bz2", "op": bytes([OP_CHUNK]), "size": u32.pack(size)}, _ZEROS)
    start = len(MAGIC) + len(bag_header(0, 0, 0))
    fields = {"count": u32.pack(0), "op": bytes([OP_CHUNK_INFO]), "ver": u32.pack(1)}
    infos = [
        pack_record(
            {**fields, "chunk_pos": u64.pack(start + i * len(chunk)), "start_time": bytes(8), "end_time": bytes(8)}
        )
        for i in range(n)
    ]
    return MAGIC + bag_header(start + n * len(chunk), 0, n) + chunk * n + b"".join(infos)


_ZEROS = bz2.compress(bytes(2**24))


def _read_bag(path: Path) -> None:
    with path.open("rb") as file:
        index = read_index(file, str(path))
        reader = Reader(file, index, str(path))
        for each in index.chunks:
            reader.data(each)


def _levels(n: int) -> str:
    """The full text of a message in which each of n types contains the next one nine times."""
    parts = [f"{_each(f'A{i + 1}[] a#{chr(10)}', 9)}{'=' * 80}\nMSG: a/A{i + 1}\n" for i in range(n)]
    return "".join(parts) + "int8 a\n"


def _cmake(text: str) -> str:
    return f"cmake_minimum_required(VERSION 3.0)\nproject(a)\n{text}"


def _robot(text: str) -> str:
    return f'<robot name="r"><link name="a"/>{text}</robot>'


def _collada(points: int, pieces: int, shown: int) -> str:
    piece = '<triangles><input semantic="VERTEX" source="#v" offset="0"/><p>0 1 2</p></triangles>'
    geometry = (
        f'<source id="s"><float_array>{"0 1 2 " * points}</float_array></source>'
        f'<vertices id="v"><input semantic="POSITION" source="#s"/></vertices>{piece * pieces}'
    )
    node = '<instance_geometry url="#g"/>' * shown
    return (
        f'<COLLADA><library_geometries><geometry id="g"><mesh>{geometry}</mesh></geometry></library_geometries>'
        f"<library_visual_scenes><visual_scene><node>{node}</node></visual_scene></library_visual_scenes></COLLADA>"
    )


def _world(text: str) -> str:
    return f'<sdf version="1.6"><world name="w">{text}</world></sdf>'


def _sphere(folder: Path) -> None:
    """A mesh of 800 triangles."""
    rings = [(math.sin(i * math.pi / 20), math.cos(i * math.pi / 20)) for i in range(21)]
    turns = [(math.cos(i * math.pi / 10), math.sin(i * math.pi / 10)) for i in range(21)]
    points = [[(r * c, r * s, z) for c, s in turns] for r, z in rings]
    corners: list[tuple[float, float, float]] = []
    for above, below in pairwise(points):
        for (a, b), (c, d) in zip(pairwise(above), pairwise(below), strict=True):
            corners += [a, c, d, a, d, b]
    data = "".join(f"vertex {x} {y} {z}\n" for x, y, z in corners)
    (folder / "m.stl").write_text(f"solid\n{data}", encoding="utf-8")


def _meshes(n: int) -> str:
    """Models with the same mesh, each at another place."""
    mesh = "<geometry><mesh><uri>m.stl</uri></mesh></geometry>"
    return _world(
        _each(
            f'<model name="m#"><static>1</static><pose>2 # 0 0 0 #</pose><link name="l"><collision name="c">{mesh}'
            "</collision></link></model>",
            n,
        )
    )


def _dots(side: int) -> Callable[[Path], object]:
    """A picture in which one of four pixels is dark."""

    def write(folder: Path) -> None:
        pixels = np.full((side, side), 255, dtype=np.uint8)
        pixels[::2, ::2] = 0
        Image.fromarray(pixels).save(folder / "m.png")

    return write


def _white(folder: Path) -> None:
    (folder / "a").mkdir()
    Image.new("1", (5000, 5000), 1).save(folder / "m.png")


TALKER = '<node name="n#" pkg="rospy_tutorials" type="talker.py"/>'

FAMILIES = {
    # expressions
    "a format string with nested brackets": Family(
        "a.txt", lambda n: f"'%((a)x){n}d' % {{'(a)x': 1}}", 10**9, refused=True
    ),
    "a format string with escaped signs": Family("a.txt", lambda n: f"'%%(a%{n}d)' % 1", 10**9, refused=True),
    "a set of colliding numbers": Family(
        "a.txt", lambda n: f"{{i * {PRIME} for i in range({n})}}", 10_000, refused=True
    ),
    "a dictionary of colliding numbers": Family(
        "a.txt", lambda n: f"dict([(i * {PRIME}, 1) for i in range({n})])", 5_000, refused=True
    ),
    "names on many lines": Family("a.txt", lambda n: f"[{'1,' * n}{chr(10) * n}]", 3000),
    "large factorials": Family("a.txt", lambda n: f"[factorial(500) for i in range({n})]", 40_000, refused=True),
    "a search from the right": Family(
        "a.txt", lambda n: f"('a' * {n}).rfind('a' * {n // 4} + 'b' + 'a' * {n // 4})", 400_000, refused=True
    ),
    "large numbers as text": Family("a.txt", lambda n: f"str([1 << 4000] * {n})", 100_000, refused=True),
    # parameter files
    "colliding keys": Family("a.yaml", lambda n: f"a: {{{_each('#: 1, ', n, PRIME)}}}", 5000, refused=True),
    "aliases of aliases": Family(
        "a.yaml",
        lambda n: "a0: &a0 [1]\n" + "".join(f"a{i}: &a{i} [{f'*a{i - 1}, ' * 9}]\n" for i in range(1, n)),
        40,
        refused=True,
    ),
    "values on many lines": Family("a.yaml", lambda n: f"a:\n{_each('- #', n, 1, chr(10))}", 2000),
    "loops in angles": Family(
        "a.yaml", lambda n: _each("k#: rad([i for i in [1] * 999][0])", n, 1, "\n"), 500, refused=True
    ),
    # robot descriptions
    "parameters of a macro": Family(
        "a.xacro",
        lambda n: _xacro(f'<xacro:macro name="m" params="{_each("p#:=1 ", n)}"><a/></xacro:macro>'),
        60_000,
        refused=True,
    ),
    "dollar signs in xacro": Family("a.xacro", lambda n: _xacro(f'<link name="{"$" * n}"/>'), 200_000, refused=True),
    # bags
    "chunk infos that name one chunk": Family("a.bag", _one_chunk, 200, refused=True),
    "a chunk that claims a gigabyte": Family(
        "a.bag", lambda n: _one_chunk(1).replace(u32.pack(_SIZE), u32.pack(n)), 2**30, refused=True
    ),
    "a length beyond the end of an MCAP file": Family(
        "a.mcap", lambda n: b"\x89MCAP0\r\n\x01" + struct.pack("<QI", 8, n) + bytes(4), 2**31, refused=True
    ),
    "many chunks of zeros": Family("a.bag", _chunks, 200, refused=True),
    # launch files
    "dollar signs": Family("a.launch", lambda n: _value("$" * n), 500_000),
    "brackets that stay open": Family("a.launch", lambda n: _value("$(" * n), 250_000),
    "unknown elements": Family("a.launch", lambda n: _launch("<a/>" * n), 2000),
    "unknown attributes": Family("a.launch", lambda n: _launch('<param name="a" value="1" b=""/>' * n), 500),
    "arguments and $(eval)": Family(
        "a.launch", lambda n: _launch(_each('<arg name="a#" default="1"/><param name="b" value="$(eval 1)"/>', n)), 200
    ),
    "arguments that are missing": Family(
        "a.launch", lambda n: _launch(_each('<param name="b" value="$(arg b#)"/>', n)), 2000, refused=True
    ),
    "remappings and nodes": Family(
        "a.launch", lambda n: _launch(_each('<remap from="a#" to="b"/>', n), _each(TALKER, n)), 500, refused=True
    ),
    "loops in $(eval)": Family(
        "a.launch",
        lambda n: _launch('<param name="a" value="$(eval sum([i for i in range(999)]))"/>' * n),
        500,
        refused=True,
    ),
    # messages and packages
    "messages of messages": Family("a.msg", _levels, 8),
    "long values read again": Family(
        "CMakeLists.txt", lambda n: _cmake(f'set(A "{"x;" * n}")\n' + "message(${A})\n" * n), 1000, refused=True
    ),
    "lists that grow": Family("CMakeLists.txt", lambda n: _cmake("list(APPEND A aaaaaaaa)\n" * n), 2000, refused=True),
    # robots, meshes and worlds
    "references to missing links": Family("a.urdf", lambda n: _robot(_each('<gazebo reference="b#"/>', n)), 1000),
    "joints that mimic one another": Family(
        "a.urdf",
        lambda n: _robot(
            "".join(
                f'<link name="b{i}"/><joint name="j{i}" type="continuous"><parent link="a"/><child link="b{i}"/>'
                f'<mimic joint="j{i + 1}"/></joint>'
                for i in range(n)
            )
        ),
        1000,
    ),
    "pieces with the same points": Family("a.dae", lambda n: _collada(n, n, 1), 1000),
    "a mesh that is shown many times": Family("a.dae", lambda n: _collada(n, 1, n), 1000),
    "properties that nobody knows": Family("a.world", lambda n: f"model ( {_each('a# 1 ', n)} )", 800),
    "definitions of many words": Family(
        "a.world", lambda n: f"define a model ( {'size [1 1 1] ' * n})\n{'a()' * n}", 1500, refused=True
    ),
    "a mesh at many places": Family("a.world", _meshes, 100, beside=_sphere),
    "a picture that is used many times": Family(
        "a.world", lambda n: 'model ( bitmap "m.png" )' * n, 1000, refused=True, beside=_dots(16)
    ),
    "a picture of many spots": Family(
        "a.world", lambda _: 'model ( bitmap "m.png" )', 4, refused=True, beside=_dots(1000)
    ),
    "a picture under many names": Family(
        "a.world",
        lambda n: "".join(f'model ( bitmap "{"a/../" * i}m.png" )' for i in range(n)),
        100,
        refused=True,
        beside=_white,
    ),
    "a map of many spots": Family(
        "m.yaml",
        lambda _: "image: m.png\nresolution: 1\norigin: [0, 0, 0]\nnegate: 0\nfree_thresh: 0.1\noccupied_thresh: 0.9",
        4,
        refused=True,
        beside=_dots(1000),
    ),
    "dependencies": Family(
        "package.xml",
        lambda n: f"<package format='2'><name>a</name>{_each('<depend>a#</depend>', n)}</package>",
        2000,
        refused=True,
    ),
    "chains of frames": Family(
        "a.world",
        lambda n: _world(
            "".join(f'<frame name="f{i}" attached_to="f{i + 1}"/>' for i in range(n)) + '<frame name="f1000"/>'
        ),
        1000,
        refused=True,
    ),
    "outlines of many sides": Family(
        "a.world",
        lambda n: _world(
            '<model name="m"><link name="l"><collision name="c"><geometry><polyline>'
            f"{_each(f'<point>{n} #</point>', n)}{_each('<point>0 #</point>', n)}"
            "</polyline></geometry></collision></link></model>"
        ),
        900,
    ),
}


def _read(path: Path) -> object:
    match path.suffix:
        case ".txt" if path.name == CMAKE:
            return read_project(path.parent)
        case ".txt":
            return Expression(path.read_text("utf-8")).evaluate({})
        case ".yaml" if path.name == "m.yaml":
            return worlds.world(path)
        case ".yaml":
            return rosparam.load_file(path)
        case ".xacro":
            return urdf.load(path)
        case ".bag":
            return _read_bag(path)
        case ".mcap":
            return from_mcap(path, path.with_suffix(".bag"))
        case ".xml":
            return read_package(path.parent)
        case ".msg":
            return class_from("a/A0", path.read_text("utf-8"))
        case ".urdf":
            return urdf.load(path)
        case ".dae":
            return meshes.read(path)
        case ".world":
            return worlds.world(path)
        case ".launch":
            return launch.read(path, environ={}, packages=PACKAGES, lenient=True)
    raise AssertionError(path)


def _calls(path: Path, data: str | bytes) -> tuple[int, bool]:
    """How many calls reading a file takes, and whether it is refused."""
    path.write_bytes(data if isinstance(data, bytes) else data.encode())
    calls, refused = 0, False

    def count(_frame: object, event: str, _arg: object) -> None:
        nonlocal calls
        calls += event in ("call", "c_call")

    before = sys.getprofile()
    sys.setprofile(count)
    try:
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")
            _read(path)
    except RosminiError:
        refused = True
    finally:
        sys.setprofile(before)
    return calls, refused


@pytest.mark.nightly
@pytest.mark.parametrize("family", FAMILIES)
def test_a_costly_file_costs_in_proportion_to_its_length_or_is_refused(family, tmp_path):
    name, make, n, refused, beside = FAMILIES[family]
    beside(tmp_path)
    _calls(tmp_path / name, make(2))  # what is loaded and cached once
    (half, _), (whole, was_refused) = (_calls(tmp_path / name, make(count)) for count in (n // 2, n))
    assert whole <= max(AT_LEAST, 2.5 * half)
    assert was_refused is refused
