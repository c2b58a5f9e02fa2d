// quorum photos against stand-ins for colmap.
#include <fmt/format.h>
#include <signal.h>

#include <chrono>
#include <cstdlib>
#include <thread>

#include "engine/io/colmap_model.h"
#include "engine/io/write_image.h"
#include "tests/support/colmap_scene.h"
#include "tests/support/test_support.h"
#include "tests/tools/tool_test.h"

namespace quorum {
namespace {

namespace fs = std::filesystem;

class Photos : public ToolTest {
 protected:
  /// Four photographs below scene/images, and what a mapper would find: a model of three of them and one of all.
  void SetUp() override {
    const ColmapModel all = make_colmap_model("PINHOLE");
    write_colmap_scene(scene(), all);
    ColmapModel few = all;
    few.images.resize(3);
    fs::create_directories(below("models/0"));
    fs::create_directories(below("models/1"));
    EXPECT_TRUE(write_colmap_model(below("models/0"), few));
    EXPECT_TRUE(write_colmap_model(below("models/1"), all));
    fs::create_directories(below("bin"));
  }
  /// A colmap that knows only these names of its switches, and writes down how it was called.
  void write_colmap(const std::string& extraction, const std::string& matching) {
    write_script(fmt::format(
        "case \"$1 $2\" in\n"
        "  'feature_extractor -h') echo '  --{0} arg (=1)';;\n"
        "  'exhaustive_matcher -h') echo '  --{1} arg (=1)';;\n"
        "  feature_extractor*) case \"$*\" in *--{0}\\ 0) ;; *) exit 1;; esac;;\n"
        "  exhaustive_matcher*) case \"$*\" in *--{1}\\ 0) ;; *) exit 1;; esac;;\n"
        "  mapper*) cp -r '{2}/.' '{3}/cameras/sparse';;\n"
        "  image_undistorter*) mkdir -p '{3}/cameras/dense'; cp -r '{4}/images' '{4}/sparse' '{3}/cameras/dense';;\n"
        "esac\n",
        extraction, matching, below("models").string(), below("result").string(), scene().string()));
  }
  void write_script(const std::string& body) {
    write_text(below("bin/colmap"), fmt::format("#!/bin/sh\necho \"$$ $*\" >>'{}'\n{}", below("calls").string(), body));
    fs::permissions(below("bin/colmap"), fs::perms::owner_all);
  }
  [[nodiscard]] std::vector<std::string> arguments(bool quiet) const {
    std::vector<std::string> words = {
        "photos", (scene() / "images").string(), "-o", below("result").string(), "--device", "cpu"};
    if (quiet) words.emplace_back("--quiet");
    return words;
  }
  [[nodiscard]] ProgramSetting with_colmap() const {
    ProgramSetting setting;
    setting.environment = {{"PATH", below("bin").string() + ":/usr/bin:/bin"}};
    return setting;
  }
  [[nodiscard]] std::string calls() const { return fs::exists(below("calls")) ? file_bytes(below("calls")) : ""; }
};

TEST_F(Photos, OptionsAreThoseOfTheInstalledColmap) {
  for (const auto& [extraction, matching] : {std::pair{"SiftExtraction.use_gpu", "SiftMatching.use_gpu"},
                                             {"FeatureExtraction.use_gpu", "FeatureMatching.use_gpu"}}) {
    fs::remove_all(below("result"));
    fs::remove(below("calls"));
    write_colmap(extraction, matching);
    const ProgramResult result = quorum_program(arguments(false), with_colmap());
    EXPECT_TRUE(contains(result.err, "4 of 4 photographs registered, in the largest of 2 models")) << result.err;
    EXPECT_TRUE(contains(calls(), "sparse/1 --output_path")) << calls();
    EXPECT_TRUE(fs::exists(below("result/cameras/undistorted.done"))) << result.err;
  }
}

TEST_F(Photos, FinishedStepsAreNotDoneAgain) {
  write_colmap("FeatureExtraction.use_gpu", "FeatureMatching.use_gpu");
  quorum_program(arguments(true), with_colmap());
  const std::string before = calls();
  EXPECT_TRUE(contains(before, "image_undistorter"));
  const ProgramResult again = quorum_program(arguments(false), with_colmap());
  EXPECT_EQ(calls(), before);
  EXPECT_TRUE(contains(again.err, "4 of 4 photographs registered")) << again.err;
}

TEST_F(Photos, ACutPhotographIsToldBeforeColmapBegins) {
  write_colmap("FeatureExtraction.use_gpu", "FeatureMatching.use_gpu");
  const std::string whole = encode_jpeg(ColorImage(64, 48, make_rgb(9, 8, 7)), 90).value();
  write_text(scene() / "images/e.jpg", whole.substr(0, whole.size() - 20));
  expect_failure(quorum_program(arguments(true), with_colmap()), 3, {"e.jpg", "ends too early", "copy it again"});
  EXPECT_FALSE(contains(calls(), "feature_extractor")) << calls();
}

TEST_F(Photos, PhotographsOfPhonesAreMetWithTheWayToConvertThem) {
  write_colmap("FeatureExtraction.use_gpu", "FeatureMatching.use_gpu");
  for (const char* name : {"a", "b", "c", "d"})
    fs::rename(scene() / "images" / (std::string(name) + ".png"), scene() / "images" / (std::string(name) + ".HEIC"));
  expect_failure(quorum_program(arguments(true), with_colmap()), 3, {"holds 0 photographs", "heif-convert"});
}

TEST_F(Photos, ASignalEndsColmapToo) {
  write_script("sleep 60 & wait\n");
  for (const int signal : {SIGTERM, SIGINT}) {
    fs::remove(below("calls"));
    Program program(built_program("quorum"), arguments(true), with_colmap());
    for (int wait = 0; wait < 1000 && calls().empty(); ++wait)
      std::this_thread::sleep_for(std::chrono::milliseconds(10));
    const int colmap = std::atoi(calls().c_str());
    ASSERT_GT(colmap, 0);
    const auto start = std::chrono::steady_clock::now();
    program.send(signal);
    const ProgramResult result = program.wait();
    EXPECT_LT(std::chrono::steady_clock::now() - start, std::chrono::seconds(10));
    EXPECT_TRUE(contains(result.err, "stopped")) << result.err;
    for (int wait = 0; wait < 500 && group_runs(colmap); ++wait)
      std::this_thread::sleep_for(std::chrono::milliseconds(10));
    EXPECT_FALSE(group_runs(colmap)) << "its process group is still there";
  }
}

TEST_F(Photos, OneFolderHoldsOneColmap) {
  write_script("sleep 60\n");
  Program first(built_program("quorum"), arguments(true), with_colmap());
  for (int wait = 0; wait < 1000 && calls().empty(); ++wait) std::this_thread::sleep_for(std::chrono::milliseconds(10));
  expect_failure(quorum_program(arguments(true), with_colmap()), 3, {"another quorum photos", "choose another"});
  first.send(SIGKILL);
  first.wait();
  const int colmap = std::atoi(calls().c_str());
  expect_failure(quorum_program(arguments(true), with_colmap()), 3, {"a colmap that it left"});
  ::kill(-colmap, SIGKILL);
}

TEST_F(Photos, FoldersThatLoopOrHoldTheOutputAreALine) {
  write_colmap("FeatureExtraction.use_gpu", "FeatureMatching.use_gpu");
  fs::create_symlink(scene() / "images/loop.png", scene() / "images/loop.png");
  fs::create_directory_symlink(scene() / "images", scene() / "images/again");
  const ProgramResult result = quorum_program(arguments(false), with_colmap());
  EXPECT_TRUE(contains(result.err, "of 4 photographs registered")) << result.err;
  std::vector<std::string> inside = arguments(true);
  inside[3] = (scene() / "images/out").string();
  expect_failure(quorum_program(inside, with_colmap()), 3, {"lies in the folder of photographs"});
  fs::create_symlink(below("around"), below("around"));
  inside[1] = below("around").string();
  inside[3] = below("result").string();
  expect_failure(quorum_program(inside, with_colmap()), 3, {"around", "cannot be listed"});
}

}  // namespace
}  // namespace quorum
