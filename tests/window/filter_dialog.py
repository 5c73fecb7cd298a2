# SPDX-License-Identifier: GPL-3.0-or-later
"""The dialog of a filter in MeshLab 2020.09: a row for each parameter, with label, editor and help text."""
import time
from collections import namedtuple

from accessible import wait_until

Row = namedtuple("Row", "editor help")


class FilterDialog:
    """A filter's open dialog."""

    def __init__(self, meshlab, title):
        self.meshlab = meshlab
        self.window = meshlab.window("frame", title)
        self.body = wait_until(lambda: self.window.child("frame"), "the dialog's body")
        self.rows = wait_until(self._rows, "the dialog's parameters")

    def _rows(self):
        """{label: Row}, in order."""
        form = next(e for e in self.body.walk() if e.role == "frame" and e is not self.body)
        rows, label, editor = {}, None, None
        for e in form.children:
            if e.role == "label" and label is None:
                label = e.name
            elif e.role == "label":
                rows[label] = Row(editor, e.name)
                label = editor = None
            elif e.role == "check box":
                label, editor = e.name, e
            elif e.role in ("text", "combo box"):
                editor = e
        return rows

    def labels(self):
        """In the order of the dialog."""
        return list(self.rows)

    def help(self, label):
        """The explanation, which also is the tooltip."""
        return self.rows[label].help

    def words(self, label):
        """What a choice offers."""
        return [e.name for e in self.rows[label].editor.walk() if e.role == "list item"]

    def get(self, label):
        """The value: true or false, the chosen word, or the text."""
        editor = self.rows[label].editor
        if editor.role == "check box":
            return editor.has("checked")
        return editor.name if editor.role == "combo box" else editor.text

    def set(self, label, value):
        """Changes a value, and sees that it is there."""
        editor = self.rows[label].editor
        if editor.role == "check box":
            if editor.has("checked") != value:
                editor.press()
        elif editor.role == "combo box":
            self._pick(label, value)
        else:
            value = str(value)
            editor.text = value
        wait_until(lambda: self.get(label) == value, f"{label}: {value}")

    def _pick(self, label, word):
        # The bus has no way to choose from the list: it is opened and walked through by keys.
        words = self.words(label)
        for attempt in range(1, 5):
            self.rows[label].editor.press()
            time.sleep(0.3 * attempt)
            self.meshlab.keys("Home", *["Down"] * words.index(word), "Return")
            try:
                wait_until(lambda: self.get(label) == word, f"{label}: {word}", 3)
                return
            except TimeoutError:
                self.meshlab.keys("Escape")

    def press(self, button):
        """Apply, Close, Default or Help."""
        wait_until(lambda: self.body.child("push button", button), button).press()

    def apply(self):
        """Starts a run; the number of log lines before it."""
        since = len(self.meshlab.log())
        self.press("Apply")
        return since

    def close(self):
        """It covers the tool bar."""
        self.press("Close")
        wait_until(lambda: not self.window.has("showing"), "dialog closed")
