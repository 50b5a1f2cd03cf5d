"""Notebooks whose cells are terminals and scripts: `%load_ext rosmini`, `%roscore`, `%%node`.

The state of a notebook is in its :class:`~rosmini.notebook.session.Session`; this package itself has none.
"""
