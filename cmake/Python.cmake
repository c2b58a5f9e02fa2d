# The Python module quorum on top of libquorum (docs/python.md): built in <build>/python/quorum, where it can be imported
# from, and installed by two components: python3-quorum for the system, and python-wheel for tools/python/setup.py, with
# libquorum beside it. Included if QUORUM_PYTHON is ON, or AUTO and what it takes is there.
if(NOT DEFINED Python3_EXECUTABLE AND EXISTS /usr/bin/python3)
  set(Python3_EXECUTABLE /usr/bin/python3 CACHE FILEPATH "The Python that the module is built for")  # pybind11 is its own
endif()
find_package(Python3 COMPONENTS Interpreter Development.Module)
find_package(pybind11 2.10 CONFIG)
if(NOT Python3_Development.Module_FOUND OR NOT pybind11_FOUND)
  if(NOT QUORUM_PYTHON STREQUAL "AUTO")
    message(FATAL_ERROR "QUORUM_PYTHON: needs pybind11-dev and python3-dev; or set it to OFF")
  endif()
  message(STATUS "Quorum: no Python module, for pybind11-dev or python3-dev is not there")
  return()
endif()

file(GLOB python_sources CONFIGURE_DEPENDS tools/python/*.cc)
Python3_add_library(quorum_python MODULE WITH_SOABI ${python_sources})
target_compile_features(quorum_python PRIVATE cxx_std_20)
set_target_properties(quorum_python PROPERTIES UNITY_BUILD ON)
target_include_directories(quorum_python PRIVATE ${PROJECT_SOURCE_DIR})
target_compile_options(quorum_python PRIVATE
  ${warnings} $<$<BOOL:${QUORUM_WERROR}>:-Werror> -fvisibility=hidden -fvisibility-inlines-hidden)
target_link_libraries(quorum_python PRIVATE quorum_api pybind11::headers)
add_dependencies(quorum_python quorum_includes)
set(python_folder ${PROJECT_BINARY_DIR}/python/quorum)
set_target_properties(quorum_python PROPERTIES
  OUTPUT_NAME _quorum LIBRARY_OUTPUT_DIRECTORY ${python_folder} INSTALL_RPATH "$ORIGIN")
set(python_files __init__.py __init__.pyi errors.py py.typed)
foreach(file IN LISTS python_files)
  configure_file(tools/python/quorum/${file} ${python_folder}/${file} COPYONLY)
endforeach()

list(TRANSFORM python_files PREPEND tools/python/quorum/)
set(python_packages lib/python3/dist-packages)  # where Debian's Python looks, below its prefix
install(TARGETS quorum_python LIBRARY DESTINATION ${python_packages}/quorum COMPONENT python3-quorum)
install(FILES ${python_files} DESTINATION ${python_packages}/quorum COMPONENT python3-quorum)
set(wheel COMPONENT python-wheel EXCLUDE_FROM_ALL)
install(TARGETS quorum_python LIBRARY DESTINATION quorum ${wheel})
install(FILES ${python_files} DESTINATION quorum ${wheel})
install(FILES $<TARGET_FILE:quorum_api> DESTINATION quorum RENAME $<TARGET_SONAME_FILE_NAME:quorum_api> ${wheel})
