# The reference of the headers as HTML, by Doxygen: target pt_reference, built on demand into reference/html of the build
# folder. What is undocumented or wrongly documented is an error.
find_package(Doxygen QUIET)
if(DOXYGEN_FOUND)
  set(pt_reference_directory ${PROJECT_BINARY_DIR}/reference)
  configure_file(${PROJECT_SOURCE_DIR}/cmake/Doxyfile.in ${pt_reference_directory}/Doxyfile @ONLY)
  file(WRITE ${pt_reference_directory}/index.dox "/** @mainpage\n * @copydetails pt.h\n */\n")
  add_custom_target(
    pt_reference
    COMMAND Doxygen::doxygen ${pt_reference_directory}/Doxyfile
    COMMENT "Writing ${pt_reference_directory}/html/index.html"
    VERBATIM
  )
endif()
