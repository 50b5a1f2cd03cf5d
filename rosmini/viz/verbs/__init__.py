"""The verbs of `rosmini` that show pictures."""
