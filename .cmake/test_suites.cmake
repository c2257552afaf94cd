# What ctest starts are suites of tests, not single ones: a process that loads deal.II takes half a second to begin. A suite of
# many tests is divided into shares of GoogleTest's.
# Run as a script once an executable is linked, it lists the executable's suites for ctest:
#   cmake -D EXECUTABLE=... -D NAME=... -D TIMEOUT=... -D OUT=... -P test_suites.cmake
if(CMAKE_SCRIPT_MODE_FILE)
  set(most_tests 40)
  execute_process(COMMAND ${EXECUTABLE} --gtest_list_tests OUTPUT_VARIABLE listed RESULT_VARIABLE status TIMEOUT 60)
  if(NOT status EQUAL 0)
    message(FATAL_ERROR "${EXECUTABLE} --gtest_list_tests failed (${status}):\n${listed}")
  endif()
  # A line without an indent names a suite, `Suite.`, with a remark behind a suite of types or values; its tests follow.
  string(REGEX MATCHALL "(^|\n)[^ \n]+\\.([^\n.][^\n]*)?(\n [^\n]*)+" suites "${listed}")
  set(text)
  foreach(suite IN LISTS suites)
    string(REGEX MATCHALL "\n " tests "${suite}")
    list(LENGTH tests count)
    string(REGEX REPLACE "^\n?([^ \n]+)\\..*" "\\1" suite "${suite}")
    math(EXPR shares "(${count} + ${most_tests} - 1) / ${most_tests}")
    foreach(share RANGE 1 ${shares})
      set(test ${NAME}.${suite})
      set(environment)
      if(shares GREATER 1)
        string(APPEND test .${share})
        math(EXPR index "${share} - 1")
        set(environment "ENVIRONMENT GTEST_TOTAL_SHARDS=${shares}\\;GTEST_SHARD_INDEX=${index}")
      endif()
      string(APPEND text "add_test([==[${test}]==] [==[${EXECUTABLE}]==] [==[--gtest_filter=${suite}.*]==])\n"
                         "set_tests_properties([==[${test}]==] PROPERTIES TIMEOUT ${TIMEOUT} ${environment})\n")
    endforeach()
  endforeach()
  file(WRITE ${OUT} "${text}")
  return()
endif()

# meltfront_add_suites(EXECUTABLE TIMEOUT): all suites of a GoogleTest executable as tests.
function(meltfront_add_suites name timeout)
  set(list ${CMAKE_CURRENT_BINARY_DIR}/${name}_suites.cmake)
  set(include ${CMAKE_CURRENT_BINARY_DIR}/${name}_include.cmake)
  add_custom_command(TARGET ${name} POST_BUILD BYPRODUCTS ${list} VERBATIM
    COMMAND ${CMAKE_COMMAND} -D EXECUTABLE=$<TARGET_FILE:${name}> -D NAME=${name} -D TIMEOUT=${timeout} -D OUT=${list}
            -P ${PROJECT_SOURCE_DIR}/.cmake/test_suites.cmake)
  # One that is not built is to fail, not to be left out.
  file(WRITE ${include} "if(EXISTS \"${list}\")\n  include(\"${list}\")\nelse()\n  add_test(${name}_not_built ${name}_not_built)\nendif()\n")
  set_property(DIRECTORY APPEND PROPERTY TEST_INCLUDE_FILES ${include})
endfunction()
