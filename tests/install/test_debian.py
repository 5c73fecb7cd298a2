# SPDX-License-Identifier: GPL-3.0-or-later
"""The Debian packages: what is in them, and the plugin's in the system's own MeshLab."""
import os
import shutil

import plyfile
import pytest
from conftest import ROOT, VERSION, call

PLUGIN = "meshlab-filter-ccdm"
SAMPLE = ROOT / "sample_meshes" / "cad_part.ply"


def field(package, name):
    return call("dpkg-deb", "--field", package, name).strip()


def contents(package):
    """{path: mode and owner} of what is not a folder."""
    rows = [line.split(None, 5) for line in call("dpkg-deb", "--contents", package).splitlines()]
    return {row[5]: (row[0], row[1]) for row in rows if not row[0].startswith("d")}


def is_installed(package):
    return "ok installed" in call("dpkg-query", "-W", "-f", "${Status}", package, expect=None)


def test_plugin_package(packages, multiarch, has_plugin):
    package = packages[PLUGIN]
    assert package.name == f"{PLUGIN}_{VERSION}_{call('dpkg', '--print-architecture').strip()}.deb"
    assert contents(package) == {
        f"./usr/lib/{multiarch}/meshlab/plugins/libfilter_ccdm.so": ("-rw-r--r--", "root/root"),
        f"./usr/share/doc/{PLUGIN}/copyright": ("-rw-r--r--", "root/root")}
    depends = field(package, "Depends")
    assert "meshlab (>= 2020.09), meshlab (<< 2020.10~)" in depends and "qt" not in depends


def test_command_line_package(packages):
    package = packages["ccdm-remesh"]
    assert contents(package) == {"./usr/bin/ccdm_remesh": ("-rwxr-xr-x", "root/root"),
                                 "./usr/share/doc/ccdm-remesh/copyright": ("-rw-r--r--", "root/root")}
    assert "libc6 (>=" in field(package, "Depends") and "meshlab" not in field(package, "Depends")


def test_fields_of_both(packages):
    for name, package in packages.items():
        assert field(package, "Package") == name
        assert field(package, "Version") == VERSION
        assert field(package, "Section") == "graphics"
        assert field(package, "Maintainer").startswith("CCDM for MeshLab <")
        first, *more = field(package, "Description").splitlines()
        assert len(first) < 80 and more
        unpack = 'dpkg-deb --fsys-tarfile "$0" | tar -xO --wildcards "*/copyright"'
        assert "GPL-3.0-or-later" in call("sh", "-c", unpack, package)


def apt(*arguments, **options):
    return call("apt-get", "-y", "-qq", "-o", "DPkg::Lock::Timeout=60", *arguments,
                env={**os.environ, "DEBIAN_FRONTEND": "noninteractive"}, **options)


def test_apt_installs_into_the_systems_meshlab(packages, multiarch, has_plugin, tmp_path):
    plugin = f"/usr/lib/{multiarch}/meshlab/plugins/libfilter_ccdm.so"
    if os.geteuid() != 0 or shutil.which("xvfb-run") is None:
        pytest.skip("needs root and xvfb-run")
    if is_installed(PLUGIN) or os.path.exists(plugin):
        pytest.skip("a plugin is installed already, and is not ours to remove")
    plan = call("apt-get", "--simulate", "install", packages[PLUGIN], expect=None)
    if [line.split()[1] for line in plan.splitlines() if line.startswith(("Inst ", "Remv "))] != [PLUGIN]:
        pytest.skip("apt would install or remove more than this package:\n" + plan[-500:])
    out = tmp_path / "out.ply"
    try:
        apt("install", packages[PLUGIN])
        assert plugin in call("dpkg", "-L", PLUGIN)
        call("xvfb-run", "-a", "/usr/bin/meshlabserver", "-i", SAMPLE,
             "-s", ROOT / "filter_ccdm" / "scripts" / "ccdm_uniform.mlx", "-o", out)
    finally:
        apt("purge", PLUGIN, expect=None)
    assert plyfile.count_ply(out)[0] == 5000
    assert not is_installed(PLUGIN) and not os.path.exists(plugin), "nothing is left behind"
    assert is_installed("meshlab")
