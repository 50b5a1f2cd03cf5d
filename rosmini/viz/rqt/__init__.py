"""The tools of rqt (http://wiki.ros.org/rqt): panels with controls, and functions that return a picture or a table."""
