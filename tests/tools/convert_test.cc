// quorum convert --with-depth: the maps of a run beside a scene, for programs that start from them.
#include <cstring>
#include <nlohmann/json.hpp>

#include "engine/io/pfm.h"
#include "tests/tools/tool_test.h"

namespace quorum {
namespace {

/// The numbers of a NumPy file, whose text must hold this shape.
std::vector<float> npy_values(const std::filesystem::path& path, const std::string& shape) {
  const std::string bytes = file_bytes(path);
  EXPECT_TRUE(bytes.starts_with(std::string("\x93NUMPY\x01\x00", 8))) << path;
  const std::size_t first = 10U + static_cast<unsigned char>(bytes[8]) + 256U * static_cast<unsigned char>(bytes[9]);
  EXPECT_EQ(first % 64, 0U);
  EXPECT_EQ(bytes[first - 1], '\n');
  const std::string text = bytes.substr(10, first - 10);
  EXPECT_TRUE(contains(text, "{'descr': '<f4', 'fortran_order': False, 'shape': (" + shape + "), }")) << text;
  std::vector<float> values((bytes.size() - first) / sizeof(float));
  std::memcpy(values.data(), bytes.data() + first, values.size() * sizeof(float));
  return values;
}

class ConvertWithDepth : public ToolTest {
 protected:
  void SetUp() override {
    synthesize(6, 96);
    std::vector<std::string> run = {"reconstruct", scene().string(), "-o", below("run").string(), "--device", "cpu"};
    run.insert(run.end(), kKeepAll.begin(), kKeepAll.end());
    ASSERT_EQ(quorum_program(run).exit_code, 0);
  }
  [[nodiscard]] ProgramResult convert(const std::string& format, const std::string& workspace) const {
    return quorum_program({"convert", scene().string(), "--to", format, "--with-depth", below(workspace).string(), "-o",
                           below("out").string()});
  }
};

TEST_F(ConvertWithDepth, MapsStandBesideTheFrames) {
  std::filesystem::remove(below("run/depth/temple0006.depth.json"));  // a view that has none
  const ProgramResult done = convert("nerfstudio", "run");
  ASSERT_EQ(done.exit_code, 0) << done.err;
  const auto frames = nlohmann::json::parse(file_bytes(below("out/transforms.json")))["frames"];
  ASSERT_EQ(frames.size(), 6U);
  EXPECT_EQ(frames[1]["file_path"], "images/temple0002.png");
  EXPECT_EQ(frames[1]["depth_file_path"], "depths/temple0002.png.npy");
  EXPECT_FALSE(frames[5].contains("depth_file_path"));
  const Grid<float> depth = read_pfm(below("run/depth/temple0002.depth.pfm")).value();
  const auto written = npy_values(below("out") / frames[1]["depth_file_path"].get<std::string>(), "72, 96");
  ASSERT_EQ(written.size(), depth.values.size());
  int valid = 0;
  for (std::size_t i = 0; i < written.size(); ++i) {
    EXPECT_EQ(written[i], depth.values[i] * 1000.0F);
    valid += written[i] > 0 ? 1 : 0;
  }
  EXPECT_GT(valid, 50);
  const auto certainty = npy_values(below("out") / frames[1]["certainty_file_path"].get<std::string>(), "72, 96");
  EXPECT_EQ(certainty, read_pfm(below("run/depth/temple0002.certainty.pfm")).value().values);
  const auto normals = npy_values(below("out") / frames[1]["normal_file_path"].get<std::string>(), "72, 96, 3");
  const auto normal = read_pfm_vectors(below("run/depth/temple0002.normal.pfm")).value();
  ASSERT_EQ(normals.size(), 3 * normal.values.size());
  for (std::size_t i = 0; i < normal.values.size(); ++i) EXPECT_EQ(normals[3 * i + 2], normal.values[i].z());
  const ProgramResult read = quorum_program({"plan", below("out").string()});  // it is a scene
  EXPECT_EQ(read.exit_code, 0) << read.err;
}

TEST_F(ConvertWithDepth, OtherFormatsAndOtherFoldersAreRefused) {
  expect_failure(convert("colmap", "run"), 2, {"--with-depth", "nerfstudio"});
  expect_failure(convert("nerfstudio", "absent"), 3, {"absent: holds no depth map of a view of this scene"});
  EXPECT_FALSE(std::filesystem::exists(below("out")));
}

}  // namespace
}  // namespace quorum
