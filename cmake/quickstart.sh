#!/bin/sh
# From a fresh clone on a bare Debian 12 to programs, a picture or passed tests:
#   sh cmake/quickstart.sh render   builds the program for PNG and renders the coursework scene to coursework.png
#   sh cmake/quickstart.sh build    builds the library, the program with all its parts and the examples into build/
#   sh cmake/quickstart.sh test     builds everything and runs all tests: with the validation layer, and with sanitizers;
#                                   and looks over the library by clang-tidy
# Each installs the packages that it needs, as root or through sudo. Without apt-get, install the equivalents first.
set -eu
cd "$(dirname "$0")/.."

render_packages="g++ cmake ninja-build libvulkan-dev mesa-vulkan-drivers glslang-tools spirv-tools
    libglm-dev libxxhash-dev libpng-dev nlohmann-json3-dev libcli11-dev libzstd-dev"
# EXR and JPEG, kernels compiled while a program runs, and Debian packages.
build_packages="$render_packages pkg-config libopenimageio-dev glslang-dev dpkg-dev file"
test_packages="$build_packages build-essential vulkan-validationlayers libgtest-dev python3 python3-jsonschema python3-numpy python3-pandas mypy
    python3-aiohttp python3-ase python3-distributed python3-gsd python3-matplotlib python3-openimageio python3-pip python3-xxhash doxygen
    clang-format-14 clang-tidy-14"
# Debian 12 lacks the one, and the other has no arrays there. The tests of figures look for them in build/python-modules.
test_modules="gemmi==0.7.5 chemfiles==0.10.4"

install_packages() { # package...
    command -v apt-get >/dev/null || return 0
    missing=
    for package; do
        dpkg-query -W -f='${Status}' "$package" 2>/dev/null | grep -q 'install ok installed' || missing="$missing $package"
    done
    [ -n "$missing" ] || return 0
    as_root=
    [ "$(id -u)" -eq 0 ] || as_root=sudo
    $as_root apt-get update
    # shellcheck disable=SC2086 # one word a package
    $as_root env DEBIAN_FRONTEND=noninteractive apt-get install -y --no-install-recommends $missing
}

install_modules() {
    python=python3
    "$python" -c "import numpy" 2>/dev/null || python=/usr/bin/python3 # the tests' interpreter
    # shellcheck disable=SC2086 # one word a module
    PYTHONPATH=build/python-modules "$python" -c "import chemfiles, gemmi; gemmi.FlatStructure" 2>/dev/null ||
        "$python" -m pip install --quiet --no-deps --upgrade --target build/python-modules $test_modules
}

build() { # preset, whether with tests [cmake --build arguments]
    preset=$1
    # Few files parse few headers.
    cmake --preset "$preset" -DPT_BUILD_TESTS="$2" -DPT_UNITY=ON || return
    shift 2
    cmake --build --preset "$preset" "$@"
}

# To build is the test of tidy.
check() { # preset
    case $1 in
    tidy) build tidy OFF --target pt_core pt-glsl ;; # all of lib/; that of cli/ takes twice as long
    *) build "$1" ON && ctest --preset "$1" ;;
    esac
}

# One after the other, for each keeps all cores busy: side by side they take twice as long.
test_all() {
    failed=
    for preset in release sanitize tidy; do
        check "$preset" || failed="$failed $preset"
    done
    echo "quickstart: ${failed:+FAILED:}${failed:-all passed}"
    [ -z "$failed" ]
}

# shellcheck disable=SC2086 # one word a package
case ${1-} in
render)
    install_packages $render_packages
    build release OFF --target pt-cli
    build/bin/pt render cli/scenes/coursework.json --size 1024x512 --spp 64 --max-path-length 6 \
        --exposure -3 --tonemap agx -o coursework.png
    ;;
build)
    install_packages $build_packages
    build release OFF
    ;;
test)
    install_packages $test_packages
    install_modules
    test_all
    ;;
*)
    sed -n 's/^# \{0,1\}//; 2,7p' "$0" >&2
    exit 2
    ;;
esac
