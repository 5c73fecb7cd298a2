# SPDX-License-Identifier: GPL-3.0-or-later
"""threads.py PLUGIN MESH: 60 short runs on four threads, a few more that fail on purpose; all results must be equal.

The mesh is read once: the host's readers report their progress through one buffer that all threads share.
"""
import sys
import threading

import numpy
import pymeshlab

FILTER = "meshing_isotropic_ccdm"
PARAMETERS = {"vertex_count": 200, "global_iterations": 2}


def run(mesh, **parameters):
    ms = pymeshlab.MeshSet()
    ms.add_mesh(pymeshlab.Mesh(*mesh))
    ms.apply_filter(FILTER, **parameters)
    m = ms.current_mesh()
    return m.vertex_matrix(), m.face_matrix()


def work(k, mesh, reference, results):
    for turn in range(15):
        if k == 0 and turn % 5 == 0:
            try:
                run(mesh, vertex_count=1)
            except pymeshlab.PyMeshLabException as error:
                assert "vertex_count must lie between" in str(error)
        results.append(all(numpy.array_equal(a, b) for a, b in zip(reference, run(mesh, **PARAMETERS))))


def main():
    pymeshlab.load_plugin(sys.argv[1])
    ms = pymeshlab.MeshSet()
    ms.load_new_mesh(sys.argv[2])
    mesh = ms.current_mesh().vertex_matrix(), ms.current_mesh().face_matrix()
    reference, results = run(mesh, **PARAMETERS), []
    threads = [threading.Thread(target=work, args=(k, mesh, reference, results)) for k in range(4)]
    for t in threads:
        t.start()
    for t in threads:
        t.join()
    print(len(results), "equal" if all(results) else "different")


main()
