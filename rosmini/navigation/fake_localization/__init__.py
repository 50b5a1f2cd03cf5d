"""A localisation that uses the true pose (http://wiki.ros.org/fake_localization)."""
