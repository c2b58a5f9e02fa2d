#include "engine/pipeline/workspace.h"

#include <fmt/format.h>
#include <oneapi/tbb/parallel_invoke.h>

#include "engine/io/file.h"
#include "engine/io/image_file.h"
#include "engine/io/pfm.h"
#include "engine/io/preview.h"

namespace quorum {

Expected<Workspace> Workspace::open(const std::filesystem::path& folder) {
  if (auto made = make_folder(folder / "depth"); !made) return std::unexpected(made.error());
  return Workspace(folder);
}

std::filesystem::path Workspace::map_path(const std::string& view, const char* map, const char* kind) const {
  return folder_ / "depth" / fmt::format("{}.{}.{}", view, map, kind);
}

bool Workspace::has_depth_map(const std::string& view) const {
  std::error_code ignored;
  return std::filesystem::is_regular_file(map_path(view, "depth", "pfm"), ignored);
}

Expected<void> Workspace::save_depth_map(const std::string& view, const DepthMap& map) const {
  Expected<void> saved[6];
  tbb::parallel_invoke(
      [&] { saved[0] = write_pfm(map_path(view, "correlation", "pfm"), map.correlation); },
      [&] { saved[1] = write_pfm(map_path(view, "confidence", "pfm"), map.confidence); },
      [&] { saved[2] = write_png(map_path(view, "correlation", "png"), color_map_unit(map.correlation)); },
      [&] { saved[3] = write_png(map_path(view, "confidence", "png"), color_map_unit(map.confidence)); },
      [&] { saved[4] = write_png(map_path(view, "depth", "png"), color_map_depth(map.depth)); },
      [&] {
        if (map.normal.empty()) return;
        saved[5] = write_png(map_path(view, "normal", "png"), color_map_normal(map.normal));
        if (saved[5]) saved[5] = write_pfm(map_path(view, "normal", "pfm"), map.normal);
      });
  for (const auto& result : saved)
    if (!result) return result;
  return write_pfm(map_path(view, "depth", "pfm"), map.depth);
}

template <typename Value>
Expected<Grid<Value>> Workspace::fitting(const std::string& view, const char* map, int width, int height,
                                         Expected<Grid<Value>> loaded) const {
  if (loaded && (loaded->width != width || loaded->height != height))
    return failure(ErrorKind::kInput,
                   fmt::format("{}: is {} x {}, but the view is {} x {}; run `quorum depth` on this scene again",
                               map_path(view, map, "pfm").string(), loaded->width, loaded->height, width, height));
  return loaded;
}

Expected<Grid<float>> Workspace::load_map(const std::string& view, const char* map, int width, int height) const {
  return fitting(view, map, width, height, read_pfm(map_path(view, map, "pfm")));
}

Expected<Grid<Eigen::Vector3f>> Workspace::load_normals(const std::string& view, int width, int height) const {
  const std::filesystem::path path = map_path(view, "normal", "pfm");
  std::error_code ignored;
  if (!std::filesystem::exists(path, ignored))
    return failure(ErrorKind::kInput,
                   fmt::format("{}: is missing; run `quorum depth` on this scene again", path.string()));
  return fitting(view, "normal", width, height, read_pfm_vectors(path));
}

Expected<DepthMap> Workspace::load_depth_map(const std::string& view, int width, int height) const {
  DepthMap map;
  const auto load = [&](const char* name, Grid<float>& grid) -> Expected<void> {
    auto loaded = load_map(view, name, width, height);
    if (!loaded) return std::unexpected(loaded.error());
    grid = std::move(*loaded);
    return {};
  };
  for (const auto& result :
       {load("depth", map.depth), load("correlation", map.correlation), load("confidence", map.confidence)})
    if (!result) return std::unexpected(result.error());
  return map;
}

Expected<Grid<float>> Workspace::load_depth(const std::string& view, int width, int height) const {
  return load_map(view, "depth", width, height);
}

Expected<void> Workspace::save_certainty(const std::string& view, const Grid<float>& certainty) const {
  if (auto drawn = write_png(map_path(view, "certainty", "png"), color_map_unit(certainty)); !drawn) return drawn;
  return write_pfm(map_path(view, "certainty", "pfm"), certainty);
}

Expected<Grid<float>> Workspace::load_certainty(const std::string& view, int width, int height) const {
  return load_map(view, "certainty", width, height);
}

void Workspace::remove_certainty(const std::string& view) const {
  std::error_code ignored;
  for (const char* kind : {"pfm", "png"}) std::filesystem::remove(map_path(view, "certainty", kind), ignored);
}

void Workspace::remove_depth_map(const std::string& view) const {
  std::error_code ignored;
  remove_certainty(view);
  for (const char* map : {"depth", "correlation", "confidence", "normal"})
    for (const char* kind : {"pfm", "png"}) std::filesystem::remove(map_path(view, map, kind), ignored);
}

}  // namespace quorum
