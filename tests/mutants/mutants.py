#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Plants one fault at a time in the engine and counts those that the tests notice: mutants.py BUILD VCGLIB [NAME...].

A fault is a piece of a header that occurs once, what it is replaced by, and the test files that ought to notice; if
those do not, all others are asked. BUILD is a folder for the spoilt copies."""
import concurrent.futures
import os
import resource
import shutil
import subprocess
import sys

ROOT = os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
ENGINE = "vcg_ext/vcg/complex/algorithms"

# name: (header, what stands there, the fault, test files)
FAULTS = {
    "flip that repeats an edge": (
        "ccdm/delaunay.h", " &&\n           r.mesh.FindEdge(h.apexA, h.apexB) == NoSide;", ";", ["delaunay"]),
    "flip of a feature": (
        "ccdm/delaunay.h", "r.mesh.Mate(s) != NoSide && !r.mesh.Constrained(s) && h.KeepsShape()",
        "r.mesh.Mate(s) != NoSide && h.KeepsShape()", ["delaunay"]),
    "wrong sign of the Delaunay excess": (
        "ccdm/delaunay.h", "const double sine = sinA * cosB + cosA * sinB;",
        "const double sine = sinA * cosB - cosA * sinB;", ["delaunay"]),
    "collapse without the link condition": (
        "ccdm/triangulation.h", "if (common != (boundaryEdge ? 1 : 2) ||", "if (common < 0 ||", ["triangulation"]),
    "collapse that joins two boundaries": (
        "ccdm/triangulation.h", " || (vBoundary && wBoundary && !boundaryEdge))", ")", ["triangulation"]),
    "relocation that turns a triangle over": (
        "ccdm/relocation.h", "all = along > 1e-4 * scale && along", "all = along", ["relocation"]),
    "circumcentres weighted by the wrong edges": (
        "ccdm/centroid_rules.h", "w * (m * uu * (ww - uw) / (2 * m2))", "w * (m * ww * (ww - uw) / (2 * m2))",
        ["centroid_rules"]),
    "cell centroid without the density": (
        "ccdm/centroid_rules.h", "rw = 0.5 * (r + remesh.rho[star.id[k + 1]]);", "rw = r;", ["centroid_rules"]),
    "momentum with the wrong sign": (
        "ccdm/centroid_rules.h", "(x - last[v]) * Momentum", "(last[v] - x) * Momentum", ["centroid_rules"]),
    "corner that is none": (
        "ccdm/feature_graph.h", "_isCorner[v] = Degree(v) != 0 && Degree(v) != 2;",
        "_isCorner[v] = Degree(v) != 0 && Degree(v) > 2;", ["feature_graph"]),
    "one sample less on each curve": (
        "ccdm/sampling.h", "for (int i = c.closed ? 0 : 1; i < segments; ++i)",
        "for (int i = c.closed ? 0 : 1; i + 1 < segments; ++i)", ["sampling"]),
    "edges of three faces accepted": (
        "ccdm/input_mesh.h", "count += end - k > 2;", "count += end - k > 3;", ["input_mesh"]),
    "larger part of the faces turned": (
        "ccdm/input_mesh.h", "if (2 * against > queue.size())", "if (2 * against < queue.size())", ["input_repair"]),
    "three sheets sewn together": (
        "ccdm/input_repair.h", "if (last - first != 2 || first->a == first->b ||",
        "if (last - first < 2 || first->a == first->b ||", ["input_repair"]),
    "several fans pass the proof": (
        "ccdm/verification.h", "if (p.star.Triangles() != corners)", "if (p.star.Triangles() > corners)",
        ["triangulation"]),
    "repeated edges pass the proof": (
        "ccdm/verification.h", "if (std::adjacent_find(outer.begin(), outer.end()) != outer.end())",
        "if (std::adjacent_find(outer.begin(), outer.end()) == outer.begin())", ["triangulation"]),
    "folds pass the check": (
        "ccdm/result_check.h", "unfounded += !BendsNear(model, f.middle, f.reach);", "unfounded += 0;",
        ["polish", "refinement"]),
    "boundary left out of the edge length": (
        "ccdm/edge_length.h", "return inner + euler + boundary / 2;", "return inner + euler;", ["edge_length"]),
    "gradation that raises the wrong end": (
        "ccdm/density.h", "if (most < spacing[o])", "if (most > spacing[o])", ["density"]),
    "exception of a thread lost": (
        "ccdm/parallel.h", "if (!_error)\n                _error", "if (_error)\n                _error", ["parallel"]),
    "crossing at a shared vertex not seen": (
        "mesh_quality/self_intersections.h", "case 1:\n            return ", "case 1:\n            return false && ",
        ["self_intersections"]),
    "worse state kept by annealing": (
        "ccdm/optimizer.h", "if (energy < bestEnergy) {", "if (energy > bestEnergy) {", ["ccdm_remeshing"]),
}


def spoil(folder, name):
    header, right, wrong, _ = FAULTS[name]
    shutil.copytree(os.path.join(ROOT, "vcg_ext"), os.path.join(folder, "vcg_ext"), dirs_exist_ok=True)
    path = os.path.join(folder, ENGINE, header)
    with open(path, encoding="utf-8") as file:
        text = file.read()
    if text.count(right) != 1:
        raise SystemExit(f"mutants.py: '{name}': the place in {header} occurs {text.count(right)} times")
    with open(path, "w", encoding="utf-8") as file:
        file.write(text.replace(right, wrong))


def limit_memory():
    """A fault may make a loop that never ends and takes ever more."""
    resource.setrlimit(resource.RLIMIT_AS, (4 << 30, 4 << 30))


def notices(folder, vcglib, tests):
    """What the tests compiled with the spoilt headers say: the first failure, or an empty string."""
    sources = [os.path.join(ROOT, "tests", t) for t in tests]
    joined = os.path.join(folder, "tests.cpp")
    with open(joined, "w", encoding="utf-8") as file:
        file.writelines(f'#include "{s}"\n' for s in sources)
    program = os.path.join(folder, "tests")
    command = ["g++", "-std=c++17", "-O1", "-ffp-contract=off", "-I", os.path.join(folder, "vcg_ext"), "-I",
               os.path.join(ROOT, "tests"), "-isystem", vcglib, "-isystem", "/usr/include/eigen3", joined, "-o", program,
               "-lgtest", "-lgtest_main", "-pthread"]
    built = subprocess.run(command, capture_output=True, text=True, check=False)
    if built.returncode != 0:
        raise SystemExit(f"mutants.py: a fault does not compile:\n{built.stderr[:2000]}")
    try:
        run = subprocess.run([program, "--gtest_fail_fast"], capture_output=True, text=True, timeout=900, check=False,
                             preexec_fn=limit_memory)
    except subprocess.TimeoutExpired:
        return "it does not end"
    if run.returncode == 0:
        return ""
    failed = [line for line in run.stdout.splitlines() if line.startswith("[  FAILED  ] ")]
    return failed[0].split()[3] if failed else f"ended with status {run.returncode}"


def judge(build, vcglib, name):
    folder = os.path.join(build, name.replace(" ", "_"))
    spoil(folder, name)
    likely = [f"unit/{t}_test.cpp" for t in FAULTS[name][3]]
    found = notices(folder, vcglib, likely)
    if not found:
        others = sorted(f"{d}/{f}" for d in ("unit", "property") for f in os.listdir(os.path.join(ROOT, "tests", d)))
        found = notices(folder, vcglib, [t for t in others if t not in likely])
    shutil.rmtree(folder)
    print(f"  {name:45} {found or 'NOT NOTICED'}", flush=True)
    return bool(found)


def main():
    if len(sys.argv) < 3:
        raise SystemExit(__doc__)
    build, vcglib, *names = sys.argv[1:]
    os.makedirs(build, exist_ok=True)
    with concurrent.futures.ThreadPoolExecutor(2) as pool:
        noticed = list(pool.map(lambda name: judge(build, vcglib, name), names or FAULTS))
    print(f"{sum(noticed)} of {len(noticed)} planted faults are noticed")
    return 0 if all(noticed) else 1


if __name__ == "__main__":
    sys.exit(main())
