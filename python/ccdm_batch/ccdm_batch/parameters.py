# SPDX-License-Identifier: GPL-3.0-or-later
"""What is asked of every mesh; values only."""

import re
from dataclasses import asdict, dataclass, field
from typing import Any, Dict, Iterable, Optional, Union

Value = Union[bool, int, float, str]
DENSITIES = ("uniform", "curvature", "quality")
LEAST_VERTICES = 4

# These have options of their own, or belong to the machinery.
_NOT_FURTHER = {
    "vertices": "use --vertices",
    "vertex_count": "use --vertices",
    "edge_length": "the target is a number of vertices here",
    "max_error": "the target is a number of vertices here",
    "feature_angle": "use --feature-angle",
    "density": "use --density",
    "seed": "use --seed",
    "threads": "use --threads",
    "new_layer": "the result is a file",
    "report": "it is in OUTPUT.json",
    "quiet": "",
    "help": "",
    "version": "",
}


@dataclass(frozen=True)
class Parameters:
    """Either `vertices` or `vertices_factor` is set; None elsewhere is the engine's own default."""

    vertices: Optional[int] = None
    vertices_factor: Optional[float] = None
    feature_angle: Optional[float] = None
    density: Optional[str] = None
    seed: Optional[int] = None
    further: Dict[str, Value] = field(default_factory=dict)

    def vertex_count(self, input_vertices: int) -> int:
        """The number of vertices asked of a mesh that has `input_vertices`."""
        if self.vertices is not None:
            return self.vertices
        return max(LEAST_VERTICES, round(input_vertices * (self.vertices_factor or 1.0)))

    def as_dict(self) -> Dict[str, Any]:
        """For JSON, and for comparison with a record."""
        return asdict(self)


def parse_further(items: Iterable[str]) -> Dict[str, Value]:
    """`key=value` items; raises ValueError with a sentence."""
    result: Dict[str, Value] = {}
    for item in items:
        key, equals, text = item.partition("=")
        key = key.strip().lower().replace("-", "_")
        if not equals or not re.fullmatch(r"[a-z][a-z0-9_]*", key) or not text.strip():
            raise ValueError(f"--set wants NAME=VALUE, not '{item}'")
        if key in _NOT_FURTHER:
            reason = _NOT_FURTHER[key]
            raise ValueError(f"'{key}' cannot be given by --set" + (f"; {reason}" if reason else ""))
        if key in result:
            raise ValueError(f"'{key}' is given twice")
        result[key] = _value(text.strip())
    return result


def _value(text: str) -> Value:
    if text.lower() in ("true", "false"):
        return text.lower() == "true"
    for kind in (int, float):
        try:
            return kind(text)
        except ValueError:
            pass
    return text
