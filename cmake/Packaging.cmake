# Debian packages: `cpack -G DEB` in a build whose prefix is /usr makes one of each install component (tools/package.sh).
# Manual pages and completions are made of what the program tells of its options.
set(pages ${PROJECT_BINARY_DIR}/pages)
if(NOT CMAKE_CROSSCOMPILING AND NOT QUORUM_SANITIZE)
  add_custom_command(
    OUTPUT ${pages}/man1/quorum.1
    COMMAND ${CMAKE_COMMAND} -E rm -rf ${pages}
    COMMAND bash ${PROJECT_SOURCE_DIR}/cmake/packaging/pages.sh $<TARGET_FILE:quorum> ${pages} ${PROJECT_VERSION}
    DEPENDS quorum cmake/packaging/pages.sh
    COMMENT "Writing manual pages and completions"
    VERBATIM)
  add_custom_target(quorum_pages ALL DEPENDS ${pages}/man1/quorum.1)
  install(DIRECTORY ${pages}/man1 DESTINATION ${CMAKE_INSTALL_MANDIR} COMPONENT quorum FILES_MATCHING PATTERN "*.gz")
  install(FILES ${pages}/completions/quorum.bash RENAME quorum
    DESTINATION ${CMAKE_INSTALL_DATADIR}/bash-completion/completions COMPONENT quorum)
  install(FILES ${pages}/completions/_quorum
    DESTINATION ${CMAKE_INSTALL_DATADIR}/zsh/vendor-completions COMPONENT quorum)
  install(FILES ${pages}/completions/quorum.fish
    DESTINATION ${CMAKE_INSTALL_DATADIR}/fish/vendor_completions.d COMPONENT quorum)
endif()
# The program of tools/archive.sh: it finds its libraries beside it, and so do they (DT_RPATH; DT_RUNPATH is not passed on).
add_executable(quorum_relocatable EXCLUDE_FROM_ALL $<TARGET_OBJECTS:quorum>)
quorum_options(quorum_relocatable)
set_target_properties(quorum_relocatable PROPERTIES
  LINKER_LANGUAGE CXX OUTPUT_NAME quorum RUNTIME_OUTPUT_DIRECTORY ${PROJECT_BINARY_DIR}/relocatable
  BUILD_WITH_INSTALL_RPATH ON INSTALL_RPATH "$ORIGIN/../lib")
target_link_options(quorum_relocatable PRIVATE -Wl,--disable-new-dtags)
quorum_link(quorum_relocatable tools)

install(DIRECTORY docs/ DESTINATION ${CMAKE_INSTALL_DATADIR}/doc/quorum-doc/docs COMPONENT quorum-doc)

set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_NAME quorum)
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "")  # each component has its own
set(CPACK_PACKAGE_VENDOR Quorum)
set(CPACK_PACKAGE_CONTACT "The authors of Quorum <quorum@localhost>" CACHE STRING "Who answers for the packages: NAME <ADDRESS>")
set(CPACK_PACKAGE_DIRECTORY ${PROJECT_BINARY_DIR}/packages)
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_STRIP_FILES ON)
set(CPACK_INSTALL_DEFAULT_DIRECTORY_PERMISSIONS
  OWNER_READ OWNER_WRITE OWNER_EXECUTE GROUP_READ GROUP_EXECUTE WORLD_READ WORLD_EXECUTE)
set(CPACK_COMPONENTS_GROUPING IGNORE)
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_PACKAGE_GENERATE_SHLIBS ON)
set(CPACK_DEBIAN_PACKAGE_CONTROL_STRICT_PERMISSION ON)

file(CONFIGURE OUTPUT ${PROJECT_BINARY_DIR}/package/changelog CONTENT
"quorum (@PROJECT_VERSION@) unstable; urgency=medium

  * What has changed stands in /usr/share/doc/quorum/CHANGELOG.md.

 -- @CPACK_PACKAGE_CONTACT@  Thu, 01 Jan 2026 00:00:00 +0000
" @ONLY)
execute_process(COMMAND gzip -9nkf ${PROJECT_BINARY_DIR}/package/changelog)

# Of a component: the package's name, its section, what it is, and what it depends on beside libraries.
function(quorum_package component name section summary depends)
  string(TOUPPER ${component} key)
  list(APPEND CPACK_COMPONENTS_ALL ${component})
  set(CPACK_COMPONENTS_ALL ${CPACK_COMPONENTS_ALL} PARENT_SCOPE)
  set(CPACK_DEBIAN_${key}_PACKAGE_NAME ${name} PARENT_SCOPE)
  set(CPACK_DEBIAN_${key}_PACKAGE_SECTION ${section} PARENT_SCOPE)
  set(CPACK_DEBIAN_${key}_DESCRIPTION "${summary}" PARENT_SCOPE)
  set(CPACK_COMPONENT_${key}_DESCRIPTION "${summary}" PARENT_SCOPE)
  set(CPACK_DEBIAN_${key}_PACKAGE_DEPENDS "${depends}" PARENT_SCOPE)
  install(FILES cmake/packaging/copyright ${PROJECT_BINARY_DIR}/package/changelog.gz
    DESTINATION ${CMAKE_INSTALL_DATADIR}/doc/${name} COMPONENT ${component})
endfunction()
set(library libquorum${QUORUM_SOVERSION})
set(about "Multi-view stereo: photographs with known cameras to depth maps and a mesh.")
quorum_package(quorum quorum graphics "multi-view stereo with one result on every device\n ${about}" "")
quorum_package(libquorum ${library} libs "multi-view stereo, shared library\n ${about}" "")
quorum_package(libquorum-dev libquorum-dev libdevel "multi-view stereo, headers for C++20\n ${about}"
  "${library} (= ${PROJECT_VERSION})")
quorum_package(quorum-doc quorum-doc doc "multi-view stereo, documents\n ${about}" "")
set(CPACK_DEBIAN_QUORUM_PACKAGE_RECOMMENDS libvulkan1)
set(CPACK_DEBIAN_QUORUM_PACKAGE_SUGGESTS "mesa-vulkan-drivers, colmap, quorum-doc")
set(CPACK_DEBIAN_LIBQUORUM_PACKAGE_RECOMMENDS libvulkan1)
set(CPACK_DEBIAN_LIBQUORUM_PACKAGE_CONTROL_EXTRA ${PROJECT_SOURCE_DIR}/cmake/packaging/triggers)
foreach(key LIBQUORUM-DEV QUORUM-DOC)
  set(CPACK_DEBIAN_${key}_PACKAGE_SHLIBDEPS OFF)
endforeach()
set(CPACK_DEBIAN_QUORUM-DOC_PACKAGE_ARCHITECTURE all)
if(TARGET quorum_python)
  # dpkg-shlibdeps does not know a library that is packed at the same time, so these stand here.
  set(python ${Python3_VERSION_MAJOR}.${Python3_VERSION_MINOR})
  math(EXPR next "${Python3_VERSION_MINOR} + 1")
  quorum_package(python3-quorum python3-quorum python "multi-view stereo, Python module\n ${about}"
    "${library} (= ${PROJECT_VERSION}), python3 (>= ${python}), python3 (<< ${Python3_VERSION_MAJOR}.${next}), python3-numpy, libc6, libgcc-s1, libstdc++6 (>= 12)")
  set(CPACK_DEBIAN_PYTHON3-QUORUM_PACKAGE_SHLIBDEPS OFF)
endif()
include(CPack)
