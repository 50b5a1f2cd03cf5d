"""Parts of recordings, for tests."""

from dataclasses import replace


def part(run, t0, t1):
    """Return what was recorded from `t0` to `t1` [s]; times are unchanged."""
    inside = (run.times >= t0) & (run.times <= t1)
    seen = (run.scan_times >= t0) & (run.scan_times <= t1)
    return replace(
        run,
        times=run.times[inside],
        truth=run.truth[inside],
        odom=run.odom[inside],
        commands=run.commands[run.commands[:, 0] <= t1],
        scan_times=run.scan_times[seen],
        scans=run.scans[seen],
        others=tuple(part(other, t0, t1) for other in run.others),
        things=tuple(thing.window(t0, t1) for thing in run.things),
        messages=tuple(each for each in run.messages if t0 <= each[0] <= t1),
    )
