import pytest

from rosmini.navigation.move_base.recoveries import InvalidList, parsed_entries


def test_a_good_list_keeps_its_order():
    entries = [{"name": "b", "type": "p/B"}, {"name": "a", "type": "p/A"}]
    assert parsed_entries(entries) == [("b", "p/B"), ("a", "p/A")]
    assert parsed_entries([]) == []


@pytest.mark.parametrize(
    ("entries", "message"),
    [
        ("conservative", "must be a list, but is of the type str"),
        (["conservative"], "must be specified as maps, but they are of the type str"),
        ([{"name": "a"}], "must have a name and a type and this does not.*It has name"),
        ([{"name": "a", "type": "x"}, {"name": "a", "type": "y"}], "with the name a already exists"),
    ],
)
def test_a_bad_one_says_why(entries, message):
    with pytest.raises(InvalidList, match=message):
        parsed_entries(entries)
