// A scene: photographs with known cameras, from files or from arrays.
//
//      0   1   2  -> x (right)          world to camera:  point_in_camera = R · point_in_world + t
//    +---+---+---+                      camera to pixel:  (x, y, 1) ~ K · point_in_camera
//  0 | o |   |   |   An integer         camera axes:      x right, y down, z forward
//    +---+---+---+   coordinate is      depth:            z of point_in_camera, the distance along the
//  1 |   |   |   |   the CENTER of a                      optical axis in scene units; 0 = none
//    +---+---+---+   pixel: o = (0, 0)  arrays:           row by row from the top
//  y (down)
#pragma once

#include <quorum/options.h>
#include <quorum/result.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace quorum::v0 {

/// A pinhole camera; matrices row by row. K is upper triangular with K(2,2) = 1 and in pixels, R a rotation.
struct Camera {
  std::array<double, 9> intrinsics = {1, 0, 0, 0, 1, 0, 0, 0, 1};         ///< K, pixels
  std::array<double, 9> camera_from_world = {1, 0, 0, 0, 1, 0, 0, 0, 1};  ///< R
  std::array<double, 3> translation = {};                                 ///< t, scene units
};

/// Pixels of 8 bits a channel that lie with the caller, who keeps them until the call that takes them returns.
struct PixelArray {
  const std::uint8_t* data = nullptr;  ///< the first channel of the top-left pixel
  int width = 0;                       ///< pixels
  int height = 0;                      ///< pixels
  int channels = 3;                    ///< 3: red, green, blue; 1: gray
  std::ptrdiff_t stride = 0;           ///< bytes from a row to the one below; 0: width · channels
  bool is_bgr = false;                 ///< the three channels are blue, green, red, as OpenCV has them
};

/// A photograph, free of lens distortion, with its camera.
struct ViewArrays {
  std::string name = {};  ///< unique; names the view and its files; empty: view0001, view0002 …
  PixelArray image = {};
  PixelArray mask = {};             ///< one channel, as large as the image; 0 is left out. Without data: all takes part
  Camera camera = {};               ///< of the image
  double near_depth = 0.0;          ///< least depth to look at, scene units
  double far_depth = 0.0;           ///< largest one; 0: unknown. A box that does not hold the camera overrules both
  std::vector<int> neighbors = {};  ///< views to compare with, best first; empty: they are chosen
};

/// A point of the object that several views see.
struct SparsePoint {
  std::array<double, 3> position = {};  ///< world, scene units
  std::vector<int> views = {};          ///< that see it: places in SceneArrays::views
};

struct SceneArrays {
  std::vector<ViewArrays> views = {};                ///< three or more
  std::vector<SparsePoint> points = {};              ///< may be empty; they help to choose neighbors and depth ranges
  std::optional<std::array<double, 6>> bounds = {};  ///< x0 y0 z0 x1 y1 z1 of the box that holds the object; else found
};

/// What is known of a view.
struct ViewInfo {
  std::string name;        ///< names its files
  std::string image_name;  ///< what the scene's files, or ViewArrays, call it
  int width = 0;           ///< of the image that is worked on, and of the view's depth map, pixels
  int height = 0;          ///< pixels
  Camera camera = {};      ///< of that image; world as in the scene's files
  double near_depth = 0.0;
  double far_depth = 0.0;  ///< 0: the bounds alone say
};

/// A scene, ready to be reconstructed. Photographs stay in files until a run needs them; those of arrays are written to
/// a temporary folder (TMPDIR), which goes with the last copy of the scene and of its results. Copies share one scene.
class QUORUM_API Scene {
 public:
  /// Reads a scene in any format that `quorum reconstruct` reads (docs/formats.md). Of the options those of the scene
  /// count ("format", "images", "masks", "bounds", "max-image-size" …) and "threads". Fails (kInput) if a file is
  /// missing or malformed or the bounds can't be right, (kUsage) if an option is wrong.
  static Result<Scene> read(const std::filesystem::path& folder, const Options& options = {});

  /// Makes a scene of arrays, which may go after the call. Of the options "bounds", "roi", "masks", "max-image-size"
  /// and "threads" count. Fails (kInput) if there are fewer than three views, or an array or camera is none: the
  /// message names the view; (kUsage) if an option is wrong or has no use here.
  static Result<Scene> from_arrays(const SceneArrays& arrays, const Options& options = {});

  [[nodiscard]] int view_count() const;
  /// index: 0 to view_count() - 1; another one ends the process.
  [[nodiscard]] ViewInfo view(int index) const;
  /// x0 y0 z0 x1 y1 z1 of the box that holds the object, world, scene units.
  [[nodiscard]] std::array<double, 6> bounds() const;
  /// Lines for the user: what was left out, and what was chosen.
  [[nodiscard]] std::vector<std::string> notes() const;

  struct State;  ///< for the library itself
  explicit Scene(std::shared_ptr<const State> state) : state_(std::move(state)) {}
  [[nodiscard]] const std::shared_ptr<const State>& state() const { return state_; }

 private:
  std::shared_ptr<const State> state_;
};

}  // namespace quorum::v0
