"""Markdown and numbers."""
import math
import re


class Page:
    """A page whose tables say on which state they were measured and how far their numbers may move."""

    def __init__(self, commit):
        self.commit, self.parts, self.heading, self.count, self.tables = commit, [], "", 0, {}

    def add(self, *parts):
        """Paragraphs and headings (texts), tables as (header, rows, Tolerance)."""
        for part in parts:
            if isinstance(part, str):
                for heading in re.findall(r"^#+ (.*)$", part, re.M):
                    self.heading, self.count = heading, 0
                self.parts.append(part.strip("\n"))
            else:
                self.count += 1
                self.tables[self.heading, self.count] = part
                self.parts += [table(*part[:2]), f"*State {self.commit}. May move: {part[2].words}.*"]

    def text(self):
        return "\n\n".join(self.parts) + "\n"


def table(header, rows):
    lines = ["| " + " | ".join(header) + " |", "|" + " --- |" * len(header)]
    return "\n".join(lines + ["| " + " | ".join(str(cell) for cell in row) + " |" for row in rows])


def number(value, digits=6):
    if value is None:
        return ""
    text = f"{value:.{digits}g}"
    return text.replace("-", "−", 1) if text.startswith("-") else text


def error(value):
    """An error: two digits."""
    return f"{value:.1e}" if value else "0"


def with_error_bar(value, bar):
    """As many digits as the error bar leaves, e.g. 0.0643 ± 0.0002; the bar is rounded up."""
    if bar == 0:
        return number(value)
    place = math.floor(math.log10(bar))
    shift = math.floor(math.log10(abs(value))) if value else 0
    size = 10.0 ** (shift if abs(shift) > 2 else 0)
    decimals = max(0, (shift if abs(shift) > 2 else 0) - place)
    rounded = math.ceil(bar / 10.0 ** place - 1e-9) * 10.0 ** place
    text = f"{value / size:.{decimals}f} ± {rounded / size:.{decimals}f}".replace("-", "−")
    return f"({text})e{shift}" if size != 1 else text
