"""The services of /gazebo answer as gazebo_ros_api_plugin does."""

import math
import re
from dataclasses import replace

import pytest

from rosmini.core.dynamic_reconfigure import Client
from rosmini.core.errors import RosminiError
from rosmini.core.time import Duration, Time
from rosmini.msgs import message_class

from .conftest import DIFF_DRIVE, box, husky, urdf


def state(model, x=0.0, y=0.0, *, vx=0.0, frame=""):
    message = message_class("gazebo_msgs/ModelState")()
    message.model_name, message.reference_frame = model, frame
    message.pose.position.x, message.pose.position.y = x, y
    message.twist.linear.x = vx
    return message


def get(bench, name, other=""):
    return bench.call("get_model_state", "gazebo_msgs/GetModelState", model_name=name, relative_entity_name=other)


def test_a_model_comes_and_goes(bench):
    there = bench()
    answer = there.spawn(box(), "crate", 1.0, 2.0)
    assert (answer.success, answer.status_message) == (True, "SpawnModel: Successfully spawned entity")
    properties = there.call("get_world_properties", "gazebo_msgs/GetWorldProperties")
    assert "crate" in properties.model_names
    assert properties.status_message == "GetWorldProperties: got properties"
    answer = there.call("delete_model", "gazebo_msgs/DeleteModel", model_name="crate")
    assert (answer.success, answer.status_message) == (True, "DeleteModel: successfully deleted model")
    answer = there.call("delete_model", "gazebo_msgs/DeleteModel", model_name="crate")
    assert not answer.success
    assert answer.status_message.startswith("DeleteModel: model does not exist")
    assert there.spawn(box(), "crate", 1.0, 2.0).success  # the name is free again


@pytest.mark.parametrize(
    ("xml", "name", "said"),
    [
        (box(), "first", "SpawnModel: Failure - entity already exists."),
        ("<robot name='r'>", "new", "line"),
        ("<robot name='r'><link name='a'/><link name='b'/></robot>", "new", "model_xml:1: the robot has 2 roots"),
        ("<sdf version='1.6'/>", "new", "no <model>"),
        ("<sdf version='1.6'><model name='m'><link/></model></sdf>", "new", 'name="..." is missing in <link>'),
        ("<world/>", "new", "input model_xml not SDF or URDF"),
        ("nothing at all", "new", "this is not XML"),
        (urdf(DIFF_DRIVE.replace("left_wheel", "left_weel")), "new", "did you mean left_wheel?"),
        (husky().replace("rear_left_joint</left", "rear_lft_joint</left"), "new", "did you mean rear_left_joint"),
        (urdf(DIFF_DRIVE.replace("<wheelDiameter>0.1", "<wheelDiameter>0")), "new", "<wheelDiameter> is more than 0 m"),
    ],
)  # fmt: skip
def test_what_cannot_come_is_refused_and_the_simulation_goes_on(bench, xml, name, said):
    there = bench()
    assert there.spawn(box(), "first").success
    models = list(there.server.world.models)
    answer = there.spawn(xml, name, 3.0)
    assert not answer.success
    assert said in answer.status_message
    assert list(there.server.world.models) == models
    before = there.server.world.now
    there.graph.run(0.5)
    assert there.server.world.now > before


def test_a_model_without_a_name_keeps_its_own(bench):
    there = bench()
    assert there.spawn(box("chest"), "").success
    assert "chest" in there.server.world.models


def test_an_occupied_place_is_refused(bench):
    there = bench()
    assert there.spawn(box(static=True), "first").success
    answer = there.spawn(urdf(), "robot", 0.2, 0.0)
    assert not answer.success
    assert "'first' is in its way" in answer.status_message
    assert "robot" not in there.server.world.models
    assert there.spawn(urdf(), "robot", 1.0, 0.0).success
    for x, what in ((1.0, "robot"), (0.1, "first")):
        answer = there.spawn(box(), "second", x, 0.0)
        assert not answer.success
        assert what in answer.status_message


def test_a_urdf_service_takes_no_sdf(bench):
    there = bench()
    answer = there.call("spawn_urdf_model", "gazebo_msgs/SpawnModel", model_name="b", model_xml=box())
    assert (answer.success, answer.status_message) == (False, "SpawnModel: Failure - model format is not URDF.")
    answer = there.call("spawn_sdf_model", "gazebo_msgs/SpawnModel", model_name="b", model_xml=urdf())
    assert answer.success


def test_the_state_of_a_model_in_the_world_and_seen_from_another(bench):
    there = bench()
    there.spawn(box(), "a", 1.0, 0.0, math.pi / 2)
    there.spawn(box(), "b", 1.0, 3.0)
    answer = get(there, "b")
    assert (answer.pose.position.x, answer.pose.position.y) == (1.0, 3.0)
    assert answer.status_message == "GetModelState: got properties"
    assert answer.header.seq == 1
    assert get(there, "b").header.seq == 2
    for frame in ("a", "a::link"):
        seen = get(there, "b", frame)
        assert (seen.pose.position.x, seen.pose.position.y) == pytest.approx((3.0, 0.0))
        assert seen.pose.orientation.z == pytest.approx(-(0.5**0.5))
        assert seen.header.frame_id == frame
    answer = get(there, "b", "c")
    assert not answer.success
    assert "relative_entity_name not found, did you forget to scope the body by model name?" in answer.status_message
    assert get(there, "nobody").status_message.startswith("GetModelState: model does not exist")


def test_a_model_is_put_elsewhere_and_slides(bench):
    there = bench()
    there.spawn(box(), "crate")
    there.spawn(box(static=True), "wall", 5.0)
    call = lambda message: there.call("set_model_state", "gazebo_msgs/SetModelState", model_state=message)
    answer = call(state("crate", 1.0, 1.0, vx=0.5))
    assert (answer.success, answer.status_message) == (True, "SetModelState: set model state done")
    assert get(there, "crate").twist.linear.x == pytest.approx(0.5)
    there.graph.run(2.0)
    x, y, _ = there.pose("crate")
    assert 1.01 < x < 1.5  # it slid, and friction has stopped it
    assert y == pytest.approx(1.0)
    assert call(state("crate", 1.0, 0.0, frame="wall")).success
    assert there.pose("crate")[:2] == pytest.approx((6.0, 0.0))
    for message, said in (
        (state("nobody"), "model does not exist"),
        (state("crate", frame="nowhere"), "specified reference frame entity does not exist"),
        (state("crate", math.nan), "finite"),
        (state("crate", 5.0), "is in its way"),
    ):
        answer = call(message)
        assert not answer.success
        assert said in answer.status_message
    assert there.pose("crate")[:2] == pytest.approx((6.0, 0.0))


def test_what_is_static_can_be_put_elsewhere_too(bench):
    there = bench()
    there.spawn(box(static=True), "wall", 5.0)
    there.spawn(urdf(), "robot", 0.0)
    scans = there.hear("/scan", "sensor_msgs/LaserScan")
    there.graph.run(0.25)
    assert scans[-1].ranges[90] == pytest.approx(4.8)
    there.call("set_model_state", "gazebo_msgs/SetModelState", model_state=state("wall", 3.0))
    there.graph.run(0.25)
    assert scans[-1].ranges[90] == pytest.approx(2.8)
    there.call("reset_world", "std_srvs/Empty")
    there.graph.run(0.25)
    assert scans[-1].ranges[90] == pytest.approx(4.8)


def test_the_topic_sets_states_too(bench):
    there = bench()
    there.spawn(box(), "crate")
    publisher = there.node.publisher("/gazebo/set_model_state", message_class("gazebo_msgs/ModelState"))
    publisher.wait_for_subscribers()
    publisher.publish(state("crate", 2.0))
    there.graph.run(0.1)
    assert there.pose("crate")[0] == pytest.approx(2.0)


def test_states_of_models_and_links_are_published(bench):
    there = bench()
    there.spawn(urdf(), "robot", 1.0, 0.0, math.pi / 2)
    models = there.hear("/gazebo/model_states", "gazebo_msgs/ModelStates")
    links = there.hear("/gazebo/link_states", "gazebo_msgs/LinkStates")
    there.drive("/cmd_vel", 0.2)
    there.graph.run(2.0)
    message = models[-1]
    robot = message.name.index("robot")
    assert message.twist[robot].linear.y == pytest.approx(0.2)
    assert message.twist[robot].linear.x == pytest.approx(0.0, abs=1e-12)
    assert message.pose[robot].position.x == pytest.approx(1.0)
    assert 180 <= len(models) <= 201  # 100 a second
    assert {"robot::base_footprint", "robot::left", "robot::right"} <= set(links[-1].name)
    left = links[-1].pose[links[-1].name.index("robot::left")].position
    assert (left.x - message.pose[robot].position.x, left.z) == pytest.approx((-0.15, 0.05))


def test_links_are_told_and_set(bench):
    there = bench()
    there.spawn(urdf(), "robot")
    ask = lambda name: there.call("get_link_state", "gazebo_msgs/GetLinkState", link_name=name)
    answer = ask("robot::laser")  # it became part of another link
    assert answer.success
    assert answer.link_state.pose.position.z == pytest.approx(0.2)
    answer = ask("robot::lasr")
    assert not answer.success
    assert "did you forget to scope the link by model name?" in answer.status_message
    assert "did you mean laser?" in answer.status_message
    message = message_class("gazebo_msgs/LinkState")(link_name="robot::left")
    message.pose.position.x, message.pose.position.y = 2.0, 0.15
    message.pose.orientation.x, message.pose.orientation.w = -(0.5**0.5), 0.5**0.5
    answer = there.call("set_link_state", "gazebo_msgs/SetLinkState", link_state=message)
    assert (answer.success, answer.status_message) == (True, "SetLinkState: success")
    assert there.pose("robot") == pytest.approx((2.0, 0.0, 0.0), abs=1e-9)


def test_properties_of_models_links_and_joints(bench):
    there = bench()
    there.spawn(urdf(), "robot")
    model = there.call("get_model_properties", "gazebo_msgs/GetModelProperties", model_name="robot")
    assert model.body_names == ["base_footprint", "left", "right"]
    assert model.joint_names == ["left_wheel", "right_wheel"]
    assert len(model.geom_names) == 3
    assert not model.is_static
    link = there.call("get_link_properties", "gazebo_msgs/GetLinkProperties", link_name="robot::left")
    assert (link.mass, link.izz) == (0.1, 1e-4)
    there.drive("/cmd_vel", 0.1)
    there.graph.run(1.1)
    joint = there.call("get_joint_properties", "gazebo_msgs/GetJointProperties", joint_name="left_wheel")
    assert joint.rate[0] == pytest.approx(2.0)  # 0.1 m/s on wheels of 5 cm
    assert not there.call("get_joint_properties", "gazebo_msgs/GetJointProperties", joint_name="no").success


def test_time_stands_goes_on_and_is_reset(bench):
    there = bench()
    there.spawn(urdf(), "robot")
    there.drive("/cmd_vel", 0.2)
    there.graph.run(1.0)
    there.call("pause_physics", "std_srvs/Empty")
    now, pose = there.server.world.now, there.pose("robot")
    there.graph.run(1.0)
    assert (there.server.world.now, there.pose("robot")) == (now, pose)
    assert there.call("get_physics_properties", "gazebo_msgs/GetPhysicsProperties").pause
    there.call("unpause_physics", "std_srvs/Empty")
    there.graph.run(1.0)
    assert there.server.world.now == pytest.approx(now + 1.0, abs=0.01)
    assert there.pose("robot")[0] == pytest.approx(pose[0] + 0.2, abs=0.01)
    there.call("reset_world", "std_srvs/Empty")
    assert there.pose("robot") == (0.0, 0.0, 0.0)
    assert there.server.world.now > 1.9  # time goes on
    there.call("reset_simulation", "std_srvs/Empty")
    assert there.server.world.now == pytest.approx(0.0, abs=0.01)


def test_physics_can_be_changed(bench):
    there = bench()
    there.spawn(box(), "crate")
    answer = there.call("get_physics_properties", "gazebo_msgs/GetPhysicsProperties")
    assert (answer.time_step, answer.max_update_rate, answer.gravity.z) == (0.001, 1000.0, -9.8)
    assert (answer.ode_config.sor_pgs_iters, answer.ode_config.erp) == (50, 0.2)
    request = {
        "time_step": 0.002,
        "max_update_rate": 1000.0,
        "gravity": answer.gravity,
        "ode_config": answer.ode_config,
    }
    request["gravity"].z = -1.0
    answer = there.call("set_physics_properties", "gazebo_msgs/SetPhysicsProperties", **request)
    assert (answer.success, answer.status_message) == (True, "physics engine updated")
    assert there.node.get_param("/gazebo/time_step") == 0.002
    now = there.server.world.now
    there.graph.run(1.0)
    assert there.server.world.now == pytest.approx(now + 2.0, abs=0.02)  # twice as fast
    there.call("set_model_state", "gazebo_msgs/SetModelState", model_state=state("crate", vx=0.5))
    there.graph.run(2.0)
    moon = there.pose("crate")[0]
    request["gravity"].z, request["time_step"] = -9.8, 0.001
    there.call("set_physics_properties", "gazebo_msgs/SetPhysicsProperties", **request)
    there.call("set_model_state", "gazebo_msgs/SetModelState", model_state=state("crate", vx=0.5))
    there.graph.run(2.0)
    assert moon > 2 * there.pose("crate")[0]  # what weighs less slides farther
    request["time_step"] = 0.0
    answer = there.call("set_physics_properties", "gazebo_msgs/SetPhysicsProperties", **request)
    assert not answer.success
    assert "time_step is 0.0 s" in answer.status_message


@pytest.mark.parametrize(
    ("field", "value", "why"),
    [
        ("time_step", math.nan, "time_step is nan"),
        ("time_step", math.inf, "time_step is inf"),
        ("time_step", -0.001, r"time_step is -0\.001 s; it must be from 1e-06 to 1 s"),
        ("time_step", 1e-7, "from 1e-06 to 1 s"),
        ("time_step", 2.0, "from 1e-06 to 1 s"),
        ("max_update_rate", -1.0, "max_update_rate is -1.0 Hz"),
        ("max_update_rate", math.nan, "max_update_rate is nan"),
        ("gravity.z", 9.8, r"gravity is \(0\.0, 0\.0, 9\.8\) m/s2"),
        ("gravity.x", 1.0, "point down"),
        ("gravity.y", -1.0, "point down"),
        ("gravity.z", -math.inf, "gravity.z is -inf"),
        ("gravity.x", math.nan, "gravity.x is nan"),
    ],
)
def test_physics_that_make_no_sense_are_refused(bench, field, value, why):
    there = bench()
    before = there.server.world.physics
    now = there.call("get_physics_properties", "gazebo_msgs/GetPhysicsProperties")
    request = {name: getattr(now, name) for name in ("time_step", "max_update_rate", "gravity", "ode_config")}
    if field.startswith("gravity"):
        setattr(request["gravity"], field[-1], value)
    else:
        request[field] = value
    answer = there.call("set_physics_properties", "gazebo_msgs/SetPhysicsProperties", **request)
    assert not answer.success
    assert answer.status_message.startswith("physics engine not updated: ")
    assert re.search(why, answer.status_message)
    assert there.server.world.physics == before


def test_parameters_of_the_physics_are_limited(bench):
    there = bench()
    client = Client(there.node, "gazebo", timeout=1.0)
    for value, limited in ((100.0, 1.0), (-1.0, 1e-6), (0.0, 1e-6)):
        client.update_configuration({"time_step": value})
        assert there.server.world.physics.time_step == there.node.get_param("/gazebo/time_step") == limited
    for name, wrong in (("time_step", math.nan), ("gravity_z", 9.8), ("gravity_x", 1.0), ("gravity_y", math.nan)):
        before = there.server.world.physics
        with pytest.raises(RosminiError, match=r"nan|point down"):
            client.update_configuration({name: wrong})
        assert there.server.world.physics == before
    client.update_configuration({"time_step": 0.001, "max_update_rate": -5.0, "gravity_z": -1.6})
    assert there.server.world.physics.max_update_rate == 0.0
    answer = there.call("get_physics_properties", "gazebo_msgs/GetPhysicsProperties")
    assert (answer.gravity.z, there.server.engine.surface.gravity) == (-1.6, 1.6)


def wrench(there, body, force, seconds):
    request = message_class("geometry_msgs/Wrench")()
    request.force.x = force
    return there.call(
        "apply_body_wrench",
        "gazebo_msgs/ApplyBodyWrench",
        body_name=body,
        wrench=request,
        start_time=Time(0),
        duration=Duration.from_sec(seconds),
    )


def test_a_force_pushes_a_thing_as_newton_says(bench):
    there = bench()
    there.spawn(box(mass=2.0), "crate")
    physics = there.server.world.physics
    there.server.set_physics(replace(physics, gravity_z=0.0))  # nothing rubs
    assert wrench(there, "crate::link", 4.0, 0.5).success
    there.graph.run(1.0)
    vx, _, _ = there.server.world.model("crate").velocity
    assert vx == pytest.approx(4.0 / 2.0 * 0.5, rel=0.02)


def test_a_force_that_wheels_hold_is_refused(bench):
    there = bench()
    there.spawn(urdf(), "robot")
    there.spawn(box(static=True), "wall", 3.0)
    assert "wheels" in wrench(there, "robot::base_footprint", 1.0, 1.0).status_message
    assert "static" in wrench(there, "wall::link", 1.0, 1.0).status_message
    assert wrench(there, "nobody::link", 1.0, 1.0).status_message.startswith("ApplyBodyWrench: body does not exist")


def test_a_force_lasts_until_it_is_cleared(bench):
    there = bench()
    there.spawn(box(), "crate")
    assert wrench(there, "crate::link", 20.0, -1.0).success
    there.graph.run(0.5)
    there.call("clear_body_wrenches", "gazebo_msgs/BodyRequest", body_name="crate::link")
    there.graph.run(2.0)
    x = there.pose("crate")[0]
    there.graph.run(1.0)
    assert x > 0.05
    assert there.pose("crate")[0] == pytest.approx(x, abs=1e-6)
