#include "engine/io/ply.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cstring>

#include "engine/io/file.h"
#include "tests/engine/io/io_test.h"
#include "tests/support/test_support.h"

namespace quorum {
namespace {

using Triangle = std::array<std::uint32_t, 3>;

class PlyTest : public testing::Test {
 protected:
  Expected<Mesh> read_text(const std::string& text) {
    std::filesystem::remove(path_);  // some file systems flush a file that is overwritten, which takes milliseconds
    write_text(path_, text);
    return read_ply(path_);
  }

  TemporaryFolder folder_;
  std::filesystem::path path_ = folder_.path() / "m.ply";
};

using Ply = PlyTest;

Mesh tetrahedron() {
  Mesh mesh;
  for (int i = 0; i < 4; ++i) {
    Vertex vertex;
    vertex.position = Eigen::Vector3f(i == 1, i == 2, i == 3) * 0.1F;
    vertex.normal = Eigen::Vector3f(0.0F, 0.6F, -0.8F);
    vertex.color = make_rgb(i, 100 + i, 255 - i);
    vertex.confidence = 0.25F * static_cast<float>(i);
    mesh.vertices.push_back(vertex);
  }
  mesh.triangles = {{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}};
  return mesh;
}

void expect_same(const Mesh& a, const Mesh& b) {
  EXPECT_EQ(a.triangles, b.triangles);
  ASSERT_EQ(a.vertices.size(), b.vertices.size());
  for (std::size_t i = 0; i < a.vertices.size(); ++i) {
    EXPECT_EQ(a.vertices[i].position, b.vertices[i].position) << i;
    EXPECT_EQ(a.vertices[i].normal, b.vertices[i].normal) << i;
    EXPECT_EQ(a.vertices[i].color, b.vertices[i].color) << i;
    EXPECT_EQ(a.vertices[i].confidence, b.vertices[i].confidence) << i;
  }
}

/// Bytes of numbers, in either byte order.
class Bytes {
 public:
  explicit Bytes(bool big_endian) : big_endian_(big_endian) {}
  template <typename T>
  Bytes& add(T value) {
    std::array<char, sizeof(T)> raw;
    std::memcpy(raw.data(), &value, sizeof(T));
    if (big_endian_) std::ranges::reverse(raw);
    text.append(raw.data(), raw.size());
    return *this;
  }
  std::string text;

 private:
  bool big_endian_;
};

constexpr const char* kSquareHeader =
    "element vertex 4\nproperty float x\nproperty float y\nproperty float z\n"
    "element face 1\nproperty list uchar int vertex_indices\nend_header\n";
const std::string kAsciiSquare =
    std::string("ply\nformat ascii 1.0\n") + kSquareHeader + "0 0 0\n1 0 0\n1 1 0\n0 1 0\n4 0 1 2 3\n";

TEST_F(Ply, ReadsBackWhatWasWritten) {
  ASSERT_TRUE(write_ply(path_, tetrahedron()));
  expect_same(read_ply(path_).value(), tetrahedron());
}

TEST_F(Ply, EmptyMeshAndCloudsReadBack) {
  Mesh one_point;
  one_point.vertices.resize(1);
  Mesh cloud = tetrahedron();
  cloud.triangles.clear();
  for (const Mesh& mesh : {Mesh(), one_point, cloud}) {
    ASSERT_TRUE(write_ply(path_, mesh));
    EXPECT_EQ(read_file(path_)->find("element face"), std::string::npos);
    expect_same(read_ply(path_).value(), mesh);
  }
}

TEST_F(Ply, WritesTheLayoutThatIsPromised) {
  ASSERT_TRUE(write_ply(path_, tetrahedron()));
  const std::string bytes = read_file(path_).value();
  const std::string header =
      "ply\nformat binary_little_endian 1.0\nelement vertex 4\nproperty float x\nproperty float y\nproperty float z\n"
      "property float nx\nproperty float ny\nproperty float nz\nproperty uchar red\nproperty uchar green\n"
      "property uchar blue\nproperty float confidence\nproperty float quality\nelement face 4\n"
      "property list uchar int vertex_indices\nend_header\n";
  ASSERT_EQ(bytes.substr(0, header.size()), header);
  EXPECT_EQ(bytes.size(), header.size() + 4 * 35 + 4 * 13);
  const std::string second = bytes.substr(header.size() + 35, 35);
  EXPECT_EQ(second.substr(24, 3), "\x01\x65\xfe");
  EXPECT_EQ(second.substr(27, 4), second.substr(31, 4));
}

TEST_F(Ply, ReadsAsciiAndBothByteOrders) {
  const Mesh from_ascii = read_text(kAsciiSquare).value();
  ASSERT_EQ(from_ascii.vertices.size(), 4U);
  EXPECT_EQ(from_ascii.vertices[2].position, Eigen::Vector3f(1, 1, 0));
  EXPECT_EQ(from_ascii.triangles, (std::vector<Triangle>{{0, 1, 2}, {0, 2, 3}}));
  for (const bool big_endian : {false, true}) {
    Bytes body(big_endian);
    for (const auto& vertex : from_ascii.vertices)
      for (const float value : vertex.position) body.add(value);
    body.add(std::uint8_t{4});
    for (int i = 0; i < 4; ++i) body.add(i);
    const auto mesh = read_text(std::string("ply\nformat binary_") + (big_endian ? "big" : "little") + "_endian 1.0\n" +
                                kSquareHeader + body.text);
    ASSERT_TRUE(mesh) << mesh.error().message;
    expect_same(*mesh, from_ascii);
  }
}

TEST_F(Ply, ReadsEveryScalarTypeInAnyOrderAndSkipsTheRest) {
  for (const bool big_endian : {false, true}) {
    Bytes body(big_endian);
    body.add(std::uint16_t{2}).add(1.0).add(2.0).add(std::int8_t{-1});                            // element extra
    body.add(std::int16_t{-300}).add(std::uint8_t{1}).add(7.0F).add(std::uint32_t{4000000000U});  // y, list, z
    body.add(std::int8_t{-5}).add(0.5F).add(0.25);                                                // x, quality, unknown
    body.add(std::int32_t{3}).add(std::uint16_t{0}).add(std::uint16_t{0}).add(std::uint16_t{0}).add(std::uint8_t{9});
    const auto mesh = read_text(std::string("ply\r\nformat binary_") + (big_endian ? "big" : "little") +
                                "_endian 1.0\r\ncomment any words at all\r\nobj_info 1\r\n"
                                "element extra 1\r\nproperty list uint16 float64 a\r\nproperty int8 b\r\n"
                                "element vertex 1\r\nproperty short y\r\nproperty list uint8 float32 l\r\n"
                                "property uint z\r\nproperty char x\r\nproperty float quality\r\nproperty double u\r\n"
                                "element face 1\r\nproperty list int32 ushort vertex_index\r\nproperty uchar flag\r\n"
                                "end_header\r\n" +
                                body.text);
    ASSERT_TRUE(mesh) << mesh.error().message;
    EXPECT_EQ(mesh->vertices.at(0).position, Eigen::Vector3f(-5.0F, -300.0F, 4e9F));
    EXPECT_EQ(mesh->vertices.at(0).confidence, 0.5F);
    EXPECT_EQ(mesh->vertices.at(0).color, make_rgb(128, 128, 128));
    EXPECT_EQ(mesh->triangles, (std::vector<Triangle>{{0, 0, 0}}));
  }
}

TEST_F(Ply, ConfidenceGoesBeforeQualityAndRealColorsAreScaled) {
  const auto mesh = read_text(
      "ply\nformat ascii 1.0\nelement vertex 2\nproperty float quality\nproperty float confidence\nproperty float x\n"
      "property float y\nproperty float z\nproperty float red\nproperty float green\nproperty float blue\n"
      "property float nx\nproperty float ny\nproperty float nz\nend_header\n"
      "1 2 0 0 0 0 0.5 1 0 0 1\n\n1 nan 0 0 0 -1 7 nan nan 0 0\n");
  ASSERT_TRUE(mesh) << mesh.error().message;
  EXPECT_EQ(mesh->vertices[0].confidence, 2.0F);
  EXPECT_EQ(mesh->vertices[0].color, make_rgb(0, 128, 255));
  EXPECT_EQ(mesh->vertices[0].normal, Eigen::Vector3f(0, 0, 1));
  EXPECT_EQ(mesh->vertices[1].confidence, 0.0F);
  EXPECT_EQ(mesh->vertices[1].color, make_rgb(0, 255, 0));
  EXPECT_EQ(mesh->vertices[1].normal, Eigen::Vector3f(0, 0, 0));
}

TEST_F(Ply, FacesMayComeFirst) {
  const auto mesh = read_text(
      "ply\nformat ascii 1.0\nelement face 1\nproperty list uchar int vertex_indices\nelement vertex 3\n"
      "property float x\nproperty float y\nproperty float z\nend_header\n3 0 1 2\n0 0 0\n1 0 0\n0 1 0\n");
  ASSERT_TRUE(mesh) << mesh.error().message;
  EXPECT_EQ(mesh->triangles, (std::vector<Triangle>{{0, 1, 2}}));
}

TEST_F(Ply, MalformedHeaderIsNamedWithItsLine) {
  const auto with_header = [](const std::string& lines) { return "ply\n" + lines; };
  const std::string xyz = "property float x\nproperty float y\nproperty float z\n";
  const std::string ascii = "format ascii 1.0\n";
  expect_bad_input(read_text(""), {"m.ply:1: expected ply"});
  expect_bad_input(read_text("solid\n"), {"m.ply:1: expected ply"});
  expect_bad_input(read_text("ply\n"), {"m.ply:1: the header has no end_header"});
  expect_bad_input(read_text(with_header("format ascii 2.0\n")), {"m.ply:2: expected \"format KIND 1.0\""});
  expect_bad_input(read_text(with_header("format text 1.0\n")), {"m.ply:2: unknown format \"text\""});
  expect_bad_input(read_text(with_header("element vertex 0\n" + xyz + "end_header\n")), {"m.ply:6:", "no format"});
  expect_bad_input(read_text(with_header(ascii + "elements vertex 1\n")), {"m.ply:3: unknown keyword \"elements\""});
  expect_bad_input(read_text(with_header(ascii + "\n")), {"m.ply:3: unknown keyword \"\""});
  for (const char* count : {"", " -1", " 1.5", " x", " 99999999999999999999", " 1 2"})
    expect_bad_input(read_text(with_header(ascii + "element vertex" + count + "\n")), {"m.ply:3: expected \"element"});
  expect_bad_input(read_text(with_header(ascii + "property float x\n")), {"m.ply:3: a property before any element"});
  const std::string vertex = ascii + "element vertex 1\n";
  expect_bad_input(read_text(with_header(vertex + "property half x\n")), {"m.ply:4: unknown type \"half\""});
  expect_bad_input(read_text(with_header(vertex + "property float\n")), {"m.ply:4: expected \"property TYPE NAME\""});
  expect_bad_input(read_text(with_header(vertex + "property list float int x\n")),
                   {"m.ply:4:", "integer type", "\"float\""});
  expect_bad_input(read_text(with_header(vertex + "property list uchar big x\n")), {"m.ply:4: unknown type \"big\""});
  expect_bad_input(read_text(with_header(vertex + "property float x\nproperty int x\n")),
                   {"m.ply:5:", "appears twice"});
  expect_bad_input(read_text(with_header(vertex + xyz + "element vertex 1\n")), {"m.ply:7:", "appears twice"});
  expect_bad_input(read_text(with_header(vertex + "end_header\n0\n")), {"m.ply:4:", "has no properties"});
  expect_bad_input(read_text(with_header(ascii + "element face 0\nend_header\n")), {"no element vertex"});
  expect_bad_input(read_text(with_header(vertex + "property float x\nproperty float z\nend_header\n0 0\n")),
                   {"m.ply:6: vertex has no property y"});
  expect_bad_input(read_text(with_header(vertex + xyz + "property list uchar int red\nend_header\n0 0 0 0\n")),
                   {"vertex property red is a list"});
}

std::string replaced(std::string text, const std::string& from, const std::string& to) {
  return text.replace(text.find(from), from.size(), to);
}

TEST_F(Ply, MalformedRowIsNamedWithItsLine) {
  const auto with_face = [](const std::string& face) { return replaced(kAsciiSquare, "4 0 1 2 3\n", face); };
  expect_bad_input(read_text(with_face("4 0 1 2 4\n")), {"m.ply:14: face 0 names vertex 4, but there are 4 vertices"});
  expect_bad_input(read_text(with_face("4 0 1 2 -1\n")), {"m.ply:14: face 0 names vertex -1"});
  expect_bad_input(read_text(with_face("2 0 1\n")), {"m.ply:14: face 0 has 2 corners"});
  expect_bad_input(read_text(with_face("0\n")), {"m.ply:14: face 0 has 0 corners"});
  expect_bad_input(read_text(with_face("4 0 1 2\n")), {"m.ply:14: the row has too few values"});
  expect_bad_input(read_text(with_face("3 0 1 2 3\n")), {"m.ply:14: the row has too many values, from \"3\""});
  expect_bad_input(read_text(with_face("3 0 1 x\n")), {"m.ply:14: \"x\" is not a number"});
  expect_bad_input(read_text(with_face("3 0 1 1.5\n")), {"m.ply:14: \"1.5\" is not of type int"});
  expect_bad_input(read_text(with_face("300 0 1 2\n")), {"m.ply:14: \"300\" is not of type uchar"});
  expect_bad_input(read_text(with_face("-3 0 1 2\n")), {"m.ply:14: \"-3\" is not of type uchar"});
  expect_bad_input(read_text(with_face("3 0 1 2\n1\n")), {"m.ply:15: there are more lines"});
  expect_bad_input(read_text(with_face("\n   \n")), {"m.ply:15: the file ends before the last row"});
  expect_bad_input(read_text(replaced(kAsciiSquare, "1 1 0", "1 nan 0")), {"m.ply:12: the position of vertex 2"});
  expect_bad_input(read_text(replaced(kAsciiSquare, "1 1 0", "1 1e300 0")), {"m.ply:12: the position of vertex 2"});
  expect_bad_input(read_text(replaced(kAsciiSquare, "vertex_indices", "corners")), {"no list vertex_indices"});
  expect_bad_input(read_text(replaced(kAsciiSquare, "list uchar int", "int")), {"no list vertex_indices"});
}

TEST_F(Ply, NegativeListLengthIsRefused) {
  const auto text = replaced(replaced(kAsciiSquare, "list uchar", "list char"), "4 0 1 2 3", "-4 0 1 2 3");
  expect_bad_input(read_text(text), {"m.ply:14: list \"vertex_indices\" has the length -4"});
}

TEST_F(Ply, TruncatedAndOverlongBinaryIsNamedWithItsByte) {
  ASSERT_TRUE(write_ply(path_, tetrahedron()));
  const std::string good = read_file(path_).value();
  expect_bad_input(read_text(good + "abc"), {"m.ply: byte " + std::to_string(good.size()) + ": 3 bytes follow"});
  const std::size_t body = good.find("end_header\n") + 11;
  for (std::size_t size = 0; size < good.size(); ++size)
    expect_bad_input(read_text(good.substr(0, size)), {size < body ? "m.ply:" : "m.ply: byte "});
}

TEST_F(Ply, CountBeyondTheFileIsRefusedBeforeAnyAllocation) {
  for (const char* count : {"100", "4294967295", "1000000000000", "18446744073709551615"}) {
    const std::string more = std::string("vertex ") + count;
    expect_bad_input(read_text(replaced(kAsciiSquare, "vertex 4", more)), {count, "do not fit", "\"vertex\""});
    const std::string faces = std::string("face ") + count;
    expect_bad_input(read_text(replaced(kAsciiSquare, "face 1", faces)), {count, "do not fit", "\"face\""});
    ASSERT_TRUE(write_ply(path_, tetrahedron()));
    const std::string binary = read_file(path_).value();
    expect_bad_input(read_text(replaced(binary, "vertex 4", more)), {count, "do not fit"});
    expect_bad_input(read_text(replaced(binary, "face 4", faces)), {count, "do not fit"});
  }
}

TEST_F(Ply, AbsentFileAndFolderAreNamed) {
  expect_bad_input(read_ply(folder_.path() / "none.ply"), {"none.ply: cannot read"});
  expect_bad_input(write_ply(folder_.path() / "none" / "m.ply", Mesh()), {"none/m.ply: cannot write"});
}

TEST_F(Ply, AnyDamageEndsInAMeshOfTheFilesSizeOrAnError) {
  ASSERT_TRUE(write_ply(path_, tetrahedron()));
  for (const std::string& good : {read_file(path_).value(), kAsciiSquare}) {
    int failures = 0;
    for (std::uint32_t seed = 0; seed < 3000; ++seed) {
      const std::string text = mutate(good, seed);
      const auto mesh = read_text(text);
      failures += mesh ? 0 : 1;
      if (!mesh) continue;
      EXPECT_LE(mesh->vertices.capacity(), text.size()) << "seed " << seed;
      EXPECT_LE(mesh->triangles.capacity(), text.size()) << "seed " << seed;
      for (const Triangle& triangle : mesh->triangles)
        for (const std::uint32_t corner : triangle) ASSERT_LT(corner, mesh->vertices.size()) << "seed " << seed;
    }
    EXPECT_GT(failures, 1000);
    EXPECT_LT(failures, 3000);
  }
}

TEST_F(Ply, ReadsTheGroundTruthOfTheRenderedScenes) {
  if (data_folder().empty()) GTEST_SKIP() << "no data folder";
  for (const char* scene : {"bunnyHemi", "dragonRing"}) {
    const auto mesh = read_ply(data_folder() / scene / "gt.ply");
    ASSERT_TRUE(mesh) << mesh.error().message;
    EXPECT_GT(mesh->vertices.size(), 1000U);
    EXPECT_GT(mesh->triangles.size(), 1000U);
  }
}

TEST_F(Ply, AMeshFarFromTheOriginKeepsItsMicrometers) {
  Mesh mesh = tetrahedron();
  for (Vertex& vertex : mesh.vertices) vertex.position += Eigen::Vector3f(0.000001F, 0, 0);
  mesh.offset = {500000.0, 4600000.0, -150.5};
  for (const PlyFrame frame : {PlyFrame::kWorld, PlyFrame::kLocal}) {
    ASSERT_TRUE(write_ply(path_, mesh, frame));
    const std::string text = read_file(path_).value();
    EXPECT_EQ(text.find("double") != std::string::npos, frame == PlyFrame::kWorld);
    EXPECT_EQ(text.find("comment offset 500000 4600000 -150.5") != std::string::npos, frame == PlyFrame::kLocal);
    const Mesh given = read_ply(path_, mesh.offset).value();
    EXPECT_EQ(given.offset, mesh.offset);
    const Mesh found = read_ply(path_).value();
    EXPECT_LT((found.offset - mesh.offset).norm(), 1.0);
    for (std::size_t i = 0; i < 4; ++i) {
      EXPECT_LT((given.vertices[i].position - mesh.vertices[i].position).norm(), 1e-8F);
      EXPECT_LT((found.offset + found.vertices[i].position.cast<double>() - mesh.offset -
                 mesh.vertices[i].position.cast<double>())
                    .norm(),
                1e-7);
    }
    EXPECT_EQ(given.triangles, mesh.triangles);
    EXPECT_EQ(given.vertices[2].color, mesh.vertices[2].color);
  }
}

TEST_F(Ply, ACommentThatIsNoOffsetIsText) {
  for (const char* comment :
       {"offset", "offset 1 2", "offset 1 2 x", "offset 1 2 nan", "offset 1 2 3 4", "my offset 1 2"})
    EXPECT_EQ(read_text(std::string("ply\nformat ascii 1.0\ncomment ") + comment + "\n" + kSquareHeader +
                        "0 0 0\n1 0 0\n1 1 0\n0 1 0\n4 0 1 2 3\n")
                  .value()
                  .offset,
              Eigen::Vector3d::Zero())
        << comment;
  EXPECT_EQ(read_text(std::string("ply\nformat ascii 1.0\ncomment offset 1 2 3\n") + kSquareHeader +
                      "0 0 0\n1 0 0\n1 1 0\n0 1 0\n4 0 1 2 3\n")
                .value()
                .offset,
            Eigen::Vector3d(1, 2, 3));
}

}  // namespace
}  // namespace quorum
