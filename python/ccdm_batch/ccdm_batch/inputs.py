# SPDX-License-Identifier: GPL-3.0-or-later
"""Which meshes there are, and what their outputs are called."""

import glob
import os
from dataclasses import dataclass
from pathlib import Path
from typing import Dict, Iterator, List, Optional, Sequence, Tuple

FORMATS = ("ply", "off", "obj", "stl")


class InputError(Exception):
    """The inputs or the output folder cannot be used; the text is a sentence."""


@dataclass(frozen=True)
class Job:
    """One mesh; `reason` says why it cannot even be tried."""

    source: Path
    target: Path
    name: str  # the output, relative to the output folder, with forward slashes
    reason: Optional[str] = None


def find_jobs(inputs: Sequence[str], output: Path, file_format: Optional[str] = None) -> List[Job]:
    """All meshes of folders, list files, globs and single files, ordered by name, each once.

    The output has the input's place relative to the folder, to the list's folder, or to the glob's fixed
    part; a file from elsewhere goes to the top of the output folder. Raises InputError.
    """
    output = output.absolute()
    found: Dict[Path, str] = {}
    for text in inputs:
        before = len(found)
        count = 0
        for source, base in _expand(text, output):
            count += 1
            found.setdefault(source, _relative(source, base))
        if count == 0 and len(found) == before:
            raise InputError(f"there is no mesh ({', '.join(FORMATS)}) in '{text}'")
    jobs: List[Job] = []
    taken: Dict[str, Path] = {}
    for source, relative in sorted(found.items(), key=lambda item: (item[1], str(item[0]))):
        name = relative if file_format is None else os.path.splitext(relative)[0] + "." + file_format
        target = output / name
        reason = None
        # Case folded: some file systems take A.ply and a.ply for one file.
        first = taken.setdefault(name.casefold(), source)
        if first != source:
            reason = f"its output '{name}' is already that of '{first}'"
        elif target == source or target in found:
            raise InputError(f"the output '{target}' is one of the inputs; choose another output folder")
        jobs.append(Job(source, target, Path(name).as_posix(), reason))
    return jobs


def _relative(source: Path, base: Path) -> str:
    try:
        return str(source.relative_to(base))
    except ValueError:
        return source.name


def _normal(path: str) -> Path:
    return Path(os.path.abspath(path))


def _is_mesh_name(name: str) -> bool:
    return not name.startswith(".") and os.path.splitext(name)[1].lower().lstrip(".") in FORMATS


def _expand(text: str, output: Path) -> Iterator[Tuple[Path, Path]]:
    """Pairs of a mesh and the folder that its name is relative to."""
    if os.path.isdir(text):
        base = _normal(text)
        for folder, folders, files in os.walk(base):
            # An output folder inside the input folder holds no inputs.
            folders[:] = sorted(f for f in folders if not f.startswith(".") and Path(folder, f) != output)
            yield from ((Path(folder, f), base) for f in sorted(files) if _is_mesh_name(f))
    elif os.path.lexists(text):
        path = _normal(text)
        if _is_mesh_name(path.name):
            yield path, path.parent
        else:
            yield from _read_list(path)
    elif glob.has_magic(text):
        base = _fixed_part(text)
        for match in sorted(glob.glob(text, recursive=True)):
            if not os.path.isdir(match):
                yield _normal(match), base
    else:
        raise InputError(f"there is no '{text}'")


def _fixed_part(pattern: str) -> Path:
    parts = []
    for part in Path(pattern).parts[:-1]:
        if glob.has_magic(part):
            break
        parts.append(part)
    return _normal(os.path.join(*parts)) if parts else _normal(".")


def _read_list(path: Path) -> Iterator[Tuple[Path, Path]]:
    """A text file with a path a line, relative to its own folder; empty lines and # comments are skipped."""
    try:
        lines = path.read_text(encoding="utf-8").splitlines()
    except OSError as error:
        raise InputError(f"the list '{path}' cannot be read: {error.strerror}") from error
    except UnicodeDecodeError as error:
        raise InputError(f"'{path}' is neither a mesh ({', '.join(FORMATS)}) nor a text file") from error
    for line in lines:
        line = line.strip()
        if line and not line.startswith("#"):
            yield _normal(os.path.join(path.parent, line)), path.parent
