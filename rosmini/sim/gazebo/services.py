"""The services of /gazebo, with the replies of gazebo_ros_api_plugin (http://wiki.ros.org/gazebo_msgs).

What is refused is no error of the call: `success` is false, and `status_message` says why, in the words of the real plugin and, where there is more to
be said, in ours after them.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import Any

from rosmini.errors import RosminiError
from rosmini.markup import parse
from rosmini.msgs import message_class, service_class
from rosmini.sim.sdf import Pose6
from rosmini.sim.sdf.poses import compose, from_quaternion, inverse, matrix

from .body import placed_links
from .errors import UnknownEntity
from .model import Model, Velocity
from .msgs import quaternion
from .physics import PhysicsProperties
from .spawning import spawn_text
from .world import GazeboWorld

Reply = dict[str, Any]

SCOPE = "did you forget to scope the {} by model name?"


def done(message: str, **fields: Any) -> Reply:
    """A reply that it was done."""
    return {"success": True, "status_message": message, **fields}


def refused(message: str, **fields: Any) -> Reply:
    """A reply that it was not, and why."""
    return {"success": False, "status_message": message, **fields}


class Services:
    """The services of a running world, in its node's private namespace."""

    def __init__(self, world: GazeboWorld, set_physics: Callable[[PhysicsProperties], object]) -> None:
        self.world = world
        self._set_physics = set_physics
        self._counts: dict[str, int] = {}
        for name, kind, handler in (
            ("spawn_urdf_model", "gazebo_msgs/SpawnModel", self.spawn_urdf),
            ("spawn_sdf_model", "gazebo_msgs/SpawnModel", self.spawn_sdf),
            ("delete_model", "gazebo_msgs/DeleteModel", self.delete_model),
            ("get_model_state", "gazebo_msgs/GetModelState", self.get_model_state),
            ("set_model_state", "gazebo_msgs/SetModelState", self.set_model_state),
            ("get_model_properties", "gazebo_msgs/GetModelProperties", self.get_model_properties),
            ("get_world_properties", "gazebo_msgs/GetWorldProperties", self.get_world_properties),
            ("get_link_state", "gazebo_msgs/GetLinkState", self.get_link_state),
            ("set_link_state", "gazebo_msgs/SetLinkState", self.set_link_state),
            ("get_link_properties", "gazebo_msgs/GetLinkProperties", self.get_link_properties),
            ("get_joint_properties", "gazebo_msgs/GetJointProperties", self.get_joint_properties),
            ("set_model_configuration", "gazebo_msgs/SetModelConfiguration", self.set_model_configuration),
            ("get_physics_properties", "gazebo_msgs/GetPhysicsProperties", self.get_physics),
            ("set_physics_properties", "gazebo_msgs/SetPhysicsProperties", self.set_physics),
            ("apply_body_wrench", "gazebo_msgs/ApplyBodyWrench", self.apply_body_wrench),
            ("clear_body_wrenches", "gazebo_msgs/BodyRequest", self.clear_body_wrenches),
            ("pause_physics", "std_srvs/Empty", lambda _: self._empty(world.pause)),
            ("unpause_physics", "std_srvs/Empty", lambda _: self._empty(world.unpause)),
            ("reset_world", "std_srvs/Empty", lambda _: self._empty(world.reset_models)),
            ("reset_simulation", "std_srvs/Empty", lambda _: self._empty(world.reset)),
        ):
            world.node.service(f"~{name}", service_class(kind), handler)

    @staticmethod
    def _empty(what: Callable[[], object]) -> Reply:
        what()
        return {}

    # -- models come and go --------------------------------------------------------------------------------------

    def spawn_urdf(self, request: Any) -> Reply:
        """Let a robot come into the world that a URDF describes."""
        try:
            root = parse(request.model_xml, "model_xml")
            if root.tag != "robot":
                return refused("SpawnModel: Failure - model format is not URDF.")
            return self._spawn(request)
        except RosminiError as error:
            return refused(f"SpawnModel: Failure - {error}")

    def spawn_sdf(self, request: Any) -> Reply:
        """Let a model come into the world that an SDF (or a URDF, as in Gazebo) describes."""
        try:
            root = parse(request.model_xml, "model_xml")
            if root.tag not in ("sdf", "gazebo", "robot"):
                return refused(
                    "GazeboRosApiPlugin SpawnModel Failure: input model_xml not SDF or URDF, or cannot be converted to Gazebo compatible format."
                )
            return self._spawn(request)
        except RosminiError as error:
            return refused(f"SpawnModel: Failure - {error}")

    def _spawn(self, request: Any) -> Reply:
        world, name = self.world, request.model_name
        if name in world.models:
            return refused("SpawnModel: Failure - entity already exists.")
        try:
            frame = self._frame(request.reference_frame)[0]
        except UnknownEntity as error:
            return refused(f"SpawnModel: reference reference_frame not found, {SCOPE.format('link')} {error}")
        pose = compose(frame, pose_of(request.initial_pose))
        model = spawn_text(world, request.model_xml, name, pose, namespace=request.robot_namespace)
        world.node.loginfo(f"{model!r} came into the world {world.name!r}")
        return done("SpawnModel: Successfully spawned entity")

    def delete_model(self, request: Any) -> Reply:
        """Take a model out of the world."""
        try:
            self.world.delete(request.model_name)
        except UnknownEntity as error:
            return refused(f"DeleteModel: model does not exist: {error}")
        return done("DeleteModel: successfully deleted model")

    # -- where they are ------------------------------------------------------------------------------------------

    def _frame(self, name: str) -> tuple[Pose6, Velocity]:
        return self.world.frame(name)

    def get_model_state(self, request: Any) -> Reply:
        """Where a model is, and how fast it goes, seen from another or from the world."""
        name, other = request.model_name, request.relative_entity_name
        try:
            model = self.world.model(name)
        except UnknownEntity as error:
            return refused(f"GetModelState: model does not exist: {error}")
        try:
            pose, velocity = relative((model.pose, model.velocity), self._frame(other))
        except UnknownEntity as error:
            text = f"GetModelState: reference relative_entity_name not found, {SCOPE.format('body')} {error}"
            return refused(text)
        self._counts[name] = self._counts.get(name, 0) + 1
        header = message_class("std_msgs/Header")(
            seq=self._counts[name], stamp=self.world.host.stamp, frame_id=other
        )
        return done(
            "GetModelState: got properties",
            header=header,
            pose=pose_message(pose),
            twist=twist_message(velocity),
        )

    def set_model_state(self, request: Any) -> Reply:
        """Put a model elsewhere, whatever stands there."""
        state = request.model_state
        try:
            model = self.world.model(state.model_name)
        except UnknownEntity as error:
            return refused(f"SetModelState: model does not exist: {error}")
        try:
            frame = self._frame(state.reference_frame)
        except UnknownEntity as error:
            return refused(f"SetModelState: specified reference frame entity does not exist: {error}")
        return self._move(model, state, frame, "SetModelState: set model state done", "SetModelState")

    def _move(
        self, model: Model, state: Any, frame: tuple[Pose6, Velocity], message: str, service: str
    ) -> Reply:
        vx, vy, w = state.twist.linear.x, state.twist.linear.y, state.twist.angular.z
        c, s = math.cos(frame[0][5]), math.sin(frame[0][5])
        try:
            pose = compose(frame[0], pose_of(state.pose))
            self.world.move(model, pose, (c * vx - s * vy, s * vx + c * vy, w))
        except RosminiError as error:
            return refused(f"{service}: {error}")
        return done(message)

    def get_link_state(self, request: Any) -> Reply:
        """Where a link is, and how fast it goes."""
        try:
            model, link = self._link(request.link_name)
        except UnknownEntity as error:
            return refused(f"GetLinkState: link not found, {SCOPE.format('link')} {error}")
        try:
            frame = self._frame(request.reference_frame)
        except UnknownEntity as error:
            return refused(
                f"GetLinkState: reference reference_frame not found, {SCOPE.format('link')} {error}"
            )
        pose, velocity = relative((model.link_pose(link), model.link_velocity(link)), frame)
        return done(
            "GetLinkState: got state",
            link_state=message_class("gazebo_msgs/LinkState")(
                link_name=request.link_name,
                pose=pose_message(pose),
                twist=twist_message(velocity),
                reference_frame=request.reference_frame,
            ),
        )

    def set_link_state(self, request: Any) -> Reply:
        """Put a model so that a link of it is there."""
        state = request.link_state
        try:
            model, link = self._link(state.link_name)
        except UnknownEntity as error:
            return refused(f"SetLinkState: link does not exist: {error}")
        try:
            frame = self._frame(state.reference_frame)
            target = compose(frame[0], pose_of(state.pose))
            velocity = (state.twist.linear.x, state.twist.linear.y, state.twist.angular.z)
            self.world.move(model, compose(target, inverse(model.link_frame(link))), velocity)
        except RosminiError as error:
            return refused(f"SetLinkState: failed: {error}")
        return done("SetLinkState: success")

    def _link(self, name: str) -> tuple[Model, str]:
        """The link that model::link names. Raises `UnknownEntity`."""
        model_name, colons, link = name.partition("::")
        if not colons:  # Gazebo also finds a link by its own name alone, if it finds it in some model
            for model in self.world.models.values():
                if name in model.links or name in model.frames:
                    return model, name
            raise UnknownEntity(f"there is no link {name!r}; links are named model::link")
        model = self.world.model(model_name)
        model.link_frame(link)
        return model, link

    # -- what they are -------------------------------------------------------------------------------------------

    def get_model_properties(self, request: Any) -> Reply:
        """The links, shapes and joints of a model."""
        try:
            model = self.world.model(request.model_name)
        except UnknownEntity as error:
            return refused(f"GetModelProperties: model does not exist: {error}")
        shapes = [each.name for _, link, _ in placed_links(model.sdf) for each in link.collisions]
        links = list(model.links)
        return done(
            "GetModelProperties: got properties",
            canonical_body_name=links[0] if links else "",
            body_names=links,
            geom_names=shapes,
            joint_names=list(model.joints),
            child_model_names=[each.name for each in model.sdf.models],
            is_static=model.static,
        )

    def get_world_properties(self, _: Any) -> Reply:
        """The time, and the names of all models."""
        return done(
            "GetWorldProperties: got properties",
            sim_time=self.world.now,
            model_names=list(self.world.models),
            rendering_enabled=True,
        )

    def get_link_properties(self, request: Any) -> Reply:
        """The mass and the inertia of a link."""
        try:
            model, name = self._link(request.link_name)
            link = next(each for called, each, _ in placed_links(model.sdf) if called == name)
        except (UnknownEntity, StopIteration) as error:
            return refused(f"GetLinkProperties: link not found, {SCOPE.format('link')} {error}".rstrip())
        inertial = link.inertial
        ixx, iyy, izz, ixy, ixz, iyz = inertial.inertia
        return done(
            "GetLinkProperties: got properties",
            com=pose_message(inertial.pose),
            gravity_mode=True,
            mass=inertial.mass,
            ixx=ixx,
            ixy=ixy,
            ixz=ixz,
            iyy=iyy,
            iyz=iyz,
            izz=izz,
        )

    def get_joint_properties(self, request: Any) -> Reply:
        """The position of a joint, and how fast it changes."""
        for model in self.world.models.values():
            if request.joint_name in model.joints:
                position, rate = model.joint(request.joint_name)
                kinds = {
                    "revolute": 0,
                    "continuous": 1,
                    "prismatic": 2,
                    "fixed": 3,
                    "ball": 4,
                    "universal": 5,
                }
                kind = next(each.type for each in model.sdf.joints if each.name == request.joint_name)
                message = "GetJointProperties: got properties"
                return done(message, type=kinds.get(kind, 0), position=[position], rate=[rate])
        return refused("GetJointProperties: joint not found")

    def set_model_configuration(self, request: Any) -> Reply:
        """Joints that drive nothing stay where they are here, so only 0 can be asked for."""
        try:
            model = self.world.model(request.model_name)
            if len(request.joint_names) != len(request.joint_positions):
                return refused("SetModelConfiguration: joint name and position list have different lengths")
            for name, position in zip(request.joint_names, request.joint_positions, strict=True):
                there, _ = model.joint(name)
                if abs(position - there) > 1e-9:
                    return refused(
                        f"SetModelConfiguration: the joint {name!r} cannot be put to {position:g}: rosmini moves no joints but driven wheels"
                    )
        except UnknownEntity as error:
            return refused(f"SetModelConfiguration: model does not exist: {error}")
        return done("SetModelConfiguration: success")

    # -- physics -------------------------------------------------------------------------------------------------

    def get_physics(self, _: Any) -> Any:
        """How the world is stepped."""
        physics = self.world.physics
        response = service_class("gazebo_msgs/GetPhysicsProperties")._response_class()
        response.time_step, response.pause = physics.time_step, self.world.paused
        response.max_update_rate = physics.max_update_rate
        physics.to_messages(response.ode_config, response.gravity)
        response.success = True
        response.status_message = "GetPhysicsProperties: got properties"
        return response

    def set_physics(self, request: Any) -> Reply:
        """Change how the world is stepped."""
        try:
            self._set_physics(PhysicsProperties.of_request(request))
        except RosminiError as error:
            return refused(f"physics engine not updated: {error}")
        return done("physics engine updated")

    def apply_body_wrench(self, request: Any) -> Reply:
        """Push a thing for a while."""
        try:
            model, link = self._link(request.body_name)
        except UnknownEntity as error:
            return refused(f"ApplyBodyWrench: body does not exist: {error}")
        try:
            frame = self._frame(request.reference_frame)[0]
        except UnknownEntity as error:
            return refused(f"ApplyBodyWrench: reference_frame not found: {error}")
        try:
            self.world.wrenches.apply(model, link, frame, request)
        except RosminiError as error:
            return refused(f"ApplyBodyWrench: {error}")
        return done("")

    def clear_body_wrenches(self, request: Any) -> Reply:
        """Stop pushing a thing."""
        self.world.wrenches.clear(request.body_name)
        return {}


def pose_of(message: Any) -> Pose6:
    """The six numbers of a geometry_msgs/Pose; a quaternion of zeros means no turn, as in Gazebo."""
    at, to = message.position, message.orientation
    if not any((to.x, to.y, to.z, to.w)):
        return (at.x, at.y, at.z, 0.0, 0.0, 0.0)
    return (at.x, at.y, at.z, *from_quaternion(to.x, to.y, to.z, to.w))


def pose_message(pose: Pose6) -> Any:
    """A geometry_msgs/Pose."""
    message = message_class("geometry_msgs/Pose")()
    at, to = message.position, message.orientation
    at.x, at.y, at.z, roll, pitch, yaw = pose
    to.x, to.y, to.z, to.w = quaternion(roll, pitch, yaw)
    return message


def twist_message(velocity: Velocity) -> Any:
    """A geometry_msgs/Twist."""
    message = message_class("geometry_msgs/Twist")()
    message.linear.x, message.linear.y, message.angular.z = velocity
    return message


def relative(state: tuple[Pose6, Velocity], frame: tuple[Pose6, Velocity]) -> tuple[Pose6, Velocity]:
    """A pose and a velocity of the world, seen from a frame that moves."""
    (pose, (vx, vy, w)), (at, (fx, fy, fw)) = state, frame
    turn = matrix(at)[:2, :2].T
    rx, ry = turn @ (vx - fx, vy - fy)
    return compose(inverse(at), pose), (float(rx), float(ry), w - fw)


__all__ = ["Services", "pose_message", "pose_of", "relative", "twist_message"]
