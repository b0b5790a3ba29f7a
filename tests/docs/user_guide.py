#!/usr/bin/env python3
"""user_guide.py PROGRAM PAGE: does all that the user guide says in an empty folder, and looks at what came out."""
import pathlib
import sys

from pages import column, done, texts

program, page = pathlib.Path(sys.argv[1]).resolve(), pathlib.Path(sys.argv[2])

with done(program, page.read_text()) as folder:
    assert (folder / "both.html").stat().st_size > 1e5
    assert sorted(file.name for file in (folder / "block/figures").iterdir()) == ["displacement_y.pdf", "von_mises.pdf"]
    assert sorted(texts(folder / "study/sweep.csv", "member")) == [
        "bound=15_steps=10", "bound=15_steps=5", "bound=5_steps=10", "bound=5_steps=5"]
    # Twice the time, twice the load, and slip that has gone on.
    ends = [column(folder / name / "history.csv", "max_displacement")[-1] for name in ("block", "further")]
    assert 1.9 < ends[1] / ends[0] < 4, ends
    assert texts(folder / "study/sweep.csv", "status") == ["done"] * 4
    # Twice the bound, less slip; and the bound bounds.
    assert max(column(folder / "rough/history.csv", "slip")) < max(column(folder / "block/history.csv", "slip"))
    assert max(map(abs, column(folder / "python-run/contact.csv", "tangential_traction_y"))) <= 10 * (1 + 1e-14)
