"""The chapter Gazebo: what its tables and boxes name exists."""

from __future__ import annotations

import re

from rosmini.core.markup import parse_file
from rosmini.core.packages import PackageIndex
from rosmini.sim.gazebo.plugins import plugin_class
from rosmini.sim.verbs.gz import TOOL


def test_the_verbs_of_gz_exist_as_they_are_written(prose):
    shown = re.findall(r"(?:`|\$ )(gz \w+ [^`\n]*)", prose)
    assert len(shown) > 7
    for line in shown:
        _, verb, *words = line.split()
        if words[-1].startswith("-") and verb == "sdf":
            words.append("FILE")
        TOOL.find(verb).parser().parse([re.sub(r"^NAME$|^FILE$", "x", word) for word in words])


def test_the_services_of_the_boxes_exist(prose, code):
    named = set(re.findall(r"/gazebo/(?!model_states)([a-z_]+_[a-z]+)\b", prose + "".join(code)))
    from rosmini import Graph, rosrun

    with Graph() as graph:
        rosrun("gazebo_ros", "gzserver", graph=graph).instance()
        there = {name.rsplit("/", 1)[-1] for name, _ in graph.master.getSystemState("/x")[2][2]}
    assert len(named) > 4
    assert named <= there


def test_the_arguments_of_the_launch_files_exist(prose):
    index = PackageIndex()
    for package, file, words in re.findall(r"\$ roslaunch (\w+) (\S+)(.*)", prose):
        root = parse_file(index.resolve(f"package://{package}/launch/{file}"))
        arguments = {arg.get("name") for arg in root.all("arg")}
        assert {word.split(":=")[0] for word in words.split()} <= arguments


def test_plugins_that_the_text_names_exist(prose):
    for library in re.findall(r"`(lib\w+\.so)`", prose):
        if library != "libgazebo_ros_api_plugin.so":
            assert plugin_class(library)
