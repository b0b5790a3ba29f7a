"""What moved between the tables of a page as it stands and those that were measured."""
import re


def cells(line):
    return [cell.strip() for cell in line.strip().strip("|").split("|")]


def read_tables(text):
    """{(heading, number of the table below it): (header, rows)} of a page."""
    tables, heading, lines, count = {}, "", [], 0
    for line in [*text.splitlines(), ""]:
        if line.lstrip().startswith("|"):
            lines.append(line)
            continue
        if lines:
            count += 1
            tables[heading, count] = (cells(lines[0]), [cells(row) for row in lines[2:]])
            lines = []
        if re.match(r"#+ ", line):
            heading, count = line.lstrip("# "), 0
    return tables


def keyed(header, rows):
    """Rows by their first cell, and where that is not enough by their first two."""
    first = [row[0] for row in rows]
    width = 1 if len(set(first)) == len(first) else 2
    return {tuple(row[:width]): dict(zip(header[width:], row[width:])) for row in rows}


def compare(before, measured, same_finest=True):
    """Sentences on what moved. `before` is the text of a page; `measured` maps the keys of `read_tables` to (header,
    rows, Tolerance). Without `same_finest` what follows from the finest mesh is left out, and so are rows of meshes
    that were not measured."""
    known = read_tables(before)
    for key, (header, rows, tolerance) in measured.items():
        place = f"{key[0]}, table {key[1]}"
        if key not in known:
            yield f"{place}: is not in the page"
            continue
        if tolerance.finest == ("all",) and not same_finest:
            continue
        old, new = keyed(*known[key]), keyed(header, [[str(cell) for cell in row] for row in rows])
        yield from missing(place, old, new, same_finest)
        for row in old.keys() & new.keys():
            if row[0] not in tolerance.finest or same_finest:
                yield from moved(f"{place}, {', '.join(row)}", row[0], old[row], new[row], tolerance)
    if same_finest:
        yield from (f"{heading}, table {n}: was not measured" for heading, n in known.keys() - measured.keys())


def missing(place, old, new, same_finest):
    for row in new.keys() - old.keys():
        yield f"{place}, {', '.join(row)}: is not in the page"
    for row in old.keys() - new.keys():
        if same_finest or not row[0].isdigit():
            yield f"{place}, {', '.join(row)}: was not measured"


def moved(place, row, old, new, tolerance):
    for column in [*old, *(new.keys() - old.keys())]:
        before, after = old.get(column), new.get(column)
        kind = tolerance.of(row, column)
        if before is None or after is None:
            yield f"{place}: column {column} is {'new' if before is None else 'gone'}"
        elif not kind.holds(before, after):
            yield f"{place}, {column}: was {before or 'empty'}, is {after or 'empty'}; allowed: {kind.words}"
