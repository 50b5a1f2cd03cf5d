"""Notebooks whose cells are terminals and scripts: `%load_ext rosmini`, `%roscore`, `%%node`.

What belongs to one notebook is a :class:`~rosmini.notebook.session.Session`; nothing is kept in this package itself.
"""
