"""Makes the committed files that are made by a program: worlds, maps, meshes and the README's picture.

`uv run python -m assets.generate` makes all of them again. None of this is in the wheel.
"""
