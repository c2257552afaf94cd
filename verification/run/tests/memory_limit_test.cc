#include <verification/run/child_process.h>
#include <verification/run/memory_limit.h>
#include <verification/run/tests/fakes.h>

#include <gtest/gtest.h>

#include <chrono>
#include <filesystem>
#include <fstream>
#include <limits>
#include <new>
#include <thread>
#include <vector>

namespace meltfront::verification
{
  namespace
  {
    void write(const std::string &file, const std::string &text)
    {
      std::filesystem::create_directories(std::filesystem::path(file).parent_path());
      std::ofstream(file) << text;
    }

    TEST(MemoryLimit, IsTheLowerOfMachineAndControlGroup)
    {
      const tests::ScratchDirectory root;
      EXPECT_EQ(available_memory(root.path()), std::numeric_limits<double>::infinity());
      write(root.path("proc/meminfo"), "MemTotal:  4000 kB\nMemAvailable:   3000 kB\n");
      EXPECT_EQ(available_memory(root.path()), 3000 * 1024.);
      write(root.path("sys/fs/cgroup/memory.max"), "max\n");
      EXPECT_EQ(available_memory(root.path()), 3000 * 1024.);
      write(root.path("sys/fs/cgroup/memory.max"), "1000000\n");
      EXPECT_EQ(available_memory(root.path()), 1e6);
    }

    TEST(MemoryLimit, IsThatOfThisMachineByDefault)
    {
      EXPECT_GT(available_memory(), 1e7);
      EXPECT_LT(available_memory(), 1e16);
    }

    TEST(MemoryLimit, MakesAllocationsBeyondItFail)
    {
#ifdef MELTFRONT_SANITIZE
      GTEST_SKIP() << "sanitizers need addresses without a limit";
#endif
      const tests::ScratchDirectory scratch;
      const std::string told = scratch.path("told");
      ChildProcess child(
          [&]
          {
            limit_memory(4e8, 1);
            const std::vector<char> little(100'000'000);
            tests::append_line(told, std::to_string(little.size()));
            try
            {
              const std::vector<char> much(1'000'000'000);
              tests::append_line(told, std::to_string(much.size()));
            }
            catch(const std::bad_alloc &)
            {
              tests::append_line(told, "no more");
            }
          },
          scratch.path("log"));
      while(!child.ended())
        std::this_thread::sleep_for(std::chrono::milliseconds(1));
      EXPECT_EQ(child.end().problem(), "");
      EXPECT_EQ(tests::lines_of(told),
                (std::vector<std::string>{"100000000", "no more"}));
    }
  } // namespace
} // namespace meltfront::verification
