#include "engine/report/run_record.h"

#include <fmt/format.h>

#include "engine/io/file.h"

namespace quorum {
namespace {

using Json = nlohmann::ordered_json;

}  // namespace

Expected<Json> read_run(const Workspace& workspace) {
  const auto text = read_file(workspace.report_path());
  Json run = text ? Json::parse(*text, nullptr, false) : Json();
  const auto holds = [&](const char* name) { return run.value(name, Json::object()).is_object(); };
  if (!run.is_object() || !holds("scene") || !holds("volume"))
    return failure(ErrorKind::kInput,
                   fmt::format("{}: no finished run is here; run quorum reconstruct to its end first",
                               workspace.report_path().string()));
  return run;
}

Json read_verified(const Workspace& workspace) {
  const auto text = read_file(workspace.verified_path());
  const Json verified = text ? Json::parse(*text, nullptr, false) : Json();
  return verified.is_object() ? verified : Json::object();
}

Json neighbor_names(const Workspace& workspace, const std::string& view) {
  const Json record = Json::parse(workspace.depth_record(view), nullptr, false);
  if (!record.is_object()) return Json::array();
  Json names = Json::array();
  for (const Json& neighbor : record.value("neighbors", Json::array()))
    if (neighbor.is_object()) names.push_back(neighbor.value("name", Json()));
  return names;
}

Bounds bounds_of(const Json& run, const Scene& scene) {
  const Json box = run.value("scene", Json::object()).value("bounds", Json::array());
  Bounds bounds = scene.bounds;
  for (std::size_t corner = 0; corner < 2; ++corner)
    for (std::size_t axis = 0; axis < 3; ++axis) {
      if (!box.is_array() || box.size() != 2 || !box[corner].is_array() || box[corner].size() != 3 ||
          !box[corner][axis].is_number())
        return scene.bounds;
      const auto place = static_cast<Eigen::Index>(axis);
      (corner == 0 ? bounds.low : bounds.high)(place) = box[corner][axis].get<double>() - scene.offset(place);
    }
  return bounds;
}

}  // namespace quorum
