#include <cases/error.h>
#include <verification/app/calibrate.h>
#include <verification/app/commands.h>

#include <fmt/format.h>

#include <unistd.h>

#include <cstdio>
#include <filesystem>
#include <fstream>
#include <thread>

namespace meltfront::verification
{
  namespace
  {
    using namespace particles::greenspan;

    /** Shares of the runs as they end; on one line of a terminal. */
    CalibrationProgress progress_on(std::FILE *file)
    {
      const bool terminal = isatty(fileno(file)) != 0;
      return [file, terminal](const double share, const std::string &what)
      {
        fmt::print(file, "{}{:3.0f} % {}{}", terminal ? "\r\033[K" : "", 100 * share,
                   what, terminal && share < 1 ? "" : "\n");
        std::fflush(file);
      };
    }

    CalibrationSettings settings_of(const CalibrateArguments &arguments)
    {
      const PairForce force = arguments.substance == "rectangle" ? PairForce::rectangle()
                                                                 : PairForce::triangle();
      CalibrationSettings settings = arguments.full ? CalibrationSettings::full(force)
                                                    : CalibrationSettings::quick(force);
      if(arguments.pressure >= 0)
        settings.pressure = arguments.pressure;
      if(arguments.seeds > 0)
        settings.members = arguments.seeds;
      settings.threads
          = arguments.jobs > 0
                ? arguments.jobs
                : std::max(1, static_cast<int>(std::thread::hardware_concurrency()));
      return settings;
    }

    std::string line(const char *name, const Measured &property)
    {
      return fmt::format("  {:<44} {:>10.4g} +- {:.2g}\n", name, property.value,
                         property.error);
    }

    std::string phase_text(const char *name, const MeasuredPhase &phase)
    {
      std::string text = fmt::format("{} at the melting temperature:\n", name);
      text += line("density", phase.density) + line("  per degree", phase.density_slope);
      text += line("heat capacity, per mass", phase.heat_capacity)
              + line("  per degree", phase.heat_capacity_slope);
      text += line("conductivity", phase.conductivity)
              + line("  per degree", phase.conductivity_slope);
      return text;
    }

    std::string phase_section(const char *name, const ContinuumPhase &phase,
                              const double excess, const double density)
    {
      return fmt::format("  subsection {}\n"
                         "    set conductivity = {:.6g}\n"
                         "    set specific heat capacity = {:.6g}\n"
                         "    set density = {:.6g}\n"
                         "  end\n",
                         name, phase.mass_conductivity(excess) / density,
                         phase.heat_capacity(excess), density);
    }

    void write(const std::string &path, const std::string &text)
    {
      const std::filesystem::path folder = std::filesystem::path(path).parent_path();
      std::error_code failure;
      if(!folder.empty())
        std::filesystem::create_directories(folder, failure);
      std::ofstream file(path);
      file << text;
      if(!file.flush())
        throw cases::OutputError(fmt::format("{} cannot be written", path));
    }
  } // namespace

  std::string calibration_text(const ContinuumMaterial &material)
  {
    std::string text = fmt::format("Pressure {:.4g}, {} seeds:\n",
                                   material.settings.pressure, material.members.size());
    for(const FailedSeed &failed : material.failures)
      text += fmt::format("  without seed {}: {}\n", failed.seed, failed.reason);
    text += line("melting temperature", material.melting_temperature);
    text += line("latent heat, per mass", material.latent_heat);
    text += phase_text("Solid", material.solid) + phase_text("Liquid", material.liquid);
    return text;
  }

  std::string material_section(const ContinuumMaterial &material, const double hot,
                               const double cold)
  {
    const Substance substance = material.substance();
    const double melting = substance.melting_temperature;
    if(!(cold < melting && melting < hot))
      throw cases::InputError(fmt::format(
          "--hot {} and --cold {} do not lie on either side of the melting temperature, "
          "which was found to be {:.4g}",
          hot, cold, melting));
    const double density = substance.solid.density(0);
    return fmt::format("subsection Material\n"
                       "  set latent heat = {:.6g}\n"
                       "  set melting temperature = {:.6g}\n",
                       substance.latent_heat, melting)
           + phase_section("Solid", substance.solid, (cold - melting) / 2, density)
           + phase_section("Liquid", substance.liquid, (hot - melting) / 2, density)
           + "end\n";
  }

  int calibrate(const CalibrateArguments &arguments)
  {
    const CalibrationSettings settings = settings_of(arguments);
    const ContinuumMaterial material = calibrate(settings, progress_on(stderr));
    std::string text = calibration_text(material);
    const std::string section = material_section(material, arguments.hot, arguments.cold);
    const Measured slope = material.front_slope(arguments.hot, arguments.cold);
    text += fmt::format("A front between {:.4g} and {:.4g}, as the continuum has it:\n",
                        arguments.hot, arguments.cold);
    text += line("square of the molten mass per width, per time", slope);
    std::fputs(text.c_str(), stdout);

    std::string comment;
    for(std::size_t begin = 0; begin < text.size();)
    {
      const std::size_t end = text.find('\n', begin);
      comment += "# " + text.substr(begin, end - begin) + "\n";
      begin = end + 1;
    }
    const std::string path
        = arguments.output.empty()
              ? fmt::format("results/calibration-{}.prm", arguments.substance)
              : arguments.output;
    write(path,
          fmt::format("# Measured by meltfront calibrate greenspan, substance {}.\n{}"
                      "#\n# Lengths are masses per width over the density of the solid; "
                      "see particles/greenspan.\n\n{}",
                      arguments.substance, comment, section));
    fmt::print("Written to {}\n", path);
    return all_well;
  }
} // namespace meltfront::verification
