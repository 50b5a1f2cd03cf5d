"""``roslaunch.xmlloader`` and ``roslaunch.config`` in scripts, as public ones use them."""

import textwrap

import pytest

from rosmini import Graph
from rosmini.core.errors import RosminiError
from rosmini.ros.launch.script_config import ROSLaunchConfig, XmlLoader, load_config_default
from rosmini.ros.scripts import Console, ScriptHandle, ScriptSpec

ROBOT = """
<launch>
  <arg name="name"/>
  <param name="size" value="0.2"/>
  <machine name="pc" address="localhost"/>
  <group ns="$(arg name)">
    <node pkg="rospy_tutorials" type="talker.py" name="talk" args="-v" respawn="true" respawn_delay="2">
      <remap from="chatter" to="said"/>
      <env name="LANG" value="C"/>
    </node>
  </group>
  <test test-name="t" pkg="rostest" type="hztest" name="rate"/>
</launch>
"""


def test_a_file_becomes_nodes_and_parameters(tmp_path):
    file = tmp_path / "robot.launch"
    file.write_text(ROBOT, encoding="utf-8")
    config = ROSLaunchConfig()
    XmlLoader(resolve_anon=True).load(str(file), config, argv=["name:=bob"])
    (node,) = config.nodes
    assert (node.package, node.type, node.namespace, node.name) == (
        "rospy_tutorials", "talker.py", "/bob/", "talk",
    )  # fmt: skip
    assert (node.args, node.respawn, node.respawn_delay, node.required) == ("-v", True, 2.0, False)
    assert (list(node.remap_args), list(node.env_args)) == ([("chatter", "said")], [("LANG", "C")])
    assert node.filename == str(file)
    assert config.resolved_node_names == ["/bob/talk"]
    assert (config.params["/size"].key, config.params["/size"].value) == ("/size", 0.2)
    assert [test.name for test in config.tests] == ["rate"]
    assert list(config.machines) == ["pc"]
    assert config.roslaunch_files == [str(file)]
    assert "talk (rospy_tutorials/talker.py)" in config.summary()


def test_several_files_make_one_configuration_and_bad_ones_are_refused(tmp_path):
    file = tmp_path / "robot.launch"
    file.write_text(ROBOT, encoding="utf-8")
    config = load_config_default(
        [(str(file), ["name:=a"])], 11311, roslaunch_strs=["<launch><param name='b' value='1'/></launch>"]
    )
    assert sorted(config.params) == ["/b", "/size"]
    with pytest.raises(RosminiError, match="name"):
        XmlLoader().load(str(file), ROSLaunchConfig(), argv=[])


def test_a_script_imports_them():
    source = """
    import roslaunch.config, roslaunch.xmlloader
    config = roslaunch.config.ROSLaunchConfig()
    loader = roslaunch.xmlloader.XmlLoader()
    loader.load_string("<launch><param name='x' value='$(optenv NOPE 7)'/></launch>", config)
    print(config.params["/x"].value)
    try:
        loader.load_string("<launch", config)
    except roslaunch.xmlloader.XmlParseException:
        print("refused")
    """
    with Graph(strict=False) as graph:
        console = Console(graph.scheduler, prefix=False, capture_output=True)
        spec = ScriptSpec("look", source=textwrap.dedent(source))
        script = ScriptHandle(graph, spec, lambda: console, owns_console=False)
        script.start()
        graph.run(1)
        assert (script.poll(), console.captured) == (0, "7\nrefused\n")
