// What a user can get wrong: one line that names the place and the remedy, the right exit code, nothing half-written.
#include <sys/mount.h>

#include <fstream>
#include <iterator>
#include <sstream>

#include "tests/tools/tool_test.h"

namespace quorum {
namespace {

class BadInput : public ToolTest {
 protected:
  void SetUp() override { synthesize(8, 64); }

  [[nodiscard]] std::filesystem::path result() const { return below("result"); }
  [[nodiscard]] std::filesystem::path par_file() const { return scene() / "temple_par.txt"; }

  /// Reconstructs the scene; more comes behind the usual arguments.
  ProgramResult reconstruct(const std::vector<std::string>& more = {}, const ProgramSetting& setting = {}) {
    std::vector<std::string> arguments = {"reconstruct", scene().string(), "-o", result().string(), "--quiet"};
    arguments.insert(arguments.end(), kKeepAll.begin(), kKeepAll.end());
    if (std::ranges::count(more, "--device") == 0) arguments.insert(arguments.end(), {"--device", "cpu"});
    arguments.insert(arguments.end(), more.begin(), more.end());
    return quorum_program(arguments, setting);
  }

  /// The run fails with exit code 3 and leaves no mesh, no report and no temporary file.
  void expect_refused(const std::vector<std::string>& parts, const std::vector<std::string>& more = {}) {
    expect_failure(reconstruct(more), 3, parts);
    expect_nothing_half_written();
  }

  void expect_nothing_half_written() {
    for (const auto& [name, bytes] : files_below(result())) {
      EXPECT_FALSE(contains(name, ".tmp")) << name;
      EXPECT_NE(name, "mesh.ply");
      EXPECT_NE(name, "run.json");
    }
  }

  std::vector<std::string> par_lines() {
    std::istringstream text(file_bytes(par_file()));
    std::vector<std::string> lines;
    for (std::string line; std::getline(text, line);) lines.push_back(line);
    return lines;
  }

  void write_par(const std::vector<std::string>& lines) {
    std::string text;
    for (const std::string& line : lines) text += line + "\n";
    write_text(par_file(), text);
  }

  /// Replaces a field of the view on a line of the par file; the name is field 0.
  void set_field(std::size_t line, std::size_t field, const std::string& value) {
    auto lines = par_lines();
    std::istringstream text(lines[line]);
    std::vector<std::string> fields{std::istream_iterator<std::string>(text), {}};
    fields[field] = value;
    lines[line].clear();
    for (const std::string& part : fields) lines[line] += part + " ";
    write_par(lines);
  }
};

TEST_F(BadInput, GoodSceneIsTaken) {
  EXPECT_EQ(reconstruct().exit_code, 0);
  EXPECT_TRUE(std::filesystem::exists(result() / "mesh.ply"));
}

TEST_F(BadInput, MissingFolderIsNamed) {
  std::filesystem::remove_all(scene());
  expect_refused({scene().string(), "no such folder", "check the path"});
}

TEST_F(BadInput, FolderWithoutCamerasIsNamed) {
  std::filesystem::remove(par_file());
  expect_refused({scene().string(), "*_par.txt"});
}

TEST_F(BadInput, EmptyParFileIsRefused) {
  write_text(par_file(), "");
  expect_refused({"temple_par.txt", "0 views", "3 or more"});
}

TEST_F(BadInput, ParLineWithTooFewFieldsIsNamed) {
  auto lines = par_lines();
  lines[2] = "temple0002.png 1 2 3";
  write_par(lines);
  expect_refused({"temple_par.txt:3", "expected 22 fields, found 4"});
}

TEST_F(BadInput, ParFieldThatIsNoNumberIsNamed) {
  set_field(3, 1, "wide");
  expect_refused({"temple_par.txt:4", "k11", "wide", "not a number"});
}

TEST_F(BadInput, WrongCountIsNamed) {
  auto lines = par_lines();
  lines[0] = "9";
  write_par(lines);
  expect_refused({"temple_par.txt:1", "9 views, but 8", "correct the count"});
}

TEST_F(BadInput, AbsentImagesAreNamedWithTheirLineWhereTooFewAreLeft) {
  for (int i = 3; i <= 8; ++i) std::filesystem::remove(scene() / ("temple000" + std::to_string(i) + ".png"));
  expect_refused({"temple_par.txt:4", "temple0003.png", "add it", "2 of 8"});
}

TEST_F(BadInput, IntrinsicsThatAreNoCameraAreRefused) {
  set_field(1, 1, "0");
  expect_refused({"temple_par.txt:2", "K is singular"});
}

TEST_F(BadInput, RotationThatIsNoneIsRefused) {
  set_field(1, 10, "2.5");
  expect_refused({"temple_par.txt:2", "R is not a rotation"});
}

TEST_F(BadInput, DamagedImageIsNamedAndHasNoDepthMap) {
  write_text(scene() / "temple0005.png", "no picture");
  expect_refused({"temple0005.png", "replace the file"});
  EXPECT_FALSE(std::filesystem::exists(result() / "depth" / "temple0005.depth.pfm"));
}

TEST_F(BadInput, CutOffImageIsNamed) {
  const std::string bytes = file_bytes(scene() / "temple0005.png");
  write_text(scene() / "temple0005.png", bytes.substr(0, 40));
  expect_refused({"temple0005.png", "replace the file"});
}

TEST_F(BadInput, AMiddleburyImageOfAnotherSizeIsTakenAtItsOwn) {
  const ProgramResult larger =
      quorum_program({"synthesize", below("larger").string(), "--views", "3", "--width", "80"});
  ASSERT_EQ(larger.exit_code, 0) << larger.err;
  std::filesystem::copy_file(below("larger") / "temple0002.png", scene() / "temple0004.png",
                             std::filesystem::copy_options::overwrite_existing);
  const ProgramResult taken = reconstruct();
  EXPECT_EQ(taken.exit_code, 0) << taken.err;
  EXPECT_TRUE(std::filesystem::exists(result() / "depth" / "temple0004.depth.pfm"));
}

TEST_F(BadInput, MissingBoundsAreFound) {
  std::filesystem::remove(scene() / "README.txt");
  const ProgramResult result = reconstruct();
  EXPECT_EQ(result.exit_code, 0) << result.err;
}

TEST_F(BadInput, AnEmptyMeshIsAFailure) {
  expect_failure(reconstruct({"--threshold", "0.99", "--min-votes", "4"}), 3,
                 {"mesh.ply", "the mesh is empty", "--bounds"});
}

TEST_F(BadInput, DamagedBoundsAreNamedWithTheirLine) {
  write_text(scene() / "README.txt", "The (tight) bounding box is\n(0 0 zero)\n(1 1 1)\n");
  expect_refused({"README.txt:2", "(x y z)", "--bounds"});
}

TEST_F(BadInput, EmptyBoundsAreRefused) { expect_refused({"empty", "--bounds"}, {"--bounds", "0 0 0 1 0 1"}); }

TEST_F(BadInput, InvertedBoundsAreRefused) {
  expect_refused({"empty", "--bounds"}, {"--bounds", "0.1", "0.1", "0.1", "-0.1", "-0.1", "-0.1"});
}

TEST_F(BadInput, BoundsThatNoViewSeesAreRefused) {
  expect_refused({"no view sees", "--bounds"}, {"--bounds", "100 100 100 101 101 101"});
}

TEST_F(BadInput, MissingMaskIsNamed) {
  std::filesystem::create_directory(below("masks"));
  expect_refused({below("masks").string(), "temple0001.png.png"}, {"--masks", below("masks").string()});
  expect_refused({below("none").string(), "no such folder"}, {"--masks", below("none").string()});
}

TEST_F(BadInput, OutputBelowAFileIsRefused) {
  write_text(below("file"), "kept");
  const ProgramResult refused = quorum_program(
      {"reconstruct", scene().string(), "-o", (below("file") / "result").string(), "--device", "cpu", "--quiet"});
  expect_failure(refused, 3, {"file/result", "not a folder"});
  EXPECT_EQ(file_bytes(below("file")), "kept");
}

TEST_F(BadInput, FileThatCannotGrowLeavesNothingHalfWritten) {
  // A depth map takes 12 KiB and fails at once; the limit stands for a disk that fills while a file is written.
  const ProgramResult refused = reconstruct({}, {.file_size_limit = 8 << 10});
  expect_failure(refused, 3, {"temple0001", "cannot write", "choose another output folder"});
  for (const auto& [name, bytes] : files_below(result())) EXPECT_FALSE(name.ends_with(".pfm")) << name;
  expect_nothing_half_written();
}

/// A file system of a given size while it lives.
class SmallDisk {
 public:
  SmallDisk(const std::filesystem::path& folder, const std::string& size) : folder_(folder) {
    std::filesystem::create_directory(folder);
    mounted_ = ::mount("tmpfs", folder.c_str(), "tmpfs", 0, ("size=" + size).c_str()) == 0;
  }
  ~SmallDisk() {
    if (mounted_) ::umount2(folder_.c_str(), MNT_DETACH);
  }
  SmallDisk(const SmallDisk&) = delete;
  SmallDisk& operator=(const SmallDisk&) = delete;
  [[nodiscard]] bool mounted() const { return mounted_; }

 private:
  std::filesystem::path folder_;
  bool mounted_ = false;
};

TEST_F(BadInput, FullDiskLeavesNothingHalfWritten) {
  const SmallDisk disk(result(), "64k");
  if (!disk.mounted()) GTEST_SKIP() << "a file system can't be mounted here";
  expect_failure(reconstruct(), 3, {result().string(), "no space left", "free some space"});
  expect_nothing_half_written();
  for (const auto& [name, bytes] : files_below(result())) {
    if (!name.ends_with(".pfm")) continue;
    EXPECT_GE(bytes.size(), 64U * 48U * 4U) << name;
  }
}

TEST_F(BadInput, UnknownDeviceGivesExitCodeFour) {
  expect_failure(reconstruct({"--device", "no-such-device"}), 4, {"--device no-such-device", "cpu"});
  expect_nothing_half_written();
}

TEST_F(BadInput, WithoutDriversADeviceIsRefusedAndAutoWorks) {
  const ProgramSetting no_driver{
      .environment = {{"VK_ICD_FILENAMES", "/nonexistent.json"}, {"VK_DRIVER_FILES", "/nonexistent.json"}}};
  expect_failure(reconstruct({"--device", "0"}, no_driver), 4, {"cpu"});
  expect_nothing_half_written();
  const ProgramResult automatic = reconstruct({"--device", "auto"}, no_driver);
  EXPECT_EQ(automatic.exit_code, 0) << automatic.err;
  EXPECT_EQ(automatic.err, "");
  EXPECT_TRUE(std::filesystem::exists(result() / "mesh.ply"));
}

TEST_F(BadInput, FuseWithoutDepthMapsAsksForThem) {
  expect_failure(quorum_program({"fuse", scene().string(), "-o", result().string(), "--quiet"}), 3,
                 {"holds no depth map", "quorum depth"});
  expect_nothing_half_written();
}

TEST_F(BadInput, FuseRefusesADamagedDepthMap) {
  ASSERT_EQ(quorum_program({"depth", scene().string(), "-o", result().string(), "--device", "cpu"}).exit_code, 0);
  write_text(result() / "depth" / "temple0002.depth.pfm", "Pf\n64 48\n-1\nshort");
  std::filesystem::remove(result() / "run.json");
  expect_failure(quorum_program({"fuse", scene().string(), "-o", result().string(), "--device", "cpu", "--quiet"}), 3,
                 {"temple0002.depth.pfm"});
  expect_nothing_half_written();
}

TEST_F(BadInput, RenderNamesTheViewsThatThereAre) {
  expect_failure(quorum_program({"render", (scene() / "gt.ply").string(), "--scene", scene().string(), "--view", "dino",
                                 "-o", below("a.png").string()}),
                 2, {"--view dino", "temple0001", "temple0008"});
  EXPECT_FALSE(std::filesystem::exists(below("a.png")));
}

TEST_F(BadInput, RenderByErrorNeedsTheTruth) {
  const std::string mesh = (scene() / "gt.ply").string();
  const std::vector<std::string> arguments = {
      "render",    mesh,    "--scene", scene().string(),       "--view", "temple0001",
      "--shading", "error", "-o",      below("a.png").string()};
  expect_failure(quorum_program(arguments), 2, {"--shading error", "--truth"});
  const auto with = [&](std::vector<std::string> more) {
    more.insert(more.begin(), arguments.begin(), arguments.end());
    return quorum_program(more);
  };
  expect_failure(with({"--truth", below("none.ply").string()}), 3, {"none.ply"});
  expect_failure(with({"--truth", mesh, "--full-error", "-1"}), 2, {"--full-error"});
  EXPECT_FALSE(std::filesystem::exists(below("a.png")));
}

TEST_F(BadInput, ExperimentNamesWhatItKnowsAndWhatItMisses) {
  expect_failure(quorum_program({"experiment", "colors", "-o", result().string(), "--device", "cpu"}), 2,
                 {"colors: no such experiment", "window", "threshold"});
  expect_failure(quorum_program({"experiment", "window", "-o", result().string(), "--threads", "-1"}), 2,
                 {"--threads -1"});
  expect_failure(quorum_program({"experiment", "-o", result().string()}), 2, {"names"});
  write_text(below("file"), "");
  expect_failure(
      quorum_program({"experiment", "window", "-o", (below("file") / "x").string(), "--device", "cpu", "--quiet"}), 3,
      {"file/x"});
}

TEST_F(BadInput, CamerasOfOtherPhotographsAreToldAndTinyScenesAreNot) {
  const auto notes = [&](int views, int width, double focal_factor, const std::vector<std::string>& more = {}) {
    for (const auto& place : {scene(), result()}) std::filesystem::remove_all(place);
    synthesize(views, width);
    for (std::size_t line = 1; line <= static_cast<std::size_t>(views); ++line)
      for (const std::size_t field : {1U, 5U}) {
        std::istringstream text(par_lines()[line]);
        const std::vector<std::string> fields{std::istream_iterator<std::string>(text), {}};
        set_field(line, field, std::to_string(focal_factor * std::stod(fields[field])));
      }
    std::vector<std::string> arguments = {"reconstruct", scene().string(), "-o", result().string(), "--device", "cpu"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return quorum_program(arguments).err;
  };
  const std::string doubt = "belong to these photographs";
  EXPECT_TRUE(contains(notes(8, 160, 0.6), "other views confirm only"));
  EXPECT_TRUE(contains(notes(8, 160, 0.6), doubt));
  EXPECT_FALSE(contains(notes(8, 160, 1.0), doubt));
  const std::string tiny = notes(6, 128, 0.6);
  EXPECT_TRUE(contains(tiny, "check the cameras") || contains(tiny, doubt)) << tiny;  // nothing is left, or crumbs
  const std::vector<std::string> keep_all = {"--no-confirm", "--min-confidence", "0", "--min-component", "0"};
  EXPECT_TRUE(contains(notes(8, 160, 0.3, keep_all), "of the pixels got a depth"));
  EXPECT_FALSE(contains(notes(6, 96, 1.0), doubt)) << "5 % of so few pixels say nothing";
}

TEST_F(BadInput, EvaluateNamesTheFileThatIsMissingOrDamaged) {
  const std::string truth = (scene() / "gt.ply").string();
  expect_failure(quorum_program({"evaluate", below("none.ply").string(), truth}), 3, {"none.ply", "check the path"});
  write_text(below("bad.ply"), "ply\nformat ascii 1.0\nelement vertex 1\nproperty float x\nend_header\n0\n");
  expect_failure(quorum_program({"evaluate", below("bad.ply").string(), truth}), 3, {"bad.ply"});
}

}  // namespace
}  // namespace quorum
