"""Values of parameters that hector_mapping accepts are accepted; those that are limited here cause one warning."""

from __future__ import annotations

import pytest

from rosmini.core.errors import ParameterError
from rosmini.core.graph import Graph
from rosmini.navigation.hector_mapping.parameters import HectorMappingParameters


@pytest.fixture
def node():
    with Graph() as graph:
        yield graph.node("hector_mapping")


UNCHANGED = {
    "map_resolution": (1e-4, 10.0),
    "map_multi_res_levels": (1, 100),
    "map_update_distance_thresh": (-1.0, 0.0),
    "map_update_angle_thresh": (-1.0, 0.0),
    "laser_min_dist": (-0.4, 0.0),
    "laser_max_dist": (-30.0, 0.0),
    "laser_z_min_value": (1.0,),
    "laser_z_max_value": (-1.0,),
    "scan_subscriber_queue_size": (-1, 0),
}
LIMITED = [
    ("map_size", 0, 2),
    ("map_size", 1, 2),
    ("map_size", 20_000, 16_384),
    ("map_start_x", -0.5, 0.0),  # in the original the map stays empty
    ("map_start_y", 1.5, 1.0),
    ("map_pub_period", 0.0, 0.01),  # the original never pauses
    ("map_pub_period", -1.0, 0.01),
    ("update_factor_free", 0.0, 1e-6),  # the original computes with infinite log-odds
    ("update_factor_free", -1.0, 1e-6),
    ("update_factor_occupied", 1.0, 0.999999),
]


@pytest.mark.parametrize(("name", "value"), [(name, one) for name, values in UNCHANGED.items() for one in values])
def test_a_value_that_the_original_accepts_is_used(node, capsys, name, value):
    node.set_param(f"~{name}", value)
    assert getattr(HectorMappingParameters.read(node), name) == value
    assert "WARN" not in capsys.readouterr().err


@pytest.mark.parametrize(("name", "value", "limited"), LIMITED)
def test_a_value_that_is_limited_causes_one_warning(node, capsys, name, value, limited):
    node.set_param(f"~{name}", value)
    assert getattr(HectorMappingParameters.read(node), name) == limited
    warned = capsys.readouterr().err
    assert warned.count("WARN") == 1
    assert f"/hector_mapping/{name} " in warned
    assert str(limited) in warned


@pytest.mark.parametrize(("name", "value"), [("map_resolution", 0.0), ("map_multi_res_levels", 0), ("map_size", -5)])
def test_a_value_that_ends_the_original_is_an_error(node, name, value):
    node.set_param(f"~{name}", value)
    with pytest.raises(ParameterError, match=f"/hector_mapping/{name} .* is {value}"):
        HectorMappingParameters.read(node)


def test_the_sign_of_distances_has_no_effect(node):
    """The original squares them."""
    node.set_param("~laser_min_dist", -0.4)
    node.set_param("~laser_max_dist", -30.0)
    assert HectorMappingParameters.read(node).limits()[:2] == (0.4, 30.0)
