"""The program against the numbers of other programs in tests/reference."""
import page
import runs
from tolerance import Error, Same, Tolerance

REFERENCE = runs.ROOT / "tests" / "reference"
IDENTITIES = {"x", "y", "step", "time", "status"}


def differences(ours, theirs, sizes):
    """Largest difference of each column over its size, or else over the reference's largest value."""
    result = {}
    for column in theirs.names:
        if column not in IDENTITIES:
            a, b = ours.numbers(column), theirs.numbers(column)
            size = sizes.get(column) or max(map(abs, b)) or 1
            result[column] = max(abs(p - q) for p, q in zip(a, b, strict=True)) / size
    return result


def compare(run, nodes, contact):
    """Differences by column, and how many statuses are the same."""
    theirs, their_contact = runs.Table.read(nodes), runs.Table.read(contact)
    ours, our_contact = run.table("nodes"), run.table("contact")
    # Where every node sticks, slips are round-off: they are measured by the displacements.
    displacement = max(max(map(abs, theirs.numbers(c))) for c in ("u_x", "u_y"))
    sizes = {"slip_y": displacement, "slip_rate": displacement / their_contact.numbers("time")[0]}
    columns = differences(ours, theirs, {})
    for column, value in differences(our_contact, their_contact, sizes).items():
        columns[column] = max(value, columns.get(column, 0))
    same = sum(a == b for a, b in zip(our_contact.texts("status"), their_contact.texts("status"), strict=True))
    return columns, f"{same} of {len(their_contact.rows)}"


def first_references(program):
    for nodes in sorted(REFERENCE.glob("*-nodes.csv")):
        name = nodes.name.removesuffix("-nodes.csv")
        foundation, cells, *more = name.split("-")
        settings = {"mesh__box__cells": f"[{cells[1:]},{cells[1:]}]"}
        if more:
            settings["material__pyroelectric"] = "[0,-1e-4]"
        run = program.run(f"cases/ouafik-2020/{foundation}.toml", **settings)
        yield name, *compare(run, nodes, REFERENCE / f"{name}-contact.csv")


def third_program(program):
    for folder in sorted((REFERENCE / "third").iterdir()):
        run = program.run(folder.relative_to(runs.ROOT) / "case.toml")
        yield folder.name, *compare(run, folder / "nodes.csv", folder / "contact.csv")


def table(results, limit):
    """Digits of the references bound the differences from above."""
    results = list(results)
    columns = list(dict.fromkeys(column for _, found, _ in results for column in found))
    rows = [[name, *(page.error(found[c]) if c in found else "" for c in columns), same]
            for name, found, same in results]
    return ["case", *(c.replace("_", " ") for c in columns), "same status"], rows, Tolerance(
        Error(limit), {"same status": Same()})


def add_to(document, program):
    document.add("""## Agreement with other codes

Label: other code. Largest difference of each column over the reference's largest value, all nodes, in
contact columns also all steps; slips over the largest displacement (rates: by the time step).
`tests/reference/README.md` says what the other programs are; `same status` counts contact nodes and steps
that both call stick or both call slip.

The paper's example by two programs, which agree with each other to 3e-10 but for the temperature of the
insulated case (1e-10 K), where the stored numbers carry round-off:""",
                 table(first_references(program), 1e-8), "Variations by a third program:",
                 table(third_program(program), 1e-9))
