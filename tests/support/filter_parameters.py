# SPDX-License-Identifier: GPL-3.0-or-later
"""The filter's parameters: as the plugin's source declares them, and as the pages list them."""
import os
import re

ROOT = os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
SOURCES = os.path.join(ROOT, "filter_ccdm")


def page_rows():
    """The cells of the page's table: dialog, script, Python, type, range, default, advanced."""
    page = open(os.path.join(SOURCES, "PARAMETERS.md"), encoding="utf-8").read()
    rows = [[cell.strip() for cell in line.strip("|\n").split("|")]
            for line in page.splitlines() if line.startswith("| ")]
    head = next(i for i, row in enumerate(rows) if row[0] == "dialog")
    return [row for row in rows[head + 1:] if len(row) == 7]


def readme_names():
    """The names in scripts that the README's table of parameters has."""
    page = open(os.path.join(ROOT, "README.md"), encoding="utf-8").read()
    table = page[page.index("| command line | script and dialog |"):].split("\n\n")[0]
    names = (re.match(r"`(\w+)`", line.split("|")[2].strip()) for line in table.splitlines())
    return [name[1] for name in names if name]


def declared():
    """(type, name, label, advanced) of each parameter in the plugin's source, in order."""
    source = open(os.path.join(SOURCES, "parameters.cpp"), encoding="utf-8").read()
    found = []
    for call in source.split("list.addParam(")[1:]:
        call = call.split("return list;")[0]
        kind, name = re.match(r"\s*(Rich\w+)\(\s*\"(\w+)\"", call).groups()
        label = re.findall(r"\"([^\"]*)\"", call[:call.index("Tip(")])[-1]
        found.append((kind, name, label, "CCDM_ADVANCED" in call))
    return found
