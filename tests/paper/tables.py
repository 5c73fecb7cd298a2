# SPDX-License-Identifier: GPL-3.0-or-later
"""Tables 1 and 2 of the paper: the printed rows, and those measured on the models at hand."""
import csv
import os

from models import HERE
from bench_peers import Settings, bench_model, install
from peers import Ours, all_peers

PRINTED = os.path.join(HERE, "printed.csv")
PAPERS_METHOD = ("--optimizer", "annealing", "--sampler", "random")
METHOD, ADAPTIVE, DEFAULT = "CCDM, paper's method", "CCDM, paper's method, curvature", "CCDM, default"
# One setting of each; the first two are of the kind of [BK04], pyacvd is of that of [VCP08].
OTHERS = ("MeshLab explicit, 20 iterations", "CGAL, 20 iterations", "mmgs", "Gmsh", "pyacvd 50, not moved")
FIGURES = ("seconds", "angle_min_avg", "angle_min", "pct_lt30", "q_fb99_avg", "q_fb99_min", "error")
FIELDS = ("table", "model", "stand_in", "before", "after", "method", "source", *FIGURES, "topology", "count_met")
HEAD = ("model", "vertices", "method", "seconds", "∠ avg", "∠ min", "< 30° %", "aspect avg", "aspect min",
        "error 1e-3", "topology")
TEXTS = ("model", "vertices", "method", "topology")


def remeshers(quick, words):
    """The project's modes and the others; `words`: only those of the others whose name has one of them."""
    peers = {p.name: p for p in all_peers()}
    # The paper remeshes Pig adaptively.
    picked = [peers[METHOD], Ours(ADAPTIVE, (*PAPERS_METHOD, "--density", "curvature")), peers[DEFAULT]]
    wanted = OTHERS if words is None else [n for n in peers if any(w.lower() in n.lower() for w in words)]
    return picked + [peers[n] for n in wanted if not quick and not peers[n].ours]


def result_file(folder, case, method):
    """Where a result is kept."""
    return os.path.join(folder, "meshes", file_name(case.paper, case.name, method))


def file_name(paper, name, method):
    """Of a result: one model may stand for two of the paper's, and two for one."""
    return "".join(c if c.isalnum() else "_" for c in f"{paper} {name} {method}".lower()) + ".ply"


def measure_tables(cases, folder, options):
    """Rows of bench_peers.py with the paper's name of the model, and what the remeshers were."""
    settings = Settings(repeats=1, time_limit=options.time_limit, distance_samples=20000 if options.quick else 1000000)
    picked = remeshers(options.quick, options.peers)
    install(picked)
    rows = []
    for case in cases:
        wanted = [p for p in picked if p.name != ADAPTIVE or case.paper == "Pig"]
        for row in bench_model(case.name, case.vertices, wanted, settings,
                               lambda peer, case=case: result_file(folder, case, peer.name)):
            rows.append({"paper": case.paper, "table": case.table, **row})
    return {"feature_angle": settings.feature_angle, "time_limit": settings.time_limit,
            "distance_samples": settings.distance_samples, "peers": [p.described() for p in picked], "rows": rows}


def printed():
    """The paper's rows."""
    with open(PRINTED, encoding="utf-8", newline="") as text:
        rows = list(csv.DictReader(line for line in text if not line.startswith("#")))
    for row in rows:
        row.update({key: float(row[key]) for key in FIGURES}, table=int(row["table"]), source="printed",
                   stand_in="", topology="")
        row.update({key: int(row[key]) if row[key] else None for key in ("before", "after")})
    return rows


def measured(row, before):
    """A row of bench_peers.py with the paper's figures."""
    return {"table": row["table"], "model": row["paper"], "stand_in": row["model"], "before": before,
            "after": row["vertices"], "method": row["peer"], "source": "measured", "seconds": row["cpu"],
            "error": 1e3 * row["hausdorff"], "topology": "kept" if row["topology_kept"] else "changed",
            "count_met": row["count_met"],
            **{key: row[key] for key in FIGURES[1:-1]}}


def records(data, number, before):
    """All rows of one table: for each of the paper's models the printed ones, then the measured ones; `before`: the
    vertices of the models at hand."""
    theirs = [r for r in data["printed"] if r["table"] == number]
    found = []
    for name in dict.fromkeys(r["model"] for r in theirs):
        found += [r for r in theirs if r["model"] == name]
        found += [measured(r, before[r["model"]]) for r in data["rows"]
                  if r["table"] == number and r["paper"] == name and not r["reason"]]
    return found


def cells(record):
    """A row of the page."""
    ours = record["source"] == "measured"
    count = [f"{n:,}" if n is not None else "?" for n in (record["before"], record["after"])]
    method = record["method"] if ours else "*" + record["method"].replace("*", "\\*") + ", printed*"
    off = " (off)" if ours and not record["count_met"] else ""
    return [f"{record['model']}: {record['stand_in']}" if ours else record["model"], " – ".join(count) + off,
            method, f"{record['seconds']:.2f}", f"{record['angle_min_avg']:.2f}",
            f"{record['angle_min']:.2f}", f"{record['pct_lt30']:.2e}" if record["pct_lt30"] else "0",
            f"{record['q_fb99_avg']:.3f}", f"{record['q_fb99_min']:.3f}", f"{record['error']:.2f}",
            record["topology"]]


def write_csv(path, rows):
    with open(path, "w", encoding="utf-8", newline="") as out:
        writer = csv.DictWriter(out, FIELDS)
        writer.writeheader()
        writer.writerows(rows)
