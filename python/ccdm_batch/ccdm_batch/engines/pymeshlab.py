# SPDX-License-Identifier: GPL-3.0-or-later
"""The engine that runs the filter in PyMeshLab, with the plugin loaded."""

import keyword
import os
from pathlib import Path
from typing import Any, Callable, Collection, Dict, Optional, Tuple

from ccdm_batch.failure import Failure
from ccdm_batch.parameters import DENSITIES, Parameters

FILTER = "meshing_isotropic_ccdm"

# Outputs of the filter, by their place in a report of the command line.
_PLACES: Dict[str, Tuple[str, ...]] = {
    "vertex_number": ("result", "vertices"),
    "face_number": ("result", "faces"),
    "extra_vertices": ("result", "extra_vertices"),
    "average_smallest_angle": ("result", "angle_min_avg"),
    "smallest_angle": ("result", "angle_min"),
    "percent_angles_below_30": ("result", "pct_lt30"),
    "average_aspect_ratio": ("result", "q_fb99_avg"),
    "smallest_aspect_ratio": ("result", "q_fb99_min"),
    "percent_valence_6": ("result", "pct_valence6"),
    "mean_edge_length": ("result", "mean_edge_length"),
    "hausdorff": ("result", "hausdorff"),
    "rms": ("result", "rms"),
    "euler_characteristic_before": ("input", "euler"),
    "euler_characteristic_after": ("result", "euler"),
    "boundary_loops": ("result", "boundary_loops"),
    "components": ("result", "components"),
    "topology_preserved": ("topology_preserved",),
    "target_met": ("target", "met"),
    "feature_curves": ("features", "curves"),
    "feature_corners": ("features", "corners"),
    "iterations_accepted": ("accepted",),
}


class PyMeshLabEngine:
    """Applies the filter `meshing_isotropic_ccdm` of the plugin file."""

    name = "pymeshlab"

    def __init__(self, plugin: Optional[str], threads: int):
        self.plugin = plugin
        self.threads = threads  # by OMP_NUM_THREADS, which the worker sets

    def check(self, further: Collection[str]) -> str:
        pymeshlab, mesh_set = self._load()
        # The host lists the parameters only when there is a mesh.
        triangle = ([[0.0, 0, 0], [1, 0, 0], [0, 1, 0]], [[0, 1, 2]])
        mesh_set.add_mesh(pymeshlab.Mesh(*triangle))
        known = mesh_set.filter_parameter_values(FILTER)
        unknown = sorted(name for name in further if _host_name(name) not in known)
        if unknown:
            raise Failure("usage", f"the filter {FILTER} has no parameter '{unknown[0]}'")
        from importlib import metadata

        return metadata.version("pymeshlab")

    def remesh(self, source: Path, target: Path, parameters: Parameters, limit: float) -> Dict[str, Any]:
        _, mesh_set = self._load()
        _call("unreadable", mesh_set.load_new_mesh, str(source))
        mesh = mesh_set.current_mesh()
        if mesh.face_number() == 0:
            raise Failure("refused", "it has no faces")
        before = {"vertices": mesh.vertex_number(), "faces": mesh.face_number()}
        values = self._values(parameters, before["vertices"], mesh_set.filter_parameter_values(FILTER))
        outputs = _call("refused", mesh_set.apply_filter, FILTER, **values)
        mesh = mesh_set.current_mesh()
        _call("output", mesh_set.save_current_mesh, str(target))
        if not target.exists():
            raise Failure("output", f"PyMeshLab wrote no {target.suffix.lstrip('.').upper()} file")
        report: Dict[str, Any] = {
            "input": before,
            "result": {"vertices": mesh.vertex_number(), "faces": mesh.face_number()},
            "parameters": {**values, "vertices": values["vertex_count"]},
        }
        outputs = dict(outputs or {})
        # PyMeshLab hands on no text, so the filter returns how many warnings its log has.
        warnings = int(outputs.pop("warnings", 0))
        report["warnings"] = [f"{warnings} in the filter's log"] if warnings else []
        _sort_in(report, outputs)
        return report

    def _load(self) -> Tuple[Any, Any]:
        try:
            import pymeshlab
        except ImportError as error:
            raise Failure("engine", f"PyMeshLab cannot be imported: {error}") from error
        if self.plugin is None or not os.path.isfile(self.plugin):
            raise Failure("engine", f"there is no plugin file '{self.plugin}'")
        _call("engine", pymeshlab.load_plugin, self.plugin)
        mesh_set = pymeshlab.MeshSet(False)
        if FILTER not in pymeshlab.filter_list():
            raise Failure("engine", f"the plugin '{self.plugin}' has no filter {FILTER}")
        return pymeshlab, mesh_set

    def _values(self, parameters: Parameters, vertices: int, defaults: Dict[str, Any]) -> Dict[str, Any]:
        given = {
            "feature_angle": parameters.feature_angle,
            "density": None if parameters.density is None else DENSITIES.index(parameters.density),
            "seed": parameters.seed,
            **parameters.further,
        }
        values = {"vertex_count": parameters.vertex_count(vertices), "new_layer": False}
        for name, value in given.items():
            if value is not None:
                values[_host_name(name)] = _as(defaults.get(_host_name(name)), value, name)
        return values


def _host_name(name: str) -> str:
    """PyMeshLab's name of a parameter: `lambda` is a word of Python's."""
    return name + "_" if keyword.iskeyword(name) else name


def _as(default: Any, value: Any, name: str) -> Any:
    """The value in the type that PyMeshLab takes for this parameter."""
    if isinstance(value, str):
        if isinstance(default, bool):
            raise Failure("usage", f"{name} must be true or false, not '{value}'")
        if isinstance(default, float):
            raise Failure("usage", f"{name} must be a number, not '{value}'")
        return value.capitalize()  # a choice, by its name in the dialog
    if isinstance(default, bool):
        return bool(value)
    if isinstance(default, float):
        return float(value)
    return value


def _call(kind: str, function: Callable[..., Any], *arguments: Any, **named: Any) -> Any:
    """Calls the host; its exceptions become Failures with the message that matters."""
    try:
        return function(*arguments, **named)
    except Exception as error:  # the host raises several kinds, which share no base of its own
        if type(error).__name__.startswith("Invalid"):
            kind = "usage"  # InvalidEnumException and the like
        text = str(error)
        for mark in ("Error details: ", "Details: "):
            text = text.rpartition(mark)[2]
        raise Failure(kind, " ".join(text.split())) from error


def _sort_in(report: Dict[str, Any], outputs: Dict[str, Any]) -> None:
    """Numbers that the filter returned to where the command line's report has them; others to `outputs`."""
    for name, value in outputs.items():
        place = _PLACES.get(name, ("outputs", name))
        part = report
        for key in place[:-1]:
            part = part.setdefault(key, {})
        part[place[-1]] = value
