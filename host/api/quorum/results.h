// What a run gives: depth maps and a mesh.
#pragma once

#include <quorum/result.h>
#include <quorum/scene.h>

#include <array>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

namespace quorum::v0 {

/// What is known at each pixel of a view, row by row from the top; width · height values. Pixels without a depth hold 0
/// everywhere. A map that the run did not make or write is empty.
struct DepthMap {
  int width = 0;                   ///< pixels
  int height = 0;                  ///< pixels
  std::vector<float> depth;        ///< distance along the optical axis, scene units; 0 = none
  std::vector<float> normal;       ///< x y z of each pixel: unit vector in the camera's frame, toward the camera
  std::vector<float> confidence;   ///< how far the votes lie above the threshold, 0..1
  std::vector<float> certainty;    ///< how likely the depth is right, from other views' depth maps, 0..1
  std::vector<float> correlation;  ///< mean correlation with the views that voted, 0..1; with option "maps" "all" alone
};

/// Triangles, and what is known of each vertex.
struct Mesh {
  std::vector<float> positions;          ///< x y z of each vertex, scene units; world = position + offset
  std::vector<float> normals;            ///< x y z of each vertex: unit vector, away from the solid; zero if unknown
  std::vector<std::uint8_t> colors;      ///< red green blue of each vertex
  std::vector<float> confidence;         ///< of each vertex: 1 is one view that is fully confident; 0: filled in
  std::vector<std::uint32_t> triangles;  ///< three vertices each, counterclockwise as seen from outside
  std::array<double, 3> offset = {};     ///< zero unless the scene lies far from its origin

  [[nodiscard]] std::size_t vertex_count() const { return confidence.size(); }
  [[nodiscard]] std::size_t triangle_count() const { return triangles.size() / 3; }
};

/// The results of a run of a scene. They lie in files until they are asked for: in the workspace, or in a temporary
/// folder (TMPDIR) that goes with the last copy. Members may be called from several threads at once.
class QUORUM_API Results {
 public:
  /// Those that a run of this scene, of the library or the program, left in a workspace. Fails (kInput) if there is no
  /// such folder.
  static Result<Results> open(const Scene& scene, const std::filesystem::path& workspace);

  [[nodiscard]] const Scene& scene() const;
  /// The folder in which they lie; README.md tells the files.
  [[nodiscard]] const std::filesystem::path& folder() const;

  /// Whether a view has a depth map; views with fewer than two neighbors have none. view: 0 to view_count() - 1 of the
  /// scene; another one ends the process.
  [[nodiscard]] bool has_depth_map(int view) const;
  /// Fails (kInput) if there is none, or its files are damaged.
  [[nodiscard]] Result<DepthMap> depth_map(int view) const;
  /// Fails (kInput) if there is none.
  [[nodiscard]] Result<Mesh> mesh() const;
  /// What the run did, as JSON: run.json, which docs/formats.md describes. Fails (kInput) if there is none.
  [[nodiscard]] Result<std::string> report() const;

  struct State;  ///< for the library itself
  explicit Results(std::shared_ptr<const State> state) : state_(std::move(state)) {}

 private:
  std::shared_ptr<const State> state_;
};

}  // namespace quorum::v0
