#include "engine/io/transforms_lens.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <nlohmann/json.hpp>
#include <string_view>

#include "engine/io/text.h"
#include "engine/io/view_names.h"

namespace quorum {
namespace {

using Json = nlohmann::json;

/// Values of a frame, or else of the file; the first that is of another kind is kept for the message.
class FrameFields {
 public:
  FrameFields(const Json& frame, const Json& file) : frame_(frame), file_(file) {}

  /// Null if it is in neither.
  [[nodiscard]] const Json* find(const std::string& name) const {
    for (const Json* source : {&frame_, &file_})
      if (const auto place = source->find(name); place != source->end() && !place->is_null()) return &*place;
    return nullptr;
  }
  std::optional<double> number(const std::string& name) {
    const Json* value = find(name);
    if (value == nullptr) return std::nullopt;
    if (value->is_number() && std::isfinite(value->get<double>())) return value->get<double>();
    fail(fmt::format("its {} is no number", name));
    return std::nullopt;
  }
  double coefficient(const char* name) { return number(name).value_or(0.0); }
  std::string word(const std::string& name) {
    const Json* value = find(name);
    if (value != nullptr && !value->is_string()) fail(fmt::format("its {} is no text", name));
    return value != nullptr && value->is_string() ? value->get<std::string>() : std::string();
  }
  bool flag(const std::string& name) {
    const Json* value = find(name);
    if (value == nullptr) return false;
    if (!value->is_boolean() && !value->is_number()) fail(fmt::format("its {} is neither true nor false", name));
    return says(name);
  }
  /// True if a field says something: it is there, and not false, 0, or a list of that.
  [[nodiscard]] bool says(const std::string& name) const {
    const Json* value = find(name);
    return value != nullptr && is_set(*value);
  }
  void fail(std::string message) {
    if (problem_.empty()) problem_ = std::move(message);
  }
  [[nodiscard]] Expected<void> done() const {
    if (problem_.empty()) return {};
    return failure(ErrorKind::kInput, problem_);
  }

 private:
  static bool is_set(const Json& value) {
    if (value.is_array())
      return std::ranges::any_of(value, [](const Json& item) { return item.is_array() || is_set(item); });
    if (value.is_number()) return value.get<double>() != 0.0;
    if (value.is_boolean()) return value.get<bool>();
    return !value.is_null();
  }

  const Json& frame_;
  const Json& file_;
  std::string problem_;
};

constexpr std::string_view kPerspective[] = {"",       "PERSPECTIVE", "SIMPLE_PINHOLE", "PINHOLE", "SIMPLE_RADIAL",
                                             "RADIAL", "OPENCV",      "FULL_OPENCV"};
constexpr std::string_view kFisheyes[] = {"OPENCV_FISHEYE", "SIMPLE_RADIAL_FISHEYE", "RADIAL_FISHEYE", "SIMPLE_FISHEYE",
                                          "FISHEYE"};

/// FrameFields that would bend the picture or move its rays in ways that are not read here.
constexpr const char* kBending[] = {"ftheta_p0",
                                    "ftheta_p1",
                                    "ftheta_p2",
                                    "ftheta_p3",
                                    "ftheta_p4",
                                    "latlong",
                                    "skew",
                                    "equirectangular",
                                    "xi",
                                    "orthographic",
                                    "rolling_shutter",
                                    "omega",
                                    "distortion_params",
                                    "alpha",
                                    "s1",
                                    "beta",
                                    "s2",
                                    "s3",
                                    "s4",
                                    "k7",
                                    "k8",
                                    "parallax_shift",
                                    "from_mitsuba"};

/// Whether a name that is not known speaks of the lens all the same, such as isFisheye or distortion_model.
bool speaks_of_lens(std::string_view name) {
  const std::string lower = folded(std::string(name));
  if (lower == "is_fisheye" || lower == "fisheye_crop_radius" || lower.starts_with("undistort")) return false;
  return std::ranges::any_of(std::array{"fisheye", "distort", "equirect", "panoram", "spherical", "orthograph"},
                             [&](std::string_view part) { return lower.contains(part); });
}

/// Of a lens; in a frame or in the file.
constexpr std::string_view kUsed[] = {"camera_model",
                                      "is_fisheye",
                                      "w",
                                      "h",
                                      "fl_x",
                                      "fl_y",
                                      "camera_angle_x",
                                      "camera_angle_y",
                                      "cx",
                                      "cy",
                                      "k1",
                                      "k2",
                                      "k3",
                                      "k4",
                                      "k5",
                                      "k6",
                                      "p1",
                                      "p2"};
constexpr std::string_view kUsedInFrame[] = {"file_path", "transform_matrix", "mask_path"};
constexpr std::string_view kUsedInFile[] = {"frames", "ply_file_path"};
/// They say how others show or split the scene, or repeat what is done already.
constexpr std::string_view kHarmless[] = {"aabb_scale",
                                          "scale",
                                          "offset",
                                          "sharpness",
                                          "applied_transform",
                                          "applied_scale",
                                          "train_filenames",
                                          "val_filenames",
                                          "test_filenames",
                                          "colmap_im_id",
                                          "rotation",
                                          "from_na",
                                          "orientation_override",
                                          "auto_scale_poses_override"};

bool contains(auto& names, std::string_view name) { return std::ranges::count(names, name) > 0; }

void set_coefficients(FrameFields& fields, const std::string& model, bool is_fisheye, Lens& lens) {
  const auto k = [&fields](const char* name) { return fields.coefficient(name); };
  if (!is_fisheye) {
    const bool rational = model == "FULL_OPENCV" || k("k5") != 0.0 || k("k6") != 0.0;
    lens.coefficients = {k("k1"), k("k2"), k("p1"), k("p2"), k("k3")};
    if (rational) {
      lens.coefficients[5] = k("k4");
      lens.coefficients[6] = k("k5");
      lens.coefficients[7] = k("k6");
    } else {
      lens.coefficients[8] = k("k4");
    }
    return;
  }
  for (const char* name : {"k5", "k6"})
    if (fields.says(name)) fields.fail(fmt::format("{} of a fisheye is not understood", name));
  if (k("p1") == 0.0 && k("p2") == 0.0) {
    lens.model = Lens::Model::kFisheye;
    lens.coefficients = {k("k1"), k("k2"), k("k3"), k("k4")};
  } else {
    lens.model = Lens::Model::kThinPrismFisheye;
    lens.coefficients = {k("k1"), k("k2"), k("p1"), k("p2"), k("k3"), k("k4")};
  }
}

}  // namespace

Expected<Lens> lens_of_frame(const Json& frame, const Json& file, ImageSize size) {
  FrameFields fields(frame, file);
  const std::string model = fields.word("camera_model");
  if (model == "EQUIRECTANGULAR")
    return failure(
        ErrorKind::kInput,
        "its camera_model EQUIRECTANGULAR is a panorama, which no pinhole camera shows; cut the panoramas into "
        "perspective views first (ns-process-data does with --camera-type equirectangular)");
  if (!contains(kPerspective, model) && !contains(kFisheyes, model))
    return failure(
        ErrorKind::kInput,
        fmt::format("its camera_model {} is not known; undistort the photographs, or give one of {}, {}",
                    quote_token(model), fmt::join(std::begin(kPerspective) + 2, std::end(kPerspective), ", "),
                    fmt::join(kFisheyes, ", ")));
  for (const char* name : kBending)
    if (fields.says(name))
      return failure(
          ErrorKind::kInput,
          fmt::format("its field {} bends the picture or its rays in a way that is not understood; undistort the "
                      "photographs and remove it",
                      name));
  for (const Json* object : {&frame, &file})
    for (const auto& [name, value] : object->items())
      if (speaks_of_lens(name) && fields.says(name))
        return failure(ErrorKind::kInput,
                       fmt::format("its field {} may bend the picture and is not known; undistort the photographs and "
                                   "remove it, or use camera_model or is_fisheye",
                                   quote_token(name)));
  const bool is_fisheye = contains(kFisheyes, model) || fields.flag("is_fisheye");

  Lens lens;
  const auto side = [](std::optional<double> value, int otherwise) {
    return value ? static_cast<int>(std::clamp(*value, 0.0, 1e6)) : otherwise;
  };
  lens.width = side(fields.number("w"), size.width);
  lens.height = side(fields.number("h"), size.height);
  auto focal_x = fields.number("fl_x");
  auto focal_y = fields.number("fl_y");
  const auto angle_x = fields.number("camera_angle_x");
  const auto angle_y = fields.number("camera_angle_y");
  if (!focal_x && angle_x) {
    if (is_fisheye) fields.fail("camera_angle_x of a fisheye is no focal length; give fl_x");
    focal_x = 0.5 * lens.width / std::tan(0.5 * *angle_x);
    if (!focal_y && angle_y) focal_y = 0.5 * lens.height / std::tan(0.5 * *angle_y);
  }
  if (!focal_x) fields.fail("neither fl_x nor camera_angle_x is there");
  lens.focal = {focal_x.value_or(0.0), focal_y.value_or(focal_x.value_or(0.0))};
  lens.principal = {fields.number("cx").value_or(lens.width / 2.0) - 0.5,
                    fields.number("cy").value_or(lens.height / 2.0) - 0.5};
  set_coefficients(fields, model, is_fisheye, lens);
  if (!fields.number("w") && !fields.number("h")) lens.width = lens.height = 0;
  QUORUM_TRY(fields.done());
  return lens;
}

void add_unused_fields(const Json& object, FieldPlace place, std::set<std::string>& names) {
  for (const auto& [name, value] : object.items()) {
    const bool used = contains(kUsed, name) ||
                      (place == FieldPlace::kFrame ? contains(kUsedInFrame, name) : contains(kUsedInFile, name));
    if (!used && !contains(kHarmless, name) && std::ranges::count(kBending, name) == 0 && !value.is_null())
      names.insert(name);
  }
}

}  // namespace quorum
