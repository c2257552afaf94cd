#ifndef meltfront_verification_app_tests_run_program_h
#define meltfront_verification_app_tests_run_program_h

#include <verification/record/temporary_directory.h>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>
#include <thread>

/** The program called as a user calls it. */
namespace meltfront::verification::tests
{
  namespace fs = std::filesystem;
  using meltfront::verification::TemporaryDirectory;

  struct Outcome
  {
    int status = -1;
    std::string output; ///< standard output and standard error
  };

  /** Run the program as a user would. */
  inline Outcome run_program(const std::string &arguments)
  {
    Outcome outcome;
    std::FILE *pipe = popen(
        (std::string(MELTFRONT_PROGRAM) + " " + arguments + " 2>&1").c_str(), "r");
    if(pipe == nullptr)
      return outcome;
    char buffer[4096];
    while(const std::size_t size = std::fread(buffer, 1, sizeof(buffer), pipe))
      outcome.output.append(buffer, size);
    const int status = pclose(pipe);
    outcome.status = WIFEXITED(status) ? WEXITSTATUS(status) : -1;
    return outcome;
  }

  /** Start the program in a session of its own and kill all of it after a moment. */
  inline void run_and_kill(const std::string &arguments, double seconds)
  {
    const pid_t child = fork();
    if(child == 0)
    {
      setsid();
      const std::string command = "exec " + std::string(MELTFRONT_PROGRAM) + " "
                                  + arguments + " >/dev/null 2>&1";
      execl("/bin/sh", "sh", "-c", command.c_str(), nullptr);
      _exit(127);
    }
    std::this_thread::sleep_for(std::chrono::duration<double>(seconds));
    kill(-child, SIGKILL);
    waitpid(child, nullptr, 0);
  }

  inline nlohmann::json read_json(const fs::path &path)
  {
    std::ifstream in(path);
    return nlohmann::json::parse(in);
  }

  inline void expect_text(const Outcome &outcome, const std::string &text)
  {
    EXPECT_NE(outcome.output.find(text), std::string::npos) << outcome.output;
  }
} // namespace meltfront::verification::tests

#endif
