#ifndef meltfront_verification_external_tests_processes_h
#define meltfront_verification_external_tests_processes_h

#include <chrono>
#include <fstream>
#include <string>
#include <thread>

namespace meltfront::verification::tests
{
  /** Whether a process is there and does not only wait to be taken note of. */
  inline bool runs(int process)
  {
    std::ifstream in("/proc/" + std::to_string(process) + "/stat");
    std::string number, name, state;
    return static_cast<bool>(in >> number >> name >> state) && state != "Z";
  }

  /** Look again and again, for ten seconds at most. */
  template <typename Condition>
  bool comes_true(const Condition &condition)
  {
    for(int i = 0; i < 1000 && !condition(); ++i)
      std::this_thread::sleep_for(std::chrono::milliseconds(10));
    return condition();
  }
} // namespace meltfront::verification::tests

#endif
