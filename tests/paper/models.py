# SPDX-License-Identifier: GPL-3.0-or-later
"""Which model stands for which of the paper's, with how many vertices, and from where it is seen."""
import os
import sys
from collections import namedtuple

HERE = os.path.dirname(os.path.abspath(__file__))
sys.path.insert(0, os.path.join(os.path.dirname(HERE), "bench"))
from common import MESHES, model

REAL = os.path.isdir(MESHES)
# `paper`: the name there; `table`: where its figures are; `name`: what stands for it; `why`: how far it does.
Case = namedtuple("Case", "paper table name vertices why")
# Elevation and azimuth in degrees, the axis that points up, and where a close-up looks.
View = namedtuple("View", "angles up centre", defaults=("z", (0.5, 0.5)))

REAL_CASES = (
    Case("Joint", 1, "joint", 6000, "the same size and kind"),
    Case("Venus", 1, "julius_noisy", 20000, "a noisy scan with a boundary"),
    Case("Venus", 1, "igea", 20000, "a clean scan of the same size"),
    Case("Pig", 1, "pig", 10000, "coarser, several boundaries"),
    Case("Klein Bottle", 1, "klein_bottle", 5000, "coarser, crosses itself"),
    Case("Moai", 1, "moai", 10000, "the same subject; the paper's vertex counts are not known"),
    Case("Lion", 2, "lion_vase", 30000, "a detailed statue, a third of the size"),
    Case("Twist", 2, "twist", 5000, "the same size and kind"),
    Case("Foot", 2, "foot", 6000, "nearly the same size, the same subject"),
    Case("Gargoyle", 2, "gargoyle", 18000, "the same subject, two thirds of the size"),
    Case("Dog", 2, "koala", 10000, "an animal, a third of the size"),
)
SAMPLE_CASES = (
    Case("Joint", 1, "cad_part", 6000, "creases and needle triangles"),
    Case("Venus", 1, "bust", 20000, "a noisy scan with a boundary"),
    Case("Pig", 1, "plate", 10000, "several boundaries"),
    Case("Klein Bottle", 1, "klein_bottle", 5000, "crosses itself"),
    Case("Moai", 1, "bumpy", 10000, "closed and organic, another subject"),
    Case("Lion", 2, "high_genus", 30000, "another subject"),
    Case("Twist", 2, "twisted_bar", 5000, "closed creases"),
    Case("Foot", 2, "bumpy", 6000, "closed and organic, another subject"),
    Case("Gargoyle", 2, "two_components", 18000, "another subject"),
    Case("Dog", 2, "sphere", 10000, "closed and smooth, another subject"),
)
PLANK = Case("Plank", 0, "max_planck", 10000, "decimated, slivers and folded faces") if REAL else Case(
    "Plank", 0, "bust", 10000, "a noisy bust")
VIEWS = {"joint": View((25, -60)), "julius_noisy": View((5, -80), "y"), "pig": View((25, -60), "y"),
         "klein_bottle": View((25, -60)), "moai": View((10, 30), "y"), "lion_vase": View((10, 30), "y"),
         "twist": View((40, -60), "z", (0.3, 0.75)), "foot": View((25, -60)), "gargoyle": View((15, 45), "y"),
         "koala": View((20, 30), "y"), "max_planck": View((5, 150), "y"), "plate": View((50, -60))}
USUAL_VIEW = View((25, -60))


def cases(quick):
    """Those of the tables; `quick`: with a tenth of the vertices."""
    return [smaller(case) if quick else case for case in (REAL_CASES if REAL else SAMPLE_CASES)]


def smaller(case):
    return case._replace(vertices=case.vertices // 10)


def plank(quick):
    """What figures 3 and 4 are about."""
    return smaller(PLANK) if quick else PLANK


def source(case):
    return model(case.name)


def view(case):
    return VIEWS.get(case.name, USUAL_VIEW)
