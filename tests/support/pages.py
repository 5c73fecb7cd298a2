# SPDX-License-Identifier: GPL-3.0-or-later
"""The code blocks and the tables of the project's pages."""
import re
from collections import namedtuple
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
README = ROOT / "README.md"
Block = namedtuple("Block", "language text line")


def blocks(page=README):
    """Everything between fences."""
    found, start, language = [], None, ""
    lines = page.read_text(encoding="utf-8").splitlines()
    for number, line in enumerate(lines, 1):
        if not line.lstrip().startswith("```"):
            continue
        if start is None:
            start, language = number, line.strip().strip("`")
        else:
            found.append(Block(language, "\n".join(lines[start:number - 1]) + "\n", start))
            start = None
    assert start is None, f"{page.name}: the block of line {start} has no end"
    return found


def first_line(block):
    """The first line that is no comment: what a block is called by."""
    return next(line for line in block.text.splitlines() if line and not line.startswith("#") or "#include" in line)


def section(title, page=README):
    """The text under a heading, without its blocks of code."""
    text = re.sub(r"^```.*?^```$", "", page.read_text(encoding="utf-8"), flags=re.M | re.S)
    parts = re.split(r"^(#+ .*)$", text, flags=re.M)
    return next(text for head, text in zip(parts[1::2], parts[2::2]) if head.lstrip("# ") == title)


def table(text):
    """The rows of the first table in a text, the head first."""
    lines = [line for line in text[text.index("\n|"):].strip().split("\n\n")[0].splitlines() if line.startswith("|")]
    return [[cell.strip() for cell in line.strip("|").split("|")] for line in lines[:1] + lines[2:]]
