# How a target of the project is made: its options, its include rules and, for a folder, its library.
include(Folders)

# The rules of cmake/Folders.cmake, checked before anything is compiled, whenever a file has changed.
file(GLOB_RECURSE checked_files CONFIGURE_DEPENDS
  shaders/*.h engine/*.h engine/*.cc host/*.h host/*.cc tools/*.h tools/*.cc tests/*.h tests/*.cc)
add_custom_command(
  OUTPUT ${PROJECT_BINARY_DIR}/includes.stamp
  COMMAND ${CMAKE_COMMAND} -DSTAMP=${PROJECT_BINARY_DIR}/includes.stamp -P ${PROJECT_SOURCE_DIR}/cmake/CheckIncludes.cmake
  DEPENDS ${checked_files} cmake/CheckIncludes.cmake cmake/Folders.cmake
  COMMENT "Checking who includes whom"
  VERBATIM)
add_custom_target(quorum_includes DEPENDS ${PROJECT_BINARY_DIR}/includes.stamp)

# Headers of others that most files include take more time than the files themselves, so they are compiled once. ccache
# does not keep what was compiled with them; with it every file reads its own headers.
if(NOT DEFINED QUORUM_PRECOMPILE AND NOT CMAKE_CXX_COMPILER_LAUNCHER MATCHES "ccache")
  set(QUORUM_PRECOMPILE ON)
endif()
set(precompiled_headers
  <algorithm> <array> <bit> <cmath> <cstdint> <expected> <filesystem> <functional> <limits> <map> <memory> <numbers>
  <optional> <span> <string> <string_view> <utility> <vector>
  <Eigen/Core> <Eigen/Geometry> <Eigen/LU> <fmt/format.h> <oneapi/tbb/parallel_for.h>)

set(warnings -Wall -Wextra -Wpedantic -Wshadow -Wconversion -Wno-sign-conversion
  # Names of other files of a folder, std::stable_sort of GCC's library, and the report's page.
  "$<$<CXX_COMPILER_ID:Clang>:-Wno-shadow;-Wno-deprecated-declarations;-Wno-overlength-strings>")

# Of undefined behavior, what is checked at every use of a pointer took half of the compiler's time where that was measured.
# The folder that reads what others wrote is built to find it for the fuzzers; elsewhere a bad pointer is the address
# sanitizer's to find.
set(searched quorum_io)
set(unsearched -fno-sanitize=null,alignment,vptr,object-size,nonnull-attribute,returns-nonnull-attribute)

# Folders that read no files: their branches lead no fuzzer anywhere, and counting them takes time.
set(unguided quorum quorum_api quorum_bench quorum_conformance quorum_depth quorum_evaluate quorum_experiment quorum_host
  quorum_image quorum_render quorum_report quorum_run quorum_synthetic quorum_texture quorum_volume)

# Options of a target: warnings, and float arithmetic that is never contracted or reordered, since results are compared
# byte by byte (docs/architecture.md, "One result everywhere"). All code can go into the shared library, too (Api.cmake),
# and is compiled once for it and for the program. None of these passes to who links the target. TEST: for code that
# tests; what it spares there is a third of the time of all compilers.
function(quorum_options target)
  cmake_parse_arguments(option "TEST" "" "" ${ARGN})
  target_compile_features(${target} PUBLIC cxx_std_23)
  target_include_directories(${target} PUBLIC ${PROJECT_SOURCE_DIR})
  target_link_libraries(${target} PUBLIC Eigen3::Eigen fmt::fmt)  # what headers of the engine show
  # Eigen's vector code fuses multiplications with additions where it can (NEON, FMA), and adds in an order of its own.
  target_compile_definitions(${target} PUBLIC EIGEN_DONT_VECTORIZE)
  target_compile_options(${target} PRIVATE
    ${warnings} -ffp-contract=off -fno-math-errno -fno-trapping-math $<$<BOOL:${QUORUM_WERROR}>:-Werror>
    -fPIC -fvisibility=hidden -fvisibility-inlines-hidden)
  if(QUORUM_FUZZ AND NOT option_TEST AND NOT target IN_LIST unguided)
    target_compile_options(${target} PRIVATE -fsanitize-coverage=inline-8bit-counters,pc-table,trace-cmp)
  endif()
  if(QUORUM_SANITIZE)
    target_compile_options(${target} PRIVATE
      -fsanitize=address -fno-omit-frame-pointer
      $<$<NOT:$<BOOL:${option_TEST}>>:-fsanitize=undefined -fno-sanitize-recover=undefined>
      # GCC 12 finds this in the standard library where the sanitizers have added code.
      $<$<CXX_COMPILER_ID:GNU>:-Wno-maybe-uninitialized>)
    if(NOT option_TEST AND NOT (QUORUM_FUZZ AND target IN_LIST searched))
      target_compile_options(${target} PRIVATE ${unsearched})
    endif()
    target_link_options(${target} PUBLIC -fsanitize=address,undefined)
  endif()
  set(first quorum_core)  # of those that share its compiled headers
  set(headers ${precompiled_headers})
  if(option_TEST)
    # Where so little is optimized, GCC 12 finds these in the standard library's strings.
    target_compile_options(${target} PRIVATE
      $<$<CONFIG:Release>:-O1>
      "$<$<CXX_COMPILER_ID:GNU>:-Wno-array-bounds;-Wno-stringop-overflow;-Wno-stringop-overread;-Wno-restrict>")
    set(first quorum_test_support)
    list(APPEND headers <gtest/gtest.h>)
  endif()
  add_dependencies(${target} quorum_includes)
  if(QUORUM_PRECOMPILE AND target STREQUAL first)
    target_precompile_headers(${target} PRIVATE ${headers})
  elseif(QUORUM_PRECOMPILE)
    target_precompile_headers(${target} REUSE_FROM ${first})
  endif()
endfunction()

# Links a target with what stands in its folder's line of cmake/Folders.cmake: folders publicly, packages privately.
function(quorum_link target folder)
  foreach(row IN LISTS QUORUM_FOLDERS)
    quorum_read_row(row "${row}")
    if(row_name STREQUAL folder)
      break()
    endif()
  endforeach()
  foreach(name IN LISTS row_first)
    cmake_path(GET name FILENAME library)
    if(TARGET quorum_${library})  # the shaders have none, nor has the host without Vulkan
      target_link_libraries(${target} PUBLIC quorum_${library})
    endif()
  endforeach()
  foreach(package_row IN LISTS QUORUM_PACKAGES)
    quorum_read_row(package "${package_row}")
    if(package_name IN_LIST row_second)
      target_link_libraries(${target} PRIVATE ${package_first})
    endif()
  endforeach()
endfunction()

# Files of a folder are compiled eight at a time, since what they include takes longer than they do. So names in anonymous
# namespaces differ within a folder. A file that takes long by itself stays alone, so that others go on beside it.
set(slow_files engine/depth/sweep_tile.cc)

# Makes <target>, the library of a folder.
function(quorum_library target folder)
  file(GLOB sources CONFIGURE_DEPENDS ${folder}/*.cc)
  add_library(${target} STATIC ${sources})
  set_target_properties(${target} PROPERTIES UNITY_BUILD ON)
  set_source_files_properties(${slow_files} PROPERTIES SKIP_UNITY_BUILD_INCLUSION ON)
  quorum_options(${target})
  quorum_link(${target} ${folder})
endfunction()
