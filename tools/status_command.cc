// quorum status: what a workspace holds, what it was made from, and what is missing.
#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <map>
#include <nlohmann/json.hpp>
#include <set>

#include "engine/core/printable.h"
#include "engine/io/file.h"
#include "engine/pipeline/workspace.h"
#include "engine/pipeline/workspace_lock.h"
#include "tools/command.h"
#include "tools/messages.h"

namespace quorum {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

struct DepthMaps {
  std::map<std::string, std::vector<std::string>> views_of;  ///< by their options
  std::set<std::string> names;
  std::set<std::string> compared;  ///< the neighbors of these
  int certainties = 0;
};

/// "window 5, threshold 0.5, …".
std::string text_of(const Json& options) {
  std::string text;
  for (const auto& [name, value] : options.items())
    text += fmt::format("{}{} {}", text.empty() ? "" : ", ", name,
                        value.is_string() ? value.get<std::string>() : value.dump());
  return text.empty() ? "unknown options" : text;
}

Expected<DepthMaps> read_records(const fs::path& folder) {
  constexpr std::string_view kDepth = ".depth.json";
  DepthMaps maps;
  std::error_code code;
  for (fs::directory_iterator entry(folder / "depth", code), end; !code && entry != end; entry.increment(code)) {
    const std::string file = entry->path().filename().string();
    if (file.ends_with(".certainty.json")) ++maps.certainties;
    if (!file.ends_with(kDepth)) continue;
    const std::string name = file.substr(0, file.size() - kDepth.size());
    QUORUM_ASSIGN(const auto text, read_file(entry->path()));
    const Json record = Json::parse(text, nullptr, false);
    const Json known = record.is_object() ? record : Json::object();
    maps.names.insert(name);
    maps.views_of[text_of(known.value("options", Json::object()))].push_back(name);
    for (const Json& neighbor : known.value("neighbors", Json::array()))
      if (neighbor.is_object() && neighbor.contains("name") && neighbor["name"].is_string())
        maps.compared.insert(neighbor["name"].get<std::string>());
  }
  if (code)
    return failure(ErrorKind::kInput, fmt::format("{}: is no output folder of a run ({}); check the path",
                                                  folder.string(), code.message()));
  for (auto& [options, views] : maps.views_of) std::ranges::sort(views);
  return maps;
}

std::string list_of(const std::set<std::string>& names) {
  std::string list;
  for (const std::string& name : names) list += (list.empty() ? "" : ", ") + name;
  return list;
}

void print_line(const std::string& what, const std::string& text) { print("{:<12} {}\n", what, printable(text)); }

/// "5 of 7 (2/7, 6/7 are missing)", of each number of shards that there were.
std::string text_of_shards(const std::vector<Shard>& done) {
  std::map<int, std::set<int>> groups;
  for (const Shard& shard : done) groups[shard.count].insert(shard.index);
  std::string text;
  for (const auto& [count, indices] : groups) {
    std::set<std::string> missing;
    for (int index = 0; index < count && missing.size() < 20; ++index)
      if (!indices.contains(index)) missing.insert(Shard{index, count}.text());
    text += fmt::format("{}{} of {}{}", text.empty() ? "" : "; ", indices.size(), count,
                        missing.empty() ? "" : fmt::format(" (missing: {})", list_of(missing)));
  }
  return text;
}

void tell_shards(const Workspace& workspace) {
  for (const char* stage : {"depth", "confirm", "fuse"})
    if (const auto done = workspace.find_shards(stage, "json"); !done.empty())
      print_line("shards", fmt::format("{}: {}", stage, text_of_shards(done)));
}

Expected<void> tell_status(const fs::path& folder) {
  QUORUM_ASSIGN(const DepthMaps maps, read_records(folder));
  std::error_code ignored;
  const bool has_mesh = fs::exists(folder / "mesh.ply", ignored);
  const bool is_done = fs::exists(folder / "run.json", ignored);
  const std::string holder = WorkspaceLock::holder(folder);
  const std::vector<std::string> at_work = WorkspaceLock::shard_holders(folder);
  print_line("run", !holder.empty()    ? "works: " + holder
                    : !at_work.empty() ? fmt::format("{} shards work", at_work.size())
                    : is_done          ? "done (run.json)"
                                       : "not finished");
  for (const std::string& shard : at_work) print_line("", shard);
  print_line("depth maps", fmt::format("{}", maps.names.size()));
  for (const auto& [options, views] : maps.views_of)
    print_line(
        "", fmt::format("{} made with {}", maps.views_of.size() == 1 ? "all" : views.front() + " and others", options));
  if (maps.views_of.size() > 1) print_line("", "different options: run `quorum depth` again");
  std::set<std::string> missing;
  std::ranges::set_difference(maps.compared, maps.names, std::inserter(missing, missing.end()));
  print_line("missing", missing.empty() ? "none of the views that these name" : list_of(missing));
  print_line("certainties", fmt::format("{}", maps.certainties));
  tell_shards(Workspace::at(folder));
  print_line("mesh",
             has_mesh ? fmt::format("mesh.ply, {} bytes", fs::file_size(folder / "mesh.ply", ignored)) : "none");
  return {};
}

}  // namespace

int status_command(int argc, char** argv) {
  CommandLine line("Tell what an output folder holds, what it was made from, and what is missing.", "status");
  fs::path folder;
  line.add("folder", folder, "Output folder of a run").required();
  return run_command(line, argc, argv, [&] { return tell_status(folder); });
}

}  // namespace quorum
