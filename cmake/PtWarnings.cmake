# Sources of tests that are compiled as one file hide no names of each other by theirs.
set(pt_in_batches
    $<AND:$<BOOL:$<TARGET_PROPERTY:UNITY_BUILD>>,$<NOT:$<STREQUAL:$<TARGET_PROPERTY:UNITY_BUILD_MODE>,GROUP>>>
)
# Compiler settings of this project's own targets, which link pt_warnings privately: users of the library do not get them.
add_library(pt_warnings INTERFACE)
target_compile_options(
  pt_warnings
  INTERFACE -Wall
            -Wextra
            -Wpedantic
            -Wconversion
            $<$<CXX_COMPILER_ID:Clang>:-Wno-sign-conversion> # of which GCC's -Wconversion has none for C++
            $<IF:${pt_in_batches},$<$<CXX_COMPILER_ID:GNU>:-Wshadow=local>,-Wshadow>
            $<$<BOOL:${PT_BUILD_TESTS}>:-Werror> # other projects and packagers have other compilers
            -ffp-contract=off # own arithmetic has the same bits where processors have fused multiplications
)
# Without a build type CMake does not optimise, and a project that adds this one as a folder may have none: these targets
# are optimised there too. A build type, and a level in CMAKE_CXX_FLAGS, are that project's choice.
get_cmake_property(pt_is_multi_config GENERATOR_IS_MULTI_CONFIG)
if(NOT CMAKE_BUILD_TYPE AND NOT pt_is_multi_config AND NOT CMAKE_CXX_FLAGS MATCHES "(^| )-O")
  separate_arguments(pt_release_flags NATIVE_COMMAND "${CMAKE_CXX_FLAGS_RELEASE}")
  target_compile_options(pt_warnings INTERFACE "$<$<COMPILE_LANGUAGE:CXX>:${pt_release_flags}>")
endif()
if(PT_SANITIZE)
  target_compile_options(pt_warnings INTERFACE -fsanitize=${PT_SANITIZE} -fno-sanitize-recover=all -fno-omit-frame-pointer)
  # Tests and targets with PT_FEW_CHECKS do without three checks of every access. These take a fifth of the compiler's time
  # and make the objects more than twice as large.
  foreach(check null alignment vptr)
    target_compile_options(
      pt_warnings
      INTERFACE $<$<OR:${pt_in_batches},$<BOOL:$<TARGET_PROPERTY:PT_FEW_CHECKS>>>:-fno-sanitize=${check}>
    )
  endforeach()
  target_link_options(pt_warnings INTERFACE -fsanitize=${PT_SANITIZE})
  find_program(PT_GOLD ld.gold)
  if(PT_GOLD AND CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
    target_link_options(pt_warnings INTERFACE -fuse-ld=gold) # links in half the time
  endif()
endif()
if(PT_COVERAGE)
  target_compile_options(pt_warnings INTERFACE --coverage)
  target_link_options(pt_warnings INTERFACE --coverage)
endif()
if(PT_FUZZ)
  target_compile_options(pt_warnings INTERFACE -fsanitize=fuzzer-no-link)
endif()
