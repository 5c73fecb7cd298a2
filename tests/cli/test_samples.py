# SPDX-License-Identifier: GPL-3.0-or-later
"""The committed sample meshes are what the generator makes."""
import filecmp
import os
import subprocess


def test_generator_makes_the_committed_files(samples, tmp_path):
    generator = os.environ["CCDM_GENERATOR"]
    subprocess.run([generator, tmp_path], check=True)
    names = sorted(n for n in os.listdir(samples) if n.endswith(".ply"))
    assert names == sorted(os.listdir(tmp_path)) and len(names) >= 9
    for name in names:
        assert filecmp.cmp(os.path.join(samples, name), tmp_path / name, shallow=False), name


def test_generator_reports_failure(tmp_path):
    generator = os.environ["CCDM_GENERATOR"]
    assert subprocess.run([generator], check=False, capture_output=True).returncode == 2
    assert subprocess.run([generator, tmp_path / "none"], check=False, capture_output=True).returncode == 1
