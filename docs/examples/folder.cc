// A scene of any format into a workspace, as `quorum reconstruct SCENE -o OUT` does. Ctrl-C stops after a view, and the
// same command goes on from there.
#include <quorum/quorum.h>

#include <atomic>
#include <csignal>
#include <cstdio>
#include <string>

namespace {

std::atomic<bool> interrupted = false;

int fail(const quorum::Error& error) {
  std::fprintf(stderr, "folder: %s\n", error.message.c_str());
  return static_cast<int>(error.kind);
}

}  // namespace

int main(int argc, char** argv) {
  if (argc < 3) {
    std::fprintf(stderr, "usage: folder SCENE OUT [OPTION VALUE]...   (an option: quality draft)\n");
    return 2;
  }
  std::signal(SIGINT, [](int) { interrupted = true; });

  quorum::Options options;
  for (int i = 3; i + 1 < argc; i += 2) options.set(argv[i], argv[i + 1]);
  const auto scene = quorum::Scene::read(argv[1], options);
  if (!scene) return fail(scene.error());

  quorum::RunSettings settings;
  settings.workspace = argv[2];
  settings.on_progress = [](const quorum::Progress& progress) {
    std::fprintf(stderr, "%3.0f %% %s %d/%d\n", progress.run_percent, std::string(progress.stage).c_str(),
                 progress.done, progress.steps);
  };
  settings.on_note = [](std::string_view line) { std::fprintf(stderr, "%s\n", std::string(line).c_str()); };
  settings.should_stop = [] { return interrupted.load(); };
  const auto results = quorum::reconstruct(*scene, options, settings);
  if (!results) return fail(results.error());

  for (int view = 0; view < scene->view_count(); ++view) {
    if (!results->has_depth_map(view)) continue;
    const auto map = results->depth_map(view);
    if (!map) return fail(map.error());
    std::size_t pixels = 0;
    for (const float depth : map->depth) pixels += depth > 0 ? 1 : 0;
    std::printf("%s: %zu of %zu pixels have a depth\n", scene->view(view).name.c_str(), pixels, map->depth.size());
  }
  const auto mesh = results->mesh();
  if (!mesh) return fail(mesh.error());
  std::printf("mesh: %zu vertices, %zu triangles\n", mesh->vertex_count(), mesh->triangle_count());
}
