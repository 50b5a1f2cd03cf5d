"""The embedded pub/sub library: names, time, messages, the computation graph, tf, actions and parameters."""
