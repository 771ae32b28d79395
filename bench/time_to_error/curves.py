# SPDX-License-Identifier: MIT
"""Error against time: a configuration's curve, and where it reaches a level."""
import dataclasses
import math


@dataclasses.dataclass(frozen=True)
class Point:
    """One picture, or the mean over pictures that differ in their seed alone."""
    value: int  # what grows along the curve
    seconds: float
    error: float  # an unbiased estimate of it, which may be below 0


@dataclasses.dataclass(frozen=True)
class Reached:
    """How long a configuration takes to an error."""
    seconds: float
    is_bound: bool = False  # the first picture was already better: at most this long


def seconds_to(points, level, smallest):
    """Seconds until the error is `level`, interpolated in log-log; None when no picture is as good.

    Errors below `smallest` > 0, which noise of the references hides, count as that.
    """
    ordered = sorted(points, key=lambda p: p.value)
    errors = [max(p.error, smallest) for p in ordered]
    for i, error in enumerate(errors):
        if error > level:
            continue
        if i == 0:
            return Reached(ordered[0].seconds, is_bound=True)
        before = errors[i - 1]
        share = math.log(before / level) / math.log(before / error)
        begin, end = ordered[i - 1].seconds, ordered[i].seconds
        return Reached(begin * (end / begin) ** share)
    return None


def slope(points):
    """Exponent of the error as a power of the seconds over the last two points; None without."""
    last = sorted(points, key=lambda p: p.value)[-2:]
    if len(last) < 2 or last[0].seconds == last[1].seconds or min(p.error for p in last) <= 0:
        return None
    return math.log(last[1].error / last[0].error) / math.log(last[1].seconds / last[0].seconds)
