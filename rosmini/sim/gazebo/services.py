"""The services of /gazebo, with the replies of gazebo_ros_api_plugin (http://wiki.ros.org/gazebo_msgs).

A refusal is not an error of the call: `success` is false, and `status_message` gives the reason in the real plugin's
words, followed by ours if there is more to say.
"""

from __future__ import annotations

import functools
import math
from collections.abc import Callable, Iterable, Iterator
from contextlib import contextmanager
from types import SimpleNamespace
from typing import Any

from rosmini.core.errors import RosminiError
from rosmini.core.geometry.products import matrix_product
from rosmini.core.graph import Node
from rosmini.core.markup import parse
from rosmini.msgs import message_class, service_class
from rosmini.sim.host import Device, Host, Stamp
from rosmini.sim.sdf import placed_links
from rosmini.sim.sdf.document import Pose6
from rosmini.sim.sdf.poses import compose, from_quaternion, inverse, matrix, quaternion

from .errors import GazeboError, UnknownEntity
from .model import GazeboWorld, Model, Velocity
from .physics_properties import PhysicsProperties
from .running_world import RunningWorld
from .spawning import spawn_text

Reply = dict[str, Any]

SCOPE = "did you forget to scope the {} by model name?"
JOINTS = {"revolute": 0, "continuous": 1, "prismatic": 2, "fixed": 3, "ball": 4, "universal": 5}


class Refusal(GazeboError):
    """A request is refused; the text is the status message."""


@contextmanager
def refusing_with(refusal: str) -> Iterator[None]:
    """Turn an error into a refusal with this text, followed by the error's own."""
    try:
        yield
    except Refusal:
        raise
    except RosminiError as error:
        raise Refusal(f"{refusal} {error}") from error


def answer_refusals(handler: Callable[[Services, Any], Reply]) -> Callable[[Services, Any], Reply]:
    """Return a refusal as the answer of a service."""

    @functools.wraps(handler)
    def answer(self: Services, request: Any) -> Reply:
        try:
            return handler(self, request)
        except Refusal as refusal:
            return {"success": False, "status_message": str(refusal)}

    return answer


def success(message: str, **fields: Any) -> Reply:
    """Return the answer of a successful service."""
    return {"success": True, "status_message": message, **fields}


class Services:
    """The services of a running world, in its node's private namespace."""

    def __init__(self, world: RunningWorld, set_physics: Callable[[PhysicsProperties], object]) -> None:
        self.world = world
        self._set_physics = set_physics
        self._counts: dict[str, int] = {}
        empty = {
            "pause_physics": (world.host.pause,),
            "unpause_physics": (world.host.unpause,),
            "reset_world": (world.reset_models,),
            "reset_simulation": (world.reset_models, world.host.reset_time),
        }
        for name, actions in empty.items():
            world.node.service(f"~{name}", service_class("std_srvs/Empty"), functools.partial(self._empty, actions))
        for name, kind, handler in (
            ("spawn_urdf_model", "SpawnModel", self.spawn_urdf),
            ("spawn_sdf_model", "SpawnModel", self.spawn_sdf),
            ("delete_model", "DeleteModel", self.delete_model),
            ("get_model_state", "GetModelState", self.get_model_state),
            ("set_model_state", "SetModelState", self.set_model_state),
            ("get_model_properties", "GetModelProperties", self.get_model_properties),
            ("get_world_properties", "GetWorldProperties", self.get_world_properties),
            ("get_link_state", "GetLinkState", self.get_link_state),
            ("set_link_state", "SetLinkState", self.set_link_state),
            ("get_link_properties", "GetLinkProperties", self.get_link_properties),
            ("get_joint_properties", "GetJointProperties", self.get_joint_properties),
            ("set_model_configuration", "SetModelConfiguration", self.set_model_configuration),
            ("get_physics_properties", "GetPhysicsProperties", self.get_physics),
            ("set_physics_properties", "SetPhysicsProperties", self.set_physics),
            ("apply_body_wrench", "ApplyBodyWrench", self.apply_body_wrench),
            ("clear_body_wrenches", "BodyRequest", self.clear_body_wrenches),
        ):
            world.node.service(f"~{name}", service_class(f"gazebo_msgs/{kind}"), handler)

    @staticmethod
    def _empty(actions: tuple[Callable[[], object], ...], _: Any) -> Reply:
        for action in actions:
            action()
        return {}

    # -- models come and go --------------------------------------------------------------------------------------

    @answer_refusals
    def spawn_urdf(self, request: Any) -> Reply:
        """Insert the robot described by a URDF."""
        return self._spawn(request, ("robot",), "SpawnModel: Failure - model format is not URDF.")

    @answer_refusals
    def spawn_sdf(self, request: Any) -> Reply:
        """Insert the model described by an SDF (or a URDF, as in Gazebo)."""
        return self._spawn(
            request,
            ("sdf", "gazebo", "robot"),
            "GazeboRosApiPlugin SpawnModel Failure: input model_xml not SDF or URDF, or cannot be converted to Gazebo "
            "compatible format.",
        )

    def _spawn(self, request: Any, tags: tuple[str, ...], wrong: str) -> Reply:
        world, name = self.world, request.model_name
        with refusing_with("SpawnModel: Failure -"):
            if parse(request.model_xml, "model_xml").tag not in tags:
                raise Refusal(wrong)
            if name in world.models:
                raise Refusal("SpawnModel: Failure - entity already exists.")
            with refusing_with(f"SpawnModel: reference reference_frame not found, {SCOPE.format('link')}"):
                frame, _ = world.frame(request.reference_frame)
            pose = compose(frame, pose_of(request.initial_pose))
            model = spawn_text(world, request.model_xml, name, pose, namespace=request.robot_namespace)
        world.node.loginfo(f"{model!r} came into the world {world.name!r}")
        return success("SpawnModel: Successfully spawned entity")

    @answer_refusals
    def delete_model(self, request: Any) -> Reply:
        """Remove a model."""
        with refusing_with("DeleteModel: model does not exist:"):
            self.world.delete(request.model_name)
        return success("DeleteModel: successfully deleted model")

    # -- poses and velocities ------------------------------------------------------------------------------------

    @answer_refusals
    def get_model_state(self, request: Any) -> Reply:
        """Return pose and velocity of a model, relative to another one or the world."""
        name, other = request.model_name, request.relative_entity_name
        with refusing_with("GetModelState: model does not exist:"):
            model = self.world.model(name)
        with refusing_with(f"GetModelState: reference relative_entity_name not found, {SCOPE.format('body')}"):
            pose, velocity = relative((model.pose, model.velocity), self.world.frame(other))
        seq = self._counts[name] = self._counts.get(name, 0) + 1
        header = message_class("std_msgs/Header")(seq=seq, stamp=self.world.host.stamp, frame_id=other)
        return success(
            "GetModelState: got properties", header=header, pose=pose_message(pose), twist=twist_message(velocity)
        )

    @answer_refusals
    def set_model_state(self, request: Any) -> Reply:
        """Move a model to another pose."""
        state = request.model_state
        with refusing_with("SetModelState: model does not exist:"):
            model = self.world.model(state.model_name)
        with refusing_with("SetModelState: specified reference frame entity does not exist:"):
            frame, _ = self.world.frame(state.reference_frame)
        vx, vy, w = state.twist.linear.x, state.twist.linear.y, state.twist.angular.z
        c, s = math.cos(frame[5]), math.sin(frame[5])
        with refusing_with("SetModelState:"):
            self.world.move(model, compose(frame, pose_of(state.pose)), (c * vx - s * vy, s * vx + c * vy, w))
        return success("SetModelState: set model state done")

    @answer_refusals
    def get_link_state(self, request: Any) -> Reply:
        """Return pose and velocity of a link."""
        with refusing_with(f"GetLinkState: link not found, {SCOPE.format('link')}"):
            model, link = self._link(request.link_name)
        with refusing_with(f"GetLinkState: reference reference_frame not found, {SCOPE.format('link')}"):
            frame = self.world.frame(request.reference_frame)
        pose, velocity = relative((model.link_pose(link), model.link_velocity(link)), frame)
        return success(
            "GetLinkState: got state",
            link_state=message_class("gazebo_msgs/LinkState")(
                link_name=request.link_name,
                pose=pose_message(pose),
                twist=twist_message(velocity),
                reference_frame=request.reference_frame,
            ),
        )

    @answer_refusals
    def set_link_state(self, request: Any) -> Reply:
        """Move a model so that one of its links has the given pose."""
        state = request.link_state
        with refusing_with("SetLinkState: link does not exist:"):
            model, link = self._link(state.link_name)
        with refusing_with("SetLinkState: failed:"):
            frame, _ = self.world.frame(state.reference_frame)
            target = compose(frame, pose_of(state.pose))
            velocity = (state.twist.linear.x, state.twist.linear.y, state.twist.angular.z)
            self.world.move(model, compose(target, inverse(model.link_frame(link))), velocity)
        return success("SetLinkState: success")

    def _link(self, name: str) -> tuple[Model, str]:
        """Return the model and the link named by model::link. Raises `UnknownEntity`."""
        model_name, colons, link = name.partition("::")
        if not colons:  # Gazebo also finds a link by its bare name, if a model has it
            for model in self.world.models.values():
                if name in model.links or name in model.frames:
                    return model, name
            raise UnknownEntity(f"there is no link {name!r}; links are named model::link")
        model = self.world.model(model_name)
        model.link_frame(link)
        return model, link

    # -- properties ----------------------------------------------------------------------------------------------

    @answer_refusals
    def get_model_properties(self, request: Any) -> Reply:
        """Return the links, shapes and joints of a model."""
        with refusing_with("GetModelProperties: model does not exist:"):
            model = self.world.model(request.model_name)
        links = list(model.links)
        return success(
            "GetModelProperties: got properties",
            canonical_body_name=links[0] if links else "",
            body_names=links,
            geom_names=[each.name for _, link, _ in placed_links(model.sdf) for each in link.collisions],
            joint_names=list(model.joints),
            child_model_names=[each.name for each in model.sdf.models],
            is_static=model.static,
        )

    def get_world_properties(self, _: Any) -> Reply:
        """Return the time and the names of all models."""
        return success(
            "GetWorldProperties: got properties",
            sim_time=self.world.now,
            model_names=list(self.world.models),
            rendering_enabled=True,
        )

    @answer_refusals
    def get_link_properties(self, request: Any) -> Reply:
        """Return the mass and the inertia of a link."""
        with refusing_with(f"GetLinkProperties: link not found, {SCOPE.format('link')}"):
            model, name = self._link(request.link_name)
            if name not in model.links:
                raise UnknownEntity(f"the link {name!r} has become part of {model.frames[name][0]!r}")
        inertial = next(link.inertial for called, link, _ in placed_links(model.sdf) if called == name)
        inertia = zip(("ixx", "iyy", "izz", "ixy", "ixz", "iyz"), inertial.inertia, strict=True)
        return success(
            "GetLinkProperties: got properties",
            com=pose_message(inertial.pose),
            gravity_mode=True,
            mass=inertial.mass,
            **dict(inertia),
        )

    @answer_refusals
    def get_joint_properties(self, request: Any) -> Reply:
        """Return the position and rate of a joint."""
        for model in self.world.models.values():
            for joint in model.sdf.joints:
                if joint.name == request.joint_name:
                    position, rate = model.joint(joint.name)
                    message, kind = "GetJointProperties: got properties", JOINTS.get(joint.type, 0)
                    return success(message, type=kind, position=[position], rate=[rate])
        raise Refusal("GetJointProperties: joint not found")

    @answer_refusals
    def set_model_configuration(self, request: Any) -> Reply:
        """Check the positions: only driven wheels move here, so no position other than the current one is accepted."""
        with refusing_with("SetModelConfiguration: model does not exist:"):
            model = self.world.model(request.model_name)
            if len(request.joint_names) != len(request.joint_positions):
                raise Refusal("SetModelConfiguration: joint name and position list have different lengths")
            for name, position in zip(request.joint_names, request.joint_positions, strict=True):
                if abs(position - model.joint(name)[0]) > 1e-9:
                    raise Refusal(
                        f"SetModelConfiguration: the joint {name!r} cannot be moved to {position:g}: rosmini moves no "
                        "joints but driven wheels"
                    )
        return success("SetModelConfiguration: success")

    # -- physics -------------------------------------------------------------------------------------------------

    def get_physics(self, _: Any) -> Any:
        """Return the physics settings."""
        response = service_class("gazebo_msgs/GetPhysicsProperties")._response_class()
        self.world.physics.fill(response)
        response.pause, response.success = self.world.paused, True
        response.status_message = "GetPhysicsProperties: got properties"
        return response

    @answer_refusals
    def set_physics(self, request: Any) -> Reply:
        """Change the physics settings."""
        with refusing_with("physics engine not updated:"):
            self._set_physics(PhysicsProperties.of_request(request))
        return success("physics engine updated")

    @answer_refusals
    def apply_body_wrench(self, request: Any) -> Reply:
        """Apply a force to a model for a while."""
        with refusing_with("ApplyBodyWrench: body does not exist:"):
            model, link = self._link(request.body_name)
        with refusing_with("ApplyBodyWrench: reference_frame not found:"):
            frame, _ = self.world.frame(request.reference_frame)
        with refusing_with("ApplyBodyWrench:"):
            self.world.wrenches.apply(model, link, frame, request)
        return success("")

    def clear_body_wrenches(self, request: Any) -> Reply:
        """Stop all forces on a body."""
        self.world.wrenches.clear(request.body_name)
        return {}


def pose_of(message: Any) -> Pose6:
    """Return the six numbers of a geometry_msgs/Pose; a quaternion of zeros means no rotation, as in Gazebo."""
    at, to = message.position, message.orientation
    if not any((to.x, to.y, to.z, to.w)):
        return (at.x, at.y, at.z, 0.0, 0.0, 0.0)
    return (at.x, at.y, at.z, *from_quaternion(to.x, to.y, to.z, to.w))


def pose_message(pose: Pose6) -> Any:
    """Return a geometry_msgs/Pose."""
    message = message_class("geometry_msgs/Pose")()
    at, to = message.position, message.orientation
    at.x, at.y, at.z, roll, pitch, yaw = pose
    to.x, to.y, to.z, to.w = quaternion(roll, pitch, yaw)
    return message


def twist_message(velocity: Velocity) -> Any:
    """Return a geometry_msgs/Twist."""
    message = message_class("geometry_msgs/Twist")()
    message.linear.x, message.linear.y, message.angular.z = velocity
    return message


def relative(state: tuple[Pose6, Velocity], frame: tuple[Pose6, Velocity]) -> tuple[Pose6, Velocity]:
    """Express a pose and a velocity in the world relative to a moving frame."""
    (pose, (vx, vy, w)), (at, (fx, fy, fw)) = state, frame
    turn = matrix(at)[:2, :2].T
    rx, ry = matrix_product(turn, (vx - fx, vy - fy))
    return compose(inverse(at), pose), (float(rx), float(ry), w - fw)


Entry = tuple[str, Pose6, Velocity]


class _States(Device):
    """One of the two topics; published only while it has a subscriber, as in gazebo_ros."""

    always = False

    def __init__(self, host: Host, world: GazeboWorld, topic: str, kind: str, rate: float) -> None:
        super().__init__(host, topic, rate)
        self._world = world
        self._class: Any = message_class(kind)
        self._publisher = host.node.publisher(topic, self._class, queue_size=10)

    def wanted(self) -> bool:
        return bool(self._publisher.num_connections())

    def entries(self) -> Iterable[Entry]:
        return [(model.name, model.pose, model.velocity) for model in self._world.models.values()]

    def due(self, _: Stamp, __: int, /) -> None:
        message = self._class()
        for name, pose, velocity in self.entries():
            message.name.append(name)
            message.pose.append(pose_message(pose))
            message.twist.append(twist_message(velocity))
        self._publisher.publish(message)

    def close(self) -> None:
        self._publisher.unregister()


class _LinkStates(_States):
    def entries(self) -> Iterable[Entry]:
        for model in self._world.models.values():
            for link in model.links:
                yield f"{model.name}::{link}", model.link_pose(link), model.link_velocity(link)


class StateTopics:
    """The two topics of states, published `rate` times a second, and the two that set states."""

    def __init__(self, world: GazeboWorld, services: Services, rate: float) -> None:
        host, node = world.host, world.node
        for name, kind, handler in (
            ("~set_model_state", "ModelState", services.set_model_state),
            ("~set_link_state", "LinkState", services.set_link_state),
        ):
            node.subscriber(name, message_class(f"gazebo_msgs/{kind}"), _callback(node, kind, handler))
        host.add(_States(host, world, "~model_states", "gazebo_msgs/ModelStates", rate))
        host.add(_LinkStates(host, world, "~link_states", "gazebo_msgs/LinkStates", rate))


def _callback(node: Node, kind: str, handler: Callable[[Any], dict[str, Any]]) -> Callable[[Any], None]:
    """Return a callback that handles a message like the service's request and logs a refusal."""
    field = {"ModelState": "model_state", "LinkState": "link_state"}[kind]

    def take(message: Any) -> None:
        answer = handler(SimpleNamespace(**{field: message}))
        if not answer["success"]:
            node.logerr(answer["status_message"])

    return take
