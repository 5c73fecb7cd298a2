#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# The project's one script. Debian 12; as root, or as a user with sudo.
set -euo pipefail
cd "$(dirname "$0")"

usage() {
    cat <<'TEXT'
usage: ./run.sh VERB

  demo    installs what is missing, builds, remeshes a sample through MeshLab's headless server,
          prints the quality before and after, and draws a picture (build/demo)
  test    the same set-up, then every check and test; with CCDM_ALL_HOSTS=1 in PyMeshLab 2022.2 too
  build   the command line, a plugin for each MeshLab (2020.09, 2022.02, 2025.07) and the tests, in build/
  bench   the benchmarks (tests/bench), or one of them: bench hosts,
          bench scaling [--sizes N ...] [--repeats N], bench range [--models M ...],
          bench tradeoffs [--models M ...],
          bench rules [--models M ...] [--parts rules time slope] [--repeats N],
          bench peers [--models M ...] [--peers WORD ...] [--repeats N] [--feature-angle DEGREES|own]
  paper   the paper's tables and figures made anew, beside its printed rows: build/paper/index.md;
          [--quick] [--peers WORD ...] [--time-limit SECONDS] [--redraw]
  fuzz SECONDS
          random and spoilt meshes and files, for that long: what is found lies in build/fuzz/findings
  coverage
          the lines of vcg_ext that the tests reach: build/coverage/lines.txt
  mutants plants faults in the engine, one at a time, and counts those that the tests notice
  reference
          the pages of the public headers, in build/reference
  package the same set-up, then the Debian packages and Python wheels, in build/packages
  screenshots
          the pictures of MeshLab's window in filter_ccdm/pictures, taken anew
  clean   removes what was built; --all: the fetched MeshLab sources too
TEXT
}

say() { printf '== %s\n' "$*"; }
fail() { printf 'run.sh: %s\n' "$*" >&2; exit 1; }

build_packages=(g++ cmake ninja-build libeigen3-dev libcli11-dev nlohmann-json3-dev libgtest-dev qtbase5-dev
    libqt5opengl5-dev libglew-dev meshlab dpkg-dev xz-utils ca-certificates)
demo_packages=(xvfb xauth python3-numpy python3-matplotlib)
reference_packages=(doxygen)
test_packages=(clang-format clang-tidy python3-pytest python3-venv python3-yaml libgl1 libopengl0
    "${reference_packages[@]}")
package_packages=(python3-pip python3-setuptools python3-wheel binutils)
fuzz_packages=(clang libclang-rt-14-dev)
# What drives MeshLab's window.
window_packages=(xvfb openbox xdotool imagemagick x11-utils dbus at-spi2-core gir1.2-atspi-2.0 python3-gi python3-numpy)
# CGAL, Python's environments, and what the wheels of other remeshers link to.
peer_packages=(libcgal-dev python3-venv libgl1 libopengl0 libglu1-mesa libgomp1 libxcursor1 libxft2 libxinerama1
    libxrender1)

as_root() {
    if [ "$(id -u)" = 0 ]; then
        "$@"
    elif command -v sudo >/dev/null; then
        sudo "$@"
    else
        fail "packages are missing and neither root nor sudo is at hand: $*"
    fi
}

install_packages() {
    local missing=() p
    for p in "$@"; do
        dpkg-query -W -f='${Status}' "$p" 2>/dev/null | grep -q 'ok installed' || missing+=("$p")
    done
    [ ${#missing[@]} -gt 0 ] || return 0
    say "installing: ${missing[*]}"
    as_root apt-get update -qq
    as_root env DEBIAN_FRONTEND=noninteractive apt-get install -y -qq --no-install-recommends "${missing[@]}" >/dev/null
}

# The trees that the plugin is compiled against: Debian's source tarballs of MeshLab, fetched with private lists,
# so that the machine's own package sources stay as they are. The first is the one that Debian 12 installs.
sdks=(2020.09:bookworm 2022.02:trixie 2025.07:sid)
fetch_sdk() {
    local version=$1 suite=$2 sdk=$PWD/.sdk/meshlab-$1 state=$PWD/.sdk/state-$1
    [ ! -e "$sdk/.complete" ] || return 0
    say "fetching the sources of MeshLab $version into .sdk"
    rm -rf "$state"
    mkdir -p "$state/lists/partial" "$state/cache/archives/partial"
    # The mirror that the machine uses already.
    local mirror package archive
    mirror=$(apt-get indextargets --format '$(SITE)' 'Created-By: Packages' 2>/dev/null | grep -m1 'debian/*$' || true)
    [ -n "$mirror" ] || { say "apt knows no Debian mirror to fetch MeshLab's sources from"; return 1; }
    printf 'deb-src [signed-by=/usr/share/keyrings/debian-archive-keyring.gpg] %s %s main\n' \
        "$mirror" "$suite" >"$state/sources.list"
    local options=(-o "Dir::Etc::sourcelist=$state/sources.list" -o Dir::Etc::sourceparts=- -o "Dir::State::lists=$state/lists"
        -o "Dir::Cache=$state/cache" -o APT::Sandbox::User= -qq)
    apt-get "${options[@]}" update || { say "the package lists of Debian $suite could not be fetched"; return 1; }
    package=$(apt-cache "${options[@]}" showsrc meshlab | sed -n "s/^Version: \($version.*\)/\1/p" | tail -1)
    [ -n "$package" ] || { say "Debian $suite has no MeshLab $version"; return 1; }
    (cd "$state" && apt-get "${options[@]}" source --tar-only "meshlab=$package" >/dev/null) ||
        { say "the sources of MeshLab $package could not be fetched"; return 1; }
    archive=$state/meshlab_${package%-*}.orig.tar.xz
    rm -rf "$sdk"
    mkdir -p "$sdk"
    tar -xf "$archive" -C "$sdk" --strip-components=1 --wildcards '*/src/common/*' '*/vcglib/*' || return 1
    touch "$sdk/.complete"
    rm -rf "$state"
}

# Enough for what needs vcglib only.
fetch_first_sdk() {
    fetch_sdk "${sdks[0]%:*}" "${sdks[0]#*:}" || fail "MeshLab's sources are needed"
}

fetch_sdks() {
    local entry
    for entry in "${sdks[@]}"; do
        fetch_sdk "${entry%:*}" "${entry#*:}" && continue
        [ "$entry" != "${sdks[0]}" ] || fail "MeshLab's sources are needed"
        say "no plugin for MeshLab ${entry%:*}"
    done
}

# PyMeshLab in an environment of its own, build/venv-VERSION. Without it its tests are skipped.
python_host() {
    local version=$1 venv=build/venv-$1
    shift
    [ ! -e "$venv/.complete" ] || return 0
    say "installing ${*} into $venv"
    rm -rf "$venv"
    mkdir -p build
    if /usr/bin/python3 -m venv "$venv" && "$venv/bin/pip" install -q --disable-pip-version-check "$@"; then
        touch "$venv/.complete"
    else
        rm -rf "$venv"
        say "could not be installed: the tests in that host are skipped"
    fi
}

# The plugins to build, each with the scalar type of its host.
variants="2020.09:float;2022.02:double;2025.07:double"

# In build/: these targets, or everything.
compile() {
    say "building (some minutes at first; build/build.log tells how far it is)"
    cmake --preset default "-DCCDM_PLUGIN_VARIANTS=$variants" >build-configure.log 2>&1 || { cat build-configure.log; fail "cmake failed"; }
    mkdir -p build && mv build-configure.log build/configure.log
    cmake --build --preset default -- -v "$@" >build/build.log 2>&1 || { grep -E 'error|FAILED' -A5 build/build.log; fail "the build failed, see build/build.log"; }
}

# Whether the real models are at hand; else says what becomes of it.
real_models_or() {
    local meshes=${CCDM_SHARED:-../shared}/meshes
    [ -d "$meshes" ] || say "$meshes is not there: $1"
}

# What users run, without the tests.
programs=(vcg_ext/apps/ccdm_remesh/all filter_ccdm/all)

# These targets, or everything.
build() {
    install_packages "${build_packages[@]}"
    fetch_sdks
    compile "$@"
    grep '^-- Plugin for MeshLab' build/configure.log || true
    filter_ccdm/make_host_tree.sh build/host build/plugins/2020.09/libfilter_ccdm.so
}

# The host's server with our plugin, on a display of its own.
server() { xvfb-run -a build/host/bin/meshlabserver "$@"; }

demo() {
    install_packages "${build_packages[@]}" "${demo_packages[@]}"
    build "${programs[@]}"
    local out=build/demo input=sample_meshes/cad_part.ply
    mkdir -p "$out"
    rm -f "$out"/*
    say "remeshing $input inside meshlabserver, script filter_ccdm/scripts/ccdm_uniform.mlx"
    server -i "$input" -s filter_ccdm/scripts/ccdm_uniform.mlx -o "$out/cad_part_ccdm.ply" >"$out/meshlabserver.log" 2>&1 ||
        { tail -5 "$out/meshlabserver.log"; fail "meshlabserver failed"; }
    [ -s "$out/cad_part_ccdm.ply" ] || fail "meshlabserver wrote no mesh, see $out/meshlabserver.log"
    sed -n 's/^LOG: [0-9]* CCDM: /  /p' "$out/meshlabserver.log"
    /usr/bin/python3 sample_meshes/render.py "$out/before_after.png" "$input" "$out/cad_part_ccdm.ply" \
        --titles "before,after" --histogram
    say "mesh: $out/cad_part_ccdm.ply   picture: $out/before_after.png"
}

check_style() {
    say "clang-format"
    git ls-files '*.h' '*.cpp' | xargs clang-format --dry-run --Werror
    say "each header by itself"
    cmake --build build --target ccdm_vcg_ext_verify_interface_header_sets >build/headers.log 2>&1 ||
        { grep -E 'error' build/headers.log; fail "a header does not compile by itself"; }
    say "clang-tidy"
    /usr/bin/python3 tests/style/tidy.py build parts_tests remesher_tests filter_ccdm_objects_2020.09 ccdm_remesh \
        ccdm_mesh_io make_sample_meshes >build/clang-tidy.log 2>&1 ||
        { grep -E 'error|warning' build/clang-tidy.log | sort -u | head -40; fail "clang-tidy found something"; }
}

run_tests() {
    install_packages "${build_packages[@]}" "${demo_packages[@]}" "${test_packages[@]}" "${package_packages[@]}" \
        "${window_packages[@]}"
    # ccdm-batch runs on PyMeshLab too: its packages go into the same environment, and what checks CITATION.cff.
    python_host 2025.07 pymeshlab==2025.7 numpy pytest distributed pyarrow cffconvert
    if [ -n "${CCDM_ALL_HOSTS:-}" ]; then
        python_host 2022.02 pymeshlab==2022.2.post4 'numpy<2' pytest
    else
        variants="2020.09:float;2025.07:double"
        rm -rf build/plugins/2022.02 # which would pass for one of this build
    fi
    build
    check_style
    say "tests"
    real_models_or "the tests on real models are skipped"
    ctest --preset default --output-on-failure
}

package() {
    install_packages "${build_packages[@]}" "${package_packages[@]}"
    build "${programs[@]}"
    rm -rf build/packages
    (cd build && cpack -G DEB >cpack.log) || { cat build/cpack.log; fail "cpack failed"; }
    /usr/bin/python3 python/build_wheels.py build/plugins build/packages
    ls -1 build/packages/*
}

# Clang's fuzzer on both targets at once.
fuzz() {
    local seconds=${1:-} target
    case "$seconds" in '' | *[!0-9]*) usage; exit 2 ;; esac
    install_packages "${build_packages[@]}" "${fuzz_packages[@]}"
    fetch_first_sdk
    say "building the fuzzers"
    mkdir -p build/fuzz/findings
    CXX=clang++ cmake -S . -B build/fuzz -G Ninja -DCMAKE_BUILD_TYPE=None -DCCDM_FUZZ=ON -DCCDM_BUILD_PLUGIN=OFF \
        >build/fuzz/configure.log || { cat build/fuzz/configure.log; fail "cmake failed"; }
    cmake --build build/fuzz --target fuzz_remesher fuzz_readers >build/fuzz/build.log ||
        { grep -E 'error|FAILED' -A5 build/fuzz/build.log; fail "the build failed"; }
    for target in remesher readers; do
        mkdir -p "build/fuzz/corpus-$target"
        # The files that once failed are seeds.
        UBSAN_OPTIONS=print_stacktrace=1 build/fuzz/bin/fuzz_$target "build/fuzz/corpus-$target" \
            "tests/fuzz/corpus/$target" -artifact_prefix=build/fuzz/findings/$target- -max_len=2000 -timeout=120 \
            -report_slow_units=120 -len_control=0 -rss_limit_mb=2000 -malloc_limit_mb=1000 \
            -max_total_time="$seconds" -print_final_stats=1 \
            >"build/fuzz/$target.log" 2>&1 &
    done
    wait
    for target in remesher readers; do
        say "$target: $(sed -n 's/^stat::number_of_executed_units: *//p' "build/fuzz/$target.log") executions"
    done
    [ -z "$(ls build/fuzz/findings)" ] || { ls -1 build/fuzz/findings/*; fail "there are findings"; }
    say "no findings"
}

coverage() {
    install_packages "${build_packages[@]}" "${demo_packages[@]}" "${test_packages[@]}" gcovr
    fetch_first_sdk
    say "building with counters"
    mkdir -p build/coverage
    cmake -S . -B build/coverage -G Ninja -DCMAKE_BUILD_TYPE=None -DCCDM_COVERAGE=ON -DCCDM_BUILD_PLUGIN=OFF \
        >build/coverage/configure.log || { cat build/coverage/configure.log; fail "cmake failed"; }
    cmake --build build/coverage >build/coverage/build.log ||
        { grep -E 'error|FAILED' -A5 build/coverage/build.log; fail "the build failed"; }
    say "tests"
    find build/coverage -name '*.gcda' -delete
    { ctest --test-dir build/coverage -j2 -L 'parts|remesher' && ctest --test-dir build/coverage -R 'pytest_(cli|nasty)'; } \
        >build/coverage/ctest.log ||
        { tail -20 build/coverage/ctest.log; fail "a test failed"; }
    gcovr -r . --filter 'vcg_ext/vcg/' --exclude-unreachable-branches --exclude-throw-branches \
        -o build/coverage/lines.txt build/coverage
    tail -4 build/coverage/lines.txt
}

mutants() {
    install_packages "${build_packages[@]}"
    fetch_first_sdk
    /usr/bin/python3 tests/mutants/mutants.py build/mutants ".sdk/meshlab-${sdks[0]%:*}/vcglib" "$@"
}

# Whatever is public and not documented is an error.
reference() {
    install_packages "${reference_packages[@]}"
    rm -rf build/reference
    mkdir -p build/reference
    (cd vcg_ext && { cat Doxyfile && echo 'OUTPUT_DIRECTORY = ../build/reference'; } | doxygen -) ||
        fail "the headers are not documented as they should be"
    say "build/reference/index.html"
}

screenshots() {
    install_packages "${build_packages[@]}" "${window_packages[@]}"
    build
    /usr/bin/python3 tests/window/take_screenshots.py build/host filter_ccdm/pictures
}

bench() {
    local which=${1:-all}
    case "$which" in all | hosts | scaling | range | tradeoffs | rules | peers) ;; *) usage; exit 2 ;; esac
    install_packages "${build_packages[@]}" "${demo_packages[@]}"
    build
    case "$which" in all | hosts) /usr/bin/python3 tests/bench/bench_hosts.py ;; esac
    case "$which" in all | scaling) /usr/bin/python3 tests/bench/bench_scaling.py "${@:2}" ;; esac
    case "$which" in all | range) /usr/bin/python3 tests/bench/bench_range.py "${@:2}" ;; esac
    case "$which" in all | tradeoffs) /usr/bin/python3 tests/bench/bench_tradeoffs.py "${@:2}" ;; esac
    case "$which" in all | rules) /usr/bin/python3 tests/bench/bench_rules.py "${@:2}" ;; esac
    case "$which" in all | peers)
        # A remesher that cannot be installed is a row that says so.
        (install_packages "${peer_packages[@]}") || say "not everything that the other remeshers need could be installed"
        /usr/bin/python3 tests/bench/bench_peers.py "${@:2}"
        [ "$which" = peers ] || /usr/bin/python3 tests/bench/bench_peers.py --feature-angle own
        ;;
    esac
}

paper() {
    install_packages "${build_packages[@]}" "${demo_packages[@]}" python3-markdown
    fetch_first_sdk
    compile ccdm_remesh measure_mesh angle_curve
    case " $* " in
    *" --quick "*) ;;
    *) (install_packages "${peer_packages[@]}") || say "not everything that the other remeshers need could be installed" ;;
    esac
    real_models_or "the sample meshes stand for the paper's models"
    /usr/bin/python3 tests/paper/reproduce.py "$@"
}

case "${1:-}" in
demo) demo ;;
test) run_tests ;;
build) build ;;
bench) bench "${@:2}" ;;
paper) paper "${@:2}" ;;
fuzz) fuzz "${2:-}" ;;
coverage) coverage ;;
mutants) mutants "${@:2}" ;;
reference) reference ;;
package) package ;;
screenshots) screenshots ;;
clean)
    rm -rf build
    [ "${2:-}" != --all ] || rm -rf .sdk
    ;;
*)
    usage
    [ -n "${1:-}" ] && exit 2
    ;;
esac
