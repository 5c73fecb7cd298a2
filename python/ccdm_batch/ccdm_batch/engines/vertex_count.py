# SPDX-License-Identifier: GPL-3.0-or-later
"""How many vertices a mesh file has, without reading all of it where the format allows."""

import re
import struct
from pathlib import Path

from ccdm_batch.failure import Failure


def count_vertices(path: Path) -> int:
    """For PLY, OFF and OBJ the vertices in the file, for STL the distinct positions; raises Failure."""
    kind = path.suffix.lower().lstrip(".")
    counter = {"ply": _ply, "off": _off, "obj": _obj, "stl": _stl}.get(kind)
    if counter is None:
        raise Failure("unreadable", f"files of type '{kind}' are not known here")
    try:
        count = counter(path)
    except (ValueError, IndexError, struct.error):
        count = 0
    if count < 1:
        raise Failure(
            "unreadable", f"it has no vertices that can be counted, so it is no {kind.upper()} mesh"
        )
    return count


def _ply(path: Path) -> int:
    head = path.open("rb").read(65536).partition(b"end_header")[0]
    found = re.search(rb"^element\s+vertex\s+(\d+)\s*$", head, re.MULTILINE)
    return int(found.group(1)) if head.startswith(b"ply") and found else 0


def _off(path: Path) -> int:
    words = []
    with path.open(encoding="latin1") as lines:
        for line in lines:
            words += line.partition("#")[0].split()
            if len(words) > 3:
                break
    # The counts may stand on the line of the keyword.
    return int(words[1]) if words and words[0].upper().endswith("OFF") else 0


def _obj(path: Path) -> int:
    with path.open("rb") as lines:
        return sum(line.lstrip().startswith((b"v ", b"v\t")) for line in lines)


def _stl(path: Path) -> int:
    data = path.read_bytes()
    faces = struct.unpack_from("<I", data, 80)[0] if len(data) >= 84 else 0
    if len(data) >= 84 and len(data) == 84 + 50 * faces:
        corners = {data[k : k + 12] for f in range(84, len(data), 50) for k in (f + 12, f + 24, f + 36)}
        return len(corners)
    return (
        len(set(re.findall(rb"vertex\s+(\S+\s+\S+\s+\S+)", data)))
        if data.lstrip().startswith(b"solid")
        else 0
    )
