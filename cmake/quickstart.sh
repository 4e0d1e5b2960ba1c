#!/bin/sh
# From a fresh clone on a bare Debian 12 to programs, a picture or passed tests:
#   sh cmake/quickstart.sh build    installs the packages and builds everything into build/ (programs in build/bin/)
#   sh cmake/quickstart.sh render   the same for the program alone, and renders the coursework scene to coursework.png
#   sh cmake/quickstart.sh test     the same, and runs all tests: with the validation layer, then with sanitizers
# Packages are installed as root, or through sudo. Without apt-get, install the equivalents first.
set -eu
cd "$(dirname "$0")/.."

packages="build-essential cmake ninja-build pkg-config
    libvulkan-dev mesa-vulkan-drivers vulkan-validationlayers glslang-dev glslang-tools spirv-tools
    libglm-dev libopenimageio-dev libpng-dev nlohmann-json3-dev libcli11-dev libgtest-dev python3
    doxygen file"

install_packages() {
    command -v apt-get >/dev/null || return 0
    missing=
    for package in $packages; do
        dpkg-query -W -f='${Status}' "$package" 2>/dev/null | grep -q 'install ok installed' || missing="$missing $package"
    done
    [ -n "$missing" ] || return 0
    as_root=
    [ "$(id -u)" -eq 0 ] || as_root=sudo
    $as_root apt-get update
    # shellcheck disable=SC2086 # one word a package
    $as_root env DEBIAN_FRONTEND=noninteractive apt-get install -y --no-install-recommends $missing
}

build() { # preset [cmake --build arguments]
    preset=$1
    shift
    cmake --preset "$preset"
    cmake --build --preset "$preset" "$@"
}

case ${1-} in
build)
    install_packages
    build release
    ;;
render)
    install_packages
    build release --target pt-cli
    build/bin/pt render cli/scenes/coursework.json --size 1024x512 --spp 64 --max-path-length 6 \
        --exposure -3 --tonemap agx -o coursework.png
    ;;
test)
    install_packages
    build release
    ctest --preset release
    build sanitize
    ctest --preset sanitize
    ;;
*)
    sed -n 's/^# \{0,1\}//; 2,6p' "$0" >&2
    exit 2
    ;;
esac
