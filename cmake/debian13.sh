#!/bin/sh
# Builds the project on Debian 13, by GCC and by the newest clang there, with link-time optimisation, against its Vulkan
# headers. Runs the tests that need no device, and renders by its Mesa. As root, on a Debian that has debootstrap:
#   sh cmake/debian13.sh [FOLDER]   FOLDER (build/debian13) gets the tree of Debian 13, unless it has one, and the builds
set -eu
project=$(cd "$(dirname "$0")/.." && pwd)
tree=${1:-$project/build/debian13}
packages="g++ make clang-19 cmake ninja-build pkg-config libvulkan-dev glslang-tools glslang-dev spirv-tools libglm-dev
    libxxhash-dev libpng-dev nlohmann-json3-dev libcli11-dev libzstd-dev libopenimageio-dev libgtest-dev python3
    python3-numpy lld-19 llvm-19 mesa-vulkan-drivers"

if [ ! -e "$tree/made" ]; then
    mirror=$(apt-get indextargets --format '$(REPO_URI)' 'Label: Debian' | head -n 1) # the one that apt uses here
    mkdir -p "$tree"
    debootstrap --variant=minbase trixie "$tree" "$mirror"
    # shellcheck disable=SC2086 # one word a package
    chroot "$tree" sh -c "apt-get update && DEBIAN_FRONTEND=noninteractive \
        apt-get install -y --no-install-recommends $(echo $packages)"
    touch "$tree/made"
fi

# What is mounted for the builds vanishes with them.
exec unshare --mount sh -eu -s "$project" "$tree" <<'END'
mkdir -p "$2/project" "$2/build"
mount --bind -o ro "$1" "$2/project"
mount -t proc proc "$2/proc"
chroot "$2" env -i PATH=/usr/bin:/bin LANG=C.UTF-8 sh -eu -c '
    for compilers in "gcc g++" "clang-19 clang++-19"; do
        build=/build/${compilers% *}
        cmake -S /project -B "$build" -G Ninja -DCMAKE_C_COMPILER="${compilers% *}" -DCMAKE_CXX_COMPILER="${compilers#* }" \
            -DCMAKE_BUILD_TYPE=Release -DPT_UNITY=ON -DPT_BUILD_EXAMPLES=OFF -DCMAKE_INTERPROCEDURAL_OPTIMIZATION=ON
        cmake --build "$build" --target pt pt_static pt-cli pt_host_tests pt_cli_tests
        ctest --test-dir "$build" --output-on-failure -R "^(host|cli|abi.exported_symbols)$"
        # More loop trips than older Mesas allow.
        "$build/bin/pt" render /project/cli/scenes/thousand-spheres.json --max-path-length 1024 --size 16x8 --spp 4 -o /x.png
    done'
END
