"""Interactive views for a notebook, each with a scripted twin that calls the same callbacks."""
