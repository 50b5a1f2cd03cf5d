"""Two plugins as one writes them: a model plugin that pushes its model along, and a world plugin that lets things come into the world."""

from __future__ import annotations

from .model_push import ModelPush
from .world_spawner import Spawner

__all__ = ["ModelPush", "Spawner"]
