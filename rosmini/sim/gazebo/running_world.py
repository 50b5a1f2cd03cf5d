"""The running world: models that are inserted, removed and moved, and plugins.

Services, Gazebo's topics, plugins, `gz` and notebooks all act on this object, which acts on the engine and its
host.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable, Mapping
from contextlib import ExitStack
from dataclasses import replace

from rosmini.core.errors import RosminiError
from rosmini.core.geometry.poses import compose
from rosmini.core.graph import Node
from rosmini.core.markup import Element
from rosmini.sim.dragging import check_room
from rosmini.sim.engine import Engine
from rosmini.sim.host import Host
from rosmini.sim.sdf import converted, placed_links, to_obstacles
from rosmini.sim.sdf.document import ORIGIN, Pose6, SdfLink, SdfModel, SdfPlugin, SdfWorld
from rosmini.sim.sdf.poses import compose as compose6
from rosmini.sim.world import Obstacle, World

from .body import Body, is_still, lowest, obstacles_at, plugins_of
from .errors import GazeboError, SpawnError, UnknownPlugin
from .model import STILL, GazeboWorld, Model, Sensor, Velocity
from .physics_properties import PhysicsProperties
from .plugins import ModelPlugin, Plugin, SensorPlugin, WorldPlugin, plugin_class
from .wrenches import Wrenches


class RunningWorld(GazeboWorld):
    """A world with models in it, in a node.

    Args:
        node: the started node; the models' topics belong to it.
        source: an SDF world, or one of rosmini's worlds.
        paused: True if time is paused initially.
        noise: scales the noise of all sensors; 0: no noise.

    """

    def __init__(self, node: Node, source: World | SdfWorld, *, paused: bool = False, noise: float = 1.0) -> None:
        self.node = node
        self.noise = noise
        self.models = {}
        self.plugins: list[Plugin] = []
        """Plugins of the world itself."""
        self.model_plugins: dict[str, list[Plugin]] = {}
        """Plugins of models and their sensors, by the model's name."""
        self.on_change: list[Callable[[str, Model], object]] = []
        """Called with "insert", "delete" or "move", and the model."""
        self.wrenches = Wrenches(self)
        """The forces that act on models."""
        if isinstance(source, SdfWorld):
            self.name = source.name
            still = [model for model in source.models if is_still(model)]
            flat, notes = converted(replace(source, models=tuple(still)))
            if source.warnings:
                wrong = map(str, source.warnings)
                node.logwarn("\n".join([f"the world {source.name!r} is incomplete:", *wrong]))
            for note in notes:
                node.loginfo(str(note))
            rate = source.physics.real_time_update_rate
            self.physics = PhysicsProperties(source.physics.max_step_size, rate, *source.gravity)
        else:
            self.name, flat, self.physics = source.name, source, PhysicsProperties()
        self.flat = flat
        self.engine = Engine(flat, lambda name: node.graph.rng(f"{node.name}/{name}"), noise=noise)
        self.host = Host(node, self.engine, from_zero=True, paused=paused, speed=self.physics.speed)
        if isinstance(source, SdfWorld):
            self._insert_models(source, still)
        else:
            for obstacle in flat.obstacles:
                self._note_obstacle(obstacle)
        self.set_physics(self.physics)

    def _insert_models(self, source: SdfWorld, still: list[SdfModel]) -> None:
        for model in source.models:
            if any(model is each for each in still):
                self._note_fixed(model)
            else:
                try:
                    self._insert(replace(model, pose=ORIGIN), model.name, model.pose, check=False)
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
        """Make a model with one link of an obstacle in one of rosmini's worlds."""
        x, y, yaw = obstacle.pose
        pose = (x, y, 0.0, 0.0, 0.0, yaw)
        sdf = SdfModel(obstacle.name, static=obstacle.fixed, links=(SdfLink("link"),))
        self.models[obstacle.name] = Model(
            self, obstacle.name, sdf, pose, obstacles=(obstacle.name,), fixed=pose if obstacle.fixed else None
        )

    # -- time ----------------------------------------------------------------------------------------------------

    def step(self, count: int = 1) -> None:
        """Take `count` physics steps and pause. Raises `GazeboError` for less than one."""
        if count < 1:
            raise GazeboError(f"a world is stepped once or more often, not {count} times")
        self.host.pause()
        self.host.step(count * self.physics.time_step)

    def reset_models(self) -> None:
        """Return every model to its spawn pose; time continues."""
        self.host.reset()
        for model in self.models.values():
            if model.fixed is not None and model.fixed != model.start:
                self.move(model, model.start)
        for plugin in self._all_plugins():
            plugin.reset()
        self.host.tell_time()

    def set_physics(self, physics: PhysicsProperties) -> None:
        """Change the physics settings."""
        self.host.catch_up()
        self.physics = physics
        self.host.speed = physics.speed
        self.engine.set_surface(gravity=max(0.0, -physics.gravity[2]))

    # -- models --------------------------------------------------------------------------------------------------

    def spawn(
        self,
        sdf: SdfModel,
        name: str = "",
        pose: Pose6 | None = None,
        *,
        namespace: str = "",
        frames: Mapping[str, tuple[str, Pose6]] | None = None,
    ) -> Model:
        """See `GazeboWorld.spawn`."""
        called = name or sdf.name
        where = sdf.pose if pose is None else compose6(pose, sdf.pose)
        self.host.catch_up()
        model = self._insert(replace(sdf, name=called, pose=ORIGIN), called, where, namespace, frames, check=True)
        self._notify("insert", model)
        return model

    def _insert(
        self,
        sdf: SdfModel,
        name: str,
        pose: Pose6,
        namespace: str = "",
        frames: Mapping[str, tuple[str, Pose6]] | None = None,
        *,
        check: bool,
    ) -> Model:
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
        sensors = [Sensor(model, each, link) for link, there, _ in placed_links(sdf) for each in there.sensors]
        is_robot = body.drive or sensors or any(getattr(cls, "needs_robot", False) for cls, _ in found)
        if is_robot:
            self._add_robot(model, body)
        else:
            self._add_things(model)
        self.models[name] = model
        try:
            self._load(model, found, sensors)
        except Exception as error:  # a plugin can raise anything
            self._remove(model)
            why = error if isinstance(error, RosminiError) else f"a plugin raised {type(error).__name__}: {error}"
            raise SpawnError(f"the model {name!r} cannot be added to the world: {why}") from error
        return model

    def _check_new(self, name: str, pose: Pose6) -> None:
        if not name:
            raise SpawnError("a model needs a name")
        if name in self.models:
            raise SpawnError(f"there is a model {name!r} already; delete it first, or give this one another name")
        if not all(math.isfinite(part) for part in pose):
            raise SpawnError(f"the model {name!r} cannot be placed at {pose}: all numbers of a pose must be finite")

    def _add_robot(self, model: Model, body: Body) -> None:
        x, y, _, _, _, yaw = model.start
        try:
            model.body = body
            self.engine.add(model.name, body.robot_model(), compose((x, y, yaw), body.axle))
        except RosminiError as error:
            raise SpawnError(f"the model {model.name!r} cannot be added to the world: {error}") from error
        for note in body.notes:
            self.node.logwarn(note)

    def _add_things(self, model: Model) -> None:
        obstacles = to_obstacles(model.sdf, model.start)
        if not obstacles and model.sdf.links:
            self.node.loginfo(f"the model {model.name!r} has nothing solid: nothing will run against it")
        try:
            model.obstacles = self._insert_all(obstacles)
        except RosminiError as error:
            raise SpawnError(f"the model {model.name!r} cannot be added to the world: {error}") from error
        if not any(obstacle.movable or obstacle.motion for obstacle in obstacles):
            model.fixed = model.start

    def _load(self, model: Model, found: list[tuple[type[Plugin], SdfPlugin]], sensors: list[Sensor]) -> None:
        plugins = self.model_plugins[model.name] = []
        for sensor in sensors:
            model.sensors.append(sensor)
            of_sensor = self._plugin_classes(sensor.sdf.plugins, f"the sensor {sensor.device_name!r}", SensorPlugin)
            for cls, tag in of_sensor:
                plugin = cls(self, f"{sensor.device_name}/{tag.name or tag.filename}")
                try:
                    if isinstance(plugin, SensorPlugin):
                        plugin.load(sensor, tag.element)
                except RosminiError as error:  # Gazebo goes on without it, too
                    plugin.close()
                    self.node.logwarn(f"the sensor {sensor.device_name!r} is left out: {error}")
                    continue
                plugins.append(plugin)
        for cls, tag in found:
            plugin = cls(self, f"{model.name}/{tag.name or tag.filename}")
            plugins.append(plugin)
            if isinstance(plugin, ModelPlugin):
                plugin.load(model, tag.element)

    def delete(self, name: str) -> None:
        """See `GazeboWorld.delete`."""
        model = self.model(name)
        self._remove(model)
        self._notify("delete", model)

    def _remove(self, model: Model) -> None:
        """Remove a model; exceptions of its plugins are reported and do not prevent it."""
        self.host.catch_up()
        with ExitStack() as ends:
            ends.callback(self._forget, model)
            for plugin in self.model_plugins.pop(model.name, ()):
                ends.callback(self.node.guarded, plugin.close, what=f"the end of {plugin.name}")

    def _forget(self, model: Model) -> None:
        if model.body is not None:
            self.engine.remove(model.name)
        for obstacle in model.obstacles:
            self.engine.remove_obstacle(obstacle)
        del self.models[model.name]

    def move(self, model: Model, pose: Pose6, velocity: Velocity = STILL) -> None:
        """See `GazeboWorld.move`."""
        if not all(math.isfinite(part) for part in (*pose, *velocity)):
            what = f"put to {pose} with the velocity {velocity}"
            raise GazeboError(f"the model {model.name!r} cannot be {what}: all numbers must be finite")
        self.host.catch_up()
        if model.fixed is not None:
            self._move_fixed(model, pose)
        else:
            at = (pose[0], pose[1], pose[5])
            if model.body is not None:
                self.engine.put(model.name, compose(at, model.body.axle), velocity)
            else:
                if at != model.flat:
                    here = {each.name: each for each in self.engine.obstacles()}
                    check_room(self.engine, here[model.obstacles[0]], at)
                self.engine.put(model.obstacles[0], at, velocity)
        self._notify("move", model)

    def _move_fixed(self, model: Model, pose: Pose6) -> None:
        """Move a fixed model; it stays where it was if there is no room."""
        old = tuple(each for each in self.engine.world.obstacles if each.name in model.obstacles)
        found = obstacles_at(pose, replace(model.sdf, name=model.name), old)
        for name in model.obstacles:
            self.engine.remove_obstacle(name)
        try:
            model.obstacles = self._insert_all(found)
        except RosminiError:
            self._insert_all(old)
            raise
        model.fixed = pose

    def _insert_all(self, obstacles: Iterable[Obstacle]) -> tuple[str, ...]:
        """Insert obstacles, all or none; return their names."""
        added: list[str] = []
        try:
            for obstacle in obstacles:
                if obstacle.movable:
                    check_room(self.engine, obstacle, obstacle.pose)
                self.engine.insert(obstacle)
                added.append(obstacle.name)
        except RosminiError:
            for name in added:
                self.engine.remove_obstacle(name)
            raise
        return tuple(added)

    def _notify(self, what: str, model: Model) -> None:
        for callback in self.on_change:
            callback(what, model)

    # -- plugins -------------------------------------------------------------------------------------------------

    def _plugin_classes(
        self, tags: Iterable[SdfPlugin], whose: str, kind: type[Plugin]
    ) -> list[tuple[type[Plugin], SdfPlugin]]:
        """Return the classes of plugins, with a warning for unknown ones and those of another kind."""
        found = []
        for tag in tags:
            try:
                cls = plugin_class(tag.filename)
            except UnknownPlugin as error:
                self.node.logwarn(f"{tag.element.path}:{tag.line}: {whose} goes on without a plugin: {error}")
                continue
            if not issubclass(cls, kind):
                self.node.logwarn(
                    f"{tag.element.path}:{tag.line}: {tag.filename!r} is a {cls.kind} plugin, but is in {whose}, "
                    f"which takes {kind.kind} plugins: left out"
                )
                continue
            found.append((cls, tag))
        return found

    def load_plugin(self, tag: SdfPlugin | str) -> WorldPlugin | None:
        """Load a plugin of the world by its tag or file name; return None, with a warning, if it is unknown."""
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
        return [*self.plugins, *(plugin for plugins in self.model_plugins.values() for plugin in plugins)]

    def close(self) -> None:
        """Close all plugins, and stop time."""
        with ExitStack() as ends:
            ends.callback(self.host.end)
            for plugin in self._all_plugins():
                ends.callback(self.node.guarded, plugin.close, what=f"the end of {plugin.name}")
