# mpfem_add_test: one Catch2 executable for a part of the toolkit, each of its test cases a test of its own in ctest.
find_package(Catch2 2.13 REQUIRED)
include(Catch)

# Most of the time that a test file takes to compile goes into what it includes: four files of tests/postproc that are
# compiled as one take half of the time of four. Names outside of functions must differ between the files of one
# executable. Where one file is worked at again and again, OFF is faster, and tools that read compile_commands.json find
# every file there.
option(MPFEM_TESTS_TOGETHER "Compile up to six test files as one" ON)
set(MPFEM_TEST_TIMEOUT 120 CACHE STRING "Seconds that one test case may take unless its part says otherwise")

# mpfem_add_test(NAME name SOURCES file... [LIBRARIES target...] [TIMEOUT seconds] [COST seconds] [LABELS label...])
# Makes the executable test-NAME with Catch2's main. Include paths: the project root and tests/support.
# Test cases appear in ctest as "NAME/test case"; `ctest -L NAME` runs those of one part.
# COST: about what the longest case takes. Parts with the highest start first, so that no long case is the last to end.
function(mpfem_add_test)
  cmake_parse_arguments(PARSE_ARGV 0 test "" "NAME;TIMEOUT;COST" "SOURCES;LIBRARIES;LABELS")
  if(NOT test_NAME OR NOT test_SOURCES OR test_UNPARSED_ARGUMENTS)
    message(FATAL_ERROR "mpfem_add_test needs NAME and SOURCES; not understood: '${test_UNPARSED_ARGUMENTS}'")
  endif()
  if(NOT test_TIMEOUT)
    set(test_TIMEOUT ${MPFEM_TEST_TIMEOUT})
  endif()
  if(NOT test_COST)
    set(test_COST 0)
  endif()

  add_executable(test-${test_NAME} ${test_SOURCES})
  target_include_directories(test-${test_NAME} PRIVATE ${PROJECT_SOURCE_DIR} ${PROJECT_SOURCE_DIR}/tests/support)
  target_link_libraries(test-${test_NAME} PRIVATE mpfem::options ${test_LIBRARIES} Catch2::Catch2WithMain)
  # Test files themselves need no speed: -O1 halves the time that they take to compile. The libraries keep theirs.
  target_compile_options(test-${test_NAME} PRIVATE $<$<CONFIG:Release>:-O1>)
  set_target_properties(test-${test_NAME} PROPERTIES RUNTIME_OUTPUT_DIRECTORY ${CMAKE_BINARY_DIR}/tests
                                                     UNITY_BUILD ${MPFEM_TESTS_TOGETHER} UNITY_BUILD_BATCH_SIZE 6)

  # catch_discover_tests would keep only the first of a list of labels, and none of the properties after it. `ctest -L`
  # takes regular expressions, so one label with all names serves.
  set(labels ${test_NAME} ${test_LABELS})
  list(JOIN labels "." label)
  catch_discover_tests(test-${test_NAME}
    TEST_PREFIX "${test_NAME}/"
    WORKING_DIRECTORY ${PROJECT_SOURCE_DIR}
    PROPERTIES TIMEOUT ${test_TIMEOUT} COST ${test_COST} LABELS ${label}
               ENVIRONMENT LSAN_OPTIONS=suppressions=${PROJECT_SOURCE_DIR}/cmake/leaks-of-others.txt)
endfunction()
