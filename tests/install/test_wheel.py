# SPDX-License-Identifier: GPL-3.0-or-later
"""The Python packages, and the plugin's in PyMeshLab."""
import os
import re
import sys
import zipfile

import pytest
from conftest import ROOT, VERSION, call

VERSIONS = ("2022.02", "2025.07")


@pytest.fixture(scope="module")
def wheels(build, tmp_path_factory):
    if not any((build / "plugins" / v / "libfilter_ccdm.so").exists() for v in VERSIONS):
        pytest.skip("the build has no plugin for PyMeshLab")
    folder = tmp_path_factory.mktemp("wheels")
    call(sys.executable, ROOT / "python" / "build_wheels.py", build / "plugins", folder)
    return {p.name.split("-")[0]: p for p in folder.glob("*.whl")}


@pytest.fixture(scope="module")
def site(wheels, tmp_path_factory):
    """What pip makes of the wheel, which is to unpack it."""
    folder = tmp_path_factory.mktemp("site")
    zipfile.ZipFile(wheels["ccdm_pymeshlab"]).extractall(folder)
    return folder


def run_python(python, code, *paths):
    return call(python, "-c", code, env={**os.environ, "PYTHONPATH": os.pathsep.join(map(str, paths))})


def test_names_and_contents(wheels, build):
    assert re.fullmatch(rf"ccdm_pymeshlab-{re.escape(VERSION)}-py3-none-linux_\w+\.whl", wheels["ccdm_pymeshlab"].name)
    assert wheels["ccdm_batch"].name == f"ccdm_batch-{VERSION}-py3-none-any.whl"
    names = zipfile.ZipFile(wheels["ccdm_pymeshlab"]).namelist()
    built = [v for v in VERSIONS if (build / "plugins" / v / "libfilter_ccdm.so").exists()]
    assert [n for n in names if n.endswith(".so")] == [f"ccdm_pymeshlab/plugins/{v}/libfilter_ccdm.so" for v in built]
    assert any(n.endswith("dist-info/LICENSE") for n in names)


def test_load_registers_the_filter(build, site):
    python = build / "venv-2025.07" / "bin" / "python"
    if not python.exists():
        pytest.skip("PyMeshLab is not installed")
    code = f"""
import ccdm_pymeshlab, pymeshlab
early = pymeshlab.MeshSet()
for _ in range(2):
    ccdm_pymeshlab.load()
early.load_new_mesh({str(ROOT / "sample_meshes" / "sphere.ply")!r})
early.meshing_isotropic_ccdm(vertex_count=777, feature_angle=180)
print("vertices:", early.current_mesh().vertex_number())
"""
    assert "vertices: 777\n" in run_python(python, code, site)


def host_of_version(folder, version):
    """Something that calls itself PyMeshLab, as far as its version is asked."""
    info = folder / f"pymeshlab-{version}.dist-info"
    info.mkdir(parents=True)
    (info / "METADATA").write_text(f"Metadata-Version: 2.1\nName: pymeshlab\nVersion: {version}\n")
    return folder


ASK = """
import ccdm_pymeshlab
try:
    print(ccdm_pymeshlab.plugin_path().parent.name)
except ImportError as error:
    print(type(error).__name__, error)
"""


@pytest.mark.parametrize("version, folder", [("2025.7", "2025.07"), ("2025.7.post1", "2025.07"),
                                             ("2022.2.post4", "2022.02")])
def test_version_is_told_from_the_host(site, build, tmp_path, version, folder):
    if not (build / "plugins" / folder / "libfilter_ccdm.so").exists():
        pytest.skip(f"the build has no plugin for {folder}")
    assert run_python(sys.executable, ASK, site, host_of_version(tmp_path, version)) == folder + "\n"


@pytest.mark.parametrize("version", ["2023.12.post3", "2025.11", "unknown"])
def test_other_hosts_are_refused_by_name(site, tmp_path, version):
    said = run_python(sys.executable, ASK, site, host_of_version(tmp_path, version))
    assert said.startswith(f"UnsupportedHostError There is no CCDM plugin for PyMeshLab {version} ")


def test_no_host(site):
    said = call(sys.executable, "-S", "-c", ASK, env={**os.environ, "PYTHONPATH": str(site)})
    assert said == "UnsupportedHostError PyMeshLab is not installed.\n"
