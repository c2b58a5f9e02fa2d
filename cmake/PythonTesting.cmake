# Tests of the Python module, a file each. One that collects no test fails, by pytest's own exit code.
file(GLOB python_tests CONFIGURE_DEPENDS tests/tools/python/test_*.py)
foreach(file IN LISTS python_tests)
  get_filename_component(name ${file} NAME_WE)
  string(REPLACE "test_" "" name ${name})
  add_test(NAME Python.${name} COMMAND bash ${PROJECT_SOURCE_DIR}/tests/tools/python/run.sh ${Python3_EXECUTABLE} ${file})
  set_tests_properties(Python.${name} PROPERTIES SKIP_RETURN_CODE 77 TIMEOUT 300 ENVIRONMENT
    "PYTHONPATH=${PROJECT_BINARY_DIR}/python;QUORUM_PROGRAM=$<TARGET_FILE:quorum>;QUORUM_BUILD_FOLDER=${PROJECT_BINARY_DIR}")
endforeach()
