# SPDX-License-Identifier: GPL-3.0-or-later
"""The rest is in pyproject.toml. Here is only that the wheel holds machine code, but none of Python's."""
from setuptools import Distribution, setup
from wheel.bdist_wheel import bdist_wheel


class WithMachineCode(Distribution):
    """The plugin is data to setuptools, which would call the wheel fit for any platform."""

    def has_ext_modules(self):
        return True


class PluginWheel(bdist_wheel):
    """For the platform and every Python 3."""

    def get_tag(self):
        return "py3", "none", super().get_tag()[2]


setup(distclass=WithMachineCode, cmdclass={"bdist_wheel": PluginWheel})
