"""Two example plugins: a model plugin that pushes its model, and a world plugin that spawns crates."""

from __future__ import annotations

from .model_push import ModelPush
from .world_spawner import Spawner

__all__ = ["ModelPush", "Spawner"]
