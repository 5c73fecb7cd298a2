# SPDX-License-Identifier: GPL-3.0-or-later
import os
import sys

import pytest

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
import desktop as desktop_module  # noqa: E402

LACKING = desktop_module.missing()


class Skipped(pytest.Module):
    """A file of tests that is not even read."""

    def collect(self):
        pytest.skip("to be installed first: " + ", ".join(LACKING), allow_module_level=True)


def pytest_pycollect_makemodule(module_path, parent):
    return Skipped.from_parent(parent, path=module_path) if LACKING else None


@pytest.hookimpl(hookwrapper=True)
def pytest_runtest_makereport(item, call):
    outcome = yield
    if call.when == "call":
        item.failed = outcome.get_result().failed


@pytest.fixture(scope="session")
def pictures_folder(tmp_path_factory):
    """Where screenshots are left for people to look at."""
    folder = os.environ.get("CCDM_WINDOW_PICTURES") or str(tmp_path_factory.mktemp("pictures"))
    os.makedirs(folder, exist_ok=True)
    return folder


@pytest.fixture(scope="session")
def desktop():
    with desktop_module.Desktop() as d:
        import accessible  # connects to the bus of the environment
        accessible.start()
        yield d


@pytest.fixture
def meshlab(desktop, request, pictures_folder):
    """Starts a MeshLab with the plugin and the given meshes open."""
    from meshlab_window import MeshLab
    running = []

    def start(*meshes):
        running.append(MeshLab(desktop, os.path.join(os.environ["CCDM_HOST"], "bin", "meshlab"), *meshes))
        return running[-1]

    yield start
    try:
        if getattr(request.node, "failed", False):
            desktop.screenshot(os.path.join(pictures_folder, f"failed_{request.node.originalname}.png"))
            for m in running[-1:]:
                print("\n".join(m.log()))
    finally:
        for m in running:
            m.close()


@pytest.fixture(scope="session")
def samples():
    return os.environ["CCDM_SAMPLES"]
