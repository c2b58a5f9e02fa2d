# Who builds on whom. Two tables, and one reader for both of their users: CMakeLists.txt makes a library of each folder
# and links it with what stands here, and cmake/CheckIncludes.cmake holds every #include against them at each build.

# Packages: name | what is linked | how #include <...> of it begins
set(QUORUM_PACKAGES
  "Eigen   | Eigen3::Eigen                               | Eigen/"
  "fmt     | fmt::fmt                                    | fmt/"
  "TBB     | TBB::tbb                                    | tbb/ oneapi/tbb/"
  "json    | nlohmann_json::nlohmann_json                | nlohmann/"
  "OpenCV  | opencv_core opencv_imgproc opencv_imgcodecs | opencv2/"
  "Embree  | embree                                      | embree3/"
  "Vulkan  | Vulkan::Headers                             | vulkan/"
  "OpenSSL | OpenSSL::Crypto                             | openssl/"
  "meshopt | meshoptimizer::meshoptimizer               | meshoptimizer.h"
  "glTF    | TinyGLTF::TinyGLTF                          | tiny_gltf.h"
  "SPIRV   | ${SPIRV_CROSS_LIBRARY}                      | spirv_cross"
  "pugixml | pugixml::pugixml                            | pugixml"
  "heif    | ${HEIF_LIBRARY}                             | libheif/"
  "JPEG    | JPEG::JPEG                                  | jpeglib.h jerror.h"
  "TIFF    | TIFF::TIFF                                  | tiffio.h"
  "stb     |                                             | stb/"
  "API     | quorum_api                                  | quorum/"
  "pybind  | pybind11::headers                           | pybind11/"
  "CLI11   | CLI11::CLI11                                | CLI/"
  "gtest   | GTest::gtest                                | gtest/")

# Folders, lowest first: name | folders above it in this table that it includes | packages
# "engine" stands for all folders of the engine; within the engine a folder is named without it.
set(QUORUM_FOLDERS
  "shaders            |                                                              |"
  "engine/core        |                                                              | Eigen fmt TBB"
  "engine/camera      | core                                                         | Eigen fmt"
  "engine/image       | shaders core                                                 |"
  "engine/scene       | core camera                                                  | Eigen fmt"
  "engine/depth       | shaders core camera image scene                              | Eigen fmt TBB"
  "engine/volume      | shaders core camera image scene depth                        | Eigen fmt TBB"
  "engine/mesh        | shaders core camera image volume                             | Eigen fmt TBB meshopt"
  "engine/render      | core camera image mesh                                       | Eigen fmt TBB Embree"
  "engine/evaluate    | core camera scene mesh                                       | Eigen fmt TBB Embree"
  "engine/synthetic   | core image scene mesh                                        | Eigen fmt TBB"
  "engine/io          | core camera image scene depth mesh                           | Eigen fmt json OpenCV OpenSSL glTF pugixml heif JPEG TIFF"
  "engine/texture     | core camera image scene mesh io                              | Eigen fmt TBB stb"
  "engine/pipeline    | core camera image scene depth volume mesh synthetic io texture | fmt TBB json"
  "engine/bench       | core io pipeline                                             | fmt json"
  "engine/experiment  | core scene volume mesh render evaluate synthetic io pipeline | fmt json"
  "engine/report      | core camera image scene mesh io texture pipeline             | Eigen fmt json"
  "engine/conformance | core scene synthetic io pipeline                             | fmt json"
  "host               | shaders engine                                               | fmt TBB Vulkan SPIRV"
  "host/run           | engine host                                                  | fmt TBB"
  "host/api           | engine host host/run                                         | fmt API"
  "tools              | engine host host/run                                         | fmt TBB json CLI11"
  "tools/python       |                                                              | API pybind"
  "tests/support      | shaders engine host                                          | Eigen fmt gtest"
  "tests/engine       | shaders engine tests/support                                 | Eigen fmt TBB json gtest heif TIFF"
  "tests/host         | shaders engine host tests/support                            | fmt gtest"
  "tests/parity       | shaders engine host tests/support                            | fmt gtest"
  "tests/tools        | engine tests/support                                         | fmt json gtest"
  "tests/host/api     | engine tests/support tests/tools                             | Eigen fmt gtest json API"
  "tests/fuzz         | engine                                                       | ")

# Reads a row of either table into <out>_name, <out>_first and <out>_second, the last two as lists.
macro(quorum_read_row out row)
  string(REGEX MATCH "^([^|]*)[|]([^|]*)[|]([^|]*)$" _ "${row}")
  string(STRIP "${CMAKE_MATCH_1}" ${out}_name)
  string(REGEX MATCHALL "[^ ]+" ${out}_second "${CMAKE_MATCH_3}")
  string(REGEX MATCH "^([^|]*)[|]([^|]*)[|]" _ "${row}")
  string(REGEX MATCHALL "[^ ]+" ${out}_first "${CMAKE_MATCH_2}")
endmacro()
