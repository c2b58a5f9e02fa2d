#include "engine/io/mesh_file.h"

#include <gtest/gtest.h>

#include <cstring>
#include <nlohmann/json.hpp>

#include "engine/io/file.h"
#include "engine/io/ply.h"
#include "tests/support/test_support.h"

namespace quorum {
namespace {

Mesh tetrahedron_of_colors() {
  Mesh mesh;
  const float corners[4][3] = {{0, 0, 0}, {1, 0, 0}, {0, 2, 0}, {0, 0, -3.3F}};
  for (const auto& corner : corners) {
    Vertex vertex;
    vertex.position = Eigen::Vector3f(corner[0], corner[1], corner[2]);
    vertex.color = make_rgb(255, 188, 0);
    vertex.confidence = 0.5F + corner[0];
    mesh.vertices.push_back(vertex);
  }
  mesh.vertices[1].normal = Eigen::Vector3f(3, 0, 4);
  mesh.triangles = {{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}, {1, 1, 2}};
  return mesh;
}

std::string written(const std::string& name, const Mesh& mesh = tetrahedron_of_colors()) {
  const TemporaryFolder folder;
  const auto done = write_mesh(folder.path() / name, mesh);
  EXPECT_TRUE(done) << done.error().message;
  return read_file(folder.path() / name).value_or("");
}

template <typename T>
T value_at(const std::string& bytes, std::size_t at) {
  T value{};
  if (at + sizeof(T) <= bytes.size()) std::memcpy(&value, bytes.data() + at, sizeof(T));
  return value;
}

/// The two chunks of a GLB file and what its accessors hold.
struct Glb {
  nlohmann::json json;
  std::string data;

  explicit Glb(const std::string& bytes) {
    const auto text_size = value_at<std::uint32_t>(bytes, 12);
    json = nlohmann::json::parse(bytes.substr(20, text_size));
    data = bytes.substr(20 + text_size + 8);
  }
  template <typename T>
  [[nodiscard]] T at(int accessor, std::size_t i) const {
    const auto& view = json["bufferViews"][json["accessors"][accessor]["bufferView"].get<int>()];
    return value_at<T>(data, view.value("byteOffset", 0) + i * sizeof(T));
  }
};

TEST(MeshFile, GlbHoldsPositionsUnitNormalsLinearColorsAndConfidence) {
  const std::string bytes = written("mesh.glb");
  EXPECT_EQ(bytes.substr(0, 4), "glTF");
  EXPECT_EQ(value_at<std::uint32_t>(bytes, 8), bytes.size());
  const Glb glb(bytes);
  const auto& primitive = glb.json["meshes"][0]["primitives"][0];
  const auto accessor = [&](const char* name) { return primitive["attributes"][name].get<int>(); };
  EXPECT_EQ(glb.at<float>(accessor("POSITION"), 3 * 3 + 2), -3.3F);
  EXPECT_EQ(glb.json["accessors"][accessor("POSITION")]["min"][2].get<float>(), -3.3F);
  EXPECT_EQ(glb.json["accessors"][accessor("POSITION")]["max"][1].get<float>(), 2.0F);
  EXPECT_FLOAT_EQ(glb.at<float>(accessor("NORMAL"), 3), 0.6F);
  for (std::size_t i = 0; i < 4; ++i) {
    const auto x = glb.at<float>(accessor("NORMAL"), 3 * i);
    const auto y = glb.at<float>(accessor("NORMAL"), 3 * i + 1);
    const auto z = glb.at<float>(accessor("NORMAL"), 3 * i + 2);
    EXPECT_NEAR(x * x + y * y + z * z, 1, 1e-6) << i;
  }
  EXPECT_EQ(glb.at<std::uint16_t>(accessor("COLOR_0"), 0), 65535);
  EXPECT_EQ(glb.at<std::uint16_t>(accessor("COLOR_0"), 1), 32957);  // ((188 / 255 + 0.055) / 1.055)^2.4 of white
  EXPECT_EQ(glb.at<std::uint16_t>(accessor("COLOR_0"), 2), 0);
  EXPECT_EQ(glb.at<float>(accessor("_CONFIDENCE"), 1), 1.5F);
  EXPECT_EQ(glb.json["accessors"][primitive["indices"].get<int>()]["count"], 12);  // the triangle without area is gone
  EXPECT_EQ(glb.at<std::uint32_t>(primitive["indices"].get<int>(), 1), 2U);
}

TEST(MeshFile, GlbOfACloudHoldsPoints) {
  Mesh cloud = tetrahedron_of_colors();
  cloud.triangles.clear();
  const Glb glb(written("cloud.GLB", cloud));
  EXPECT_EQ(glb.json["meshes"][0]["primitives"][0]["mode"], 0);
  EXPECT_FALSE(glb.json["meshes"][0]["primitives"][0].contains("indices"));
}

TEST(MeshFile, ObjCountsFromOneAndCarriesColors) {
  const std::string text = written("mesh.obj");
  EXPECT_NE(text.find("v 0 0 -3.3 1.0000 0.7373 0.0000\n"), std::string::npos) << text;
  EXPECT_NE(text.find("f 1//1 3//3 2//2\n"), std::string::npos) << text;
  EXPECT_EQ(text.find("f 2//2 2//2"), std::string::npos);
}

TEST(MeshFile, StlHoldsNormalsAndCornersOfTriangles) {
  const std::string bytes = written("mesh.stl");
  ASSERT_EQ(bytes.size(), 84 + 4 * 50U);
  EXPECT_FALSE(bytes.starts_with("solid"));  // which readers take for text
  EXPECT_EQ(value_at<std::uint32_t>(bytes, 80), 4U);
  EXPECT_EQ(value_at<float>(bytes, 84 + 8), -1.0F);           // normal of the first triangle
  EXPECT_EQ(value_at<float>(bytes, 84 + 12 + 12 + 4), 2.0F);  // y of its second corner
}

TEST(MeshFile, WhatLiesFarKeepsItsMillimeters) {
  Mesh mesh = tetrahedron_of_colors();
  mesh.offset = {500000, 5400000, 250};
  EXPECT_NE(written("mesh.obj", mesh).find("v 500001.000000 5400000.000000 250.000000 "), std::string::npos);
  EXPECT_EQ(Glb(written("mesh.glb", mesh)).json["nodes"][0]["translation"], nlohmann::json({500000, 5400000, 250}));
  EXPECT_NE(written("mesh.stl", mesh).find("offset 500000 5400000 250"), std::string::npos);
  const TemporaryFolder folder;
  ASSERT_TRUE(write_mesh(folder.path() / "mesh.ply", mesh));
  const auto read = read_ply(folder.path() / "mesh.ply", mesh.offset);
  ASSERT_TRUE(read);
  EXPECT_EQ(read->vertices[3].position, mesh.vertices[3].position);
}

TEST(MeshFile, OtherEndingsAndWhatAFormatCannotHoldAreRefused) {
  const TemporaryFolder folder;
  for (const char* name : {"mesh.fbx", "mesh", "mesh.ply.gz"}) {
    const auto refused = write_mesh(folder.path() / name, tetrahedron_of_colors());
    ASSERT_FALSE(refused) << name;
    EXPECT_EQ(refused.error().kind, ErrorKind::kUsage);
    EXPECT_NE(refused.error().message.find(".glb"), std::string::npos);
  }
  Mesh cloud = tetrahedron_of_colors();
  cloud.triangles.clear();
  EXPECT_FALSE(write_mesh(folder.path() / "cloud.stl", cloud));
  EXPECT_FALSE(write_mesh(folder.path() / "empty.glb", Mesh{}));
  EXPECT_TRUE(std::filesystem::is_empty(folder.path()));
}

}  // namespace
}  // namespace quorum
