#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# make_host_tree.sh DIR PLUGIN: a private MeshLab 2020.09 in DIR that also has PLUGIN, without touching
# the installed one. The programs find their plugins relative to their own place, so they are copied;
# everything else is linked.
set -euo pipefail
dir=$1 plugin=$2
multiarch=$(dpkg-architecture -qDEB_HOST_MULTIARCH)
installed=/usr/lib/$multiarch/meshlab
rm -rf "$dir"
mkdir -p "$dir/bin" "$dir/lib/$multiarch/meshlab/plugins"
for program in meshlab meshlabserver; do
    cp "/usr/bin/$program" "$dir/bin/"
done
ln -s "$installed"/*.so* "$dir/lib/$multiarch/meshlab/"
ln -s "$installed"/plugins/*.so "$dir/lib/$multiarch/meshlab/plugins/"
# Takes the place of the one of an installed package.
ln -sf "$(realpath "$plugin")" "$dir/lib/$multiarch/meshlab/plugins/"
