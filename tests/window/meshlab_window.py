# SPDX-License-Identifier: GPL-3.0-or-later
"""MeshLab 2020.09's window, found by names and worked as a user works it."""
import os
import re
import time

import accessible
from accessible import wait_until
from desktop import stop
from filter_dialog import FilterDialog

LAYER_COLUMNS = 4  # of the layer list: eye, number, name, ways to draw


class MeshLab:
    """A running MeshLab with the given meshes open. To be closed."""

    def __init__(self, desktop, program, *meshes):
        self.desktop = desktop
        self._log_path = os.path.join(desktop.folder, "meshlab.log")
        if os.path.exists(self._log_path):
            os.remove(self._log_path)
        self.process = desktop.spawn([program, *map(str, meshes)], "meshlab")
        try:
            self.application = wait_until(lambda: accessible.application(self.process.pid), "MeshLab", 60)
            self.main = self.window("frame", "MeshLab", 60)
            if meshes:
                self.wait_log("^All files opened", timeout=60)
        except BaseException:
            self.close()
            raise

    def close(self):
        """Ends the program, whatever it is doing."""
        stop(self.process)

    def is_alive(self):
        """Runs, and answers."""
        return self.process.poll() is None and self.main.has("showing")

    # The log. Every line of the panel is also on standard error, as "LOG: LEVEL text".

    def log(self):
        """The lines so far."""
        with open(self._log_path, encoding="utf-8", errors="replace") as file:
            return re.findall(r"^LOG: \d (.*)\n", file.read(), re.M)

    def wait_log(self, pattern, since=0, timeout=60):
        """Waits for a line with `pattern`; the lines from number `since` on."""
        def seen():
            if self.process.poll() is not None:
                raise AssertionError(f"MeshLab ended with status {self.process.returncode}, waiting for {pattern!r}")
            lines = self.log()[since:]
            return lines if any(re.search(pattern, line) for line in lines) else None
        return wait_until(seen, f"log line {pattern!r}", timeout)

    def wait_applied(self, since, timeout=60):
        """Waits for the end of a run; the lines from number `since` on."""
        lines = self.wait_log("^(Applied filter|Filter failed)", since, timeout)
        assert lines[-1].startswith("Applied filter"), lines
        return lines

    # Windows, menus, keys.

    def window(self, role, beginning, timeout=20):
        """Waits for the top-level window whose name begins so."""
        return wait_until(lambda: self._window(role, beginning), f"{role} {beginning!r}", timeout)

    def _window(self, role, beginning):
        for e in self.application.children:
            if e.role == role and e.name.startswith(beginning) and e.has("showing"):
                return e
        return None

    def item(self, *path):
        """An item of the menu bar, given the names from the outermost to its own."""
        item = self.main.child("menu bar")
        for name in path[:-1]:
            item = item.child("menu item", name).child("popup menu")
        return item.child("menu item", path[-1])

    def choose(self, *path):
        """Does what an item of the menu bar is for."""
        self.item(*path).press()

    def keys(self, *keys):
        """Presses keys in the window that has the keyboard."""
        self.desktop.output("xdotool", "key", "--delay", "40", *keys)

    def click(self, x, y):
        """Clicks at a place on the screen."""
        self.desktop.output("xdotool", "mousemove", str(x), str(y), "click", "1")

    def tool(self, name, on=True):
        """Switches a button of the tool bar. The bus would change its look only, so it is clicked."""
        bar = self.main.child("tool bar", "Standard")
        for _ in range(4):
            button = bar.find("check box", name)
            if button.has("checked") == on:
                return
            self.click(*button.centre)
            try:
                wait_until(lambda: bar.find("check box", name).has("checked") == on, f"{name} {on}", 5)
            except TimeoutError:
                continue
        raise TimeoutError(f"tool {name}")

    # Filters.

    def open_filter(self, *path):
        """The dialog of a filter, from the menu Filters."""
        self.choose("Filters", *path)
        return FilterDialog(self, path[-1])

    def search_filter(self, words, title):
        """The same from the search box. A key that comes before the box does is lost, then all is tried again."""
        for attempt in range(1, 5):
            self.keys("Escape", "Escape", "ctrl+f")
            time.sleep(0.3 * attempt)
            self.desktop.output("xdotool", "type", "--delay", "30", words)
            time.sleep(0.3 * attempt)
            self.keys("Down", "Return")
            try:
                self.window("frame", title, timeout=5)
                break
            except TimeoutError:
                continue
        return FilterDialog(self, title)

    def failure(self):
        """Waits for the box that says why a filter failed, and closes it; its text."""
        box = self.window("alert", "Filter Failure")
        text = box.find("label").name
        box.find("push button", "OK").press()
        wait_until(lambda: self._window("alert", "Filter Failure") is None, "box closed")
        return text

    # Layers and files.

    def layers(self):
        """[(name, whether it is the current one)] in order; the star that marks unsaved ones is left out."""
        names = [row[2] for row in self.layer_rows()]
        return [(e.name.replace(" *", ""), e.has("selected")) for e in names]

    def layer_rows(self):
        """The cells of each layer's row."""
        cells = [e for e in self.main.child("frame").child("filler").child("tree").children if e.role == "table cell"]
        return [cells[i:i + LAYER_COLUMNS] for i in range(0, len(cells), LAYER_COLUMNS)]

    def import_mesh(self, path):
        """Opens a mesh as one more layer."""
        since = len(self.log())
        self.choose("File", "Import Mesh...")
        self._name_file("Import Mesh", path, "Open")
        self.wait_log("^All files opened", since)

    def export_mesh(self, path):
        """Saves the current layer; `path` ends in .ply."""
        since = len(self.log())
        self.choose("File", "Export Mesh As...")
        self._name_file("Save ", path, "Save")
        self.window("dialog", "Choose Saving").find("push button", "OK").press()
        self.wait_log("^Saved Mesh", since)
        return path

    def _name_file(self, title, path, button):
        dialog = self.window("dialog", title)
        name = dialog.find("text", "File name:")
        name.text = str(path)
        wait_until(lambda: name.text == str(path), "file name")
        dialog.find("push button", button).press()

    def progress_bar(self):
        """Its place on the screen."""
        bars = [e for e in self.main.child("status bar").children if e.role == "progress bar" and e.has("showing")]
        return max((bar.box for bar in bars), key=lambda box: box.width)
