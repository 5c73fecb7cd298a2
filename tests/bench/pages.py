# SPDX-License-Identifier: GPL-3.0-or-later
"""What the written pages share: paragraphs, Markdown tables, pictures."""
import os
import textwrap

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
from matplotlib.ticker import FuncFormatter, LogLocator

from common import HERE, put_between

README = os.path.join(HERE, "README.md")
PICTURES = os.path.join(HERE, "pictures")


def paragraph(text):
    """Lines of at most 110 characters."""
    return textwrap.wrap(text, 110, break_long_words=False, break_on_hyphens=False)


def stamp(data, effect):
    """Which command made the figures, when and on what; `effect`: what it writes."""
    machine = data["machine"]
    return paragraph(f"`{data['command']}`, {data['date']}, {machine['cpu']}, {machine['cores']} cores, "
                     f"{machine['system']}, engine {data['engine']}. That command writes {effect}, with figures of "
                     "that run only.")


def table(head, rows, texts=()):
    """A Markdown table; numbers to the right, the columns that are named in `texts` to the left."""
    lines = ["| " + " | ".join(head) + " |", "|" + "|".join("---" if h in texts else "--:" for h in head) + "|"]
    return lines + ["| " + " | ".join(row) + " |" for row in rows]


def groups(rows, *keys):
    """The rows by the values of some of their keys, in order of appearance."""
    found = {}
    for row in rows:
        found.setdefault(tuple(row[key] for key in keys), []).append(row)
    return found


def write_page(path, lines):
    with open(path, "w", encoding="utf-8") as out:
        out.write("\n".join(lines) + "\n")


def write_section(name, lines):
    """Puts the lines between the marks of that name in README.md."""
    put_between(README, f"<!-- {name}: written by its script -->", f"<!-- {name}: end -->", lines)


def plain_ticks(axis):
    """Ticks at 1, 2 and 5 of each decade of a logarithmic axis, written out."""
    axis.set_major_locator(LogLocator(subs=(1, 2, 5)))
    axis.set_major_formatter(FuncFormatter(lambda x, _: f"{x:,g}" if x < 1000 else f"{x:,.0f}"))
    axis.set_minor_formatter(FuncFormatter(lambda x, _: ""))


def save(figure, name, folder=PICTURES):
    os.makedirs(folder, exist_ok=True)
    figure.tight_layout()
    figure.savefig(os.path.join(folder, name), dpi=90)
    plt.close(figure)
