"""Pictures of gmapping's particles: what they say, that they are steady, and what they refuse."""

import numpy as np
import pytest

from rosmini.navigation.gmapping import Film, GridSlam, Settings
from rosmini.viz.view import ViewError

from ..navigation.gmapping.test_matching import BEARINGS, square
from ..navigation.gmapping.test_slam import a_slam


@pytest.fixture(scope="module")
def film():
    """A short drive along a square room, in too many steps."""
    slam = a_slam(particles=4, linear_update=0.3)
    film = Film(slam)
    for step in range(4):
        x = 0.3 * step
        film.take(slam.process(square(x, 0.0, 0.0), BEARINGS, (1.02 * x, 0.0, 0.0), float(step)))
    return film


def test_a_map_with_its_paths(film):
    view = film.slam.show(title="Figure 1")
    assert view.text.startswith("Figure 1: the map of the best particle: 4.")
    assert "its path: 4 scans, 0.9 m; 4 of the first 4 particles live on" in view.text
    assert "paths of the others" in view.svg
    worst = int(np.argmin(film.slam.sums))
    assert f"the map of particle {worst}" in film.slam.show(particle=worst).text


def test_a_film_is_played(film):
    view = film.show(title="Figure 2")
    assert "best particle" in view.text
    assert "map" in view.text
    assert "paths of all particles" in view.text


@pytest.mark.parametrize(
    ("make", "said"),
    [
        (lambda film: film.slam.show(particle=7), "particles 0 to 3, not 7"),
        (lambda film: GridSlam(Settings(), random=np.random.default_rng(0)).show(), "no scan has been processed"),
        (lambda film: Film(film.slam).show(), "the film is empty"),
    ],
)
def test_what_cannot_be_drawn(film, make, said):
    with pytest.raises(ViewError, match=said):
        make(film)
