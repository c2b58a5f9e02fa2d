#include "engine/io/visualsfm.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <utility>

#include "engine/camera/pose.h"
#include "engine/io/file.h"
#include "engine/io/sfm_scene.h"
#include "engine/io/text.h"

namespace quorum {
namespace {

namespace fs = std::filesystem;

/// fx cx fy cy of all cameras, where the first line gives them.
using FixedK = std::optional<std::array<double, 4>>;

/// Numbers of tokens from one of them on; nothing if there are fewer, or one is none.
template <std::size_t N>
std::optional<std::array<double, N>> numbers_of(const std::vector<std::string_view>& tokens, std::size_t first) {
  std::array<double, N> numbers{};
  if (tokens.size() < first + N) return std::nullopt;
  for (std::size_t i = 0; i < N; ++i) {
    const auto number = parse_number<double>(tokens[first + i]);
    if (!number || !std::isfinite(*number)) return std::nullopt;
    numbers[i] = *number;
  }
  return numbers;
}

class NvmReader {
 public:
  NvmReader(const fs::path& path, std::string_view text) : path_(path), lines_(text) {}

  Expected<void> read_title() {
    const auto line = lines_.next();
    const auto tokens = split_tokens(line.value_or(""));
    if (tokens.empty() || tokens[0] != "NVM_V3")
      return fail("does not begin with NVM_V3; save it from VisualSFM as NVM, with quaternions");
    if (tokens.size() == 1) return {};
    fixed_ = numbers_of<4>(tokens, 2);
    if (tokens[1] != "FixedK" || !fixed_) return fail("expected NVM_V3 or NVM_V3 FixedK fx cx fy cy");
    return {};
  }

  /// The next model; without images if there is none.
  Expected<SfmModel> read_model() {
    SfmModel model{path_};
    const auto line = lines_.next_filled();
    if (!line) return model;
    QUORUM_ASSIGN(const auto cameras, count(*line, "cameras"));
    for (std::uint64_t i = 0; i < cameras; ++i) QUORUM_TRY(read_camera(model));
    if (cameras == 0) return model;
    QUORUM_ASSIGN(const auto points, count(lines_.next_filled().value_or("0"), "points"));
    for (std::uint64_t i = 0; i < points; ++i) QUORUM_TRY(read_point(model));
    return model;
  }

 private:
  [[nodiscard]] std::unexpected<Error> fail(std::string_view message) const {
    return failure_at_line(path_, lines_.number(), message);
  }

  Expected<std::uint64_t> count(std::string_view line, const char* of) const {
    const auto tokens = split_tokens(line);
    const auto number = tokens.size() == 1 ? parse_number<std::uint64_t>(tokens[0]) : std::nullopt;
    if (!number) return fail(fmt::format("expected the count of {}, found {}", of, quote_token(line)));
    return *number;
  }

  /// A name, and ten numbers: focal length, quaternion, center, distortion, 0.
  Expected<void> read_camera(SfmModel& model) {
    constexpr std::size_t kNumbers = 10;
    const auto line = lines_.next_filled();
    const auto tokens = split_tokens(line.value_or(""));
    const auto v = tokens.size() > kNumbers ? numbers_of<kNumbers>(tokens, tokens.size() - kNumbers) : std::nullopt;
    if (!v) return fail("expected a name and the 10 numbers of a camera");
    const std::string_view last = tokens[tokens.size() - kNumbers - 1];
    std::string name(tokens[0].data(), last.data() + last.size());
    std::ranges::replace(name, '"', ' ');  // how VisualSFM writes spaces
    const auto& [focal, w, x, y, z, center_x, center_y, center_z, distortion, zero] = *v;
    Camera pose;
    pose.camera_from_world = rotation_of_quaternion({w, x, y, z});
    if (!pose.camera_from_world.allFinite()) return fail("its quaternion is no rotation");
    pose.translation = translation_of_center(pose.camera_from_world, {center_x, center_y, center_z});
    model.images.push_back({name, pose, [focal = focal, distortion = distortion, fixed = fixed_](ImageSize size) {
                              Lens lens;
                              lens.width = size.width;
                              lens.height = size.height;
                              lens.focal =
                                  fixed ? Eigen::Vector2d((*fixed)[0], (*fixed)[2]) : Eigen::Vector2d::Constant(focal);
                              lens.principal = fixed ? Eigen::Vector2d((*fixed)[1] - 0.5, (*fixed)[3] - 0.5)
                                                     : Eigen::Vector2d((size.width - 1) / 2.0, (size.height - 1) / 2.0);
                              lens.model = Lens::Model::kInverseRadial;
                              lens.coefficients[0] = distortion;
                              return lens;
                            }});
    return {};
  }

  /// x y z, a color, a count, and of each sighting the camera, the feature and where.
  Expected<void> read_point(SfmModel& model) {
    const auto line = lines_.next_filled();
    if (!line) return fail("ends before the points that were counted");
    const auto tokens = split_tokens(*line);
    const auto position = numbers_of<3>(tokens, 0);
    const auto sightings = tokens.size() > 6 ? parse_number<std::uint64_t>(tokens[6]) : std::nullopt;
    if (!position || !sightings || *sightings > tokens.size() || tokens.size() != 7 + 4 * *sightings)
      return fail("expected a point: x y z, a color, a count and 4 numbers a sighting");
    SparsePoint point{Eigen::Vector3d((*position)[0], (*position)[1], (*position)[2]), {}};
    for (std::size_t i = 0; i < *sightings; ++i) {
      const auto image = parse_number<std::uint64_t>(tokens[7 + 4 * i]);
      if (!image || *image >= model.images.size())
        return fail(
            fmt::format("a point refers to camera {} of {}", quote_token(tokens[7 + 4 * i]), model.images.size()));
      point.views.push_back(static_cast<int>(*image));
    }
    model.points.push_back(std::move(point));
    return {};
  }

  const fs::path& path_;
  LineReader lines_;
  FixedK fixed_;
};

}  // namespace

Expected<Scene> read_visualsfm(const fs::path& path, const fs::path& images) {
  QUORUM_ASSIGN(const auto text, read_file(path));
  NvmReader reader(path, text);
  QUORUM_TRY(reader.read_title());
  QUORUM_ASSIGN(auto best, reader.read_model());
  int count = best.images.empty() ? 0 : 1;
  while (count > 0) {
    QUORUM_ASSIGN(auto next, reader.read_model());
    if (next.images.empty()) break;  // what follows is about PLY files
    ++count;
    if (next.images.size() > best.images.size()) best = std::move(next);
  }
  if (count > 1)
    best.notes.push_back(fmt::format("of {} models the largest is taken, with {} images", count, best.images.size()));
  return make_sfm_scene(std::move(best), photograph_folders(path, images));
}

}  // namespace quorum
