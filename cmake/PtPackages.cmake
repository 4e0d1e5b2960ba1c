# Debian packages, made by `cpack -G DEB` in the build folder: libpt0.4, named after the soname, to run programs with,
# libpt0.4-dev to build them, pt the program, pt-image-formats with which it writes EXR and JPEG, and libpt0.4-glsl with which
# programs compile kernels while they run. Dependencies are those that dpkg-shlibdeps finds. Included by the top CMakeLists.txt.
set(pt_runtime_package libpt${PROJECT_VERSION_MAJOR}.${PROJECT_VERSION_MINOR})
set(pt_development_package ${pt_runtime_package}-dev)
set(pt_program_package pt)
set(pt_image_formats_package pt-image-formats)
set(pt_compiler_package ${pt_runtime_package}-glsl)
set(CPACK_COMPONENTS_ALL pt_runtime pt_development)
if(PT_BUILD_CLI)
  list(APPEND CPACK_COMPONENTS_ALL pt_program)
endif()
if(TARGET pt-image-file)
  list(APPEND CPACK_COMPONENTS_ALL pt_image_formats)
endif()
if(TARGET pt-glsl)
  list(APPEND CPACK_COMPONENTS_ALL pt_compiler)
endif()

include(PtLicenses)
foreach(component IN LISTS CPACK_COMPONENTS_ALL)
  string(REPLACE "pt_" "" part ${component})
  pt_write_copyright(${PROJECT_BINARY_DIR}/copyright/${part}/copyright ${part})
  install(
    FILES ${PROJECT_BINARY_DIR}/copyright/${part}/copyright
    DESTINATION ${CMAKE_INSTALL_DATADIR}/doc/${${component}_package}
    COMPONENT ${component}
  )
  string(TOUPPER ${component} upper)
  set(CPACK_DEBIAN_${upper}_PACKAGE_NAME ${${component}_package})
endforeach()

install(
  DIRECTORY ${PROJECT_SOURCE_DIR}/lib/examples/
  DESTINATION share/doc/${pt_development_package}/examples
  COMPONENT pt_development EXCLUDE_FROM_ALL
  PATTERN CMakeLists.txt EXCLUDE
  PATTERN __pycache__ EXCLUDE
)
install(
  DIRECTORY ${PROJECT_SOURCE_DIR}/cli/scenes
  DESTINATION share/doc/${pt_program_package}/examples
  COMPONENT pt_program EXCLUDE_FROM_ALL
)

set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_DIRECTORY ${PROJECT_BINARY_DIR})
set(CPACK_PACKAGE_NAME ${PROJECT_NAME})
set(CPACK_PACKAGE_VERSION ${PROJECT_VERSION})
set(CPACK_PACKAGE_CONTACT "pt developers <developers@pt.invalid>") # a domain that no host can have (RFC 2606)
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "${PROJECT_DESCRIPTION}")
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_STRIP_FILES ON)
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS_PRIVATE_DIRS ${CMAKE_LIBRARY_OUTPUT_DIRECTORY})
set(CPACK_DEBIAN_PACKAGE_CONTROL_STRICT_PERMISSION ON)

set(pt_story "Scenes of spheres and planes are path-traced by one Vulkan compute kernel,
on GPUs of any vendor or, with Mesa's lavapipe, on the CPU. Images are
exact sums of their samples.
")
set(same_version "(= ${PROJECT_VERSION})")

set(CPACK_DEBIAN_PT_RUNTIME_DESCRIPTION "${pt_story}\nThis package has the shared libraries.")
set(CPACK_DEBIAN_PT_RUNTIME_PACKAGE_SECTION libs)
set(CPACK_DEBIAN_PT_RUNTIME_PACKAGE_RECOMMENDS "mesa-vulkan-drivers | vulkan-icd")
file(WRITE ${PROJECT_BINARY_DIR}/debian-control/triggers "activate-noawait ldconfig\n")
set(CPACK_DEBIAN_PT_RUNTIME_PACKAGE_CONTROL_EXTRA ${PROJECT_BINARY_DIR}/debian-control/triggers)
set(CPACK_DEBIAN_PACKAGE_GENERATE_SHLIBS ON)

set(CPACK_DEBIAN_PT_DEVELOPMENT_DESCRIPTION
    "${pt_story}
This package has the headers, the static libraries, and how to find the
libraries by CMake and pkg-config."
)
set(CPACK_DEBIAN_PT_DEVELOPMENT_PACKAGE_SECTION libdevel)
set(CPACK_DEBIAN_PT_DEVELOPMENT_PACKAGE_DEPENDS "${pt_runtime_package} ${same_version}, libvulkan-dev")
set(CPACK_DEBIAN_PT_DEVELOPMENT_PACKAGE_RECOMMENDS g++) # the C++ runtime, for programs with the static library

set(CPACK_DEBIAN_PT_PROGRAM_DESCRIPTION
    "${pt_story}
This package has the command line program, which renders scene files to
PNG and, with pt-image-formats, to EXR and JPEG."
)
set(CPACK_DEBIAN_PT_PROGRAM_PACKAGE_SECTION graphics)
set(CPACK_DEBIAN_PT_PROGRAM_PACKAGE_DEPENDS "${pt_runtime_package} ${same_version}")
set(CPACK_DEBIAN_PT_PROGRAM_PACKAGE_RECOMMENDS "${pt_image_formats_package} ${same_version}")
set(CPACK_DEBIAN_PT_PROGRAM_PACKAGE_CONFLICTS tcllib) # it has another /usr/bin/pt

set(CPACK_DEBIAN_PT_IMAGE_FORMATS_DESCRIPTION
    "${pt_story}
This package has the module with which the command line program writes
EXR and JPEG and reads reference images, by OpenImageIO."
)
set(CPACK_DEBIAN_PT_IMAGE_FORMATS_PACKAGE_SECTION graphics)
set(CPACK_DEBIAN_PT_IMAGE_FORMATS_PACKAGE_DEPENDS "${pt_program_package} ${same_version}")

set(CPACK_DEBIAN_PT_COMPILER_DESCRIPTION
    "${pt_story}
This package has the module that compiles changed kernels while a program
runs, and the kernels' sources."
)
set(CPACK_DEBIAN_PT_COMPILER_PACKAGE_SECTION libs)
set(CPACK_DEBIAN_PT_COMPILER_PACKAGE_DEPENDS "${pt_runtime_package} ${same_version}")
include(CPack)
