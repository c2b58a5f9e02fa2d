// How the program answers to what is typed.
#include <nlohmann/json.hpp>

#include "tests/tools/tool_test.h"

namespace quorum {
namespace {

const std::vector<std::string> kCommands = {"reconstruct", "depth",   "fuse",  "evaluate", "render",
                                            "synthesize",  "devices", "bench", "status",   "confirm",
                                            "join",        "plan",    "submit"};

TEST(CommandLine, VersionIsPrinted) {
  const ProgramResult result = quorum_program({"--version"});
  EXPECT_EQ(result.exit_code, 0);
  EXPECT_TRUE(result.out.starts_with("quorum ")) << result.out;
  EXPECT_EQ(std::ranges::count(result.out, '.'), 2) << result.out;
  EXPECT_EQ(result.err, "");
}

TEST(CommandLine, HelpListsEveryCommand) {
  const ProgramResult result = quorum_program({"--help"});
  EXPECT_EQ(result.exit_code, 0);
  EXPECT_EQ(result.err, "");
  for (const std::string& command : kCommands) EXPECT_TRUE(contains(result.out, "\n  " + command + " ")) << command;
}

TEST(CommandLine, NothingTypedPrintsTheHelpAsAnError) {
  const ProgramResult result = quorum_program({});
  EXPECT_EQ(result.exit_code, 2);
  EXPECT_EQ(result.out, "");
  EXPECT_EQ(result.err, quorum_program({"--help"}).out);
}

TEST(CommandLine, UnknownCommandIsNamed) {
  expect_failure(quorum_program({"recnstruct"}), 2, {"recnstruct", "quorum --help"});
}

TEST(CommandLine, MistypedCommandsAndOptionsGetASuggestion) {
  expect_failure(quorum_program({"recnstruct"}), 2, {"did you mean reconstruct?"});
  expect_failure(quorum_program({"stauts"}), 2, {"did you mean status?"});
  expect_failure(quorum_program({"reconstruct", "scene", "-o", "o", "--widow", "5"}), 2, {"did you mean --window?"});
  expect_failure(quorum_program({"fuse", "scene", "-o", "o", "--voxelsize=1mm"}), 2, {"did you mean --voxel-size?"});
  EXPECT_FALSE(contains(quorum_program({"xyzzy"}).err, "did you mean"));
}

TEST(CommandLine, HelpOfACommandIsAlsoHelpCommand) {
  EXPECT_EQ(quorum_program({"help", "fuse"}).out, quorum_program({"fuse", "--help"}).out);
  EXPECT_EQ(quorum_program({"help"}).out, quorum_program({"--help"}).out);
  expect_failure(quorum_program({"help", "fuze"}), 2, {"did you mean fuse?"});
}

TEST(CommandLine, EveryCommandHasHelp) {
  for (const std::string& command : kCommands) {
    const ProgramResult result = quorum_program({command, "--help"});
    EXPECT_EQ(result.exit_code, 0) << command;
    EXPECT_EQ(result.err, "") << command;
    EXPECT_TRUE(contains(result.out, "Usage: " + command)) << result.out;
    EXPECT_TRUE(contains(result.out, "--help")) << result.out;
  }
}

TEST(CommandLine, UnknownOptionPointsToTheHelp) {
  for (const std::string& command : kCommands)
    expect_failure(quorum_program({command, "--no-such-option"}), 2, {command + ":", "quorum " + command + " --help"});
}

TEST(CommandLine, MissingArgumentsAreNamed) {
  expect_failure(quorum_program({"reconstruct"}), 2, {"scene", "required"});
  expect_failure(quorum_program({"reconstruct", "scene"}), 2, {"--output", "required"});
  expect_failure(quorum_program({"render", "mesh.ply", "--scene", "scene", "-o", "a.png"}), 2, {"--view", "required"});
  expect_failure(quorum_program({"evaluate", "mesh.ply"}), 2, {"truth", "required"});
}

struct WrongValue {
  std::vector<std::string> words;
  std::string range;  // what the message says of the values that are right
};

void PrintTo(const WrongValue& wrong, std::ostream* out) {
  for (const std::string& word : wrong.words) *out << word << ' ';
}

class WrongValues : public testing::TestWithParam<WrongValue> {};

TEST_P(WrongValues, AreRefusedWithOptionAndRange) {
  std::vector<std::string> arguments = {"reconstruct", "scene", "-o", "result"};
  arguments.insert(arguments.end(), GetParam().words.begin(), GetParam().words.end());
  expect_failure(quorum_program(arguments), 2, {GetParam().words[0], GetParam().range});
}

INSTANTIATE_TEST_SUITE_P(Reconstruct, WrongValues,
                         testing::Values(WrongValue{{"--neighbors", "1"}, "2 to 32"},             //
                                         WrongValue{{"--neighbors", "four"}, "four"},             //
                                         WrongValue{{"--min-angle", "91"}, "0 to 90"},            //
                                         WrongValue{{"--max-angle", "0"}, "1 to 180"},            //
                                         WrongValue{{"--window", "4"}, "3 to 15"},                //
                                         WrongValue{{"--second-window", "5"}, "above --window"},  //
                                         WrongValue{{"--second-window", "8"}, "5 to 15, odd"},    //
                                         WrongValue{{"--window-model", "disc"}, "axis"},          //
                                         WrongValue{{"--threshold", "1"}, "0 to 0.99"},           //
                                         WrongValue{{"--threshold", "nan"}, "0 to 0.99"},         //
                                         WrongValue{{"--min-votes", "0"}, "1 to 32"},             //
                                         WrongValue{{"--min-votes", "5"}, "--neighbors"},         //
                                         WrongValue{{"--depth-step", "0"}, "positive"},           //
                                         WrongValue{{"--depth-step", "2.5in"}, "2.5mm"},          //
                                         WrongValue{{"--depth-step", "-1mm"}, "positive"},        //
                                         WrongValue{{"--step-pixels", "0.01"}, "0.05 to 8"},      //
                                         WrongValue{{"--support-tolerance", "256"}, "0 to 255"},  //
                                         WrongValue{{"--refinement", "33"}, "1 to 32"},           //
                                         WrongValue{{"--mask-below", "1"}, "0 to 0.999"},         //
                                         WrongValue{{"--voxel-size", "inf"}, "positive"},         //
                                         WrongValue{{"--max-slope", "90"}, "10 to 89"},           //
                                         WrongValue{{"--feather", "9"}, "0 to 8"},                //
                                         WrongValue{{"--min-confidence", "-1"}, "0 or more"},     //
                                         WrongValue{{"--min-component", "-1"}, "0 or more"},      //
                                         WrongValue{{"--weights", "slant,none"}, "commas"},       //
                                         WrongValue{{"--threads", "-1"}, "0 to 1024"},            //
                                         WrongValue{{"--tile", "4", "16"}, "8 to 64"},            //
                                         WrongValue{{"--simd", "mmx"}, "baseline"},               //
                                         WrongValue{{"--memory", "1"}, "512MiB"},                 //
                                         WrongValue{{"--memory", "0GiB"}, "512MiB"},              //
                                         WrongValue{{"--memory", "1GiBs"}, "4GiB"},               //
                                         WrongValue{{"--memory", "nanGiB"}, "4GiB"},              //
                                         WrongValue{{"--memory", "-1GiB"}, "auto"},               //
                                         WrongValue{{"--bounds", "1", "2", "3"}, "six"},          //
                                         WrongValue{{"--bounds", "0 0 0 1 1 x"}, "x0 y0 z0 x1 y1 z1"}));

TEST(CommandLine, TruncationMustFitTheVoxels) {
  expect_failure(
      quorum_program({"reconstruct", "scene", "-o", "result", "--voxel-size", "1mm", "--truncation", "100mm"}), 2,
      {"--truncation", "1.5 to 32"});
}

TEST(CommandLine, WrongValuesOfOtherCommandsAreRefusedWithOptionAndRange) {
  expect_failure(quorum_program({"synthesize", "scene", "--views", "2"}), 2, {"--views", "3 to 1024"});
  expect_failure(quorum_program({"synthesize", "scene", "--width", "63"}), 2, {"--width", "64 to 8192"});
  expect_failure(quorum_program({"synthesize", "scene", "--noise", "65"}), 2, {"--noise", "0 to 64"});
  expect_failure(quorum_program({"synthesize", "scene", "--texture", "5"}), 2, {"--texture", "0 to 4"});
  expect_failure(quorum_program({"synthesize", "scene", "--cameras", "line"}), 2, {"--cameras", "hemisphere"});
  expect_failure(quorum_program({"evaluate", "a.ply", "b.ply", "--share", "2"}), 2, {"--share", "0 to 1"});
  expect_failure(quorum_program({"evaluate", "a.ply", "b.ply", "--threshold", "0"}), 2, {"--threshold", "positive"});
  expect_failure(quorum_program({"evaluate", "a.ply", "b.ply", "--distances", "x"}), 2, {"--distances", "positive"});
  expect_failure(quorum_program({"evaluate", "a.ply", "b.ply", "--samples", "0"}), 2, {"--samples", "1 to 100000000"});
  expect_failure(quorum_program({"synthesize", "scene", "--seed", "-1"}), 2, {"--seed", "0 or more"});
  EXPECT_FALSE(std::filesystem::exists("scene"));
}

TEST(CommandLine, DevicesPrintsJson) {
  const ProgramResult result = quorum_program({"devices", "--json"});
  ASSERT_EQ(result.exit_code, 0) << result.err;
  const auto json = nlohmann::json::parse(result.out, nullptr, false);
  ASSERT_FALSE(json.is_discarded()) << result.out;
  EXPECT_TRUE(json["devices"].is_array());
  EXPECT_TRUE(json["cpu"].is_string());
  EXPECT_FALSE(json["chosen"].get<std::string>().empty());
  EXPECT_FALSE(json["reason"].get<std::string>().empty());
}

TEST(CommandLine, DevicesChoosesTheCpuWhenAsked) {
  const ProgramResult result = quorum_program({"devices", "--device", "cpu", "--json"});
  ASSERT_EQ(result.exit_code, 0) << result.err;
  const auto json = nlohmann::json::parse(result.out, nullptr, false);
  ASSERT_FALSE(json.is_discarded()) << result.out;
  EXPECT_EQ(json["chosen"], json["cpu"]);
}

}  // namespace
}  // namespace quorum
