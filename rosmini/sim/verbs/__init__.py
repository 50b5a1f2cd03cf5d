"""The verbs of `rosmini` that belong to the simulators."""
