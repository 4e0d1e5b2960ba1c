#!/bin/sh
# What packagers start from, of the last commit:
#   sh cmake/packages/source.sh [FOLDER]
# FOLDER, build/packages if not given, gets the source tarball, Debian's source package (where dpkg-source is there), the recipe
# for conda-forge and the port for vcpkg. The same commit gives the same bytes.
set -eu
cd "$(dirname "$0")/../.."
mkdir -p "${1-build/packages}"
folder=$(cd "${1-build/packages}" && pwd)
home=https://pt.invalid # where releases will be; no such domain can exist (RFC 2606)
version=$(sed -n 's/^  VERSION \([0-9.]*\)$/\1/p' CMakeLists.txt)
minor=${version%.*}
date=$(git log -1 --format=%cD)
editor=lib/python/pt/view/page/codemirror.js # minified

archive() { # NAME [pathspec...]
    name=$1
    shift
    git archive --prefix="pt-$version/" HEAD -- . "$@" | gzip -9 -n > "$folder/$name"
}

fill() { # TEMPLATE FILE
    sed "s|@home@|$home|; s|@version@|$version|; s|@minor@|$minor|g; s|@date@|$date|; s|@sha256@|$sha256|; s|@sha512@|$sha512|" \
        "cmake/packages/$1" > "$folder/$2"
}

sum() { # PROGRAM
    "$1" "$folder/pt-$version.tar.gz" | cut -d ' ' -f 1
}

# Debian takes no minified files; its packages have no Python.
debian() {
    archive "pt_$version+ds.orig.tar.gz" ":!$editor"
    rm -rf "$folder/pt-$version"
    tar -x -z -C "$folder" -f "$folder/pt_$version+ds.orig.tar.gz"
    cp -R cmake/packages/debian "$folder/pt-$version/debian"
    for file in control changelog rules; do
        fill "debian/$file" "pt-$version/debian/$file"
    done
    cmake -DFILE="$folder/pt-$version/debian/copyright" -DEXCLUDED="$editor" -P cmake/PtLicenses.cmake
    (cd "$folder" && dpkg-source -b "pt-$version")
}

archive "pt-$version.tar.gz"
sha256=$(sum sha256sum)
sha512=$(sum sha512sum)
rm -rf "$folder/conda" "$folder/vcpkg"
mkdir -p "$folder/conda" "$folder/vcpkg/pt"
fill conda/recipe.yaml conda/recipe.yaml
for file in vcpkg.json portfile.cmake usage; do
    fill "vcpkg/$file" "vcpkg/pt/$file"
done
cp -R cmake/packages/vcpkg/test "$folder/vcpkg/vcpkg-ci-pt"
cp -R tests/consumers/package_c "$folder/vcpkg/vcpkg-ci-pt/project"
cp -R tests/consumers/c99 "$folder/vcpkg/vcpkg-ci-pt"
if command -v dpkg-source > /dev/null; then
    debian
fi
