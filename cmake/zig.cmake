# A toolchain file for CMake that compiles by Zig, which carries libc++ and the symbols of every glibc, for another system
# than the one at hand. Used by wheel.sh.
set(PT_ZIG "" CACHE FILEPATH "The program zig, as in the Python package ziglang")
set(PT_TARGET "" CACHE STRING "Zig's name of a system, such as aarch64-linux-gnu.2.28 or x86_64-windows-gnu")
set(PT_PREFIX "" CACHE PATH "Where headers and libraries are looked for")
set(CMAKE_TRY_COMPILE_PLATFORM_VARIABLES PT_ZIG PT_TARGET PT_PREFIX)

string(REGEX MATCH "^[^-]+" CMAKE_SYSTEM_PROCESSOR ${PT_TARGET})
set(CMAKE_SYSTEM_NAME Linux)
if(PT_TARGET MATCHES "windows")
  set(CMAKE_SYSTEM_NAME Windows)
elseif(PT_TARGET MATCHES "macos")
  set(CMAKE_SYSTEM_NAME Darwin)
endif()
set(CMAKE_C_COMPILER ${PT_ZIG} cc)
set(CMAKE_CXX_COMPILER ${PT_ZIG} c++)
foreach(language C CXX)
  set(CMAKE_${language}_COMPILER_TARGET ${PT_TARGET})
  set(CMAKE_${language}_ARCHIVE_CREATE "${PT_ZIG} ar qc <TARGET> <OBJECTS>")
  set(CMAKE_${language}_ARCHIVE_FINISH "")
endforeach()
set(CMAKE_DISABLE_PRECOMPILE_HEADERS ON)
foreach(kind EXE SHARED MODULE)
  set(CMAKE_${kind}_LINKER_FLAGS_INIT -s) # this machine's strip knows no other processor
endforeach()

set(CMAKE_FIND_ROOT_PATH ${PT_PREFIX})
set(CMAKE_FIND_ROOT_PATH_MODE_PROGRAM NEVER)
foreach(kind LIBRARY INCLUDE PACKAGE)
  set(CMAKE_FIND_ROOT_PATH_MODE_${kind} ONLY)
endforeach()
set(CMAKE_DISABLE_FIND_PACKAGE_PkgConfig ON) # which knows this machine's libraries
