"""Limits of sequences of values on meshes or steps, each half as coarse as the one before."""
import math


class Limit:
    def __init__(self, value, bar, order):
        self.value, self.bar, self.order = value, bar, order

    def agrees_with(self, other):
        return abs(self.value - other.value) <= self.bar + other.bar


def aitken(a, b, c):
    """The limit of a geometric approach; None where the differences do not shrink with one sign."""
    before, last = b - a, c - b
    if before * last <= 0 or abs(last) >= abs(before):
        return None
    return c + last * last / (before - last)


def limit(values):
    """Aitken's extrapolation of the last three values. The error bar is its distance from the last value or
    from the extrapolation of the three before, whichever is larger. Where there is no extrapolation: the
    last value, and the larger of the last two differences."""
    a, b, c = values[-3:]
    value = aitken(a, b, c)
    if value is None:
        return Limit(c, max(abs(b - a), abs(c - b)), None)
    before = aitken(*values[-4:-1]) if len(values) > 3 else None
    bar = abs(value - c) if before is None else max(abs(value - c), abs(value - before))
    return Limit(value, bar, math.log2((b - a) / (c - b)))


def growth(values):
    """Two estimates of s in h^-s: from the last two values, and from the last two differences, which a
    constant beside the power does not disturb."""
    a, b, c = (abs(value) for value in values[-3:])
    shrinks = (c - b) * (b - a) <= 0
    return math.log2(c / b), None if shrinks else math.log2((c - b) / (b - a))
