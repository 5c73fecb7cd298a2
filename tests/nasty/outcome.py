# SPDX-License-Identifier: GPL-3.0-or-later
"""One nasty input through the command line, and what came out."""
import json
import os
import subprocess
import time

import numpy as np

import plyfile

DONE, REFUSED = 0, 4
SLOW = 60  # seconds; a run that takes longer hangs


class Outcome:
    def __init__(self, case, folder):
        folder = str(folder)
        self.input = os.path.join(folder, f"{case.name}.{case.form}")
        self.output = os.path.join(folder, "result.ply")
        self.report_file = os.path.join(folder, "report.json")
        self.points, self.faces = case.mesh()
        write(self.input, case.form, self.points, self.faces)
        start = time.monotonic()
        run = subprocess.run(command(case, self.input, self.output, self.report_file), capture_output=True, text=True,
                             timeout=SLOW, check=False)
        self.seconds = time.monotonic() - start
        self.status, self.said, self.error = run.returncode, run.stdout, run.stderr.strip()
        with open(self.report_file, encoding="utf-8") as file:
            self.report = json.load(file)
        if os.path.exists(self.output):
            result = plyfile.read_ply(self.output)
            self.result = np.array([(v["x"], v["y"], v["z"]) for v in result["vertex"]])
            self.triangles = [tuple(f["vertex_indices"]) for f in result["face"]]

    @property
    def reason(self):
        """Why it was refused, without the file's name."""
        return self.error.split(os.path.basename(self.input) + ": ")[-1]


def command(case, source, output, report):
    """Few rounds: what is looked for is not how good the triangles are."""
    return [os.environ["CCDM_REMESH"], source, output, "--vertices", str(case.vertices), "--global-iterations", "4",
            "--threads", "1", "--report", report, *map(str, case.args)]


def write(path, form, points, faces):
    points = points.tolist()
    if form == "ply":
        plyfile.write_ply(path, points, faces, double=True)
    else:
        {"off": plyfile.write_off, "obj": plyfile.write_obj, "stl": plyfile.write_stl}[form](path, points, faces)
