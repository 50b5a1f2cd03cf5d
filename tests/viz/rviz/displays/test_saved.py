"""Displays as the real RViz writes them into its files: every property is known here, and written again as it was."""

import pytest
import yaml

from rosmini.viz.rviz import Config, Scene

POINTS = """
      Alpha: 1
      Autocompute Intensity Bounds: true
      Autocompute Value Bounds:
        Max Value: 10
        Min Value: -10
        Value: true
      Axis: Z
      Channel Name: intensity
      Color: 255; 255; 255
      Color Transformer: Intensity
      Decay Time: 0
      Invert Rainbow: false
      Max Color: 255; 255; 255
      Max Intensity: 4096
      Min Color: 0; 0; 0
      Min Intensity: 0
      Position Transformer: XYZ
      Queue Size: 10
      Selectable: true
      Size (Pixels): 3
      Size (m): 0.009999999776482582
      Style: Flat Squares
      Unreliable: false
      Use Fixed Frame: true
      Use rainbow: true"""
DISPLAYS = {
    "Marker": """
      Marker Topic: visualization_marker
      Namespaces:
        basic_shapes: true
      Queue Size: 100""",
    "MarkerArray": """
      Marker Topic: visualization_marker_array
      Namespaces: {}
      Queue Size: 100""",
    "InteractiveMarkers": """
      Enable Transparency: true
      Show Axes: false
      Show Descriptions: true
      Show Visual Aids: false
      Update Topic: /basic_controls/update""",
    "PointCloud": POINTS + "\n      Topic: /cloud",
    "PointCloud2": POINTS + "\n      Topic: /points",
    "Temperature": POINTS.replace("Name: intensity", "Name: temperature") + "\n      Topic: /t",
    "DepthCloud": POINTS
    + """
      Auto Size:
        Auto Size Factor: 1
        Value: true
      Color Image Topic: /camera/rgb/image_raw
      Color Transport Hint: raw
      Depth Map Topic: /camera/depth/image_raw
      Depth Map Transport Hint: raw
      Occlusion Compensation:
        Occlusion Time-Out: 30
        Value: false
      Topic Filter: true""",
    "Image": """
      Image Topic: /camera/rgb/image_raw
      Max Value: 1
      Median window: 5
      Min Value: 0
      Normalize Range: true
      Queue Size: 2
      Transport Hint: raw
      Unreliable: false""",
    "Camera": """
      Image Rendering: background and overlay
      Image Topic: /camera/rgb/image_raw
      Overlay Alpha: 0.5
      Queue Size: 2
      Transport Hint: raw
      Unreliable: false
      Visibility:
        Grid: true
        Value: true
      Zoom Factor: 1""",
    "Effort": """
      Alpha: 1
      History Length: 1
      Joints:
        All Enabled: true
      Queue Size: 10
      Robot Description: robot_description
      Scale: 1
      Topic: /joint_states
      Unreliable: false
      Width: 0.019999999552965164""",
    "WrenchStamped": """
      Alpha: 1
      Arrow Width: 0.5
      Force Arrow Scale: 2
      Force Color: 204; 51; 51
      Hide Small Values: true
      History Length: 1
      Queue Size: 10
      Topic: /wrench
      Torque Arrow Scale: 2
      Torque Color: 204; 204; 51
      Unreliable: false""",
}


@pytest.mark.parametrize("kind", DISPLAYS)
def test_all_that_rviz_writes_is_known_and_kept(stage, tmp_path, kind):
    text = f"""Visualization Manager:
  Displays:
    - Class: rviz/{kind}
      Name: {kind}
      Enabled: true
      Value: true{DISPLAYS[kind]}
  Global Options:
    Fixed Frame: map
"""
    file = tmp_path / "one.rviz"
    file.write_text(text, encoding="utf-8")
    with Scene(stage.graph, Config.read(file)) as scene:
        assert scene.warning == ""
        saved = yaml.safe_load(scene.save(tmp_path / "again.rviz").read_text(encoding="utf-8"))
    (given,) = yaml.safe_load(text)["Visualization Manager"]["Displays"]
    (again,) = saved["Visualization Manager"]["Displays"]
    assert {name: again[name] for name in given} == given
