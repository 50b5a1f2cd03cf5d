"""Observers of a graph: recording, faults made on purpose, statistics of topics, console of log messages."""
