"""Chapter 23: its figures are numbered; what its tables and boxes name exists."""

from __future__ import annotations

import re

import pytest

from book.tools import notebooks
from rosmini.core.markup import parse_file
from rosmini.core.packages import PackageIndex
from rosmini.sim.gazebo import plugin_class
from rosmini.sim.verbs.gz import TOOL

from .conftest import NOTEBOOKS, figure_numbers, prose_of

NAME = "23_gazebo"
FIGURES = ("rqt_graph(", ".show(", ".show3d(", "plot(", "image_picture(")


@pytest.fixture(scope="module")
def code():
    return [
        cell.source for cell in notebooks.read(NOTEBOOKS / f"{NAME}.ipynb").cells if cell.cell_type == "code"
    ]


@pytest.fixture(scope="module")
def prose():
    return prose_of(NAME)


def test_every_figure_is_numbered_in_order(code):
    numbers = figure_numbers(NAME)
    assert numbers == list(range(1, len(numbers) + 1))
    drawn = [source for source in code if any(word in source for word in FIGURES)]
    assert len(drawn) == len(numbers) > 0


def test_a_page_holds_few_views_to_be_turned(code):
    assert "".join(code).count("show3d(") <= 2


def test_the_verbs_of_gz_exist_as_they_are_written(prose):
    shown = re.findall(r"(?:`|\$ )(gz \w+ [^`\n]*)", prose)
    assert len(shown) > 10
    for line in shown:
        _, verb, *words = line.split()
        if words[-1].startswith("-") and verb == "sdf":
            words.append("FILE")
        TOOL.find(verb).parser().parse([re.sub(r"^NAME$|^FILE$", "x", word) for word in words])


def test_the_services_of_the_boxes_exist(prose, code):
    named = set(re.findall(r"rosservice call /gazebo/(\w+)", prose)) | set(
        re.findall(r'call\("(\w+)"', "".join(code))
    )
    from rosmini import Graph, rosrun

    with Graph() as graph:
        rosrun("gazebo_ros", "gzserver", graph=graph).instance()
        there = {name.rsplit("/", 1)[-1] for name, _ in graph.master.getSystemState("/x")[2][2]}
    assert len(named) > 8
    assert named <= there


def test_the_arguments_of_the_launch_files_exist(prose):
    index = PackageIndex()
    for package, file, words in re.findall(r"\$ roslaunch (\w+) (\S+)(.*)", prose):
        root = parse_file(index.resolve(f"package://{package}/launch/{file}"))
        arguments = {arg.get("name") for arg in root.all("arg")}
        assert {word.split(":=")[0] for word in words.split()} <= arguments


def test_plugins_that_the_text_names_exist(prose):
    for library in re.findall(r"`(lib\w+\.so)`", prose):
        if library not in ("libgazebo_ros_api_plugin.so", "libleash.so"):
            assert plugin_class(library)
