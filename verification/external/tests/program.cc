// An external program for tests: it answers with the exact solution of a slab between
// walls at -1 and 1 whose properties are all 1, a front at sqrt(t)/2 and the temperature
// x - front, well or in one of many wrong ways.

#include <nlohmann/json.hpp>

#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <csignal>
#include <cstdlib>
#include <fstream>
#include <iostream>
#include <string>
#include <vector>

namespace
{
  using nlohmann::json;

  [[noreturn]] void write_for_ever(std::ostream &out)
  {
    const std::string block(1 << 20, '7');
    for(;;)
      out << block;
  }

  /** Start another process, tell the numbers of both, and sleep. */
  [[noreturn]] void hang(const std::string &file)
  {
    const pid_t other = fork();
    if(other != 0)
      std::ofstream(file) << getpid() << ' ' << other << std::endl;
    for(;;)
      sleep(1);
  }

  std::vector<double> middles(int n)
  {
    std::vector<double> x;
    for(int i = 0; i < n; ++i)
      x.push_back((i + 0.5) / n);
    return x;
  }

  json start(int n, const std::string &how)
  {
    json line{{"kind", "start"},
              {"protocol", 1},
              {"spacing", how == "coarse" ? 0.9 : 1. / n},
              {"positions", {middles(n)}},
              {"weights", std::vector<double>(static_cast<std::size_t>(n), 1. / n)},
              {"parameters", {{"how", how}}}};
    if(how == "weights")
      line["weights"][0] = 1;
    if(how == "flat")
      line["weights"].erase(0);
    return line;
  }

  /** What all have in common that hold the exact state. */
  json state(int n, double time, double &initial)
  {
    const double front = 0.5 * std::sqrt(time);
    std::vector<double> temperature, solid;
    double stored = 0, latent = 0;
    for(int i = 0; i < n; ++i)
    {
      temperature.push_back((i + 0.5) / n - front);
      solid.push_back(std::clamp(front * n - i, 0., 1.));
      stored += temperature.back() / n;
      latent += (1 - solid.back()) / n;
    }
    if(time == 0)
      initial = stored + latent;
    return {{"kind", "snapshot"},
            {"time", time},
            {"temperature", temperature},
            {"solid_fraction", solid},
            {"heat",
             {{"stored", stored},
              {"latent", latent},
              {"boundary", stored + latent - initial},
              {"sources", 0}}}};
  }

  /** Spoil a snapshot of the middle of the run. */
  void spoil(json &line, const std::string &how)
  {
    if(how == "front")
      line["front"] = {{0.9}};
    if(how == "phase")
      for(std::size_t i = line["solid_fraction"].size() / 2;
          i < line["solid_fraction"].size(); ++i)
        line["solid_fraction"][i] = 1;
    if(how == "sites")
      line["temperature"].erase(0);
    if(how == "time")
      line["time"] = line["time"].get<double>() + 0.01;
    if(how == "fraction")
      line["solid_fraction"][0] = 1.5;
    if(how == "null")
      line["temperature"][0] = nullptr;
    if(how == "word")
      line["solid_fraction"][0] = "solid";
    if(how == "book")
      line["heat"]["boundary"] = 0.3;
    if(how == "bookless")
      line.erase("heat");
    if(how == "hot")
      line["temperature"].back() = 7;
    if(how == "surplus")
      line["entropy"] = 1;
  }

  /** @return whether the answer goes on */
  bool tell(const json &line, const std::string &how)
  {
    if(how == "crash")
      std::raise(SIGSEGV);
    if(how == "status")
    {
      std::cerr << "the matrix is singular\n";
      std::exit(3);
    }
    if(how == "stop")
      return false;
    std::string text = line.dump();
    if(how == "nan")
      text.replace(text.find("\"temperature\":[") + 15, 1, "NaN,");
    if(how == "garbage")
      text = "step 17 done";
    if(how != "missing")
      std::cout << text << '\n';
    if(how == "twice")
      std::cout << text << '\n';
    return true;
  }

  void answer(const json &request, const std::string &how)
  {
    const int n = request.at("n");
    const std::vector<double> times = request.at("times").at("values");
    std::cout << start(n, how).dump() << '\n';
    double initial = 0;
    for(std::size_t i = 0; i < times.size(); ++i)
    {
      json line = state(n, times[i], initial);
      const bool spoilt = i == times.size() / 2;
      if(spoilt)
        spoil(line, how);
      if(!tell(line, spoilt ? how : ""))
        return;
    }
    std::cout << json{{"kind", "end"}, {"steps", times.size() - 1}, {"work", 7}}.dump()
              << '\n';
    if(how == "more")
      std::cout << "bye\n";
  }
} // namespace

int main(int argc, char **argv)
{
  const std::string how = argc > 1 ? argv[1] : "";
  if(how == "silent")
    return 0;
  if(how == "late")
    hang(argv[2]);
  if(how == "endless")
    write_for_ever(std::cout);
  if(how == "endless messages")
    write_for_ever(std::cerr);
  if(how == "blank")
    std::cout << std::string(1000, '\n');
  const json request = json::parse(std::cin);
  if(how == "refused")
    std::cout << json{{"kind", "refused"}, {"reason", "n is odd"}}.dump() << '\n';
  else if(how == "echo")
    std::cout << request.dump() << '\n';
  else
    answer(request, how);
}
