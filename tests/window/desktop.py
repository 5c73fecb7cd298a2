# SPDX-License-Identifier: GPL-3.0-or-later
"""A desktop of its own for a program under test: X server, session bus, window manager, accessibility bus.

One in a process: the accessibility library connects once, to the bus that the environment names then.
"""
import importlib.util
import os
import shutil
import signal
import subprocess
import sys
import tempfile
import time
import uuid

sys.path.insert(0, os.path.join(os.path.dirname(os.path.dirname(os.path.abspath(__file__))), "support"))
import display  # noqa: E402

# Where each comes from in Debian.
PROGRAMS = {"Xvfb": "xvfb", "openbox": "openbox", "dbus-daemon": "dbus", "xdotool": "xdotool",
            "import": "imagemagick", "xprop": "x11-utils"}
MARK = "CCDM_WINDOW_TEST"


def missing():
    """The packages that have to be installed first; empty when none."""
    names = [package for program, package in PROGRAMS.items() if shutil.which(program) is None]
    try:
        import gi
        gi.require_version("Atspi", "2.0")
    except (ImportError, ValueError):
        names += ["python3-gi", "gir1.2-atspi-2.0"]
    if importlib.util.find_spec("numpy") is None:
        names.append("python3-numpy")
    if not os.path.exists("/usr/share/dbus-1/services/org.a11y.Bus.service"):
        names.append("at-spi2-core")
    return names


def wait_for(condition, what, timeout):
    """The first true value of `condition`."""
    end = time.monotonic() + timeout
    while True:
        value = condition()
        if value:
            return value
        if time.monotonic() > end:
            raise TimeoutError(f"{what}: not within {timeout} s")
        time.sleep(0.05)


class Desktop:
    """To be closed; then none of the processes that it started, or that those started, is left."""

    def __init__(self, size=(1400, 900)):
        self.size = size
        self.folder = tempfile.mkdtemp(prefix="ccdm_window_")
        self.mark = uuid.uuid4().hex
        self.started = []
        os.mkdir(f"{self.folder}/run", 0o700)
        self.environment = {k: v for k, v in os.environ.items() if k in ("PATH", "TMPDIR", "LD_LIBRARY_PATH")}
        self.environment.update(
            {MARK: self.mark, "HOME": self.folder, "XDG_CONFIG_HOME": f"{self.folder}/config",
             "XDG_RUNTIME_DIR": f"{self.folder}/run", "LC_ALL": "C.UTF-8", "LIBGL_ALWAYS_SOFTWARE": "1",
             # Qt answers on the accessibility bus only when told to.
             "QT_LINUX_ACCESSIBILITY_ALWAYS_ON": "1"})
        try:
            self._start()
        except BaseException:
            self.close()
            raise

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self.close()

    def _start(self):
        self.environment["DISPLAY"] = ":" + self._first_line(display.x_server(*self.size), "X server")
        # Services of the bus inherit its environment, so it comes after the display.
        bus = self._first_line(["dbus-daemon", "--session", "--nofork", "--nopidfile", "--print-address={fd}"], "bus")
        self.environment["DBUS_SESSION_BUS_ADDRESS"] = bus
        # Without a window manager Qt never comes to the accessibility bus.
        self.spawn(["openbox", "--sm-disable"], "openbox")
        wait_for(lambda: "window id" in self.output("xprop", "-root", "_NET_SUPPORTING_WM_CHECK"), "window manager", 20)
        for name in ("AT_SPI_BUS_ADDRESS", "WAYLAND_DISPLAY"):
            os.environ.pop(name, None)
        for name in ("DISPLAY", "DBUS_SESSION_BUS_ADDRESS", "XDG_RUNTIME_DIR"):
            os.environ[name] = self.environment[name]
        from gi.repository import Gio, GLib
        enable = GLib.Variant("(ssv)", ("org.a11y.Status", "IsEnabled", GLib.Variant("b", True)))
        connection = Gio.DBusConnection.new_for_address_sync(
            bus, Gio.DBusConnectionFlags.AUTHENTICATION_CLIENT | Gio.DBusConnectionFlags.MESSAGE_BUS_CONNECTION,
            None, None)
        connection.set_exit_on_close(False)
        # The call starts the accessibility bus; Qt looks at the property.
        connection.call_sync("org.a11y.Bus", "/org/a11y/bus", "org.freedesktop.DBus.Properties", "Set", enable, None,
                             Gio.DBusCallFlags.NONE, 20000, None)

    def _first_line(self, command, name):
        """Starts what prints a line to the file descriptor that stands for {fd} once it is ready."""
        line = display.first_line(command, lambda words, fds: self.spawn(words, name, pass_fds=fds))
        if not line:
            raise RuntimeError(f"{name} ended: " + open(f"{self.folder}/{name}.log", errors="replace").read())
        return line

    def spawn(self, command, name, **options):
        """Starts a process whose output goes to NAME.log in the folder."""
        log = open(f"{self.folder}/{name}.log", "ab")
        with log:
            process = subprocess.Popen(command, stdin=subprocess.DEVNULL, stdout=log, stderr=log, cwd=self.folder,
                                       env=self.environment, preexec_fn=display.die_with_parent, **options)
        self.started.append(process)
        return process

    def output(self, *command):
        """What a short command prints."""
        return subprocess.run(command, env=self.environment, capture_output=True, text=True, timeout=30,
                              check=False).stdout

    def screenshot(self, path, box=None):
        """Of the screen, or of a box (x, y, width, height) on it."""
        crop = [] if box is None else ["-crop", "{2}x{3}+{0}+{1}".format(*box), "+repage"]
        subprocess.run(["import", "-window", "root", *crop, "-strip", path], env=self.environment, check=True,
                       timeout=30)

    def processes(self):
        """Ids of the living processes that descend from this desktop, which the mark in their environment tells."""
        mark = f"{MARK}={self.mark}".encode()
        found = []
        for pid in filter(str.isdigit, os.listdir("/proc")):
            try:
                with open(f"/proc/{pid}/environ", "rb") as environment:
                    if mark in environment.read().split(b"\0"):
                        found.append(int(pid))
            except OSError:
                pass
        return found

    def close(self):
        """Ends every process of this desktop and removes its folder."""
        # Clients first, the X server and the bus last.
        for process in reversed(self.started):
            stop(process)
        for pid in self.processes():
            try:
                os.kill(pid, signal.SIGKILL)
            except ProcessLookupError:
                pass
        wait_for(lambda: not self.processes(), "end of the desktop's processes", 20)
        shutil.rmtree(self.folder, ignore_errors=True)


def stop(process):
    """Ends a process, with force after three seconds."""
    if process.poll() is None:
        process.terminate()
    try:
        process.wait(3)
    except subprocess.TimeoutExpired:
        process.kill()
        process.wait(10)
