# Installs the library: a shared and a static one, the headers, and how to find them by CMake and by pkg-config. Nothing
# that is installed names the prefix, so that an installed tree can be moved. Included by lib/.
include(CMakePackageConfigHelpers)
set(pt_cmake_directory ${CMAKE_INSTALL_LIBDIR}/cmake/pt)

install(
  TARGETS pt
  EXPORT pt-targets
  LIBRARY COMPONENT pt_runtime NAMELINK_COMPONENT pt_development
)
install(
  TARGETS pt_static
  EXPORT pt-static-targets
  ARCHIVE COMPONENT pt_development
)
if(PT_BUILD_SCENE_FILE OR PT_BUILD_CLI)
  install(
    TARGETS pt_scene
    EXPORT pt-scene-targets
    LIBRARY COMPONENT pt_runtime NAMELINK_COMPONENT pt_development
  )
  install(
    TARGETS pt_scene_static
    EXPORT pt-scene-targets
    ARCHIVE COMPONENT pt_development
  )
  set(pt_scene_export pt-scene-targets)
endif()
install(
  DIRECTORY include/pt
  DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}
  COMPONENT pt_development
  FILES_MATCHING
  PATTERN "*.h"
)

foreach(export pt-targets pt-static-targets ${pt_scene_export})
  install(
    EXPORT ${export}
    NAMESPACE pt::
    DESTINATION ${pt_cmake_directory}
    COMPONENT pt_development
  )
endforeach()
configure_file(${PROJECT_SOURCE_DIR}/cmake/pt-config.cmake.in pt-config.cmake @ONLY)
write_basic_package_version_file(pt-config-version.cmake COMPATIBILITY SameMinorVersion)
install(
  FILES ${CMAKE_CURRENT_BINARY_DIR}/pt-config.cmake ${CMAKE_CURRENT_BINARY_DIR}/pt-config-version.cmake
  DESTINATION ${pt_cmake_directory}
  COMPONENT pt_development
)

# pt.pc, and pt-static.pc with all that the static library needs: where both are installed a linker takes the shared
# one for -lpt, whatever pkg-config --static adds.
list(TRANSFORM pt_cxx_runtime PREPEND -l OUTPUT_VARIABLE pt_cxx_runtime_flags)
list(JOIN pt_cxx_runtime_flags " " pt_cxx_runtime_flags)
file(RELATIVE_PATH pt_prefix_from_pc ${CMAKE_INSTALL_FULL_LIBDIR}/pkgconfig ${CMAKE_INSTALL_PREFIX})
string(REGEX REPLACE "/$" "" pt_prefix_from_pc "${pt_prefix_from_pc}")
function(pt_install_pc name libs requires)
  set(pt_pc_name ${name})
  set(pt_pc_libs ${libs})
  set(pt_pc_requires ${requires})
  configure_file(${PROJECT_SOURCE_DIR}/cmake/pt.pc.in ${name}.pc @ONLY)
  install(
    FILES ${CMAKE_CURRENT_BINARY_DIR}/${name}.pc
    DESTINATION ${CMAKE_INSTALL_LIBDIR}/pkgconfig
    COMPONENT pt_development
  )
endfunction()
pt_install_pc(pt "-L\${libdir} -lpt" "")
pt_install_pc(pt-static "\${libdir}/libpt.a ${pt_cxx_runtime_flags}" vulkan)
if(pt_scene_export)
  pt_install_pc(pt-scene "-L\${libdir} -lpt-scene" "")
  pt_install_pc(pt-scene-static "\${libdir}/libpt-scene.a ${pt_cxx_runtime_flags}" "")
endif()
