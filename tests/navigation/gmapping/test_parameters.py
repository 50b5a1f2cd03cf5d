"""Values of parameters that slam_gmapping accepts are accepted; those that are limited here cause one warning."""

from __future__ import annotations

import math

import pytest

from rosmini.core.errors import ParameterError
from rosmini.core.graph import Graph
from rosmini.navigation.gmapping.parameters import GmappingParameters


@pytest.fixture
def node():
    with Graph() as graph:
        yield graph.node("gmapping")


UNCHANGED = {
    "map_update_interval": (-1.0, 0.0, math.inf),
    "transform_publish_period": (-1.0, 0.0),
    "tf_delay": (-0.1, 0.0),
    "maxRange": (0.0, math.inf),
    "maxUrange": (0.0, math.inf),
    "minimumScore": (-1.0, 1e9),
    "kernelSize": (-1, 0),
    "lstep": (-0.05, 0.0),
    "astep": (-0.05, 0.0),
    "lskip": (-1, 10_000),
    "srr": (-0.1, 0.0),
    "srt": (-0.2, 0.0),
    "str": (-0.1, 0.0),
    "stt": (-0.2, 0.0),
    "linearUpdate": (-1.0, 0.0),
    "angularUpdate": (-1.0, 0.0),
    "temporalUpdate": (0.0, 10.0),
    "resampleThreshold": (-1.0, 2.0),
    "xmin": (200.0,),
    "occ_thresh": (-1.0, 2.0),
}
LIMITED = [
    ("throttle_scans", -2, 1),  # 0 ends the original: it divides by it
    ("throttle_scans", 0, 1),
    ("tf_delay", 1e10, 1e6),
    ("maxRange", -1.0, 0.0),  # no beam is used in either case
    ("maxUrange", -5.0, 0.0),
    ("sigma", 0.0, 1e-6),
    ("sigma", -0.05, 1e-6),
    ("kernelSize", 100, 10),
    ("iterations", -1, 0),
    ("iterations", 1000, 50),
    ("lsigma", 0.0, 1e-6),
    ("ogain", 0.0, 1e-6),
    ("particles", 20_000, 10_000),
    ("xmin", -math.inf, -1e6),
    ("ymax", 1e9, 1e6),
    ("delta", 1e-4, 1e-3),
]


@pytest.mark.parametrize(("name", "value"), [(name, one) for name, values in UNCHANGED.items() for one in values])
def test_a_value_that_the_original_accepts_is_used(node, capsys, name, value):
    node.set_param(f"~{name}", value)
    assert getattr(GmappingParameters.read(node), name) == value
    assert "WARN" not in capsys.readouterr().err


@pytest.mark.parametrize(("name", "value", "limited"), LIMITED)
def test_a_value_that_is_limited_causes_one_warning(node, capsys, name, value, limited):
    node.set_param(f"~{name}", value)
    assert getattr(GmappingParameters.read(node), name) == limited
    warned = capsys.readouterr().err
    assert warned.count("WARN") == 1
    assert f"/gmapping/{name} " in warned
    assert str(limited) in warned


@pytest.mark.parametrize(("name", "value"), [("particles", 0), ("particles", -1), ("delta", 0.0), ("delta", -0.05)])
def test_a_value_that_ends_the_original_is_an_error(node, name, value):
    node.set_param(f"~{name}", value)
    with pytest.raises(ParameterError, match=f"/gmapping/{name} .* is {value}"):
        GmappingParameters.read(node)


def test_a_negative_lskip_skips_all_beams(node):
    """It is unsigned in the original."""
    node.set_param("~lskip", -1)
    assert GmappingParameters.read(node).settings(3.5).matcher.lskip == 2**32 - 1
