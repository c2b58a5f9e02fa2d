#include "engine/report/packed_mesh.h"

#include <gtest/gtest.h>

#include "engine/report/data_url.h"

namespace quorum {
namespace {

TEST(PackedMesh, Base64IsThatOfTheStandard) {
  for (const auto& [bytes, text] :
       {std::pair{"", ""}, {"f", "Zg=="}, {"fo", "Zm8="}, {"foo", "Zm9v"}, {"foob", "Zm9vYg=="}})
    EXPECT_EQ(base64(bytes), text);
  EXPECT_EQ(base64({"\xff\xfe\x00", 3}), "//4A");
}

TEST(PackedMesh, PositionsSpanTheBoxAndCountsAreCapped) {
  Mesh mesh;
  mesh.vertices.resize(2);
  mesh.vertices[0].position = {1, 2, 3};
  mesh.vertices[0].color = make_rgb(1, 2, 3);
  mesh.vertices[1].position = {5, 2, 4};
  mesh.vertices[1].color = make_rgb(4, 5, 6);
  mesh.vertices[1].confidence = 2;
  mesh.triangles = {{0, 1, 0}};
  const PackedMesh packed = pack_mesh(mesh, {3, 700}, 2.5F);
  EXPECT_EQ(packed.low, Eigen::Vector3f(1, 2, 3));
  EXPECT_EQ(packed.size, Eigen::Vector3f(4, 0, 1));
  EXPECT_EQ(packed.positions, base64({"\0\0\0\0\0\0\xff\xff\0\0\xff\xff", 12}));
  EXPECT_EQ(packed.colors, base64({"\1\2\3\4\5\6", 6}));
  EXPECT_EQ(packed.confidence, base64({"\0\xcc", 2}));  // 2 of 2.5 = 204 of 255
  EXPECT_EQ(packed.views, base64({"\3\xff", 2}));
  EXPECT_EQ(packed.triangles, base64({"\0\0\0\0\1\0\0\0\0\0\0\0", 12}));
}

}  // namespace
}  // namespace quorum
