"""`move_base/move_base`: drives a robot to a goal (http://wiki.ros.org/move_base).

It offers the action `move_base`, also accepts goals on `move_base_simple/goal`, and commands the base on `cmd_vel`. The
services `~make_plan` and `~clear_costmaps`, all topics, parameters and texts are those of ROS. Planning runs in a
separate lane; the control cycle runs at `controller_frequency` in the graph's time.

There are four differences from the original. A goal in another frame is transformed with the latest transform, whatever
its stamp. A robot that oscillates is stopped in the same cycle instead of being commanded once more. A goal on
`move_base_simple/goal` that arrives before the action server has started is kept; the original loses it. Any exception
that a plugin raises counts as a failed call, and the log says where it was raised.
"""

from __future__ import annotations

from collections.abc import Sequence
from contextlib import suppress
from typing import Any

from rosmini.core.actionlib import SimpleActionServer
from rosmini.core.dynamic_reconfigure import Server
from rosmini.core.errors import ROSInterruptException, RosminiError
from rosmini.core.graph import Node
from rosmini.core.graph.show import show
from rosmini.core.tf import TransformListener
from rosmini.msgs import message_class, service_class
from rosmini.navigation.costmap_2d.costmap import FREE_SPACE
from rosmini.navigation.costmap_2d.costmap_ros import Costmap2DROS
from rosmini.navigation.kernels import prepare
from rosmini.navigation.nav_core import BadGoal, NavigationFailure, TransformMissing, planar_pose
from rosmini.navigation.nav_core.poses import checked_goal

from .checks import check_setup
from .parameters import MoveBaseConfig, MoveBaseParameters
from .planning import PlannerLane, offsets_within
from .plugin_calls import call
from .plugins import GLOBAL, LOCAL, Planners
from .recoveries import Recoveries
from .state_machine import Abort, Follow, Plan, Recover, State, StateMachine

BAD_QUATERNION = "Aborting on goal because it was sent with an invalid quaternion"
RECOVERY_TIME_LIMIT = 120.0
"""Time limit for a recovery behaviour that is not part of rosmini [s]."""
WARN_PERIOD = 1.0
"""Minimum interval between repetitions of the same warning [s]."""


class MoveBase:
    """The `move_base` node."""

    def __init__(self, node: Node) -> None:
        self.node = node
        self.parameters = own = MoveBaseParameters.read(node)
        self.config: MoveBaseConfig = own
        self.buffer = TransformListener(node).buffer
        self._advertise()
        self.global_costmap = Costmap2DROS("global_costmap", self.buffer, node)
        self.global_costmap.pause()
        self.planners = Planners(node, self.buffer, self.global_costmap)
        self.planners.load(GLOBAL, own.base_global_planner)
        self.local_costmap = Costmap2DROS("local_costmap", self.buffer, node)
        self.local_costmap.pause()
        self.planners.local_costmap = self.local_costmap
        self.planners.load(LOCAL, own.base_local_planner)
        prepare(node)
        self.global_costmap.start()
        self.local_costmap.start()
        radius = float(node.get_param("~local_costmap/circumscribed_radius", 0.46))
        self._clearing_radius = radius if own.clearing_radius is None else own.clearing_radius
        self._offer_services()
        if own.shutdown_costmaps:
            self._stop_costmaps()
        self.recovery_behaviors = Recoveries(node, self.buffer, self.global_costmap, self.local_costmap).load(
            rotate=own.clearing_rotation_allowed,
            reset_distance=own.conservative_reset_dist,
            circumscribed_radius=radius,
        )
        self.machine = StateMachine(own, len(self.recovery_behaviors))
        self.goal: Any = None
        """The current goal in the global frame (`PoseStamped`), or None."""
        self.plan: Sequence[Any] = ()
        """The plan that the local planner is following."""
        self.problem = ""
        """The reason for the last failure to plan or to find a command."""
        self.lane = PlannerLane(node, self.machine, self._make_plan, self._stop_base)
        check_setup(self)
        self.action.start()
        self._defaults: dict[str, Any] | None = None
        self._reconfigure_server = Server(node, MoveBaseConfig, self._reconfigure)

    def _advertise(self) -> None:
        node = self.node
        self._twist = message_class("geometry_msgs/Twist")
        stamped = message_class("geometry_msgs/PoseStamped")
        self._action_goal = message_class("move_base_msgs/MoveBaseActionGoal")
        self._feedback = message_class("move_base_msgs/MoveBaseFeedback")()
        self._recovery = message_class("move_base_msgs/RecoveryStatus")
        self.action = SimpleActionServer(
            node,
            "move_base",
            message_class("move_base_msgs/MoveBaseAction"),
            execute_cb=self._execute,
            auto_start=False,
        )
        self._commands = node.publisher("cmd_vel", self._twist, queue_size=1)
        self._current_goal = node.publisher("~current_goal", stamped, queue_size=10)
        self._early_goal: Any = None
        """The latest pose on `move_base_simple/goal` that arrived before the action server was connected."""
        self._has_server = False
        self._goals = node.publisher(
            "move_base/goal", self._action_goal, queue_size=1, on_connect=self._goals_connected
        )
        self._recoveries = node.publisher("move_base/recovery_status", self._recovery, queue_size=1)
        for publisher in (self._commands, self._current_goal, self._recoveries):
            publisher.expect_nobody()
        node.subscriber("move_base_simple/goal", stamped, self._simple_goal, queue_size=1)
        node.on_shutdown(self._on_shutdown)

    def _offer_services(self) -> None:
        self.node.service("~make_plan", service_class("nav_msgs/GetPlan"), self._make_plan_service)
        self.node.service("~clear_costmaps", service_class("std_srvs/Empty"), self._clear_costmaps)

    def __repr__(self) -> str:
        return f"<MoveBase {self.node.name}: {self.state.value}{'' if self.goal is None else ', with a goal'}>"

    # -- public state --------------------------------------------------------------------------------------------

    @property
    def state(self) -> State:
        """The current state: PLANNING, CONTROLLING or CLEARING."""
        return self.machine.state

    @property
    def planner(self) -> Any:
        """The global planner."""
        return self.planners.of[GLOBAL]

    @property
    def controller(self) -> Any:
        """The local planner."""
        return self.planners.of[LOCAL]

    def show(self, **options: Any) -> Any:
        """Return a picture of the loaded parts and the topics that connect them to other nodes."""
        return show("move_base", self, **options)

    def _now(self) -> float:
        return self.node.clock.now_ns() * 1e-9

    # -- goals ---------------------------------------------------------------------------------------------------

    def _simple_goal(self, pose: Any) -> None:
        """Forward a pose from `move_base_simple/goal` to the action server once it is connected."""
        if not self._has_server:
            self._early_goal = pose
            return
        goal = self._action_goal()
        goal.header.stamp = self.node.now()
        goal.goal.target_pose = pose
        self._goals.publish(goal)

    def _goals_connected(self, subscriber: str) -> None:
        """Send the waiting goal once this node's own action server is connected."""
        if subscriber != self.node.name or self._has_server:
            return
        self._has_server = True
        pose, self._early_goal = self._early_goal, None
        if pose is not None:
            self._simple_goal(pose)

    def _accept(self, message: Any) -> bool:
        """Start driving to a goal, or abort it if its pose is invalid or tilted; return whether it was accepted."""
        try:
            checked_goal(message.target_pose)
        except BadGoal as error:
            self.node.logerr(str(error))
            self.action.set_aborted(None, BAD_QUATERNION)
            return False
        self._start_goal(message.target_pose)
        return True

    def _start_goal(self, target: Any) -> None:
        """Start driving to a pose in any frame."""
        try:
            self.goal = self.global_costmap.to_global(target)
        except TransformMissing as error:
            self.node.logwarn(
                f"Failed to transform the goal pose from {target.header.frame_id} into the "
                f"{self.global_costmap.global_frame} frame: {error}"
            )
            self.goal = target
        self.problem = ""
        self.plan = ()
        self.lane.goal = self.goal
        self.machine.start_goal(self._now())
        self.lane.wake()
        self._current_goal.publish(self.goal)

    def _execute(self, message: Any) -> None:
        """Run the control cycle until the goal is finished."""
        self._stop_base()
        if not self._accept(message):
            return
        if self.config.shutdown_costmaps:
            self.global_costmap.start()
            self.local_costmap.start()
        frequency = self.config.controller_frequency
        rate = self.node.rate(frequency)
        while not self.node.is_shutdown():
            if self.config.controller_frequency != frequency:
                frequency = self.config.controller_frequency
                self.node.loginfo(f"Setting controller frequency to {frequency:.2f}")
                rate = self.node.rate(frequency)
            if self.action.is_preempt_requested() and not self._handle_preemption():
                return
            began = self.node.clock.now_ns()
            if self._cycle():
                return
            took = (self.node.clock.now_ns() - began) * 1e-9
            rate.sleep()
            if took > 1 / frequency and self.state is State.CONTROLLING:
                self.node.logwarn(
                    f"Control loop missed its desired rate of {frequency:.4f}Hz... the loop actually took "
                    f"{took:.4f} seconds"
                )

    def _handle_preemption(self) -> bool:
        """Accept the waiting goal, or stop if there is none; return whether there is a goal to continue with."""
        if self.action.is_new_goal_available():
            return self._accept(self.action.accept_new_goal())
        self._clear_goal()
        self.action.set_preempted()
        return False

    def _clear_goal(self) -> None:
        """Clear the current goal and stop."""
        self.machine.end_goal(self._now())
        self.goal = None
        self._stop_base()
        if self.config.shutdown_costmaps:
            self._stop_costmaps()

    def _stop_base(self) -> None:
        self._commands.publish(self._twist())

    def _stop_costmaps(self) -> None:
        self.global_costmap.stop()
        self.local_costmap.stop()

    def _on_shutdown(self) -> None:
        self._stop_base()
        if self.action.is_active():
            self.action.set_aborted(None, "Aborting on the goal because the node has been killed")

    # -- one cycle of control ------------------------------------------------------------------------------------

    def _cycle(self) -> bool:
        """Run one control cycle; return whether the goal is finished: reached or aborted."""
        with suppress(TransformMissing):
            self._publish_position()
        if not self.local_costmap.is_current:
            self.node.logwarn(
                f"[{self.node.name}]:Sensor data is out of date, we're not going to allow commanding of the base for "
                "safety",
                throttle=WARN_PERIOD,
            )
            self._stop_base()
            return False
        plan = self.lane.take()
        if plan is not None and not self._pass_plan(plan):
            return True
        decision = self.machine.step()
        if isinstance(decision, Plan):
            self.lane.wake()
        elif isinstance(decision, Follow):
            return self._follow()
        elif isinstance(decision, Recover):
            self._run_recovery(decision.number)
        else:
            self._abort(decision)
            return True
        return False

    def _publish_position(self) -> None:
        pose = self.global_costmap.robot_pose()
        self._feedback.base_position = pose
        self.action.publish_feedback(self._feedback)
        x, y, _ = planar_pose(pose)
        self.machine.robot_at(self._now(), x, y)

    def _pass_plan(self, plan: Sequence[Any]) -> bool:
        """Pass a new plan to the local planner; return whether it took the plan. If it did not, abort the goal."""
        self.plan = plan
        try:
            self._call_planner(LOCAL, "set_plan", plan)
        except NavigationFailure as error:
            self.node.logerr(f"Failed to pass global plan to the controller, aborting. {error}")
            self.problem = str(error)
            self._clear_goal()
            self.action.set_aborted(None, "Failed to pass global plan to the controller.")
            return False
        self.machine.plan_taken()
        return True

    def _call_planner(self, which: str, method: str, *arguments: Any) -> Any:
        """Return the result of a method of the global or the local planner; raises what `plugin_calls.call` raises."""
        planner = self.planners.of[which]
        patience = self.config.planner_patience if which == GLOBAL else self.config.controller_patience
        what = f"{method}() of the {which} planner {self.planners.names[which]}"
        return call(self.node, what, getattr(planner, method), *arguments, budget=max(patience, 1.0))

    def _follow(self) -> bool:
        """Publish the command of the local planner; return whether the goal is reached."""
        now = self._now()
        if self._is_reached():
            self._clear_goal()
            self.action.set_succeeded(None, "Goal reached.")
            return True
        if self.machine.check_oscillation(now):
            self.problem = (
                f"the robot has stayed within {self.config.oscillation_distance:g} m for "
                f"{self.config.oscillation_timeout:g} s"
            )
            self._stop_base()
            return False
        try:
            command = self._call_planner(LOCAL, "compute_velocity_commands")
        except NavigationFailure as error:
            self._handle_no_command(error)
            return False
        self.machine.command_found(self._now())
        self._commands.publish(command)
        return False

    def _is_reached(self) -> bool:
        try:
            return bool(self._call_planner(LOCAL, "is_goal_reached"))
        except NavigationFailure as error:
            self.node.logwarn(f"Cannot determine whether the goal is reached: {error}", throttle=WARN_PERIOD)
            return False

    def _handle_no_command(self, error: NavigationFailure) -> None:
        self.problem = str(error)
        self.node.logwarn(f"No valid command: {error}", throttle=WARN_PERIOD)
        self.machine.command_failed(self._now())
        self._stop_base()
        if self.state is State.PLANNING:  # while CLEARING, a new plan would end the recovery before it begins
            self.lane.wake()

    def _run_recovery(self, number: int) -> None:
        """Run a recovery behaviour; the control cycle waits until it returns."""
        name, behavior = self.recovery_behaviors[number]
        status = self._recovery(
            current_recovery_number=number,
            total_number_of_recoveries=len(self.recovery_behaviors),
            recovery_behavior_name=name,
        )
        with suppress(TransformMissing):
            status.pose_stamped = self.global_costmap.robot_pose()
        self._recoveries.publish(status)
        try:
            call(self.node, f"the recovery behavior {name}", behavior.run_behavior, budget=RECOVERY_TIME_LIMIT)
        except NavigationFailure as error:
            self.node.logerr(str(error))
        self.machine.recovered(self._now())

    def _abort(self, decision: Abort) -> None:
        self.node.logerr(f"{decision.log}. {self.problem}" if self.problem else decision.log)
        self.action.set_aborted(None, decision.text)
        self._clear_goal()

    # -- plans ---------------------------------------------------------------------------------------------------

    def _make_plan(self, goal: Any) -> Sequence[Any]:
        """Return a plan from the robot's current pose to the goal; empty on failure."""
        try:
            start = self.global_costmap.robot_pose()
        except TransformMissing as error:
            self.problem = f"Unable to get starting pose of robot, unable to create global plan: {error}"
            self.node.logwarn(self.problem, throttle=WARN_PERIOD)
            return ()
        return self._planned(start, goal)

    def _planned(self, start: Any, goal: Any) -> Sequence[Any]:
        try:
            plan: Sequence[Any] = self._call_planner(GLOBAL, "make_plan", start, goal)
        except NavigationFailure as error:
            self.problem = str(error)
            self.node.logwarn(f"Failed to find a plan: {error}", throttle=WARN_PERIOD)
            return ()
        if plan is None or not len(plan):
            self.problem = f"the global planner {self.planners.names[GLOBAL]} returned no poses"
            return ()
        return plan

    def _make_plan_service(self, request: Any) -> Any:
        """Return a plan to the goal or to a pose within the tolerance (`~make_plan`); empty if there is none."""
        if self.action.is_active():
            raise self._refusal("move_base must be in an inactive state to make a plan for an external user")
        start = request.start
        if not start.header.frame_id:
            try:
                start = self.global_costmap.robot_pose()
            except TransformMissing as error:
                raise self._refusal(
                    "move_base cannot make a plan for you because it could not get the start pose of the robot: "
                    f"{error}"
                ) from error
        if self.config.make_plan_clear_costmap:
            self._clear_windows(2 * self._clearing_radius)
        answer = message_class("nav_msgs/Path")()
        answer.poses = list(self._plan_near(start, request.goal, request.tolerance))
        if answer.poses:
            answer.header = answer.poses[0].header
        return {"plan": answer}

    def _refusal(self, text: str) -> RosminiError:
        self.node.logerr(text)
        return RosminiError(text)

    def _plan_near(self, start: Any, goal: Any, tolerance: float) -> Sequence[Any]:
        plan = self._planned(start, goal)
        if plan:
            return plan
        stamped, place = type(goal), goal.pose.position
        for dx, dy in offsets_within(tolerance, self.global_costmap.grid.resolution):
            near = stamped(header=goal.header)
            near.pose.orientation = goal.pose.orientation
            near.pose.position.x, near.pose.position.y = place.x + dx, place.y + dy
            plan = self._planned(start, near)
            if plan:
                return [*plan, goal] if self.config.make_plan_add_unreachable_goal else plan
        return ()

    # -- costmaps ------------------------------------------------------------------------------------------------

    def _clear_windows(self, side: float) -> None:
        """Clear a square around the robot in both costmaps."""
        for costmap in (self.global_costmap, self.local_costmap):
            with suppress(TransformMissing):
                x, y, _ = planar_pose(costmap.robot_pose())
                half = side / 2
                square = [(x - half, y - half), (x + half, y - half), (x + half, y + half), (x - half, y + half)]
                costmap.set_costs(square, FREE_SPACE)

    def _clear_costmaps(self, _: Any) -> dict[str, Any]:
        self.local_costmap.reset_layers()
        self.global_costmap.reset_layers()
        return {}

    # -- parameters ----------------------------------------------------------------------------------------------

    def _reconfigure(self, config: Any, _: int) -> Any:
        """Apply changed parameters; the first call only stores the initial values."""
        if self._defaults is None:
            self._defaults = dict(config)
            return config
        if config["restore_defaults"]:
            config.update({**self._defaults, "restore_defaults": False})
        for which in (GLOBAL, LOCAL):
            self._change_planner(which, config)
        self.config = MoveBaseConfig(**{name: value for name, value in config.items() if name != "groups"})
        self.machine.config = self.config
        return config

    def _change_planner(self, which: str, config: Any) -> None:
        """Replace a planner if its parameter has changed; if it cannot be loaded, keep the current one."""
        parameter = f"base_{which}_planner"
        if config[parameter] == self.planners.names[which]:
            return
        self.node.loginfo(f"Loading {which} planner {config[parameter]}")
        try:
            self.planners.load(which, config[parameter])
        except RosminiError as error:
            if isinstance(error, ROSInterruptException):
                raise
            self.node.logfatal(str(error))
            config[parameter] = self.planners.names[which]
            return
        self.lane.latest, self.plan = None, ()
        self._stop_base()
        if self.goal is not None:
            self.machine.start_goal(self._now())
