# SPDX-License-Identifier: GPL-3.0-or-later
"""Calls that a platform may lack are in one file of each program, behind its #if."""
import re

from conftest import ROOT

# Headers of POSIX, Linux or Windows, and what tells platforms apart.
PLATFORM = re.compile(r"#\s*include\s*<(unistd|dlfcn|pthread|fcntl|poll|dirent|strings|windows|io|direct|sys/\w+)\.h>"
                      r"|\b(__unix__|__linux__|__APPLE__|_WIN32|_MSC_VER|Q_OS_\w+)\b"
                      r"|\b(isatty|fileno|dladdr|fork|mkstemp|popen|setenv|usleep|sigaction|realpath)\s*\(")
ALLOWED = {"filter_ccdm/host_process.cpp", "vcg_ext/apps/ccdm_remesh/platform.h"}


def test_platform_calls_are_where_they_belong():
    found = set()
    for top in ("filter_ccdm", "vcg_ext"):
        for path in (ROOT / top).rglob("*"):
            if path.suffix in (".h", ".cpp") and PLATFORM.search(path.read_text(encoding="utf-8")):
                found.add(str(path.relative_to(ROOT)))
    assert found == ALLOWED
