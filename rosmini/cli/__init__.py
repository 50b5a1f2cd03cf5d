"""The `rosmini` command."""
