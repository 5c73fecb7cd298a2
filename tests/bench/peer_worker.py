#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""One run of a peer that comes as a Python package, in a process of its own.

    peer_worker.py PEER INPUT.ply OUTPUT.ply SIZE ANGLE [KEY=NUMBER ...]

SIZE is an edge length or a number of vertices, as the peer takes it; ANGLE the feature angle in degrees.
Starts with the imports; OUTPUT.ply.start then holds the processor seconds that starting Python and
importing the package took, so that they need not be charged to the peer.
"""
import os
import sys
import time

import numpy as np

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "..", "sample_meshes"))
from meshfile import read_ply, write_ply


def explicit():
    """MeshLab's isotropic explicit remeshing; all but the three parameters at its defaults."""
    import pymeshlab

    def run(source, target, size, angle, iterations):
        meshes = pymeshlab.MeshSet()
        meshes.load_new_mesh(source)
        meshes.meshing_isotropic_explicit_remeshing(iterations=int(iterations), featuredeg=angle,
                                                    targetlen=pymeshlab.PureValue(size))
        meshes.save_current_mesh(target, save_vertex_quality=False, save_vertex_color=False)
    return run


def gmsh():
    """Patches parametrised and meshed anew, by the default frontal-Delaunay algorithm."""
    import gmsh as api

    def load(points, faces):
        tag = api.model.addDiscreteEntity(2)
        api.model.mesh.addNodes(2, tag, range(1, len(points) + 1), points.ravel())
        api.model.mesh.addElementsByType(tag, 2, [], (faces + 1).ravel())

    def run(source, target, size, angle):
        points, faces = read_ply(source)
        used, faces = np.unique(faces, return_inverse=True)
        api.initialize(readConfigFiles=False)
        api.option.setNumber("General.Terminal", 0)
        load(points[used], faces.reshape(-1, 3))
        api.model.mesh.classifySurfaces(np.radians(angle), True, True)
        api.model.mesh.createGeometry()
        api.model.geo.synchronize()
        api.option.setNumber("Mesh.MeshSizeExtendFromBoundary", 0)
        api.option.setNumber("Mesh.MeshSizeMin", size)
        api.option.setNumber("Mesh.MeshSizeMax", size)
        api.model.mesh.generate(2)
        tags, coordinates, _ = api.model.mesh.getNodes()
        _, corners = api.model.mesh.getElementsByType(2)
        index = np.zeros(int(tags.max()) + 1, int)
        index[tags.astype(int)] = np.arange(len(tags))
        write_ply(target, coordinates.reshape(-1, 3), index[corners.astype(int)].reshape(-1, 3))
        api.finalize()
    return run


def acvd():
    """Clusters of the vertices of the input, which is split until it has `subsampling` times as many.

    By default the clusters' centres are then moved onto the input, which takes most of the time.
    """
    import pyacvd
    import pyvista

    def run(source, target, size, _, subsampling, moved):
        clustering = pyacvd.Clustering(pyvista.read(source).clean())
        while clustering.mesh.n_points < subsampling * size:
            clustering.subdivide(1)
        clustering.cluster(int(round(size)))
        result = clustering.create_mesh(moveclus=bool(moved))
        write_ply(target, result.points, result.faces.reshape(-1, 4)[:, 1:])
    return run


def botsch():
    """Split, collapse, flip and smooth, after Botsch and Kobbelt, with its own detection of creases."""
    import gpytoolbox

    def run(source, target, size, angle, iterations):
        points, faces = read_ply(source)
        used, faces = np.unique(faces, return_inverse=True)
        u, g = gpytoolbox.remesh_botsch(points[used], faces.reshape(-1, 3).astype(np.int32), int(iterations), size,
                                        project=True, detect_feature_edges=True, feature_dihedral_threshold=angle)
        write_ply(target, u, g)
    return run


def instant():
    """Instant Meshes: an orientation and a position field, triangles extracted from them."""
    import pynanoinstantmeshes

    def run(source, target, size, angle, smoothing):
        points, faces = read_ply(source)
        u, g = pynanoinstantmeshes.remesh(points.astype(np.float32), faces.astype(np.uint32), int(round(size)), rosy=6,
                                          posy=3, creaseAngle=angle, align_to_boundaries=True,
                                          smooth_iter=int(smoothing), deterministic=True)
        write_ply(target, u, g)
    return run


def main():
    name, source, target, size, angle = sys.argv[1:6]
    options = {key: float(value) for key, value in (pair.split("=") for pair in sys.argv[6:])}
    peers = {f.__name__: f for f in (explicit, gmsh, acvd, botsch, instant)}
    run = peers[name]()
    with open(target + ".start", "w", encoding="ascii") as out:
        out.write(str(time.process_time()))
    run(source, target, float(size), float(angle), **options)
    return 0


if __name__ == "__main__":
    sys.exit(main())
