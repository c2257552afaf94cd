#include <cases/error.h>
#include <cases/stopwatch.h>
#include <particles/benchmarks/lammps.h>
#include <particles/greenspan/generation.h>
#include <particles/greenspan/motion/motion.h>

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <limits>
#include <ostream>
#include <sstream>

namespace meltfront::particles::benchmarks
{
  namespace
  {
    /** Room around a solid that flies apart. */
    constexpr double room = 50;

    /** A folder of one's own that is removed at the end. */
    class WorkFolder
    {
    public:
      WorkFolder()
      {
        std::string name = (std::filesystem::temp_directory_path()
                            / ("meltfront-lammps-" + std::string(6, 'X')))
                               .string();
        if(!mkdtemp(name.data()))
          throw cases::OutputError("no temporary folder can be made for LAMMPS");
        path = name;
      }

      WorkFolder(const WorkFolder &) = delete;
      WorkFolder &operator=(const WorkFolder &) = delete;

      ~WorkFolder()
      {
        std::error_code ignored;
        std::filesystem::remove_all(path, ignored);
      }

      std::filesystem::path path;
    };

    void write_data(const std::filesystem::path &file,
                    const greenspan::ParticleState &state)
    {
      std::ofstream out(file);
      out << fmt::format("isolated solid\n\n{} atoms\n1 atom types\n\n", state.size());
      for(int d = 0; d < 2; ++d)
      {
        const auto [least, most]
            = std::minmax_element(state.position[d].begin(), state.position[d].end());
        const char *name = d == 0 ? "x" : "y";
        out << fmt::format("{:.17g} {:.17g} {}lo {}hi\n", *least - room, *most + room,
                           name, name);
      }
      out << "-0.5 0.5 zlo zhi\n\nMasses\n\n1 1.0\n\nAtoms # atomic\n\n";
      for(std::size_t i = 0; i < state.size(); ++i)
        out << fmt::format("{} 1 {:.17g} {:.17g} 0\n", i + 1, state.position[0][i],
                           state.position[1][i]);
      out << "\nVelocities\n\n";
      for(std::size_t i = 0; i < state.size(); ++i)
        out << fmt::format("{} {:.17g} {:.17g} 0\n", i + 1, state.velocity[0][i],
                           state.velocity[1][i]);
    }

    void write_input(const std::filesystem::path &file, const MiePotential &mie,
                     double time_step, long steps)
    {
      std::ofstream(file) << fmt::format(
          "units lj\ndimension 2\natom_style atomic\nboundary f f p\natom_modify sort "
          "1000 0\n"
          "read_data data.txt\npair_style mie/cut {:.17g}\n"
          "pair_coeff 1 1 {:.17g} {:.17g} {:.17g} {:.17g}\n"
          "neighbor 0.3 bin\nneigh_modify every 1 delay 0 check yes\n"
          "timestep {:.17g}\nfix 1 all nve\nfix 2 all enforce2d\nthermo {}\nrun {}\n"
          "write_dump all custom end.txt id x y vx vy modify sort id format float "
          "%.17g\n",
          mie.cutoff, mie.epsilon, mie.sigma, mie.repulsion_exponent,
          mie.attraction_exponent, time_step, steps, steps);
    }

    greenspan::ParticleState read_end(const std::filesystem::path &file, std::size_t n)
    {
      std::ifstream in(file);
      std::string line;
      while(std::getline(in, line) && !line.starts_with("ITEM: ATOMS"))
      {
      }
      greenspan::ParticleState state;
      std::size_t id;
      std::array<double, 3> point{};
      double u, v;
      while(in >> id >> point[0] >> point[1] >> u >> v)
      {
        state.add(point);
        state.velocity[0].back() = u;
        state.velocity[1].back() = v;
      }
      if(state.size() != n)
        throw cases::OutputError(
            fmt::format("LAMMPS left {} particles of {} in its dump", state.size(), n));
      return state;
    }

    double read_seconds(const std::filesystem::path &file)
    {
      std::ifstream in(file);
      for(std::string line; std::getline(in, line);)
        if(line.starts_with("Loop time of "))
          return std::stod(line.substr(std::string("Loop time of ").size()));
      throw cases::OutputError("LAMMPS wrote no loop time to its log");
    }

    greenspan::ParticleState crystal(int per_side)
    {
      using namespace greenspan;
      ParticleState state = HexagonalLattice::rectangle(
          per_side, per_side, PairForce::triangle().equilibrium_distance());
      set_temperature(state, 2.626, 1);
      return state;
    }

    double our_seconds(const greenspan::ParticleState &start, double time_step,
                       long steps)
    {
      greenspan::MotionParameters parameters;
      parameters.gravity = 0;
      parameters.time_step = time_step;
      greenspan::Motion motion(parameters, start);
      const cases::Stopwatch watch;
      motion.advance(steps);
      return watch.elapsed().wall;
    }
  } // namespace

  std::optional<std::string> find_lammps()
  {
    const char *path = std::getenv("PATH");
    std::istringstream folders(path ? path : "");
    for(std::string folder; std::getline(folders, folder, ':');)
    {
      const std::string program = folder + "/lmp";
      if(access(program.c_str(), X_OK) == 0)
        return program;
    }
    return std::nullopt;
  }

  MiePotential::MiePotential(const greenspan::PairForce &force)
    : epsilon(0)
    , sigma(0)
    , repulsion_exponent(force.repulsion_exponent - 1)
    , attraction_exponent(force.attraction_exponent - 1)
    , cutoff(force.cutoff)
  {
    sigma = std::pow(force.repulsion * attraction_exponent
                         / (force.attraction * repulsion_exponent),
                     1 / (repulsion_exponent - attraction_exponent));
    const double r = force.equilibrium_distance();
    epsilon = force.attraction / attraction_exponent * std::pow(r, -attraction_exponent)
              - force.repulsion / repulsion_exponent * std::pow(r, -repulsion_exponent);
  }

  LammpsRun run_lammps(const std::string &program, const greenspan::PairForce &force,
                       const greenspan::ParticleState &start, double time_step,
                       long steps)
  {
    const WorkFolder folder;
    write_data(folder.path / "data.txt", start);
    write_input(folder.path / "input.txt", MiePotential(force), time_step, steps);
    const std::string command = fmt::format(
        "cd '{}' && OMP_NUM_THREADS=1 '{}' -in input.txt -log log.txt -screen "
        "none >output.txt 2>&1 </dev/null",
        folder.path.string(), program);
    if(std::system(command.c_str()) != 0)
    {
      std::ifstream log(folder.path / "log.txt");
      std::string line, last;
      while(std::getline(log, line))
        last = line.starts_with("ERROR") ? line : last;
      throw cases::OutputError(
          fmt::format("{} fails on an isolated solid: {}", program,
                      last.empty() ? "it says nothing in its log" : last));
    }
    return {read_end(folder.path / "end.txt", start.size()),
            read_seconds(folder.path / "log.txt")};
  }

  void compare_with_lammps(std::ostream &out)
  {
    const std::optional<std::string> program = find_lammps();
    if(!program)
    {
      out << "\nLAMMPS (lmp) is not installed: particle solids are not compared with "
             "it\n";
      return;
    }
    out << fmt::format(
        "\nfree crystal, leapfrog, one thread, ns of wall time per particle "
        "and step, least of three in turn\n{:>10} {:>8} {:>12} {:>12} {:>8}\n",
        "particles", "steps", "LAMMPS", "meltfront", "ratio");
    constexpr double time_step = 1e-4;
    for(const auto &[per_side, steps] : {std::pair{32, 3000L}, {100, 300L}, {316, 30L}})
    {
      const greenspan::ParticleState start = crystal(per_side);
      double theirs = std::numeric_limits<double>::infinity(), ours = theirs;
      for(int turn = 0; turn < 3; ++turn)
      {
        theirs = std::min(theirs, run_lammps(*program, greenspan::PairForce::triangle(),
                                             start, time_step, steps)
                                      .seconds);
        ours = std::min(ours, our_seconds(start, time_step, steps));
      }
      const double unit = 1e9 / (static_cast<double>(start.size()) * double(steps));
      out << fmt::format("{:>10} {:>8} {:>12.1f} {:>12.1f} {:>8.2f}\n", start.size(),
                         steps, unit * theirs, unit * ours, theirs / ours)
          << std::flush;
    }
  }
} // namespace meltfront::particles::benchmarks
