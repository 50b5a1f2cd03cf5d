"""The running world: models that come, go and are moved, time, and plugins (what gazebo::physics::World is).

Services, Gazebo's own topics, plugins, the `gz` verbs and notebooks all act on this one object, which acts on the engine and its host.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable
from contextlib import ExitStack
from dataclasses import replace
from typing import TYPE_CHECKING

from rosmini.errors import RosminiError, nearest
from rosmini.geometry.poses import Pose, compose
from rosmini.markup import Element
from rosmini.sim.engine import Engine
from rosmini.sim.host import Host
from rosmini.sim.sdf import ORIGIN, Pose6, SdfLink, SdfModel, SdfPlugin, SdfWorld, converted, to_obstacles
from rosmini.sim.sdf.poses import compose as compose6
from rosmini.sim.world import Obstacle, World, WorldError

from .body import Body, is_still, lowest, obstacles_at, outline_of, placed_links, plugins_of
from .errors import GazeboError, SpawnError, UnknownEntity, UnknownPlugin
from .model import STILL, Model, Sensor, Velocity
from .physics import PhysicsProperties
from .plugins import ModelPlugin, Plugin, SensorPlugin, WorldPlugin, plugin_class
from .world_state import ModelState, WorldState, bring_back
from .wrenches import Wrenches

if TYPE_CHECKING:
    from collections.abc import Mapping

    from rosmini.graph import Node

WORLD_FRAMES = ("", "world", "map", "/map")
"""What stands for the world where the name of a model or a link is asked for."""


class GazeboWorld:
    """A world with models in it, in a node.

    Args:
        node: the started node; its topics are those of the models.
        source: an SDF world, or one of rosmini's.
        paused: whether time stands at first.
        noise: scales the noise of all sensors; 0: none.

    """

    def __init__(
        self, node: Node, source: World | SdfWorld, *, paused: bool = False, noise: float = 1.0
    ) -> None:
        self.node = node
        self.noise = noise
        self.models: dict[str, Model] = {}
        """By name, in the sequence of their coming."""
        self.plugins: list[Plugin] = []
        self.on_change: list[Callable[[str, Model], object]] = []
        """Called with "insert", "delete" or "move", and the model."""
        self.wrenches = Wrenches(self)
        """The forces that act on things."""
        self.on_time: list[Callable[[], object]] = []
        """Called when time was stopped, let go on, stepped, or set back with or without the models."""
        if isinstance(source, SdfWorld):
            self.name = source.name
            still = [model for model in source.models if is_still(model)]
            flat, notes = converted(replace(source, models=tuple(still)))
            if source.warnings:
                wrong = map(str, source.warnings)
                node.logwarn("\n".join([f"the world {source.name!r} is not whole:", *wrong]))
            for note in notes:
                node.loginfo(str(note))
            rate = source.physics.real_time_update_rate
            self.physics = PhysicsProperties(source.physics.max_step_size, rate, source.gravity)
        else:
            self.name, flat, self.physics = source.name, source, PhysicsProperties()
        self.flat = flat
        self.engine = Engine(flat, lambda name: node.graph.rng(f"{node.name}/{name}"), noise=noise)
        self.host = Host(node, self.engine, from_zero=True, paused=paused, speed=self.physics.speed)
        if isinstance(source, SdfWorld):
            self._bring_all(source, still)
        else:
            for obstacle in flat.obstacles:
                self._note_obstacle(obstacle)
        self.set_physics(self.physics)

    def __repr__(self) -> str:
        return f"<GazeboWorld {self.name}: {len(self.models)} models, {self.now:.3f} s{', paused' * self.paused}>"

    def _bring_all(self, source: SdfWorld, still: list[SdfModel]) -> None:
        for model in source.models:
            if any(model is each for each in still):
                self._note_fixed(model)
            else:
                try:
                    self._bring(replace(model, pose=ORIGIN), model.name, model.pose, check=False)
                except SpawnError as error:
                    self.node.logerr(f"{model.path}:{model.line}: {error}. The world goes on without it")
        for actor in source.actors:
            self._note_obstacle(next(each for each in self.flat.obstacles if each.name == actor.name))
        for tag in source.plugins:
            self.load_plugin(tag)

    def _note_fixed(self, model: SdfModel) -> None:
        own = tuple(
            each.name
            for each in self.flat.obstacles
            if each.name == model.name or each.name.startswith(f"{model.name}::")
        )
        moving = any(each.motion is not None for each in self.flat.obstacles if each.name in own)
        self.models[model.name] = Model(
            self,
            model.name,
            replace(model, pose=ORIGIN),
            model.pose,
            obstacles=own,
            fixed=None if moving else model.pose,
        )

    def _note_obstacle(self, obstacle: Obstacle) -> None:
        """Take what rosmini's own world has as a model of one link."""
        x, y, yaw = obstacle.pose
        pose = (x, y, 0.0, 0.0, 0.0, yaw)
        sdf = SdfModel(obstacle.name, static=obstacle.fixed, links=(SdfLink("link"),))
        self.models[obstacle.name] = Model(
            self, obstacle.name, sdf, pose, obstacles=(obstacle.name,), fixed=pose if obstacle.fixed else None
        )

    # -- time ----------------------------------------------------------------------------------------------------

    @property
    def now(self) -> float:
        """The world's time [s]."""
        return self.host.now

    @property
    def paused(self) -> bool:
        """Whether time stands."""
        return self.host.paused

    @property
    def iterations(self) -> int:
        """How many steps of the physics that is."""
        return round(self.host.now / self.physics.time_step)

    def pause(self) -> None:
        """Let time stand. Harmless when repeated."""
        self.host.pause()
        self._tell_time()

    def unpause(self) -> None:
        """Let time go on. Harmless when repeated."""
        self.host.unpause()
        self._tell_time()

    def step(self, count: int = 1) -> None:
        """Let so many steps of the physics pass, and stand then. Raises `GazeboError` for less than one."""
        if count < 1:
            msg = f"a world is stepped once or more often, not {count} times"
            raise GazeboError(msg)
        self.host.pause()
        self.host.step(count * self.physics.time_step)
        self._tell_time()

    def reset_models(self) -> None:
        """Put every model back to where it came into the world; time goes on."""
        self.host.reset()
        for model in self.models.values():
            if model.fixed is not None and model.fixed != model.start:
                self.move(model, model.start)
        for plugin in self._all_plugins():
            plugin.reset()
        self._tell_time()

    def reset_time(self) -> None:
        """Let time begin at 0 again."""
        self.host.reset_time()
        self._tell_time()

    def reset(self) -> None:
        """Put everything back to how it was in the beginning, and time to 0."""
        self.reset_models()
        self.reset_time()

    def set_physics(self, physics: PhysicsProperties) -> None:
        """Change how the world is stepped."""
        self.host.catch_up()
        self.physics = physics
        self.host.speed = physics.speed
        self.engine.gravity = max(0.0, -physics.gravity[2])

    def save(self) -> WorldState:
        """Everything of now: where all is, how fast it goes, what the noise will be. Nothing changes by it; it can be pickled.

        Messages that are on their way are no part of it, nor is what a plugin remembers elsewhere than in a device.
        """
        return WorldState.of(self)

    def restore(self, state: WorldState) -> None:
        """Go on from there, to the last bit as it went on then: models that have come since go, those that have gone come back.

        Raises `GazeboError` for what is no state of this world, and `RosminiError` if there are other devices now than there were.
        """
        bring_back(self, state)
        self._tell_time()

    # -- models --------------------------------------------------------------------------------------------------

    def model(self, name: str) -> Model:
        """The model of this name. Raises `UnknownEntity`, with the nearest."""
        if name not in self.models:
            hint = nearest(name, self.models) or f"the models are: {', '.join(self.models) or 'none'}"
            raise UnknownEntity(f"there is no model {name!r} in the world {self.name!r}; {hint}")
        return self.models[name]

    def entity(self, name: str) -> tuple[Model, str]:
        """The model and the link that `model::link` or `model` names; without a link its first. Raises `UnknownEntity`."""
        model_name, _, link = name.partition("::")
        model = self.model(model_name)
        if not link:
            link = model.links[0] if model.links else ""
        elif link not in model.frames:
            model.link_frame(link)
        return model, link

    def frame(self, name: str) -> tuple[Pose6, Velocity]:
        """Where what is named is in the world, and how fast it goes; the world itself for `WORLD_FRAMES`. Raises `UnknownEntity`."""
        if name in WORLD_FRAMES:
            return ORIGIN, STILL
        model, link = self.entity(name)
        if "::" not in name or not link:
            return model.pose, model.velocity
        return model.link_pose(link), model.link_velocity(link)

    def holds(self, name: str) -> bool:
        """Tell whether what the engine calls so stands fast: a wall, or a fixed obstacle."""
        if name in self.engine.robots:
            return math.isinf(self.engine.robots[name].model.mass)
        return not any(each.name == name for each in self.engine.obstacles())

    def spawn(
        self,
        sdf: SdfModel,
        name: str = "",
        pose: Pose6 | None = None,
        *,
        namespace: str = "",
        frames: Mapping[str, tuple[str, Pose6]] | None = None,
    ) -> Model:
        """Let a model come into the world, as `name`, at `pose` (then its own pose counts from there). What is not static stands on the ground.

        Raises `SpawnError`: the name is used, something stands there, or a plugin lacks what it needs; and what the readers raise. Nothing
        of it is in the world then.
        """
        called = name or sdf.name
        where = sdf.pose if pose is None else compose6(pose, sdf.pose)
        self.host.catch_up()
        model = self._bring(
            replace(sdf, name=called, pose=ORIGIN), called, where, namespace, frames, check=True
        )
        self._tell("insert", model)
        return model

    def bring_back(self, name: str, state: ModelState) -> None:
        """Take in again, with its topics, a model that was deleted, and that a restored engine has already. For `restore`."""
        self._bring(
            state.sdf, name, state.start, state.namespace, state.frames, check=False, there=state.obstacles
        )
        self._tell("insert", self.models[name])

    def _bring(
        self,
        sdf: SdfModel,
        name: str,
        pose: Pose6,
        namespace: str = "",
        frames: Mapping[str, tuple[str, Pose6]] | None = None,
        *,
        check: bool,
        there: tuple[str, ...] | None = None,
    ) -> Model:
        """Let a model come, as what the engine has already if `there` names its obstacles."""
        self._check_new(name, pose)
        if check and not sdf.static:
            above = lowest(sdf, pose)
            pose = (pose[0], pose[1], 0.0 - above if above is not None else pose[2], *pose[3:])
        model = Model(self, name, sdf, pose, namespace, frames or {})
        found = self._plugin_classes(plugins_of(sdf), f"the model {name!r}", ModelPlugin)
        body = Body(sdf)
        for cls, tag in found:
            if issubclass(cls, ModelPlugin):
                cls.prepare(body, tag.element, self.node.logwarn)
        sensors = [
            Sensor(model, each, link) for link, there, _ in placed_links(sdf) for each in there.sensors
        ]
        is_robot = body.drive or sensors or any(getattr(cls, "needs_robot", False) for cls, _ in found)
        if there is not None:
            model.body, model.obstacles = body if is_robot else None, there
        elif is_robot:
            self._add_robot(model, body)
        else:
            self._add_things(model)
        self.models[name] = model
        try:
            self._load(model, found, sensors)
        except Exception as error:  # whatever a plugin of somebody's raises
            self._take(model)
            why = (
                error
                if isinstance(error, RosminiError)
                else f"a plugin raised {type(error).__name__}: {error}"
            )
            raise SpawnError(f"the model {name!r} cannot come into the world: {why}") from error
        return model

    def _check_new(self, name: str, pose: Pose6) -> None:
        if not name:
            raise SpawnError("a model needs a name")
        if name in self.models:
            raise SpawnError(
                f"there is a model {name!r} already; delete it first, or give this one another name"
            )
        if not all(math.isfinite(part) for part in pose):
            raise SpawnError(
                f"the model {name!r} cannot come to {pose}: all numbers of a pose have to be finite"
            )

    def _add_robot(self, model: Model, body: Body) -> None:
        x, y, _, _, _, yaw = model.start
        try:
            model.body = body
            self.engine.add(model.name, body.robot_model(), compose((x, y, yaw), body.axle))
        except RosminiError as error:
            raise SpawnError(f"the model {model.name!r} cannot come into the world: {error}") from error
        for note in body.notes:
            self.node.logwarn(note)

    def _add_things(self, model: Model) -> None:
        obstacles = to_obstacles(model.sdf, model.start)
        if not obstacles and model.sdf.links:
            self.node.loginfo(f"the model {model.name!r} has nothing solid: nothing will run against it")
        try:
            model.obstacles = self._insert_all(obstacles)
        except RosminiError as error:
            raise SpawnError(f"the model {model.name!r} cannot come into the world: {error}") from error
        if not any(obstacle.movable or obstacle.motion for obstacle in obstacles):
            model.fixed = model.start

    def _load(self, model: Model, found: list[tuple[type[Plugin], SdfPlugin]], sensors: list[Sensor]) -> None:
        for sensor in sensors:
            model.sensors.append(sensor)
            of_sensor = self._plugin_classes(
                sensor.sdf.plugins, f"the sensor {sensor.device_name!r}", SensorPlugin
            )
            for cls, tag in of_sensor:
                plugin = cls(self, f"{sensor.device_name}/{tag.name or tag.filename}")
                model.plugins.append(plugin)
                if isinstance(plugin, SensorPlugin):
                    plugin.load(sensor, tag.element)
        for cls, tag in found:
            plugin = cls(self, f"{model.name}/{tag.name or tag.filename}")
            model.plugins.append(plugin)
            if isinstance(plugin, ModelPlugin):
                plugin.load(model, tag.element)

    def delete(self, name: str) -> None:
        """Take a model out of the world, whether it moves or not: its topics end, and all else goes on. Raises `UnknownEntity`."""
        model = self.model(name)
        self._take(model)
        self._tell("delete", model)

    def _take(self, model: Model) -> None:
        """Take a model out of the world; what its plugins raise then is told, and it goes all the same."""
        self.host.catch_up()
        with ExitStack() as ends:
            ends.callback(self._forget, model)
            for plugin in model.plugins:
                ends.callback(self.node.guarded, plugin.close, what=f"the end of {plugin.name}")

    def _forget(self, model: Model) -> None:
        if model.body is not None:
            self.engine.remove(model.name)
        for obstacle in model.obstacles:
            self.engine.take_away(obstacle)
        del self.models[model.name]

    def move(self, model: Model, pose: Pose6, velocity: Velocity = STILL) -> None:
        """Put a model elsewhere, with a velocity in the frame of the world. Raises `GazeboError` for what is not finite, `WorldError` if something stands there."""
        if not all(math.isfinite(part) for part in (*pose, *velocity)):
            msg = f"the model {model.name!r} cannot be put to {pose} with the velocity {velocity}: all numbers have to be finite"
            raise GazeboError(msg)
        self.host.catch_up()
        if model.fixed is not None:
            self._move_fixed(model, pose)
        else:
            at = (pose[0], pose[1], pose[5])
            if model.body is not None:
                self.engine.put(model.name, compose(at, model.body.axle), velocity)
            else:
                if at != model.flat:
                    self._check_room(
                        next(each for each in self.engine.obstacles() if each.name == model.obstacles[0]), at
                    )
                self.engine.put(model.obstacles[0], at, velocity)
        self._tell("move", model)

    def _move_fixed(self, model: Model, pose: Pose6) -> None:
        """Take what stands fixed away, and put it down elsewhere; where it was, if there is no room."""
        old = tuple(each for each in self.engine.world.obstacles if each.name in model.obstacles)
        found = obstacles_at(pose, replace(model.sdf, name=model.name), old)
        for name in model.obstacles:
            self.engine.take_away(name)
        try:
            model.obstacles = self._insert_all(found)
        except RosminiError:
            self._insert_all(old)
            raise
        model.fixed = pose

    def _check_room(self, obstacle: Obstacle, pose: Pose) -> None:
        """Raise `WorldError` if something fixed is where a thing is to be."""
        hindrance = self.engine.world.blocked(pose, outline_of(obstacle), obstacle.height)
        if hindrance is not None:
            msg = f"{obstacle.name!r} cannot be placed at ({pose[0]:.2f}, {pose[1]:.2f}): {hindrance} is in its way"
            raise WorldError(msg)

    def _insert_all(self, obstacles: Iterable[Obstacle]) -> tuple[str, ...]:
        """Put obstacles into the world, all or none; return their names."""
        added: list[str] = []
        try:
            for obstacle in obstacles:
                if obstacle.movable:
                    self._check_room(obstacle, obstacle.pose)
                self.engine.insert(obstacle)
                added.append(obstacle.name)
        except RosminiError:
            for name in added:
                self.engine.take_away(name)
            raise
        return tuple(added)

    def _tell(self, what: str, model: Model) -> None:
        for callback in self.on_change:
            callback(what, model)

    def _tell_time(self) -> None:
        for callback in self.on_time:
            callback()

    # -- plugins -------------------------------------------------------------------------------------------------

    def _plugin_classes(
        self, tags: Iterable[SdfPlugin], whose: str, kind: type[Plugin]
    ) -> list[tuple[type[Plugin], SdfPlugin]]:
        """The classes of plugins that there are; of others, and of those of another kind, a warning tells."""
        found = []
        for tag in tags:
            try:
                cls = plugin_class(tag.filename)
            except UnknownPlugin as error:
                self.node.logwarn(f"{tag.element.path}:{tag.line}: {whose} goes on without a plugin: {error}")
                continue
            if not issubclass(cls, kind):
                self.node.logwarn(
                    f"{tag.element.path}:{tag.line}: {tag.filename!r} is a {cls.kind} plugin, but stands in {whose}, which takes "
                    f"{kind.kind} plugins: left out"
                )
                continue
            found.append((cls, tag))
        return found

    def load_plugin(self, tag: SdfPlugin | str) -> WorldPlugin | None:
        """Load a plugin of the world, by its tag or its file name; None, with a warning, if there is none."""
        if isinstance(tag, str):
            tag = SdfPlugin(tag, tag, Element("plugin", {"filename": tag}))
        for cls, each in self._plugin_classes([tag], f"the world {self.name!r}", WorldPlugin):
            plugin = cls(self, f"{self.name}/{each.name or each.filename}")
            if isinstance(plugin, WorldPlugin):
                self.plugins.append(plugin)
                plugin.load(self, each.element)
                return plugin
        return None

    def _all_plugins(self) -> list[Plugin]:
        return [*self.plugins, *(plugin for model in self.models.values() for plugin in model.plugins)]

    def close(self) -> None:
        """End all plugins, and time."""
        with ExitStack() as ends:
            ends.callback(self.host.end)
            for plugin in self._all_plugins():
                ends.callback(self.node.guarded, plugin.close, what=f"the end of {plugin.name}")
