"""What an installed distribution announces."""

import os

from rosmini.core.entry_points import entry_points


def test_what_is_installed_later_is_found(tmp_path, monkeypatch):
    os.utime(tmp_path, (0, 0))
    monkeypatch.syspath_prepend(str(tmp_path))
    assert "late" not in entry_points("rosmini.nodes").names
    info = tmp_path / "late-1.0.dist-info"
    info.mkdir()
    (info / "METADATA").write_text("Metadata-Version: 2.1\nName: late\nVersion: 1.0\n", encoding="utf-8")
    (info / "entry_points.txt").write_text("[rosmini.nodes]\nlate = json:dumps\n", encoding="utf-8")
    assert "late" in entry_points("rosmini.nodes").names
    assert "late" not in entry_points("rosmini.verbs").names
