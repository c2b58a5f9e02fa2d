#include "engine/pipeline/progress_meter.h"

#include <gtest/gtest.h>

namespace quorum {
namespace {

TEST(ProgressMeter, TellsPercentRateAndTimeLeft) {
  ProgressMeter meter({{"first", 3.0}, {"second", 1.0}});
  EXPECT_EQ(meter.run_percent(), 0.0);
  EXPECT_FALSE(meter.seconds_left());
  meter.stage("first", 4, 100.0);
  EXPECT_FALSE(meter.run_seconds_left());
  meter.step(102.0);
  EXPECT_DOUBLE_EQ(meter.percent(), 25.0);
  EXPECT_DOUBLE_EQ(meter.rate(), 0.5);
  EXPECT_DOUBLE_EQ(*meter.seconds_left(), 6.0);
  EXPECT_DOUBLE_EQ(meter.run_percent(), 18.75);
  EXPECT_NEAR(*meter.run_seconds_left(), 8.667, 0.001);
}

TEST(ProgressMeter, StagesThatAreSkippedOrUnknownKeepTheRunMonotonic) {
  ProgressMeter meter({{"first", 3.0}, {"second", 1.0}});
  meter.stage("second", 2, 0.0);
  EXPECT_DOUBLE_EQ(meter.run_percent(), 75.0);
  meter.step(1.0);
  EXPECT_DOUBLE_EQ(meter.run_percent(), 87.5);
  meter.step(2.0);
  meter.end_stage();
  EXPECT_DOUBLE_EQ(meter.run_percent(), 100.0);
  EXPECT_EQ(meter.steps(), 0);
  meter.stage("second", 2, 3.0);  // as for the next slab
  EXPECT_DOUBLE_EQ(meter.run_percent(), 100.0);
  meter.stage("other", 2, 3.0);
  EXPECT_DOUBLE_EQ(meter.run_percent(), 100.0);
}

TEST(ProgressMeter, DurationsReadWell) {
  EXPECT_EQ(duration_text(12.4), "12 s");
  EXPECT_EQ(duration_text(600), "10 min");
  EXPECT_EQ(duration_text(9000), "2.5 h");
}

}  // namespace
}  // namespace quorum
