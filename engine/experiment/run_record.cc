#include "engine/experiment/run_record.h"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

namespace quorum {
namespace {

using Json = nlohmann::ordered_json;

template <typename T>
Json json_or_null(const std::optional<T>& value) {
  return value ? Json(*value) : Json(nullptr);
}

std::optional<double> number_or_none(const Json& value) {
  return value.is_null() ? std::nullopt : std::optional(value.get<double>());
}

Json json_of(const DepthMeasures& depth) {
  return {{"views", depth.views},
          {"swept_pixels", depth.swept_pixels},
          {"valid_pixels", depth.valid_pixels},
          {"depth_samples", depth.depth_samples},
          {"loose_pixels", depth.loose_pixels},
          {"background_pixels", depth.background_pixels},
          {"roughness", depth.roughness},
          {"correlation", depth.correlation},
          {"confidence", depth.confidence},
          {"median_error", json_or_null(depth.median_error)},
          {"wrong_share", json_or_null(depth.wrong_share)}};
}

DepthMeasures depth_measures(const Json& json) {
  DepthMeasures depth;
  json.at("views").get_to(depth.views);
  json.at("swept_pixels").get_to(depth.swept_pixels);
  json.at("valid_pixels").get_to(depth.valid_pixels);
  json.at("depth_samples").get_to(depth.depth_samples);
  json.at("loose_pixels").get_to(depth.loose_pixels);
  json.at("background_pixels").get_to(depth.background_pixels);
  json.at("roughness").get_to(depth.roughness);
  json.at("correlation").get_to(depth.correlation);
  json.at("confidence").get_to(depth.confidence);
  depth.median_error = number_or_none(json.at("median_error"));
  depth.wrong_share = number_or_none(json.at("wrong_share"));
  return depth;
}

Json json_of(const MeshScore& mesh) {
  Json json = {{"vertices", mesh.vertices}, {"triangles", mesh.triangles}};
  if (!mesh.evaluation) return json;
  json["accuracy"] = mesh.evaluation->accuracy;
  json["median_accuracy"] = mesh.evaluation->median_accuracy;
  json["mean_accuracy"] = mesh.evaluation->mean_accuracy;
  json["completeness"] = mesh.evaluation->completeness;
  for (const FScore& score : mesh.evaluation->f_scores)
    json["f_scores"].push_back(
        {{"distance", score.distance}, {"precision", score.precision}, {"recall", score.recall}, {"f", score.f}});
  return json;
}

MeshScore mesh_score(const Json& json) {
  MeshScore mesh{json.at("vertices").get<std::uint64_t>(), json.at("triangles").get<std::uint64_t>(), std::nullopt};
  if (!json.contains("accuracy")) return mesh;
  Evaluation& evaluation = mesh.evaluation.emplace();
  json.at("accuracy").get_to(evaluation.accuracy);
  json.at("median_accuracy").get_to(evaluation.median_accuracy);
  json.at("mean_accuracy").get_to(evaluation.mean_accuracy);
  json.at("completeness").get_to(evaluation.completeness);
  for (const Json& score : json.at("f_scores"))
    evaluation.f_scores.push_back({score.at("distance").get<double>(), score.at("precision").get<double>(),
                                   score.at("recall").get<double>(), score.at("f").get<double>()});
  return mesh;
}

}  // namespace

std::string record_json(const RunRecord& record) {
  const Json json = {{"scene", record.scene},
                     {"identity", Json::parse(record.identity)},
                     {"device", record.device},
                     {"wall_seconds", record.wall_seconds},
                     {"cpu_seconds", record.cpu_seconds},
                     {"depth_cpu_seconds", record.depth_cpu_seconds},
                     {"peak_memory_bytes", record.peak_memory_bytes},
                     {"voxel_size", record.voxel_size},
                     {"min_confidence", record.min_confidence},
                     {"depth_maps", json_of(record.depth)},
                     {"mesh", json_of(record.mesh)},
                     {"problem", record.problem}};
  return json.dump(2) + "\n";
}

Expected<RunRecord> read_record(const std::string& text) {
  try {
    const Json json = Json::parse(text);
    RunRecord record;
    json.at("scene").get_to(record.scene);
    record.identity = json.at("identity").dump();
    json.at("device").get_to(record.device);
    json.at("wall_seconds").get_to(record.wall_seconds);
    json.at("cpu_seconds").get_to(record.cpu_seconds);
    json.at("depth_cpu_seconds").get_to(record.depth_cpu_seconds);
    json.at("peak_memory_bytes").get_to(record.peak_memory_bytes);
    json.at("voxel_size").get_to(record.voxel_size);
    json.at("min_confidence").get_to(record.min_confidence);
    record.depth = depth_measures(json.at("depth_maps"));
    record.mesh = mesh_score(json.at("mesh"));
    json.at("problem").get_to(record.problem);
    return record;
  } catch (const Json::exception& error) {
    return failure(ErrorKind::kInput, fmt::format("not the record of a run: {}", error.what()));
  }
}

}  // namespace quorum
