"""A notebook whose cells are terminals: ``%load_ext rosmini``, ``%roscore``, ``%%node talker.py``.

What belongs to one notebook is a :class:`~rosmini.notebook.session.Session`; nothing is kept in this package itself.
"""
