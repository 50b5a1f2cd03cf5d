"""The whole of it: simulator, map_server, fake_localization and move_base, as launch files start them."""

import io
import math
import re
from types import SimpleNamespace

import pytest

from rosmini.core.actionlib import SimpleActionClient, Status
from rosmini.core.errors import ServiceException
from rosmini.core.packages import assets_dir
from rosmini.core.time import Time
from rosmini.msgs.dynamic_reconfigure.msg import BoolParameter, Config, DoubleParameter, StrParameter
from rosmini.msgs.dynamic_reconfigure.srv import Reconfigure
from rosmini.msgs.geometry_msgs.msg import PoseStamped, Twist
from rosmini.msgs.move_base_msgs.msg import MoveBaseAction, MoveBaseGoal, RecoveryStatus
from rosmini.msgs.nav_msgs.srv import GetPlan
from rosmini.navigation.move_base.state_machine import State
from rosmini.navigation.nav_core import BaseGlobalPlanner, BaseLocalPlanner, NoPath, NoValidCommand, pose_stamped
from rosmini.ros.launch import roslaunch
from rosmini.sim.shapes import Box
from rosmini.sim.world import Obstacle

ROOM = {
    "map_file": str(assets_dir() / "ros/rosmini_sim/maps/room.yaml"),
    "localization": "fake_localization",
    "open_rviz": False,
}
IN_A_WALL = (2.44, 1.3, 0.0)
NO_PLAN = (Status.ABORTED, "Failed to find a valid plan. Even after executing recovery behaviors.")


class Straight(BaseGlobalPlanner, plugin="test_node/Straight"):
    """A reader's own: straight on, every 5 cm, if the costs allow it."""

    def make_plan(self, start, goal):
        a, b = start.pose.position, goal.pose.position
        steps = max(2, int(math.hypot(b.x - a.x, b.y - a.y) / 0.05))
        poses = [
            pose_stamped("map", Time(), (a.x + (b.x - a.x) * i / steps, a.y + (b.y - a.y) * i / steps, 0.0))
            for i in range(steps)
        ]
        if any(self.cost(each) > 252 for each in poses):
            raise NoPath("something is in the way")
        return [*poses, goal]

    def cost(self, pose):
        cell = self.costmap.grid.world_to_map(pose.pose.position.x, pose.pose.position.y)
        return 255 if cell is None else self.costmap.grid.cost(*cell)


class Endless(BaseGlobalPlanner, plugin="test_node/Endless"):
    def make_plan(self, start, goal):
        self.costmap.node.sleep(1e6)


class Stubborn(BaseLocalPlanner, plugin="test_node/Stubborn"):
    """Finds no command until it has been asked for one often enough."""

    asked = 0

    def set_plan(self, plan):
        pass

    def compute_velocity_commands(self):
        Stubborn.asked += 1
        raise NoValidCommand("it does not like to")

    def is_goal_reached(self):
        return Stubborn.asked > 12


def start(graph, *, careful=False):
    """The room with a burger, and what stands around `move_base`."""
    said = io.StringIO()
    console = {"stdout": said, "stderr": said}
    for package, file, arguments in (
        ("rosmini_sim", "simulator.launch", {"world": "room", "noise": "0"}),
        ("turtlebot3_navigation", "turtlebot3_navigation.launch", {**ROOM, "careful": careful}),
    ):
        roslaunch(package, file, graph=graph, console=console, model="burger", **arguments)
    graph.run(3.0)
    node = graph.node("client")
    heard = []
    node.subscriber("cmd_vel", Twist, lambda twist: heard.append((twist.linear.x, twist.angular.z)))
    client = SimpleActionClient(node, "move_base", MoveBaseAction)
    graph.run(0.5)
    return SimpleNamespace(
        graph=graph,
        said=said.getvalue,
        node=node,
        client=client,
        commands=heard,
        move_base=graph.nodes["/move_base"].program,
        sim=graph.nodes["/simulator"].program,
    )


def goal(x, y, yaw=0.0, frame="map"):
    return MoveBaseGoal(target_pose=pose_stamped(frame, Time(), (x, y, yaw)))


def go(rig, target, seconds=120.0):
    """Send a goal, and let time pass until it is over; how it ended."""
    rig.client.send_goal(target)
    rig.graph.run(0.2)
    return until_over(rig, seconds)


def until_over(rig, seconds=120.0):
    end = rig.node.now().to_sec() + seconds
    while rig.client.get_state() in (Status.PENDING, Status.ACTIVE) and rig.node.now().to_sec() < end:
        rig.graph.run(0.5)
    return rig.client.get_state(), rig.client.get_goal_status_text()


COSTMAPS = {
    "global_costmap": ("inflation_layer", "obstacle_layer", "static_layer"),
    "local_costmap": ("inflation_layer", "obstacle_layer"),
}
"""The layers of each, with ROBOTIS's files."""


def check_topics_and_services(node):
    """As `rosnode info` prints them of a real `move_base` 1.17.3 with the same planners and layers."""
    changeable = ["", "/DWAPlannerROS", *(f"/{each}" for each in COSTMAPS)]
    changeable += [f"/{costmap}/{layer}" for costmap, layers in COSTMAPS.items() for layer in layers]
    assert set(node.publications) == {
        "/rosout",
        "/cmd_vel",
        "/move_base/DWAPlannerROS/cost_cloud",
        "/move_base/DWAPlannerROS/global_plan",
        "/move_base/DWAPlannerROS/local_plan",
        "/move_base/DWAPlannerROS/trajectory_cloud",
        "/move_base/NavfnROS/plan",
        "/move_base/current_goal",
        "/move_base/feedback",
        "/move_base/goal",
        "/move_base/recovery_status",
        "/move_base/result",
        "/move_base/status",
        *(f"/move_base/{each}/{topic}" for each in COSTMAPS for topic in ("costmap", "costmap_updates", "footprint")),
        *(f"/move_base{each}/parameter_{what}" for each in changeable for what in ("descriptions", "updates")),
    }
    assert set(node.subscriptions) == {
        "/map", "/move_base/cancel", "/move_base/global_costmap/footprint", "/move_base/goal",
        "/move_base/local_costmap/footprint", "/move_base_simple/goal", "/odom", "/scan", "/tf", "/tf_static",
    }  # fmt: skip
    assert set(node.services) == {
        "/move_base/NavfnROS/make_plan",
        "/move_base/clear_costmaps",
        "/move_base/get_loggers",
        "/move_base/make_plan",
        "/move_base/set_logger_level",
        *(f"/move_base{each}/set_parameters" for each in changeable),
    }


def test_it_gets_there_and_says_so(graph):
    rig = start(graph)
    check_topics_and_services(graph.nodes["/move_base"])
    goals, positions = [], []
    rig.node.subscriber("move_base/current_goal", PoseStamped, goals.append)
    graph.run(0.5)
    rig.client.send_goal(goal(1.9, 2.5), feedback_cb=positions.append)
    graph.run(3.0)
    assert until_over(rig) == (Status.SUCCEEDED, "Goal reached.")
    x, y, _ = rig.sim.truth()
    assert math.dist((x, y), (1.9, 2.5)) < 0.12
    assert goals[0].pose.position.x == 1.9
    assert math.dist((positions[-1].base_position.pose.position.x, 0), (x, 0)) < 0.1
    assert rig.commands[-1] == (0.0, 0.0)
    assert rig.move_base.state is State.PLANNING


def test_a_simple_goal_another_one_and_a_cancellation(graph):
    rig = start(graph)
    simple = rig.node.publisher("move_base_simple/goal", PoseStamped, queue_size=1)
    graph.run(0.5)
    simple.publish(goal(1.9, 2.5).target_pose)
    graph.run(3.0)
    assert rig.move_base.state is State.CONTROLLING
    rig.client.send_goal(goal(1.0, 0.0))
    graph.run(3.0)
    assert rig.client.get_state() is Status.ACTIVE
    assert rig.move_base.goal.pose.position.x == 1.0
    rig.client.cancel_goal()
    graph.run(1.0)
    assert rig.client.get_state() is Status.PREEMPTED
    assert rig.commands[-1] == (0.0, 0.0)
    assert rig.move_base.goal is None


@pytest.mark.nightly
def test_of_the_goals_that_arrive_before_the_action_server_the_newest_is_reached(graph):
    desk = graph.node("desk").publisher("move_base_simple/goal", PoseStamped, latch=True)
    for x in (1.9, 0.8):
        desk.publish(goal(x, 0.0).target_pose)
    rig = start(graph)
    assert rig.move_base.goal.pose.position.x == 0.8
    graph.run(20.0)
    assert math.dist(rig.sim.truth()[:2], (0.8, 0.0)) < 0.12
    assert rig.move_base.goal is None


def test_goals_that_are_none(graph):
    rig = start(graph)
    change(rig, planner_patience=0.5, recovery_behavior_enabled=False)
    bad = goal(1.0, 0.0)
    bad.target_pose.pose.orientation.w = 0.0
    assert go(rig, bad) == (Status.ABORTED, "Aborting on goal because it was sent with an invalid quaternion")
    for target, why in (
        (goal(90.0, 0.0), "off the global costmap"),
        (goal(*IN_A_WALL), "253|254"),
        (goal(1.0, 0.0, frame="mars"), "mars"),
    ):
        before = len(rig.said())
        state, text = go(rig, target)
        assert (state, text) == NO_PLAN
        assert re.search(why, rig.said()[before:]), why


@pytest.mark.nightly
def test_recoveries_run_in_their_order_and_the_list_ends(graph):
    rig = start(graph)
    statuses = []
    rig.node.subscriber("move_base/recovery_status", RecoveryStatus, statuses.append)
    graph.run(0.5)
    change(rig, base_local_planner="test_node/Stubborn", controller_patience=0.3, oscillation_timeout=0.0)
    Stubborn.asked = -1000
    state, text = go(rig, goal(1.0, 0.0))
    assert (state, text) == (Status.ABORTED, "Failed to find a valid control. Even after executing recovery behaviors.")
    expected = ["conservative_reset", "rotate_recovery", "aggressive_reset", "rotate_recovery"]
    assert [each.recovery_behavior_name for each in statuses] == expected
    assert [each.current_recovery_number for each in statuses] == [0, 1, 2, 3]
    assert {each.total_number_of_recoveries for each in statuses} == {4}
    assert max(turn for _, turn in rig.commands) == 1.0, "it turned around"
    assert "it does not like to" in rig.said()
    Stubborn.asked = 8
    assert go(rig, goal(1.0, 0.0))[0] is Status.SUCCEEDED, "it recovers"


def change(rig, **values):
    """Change parameters by dynamic_reconfigure; return the texts that hold then."""
    client = rig.node.service_client("/move_base/set_parameters", Reconfigure)
    answers = []
    config = Config()
    for name, value in values.items():
        if isinstance(value, bool):
            config.bools.append(BoolParameter(name=name, value=value))
        elif isinstance(value, str):
            config.strs.append(StrParameter(name=name, value=value))
        else:
            config.doubles.append(DoubleParameter(name=name, value=value))
    rig.node.spawn("changer", lambda: answers.append(client(config=config)))
    rig.graph.run(0.5)
    return {each.name: each.value for each in answers[0].config.strs}


@pytest.mark.nightly
def test_planners_change_at_run_time(graph):
    rig = start(graph)
    held = change(rig, base_global_planner="test_node/Straight")
    assert held["base_global_planner"] == "test_node/Straight"
    assert "/move_base/NavfnROS/plan" not in graph.nodes["/move_base"].publications
    assert go(rig, goal(1.0, 0.0, frame="base_footprint"))[0] is Status.SUCCEEDED
    assert math.dist(rig.sim.truth()[:2], (1.0, 0.0)) < 0.12
    held = change(rig, base_global_planner="test_node/Strait", base_local_planner="dwa_local_planner/DWA")
    assert held["base_global_planner"] == "test_node/Straight"
    assert held["base_local_planner"] == "dwa_local_planner/DWAPlannerROS"
    said = rig.said()
    assert "Failed to create the test_node/Strait planner" in said
    assert "did you mean test_node/Straight" in said
    change(rig, base_global_planner="navfn/NavfnROS")
    assert "/move_base/NavfnROS/plan" in graph.nodes["/move_base"].publications


@pytest.mark.nightly
def test_a_planner_that_never_returns(graph):
    rig = start(graph)
    change(rig, base_global_planner="test_node/Endless", recovery_behavior_enabled=False, planner_patience=2.0)
    state, text = go(rig, goal(1.0, 0.0), 30.0)
    assert (state, text) == NO_PLAN
    assert "make_plan() of the global planner test_node/Endless did not return within 2 s" in rig.move_base.problem


def test_make_plan(graph):
    rig = start(graph)
    client = rig.node.service_client("/move_base/make_plan", GetPlan)
    answers = []

    def ask(x, y, tolerance=0.0):
        def call():
            try:
                answers.append(len(client(goal=goal(x, y).target_pose, tolerance=tolerance).plan.poses))
            except ServiceException as error:
                answers.append(str(error))

        rig.node.spawn("asker", call)
        graph.run(0.5)
        return answers[-1]

    assert ask(1.9, 2.5) > 40
    assert ask(*IN_A_WALL[:2]) == 0
    assert ask(*IN_A_WALL[:2], tolerance=0.5) > 20
    rig.client.send_goal(goal(1.9, 2.5))
    graph.run(1.0)
    assert "must be in an inactive state" in ask(1.0, 0.0)


@pytest.mark.nightly
def test_careful_plans_keep_the_robots_width_and_it_backs_out_of_a_corner(graph):
    """Its nose is between boxes: neither ahead nor round, the corners of its outline would hit them."""
    rig = start(graph, careful=True)
    move_base = rig.move_base
    local = move_base.local_costmap
    assert local.inscribed_radius < 0.105 < move_base.global_costmap.inscribed_radius < local.circumscribed_radius
    for costmap in (move_base.global_costmap, local):
        (layer,) = (each for each in costmap.layers if each.name == "obstacle_layer")
        assert [source.settings.inf_is_valid for source in layer.sources] == [True]
    assert [each.name for each in move_base.recovery_behaviors][-2:] == ["second_reset", "last_reset"]
    assert "will clear nothing" not in rig.said()
    x, y, _ = rig.sim.truth()
    for number, (dx, dy) in enumerate([(0.16, 0.0), (-0.06, 0.22), (-0.06, -0.22)]):
        size = (0.1, 0.6) if dx > 0 else (0.3, 0.1)
        rig.sim.engine.insert(Obstacle(f"box {number}", Box(*size), (x + dx, y + dy, 0.0), mass=50.0))
    graph.run(1.0)
    go(rig, goal(1.5, 0.0), seconds=45.0)
    assert math.dist(rig.sim.truth()[:2], (x, y)) > 0.3
    assert min(forward for forward, _ in rig.commands) < 0
    assert not rig.sim.engine.touching(rig.sim.name)


def walled_in(rig):
    """Boxes around where the robot stands, an arm's length off, as somebody might put them there; their names."""
    x, y, _ = rig.sim.truth()
    names = []
    for number, (dx, dy) in enumerate([(0.5, 0.0), (-0.5, 0.0), (0.0, 0.5), (0.0, -0.5)]):
        size = (0.1, 1.1) if dx else (0.88, 0.1)
        names.append(f"box {number}")
        rig.sim.engine.insert(Obstacle(names[-1], Box(*size), (x + dx, y + dy, 0.0), mass=50.0))
    return names


@pytest.mark.nightly
def test_a_robot_that_is_walled_in_says_so_and_goes_on_when_it_is_freed(graph):
    """Nothing is played here: lasers see the boxes, the planner finds no way, recoveries run, the goal is aborted."""
    rig = start(graph)
    statuses = []
    rig.node.subscriber("move_base/recovery_status", RecoveryStatus, statuses.append)
    names = walled_in(rig)
    graph.run(1.0)
    target = goal(1.5, 0.0)
    state, text = go(rig, target)
    assert (state, text) == NO_PLAN
    order = ["conservative_reset", "rotate_recovery", "aggressive_reset", "rotate_recovery"]
    assert [each.recovery_behavior_name for each in statuses] == order
    assert "no path leads from the start" in rig.said()
    assert math.dist(rig.sim.truth()[:2], (0.0, 0.0)) < 0.1, "it turned, and went nowhere"
    for name in names:
        rig.sim.engine.remove_obstacle(name)
    assert go(rig, target)[0] is Status.SUCCEEDED
