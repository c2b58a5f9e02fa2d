#include "engine/io/view_list.h"

#include <fmt/format.h>

#include <algorithm>

#include "engine/camera/pinhole_picture.h"
#include "engine/core/option.h"
#include "engine/io/image_size.h"
#include "engine/io/text.h"
#include "engine/io/view_names.h"

namespace quorum {
namespace {

/// The lens of the same picture at another size. Positions count from the corner of the top-left pixel.
Lens resized(Lens lens, ImageSize size) {
  const Eigen::Vector2d factor(static_cast<double>(size.width) / lens.width,
                               static_cast<double>(size.height) / lens.height);
  lens.focal = lens.focal.cwiseProduct(factor);
  lens.principal = (lens.principal.array() + 0.5) * factor.array() - 0.5;
  lens.width = size.width;
  lens.height = size.height;
  return lens;
}

/// Where the principal point lies: (1, 1) is the middle, (0, 0) the corner at the top left.
Eigen::Vector2d principal_place(const Lens& lens) {
  return 2.0 * (lens.principal.array() + 0.5) / Eigen::Array2d(lens.width, lens.height);
}

/// True where the principal point lies nearer to the border than to the middle.
bool is_off_center(const Lens& lens) { return (principal_place(lens).array() - 1.0).abs().maxCoeff() > 0.5; }

/// The factor to the size of the picture whose middle the principal point is, where it is a half, a quarter, an eighth
/// or twice, four or eight times as large; else 1.
double factor_of_middle(const Lens& lens) {
  constexpr double kOff = 0.1;  // as far as lenses have it from the middle
  const Eigen::Vector2d place = principal_place(lens);
  for (const double factor : {0.125, 0.25, 0.5, 2.0, 4.0, 8.0})
    if ((place.array() / factor - 1.0).abs().maxCoeff() < kOff) return factor;
  return 1.0;
}

}  // namespace

std::string names_in_short(const std::vector<std::string>& names) {
  constexpr std::size_t kTold = 5;
  const auto end = names.begin() + static_cast<std::ptrdiff_t>(std::min(names.size(), kTold));
  return fmt::format("{}{}", fmt::join(names.begin(), end, ", "), names.size() > kTold ? " …" : "");
}

std::string absent_note(const std::vector<std::string>& names, std::size_t count) {
  return fmt::format("{} of {} photographs {} not there and left out: {}", names.size(), count,
                     names.size() == 1 ? "is" : "are", names_in_short(names));
}

std::string alpha_note(std::size_t count) {
  return fmt::format("{} photographs have an alpha channel, which is taken as their mask", count);
}

Expected<int> ViewList::add(const std::string& image_name, const std::filesystem::path& image_path, const Camera& pose,
                            Lens lens) {
  const auto refuse = [&](std::string_view message) {
    return failure(ErrorKind::kInput, fmt::format("image \"{}\": {}", image_name, message));
  };
  if (has_control_characters(image_name))
    return failure(ErrorKind::kInput,
                   fmt::format("image {}: its name has control characters; rename it", quote_token(image_name)));
  if (image_path.empty()) {
    absent_.push_back(image_name);
    return -1;
  }
  QUORUM_ASSIGN(const auto header, read_image_header(image_path));
  const ImageSize size = header.size;
  if (lens.width == 0 && lens.height == 0) {
    lens.width = size.width;
    lens.height = size.height;
    if (const double other = factor_of_middle(lens); other != 1.0)
      return refuse(
          fmt::format("its principal point is the middle of a picture of about {:.0f} x {:.0f}, and {} is {} x "
                      "{}; give photographs of that size, or scale focal length and principal point",
                      other * size.width, other * size.height, image_path.string(), size.width, size.height));
  }
  if (!photographs_.insert(image_path.lexically_normal()).second)
    return refuse(fmt::format("{} is the photograph of another image, too; leave one of the two", image_path.string()));
  const auto factor = common_factor({lens.width, lens.height}, size);
  if (!factor && lens.width == size.height && lens.height == size.width)
    return refuse(
        fmt::format("{} is {} x {}, its camera {} x {}: the cameras were found for pictures turned by the "
                    "orientation in the file; turn the pixels of the files, too (mogrify -auto-orient)",
                    image_path.string(), size.width, size.height, lens.width, lens.height));
  if (!factor)
    return refuse(fmt::format("{} is {} x {}, its camera {} x {}; give the photographs that the cameras were found for",
                              image_path.string(), size.width, size.height, lens.width, lens.height));
  if (*factor != 1.0) {
    lens = resized(lens, size);
    least_factor_ = scaled_count_ == 0 ? *factor : std::min(least_factor_, *factor);
    largest_factor_ = std::max(largest_factor_, *factor);
    ++scaled_count_;
  }

  View view;
  view.image_name = image_name;
  view.image_path = image_path;
  if (header.has_alpha) {
    view.mask_path = image_path;
    ++alpha_count_;
  }
  view.camera = pose;
  view.camera.intrinsics << lens.focal.x(), 0, lens.principal.x(), 0, lens.focal.y(), lens.principal.y(), 0, 0, 1;
  view.width = lens.width;
  view.height = lens.height;
  if (const char* defect = camera_defect(view.camera); defect != nullptr)
    return refuse(fmt::format("{}; {}", defect, kCameraRemedy));
  if (const std::string absurd = absurd_value(view.camera, lens.width, lens.height); !absurd.empty())
    return refuse(fmt::format("{}; {}", absurd, kCameraRemedy));
  if (is_off_center(lens)) off_center_.push_back(image_name);
  if (!lens.is_pinhole()) {
    const auto picture = pinhole_picture(lens);
    if (!picture) return refuse("its lens can't be undistorted; check its coefficients");
    view.camera.intrinsics = picture->intrinsics;
    view.width = picture->width;
    view.height = picture->height;
    view.photo_width = lens.width;
    view.photo_height = lens.height;
    view.lens = lens;
  }
  views_.push_back(std::move(view));
  return static_cast<int>(views_.size()) - 1;
}

Expected<Scene> ViewList::finish() {
  const std::size_t count = views_.size() + absent_.size();
  if (views_.size() < 3 && !absent_.empty())
    return failure(
        ErrorKind::kInput,
        fmt::format("{} of {} photographs are there, expected 3 or more (image \"{}\" is not there); add them "
                    "or give their folder with {}",
                    views_.size(), count, absent_.front(), option_name("images")));
  if (views_.size() < 3)
    return failure(ErrorKind::kInput,
                   fmt::format("holds {} views, expected 3 or more: a reference view and two neighbors", count));
  QUORUM_TRY(name_views(views_));
  Scene scene{std::move(views_), {}};
  if (!absent_.empty()) scene.notes.push_back(absent_note(absent_, count));
  if (scaled_count_ > 0) {
    const std::string factors = largest_factor_ - least_factor_ < 0.005
                                    ? fmt::format("{:.4g}", largest_factor_)
                                    : fmt::format("{:.4g} to {:.4g}", least_factor_, largest_factor_);
    scene.notes.push_back(fmt::format("{} photographs have another size than their cameras, which are scaled by {}",
                                      scaled_count_, factors));
  }
  if (alpha_count_ > 0) scene.notes.push_back(alpha_note(alpha_count_));
  if (!off_center_.empty())
    scene.notes.push_back(
        fmt::format("{} photographs have their principal point (cx, cy) nearer to the border than to the middle, as "
                    "cropped ones alone do: {}",
                    off_center_.size(), names_in_short(off_center_)));
  return scene;
}

}  // namespace quorum
