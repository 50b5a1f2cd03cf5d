"""Parameters that are declared once, and read from a node's private namespace."""

from __future__ import annotations

from dataclasses import dataclass

import pytest
import yaml

from rosmini.core.errors import ParameterError
from rosmini.core.graph import Graph
from rosmini.core.parameters import Parameters, parameter


@dataclass(frozen=True)
class Settings(Parameters):
    strict = True
    allowed = ("tf_prefix",)

    rate: float = parameter(10.0, "how often to look", unit="Hz", minimum=0.5, maximum=100.0)
    count: int = parameter(3, "how many", minimum=1)
    label: str | None = parameter(None, "what to write on it")
    loud: bool = parameter(False, "make a noise")


@pytest.fixture
def node():
    with Graph() as graph:
        yield graph.node("worker")


def test_what_is_set_is_read_and_an_int_is_a_float(node):
    node.set_param("~rate", 20)
    node.set_param("~label", "left")
    node.set_param("~loud", True)
    settings = Settings.read(node)
    assert settings == Settings(20.0, 3, "left", True)
    assert isinstance(settings.rate, float)


def test_what_is_given_comes_before_what_is_set(node):
    node.set_param("~count", 5)
    assert Settings.read(node, count=7, label=None).count == 7


def test_parameters_of_other_nodes_do_not_matter(node):
    node.set_param("/rate", "fast")
    node.set_param("/other/rat", 1)
    node.set_param("~tf_prefix", "robot1")
    assert Settings.read(node) == Settings()


@pytest.mark.parametrize(
    ("name", "value", "message"),
    [
        ("~rat", 1.0, r"/worker/rat.*no parameter ~rat; did you mean ~rate\?"),
        ("~xyz", 1.0, r"no parameter ~xyz; its parameters are ~rate, ~count, ~label, ~loud"),
        ("~rate", "fast", r"/worker/rate.*'fast'.*a float is needed"),
        ("~rate", float("nan"), r"/worker/rate is not a number"),
        ("~rate", 0.1, r"/worker/rate \(how often to look\) is 0.1; .* at least 0.5 and at most 100.0 Hz"),
        ("~count", 0, r"at least 1"),
        ("~count", "2.5", r"an int is needed"),
        ("~loud", 1, r"a bool is needed"),
        ("~label", 4, r"a str is needed"),
    ],
)
def test_what_is_wrong_is_named(node, name, value, message):
    node.set_param(name, value)
    with pytest.raises(ParameterError, match=message):
        Settings.read(node)


def test_a_failed_read_changes_nothing(node):
    before = {"rat": 1.0, "rate": 2.0, "count": 0}
    node.set_param("~", before)
    for wrong in ("count", "rat"):
        with pytest.raises(ParameterError, match=f"/worker/{wrong}"):
            Settings.read(node)
        assert node.get_param("~") == before
        node.delete_param(f"~{wrong}")  # as the message advises
        del before[wrong]
    assert Settings.read(node).rate == 2.0


def test_the_table_says_all():
    assert Settings.table() == [
        ("~rate", "float", "10.0", "0.5 ... 100.0", "Hz", "how often to look"),
        ("~count", "int", "3", "1 ...", "", "how many"),
        ("~label", "str", "", "", "", "what to write on it"),
        ("~loud", "bool", "False", "", "", "make a noise"),
    ]


# ---- namespaces and lists ----


@dataclass(frozen=True)
class Layer(Parameters):
    strict = True

    name: str = parameter("", "its namespace")
    type: str = parameter("", "the plugin's name")


@dataclass(frozen=True)
class Inflation(Parameters):
    strict = True

    enabled: bool = parameter(True, "whether it takes part")
    inflation_radius: float = parameter(0.55, "how far costs reach", unit="m", minimum=0.0, maximum=50.0)
    cost_scaling_factor: float = parameter(10.0, "how fast they fall", minimum=0.0, maximum=100.0)


@dataclass(frozen=True)
class Costmap(Parameters):
    strict = True

    global_frame: str = parameter("map", "the frame it lies in")
    robot_base_frame: str = parameter("base_link", "the robot's frame")
    update_frequency: float = parameter(5.0, "how often it is updated", unit="Hz", minimum=0.0, maximum=100.0)
    rolling_window: bool = parameter(False, "whether it moves with the robot")
    width: int = parameter(10, "its width", unit="m", minimum=0)
    footprint: str | tuple[tuple[float, ...], ...] = parameter("[]", "the robot's outline", unit="m")
    plugins: tuple[Layer, ...] = parameter((), "its layers")
    inflation_layer: Inflation = parameter(Inflation(), "the layer that inflates")

    def others(self):
        return [layer.name for layer in self.plugins]


@dataclass(frozen=True)
class MoveBase(Parameters):
    strict = True
    allowed = ("DWAPlannerROS",)

    base_local_planner: str = parameter("base_local_planner/TrajectoryPlannerROS", "the local planner")
    controller_frequency: float = parameter(20.0, "how often commands are sent", unit="Hz", minimum=0.0)
    recovery_behaviors: tuple[Layer, ...] = parameter((), "what to try when stuck")
    global_costmap: Costmap = parameter(Costmap(), "what the global planner sees")


@dataclass(frozen=True)
class Amcl(Parameters):
    odom_model_type: str = parameter("diff", "the robot's kind", choices=("diff", "omni", "diff-corrected"))
    min_particles: int = parameter(100, "how few particles", minimum=0)
    laser_max_range: float = parameter(-1.0, "beams longer than this are cut", unit="m")
    initial_cov: tuple[float, ...] = parameter((0.25, 0.25), "how far off it may be", minimum=0.0)


MOVE_BASE_YAML = """
base_local_planner: dwa_local_planner/DWAPlannerROS
controller_frequency: 10
recovery_behaviors:
  - {name: careful_reset, type: clear_costmap_recovery/ClearCostmapRecovery}
DWAPlannerROS: {max_vel_x: 0.26, acc_lim_x: 2, vx_samples: 20}
global_costmap:
  global_frame: map
  robot_base_frame: base_footprint
  update_frequency: 8
  width: 12
  footprint: [[-0.2, -0.15], [-0.2, 0.15], [0.2, 0.15], [0.2, -0.15]]
  plugins:
    - {name: static_layer, type: "costmap_2d::StaticLayer"}
    - name: scans
      type: costmap_2d::ObstacleLayer
    - {name: inflation_layer, type: "costmap_2d::InflationLayer"}
  static_layer: {map_topic: /map}
  scans: {observation_sources: front, front: {data_type: LaserScan, topic: scan, marking: true}}
  inflation_layer: {inflation_radius: 0.9, cost_scaling_factor: 3}
"""


@pytest.fixture
def move_base():
    with Graph() as graph:
        node = graph.node("move_base")
        node.set_param("~", yaml.safe_load(MOVE_BASE_YAML))
        yield node


def test_a_parameter_file_of_the_real_move_base(move_base):
    settings = MoveBase.read(move_base)
    costmap = settings.global_costmap
    assert settings.recovery_behaviors == (Layer("careful_reset", "clear_costmap_recovery/ClearCostmapRecovery"),)
    assert costmap.footprint == ((-0.2, -0.15), (-0.2, 0.15), (0.2, 0.15), (0.2, -0.15))
    assert [layer.name for layer in costmap.plugins] == ["static_layer", "scans", "inflation_layer"]
    assert costmap.inflation_layer == Inflation(inflation_radius=0.9, cost_scaling_factor=3.0)
    assert (costmap.update_frequency, costmap.width, costmap.rolling_window) == (8.0, 12, False)
    # The namespace of a plugin is read by the plugin itself.
    layer = Inflation.read(move_base, "~global_costmap/inflation_layer")
    assert layer == costmap.inflation_layer


@pytest.mark.parametrize(("given", "read"), [(2.49, 2), (2.5, 3), (7.0, 7), (-1.2, -2), (-1.7, -2), (1e9, 10**9)])
def test_floats_are_rounded_to_ints_as_roscpp_does(node, given, read):
    @dataclass(frozen=True)
    class Whole(Parameters):
        retries: int = parameter(0, "how often to try again")

    node.set_param("~retries", given)
    assert repr(Whole.read(node).retries) == repr(read)


@dataclass(frozen=True)
class Tuned(Parameters):
    dynamic = True

    rate: float = parameter(10.0, "how often", unit="Hz", minimum=0.5, maximum=100.0)
    count: int = parameter(3, "how many", minimum=1)


@dataclass(frozen=True)
class TunedAndFixed(Tuned):
    share: float = parameter(0.5, "which part", minimum=0.0)


def test_only_dynamic_fields_are_limited(node):
    node.set_param("~", {"rate": 300, "count": -2.0})
    assert repr(TunedAndFixed.read(node)) == repr(TunedAndFixed(100.0, 1, 0.5))
    node.set_param("~share", -1)
    with pytest.raises(ParameterError, match=r"/worker/share \(which part\) is -1.0.* at least 0.0"):
        TunedAndFixed.read(node)


@pytest.mark.parametrize(
    ("name", "value", "message"),
    [
        (
            "inflation_layer/inflation_radus",
            1.0,
            r"node /move_base has no parameter ~global_costmap/inflation_layer/inflation_radus; .*/inflation_radius\?",
        ),
        ("inflation_layer/inflation_radius", 99, r"inflation_layer/inflation_radius \(.*at most 50.0 m"),
        ("inflation_layer", 3, r"is the int 3, and a dictionary of enabled, .* is needed"),
        ("obstacle_layer", {}, r"no parameter ~global_costmap/obstacle_layer"),
        ("footprint", [[1, "a"]], r"global_costmap/footprint\[0\]\[1\] is the str 'a', and a float"),
        ("footprint", 0.2, r"a str or list of list of float is needed"),
        ("plugins", [{"nmae": "x"}], r"plugins\[0\]/nmae.* did you mean ~global_costmap/plugins\[0\]/name\?"),
        ("plugins", ["static"], r"plugins\[0\] is the str 'static', and a dictionary of name, type is needed"),
        ("plugins", {"name": "x"}, r"list of dictionary of name, type"),
    ],
)
def test_what_is_wrong_inside_is_named(move_base, name, value, message):
    before = move_base.get_param("/")
    MoveBase.read(move_base)
    move_base.set_param(f"~global_costmap/{name}", value)
    with pytest.raises(ParameterError, match=message):
        MoveBase.read(move_base)
    move_base.set_param("/", before)
    MoveBase.read(move_base)


def test_choices_and_ranges_hold_for_each_element(node):
    node.set_param("~initial_cov", [0.5, -1])
    with pytest.raises(ParameterError, match=r"initial_cov\[1\] .*at least 0.0"):
        Amcl.read(node)


def test_a_namespace_that_is_none(node):
    node.set_param("~", {"inner": 3})
    with pytest.raises(ParameterError, match=r"/worker/inner is the int 3, and ~inner/ is a namespace .*name, type"):
        Layer.read(node, "~inner")


def test_the_table_of_namespaces_and_lists():
    rows = {row[0]: row[1:] for row in Costmap.table()}
    assert rows["~plugins"] == ("list of dictionary of name, type", "[]", "", "", "its layers")
    assert rows["~footprint"][0] == "str or list of list of float"
    assert rows["~inflation_layer/inflation_radius"] == ("float", "0.55", "0.0 ... 50.0", "m", "how far costs reach")
    assert {row[0]: row for row in Amcl.table()}["~initial_cov"][2] == "[0.25, 0.25]"


def test_unknown_names_are_warned_of(node, capsys):
    @dataclass(frozen=True)
    class Lenient(Parameters):
        reset_distance: float = parameter(3.0, "a side")

    node.set_param("~", {"reset_distanze": 2, "reset_distance": 1.5})
    assert Lenient.read(node).reset_distance == 1.5
    assert "/worker/reset_distanze" in (said := capsys.readouterr().err)
    assert "did you mean ~reset_distance?" in said
