"""The pub/sub library: names, time, errors, packages, messages, parameters, the computation graph, tf, actionlib."""
