#ifndef meltfront_verification_run_memory_limit_h
#define meltfront_verification_run_memory_limit_h

#include <string>

namespace meltfront::verification
{
  /**
   * Memory that the machine has for new processes (bytes): MemAvailable of /proc/meminfo,
   * or the limit of the control group if that is lower; infinite where neither tells.
   * @param root of the file system, for tests
   */
  double available_memory(const std::string &root = "");

  /**
   * From now on allocations of this process beyond a limit fail (std::bad_alloc), before
   * the machine has to kill it. An infinite limit sets none.
   * @param threads whose stacks are reserved on top of it
   */
  void limit_memory(double bytes, int threads);
} // namespace meltfront::verification

#endif
