#include "engine/pipeline/provenance.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "engine/pipeline/run_json.h"

namespace quorum {
namespace {

TEST(TakeSurfaceOptions, ThoseOfTheSurfaceAreTaken) {
  RunOptions options;
  const auto done = take_surface_options(
      options, R"({"options": {"feather": 3, "max_slope": 55, "window": 9}, "mask_below": 0.25, "shard": "1/2"})");
  ASSERT_TRUE(done) << done.error().message;
  RunOptions wanted;
  wanted.mask_below = 0.25;
  EXPECT_EQ(options_json(options, RunStage::kDepth, RunStage::kDepth),
            options_json(wanted, RunStage::kDepth, RunStage::kDepth));  // the window is not the surface's to say
  const auto fusion = nlohmann::json::parse(options_json(options, RunStage::kConfirm, RunStage::kFusion));
  EXPECT_EQ(fusion["feather"], 3);
  EXPECT_EQ(fusion["max_slope"], 55);
}

TEST(TakeSurfaceOptions, ValuesThatNoRunHasAreRefused) {
  for (const char* record : {R"({"options": {"feather": 99}})", R"({"options": {"feather": "wide"}})",
                             R"({"options": {}, "mask_below": 7})"}) {
    RunOptions options;
    const auto done = take_surface_options(options, record);
    ASSERT_FALSE(done) << record;
    EXPECT_FALSE(done.error().message.empty());
  }
}

TEST(TakeSurfaceOptions, WhatIsNestedDeeplyIsLeftOut) {
  constexpr std::size_t kDepth = 400'000;  // more than a stack holds, if each took a call
  RunOptions options;
  const std::string record = R"({"options": {"feather": )" + std::string(kDepth, '[') + std::string(kDepth, ']') + "}}";
  static_cast<void>(take_surface_options(options, record));
  EXPECT_TRUE(options.check());
}

}  // namespace
}  // namespace quorum
