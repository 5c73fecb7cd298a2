# SPDX-License-Identifier: GPL-3.0-or-later
"""Pictures of MeshLab's window."""
import subprocess
import time

from accessible import Box, wait_until


def settle():
    """Lets the window paint what it has been told."""
    time.sleep(0.7)


def dialog_with_help(dialog, path, size=None):
    """The dialog with its explanations, `size` pixels large."""
    dialog.press("Help")
    dialog.body.find("label", dialog.help(dialog.labels()[0]))
    desktop = dialog.meshlab.desktop
    if size:
        # Titles are regular expressions to xdotool.
        window = desktop.output("xdotool", "search", "--name", "^" + dialog.window.name.split(" (")[0]).split()[-1]
        desktop.output("xdotool", "windowsize", "--sync", window, *map(str, size))
    settle()
    desktop.screenshot(path, dialog.window.box)
    dialog.press("Help")


def side_by_side(meshlab, path):
    """The first layer and the last one as wireframes over their faces, in two views beside each other."""
    last = len(meshlab.layers()) - 1
    meshlab.choose("Windows", "Split current view", "Vertically")
    views = wait_until(lambda: _views(meshlab), "two views")
    for view, shown, hidden in ((views[1], last, 0), (views[0], 0, last)):
        meshlab.click(view.x + 20, view.y + 20)
        settle()
        meshlab.choose("View", "Show Trackball")
        meshlab.choose("View", "Show Info Panel")
        meshlab.click(*meshlab.layer_rows()[hidden][0].centre)
        meshlab.click(*meshlab.layer_rows()[shown][2].centre)
        wait_until(lambda shown=shown: meshlab.layers()[shown][1], "current layer")
        meshlab.tool("Face")
        meshlab.tool("Wireframe")
        settle()
    # The mesh fills the width; above and below there is nothing to see.
    width = views[1].x + views[1].width - views[0].x
    height = min(views[0].height, int(1.1 * views[0].width))
    meshlab.desktop.screenshot(path, Box(views[0].x, views[0].y + (views[0].height - height) // 2, width, height))


def _views(meshlab):
    pane = meshlab.main.child("layered pane").child("frame").child("split pane")
    boxes = sorted(e.box for e in pane.children if e.role == "filler" and e.has("showing"))
    return boxes if len(boxes) == 2 else None


def progress(desktop, box):
    """How much of a progress bar has the colour that fills it, about 0 to 1; grey is empty."""
    # Above the number in the middle.
    out = subprocess.run(["import", "-window", "root", "-crop", f"{box.width}x1+{box.x}+{box.y + 4}", "-depth", "8",
                          "rgb:-"], env=desktop.environment, capture_output=True, timeout=30, check=True).stdout
    pixels = [out[i:i + 3] for i in range(0, len(out), 3)]
    return sum(max(p) - min(p) > 40 for p in pixels) / len(pixels)


def dark_share(path, left, right):
    """Share of nearly black pixels in a picture between two fractions of its width: the lines of a wireframe."""
    size = subprocess.run(["identify", "-format", "%w %h", path], capture_output=True, text=True, check=True).stdout
    width, height = map(int, size.split())
    crop = f"{int(width * (right - left))}x{height}+{int(width * left)}+0"
    out = subprocess.run(["convert", path, "-crop", crop, "-colorspace", "gray", "-threshold", "12%", "-format",
                          "%[fx:1-mean]", "info:"], capture_output=True, text=True, check=True).stdout
    return float(out)
