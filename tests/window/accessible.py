# SPDX-License-Identifier: GPL-3.0-or-later
"""What a window shows, as the accessibility bus tells it. To be imported when a Desktop is there."""
import time
from collections import namedtuple

import gi

gi.require_version("Atspi", "2.0")
from gi.repository import Atspi, GLib  # noqa: E402

Box = namedtuple("Box", "x y width height")
# An application that is busy answers late; whoever asks tries again.
REPLY, START = 1500, 5000
Atspi.set_timeout(REPLY, START)


def wait_until(condition, what, timeout=20):
    """The first true value of `condition`; what vanishes while it is being looked at counts as not there yet."""
    end = time.monotonic() + timeout
    while True:
        # The library learns of changes through events.
        while GLib.MainContext.default().iteration(False):
            pass
        try:
            value = condition()
        except (GLib.Error, LookupError):
            value = None
        if value:
            return value
        if time.monotonic() > end:
            raise TimeoutError(f"{what}: not within {timeout} s")
        time.sleep(0.03)


class Element:
    """One thing in a window. Nothing is remembered: every question goes to the program."""

    def __init__(self, node):
        self.node = node

    @property
    def role(self):
        return self.node.get_role_name()

    @property
    def name(self):
        return self.node.get_name()

    @property
    def children(self):
        """Direct ones, in order."""
        found = (self.node.get_child_at_index(i) for i in range(self.node.get_child_count()))
        return [Element(n) for n in found if n is not None]

    def walk(self):
        """This and everything below it, the nearer the earlier; what is not shown too."""
        level = [self]
        while level:
            yield from level
            level = [child for e in level for child in e.children]

    def has(self, state):
        """`state`: showing, checked, enabled, selected, ..."""
        return self.node.get_state_set().contains(getattr(Atspi.StateType, state.upper()))

    @property
    def box(self):
        """Place on the screen."""
        e = self.node.get_extents(Atspi.CoordType.SCREEN)
        return Box(e.x, e.y, e.width, e.height)

    @property
    def centre(self):
        b = self.box
        return b.x + b.width // 2, b.y + b.height // 2

    def first(self, role, name=None):
        """The nearest one below this that shows, or None."""
        for e in self.walk():
            if e.role == role and name in (None, e.name) and e.has("showing"):
                return e
        return None

    def find(self, role, name=None, timeout=20):
        """Waits for it."""
        return wait_until(lambda: self.first(role, name), f"{role} {name!r}", timeout)

    def child(self, role, name=None):
        """The direct child; LookupError if there is none."""
        for c in self.children:
            if c.role == role and name in (None, c.name):
                return c
        raise LookupError(f"no {role} {name!r}")

    def press(self):
        """Does what the element is for. Does not wait until that is done: a run or a modal box may follow."""
        Atspi.set_timeout(200, 200)
        try:
            Atspi.Action.do_action(self.node, 0)
        except GLib.Error:
            pass
        finally:
            Atspi.set_timeout(REPLY, START)

    @property
    def text(self):
        return Atspi.Text.get_text(self.node, 0, -1)

    @text.setter
    def text(self, value):
        Atspi.EditableText.set_text_contents(self.node, value)


def application(pid):
    """The program with this process id, or None."""
    desktop = Atspi.get_desktop(0)
    for i in range(desktop.get_child_count()):
        node = desktop.get_child_at_index(i)
        if node is not None and node.get_process_id() == pid:
            return Element(node)
    return None


def start():
    """Starts the registry, which programs look for when they start."""
    Atspi.init()
    Atspi.get_desktop(0).get_child_count()
    # Caches go stale when a program is too busy to send events.
    Atspi.get_desktop(0).set_cache_mask(Atspi.Cache.NONE)
