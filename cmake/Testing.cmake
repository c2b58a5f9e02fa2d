# The tests: engine (no Vulkan), host and parity (Vulkan), and the command line as a user runs it.
include(GoogleTest)
include(LongTests)

# Code of tests is compiled once for two builds: a build with sanitizers takes what the release build compiled, and finds
# what is wrong in its own engine. Tests take half of the time of all compilers.
set(QUORUM_TEST_OBJECTS "" CACHE PATH "A build of the same sources: its compiled tests are linked, none is compiled here")

# Sets <result> to the sources, or to their objects in QUORUM_TEST_OBJECTS. Up to eight files of a folder are compiled at a
# time, as in the engine: what tests instantiate of others' templates takes longer than they do. So names in anonymous
# namespaces differ within a folder. A file with definitions of its own is compiled alone.
set(tests_with_definitions tests/support/test_support.cc)
function(quorum_test_sources result target)
  set(files ${ARGN})
  set(objects)
  foreach(file IN LISTS files)
    cmake_path(RELATIVE_PATH file BASE_DIRECTORY ${PROJECT_SOURCE_DIR} OUTPUT_VARIABLE name)
    if(name IN_LIST tests_with_definitions)
      list(APPEND objects ${QUORUM_TEST_OBJECTS}/CMakeFiles/${target}.dir/${name}.o)
      continue()
    endif()
    cmake_path(GET name PARENT_PATH folder)
    string(MAKE_C_IDENTIFIER ${folder} folder)
    math(EXPR batch "${count_${folder}} + 0" OUTPUT_FORMAT DECIMAL)
    math(EXPR count_${folder} "${batch} + 1")
    math(EXPR batch "${batch} / 8")
    set_source_files_properties(${file} PROPERTIES UNITY_GROUP ${folder}_${batch})
    list(APPEND objects ${QUORUM_TEST_OBJECTS}/CMakeFiles/${target}.dir/Unity/unity_${folder}_${batch}_cxx.cxx.o)
  endforeach()
  if(QUORUM_TEST_OBJECTS)
    list(REMOVE_DUPLICATES objects)
    set_source_files_properties(${objects} PROPERTIES EXTERNAL_OBJECT TRUE GENERATED TRUE)
    set(files ${objects})
  endif()
  set(${result} ${files} PARENT_SCOPE)
endfunction()

file(GLOB support_sources CONFIGURE_DEPENDS tests/support/*.cc)
list(FILTER support_sources EXCLUDE REGEX "(vulkan_test|vulkan_leaks|sanitizer)\\.cc$")
quorum_test_sources(support_objects quorum_test_support ${support_sources})
add_library(quorum_test_support STATIC ${support_objects} tests/support/sanitizer.cc)
set_target_properties(quorum_test_support PROPERTIES UNITY_BUILD ON UNITY_BUILD_MODE GROUP)
quorum_options(quorum_test_support TEST)
target_link_libraries(quorum_test_support PUBLIC quorum_engine GTest::gtest)
# So that a compiler cache knows the other files in another folder, too.
set_source_files_properties(${tests_with_definitions} PROPERTIES
  COMPILE_DEFINITIONS QUORUM_SOURCE_DIR="${PROJECT_SOURCE_DIR}")

list(JOIN long_tests ":" long_tests)

# Makes the tests of <name> known: each by itself, or, with sanitizers, a suite at a time, since a process takes longer to
# start than most tests to run.
function(quorum_discover_tests name)
  if(NOT QUORUM_SANITIZE)
    gtest_discover_tests(${name} DISCOVERY_MODE PRE_TEST PROPERTIES TIMEOUT 900)
    return()
  endif()
  set(script ${PROJECT_BINARY_DIR}/${name}_suites.cmake)
  set(program ${PROJECT_BINARY_DIR}/${name})
  configure_file(cmake/SuitesOfTests.cmake.in ${script} @ONLY)
  set_property(DIRECTORY APPEND PROPERTY TEST_INCLUDE_FILES ${script})
endfunction()

function(quorum_test name)
  quorum_test_sources(objects ${name} ${ARGN})
  if(QUORUM_TEST_OBJECTS)
    # The engine's objects come first: of an inline function that stands twice the linker takes the first, with sanitizers.
    get_target_property(libraries quorum_engine INTERFACE_LINK_LIBRARIES)
    list(TRANSFORM libraries REPLACE "(.+)" "$<TARGET_OBJECTS:\\1>")
    list(PREPEND objects ${libraries})
  endif()
  add_executable(${name} ${objects})
  set_target_properties(${name} PROPERTIES UNITY_BUILD ON UNITY_BUILD_MODE GROUP)
  quorum_options(${name} TEST)
  target_link_libraries(${name} PRIVATE quorum_test_support GTest::gtest_main nlohmann_json::nlohmann_json TBB::tbb)
  quorum_discover_tests(${name})
endfunction()

file(GLOB_RECURSE engine_tests CONFIGURE_DEPENDS tests/engine/*_test.cc)
quorum_test(engine_tests ${engine_tests})

if(QUORUM_VULKAN)
  file(GLOB host_tests CONFIGURE_DEPENDS tests/host/*_test.cc tests/parity/*_test.cc)
  if(host_tests)
    quorum_kernels(quorum_test_kernels ${PROJECT_SOURCE_DIR}/tests/host/kernels test_kernel_table)
    quorum_test(host_tests ${host_tests} ${PROJECT_SOURCE_DIR}/tests/support/vulkan_test.cc)
    target_sources(host_tests PRIVATE tests/support/vulkan_leaks.cc)
    target_link_libraries(host_tests PRIVATE quorum_host quorum_test_kernels Vulkan::Headers)
    if(QUORUM_TEST_OBJECTS)
      # Classes of vulkan_raii.hpp lack a member where NDEBUG is defined, as it is where these tests were compiled.
      target_compile_definitions(quorum_host PRIVATE NDEBUG)
      set_target_properties(quorum_host PROPERTIES DISABLE_PRECOMPILE_HEADERS ON)
    endif()
  endif()
endif()

# The program of a build without Vulkan. Two of its files differ, the objects of the others are those of quorum.
if(QUORUM_VULKAN)
  set(files_that_differ tools/devices_command.cc host/run/open_backend.cc)
  set_source_files_properties(${files_that_differ} PROPERTIES SKIP_UNITY_BUILD_INCLUSION ON)
  add_executable(quorum_without_vulkan ${files_that_differ}
    "$<FILTER:$<TARGET_OBJECTS:quorum>;$<TARGET_OBJECTS:quorum_run>,EXCLUDE,/(devices_command|open_backend)[.]cc>")
  quorum_options(quorum_without_vulkan)
  target_link_libraries(quorum_without_vulkan
    PRIVATE quorum_engine CLI11::CLI11 nlohmann_json::nlohmann_json TBB::tbb)
endif()

file(GLOB tool_tests CONFIGURE_DEPENDS tests/tools/*_test.cc)
if(tool_tests)
  quorum_test(tool_tests ${tool_tests})
  add_dependencies(tool_tests quorum)
  if(TARGET quorum_without_vulkan)
    add_dependencies(tool_tests quorum_without_vulkan)
  endif()
endif()

include(ApiTesting)
if(TARGET quorum_python)
  include(PythonTesting)
endif()
if(TARGET quorum_pages)
  add_test(NAME Pages.NameEveryCommandAndOption
    COMMAND bash ${PROJECT_SOURCE_DIR}/tests/tools/pages_test.sh $<TARGET_FILE:quorum> ${PROJECT_BINARY_DIR}/pages)
endif()
if(NOT QUORUM_SANITIZE)
  add_test(NAME Documents.CommandsRun COMMAND bash ${PROJECT_SOURCE_DIR}/tests/tools/documents_test.sh
    $<TARGET_FILE:quorum> ${PROJECT_SOURCE_DIR} ${PROJECT_BINARY_DIR}/documents)
endif()
