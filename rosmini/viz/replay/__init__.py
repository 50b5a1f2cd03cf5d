"""A recorded run as a player that needs no server: `replay(recording)`, or `recording.replay()`.

`replay("demo.bag")` plays a bag; a `Run` of bodies and layers plays data that is not in messages.
"""
