# The shared library libquorum with its headers host/api/quorum, made of the objects that the program is made of, and
# how it is installed: as the CMake package Quorum and for pkg-config. docs/library.md tells how it is used.
#
# Interfaces of one soname are compatible. Before 1.0 each minor version may change them.
set(QUORUM_SOVERSION ${PROJECT_VERSION_MAJOR})
if(PROJECT_VERSION_MAJOR EQUAL 0)
  string(APPEND QUORUM_SOVERSION .${PROJECT_VERSION_MINOR})
endif()
set(api_package ${PROJECT_BINARY_DIR}/package)
configure_file(cmake/packaging/quorum.map.in ${api_package}/quorum.map @ONLY)

file(GLOB api_sources CONFIGURE_DEPENDS host/api/*.cc)
file(GLOB api_headers CONFIGURE_DEPENDS host/api/quorum/*.h)
add_library(quorum_api SHARED ${api_sources})
add_library(Quorum::quorum ALIAS quorum_api)
quorum_options(quorum_api)
# Others see the headers alone: nothing of the engine, whose names these would clash with.
set_target_properties(quorum_api PROPERTIES
  INTERFACE_INCLUDE_DIRECTORIES "" INTERFACE_LINK_LIBRARIES "" UNITY_BUILD ON)
set_property(TARGET quorum_api PROPERTY INTERFACE_COMPILE_FEATURES cxx_std_20)
target_compile_definitions(quorum_api PRIVATE QUORUM_API_APART $<$<BOOL:${QUORUM_VULKAN}>:QUORUM_HAS_VULKAN>)
target_sources(quorum_api PUBLIC FILE_SET HEADERS BASE_DIRS host/api FILES ${api_headers})
target_link_libraries(quorum_api PRIVATE quorum_run TBB::tbb)
target_link_options(quorum_api PRIVATE -Wl,--version-script=${api_package}/quorum.map)
if(NOT QUORUM_SANITIZE)
  target_link_options(quorum_api PRIVATE -Wl,--no-undefined)
endif()
set_target_properties(quorum_api PROPERTIES
  OUTPUT_NAME quorum EXPORT_NAME quorum VERSION ${PROJECT_VERSION} SOVERSION ${QUORUM_SOVERSION} DEFINE_SYMBOL ""
  LINK_DEPENDS ${api_package}/quorum.map)

if(QUORUM_INSTALL)
  include(CMakePackageConfigHelpers)
  set(api_cmake_folder ${CMAKE_INSTALL_LIBDIR}/cmake/Quorum)
  install(TARGETS quorum_api EXPORT QuorumTargets
    LIBRARY DESTINATION ${CMAKE_INSTALL_LIBDIR} COMPONENT libquorum NAMELINK_COMPONENT libquorum-dev
    FILE_SET HEADERS DESTINATION ${CMAKE_INSTALL_INCLUDEDIR} COMPONENT libquorum-dev)
  install(EXPORT QuorumTargets NAMESPACE Quorum:: DESTINATION ${api_cmake_folder} COMPONENT libquorum-dev)
  configure_package_config_file(cmake/packaging/QuorumConfig.cmake.in ${api_package}/QuorumConfig.cmake
    INSTALL_DESTINATION ${api_cmake_folder} NO_SET_AND_CHECK_MACRO)
  write_basic_package_version_file(${api_package}/QuorumConfigVersion.cmake COMPATIBILITY SameMinorVersion)
  install(FILES ${api_package}/QuorumConfig.cmake ${api_package}/QuorumConfigVersion.cmake
    DESTINATION ${api_cmake_folder} COMPONENT libquorum-dev)
  file(RELATIVE_PATH QUORUM_PREFIX_FROM_PC /${CMAKE_INSTALL_LIBDIR}/pkgconfig /)
  configure_file(cmake/packaging/quorum.pc.in ${api_package}/quorum.pc @ONLY)
  install(FILES ${api_package}/quorum.pc DESTINATION ${CMAKE_INSTALL_LIBDIR}/pkgconfig COMPONENT libquorum-dev)
  install(FILES docs/library.md DESTINATION ${CMAKE_INSTALL_DATADIR}/doc/libquorum-dev COMPONENT libquorum-dev)
  install(DIRECTORY docs/examples DESTINATION ${CMAKE_INSTALL_DATADIR}/doc/libquorum-dev COMPONENT libquorum-dev)
endif()
