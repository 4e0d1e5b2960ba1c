# Compiler settings of this project's own targets, which link pt_warnings privately: users of the library do not get them.
add_library(pt_warnings INTERFACE)
target_compile_options(
  pt_warnings
  INTERFACE -Wall
            -Wextra
            -Wpedantic
            -Wshadow
            -Wconversion
            $<$<BOOL:${PROJECT_IS_TOP_LEVEL}>:-Werror> # other projects have other compilers
)
if(PT_SANITIZE)
  target_compile_options(pt_warnings INTERFACE -fsanitize=${PT_SANITIZE} -fno-sanitize-recover=all -fno-omit-frame-pointer)
  target_link_options(pt_warnings INTERFACE -fsanitize=${PT_SANITIZE})
endif()
if(PT_COVERAGE)
  target_compile_options(pt_warnings INTERFACE --coverage)
  target_link_options(pt_warnings INTERFACE --coverage)
endif()
if(PT_FUZZ)
  target_compile_options(pt_warnings INTERFACE -fsanitize=fuzzer-no-link)
endif()
