# pt_add_archive(TARGET NAME OBJECTS [archives of the project's that these need]): the static library NAME.
#
# Hidden symbols of an archive still meet those of the program, which may have a namespace pt of its own or Vulkan-Hpp
# with other settings. Therefore the archive has one object that is linked in advance. Its symbols are local, except those
# that begin with pt_. Groups are dissolved first: a linker would drop a group that it has seen elsewhere, and with it the
# targets of local symbols.
function(pt_add_archive target name objects)
  set(object ${CMAKE_CURRENT_BINARY_DIR}/${name}.o)
  set(files "$<FILTER:$<TARGET_OBJECTS:${objects}>,INCLUDE,\\.o$>") # without the precompiled header
  set(archives ${ARGN})
  list(TRANSFORM archives REPLACE "(.+)" "$<TARGET_FILE:\\1>")
  add_custom_command(
    OUTPUT ${object}
    COMMAND ${CMAKE_CXX_COMPILER} -r -nostdlib -Wl,--force-group-allocation -o ${object} ${files} ${archives}
    COMMAND ${CMAKE_OBJCOPY} --wildcard --keep-global-symbol=pt_* ${object}
    DEPENDS ${files} ${archives}
    COMMENT "Linking ${name}.o"
    COMMAND_EXPAND_LISTS VERBATIM
  )
  add_library(${target} STATIC ${object})
  set_target_properties(${target} PROPERTIES OUTPUT_NAME ${name} LINKER_LANGUAGE CXX)
  target_link_libraries(${target} INTERFACE ${pt_cxx_runtime})
  # Only Linux's linker makes the object, and no test uses a sanitized one.
  if(PT_SANITIZE OR NOT CMAKE_SYSTEM_NAME STREQUAL "Linux")
    set_target_properties(${target} PROPERTIES EXCLUDE_FROM_ALL ON)
  endif()
endfunction()
