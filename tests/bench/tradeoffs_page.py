# SPDX-License-Identifier: GPL-3.0-or-later
"""ANGLES.md and APPROXIMATION.md with their pictures, from what bench_tradeoffs.py measured in one run."""
import os

import pages
from common import HERE
from pages import groups, paragraph, plt, save

HEAD = ["model", "vertices", "{}", "CPU s", "average smallest angle", "smallest angle", "below", "Hausdorff", "RMS"]
UNITS = """CPU: processor seconds of the whole process on one thread, the quicker of two runs. Angles in degrees, Hausdorff and RMS in 1e-3 of the
bounding box's diagonal, by the project's `mesh_quality.h`; *below*: triangles under the target angle, by the report's
certificate. Feature angle 40 degrees; everything else at its default."""
ANGLES = """The optimiser raises the average; at its end, `--min-angle` degrees are a target for the smallest angle, and
the report is the certificate: the smallest angle that was reached, and for each triangle under the target why."""
APPROXIMATION = """Neither the energy nor the angles see the distance to the input. `--approximation` weighs it: up to
0.5 by moves and flips on the surface, above that vertices leave the surface along their normals as well, 1 all the way
to the least squares of the distance."""


def figures(row):
    return [f"{row['cpu']:.2f}", f"{row['angle_min_avg']:.2f}", f"{row['angle_min']:.1f}", str(row["below"]),
            f"{1e3 * row['hausdorff']:.2f}", f"{1e3 * row['rms']:.3f}"]


def table(rows, option):
    lines = [[row["model"], f"{row['n']:,}", f"{row[option]:g}", *figures(row)] for row in rows]
    return pages.table([h.format(option) for h in HEAD], lines, texts=("model",))


def by_model(rows):
    return {model: part for (model,), part in groups(rows, "model").items()}


def at(rows, option, value):
    return next(row for row in rows if row[option] == value)


def reasons(rows):
    """How many triangles for each reason, the most frequent first."""
    total = {}
    for row in rows:
        for reason, count in row["reasons"].items():
            total[reason.replace("_", " ")] = total.get(reason.replace("_", " "), 0) + count
    return ", ".join(f"{name} {count}" for name, count in sorted(total.items(), key=lambda x: -x[1]) if count)


def answer_on_angles(rows):
    models = by_model(rows)
    forty = [at(r, "min-angle", 40) for r in models.values()]
    met = [row["model"] for row in forty if row["below"] == 0]
    short = [row for row in forty if row["below"]]
    cost = max(at(r, "min-angle", 0)["angle_min_avg"] - at(r, "min-angle", 40)["angle_min_avg"] for r in models.values())
    text = (f"The default of 40 degrees is met by every triangle on {len(met)} of {len(models)} models"
            f"{' (' + ', '.join(met) + ')' if met else ''}, and lowers the average smallest angle by at most {cost:.2f} "
            "degrees against no target. ")
    if short:
        text += (f"Where it is not, {sum(r['below'] for r in short)} of {sum(r['faces'] for r in short):,} triangles stay "
                 f"under it, because of: {reasons(short)}. ")
    more = [name for name, r in models.items() if at(r, "min-angle", 42)["below"] == 0]
    return text + f"A target of 42 degrees is met on {len(more)}" + (f" ({', '.join(more)})." if more else ".")


def answer_on_approximation(rows):
    parts = []
    for value in (0.25, 0.5, 1):
        pairs = [(at(r, "approximation", 0), at(r, "approximation", value)) for r in by_model(rows).values()]
        gain = [100 * (1 - some["rms"] / none["rms"]) for none, some in pairs]
        lost = [none["angle_min_avg"] - some["angle_min_avg"] for none, some in pairs]
        parts.append(f"{value:g}: {min(gain):.0f} to {max(gain):.0f} % less RMS for {min(lost):.2f} to {max(lost):.2f} degrees")
    return "Against no weight, of the average smallest angle: " + "; ".join(parts) + "."


def draw(rows, option, keys, name):
    """Each model's figures over the option."""
    figure, panels = plt.subplots(1, len(keys), figsize=(4.3 * len(keys), 3.6))
    for axes, (key, label, scale) in zip(panels, keys):
        for model, r in by_model(rows).items():
            axes.plot([row[option] for row in r], [scale * row[key] for row in r], "o-", markersize=3, label=model)
        axes.set_xlabel("--" + option)
        axes.set_ylabel(label)
        axes.grid(alpha=0.3)
    panels[-1].legend(fontsize=7, loc="center left", bbox_to_anchor=(1, 0.5))
    save(figure, name)


def page(title, question, answer, data, option, picture):
    lines = [f"# {title}", "", *pages.stamp(data, "this page"), "", *paragraph(question), "", *paragraph(answer), ""]
    return lines + [f"![{title}](pictures/{picture})", "", *paragraph(UNITS), "", *table(data[option], option)]


def write(data):
    angles, close = data["min-angle"], data["approximation"]
    draw(angles, "min-angle", (("angle_min", "smallest angle, degrees", 1),
                               ("angle_min_avg", "average smallest angle, degrees", 1)), "min_angle.png")
    draw(close, "approximation", (("rms", "RMS, 1e-3 of the diagonal", 1e3),
                                  ("angle_min_avg", "average smallest angle, degrees", 1)), "approximation.png")
    pages.write_page(os.path.join(HERE, "ANGLES.md"),
                     page("A certified smallest angle", ANGLES, answer_on_angles(angles), data, "min-angle",
                          "min_angle.png"))
    pages.write_page(os.path.join(HERE, "APPROXIMATION.md"),
                     page("Closeness against angles", APPROXIMATION, answer_on_approximation(close), data,
                          "approximation", "approximation.png"))
