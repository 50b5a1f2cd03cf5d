"""A recorded run as a player that needs no server: `player.replay(recording)`, or `recording.replay()`.

`player.replay("demo.bag")` plays a bag; a `run.Run` of bodies and layers plays data that is not in messages.
"""
