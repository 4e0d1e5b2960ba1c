vcpkg_download_distfile(
  archive
  URLS "@home@/pt-${VERSION}.tar.gz"
  FILENAME "pt-${VERSION}.tar.gz"
  SHA512 @sha512@
)
vcpkg_extract_source_archive(SOURCE_PATH ARCHIVE "${archive}")
vcpkg_add_to_path("${CURRENT_HOST_INSTALLED_DIR}/tools/glslang")
vcpkg_add_to_path("${CURRENT_HOST_INSTALLED_DIR}/tools/spirv-tools")
vcpkg_cmake_configure(
  SOURCE_PATH "${SOURCE_PATH}"
  OPTIONS
    -DPT_BUILD_CLI=OFF
    -DPT_BUILD_TESTS=OFF
    -DPT_BUILD_EXAMPLES=OFF
    -DPT_UNITY=ON
    -DCMAKE_DISABLE_FIND_PACKAGE_glslang=ON # no module that compiles kernels
)
vcpkg_cmake_install()
vcpkg_cmake_config_fixup(CONFIG_PATH lib/cmake/pt)
vcpkg_fixup_pkgconfig()
file(GLOB copyrights "${CURRENT_PACKAGES_DIR}/share/doc/*/copyright")
list(GET copyrights 0 copyright)
vcpkg_install_copyright(FILE_LIST "${copyright}")
file(REMOVE_RECURSE "${CURRENT_PACKAGES_DIR}/debug/include" "${CURRENT_PACKAGES_DIR}/debug/share" "${CURRENT_PACKAGES_DIR}/share/doc")
file(INSTALL "${CMAKE_CURRENT_LIST_DIR}/usage" DESTINATION "${CURRENT_PACKAGES_DIR}/share/${PORT}")
