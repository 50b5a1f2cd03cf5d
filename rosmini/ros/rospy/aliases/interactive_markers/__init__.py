"""The module that scripts import as ``interactive_markers``: http://wiki.ros.org/interactive_markers.

Names and signatures are those of interactive_markers 1.12; the node is that of the script. The implementation is
:mod:`rosmini.ros.interactive_markers`.
"""
