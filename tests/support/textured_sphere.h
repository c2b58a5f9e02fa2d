// The textured sphere with its photographs as files and a mesh: an input for texturing.
#pragma once

#include "engine/mesh/mesh.h"
#include "tests/support/sphere_scene.h"
#include "tests/support/test_support.h"

namespace quorum {

/// A sphere of radius kSphereRadius at the origin, of 4 * rings² triangles but at the poles, all corners to the
/// outside.
Mesh make_sphere_mesh(int rings);

/// make_surrounding_sphere_scene whose views name photographs in a folder of its own.
class TexturedSphere {
 public:
  TexturedSphere(int around, int width, int height);

  SphereScene sphere;

 private:
  TemporaryFolder folder_;
};

}  // namespace quorum
