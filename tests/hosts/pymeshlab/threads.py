# SPDX-License-Identifier: GPL-3.0-or-later
"""threads.py PLUGIN MESH: 60 short runs on four threads, a few more that fail on purpose; all results must be equal."""
import sys
import threading

import numpy
import pymeshlab

FILTER = "meshing_isotropic_ccdm"


def run():
    ms = pymeshlab.MeshSet()
    ms.load_new_mesh(sys.argv[2])
    ms.apply_filter(FILTER, vertex_count=200, global_iterations=2)
    m = ms.current_mesh()
    return m.vertex_matrix(), m.face_matrix()


def work(k, reference, results):
    for turn in range(15):
        if k == 0 and turn % 5 == 0:
            ms = pymeshlab.MeshSet()
            ms.load_new_mesh(sys.argv[2])
            try:
                ms.apply_filter(FILTER, vertex_count=1)
            except pymeshlab.PyMeshLabException as error:
                assert "vertex_count must lie between" in str(error)
        results.append(all(numpy.array_equal(a, b) for a, b in zip(reference, run())))


def main():
    pymeshlab.load_plugin(sys.argv[1])
    reference, results = run(), []
    threads = [threading.Thread(target=work, args=(k, reference, results)) for k in range(4)]
    for t in threads:
        t.start()
    for t in threads:
        t.join()
    print(len(results), "equal" if all(results) else "different")


main()
