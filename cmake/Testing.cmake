# The tests: engine (no Vulkan), host and parity (Vulkan), and the command line as a user runs it.
include(GoogleTest)

file(GLOB support_sources CONFIGURE_DEPENDS tests/support/*.cc)
list(FILTER support_sources EXCLUDE REGEX "vulkan_test\\.cc$")
add_library(quorum_test_support STATIC ${support_sources})
target_link_libraries(quorum_test_support PUBLIC quorum_engine GTest::gtest)

function(quorum_test name)
  add_executable(${name} ${ARGN})
  target_link_libraries(${name} PRIVATE quorum_test_support GTest::gtest_main nlohmann_json::nlohmann_json TBB::tbb)
  gtest_discover_tests(${name} DISCOVERY_MODE PRE_TEST PROPERTIES TIMEOUT 900)
endfunction()

file(GLOB_RECURSE engine_tests CONFIGURE_DEPENDS tests/engine/*_test.cc)
quorum_test(engine_tests ${engine_tests})

if(QUORUM_VULKAN)
  file(GLOB host_tests CONFIGURE_DEPENDS tests/host/*_test.cc tests/parity/*_test.cc)
  if(host_tests)
    quorum_kernels(quorum_test_kernels ${CMAKE_SOURCE_DIR}/tests/host/kernels test_kernel_table)
    quorum_test(host_tests ${host_tests} tests/support/vulkan_test.cc)
    target_link_libraries(host_tests PRIVATE quorum_host quorum_test_kernels Vulkan::Headers)
  endif()
endif()

file(GLOB tool_tests CONFIGURE_DEPENDS tests/tools/*_test.cc)
if(tool_tests)
  quorum_test(tool_tests ${tool_tests})
  target_compile_definitions(tool_tests PRIVATE QUORUM_PROGRAM="$<TARGET_FILE:quorum>")
  add_dependencies(tool_tests quorum)
endif()
