"""How far the numbers of a table may move, as the page says it below the table and as pages are compared by it."""
import re

NUMBER = re.compile(r"[-−]?\d+(?:\.\d+)?(?:e[-+−]?\d+)?")


def numbers(cell):
    return [float(text.replace("−", "-")) for text in NUMBER.findall(cell)]


class Same:
    words = "exactly"

    def holds(self, before, after):
        return before == after


class Relative:
    """Of the number itself; a number and an empty cell or a word are not alike."""

    def __init__(self, share):
        self.share, self.words = share, f"to {share:g} of itself"

    def holds(self, before, after):
        old, new = numbers(before), numbers(after)
        return len(old) == len(new) and (bool(old) or before == after) and all(
            abs(a - b) <= self.share * max(abs(a), abs(b)) for a, b in zip(old, new))


class Absolute:
    def __init__(self, size):
        self.size, self.words = size, f"to {size:g}"

    def holds(self, before, after):
        old, new = numbers(before), numbers(after)
        return len(old) == len(new) and (bool(old) or before == after) and all(
            abs(a - b) <= self.size for a, b in zip(old, new))


class Error:
    """A number that should be 0: it may be anything below the limit, or half as large again as it was."""

    def __init__(self, limit):
        self.limit, self.words = limit, f"up to {limit:g}, or half as large again as before"

    def holds(self, before, after):
        old, new = numbers(before), numbers(after)
        return len(old) == len(new) and all(b <= max(self.limit, 1.5 * a) for a, b in zip(old, new))


class Bar:
    """A value with an error bar: the two intervals have to meet."""
    words = "within the error bars"

    def holds(self, before, after):
        (old, old_bar), (new, new_bar) = map(self.interval, (before, after))
        return abs(old - new) <= old_bar + new_bar

    @staticmethod
    def interval(cell):
        value = numbers(cell)
        scale = 10 ** value[2] if cell.startswith("(") and cell.count(")e") and len(value) > 2 else 1
        return value[0] * scale, (value[1] if "±" in cell else 0) * scale


class Count:
    """Numbers of iterations, or ranges of them: each range meets the other one, widened by a share and two."""

    def __init__(self, share):
        self.share, self.words = share, f"counts to {100 * share:g} % and 2"

    def holds(self, before, after):
        old, new = map(self.ranges, (before, after))
        return len(old) == len(new) and all(self.meet(a, b) for a, b in zip(old, new))

    def meet(self, old, new):
        widened = self.share * old[1] + 2
        return new[0] <= old[1] + widened and new[1] >= old[0] - widened

    @staticmethod
    def ranges(cell):
        return [(float(low), float(high or low)) for low, high in re.findall(r"(\d+)(?: to (\d+))?", cell)]


class Tolerance:
    """For each cell the kind of its row (by the first cell), else of its column, else that of all. `finest` names
    rows that follow from the finest mesh."""

    def __init__(self, all_cells, columns=(), rows=(), finest=()):
        self.all, self.columns, self.rows, self.finest = all_cells, dict(columns), dict(rows), tuple(finest)

    def of(self, row, column):
        return self.rows.get(row) or self.columns.get(column) or self.all

    @property
    def words(self):
        special = [f"{name}: {kind.words}" for name, kind in (self.columns | self.rows).items()]
        return "; ".join([*special, self.all.words if not special else f"all else: {self.all.words}"])
