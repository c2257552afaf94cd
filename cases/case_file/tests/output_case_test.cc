#include <cases/case_file/output_reader.h>
#include <cases/case_file/tests/sample_case.h>

#include <gtest/gtest.h>

using namespace meltfront::cases;
using namespace meltfront::cases::test;

namespace
{
  std::string slab_with_output(const std::string &keys)
  {
    return with(slab, "subsection Output\n" + keys + "end\n");
  }
} // namespace

TEST(Output, PlacesAndTimesAreRead)
{
  const OutputRequest output = output_of(
      read(slab_with_output("  set probe 1 = 1 cm\n  set probe 3 = 0.1\n  set line 1 = "
                            "0, 5 cm\n  set line times = 10, 1 min\n")));
  ASSERT_EQ(output.probes.size(), 2u);
  EXPECT_DOUBLE_EQ(output.probes[0][0], 0.01);
  ASSERT_EQ(output.lines.size(), 1u);
  EXPECT_DOUBLE_EQ(output.lines[0].to[0], 0.05);
  EXPECT_EQ(output.line_times, (std::vector<double>{10, 60, 100}));
  EXPECT_TRUE(output_of(read(slab)).probes.empty());
  EXPECT_TRUE(output_of(read(slab)).lines.empty());
}

TEST(Output, WhatLiesOutsideIsRefused)
{
  for(const auto &[keys, piece] :
      {std::pair{"  set probe 1 = 0.2\n", "lies outside of the domain"},
       {"  set probe 1 = 0.05, 0.01\n", "needs 1 number in this domain, not 2"},
       {"  set line 1 = 0.05\n", "needs 2 numbers"},
       {"  set line times = 200\n", "must ascend from the scene's start"},
       {"  set line times = 20, 10\n", "must ascend"}})
    EXPECT_NE(complaint(slab_with_output(keys)).find(piece), std::string::npos)
        << complaint(slab_with_output(keys));
}
