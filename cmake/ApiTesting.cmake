# Tests of the library: as it is called, and as it is installed.
file(GLOB api_tests CONFIGURE_DEPENDS tests/host/api/*.cc)
quorum_test(api_tests ${api_tests})
target_sources(api_tests PRIVATE tests/support/vulkan_leaks.cc)
target_link_libraries(api_tests PRIVATE quorum_api)
target_compile_definitions(api_tests PRIVATE QUORUM_API_APART)
add_dependencies(api_tests quorum)

set(api_test_folder ${PROJECT_SOURCE_DIR}/tests/host/api)
add_test(NAME ApiSymbols.AreThoseOfItsNamespace
  COMMAND bash ${api_test_folder}/symbols_test.sh $<TARGET_FILE:quorum_api> ${QUORUM_SOVERSION})
# In the optimized build alone: these take the compiler's time, and a library with sanitizers asks programs for theirs.
if(CMAKE_BUILD_TYPE STREQUAL "Release" AND NOT QUORUM_SANITIZE)
  add_test(NAME ApiHeaders.CompileAlone
    COMMAND bash ${api_test_folder}/headers_test.sh ${PROJECT_SOURCE_DIR}/host/api ${CMAKE_CXX_COMPILER} clang++-19)
  if(QUORUM_INSTALL)
    add_test(NAME ApiInstall.ExamplesBuildFromAPrefix
      COMMAND bash ${api_test_folder}/install_test.sh ${PROJECT_BINARY_DIR} ${PROJECT_SOURCE_DIR} ${CMAKE_CXX_COMPILER})
  endif()
endif()
