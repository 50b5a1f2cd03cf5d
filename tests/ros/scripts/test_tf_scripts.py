"""Scripts as the public tutorials of tf and tf2 teach to write them, unmodified, in simulated and in wall time."""

from pathlib import Path

from rosmini.ros.scripts import ScriptSpec

HERE = Path(__file__).parent / "tf"


def spec(name):
    return ScriptSpec(str(HERE / name), ())


def said_by(ran, name):
    return [line.removeprefix(f"[{name}] ") for line in ran.lines if line.startswith(f"[{name}] ")]


def test_tf(run):
    # The listener starts first: on its first look nothing has come.
    end = "[turtle_tf_listener] stands still: True"
    ran = run(spec("turtle_tf_listener.py"), spec("turtle_tf_broadcaster.py"), until=end)
    assert said_by(ran, "turtle_tf_listener") == [
        "not yet: LookupException",
        "carrot at 1.50 1.00 yaw 90.0",
        "point at 2.00 2.00 in world",
        "waited for now: True",
        '"nobody" passed to lookupTransform argument source_frame does not exist',
        "stands still: True",
    ]
    assert ran.status == 0


def test_tf2(run):
    ran = run(spec("tf2_listener.py"), spec("turtle_tf_broadcaster.py"), until="[tf2_listener] True")
    assert said_by(ran, "tf2_listener") == [
        "tip at 1.50 1.25",
        "pose at 1.50 2.25",
        "again at 1.50 2.25 in world",
        "False",
        "True",
    ]
    assert ran.status == 0


def test_the_messages_of_the_package_tf(run):
    ran = run(
        "import tf.msg\nfrom tf.srv import FrameGraph\nimport tf\nprint(tf.msg.tfMessage._type, FrameGraph._type)"
    )
    assert ran.lines == ["[script] tf/tfMessage tf/FrameGraph"]
