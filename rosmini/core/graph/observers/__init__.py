"""Observers of a graph: recording, injected faults, statistics of topics, console of log messages."""
