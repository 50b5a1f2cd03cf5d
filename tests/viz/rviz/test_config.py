"""Files of RViz: read, shown, and written again with all that was in them."""

import pytest
import yaml
from hypothesis import given
from hypothesis import strategies as st

from rosmini.viz.rviz import Config
from rosmini.viz.rviz.config import MAX_DEPTH, ConfigError


def test_a_public_file_is_written_again_with_all_that_was_in_it(stage, data):
    text = (data / "navigation.rviz").read_text(encoding="utf-8")
    saved = yaml.safe_load(stage.scene(data / "navigation.rviz", None).saved().text())
    before = yaml.safe_load(text)

    def lost(old, new, path=""):
        if isinstance(old, dict):
            return [
                p for k, v in old.items() for p in (lost(v, new.get(k), f"{path}/{k}") if k in new else [f"{path}/{k}"])
            ]
        if isinstance(old, list):
            return [p for i, (a, b) in enumerate(zip(old, new, strict=True)) for p in lost(a, b, f"{path}[{i}]")]
        return [] if old == new else [f"{path}: {old} -> {new}"]

    assert lost(before, saved) == []


def test_what_is_not_known_is_named_in_one_warning(stage, data):
    warning = stage.scene(data / "navigation.rviz", None).warning
    assert "\n" not in warning
    for name in ("octomap_rviz_plugin/OccupancyGrid (Octomap)", "jsk_rviz_plugin/PublishTopic",
                 "rviz_plugin_tutorials/PlantFlag", "Costmap/Shininess"):  # fmt: skip
        assert name in warning
    assert "LaserScan" not in warning
    assert "TopDownOrtho" not in warning


def test_a_display_that_is_not_known_says_so(stage, data, statuses):
    scene = stage.scene(data / "navigation.rviz", None)
    scene.update()
    level, text = statuses(scene["Octomap"])["Class"]
    assert level == "Error"
    said = "The class required for this display, 'octomap_rviz_plugin/OccupancyGrid', could not be loaded."
    assert text.startswith(said)


def test_values_are_those_of_the_file(stage, data):
    scene = stage.scene(data / "navigation.rviz", None)
    assert scene.fixed_frame == "map"
    assert scene["LaserScan"]["Size (m)"] == pytest.approx(0.05)
    assert scene["LaserScan"]["Color"] == (0, 255, 0)
    assert scene["Grid"]["Line Style/Line Width"] == pytest.approx(0.03)
    assert scene["LaserScan"]["Autocompute Value Bounds/Max Value"] == 10
    assert scene["LaserScan"]["Autocompute Value Bounds"] is True
    assert scene["Costmap"]["Draw Behind"] is True
    assert scene["TF"].enabled is False
    assert scene["TF"]["Frames"]["base_scan"] == {"Value": True}


def test_a_new_configuration_has_the_parts_that_the_real_one_reads(stage, tmp_path):
    scene = stage.scene(fixed_frame="odom")
    scene.add("LaserScan", {"Topic": "/scan", "Color": (1, 2, 3)})
    tree = yaml.safe_load(scene.save(tmp_path / "my.rviz").read_text(encoding="utf-8"))
    assert set(tree) == {"Panels", "Visualization Manager", "Window Geometry"}
    manager = tree["Visualization Manager"]
    assert set(manager) >= {
        "Displays",
        "Enabled",
        "Global Options",
        "Name",
        "Tools",
        "Transformation",
        "Value",
        "Views",
    }
    assert manager["Global Options"]["Fixed Frame"] == "odom"
    scan = manager["Displays"][0]
    assert (scan["Class"], scan["Topic"], scan["Color"], scan["Enabled"]) == (
        "rviz/LaserScan",
        "/scan",
        "1; 2; 3",
        True,
    )
    assert scan["Autocompute Value Bounds"] == {"Value": True, "Min Value": -10.0, "Max Value": 10.0}
    again = stage.scene(tmp_path / "my.rviz", None)
    assert again.saved().tree == scene.saved().tree
    assert again.warning == ""


@pytest.mark.parametrize(
    ("text", "said"),
    [
        ("", "not a configuration"),
        ("[]", "not a configuration"),
        ("Visualization Manager: 3", "not a configuration"),
        ("Visualization Manager: {a: [}", "line 1"),
        ("a: &a [*a]\nVisualization Manager: {}", "contains itself"),
        ("Visualization Manager: " + "{a: " * (MAX_DEPTH + 5) + "1" + "}" * (MAX_DEPTH + 5), "deeper"),
        ("Visualization Manager: !!python/object/apply:os.system ['true']", "not YAML"),
    ],
)
def test_what_is_no_configuration_is_refused(text, said):
    with pytest.raises(ConfigError, match=said):
        Config.parse(text)


def test_a_file_that_cannot_be_read_or_written_is_named(tmp_path):
    with pytest.raises(ConfigError, match=r"absent\.rviz"):
        Config.read(tmp_path / "absent.rviz")
    with pytest.raises(ConfigError, match="cannot be read"):
        Config.read("a\0b.rviz")
    with pytest.raises(ConfigError, match="nowhere"):
        Config().write(tmp_path / "nowhere" / "a.rviz")


JUNK = st.recursive(
    st.none() | st.booleans() | st.integers() | st.floats() | st.text(max_size=5),
    lambda inner: st.lists(inner, max_size=3) | st.dictionaries(st.sampled_from(
        ["Alpha", "Class", "Color", "Displays", "Enabled", "Fixed Frame", "Frames", "Global Options", "Line Style",
         "Name", "Offset", "Panels", "Topic", "Tools", "Value", "Views", "Current", "X"]), inner, max_size=4),
    max_leaves=12,
)  # fmt: skip


@given(
    displays=st.lists(JUNK, max_size=4),
    rest=st.dictionaries(st.sampled_from(["Global Options", "Tools", "Views"]), JUNK),
)
def test_whatever_a_file_has_a_scene_is_made_and_saved(displays, rest):
    from rosmini import Graph
    from rosmini.viz.rviz import Scene

    for each in displays:
        if isinstance(each, dict):
            each.setdefault("Class", "rviz/LaserScan")
    config = Config({"Panels": [], "Visualization Manager": {"Displays": displays, **rest}})
    with Graph() as graph, Scene(graph, config) as scene:
        scene.update()
        again = Config.parse(scene.saved().text())
        assert len(again.mappings("Displays")) == sum(isinstance(each, dict) for each in displays)
