"""`python -m rosmini.sim.worlds` draws the maps that rosmini brings again."""

from __future__ import annotations

from . import floor

for written in floor.write(floor.maps_dir()):
    print(written)
