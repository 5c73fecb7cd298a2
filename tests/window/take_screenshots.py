# SPDX-License-Identifier: GPL-3.0-or-later
"""Makes the pictures of MeshLab's window that the README shows.

    take_screenshots.py HOST FOLDER

HOST is a MeshLab with the plugin (build/host); dialog.png and result.png go into FOLDER.
"""
import os
import sys

import ccdm
import desktop

HEIGHT_OF_ROW, HEIGHT_OF_REST = 60, 180  # of the dialog with its explanations


def main():
    host, folder = sys.argv[1:]
    lacking = desktop.missing()
    if lacking:
        print("to be installed first: " + ", ".join(lacking), file=sys.stderr)
        return 1
    os.makedirs(folder, exist_ok=True)
    height = HEIGHT_OF_REST + HEIGHT_OF_ROW * len(ccdm.LABELS)
    screen_height = max(900, height + 100)
    # So wide that the mesh, whose size goes by the height of a view, fits into half of it.
    with desktop.Desktop((int(1.6 * screen_height), screen_height)) as screen:
        import accessible  # connects to the bus of the environment
        accessible.start()
        import pictures
        from meshlab_window import MeshLab
        meshlab = MeshLab(screen, os.path.abspath(os.path.join(host, "bin", "meshlab")),
                          os.path.join(ccdm.ROOT, "sample_meshes", "twisted_bar.ply"))
        try:
            dialog = ccdm.open_dialog(meshlab)
            pictures.dialog_with_help(dialog, os.path.join(folder, "dialog.png"), (780, height))
            print("\n".join(ccdm.remesh(dialog)))
            dialog.close()
            pictures.side_by_side(meshlab, os.path.join(folder, "result.png"))
        finally:
            meshlab.close()
    return 0


if __name__ == "__main__":
    sys.exit(main())
