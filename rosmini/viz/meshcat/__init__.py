"""The robot and its world in three dimensions, through meshcat's API and without a server."""
