# The target coverage: runs the tests given to pt_report_coverage with counters reset, and prints for each file of lib/ how
# many of its lines and branches ran, and which did not. Branches that only an exception takes are left out: every call that
# may throw has one.
find_program(PT_GCOVR gcovr REQUIRED)

function(pt_report_coverage)
  set(report ${PT_GCOVR} --root ${PROJECT_SOURCE_DIR} --filter ${PROJECT_SOURCE_DIR}/lib/ --exclude-throw-branches
             ${PROJECT_BINARY_DIR}
  )
  set(runs)
  foreach(test IN LISTS ARGN)
    list(APPEND runs COMMAND ${test} --gtest_brief=1)
  endforeach()
  add_custom_target(
    coverage
    COMMAND find ${PROJECT_BINARY_DIR} -name *.gcda -delete
    ${runs}
    COMMAND ${report} --branches
    COMMAND ${report}
    DEPENDS ${ARGN}
    VERBATIM USES_TERMINAL
  )
endfunction()
