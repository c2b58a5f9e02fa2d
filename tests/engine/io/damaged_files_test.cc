// Every file that is read, damaged by chance: it is read or refused on one line, without a crash. The sanitizers watch
// in the debug build. QUORUM_FUZZ_SECONDS: how long to go on, per file; seeds go on from where the last ones ended.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <chrono>
#include <cstdlib>
#include <functional>

#include "engine/io/file.h"
#include "engine/io/middlebury.h"
#include "engine/io/pfm.h"
#include "engine/io/ply.h"
#include "engine/io/scene_folder.h"
#include "tests/engine/io/io_test.h"
#include "tests/support/scene_formats.h"
#include "tests/support/test_support.h"

namespace quorum {
namespace {

namespace fs = std::filesystem;

Expected<void> read_as_scene(const fs::path& folder) {
  const auto scene = read_scene(folder, {});
  if (!scene) return std::unexpected(scene.error());
  EXPECT_TRUE(scene->bounds.valid());
  for (const View& view : scene->views) {
    EXPECT_EQ(camera_defect(view.camera), nullptr);
    for (const int neighbor : view.neighbors) EXPECT_LT(static_cast<std::size_t>(neighbor), scene->views.size());
  }
  for (const SparsePoint& point : scene->points)
    for (const int view : point.views) EXPECT_LT(static_cast<std::size_t>(view), scene->views.size());
  return {};
}

Expected<void> read_as_mesh(const fs::path& path) {
  const auto mesh = read_ply(path);
  if (!mesh) return std::unexpected(mesh.error());
  for (const auto& triangle : mesh->triangles)
    for (const std::uint32_t corner : triangle) EXPECT_LT(corner, mesh->vertices.size());
  return {};
}

template <auto read>
Expected<void> only_read(const fs::path& path) {
  const auto result = read(path);
  if (!result) return std::unexpected(result.error());
  return {};
}

struct DamagedFile {
  const char* name;
  const char* folder;  ///< of a scene, as make_inputs writes it; or the folder of the file
  const char* file;    ///< in it
  Expected<void> (*read)(const fs::path&) = read_as_scene;  ///< takes the scene's folder, others the file
};

void PrintTo(const DamagedFile& file, std::ostream* out) { *out << file.name; }

const DamagedFile kFiles[] = {{"ColmapCamerasBin", "colmap", "sparse/cameras.bin"},
                              {"ColmapImagesBin", "colmap", "sparse/images.bin"},
                              {"ColmapPointsBin", "colmap", "sparse/points3D.bin"},
                              {"ColmapRigsBin", "colmap", "sparse/rigs.bin"},
                              {"ColmapFramesBin", "colmap", "sparse/frames.bin"},
                              {"ColmapCamerasTxt", "text", "sparse/cameras.txt"},
                              {"ColmapImagesTxt", "text", "sparse/images.txt"},
                              {"ColmapPointsTxt", "text", "sparse/points3D.txt"},
                              {"PatchMatchCfg", "colmap", "stereo/patch-match.cfg"},
                              {"MvsnetCamera", "mvsnet", "cams/00000001_cam.txt"},
                              {"MvsnetPairs", "mvsnet", "pair.txt"},
                              {"Transforms", "transforms", "transforms.json"},
                              {"Bundle", "bundler", "bundle.out"},
                              {"BundlerList", "bundler", "list.txt"},
                              {"MiddleburyPar", "middlebury", "tiny_par.txt"},
                              {"MiddleburyReadme", "middlebury", "README.txt"},
                              {"PlyBinary", "files", "binary.ply", read_as_mesh},
                              {"PlyAscii", "files", "ascii.ply", read_as_mesh},
                              {"Pfm", "files", "map.pfm", only_read<read_pfm>},
                              {"Roi", "files", "box.txt", only_read<read_roi>}};

void make_inputs(const fs::path& folder) {
  Scene scene = write_scene_formats(folder, make_colmap_model("PINHOLE"));
  fs::create_directories(folder / "colmap/stereo");
  write_text(folder / "colmap/stereo/patch-match.cfg", "a.png\nc.png, b.png\nb.png\n__auto__, 20\nc.png\n__all__\n");
  for (const char* name : {"rigs.bin", "frames.bin"})
    write_text(folder / "colmap/sparse" / name, std::string(64, '\1'));
  write_colmap_scene(folder / "text", make_colmap_model("OPENCV"));
  for (const char* name : {"cameras.bin", "images.bin", "points3D.bin"}) fs::remove(folder / "text/sparse" / name);
  write_colmap_text(folder / "text/sparse", make_colmap_model("OPENCV"));

  fs::copy(folder / "colmap/images", folder / "middlebury");
  scene.bounds = {{-1, -1, -1}, {1, 1, 1}};
  EXPECT_TRUE(write_middlebury(folder / "middlebury", "tiny", scene));

  fs::create_directories(folder / "files");
  Mesh mesh;
  mesh.vertices.resize(4);
  for (int i = 0; i < 4; ++i) mesh.vertices[static_cast<std::size_t>(i)].position(i % 3) = 0.5F;
  mesh.triangles = {{0, 1, 2}, {1, 2, 3}};
  EXPECT_TRUE(write_ply(folder / "files/binary.ply", mesh));
  write_text(folder / "files/ascii.ply",
             "ply\nformat ascii 1.0\ncomment made by hand\nelement vertex 4\nproperty float x\nproperty float y\n"
             "property float z\nproperty uchar red\nproperty uchar green\nproperty uchar blue\nproperty float quality\n"
             "element face 1\nproperty list uchar int vertex_indices\nend_header\n"
             "0 0 0 255 0 0 1\n1 0 0 255 0 0 0.5\n1 1 0 0 9 0 nan\n0 1 0 8 7 6 1\n4 0 1 2 3\n");
  EXPECT_TRUE(write_pfm(folder / "files/map.pfm", Grid<float>(4, 3, 1.5F)));
  write_text(folder / "files/box.txt", "# a box\n-1 -2 -3\n1 2 3 # end\n");
}

class DamagedFiles : public testing::TestWithParam<DamagedFile> {};

TEST_P(DamagedFiles, AreReadOrRefusedOnOneLine) {
  const DamagedFile& file = GetParam();
  const TemporaryFolder folder;
  make_inputs(folder.path());
  const fs::path target = folder.path() / file.folder / file.file;
  const fs::path input = file.read == read_as_scene ? folder.path() / file.folder : target;
  const auto undamaged = file.read(input);
  ASSERT_TRUE(undamaged) << undamaged.error().message;

  const std::string good = read_file(target).value();
  const char* wanted = std::getenv("QUORUM_FUZZ_SECONDS");
  const double seconds = wanted != nullptr ? std::atof(wanted) : 0.0;
  const auto start = std::chrono::steady_clock::now();
  const auto elapsed = [&] { return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count(); };
  std::uint32_t seed = 0;
  std::uint32_t refused = 0;
  for (; (seed < 200 || elapsed() < seconds) && !HasFailure(); ++seed) {
    fs::remove(target);  // some file systems flush a file that is overwritten, which takes milliseconds
    write_text(target, mutate(good, seed));
    const auto result = file.read(input);
    if (result) continue;
    ++refused;
    EXPECT_EQ(result.error().message.find('\n'), std::string::npos) << "seed " << seed;
    EXPECT_EQ(result.error().kind, ErrorKind::kInput) << "seed " << seed << ": " << result.error().message;
  }
  if (seconds > 0) fmt::print("{}: {} of {} refused\n", file.name, refused, seed);
  const std::string_view name = file.name;
  const bool is_refused = !name.ends_with("RigsBin") && !name.ends_with("FramesBin") && name != "PatchMatchCfg";
  EXPECT_EQ(refused > 0, is_refused);
}

INSTANTIATE_TEST_SUITE_P(AllFormats, DamagedFiles, testing::ValuesIn(kFiles),
                         [](const auto& file) { return std::string(file.param.name); });

}  // namespace
}  // namespace quorum
