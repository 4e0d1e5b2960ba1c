# With PT_UNITY, the sources of a target are compiled as one file or two: most of the time of a compiler, and of clang-tidy,
# goes into headers. It suits a single build, not changes of sources. Names in anonymous namespaces must differ
# within a file.
option(PT_UNITY "Compile the sources of the library, the program and the tests as few files" OFF)
if(PT_UNITY)
  set(CMAKE_DISABLE_PRECOMPILE_HEADERS ON) # too few files read a header to repay its precompiling
endif()
# GCC looks for garbage in hundreds of megabytes of headers each time that a file has added a little: a tenth of its time.
if(PT_UNITY AND CMAKE_CXX_COMPILER_ID STREQUAL "GNU" AND NOT CMAKE_CXX_CLANG_TIDY)
  add_compile_options(--param=ggc-min-heapsize=1000000) # KB
endif()

# pt_unite(TARGET [folders]): the sources of these folders are compiled as one, and all others as one.
function(pt_unite target)
  if(NOT PT_UNITY)
    return()
  endif()
  set_target_properties(${target} PROPERTIES UNITY_BUILD ON UNITY_BUILD_MODE GROUP)
  if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
    target_compile_options(${target} PRIVATE -Wno-subobject-linkage) # a fault of headers, for which it takes the sources
  endif()
  list(JOIN ARGN _ folders)
  get_target_property(sources ${target} SOURCES)
  foreach(source IN LISTS sources)
    cmake_path(GET source PARENT_PATH folder)
    if(folder AND folder IN_LIST ARGN)
      set_source_files_properties(${source} PROPERTIES UNITY_GROUP ${folders})
    else()
      set_source_files_properties(${source} PROPERTIES UNITY_GROUP all)
    endif()
  endforeach()
endfunction()
