#include "engine/conformance/conformance.h"

#include <gtest/gtest.h>

#include <cstdlib>

#include "engine/io/file.h"
#include "engine/io/sha256.h"
#include "engine/pipeline/cpu_backend.h"
#include "tests/support/test_support.h"

namespace quorum {
namespace {

TEST(Sha256, GivesTheDigestsOfTheStandard) {
  EXPECT_EQ(sha256(""), "e3b0c44298fc1c149afbf4c8996fb92427ae41e4649b934ca495991b7852b855");
  EXPECT_EQ(sha256("abc"), "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad");
  Sha256 pieces;
  pieces.add("a");
  pieces.add("");
  pieces.add("bc");
  EXPECT_EQ(pieces.hex(), sha256("abc"));
}

class Conformance : public testing::TestWithParam<std::size_t> {};

TEST_P(Conformance, TheCpuGivesTheBytesOfTheDocs) {
  const ConformanceCase& conformance = conformance_cases()[GetParam()];
  if (!conformance.quick) GTEST_SKIP() << "`quorum verify` runs this case";
  const TemporaryFolder folder;
  CpuBackend cpu({SimdLevel::kBaseline, 40, 16});
  Progress progress;
  const auto found = run_conformance(conformance, cpu, folder.path(), progress);
  ASSERT_TRUE(found) << found.error().message;
  for (std::size_t stage = 0; stage < found->size(); ++stage)
    EXPECT_EQ((*found)[stage], conformance.expected[stage])
        << conformance.name << ": other " << kConformanceStages[stage]
        << ". If results are to change, raise the version of the stage and put the new digest into "
           "conformance_cases.cc";
}

INSTANTIATE_TEST_SUITE_P(Cases, Conformance, testing::Range(std::size_t{0}, conformance_cases().size()));

TEST(ConformanceCases, TheFirstDifferenceIsTold) {
  const ConformanceCase& first = conformance_cases()[0];
  ConformanceHashes found = first.expected;
  EXPECT_EQ(first_difference(first, found), "");
  found[3] = "other";
  EXPECT_EQ(first_difference(first, found), "mesh");
  found[2] = "other";
  EXPECT_EQ(first_difference(first, found), "depth maps");
}

TEST(ConformanceCases, TheDocsSayWhatTheyMustGive) {
  const std::string path = (source_folder() / "docs/conformance.md").string();
  auto page = read_file(path);
  ASSERT_TRUE(page) << page.error().message;
  const std::size_t cases = page->find("## Cases");
  ASSERT_NE(cases, std::string::npos);
  const std::string expected = page->substr(0, cases) + conformance_markdown();
  if (std::getenv("QUORUM_WRITE_DOCS") != nullptr) write_file(path, expected).value();
  EXPECT_EQ(read_file(path).value(), expected) << "run this test once with QUORUM_WRITE_DOCS=1";
}

}  // namespace
}  // namespace quorum
