# With PT_UNITY, the sources of a folder are compiled as one file: most of the time of a compiler, and of clang-tidy, goes
# into headers. For what is built once; who changes sources builds without. Names in anonymous namespaces must differ
# within a file.
option(PT_UNITY "Compile the sources of each folder of the library and the program as one file" OFF)
# GCC looks for garbage in hundreds of megabytes of headers each time that a file has added a little: a tenth of its time.
if(PT_UNITY AND CMAKE_CXX_COMPILER_ID STREQUAL "GNU" AND NOT CMAKE_CXX_CLANG_TIDY)
  add_compile_options(--param=ggc-min-heapsize=1000000) # KB
endif()

function(pt_have_unity_groups target)
  set_target_properties(${target} PROPERTIES UNITY_BUILD ON UNITY_BUILD_MODE GROUP)
  if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
    target_compile_options(${target} PRIVATE -Wno-subobject-linkage) # a fault of headers, for which it takes the sources
  endif()
endfunction()

# pt_unite(TARGET): all sources are compiled as one.
function(pt_unite target)
  if(PT_UNITY)
    pt_have_unity_groups(${target})
    get_target_property(sources ${target} SOURCES)
    set_source_files_properties(${sources} PROPERTIES UNITY_GROUP all)
  endif()
endfunction()

# pt_unite_folders(TARGET [folders that are compiled as one])
function(pt_unite_folders target)
  if(NOT PT_UNITY)
    return()
  endif()
  pt_have_unity_groups(${target})
  get_target_property(sources ${target} SOURCES)
  foreach(source IN LISTS sources)
    cmake_path(GET source PARENT_PATH folder)
    if(folder IN_LIST ARGN)
      list(JOIN ARGN _ folder)
    endif()
    if(source MATCHES "\\.cpp$" AND folder)
      set_source_files_properties(${source} PROPERTIES UNITY_GROUP ${folder})
    endif()
  endforeach()
endfunction()
