#!/usr/bin/env python3
"""Every link between the documents leads to a file, and to a heading where it names one."""
import pathlib
import re
import sys

ROOT = pathlib.Path(__file__).resolve().parents[2]


def anchors(page):
    """Of headings, as GitHub forms them."""
    text = re.sub(r"^```.*?^```", "", page.read_text(), flags=re.M | re.S)
    headings = re.findall(r"^#+ (.*)$", text, re.M)
    return {re.sub(r"[^\w\- ]", "", heading.lower()).strip().replace(" ", "-") for heading in headings}


def complaints(page):
    text = re.sub(r"^```.*?^```", "", page.read_text(), flags=re.M | re.S)
    for link in re.findall(r"\]\(([^)\s]+)\)", text):
        path, _, anchor = link.partition("#")
        target = page.parent / path if path else page
        if "://" in link:
            continue
        if not target.exists():
            yield f"{page.relative_to(ROOT)}: {link}: there is no such file"
        elif anchor and anchor not in anchors(target):
            yield f"{page.relative_to(ROOT)}: {link}: there is no such heading"


folders = [ROOT / name for name in ("docs", "cases", "bench", "tests", "examples")]
pages = [*ROOT.glob("*.md"), *(page for folder in folders for page in folder.rglob("*.md"))]
assert len(pages) > 15, pages
wrong = [words for page in pages for words in complaints(page)]
print("\n".join(wrong), file=sys.stderr)
sys.exit(1 if wrong else 0)
