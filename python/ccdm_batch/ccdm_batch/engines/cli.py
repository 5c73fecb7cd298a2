# SPDX-License-Identifier: GPL-3.0-or-later
"""The engine that runs the command line, ccdm_remesh."""

import json
import re
import signal
import subprocess
from pathlib import Path
from typing import Any, Collection, Dict, List, Optional

from ccdm_batch.engines.vertex_count import count_vertices
from ccdm_batch.failure import Failure
from ccdm_batch.parameters import Parameters
from ccdm_batch.process import end_with_parent

# ccdm_remesh's exit statuses.
_KINDS = {2: "usage", 3: "unreadable", 4: "refused", 5: "output", 6: "check"}


class CommandLineEngine:
    """Starts the program `program` once a mesh."""

    name = "cli"

    def __init__(self, program: str, threads: int):
        self.program = program
        self.threads = threads

    def check(self, further: Collection[str]) -> str:
        version = self._ask("--version").split()
        known = set(re.findall(r"--([a-z][a-z-]*)", self._ask("--help"))) if further else set()
        unknown = sorted(name for name in further if _option(name)[2:] not in known)
        if unknown:
            raise Failure("usage", f"{self.program} has no parameter '{unknown[0]}'")
        return version[-1] if version else ""

    def remesh(self, source: Path, target: Path, parameters: Parameters, limit: float) -> Dict[str, Any]:
        report = target.with_name("engine_report.json")
        input_vertices = count_vertices(source) if parameters.vertices is None else 0
        arguments = [self.program, str(source), str(target), "--quiet", "--report", str(report)]
        arguments += self._options(parameters, input_vertices)
        try:
            run = subprocess.run(
                arguments,
                stdin=subprocess.DEVNULL,
                stdout=subprocess.DEVNULL,
                stderr=subprocess.PIPE,
                text=True,
                errors="replace",
                check=False,
                preexec_fn=lambda: end_with_parent(limit),
            )
        except OSError as error:
            raise Failure("engine", f"{self.program} cannot be started: {error.strerror}") from error
        content: Optional[Dict[str, Any]] = _read_report(report)
        if run.returncode != 0:
            status = run.returncode
            if status < 0:
                raise Failure("crash", f"{self.program} was ended by {signal.Signals(-status).name}", content)
            reason = _reason(run.stderr, source) or f"{self.program} ended with exit status {status}"
            raise Failure(_KINDS.get(status, "crash"), reason, content)
        if not target.exists() or content is None:
            raise Failure("engine", f"{self.program} ended well, but left no mesh and report")
        return content

    def _options(self, parameters: Parameters, input_vertices: int) -> List[str]:
        values: Dict[str, Any] = {
            "vertices": parameters.vertex_count(input_vertices),
            "feature_angle": parameters.feature_angle,
            "density": parameters.density,
            "seed": parameters.seed,
            **parameters.further,
            "threads": self.threads,
        }
        if str(values.get("optimizer")).lower() == "annealing":
            values.setdefault("sampler", "random")  # as in the filter
        return [
            text for key, value in values.items() if value is not None for text in (_option(key), str(value))
        ]

    def _ask(self, option: str) -> str:
        try:
            run = subprocess.run(
                [self.program, option], capture_output=True, text=True, check=False, timeout=30
            )
        except OSError as error:
            raise Failure("engine", f"'{self.program}' cannot be started: {error.strerror}") from error
        except subprocess.TimeoutExpired as error:
            raise Failure("engine", f"'{self.program} {option}' does not end") from error
        if run.returncode != 0:
            raise Failure("engine", f"'{self.program} {option}' ended with exit status {run.returncode}")
        return run.stdout


def _option(name: str) -> str:
    return "--" + name.replace("_", "-")


def _reason(errors: str, source: Path) -> str:
    """The program's message without its name and the name of the file, which is a copy."""
    for line in errors.splitlines():
        if line.strip():
            text = line.strip().partition("ccdm_remesh: ")[2] or line.strip()
            return text[len(f"{source}: ") :] if text.startswith(f"{source}: ") else text
    return ""


def _read_report(path: Path) -> Any:
    try:
        return json.loads(path.read_text(encoding="utf-8"))
    except (OSError, ValueError):
        return None
