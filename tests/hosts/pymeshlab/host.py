# SPDX-License-Identifier: GPL-3.0-or-later
"""PyMeshLab with the plugin loaded, and what the tests share: meshes in, arrays out."""
import os
import re
import subprocess
import sys

import numpy
import pymeshlab
import pytest

SUPPORT = os.path.join(os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__)))), "support")
sys.path.insert(0, SUPPORT)

FILTER = "meshing_isotropic_ccdm"
SAMPLES = os.environ["CCDM_SAMPLES"]
SCRIPTS = os.environ["CCDM_SCRIPTS"]
PLUGINS = os.environ["CCDM_PLUGINS"]
VERSION = os.environ["CCDM_HOST_VERSION"]
PLUGIN = os.path.join(PLUGINS, VERSION, "libfilter_ccdm.so")
pymeshlab.load_plugin(PLUGIN)
# After a failure PyMeshLab's progress still goes to the log of that set, so it has to stay.
FAILED = []


def meshes(ms):
    return ms.mesh_number() if hasattr(ms, "mesh_number") else ms.number_meshes()


def load(name):
    ms = pymeshlab.MeshSet()
    ms.load_new_mesh(os.path.join(SAMPLES, name + ".ply"))
    return ms


def set_of(*mesh, **arrays):
    """A MeshSet of one mesh from arrays."""
    ms = pymeshlab.MeshSet()
    ms.add_mesh(pymeshlab.Mesh(*mesh, **arrays))
    return ms


def content(ms):
    m = ms.current_mesh()
    return m.vertex_matrix(), m.face_matrix()


def custom(m, name, of="vertex", kind="scalar"):
    return getattr(m, f"{of}_custom_{kind}_attribute_{'array' if kind == 'scalar' else 'matrix'}")(name)


def add_points(ms, name, x, y, z, of="vertex"):
    """A custom attribute of points by expressions; PyMeshLab 2022.2 overruns its memory when it takes an array."""
    ms.apply_filter(f"compute_new_custom_point_attribute_per_{of}", name=name, x_expr=x, y_expr=y, z_expr=z)


def everything(m):
    """All arrays that a mesh has, by name."""
    found = {"points": m.vertex_matrix(), "faces": m.face_matrix(), "vertex normals": m.vertex_normal_matrix(),
             "face normals": m.face_normal_matrix(), "vertex selection": m.vertex_selection_array(),
             "face selection": m.face_selection_array()}
    for name in ("vertex_scalar_array", "vertex_color_matrix", "face_scalar_array", "face_color_matrix",
                 "vertex_tex_coord_matrix", "wedge_tex_coord_matrix"):
        try:
            found[name] = getattr(m, name)()
        except Exception:  # pylint: disable=broad-except # of several kinds, the host's
            pass  # the mesh has none
    return found


def same(a, b):
    return a.shape == b.shape and a.tobytes() == b.tobytes()


def refused(ms, pattern, **parameters):
    """The filter raises with the reason, the MeshSet stays as it was and works on."""
    FAILED.append(ms)
    before, count, current = everything(ms.current_mesh()), meshes(ms), ms.current_mesh_id()
    with pytest.raises(pymeshlab.PyMeshLabException) as caught:
        ms.apply_filter(FILTER, **parameters)
    assert re.search(pattern, str(caught.value)), caught.value
    assert meshes(ms) == count and ms.current_mesh_id() == current
    after = everything(ms.current_mesh())
    assert before.keys() == after.keys() and all(same(before[k], after[k]) for k in before)


def log_of(program):
    """The filter's lines in the log of a program that fills `ms`, a verbose MeshSet, and runs it."""
    code = f"""
import sys
sys.path.insert(0, {os.path.dirname(os.path.abspath(__file__))!r})
from host import *
ms = pymeshlab.MeshSet(verbose=True)
{program}
"""
    run = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, timeout=120, check=False)
    assert run.returncode == 0, run.stdout + run.stderr
    return re.findall(r"^LOG: \d CCDM: (.*)$", run.stdout + run.stderr, re.M)


def unit(vectors):
    return vectors / numpy.linalg.norm(vectors, axis=-1, keepdims=True)


def cross_2d(a, b):
    return a[..., 0] * b[..., 1] - a[..., 1] * b[..., 0]


def uv_areas(uv):
    """Signed areas of the triangles in texture space; `uv` has three corners for each."""
    return cross_2d(uv[:, 1] - uv[:, 0], uv[:, 2] - uv[:, 0]) / 2
