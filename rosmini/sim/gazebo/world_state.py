"""Everything of a running world at one moment: plain data, which may be copied, pickled, and brought back."""

from __future__ import annotations

from dataclasses import dataclass, fields, is_dataclass
from typing import TYPE_CHECKING, Any

from rosmini.sim.host import HostState
from rosmini.sim.sdf import Pose6, SdfModel

from .errors import GazeboError
from .model import Model
from .physics import PhysicsProperties
from .wrenches import WrenchState

if TYPE_CHECKING:
    from .world import GazeboWorld


@dataclass(frozen=True)
class ModelState:
    """What a model is, and what of it the engine does not know."""

    sdf: SdfModel
    start: Pose6
    namespace: str
    frames: dict[str, tuple[str, Pose6]]
    obstacles: tuple[str, ...]
    fixed: Pose6 | None
    """Where it is if it stands fast."""

    @classmethod
    def of(cls, model: Model) -> ModelState:
        """That of a model now."""
        return cls(model.sdf, model.start, model.namespace, dict(model.frames), model.obstacles, model.fixed)

    def came_as(self, model: Model) -> bool:
        """Tell whether a model came into the world as this one did."""
        return all(
            alike(getattr(self, name), getattr(model, name))
            for name in ("namespace", "start", "frames", "sdf")
        )


@dataclass(frozen=True)
class WorldState:
    """All that a world will go on from; see `rosmini.sim.gazebo.world.GazeboWorld.save`."""

    world: str
    host: HostState
    models: dict[str, ModelState]
    physics: PhysicsProperties
    forces: tuple[WrenchState, ...]

    @classmethod
    def of(cls, world: GazeboWorld) -> WorldState:
        """That of a world now."""
        models = {name: ModelState.of(model) for name, model in world.models.items()}
        return cls(world.name, world.host.save(), models, world.physics, world.wrenches.state())


def bring_back(world: GazeboWorld, state: WorldState) -> None:
    """Let a world be as it was; see `rosmini.sim.gazebo.world.GazeboWorld.restore`."""
    if not isinstance(state, WorldState):
        msg = f"the world {world.name!r} can only be restored from what its save() returned, not from a {type(state).__name__}"
        raise GazeboError(msg)
    if state.world != world.name:
        msg = f"a state of the world {state.world!r} cannot be restored in the world {world.name!r}"
        raise GazeboError(msg)
    for name, model in list(world.models.items()):
        if name not in state.models or not state.models[name].came_as(model):
            world.delete(name)
    gone = [name for name in state.models if name not in world.models]
    world.set_physics(state.physics)
    world.engine.restore(state.host.engine)
    for name in gone:
        world.bring_back(name, state.models[name])
    for name, old in state.models.items():
        world.models[name].obstacles, world.models[name].fixed = old.obstacles, old.fixed
    world.models = {name: world.models[name] for name in state.models}
    world.wrenches.restore(state.forces)
    world.host.restore(state.host)


def alike(a: Any, b: Any) -> bool:
    """Tell whether two descriptions say the same: also elements of markup, which are equal only to themselves."""
    if type(a) is not type(b):
        return False
    if is_dataclass(a):
        return a is b or all(alike(getattr(a, each.name), getattr(b, each.name)) for each in fields(a))
    if isinstance(a, dict):
        return a.keys() == b.keys() and all(alike(value, b[key]) for key, value in a.items())
    if isinstance(a, (list, tuple)):
        return len(a) == len(b) and all(map(alike, a, b))
    return bool(a == b)
