# SPDX-License-Identifier: GPL-3.0-or-later
"""The remeshers that bench_peers.py compares: how each is installed, asked its version and run.

A peer takes either an edge length or a number of vertices; `slope` is how the logarithm of its vertex count
follows that of this size: -2 for a length, 1 for a number.
"""
import glob
import os
import re
import subprocess
import sys

from common import OUT, PROGRAM, ROOT, usage_of

sys.path.insert(0, os.path.join(ROOT, "sample_meshes"))
import numpy as np
from meshfile import read_ply, write_ply

HERE = os.path.dirname(os.path.abspath(__file__))
INSTALL_LIMIT = 600  # seconds


class Environment:
    """A virtual environment of the benchmark's own, for the packages of the peers."""

    def __init__(self, folder):
        self.folder = folder
        self.python = os.path.join(folder, "bin", "python")

    def install(self, package, *options):
        """Nothing when it is there already. A RuntimeError says why it cannot be had."""
        if not os.path.exists(self.python):
            usage_of(["/usr/bin/python3", "-m", "venv", self.folder], INSTALL_LIMIT)
        if not self.version(package):
            usage_of([self.python, "-m", "pip", "install", "-q", "--disable-pip-version-check", "--only-binary",
                      ":all:", *options, package], INSTALL_LIMIT)

    def version(self, package):
        code = "import importlib.metadata, sys; print(importlib.metadata.version(sys.argv[1]))"
        done = subprocess.run([self.python, "-c", code, package], capture_output=True, text=True, check=False)
        return done.stdout.strip()

    def file(self, path):
        found = glob.glob(os.path.join(self.folder, "lib", "python3*", "site-packages", path))
        if not found:
            raise RuntimeError(f"the package has no {path}")
        return found[0]


class Peer:
    """One row of the tables. `family` joins those that take the same size, so that one's helps the next."""

    slope = -2
    ours = False

    def __init__(self, name, family, settings):
        self.name, self.family, self.settings = name, family, settings
        self.version = ""
        self.reason = ""  # why it cannot be run

    def described(self):
        return {"name": self.name, "version": self.version, "settings": self.settings, "reason": self.reason,
                "takes": "edge length" if self.slope < 0 else "vertices", "ours": self.ours}

    def install(self):
        """Makes the peer ready and sets its version, or raises a RuntimeError with the reason."""

    def prepare(self, source, folder):
        """The file to hand to the peer; conversions are not timed."""
        return source

    def command(self, source, target, size, angle):
        raise NotImplementedError

    def finish(self, target):
        """The mesh file to measure."""
        return target


class Ours(Peer):
    """The project's command line on one thread."""

    slope = 1
    ours = True

    def __init__(self, name, options=()):
        settings = " ".join(("--threads 1",) + tuple(options))
        super().__init__(name, "ccdm", settings)
        self.options = tuple(options)

    def install(self):
        text = subprocess.run([PROGRAM, "--help"], capture_output=True, text=True, check=True).stdout
        for option in self.options:
            if option.startswith("--") and option not in text:
                raise RuntimeError(f"this build has no {option}")
        version = subprocess.run([PROGRAM, "--version"], capture_output=True, text=True, check=True)
        self.version = version.stdout.split()[-1]

    def command(self, source, target, size, angle):
        return [PROGRAM, source, target, "--vertices", str(round(size)), "--feature-angle", str(angle),
                "--threads", "1", "--quiet", *self.options]


class Packaged(Peer):
    """A Python package, driven by a function of peer_worker.py in a process of its own."""

    def __init__(self, name, environment, package, function, settings, slope=-2, **options):
        super().__init__(name, function, settings)
        self.environment, self.package, self.slope, self.options = environment, package, slope, options

    def install(self):
        self.environment.install("numpy")
        self.environment.install(self.package)
        self.version = self.package + " " + self.environment.version(self.package)

    def command(self, source, target, size, angle):
        return [self.environment.python, os.path.join(HERE, "peer_worker.py"), self.family, source, target, repr(size),
                str(angle), *(f"{key}={value}" for key, value in self.options.items())]


class Cgal(Peer):
    """Debian's CGAL behind a small driver, cgal_remesh.cpp."""

    program = os.path.join(OUT, "cgal_remesh")

    def __init__(self, iterations):
        super().__init__(f"CGAL, {iterations} iterations", "cgal", "isotropic_remeshing, sharp edges constrained")
        self.iterations = iterations

    def install(self):
        header = "/usr/include/CGAL/version.h"
        if not os.path.exists(header):
            raise RuntimeError("libcgal-dev is not installed")
        self.version = "CGAL " + re.search(r"define CGAL_VERSION (\S+)", open(header, encoding="utf-8").read())[1]
        source = os.path.join(HERE, "cgal_remesh.cpp")
        if not os.path.exists(self.program) or os.path.getmtime(self.program) < os.path.getmtime(source):
            os.makedirs(OUT, exist_ok=True)
            usage_of(["g++", "-std=c++17", "-O3", "-DNDEBUG", source, "-o", self.program, "-lgmp", "-lmpfr"],
                     INSTALL_LIMIT)

    def command(self, source, target, size, angle):
        return [self.program, source, target, repr(size), str(self.iterations), str(angle)]


class Mmgs(Peer):
    """The program of the Mmg platform for surfaces; it reads and writes Medit's text format."""

    def __init__(self, environment):
        super().__init__("mmgs", "mmgs", "-hsiz, -ar, -hausd 0.01 of the diagonal")
        self.environment = environment
        self.diagonal = 1

    def install(self):
        self.environment.install("numpy")
        # What the package needs beside its programs is of no use here.
        self.environment.install("mmgpy", "--no-deps")
        self.program = self.environment.file("mmgpy/bin/mmgs_O3")
        said = subprocess.run([self.program, "-h"], capture_output=True, text=True, check=False).stdout
        self.version = "Mmg " + re.search(r"Release ([\d.]+)", said)[1]

    def prepare(self, source, folder):
        points, faces = read_ply(source)
        used, faces = np.unique(faces, return_inverse=True)
        points = points[used]
        self.diagonal = float(np.linalg.norm(np.ptp(points, axis=0)))
        path = os.path.join(folder, "mmgs_input.mesh")
        write_medit(path, points, faces.reshape(-1, 3))
        return path

    def command(self, source, target, size, angle):
        return [self.program, "-v", "0", "-hsiz", repr(size), "-ar", str(angle), "-hausd", repr(0.01 * self.diagonal),
                "-in", source, "-out", os.path.splitext(target)[0] + ".mesh"]

    def finish(self, target):
        write_ply(target, *read_medit(os.path.splitext(target)[0] + ".mesh"))
        return target


def write_medit(path, points, faces):
    with open(path, "w", encoding="ascii") as out:
        out.write(f"MeshVersionFormatted 2\nDimension 3\nVertices\n{len(points)}\n")
        out.writelines("%.17g %.17g %.17g 0\n" % tuple(p) for p in points)
        out.write(f"Triangles\n{len(faces)}\n")
        out.writelines("%d %d %d 0\n" % tuple(f) for f in faces + 1)
        out.write("End\n")


def read_medit(path):
    """Points and triangles; the other blocks are passed over."""
    blocks, name = {}, None
    for line in open(path, encoding="ascii"):
        words = line.split()
        if words and words[0][0].isalpha():
            name = words[0]
            blocks[name] = []
        elif words and name in ("Vertices", "Triangles"):
            blocks[name].append(words[:3])
    points, faces = (blocks[name][1:] for name in ("Vertices", "Triangles"))
    return np.array(points, float), np.array(faces, int) - 1


def all_peers():
    environment = Environment(os.path.join(OUT, "venv"))

    def packaged(name, package, function, settings, **options):
        return Packaged(name, environment, package, function, settings, **options)

    explicit, botsch, acvd = "isotropic explicit remeshing", "remesh_botsch, detected creases", "input subdivided to"
    instant = "rosy 6, posy 3, aligned to boundaries"
    return [
        Ours("CCDM, default"),
        Ours("CCDM, approximation 1", ("--approximation", "1")),
        Ours("CCDM, paper's method", ("--optimizer", "annealing", "--sampler", "random")),
        packaged("MeshLab explicit, 10 iterations", "pymeshlab", "explicit", explicit, iterations=10),
        packaged("MeshLab explicit, 20 iterations", "pymeshlab", "explicit", explicit, iterations=20),
        Cgal(10),
        Cgal(20),
        Mmgs(environment),
        packaged("Gmsh", "gmsh", "gmsh", "classifySurfaces, createGeometry, frontal-Delaunay"),
        packaged("Instant Meshes", "PyNanoInstantMeshes", "instant", instant, slope=1, smoothing=2),
        packaged("Instant Meshes, not smoothed", "PyNanoInstantMeshes", "instant", instant, slope=1, smoothing=0),
        packaged("gpytoolbox Botsch, 10 iterations", "gpytoolbox", "botsch", botsch, iterations=10),
        packaged("gpytoolbox Botsch, 20 iterations", "gpytoolbox", "botsch", botsch, iterations=20),
        packaged("pyacvd 10", "pyacvd", "acvd", f"{acvd} 10 vertices a cluster", slope=1, subsampling=10, moved=1),
        packaged("pyacvd 10, not moved", "pyacvd", "acvd", f"{acvd} 10 vertices a cluster, centres not moved onto it",
                 slope=1, subsampling=10, moved=0),
        packaged("pyacvd 50, not moved", "pyacvd", "acvd", f"{acvd} 50 vertices a cluster, centres not moved onto it",
                 slope=1, subsampling=50, moved=0),
    ]
