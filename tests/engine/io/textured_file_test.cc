#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "engine/io/file.h"
#include "engine/io/glb.h"
#include "engine/io/mesh_file.h"
#include "tests/support/test_support.h"

namespace quorum {
namespace {

/// Two triangles on a page, one on another, and one that nothing shows.
TexturedMesh four_triangles() {
  TexturedMesh mesh;
  for (int i = 0; i < 12; ++i) {
    Vertex vertex;
    vertex.position = Eigen::Vector3f(static_cast<float>(i), static_cast<float>(i * i % 7), 0.25F);
    vertex.normal = Eigen::Vector3f::UnitZ();
    vertex.color = make_rgb(10, 128, 250);
    vertex.confidence = static_cast<float>(i) / 8;
    mesh.mesh.vertices.push_back(vertex);
    mesh.coordinates.emplace_back(static_cast<float>(i) / 16, 0.75F);
  }
  mesh.mesh.triangles = {{0, 1, 2}, {3, 4, 5}, {6, 7, 8}, {9, 10, 11}};
  mesh.first_triangles = {0, 2, 3, 4};
  mesh.first_vertices = {0, 6, 9, 12};
  mesh.pages = {ColorImage(4, 3, make_rgb(200, 30, 7)), ColorImage(5, 5, make_rgb(0, 0, 90))};
  mesh.pages[0].at(2, 1) = make_rgb(1, 2, 3);
  return mesh;
}

class TexturedFile : public testing::Test {
 protected:
  std::filesystem::path write(const std::string& name, const TexturedMesh& mesh, std::string_view ending = ".png") {
    const auto path = folder_.path() / name;
    const auto done = write_textured(path, mesh, ending);
    EXPECT_TRUE(done) << done.error().message;
    return path;
  }
  TemporaryFolder folder_;
};

TEST_F(TexturedFile, GlbComesBackAsItWas) {
  TexturedMesh mesh = four_triangles();
  mesh.mesh.offset = {500000, 5400000, 250};
  const auto read = read_glb(write("mesh.glb", mesh));
  ASSERT_TRUE(read) << read.error().message;
  EXPECT_EQ(read->pages, mesh.pages);
  EXPECT_EQ(read->coordinates[4], mesh.coordinates[4]);
  EXPECT_EQ(read->mesh.triangles, mesh.mesh.triangles);
  EXPECT_EQ(read->first_triangles, mesh.first_triangles);
  EXPECT_EQ(read->first_vertices, mesh.first_vertices);
  EXPECT_EQ(read->unseen_triangles(), 1U);
  EXPECT_EQ(read->mesh.offset, mesh.mesh.offset);
  for (std::size_t v = 0; v < mesh.mesh.vertices.size(); ++v) {
    EXPECT_EQ(read->mesh.vertices[v].position, mesh.mesh.vertices[v].position);
    EXPECT_EQ(read->mesh.vertices[v].confidence, mesh.mesh.vertices[v].confidence);
  }
  EXPECT_EQ(read->mesh.vertices[10].color, make_rgb(10, 128, 250));
}

TEST_F(TexturedFile, GlbMarksWhatNoPhotographShows) {
  const std::string bytes = read_file(write("mesh.glb", four_triangles(), ".jpg")).value();
  std::uint32_t size = 0;
  std::memcpy(&size, bytes.data() + 12, 4);
  const auto json = nlohmann::json::parse(bytes.substr(20, size));
  const auto& primitives = json["meshes"][0]["primitives"];
  ASSERT_EQ(primitives.size(), 3U);
  EXPECT_TRUE(primitives[0]["attributes"].contains("TEXCOORD_0"));
  EXPECT_FALSE(primitives[0]["attributes"].contains("COLOR_0"));  // viewers multiply the page by it
  EXPECT_TRUE(primitives[0]["attributes"].contains("_CONFIDENCE"));
  EXPECT_TRUE(primitives[2]["attributes"].contains("COLOR_0"));
  EXPECT_EQ(json["materials"][primitives[2]["material"].get<int>()]["name"], "unseen");
  EXPECT_EQ(json["images"][0]["mimeType"], "image/jpeg");
}

TEST_F(TexturedFile, AGlbOfVertexColorsIsReadToo) {
  const Mesh mesh = four_triangles().mesh;
  ASSERT_TRUE(write_mesh(folder_.path() / "colors.glb", mesh));
  const auto read = read_glb(folder_.path() / "colors.glb");
  ASSERT_TRUE(read) << read.error().message;
  EXPECT_TRUE(read->pages.empty());
  EXPECT_EQ(read->mesh.triangles.size(), mesh.triangles.size());
  EXPECT_EQ(read->mesh.vertices[0].color, make_rgb(10, 128, 250));
}

TEST_F(TexturedFile, ObjNamesItsPagesAndCountsFromTheBottom) {
  const auto path = write("mesh.obj", four_triangles());
  const std::string text = read_file(path).value();
  EXPECT_NE(text.find("mtllib mesh.mtl\n"), std::string::npos);
  EXPECT_NE(text.find("vt 0.0625 0.25\n"), std::string::npos);
  EXPECT_NE(text.find("usemtl page2\nf 7/7/7 8/8/8 9/9/9\nusemtl unseen\nf 10/10/10"), std::string::npos) << text;
  const std::string materials = read_file(folder_.path() / "mesh.mtl").value();
  EXPECT_NE(materials.find("newmtl page1\n"), std::string::npos);
  EXPECT_NE(materials.find("map_Kd mesh-2.png\n"), std::string::npos);
  EXPECT_TRUE(std::filesystem::exists(folder_.path() / "mesh-1.png"));
  EXPECT_EQ(write_textured(folder_.path() / "mesh.ply", four_triangles(), ".png").error().kind, ErrorKind::kUsage);
}

TEST_F(TexturedFile, DamagedGlbIsRefusedInALine) {
  const std::string bytes = read_file(write("mesh.glb", four_triangles())).value();
  const auto path = folder_.path() / "damaged.glb";
  for (std::size_t size = 0; size < bytes.size(); size += 1 + size / 4) {
    ASSERT_TRUE(write_file(path, bytes.substr(0, size)));
    const auto read = read_glb(path);
    ASSERT_FALSE(read) << size;
    EXPECT_NE(read.error().message.find("damaged.glb"), std::string::npos);
  }
  for (std::size_t at = 20; at < bytes.size(); at += 151) {
    std::string damaged = bytes;
    damaged[at] = static_cast<char>(damaged[at] ^ 0x15);
    ASSERT_TRUE(write_file(path, damaged));
    static_cast<void>(read_glb(path));  // whatever it says, it does not end the process
  }
}

TEST_F(TexturedFile, AnImageBeyondTheFileIsRefused) {
  std::string bytes = read_file(write("mesh.glb", four_triangles())).value();
  std::uint32_t size = 0;
  std::memcpy(&size, bytes.data() + 12, 4);
  auto json = nlohmann::json::parse(bytes.substr(20, size));
  json["bufferViews"][json["images"][0]["bufferView"].get<std::size_t>()]["byteOffset"] = 1'000'000'000;
  std::string text = json.dump();
  text.resize((text.size() + 3) / 4 * 4, ' ');
  bytes.replace(20, size, text);
  const std::array<std::uint32_t, 2> sizes = {static_cast<std::uint32_t>(bytes.size()),
                                              static_cast<std::uint32_t>(text.size())};
  std::memcpy(bytes.data() + 8, sizes.data(), sizeof(sizes));
  ASSERT_TRUE(write_file(folder_.path() / "beyond.glb", bytes));
  const auto read = read_glb(folder_.path() / "beyond.glb");
  ASSERT_FALSE(read);
  EXPECT_NE(read.error().message.find("beyond.glb: is not as Quorum writes it"), std::string::npos)
      << read.error().message;
}

TEST_F(TexturedFile, NumbersThatNoModelOfOursHoldsAreRefused) {
  constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
  const std::vector<void (*)(TexturedMesh&)> faults = {
      [](TexturedMesh& mesh) { mesh.coordinates[1].x() = kNan; },
      [](TexturedMesh& mesh) { mesh.coordinates[1].y() = 2; },
      [](TexturedMesh& mesh) { mesh.mesh.vertices[1].confidence = kNan; },
      [](TexturedMesh& mesh) { mesh.mesh.vertices[1].confidence = -1; }};
  for (std::size_t i = 0; i < faults.size(); ++i) {
    TexturedMesh mesh = four_triangles();
    faults[i](mesh);
    const auto read = read_glb(write("odd.glb", mesh));
    ASSERT_FALSE(read) << i;
    EXPECT_NE(read.error().message.find("odd.glb: is not as Quorum writes it"), std::string::npos) << i;
  }
}

}  // namespace
}  // namespace quorum
