// Boxes that don't fit the object, and photographs without a background or of nothing else: the surface is the true
// one, and there is none on the faces of the box.
#include <array>
#include <fstream>
#include <sstream>

#include "engine/evaluate/distance.h"
#include "engine/io/image_file.h"
#include "engine/io/ply.h"
#include "engine/io/write_image.h"
#include "tests/tools/tool_test.h"

namespace quorum {
namespace {

struct Box {
  Eigen::Vector3d low;
  Eigen::Vector3d high;
};

const Box kTight = {{-0.05, 0, -0.0375}, {0.05, 0.16, 0.0375}};
constexpr double kNear = 0.003;  // three voxels and more

/// The temple, and what a run makes of it in a box.
class Bounds : public ToolTest {
 protected:
  void SetUp() override {
    synthesize(16, 240);
    truth_ = read_ply(scene() / "gt.ply").value();
  }

  /// Without a mesh, if the run says that there is no surface.
  Mesh reconstruct(const Box& box) {
    std::vector<std::string> arguments = {"reconstruct", scene().string(), "-o",      below("out").string(), "--device",
                                          "cpu",         "--quiet",        "--bounds"};
    for (const Eigen::Vector3d& corner : {box.low, box.high})
      for (const double value : corner) arguments.push_back(std::to_string(value));
    const ProgramResult result = quorum_program(arguments);
    if (result.exit_code == 3 && contains(result.err, "the mesh is empty")) return {};
    EXPECT_EQ(result.exit_code, 0) << result.err;
    return read_ply(below("out") / "mesh.ply").value();
  }

  [[nodiscard]] std::vector<double> distances(const Mesh& mesh) const {
    std::vector<Eigen::Vector3d> points;
    for (const Vertex& vertex : mesh.vertices) points.push_back(vertex.position.cast<double>());
    return SurfaceDistance::build(truth_).value().to(points);
  }

  /// Share of vertices that lie near the true surface.
  [[nodiscard]] double right_share(const Mesh& mesh) const {
    const std::vector<double> all = distances(mesh);
    return static_cast<double>(std::ranges::count_if(all, [](double distance) { return distance < kNear; })) /
           static_cast<double>(all.size());
  }

  /// Vertices that lie on a face of the box, along it, where nothing is.
  [[nodiscard]] std::int64_t made_up(const Mesh& mesh, const Box& box) const {
    constexpr float kAlong = 0.8F;
    const std::vector<double> all = distances(mesh);
    std::int64_t count = 0;
    for (std::size_t i = 0; i < all.size(); ++i) {
      const Vertex& vertex = mesh.vertices[i];
      for (int axis = 0; axis < 3; ++axis) {
        const auto place = static_cast<double>(vertex.position[axis]);
        const bool on_face = std::min(std::abs(place - box.low[axis]), std::abs(box.high[axis] - place)) < kNear;
        count += on_face && std::abs(vertex.normal[axis]) > kAlong && all[i] > kNear ? 1 : 0;
      }
    }
    return count;
  }

 private:
  Mesh truth_;
};

TEST_F(Bounds, MayHoldTheCameras) {
  const Box box{{-0.9, -0.9, -0.9}, {0.9, 0.9, 0.9}};  // the cameras are 0.66 away
  const Mesh mesh = reconstruct(box);
  const Mesh tight = reconstruct(kTight);
  EXPECT_GT(mesh.vertices.size(), tight.vertices.size() / 2);
  EXPECT_GT(right_share(mesh), 0.97);
  EXPECT_EQ(made_up(mesh, box), 0);
  EXPECT_EQ(made_up(tight, kTight), 0);
}

TEST_F(Bounds, MayBeFarLargerThanTheObject) {
  const Box box{{-3, -3, -3}, {3, 3, 3}};
  const Mesh mesh = reconstruct(box);
  EXPECT_GT(mesh.vertices.size(), 100U);
  EXPECT_GT(right_share(mesh), 0.97);
  EXPECT_EQ(made_up(mesh, box), 0);
}

TEST_F(Bounds, MayCutTheObject) {
  const Box box{{-0.02, 0.05, -0.0375}, {0.05, 0.1, 0.01}};
  const Mesh mesh = reconstruct(box);
  EXPECT_GT(mesh.vertices.size(), 500U);
  EXPECT_GT(right_share(mesh), 0.97);
  EXPECT_EQ(made_up(mesh, box), 0);
  for (const Vertex& vertex : mesh.vertices) {
    ASSERT_TRUE((vertex.position.cast<double>().array() > box.low.array() - kNear).all());
    ASSERT_TRUE((vertex.position.cast<double>().array() < box.high.array() + kNear).all());
  }
}

TEST_F(Bounds, WhereNothingIsThereIsNoSurface) {
  const Mesh inside = reconstruct({{-0.004, 0.07, -0.004}, {0.004, 0.09, 0.004}});
  EXPECT_EQ(inside.vertices.size(), 0U) << "between the columns";
  const Box beside{{0.1, 0, -0.0375}, {0.2, 0.16, 0.0375}};
  const Mesh background = reconstruct(beside);
  EXPECT_LT(background.vertices.size(), 200U);
  EXPECT_EQ(made_up(background, beside), 0);
}

TEST_F(Bounds, PhotographsMayHaveNoBackground) {
  // The middle of each: no border of the object, and no background but between the columns.
  constexpr int kWidth = 80;
  constexpr int kHeight = 72;
  std::ifstream file(scene() / "temple_par.txt");
  std::string cameras;
  for (std::string line; std::getline(file, line);) {
    std::istringstream text(line);
    std::vector<std::string> fields{std::istream_iterator<std::string>(text), {}};
    if (fields.size() > 6) {
      const std::filesystem::path path = scene() / fields[0];
      const ColorImage whole = read_image(path).value();
      const int left = (whole.width - kWidth) / 2;
      const int top = (whole.height - kHeight) / 2;
      ColorImage middle(kWidth, kHeight);
      for (int y = 0; y < kHeight; ++y)
        for (int x = 0; x < kWidth; ++x) middle.at(x, y) = whole.at(left + x, top + y);
      ASSERT_TRUE(write_image(path, middle));
      fields[3] = std::to_string(std::stod(fields[3]) - left);
      fields[6] = std::to_string(std::stod(fields[6]) - top);
    }
    for (const std::string& field : fields) cameras += field + " ";
    cameras += "\n";
  }
  write_text(scene() / "temple_par.txt", cameras);
  const Mesh mesh = reconstruct(kTight);
  EXPECT_GT(mesh.vertices.size(), 1000U);
  EXPECT_GT(right_share(mesh), 0.95);
  EXPECT_EQ(made_up(mesh, kTight), 0);
}

}  // namespace
}  // namespace quorum
