"""Makes the committed files that are made by a program: worlds, maps, meshes, the README's picture, and type stubs.

`uv run python -m assets.generate` makes all of them again. None of this is in the wheel.
"""
